
#include "core/io/preset_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/cloth/state.h"
#include "core/contact/self_contact.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"
#include "core/io/json_tree.h"
#include "core/io/output_file.h"
#include "core/model/fabric.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double farthest_key = 1e3;      // of a path, s and m
constexpr std::size_t most_keys = 10000;  // of a path

using Type = JsonNode::Type;

/// Why `v` is not allowed, or empty. The one place where ranges are checked.
template <class T>
std::string range_problem(const Row<T>& row, double v) {
  if (std::isfinite(v) && v >= row.min && v <= row.max) return {};
  return shortest_number(v) + " is not allowed; allowed: " + shortest_number(row.min) + " to " +
         shortest_number(row.max) + (row.unit.empty() ? "" : " " + std::string(row.unit)) +
         (row.zero_is_off ? " (0: never)" : "");
}

template <class T>
std::string value_problem(const Row<T>& row, const T& object) {
  return std::visit(
      [&](auto field) -> std::string {
        const auto& value = object.*field;
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, glm::dvec3>) {
          for (int c = 0; c < 3; ++c)
            if (auto problem = range_problem(row, value[c]); !problem.empty()) return problem;
          return {};
        } else if constexpr (std::is_same_v<Value, std::string>) {
          if (row.key == "integrator" && !is_integrator(value))
            return "\"" + excerpt(value) + "\" is not an integrator" + did_you_mean(value, integrator_names(), ".") +
                   " Known: " + joined(integrator_names());
          const std::span<const std::string_view> allowed = row.key == "contact" ? std::span(contact_names)
                                                            : row.key == "self"  ? std::span(self_names)
                                                            : row.key == "tearing.mode"
                                                                ? std::span(tearing_names)
                                                                : std::span<const std::string_view>();
          if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), value) == allowed.end())
            return "\"" + excerpt(value) + "\" is not known" + did_you_mean(value, allowed, ".") +
                   " Allowed: " + joined(allowed);
          return {};
        } else {
          return is_absent(row, double(value)) ? std::string() : range_problem(row, double(value));
        }
      },
      row.field);
}

/// What is wrong with the number as it is written, where a whole one is meant: 1e9, 1.5, or more than an int holds.
template <class T>
std::string whole_number_problem(const Row<T>& row, const JsonNode& node) {
  if (!std::holds_alternative<int T::*>(row.field) || !node.is_number()) return {};
  if (std::string problem = range_problem(row, node.number); !problem.empty()) return problem;
  if (node.type == Type::integer) return {};
  return "must be written as a whole number, like 32; allowed: " + shortest_number(row.min) + " to " +
         shortest_number(row.max);
}

std::string sites_problem(const Preset& p, Pins::Mode mode, const std::vector<Pins::Site>& list) {
  if (mode != Pins::Mode::list) return {};
  for (const auto [i, j] : list)
    if (i < 0 || i >= p.rows || j < 0 || j >= p.columns)
      return "[" + std::to_string(i) + ", " + std::to_string(j) + "] is outside the cloth; allowed: [0, 0] to [" +
             std::to_string(p.rows - 1) + ", " + std::to_string(p.columns - 1) + "]";
  return {};
}

/// Values that only other shapes have mean nothing, and no writer keeps them.
void drop_other_shapes(Body& body) {
  for (const BodyRow& row : body_notation())
    if (!shape_has(body.shape, row.key)) std::visit([&](auto field) { body.*field = Body().*field; }, row.field);
}

std::string too_far(double value) {
  return "must hold numbers from -1000 to 1000, not " + shortest_number(value);
}

std::string path_problem(const std::vector<PathKey>& path) {
  for (std::size_t n = 0; n < path.size(); ++n) {
    const PathKey& key = path[n];
    const std::string at = "[" + std::to_string(n) + "] ";
    for (const double value : {key.t, key.x.x, key.x.y, key.x.z})
      if (!(std::abs(value) <= farthest_key)) return at + too_far(value);
    if (n > 0 && !(key.t > path[n - 1].t)) return at + "must be later than the one before";
  }
  return {};
}

std::string path_problem(const Body& body) {
  if (!body.path.empty() && body.velocity != glm::dvec3(0))
    return "a body follows its path or has a velocity, not both; remove one";
  return path_problem(body.path);
}

std::string self_contact_problem(const Preset& p) {
  if (!touches_itself(p)) return {};
  if (const double most = largest_thickness(p.L); contact_thickness(p) > most)
    return "contact.thickness: " + quantity(p.thickness, "m") +
           " is too thick for a spacing of L = " + quantity(p.L, "m") + "; at most " + quantity(most, "m") +
           ", or a coarser cloth";
  // Nearer than that, all parts of the cloth are near dozens of others.
  if (constexpr double least = 0.2; p.initial_stretch < least)
    return "cloth.initial_stretch: must be at least " + shortest_number(least) +
           " with contact of the cloth with itself (contact.self)";
  return {};
}

std::string parting_problem(const Preset& p) {
  if (!parts(p)) return {};
  const auto beside = [](const std::string& what) {
    return "tearing.mode: split does not go with " + what + " yet; use springs";
  };
  if (p.columns < 2) return "tearing.mode: a cloth that parts needs at least 2 columns; use springs";
  if (force::curl.on(p)) return beside("a curvature at rest (kappa_warp, kappa_weft)");
  if (parts_cloth(scheme(p.integrator))) return {};
  std::vector<std::string_view> can;
  for (const Scheme& method : schemes())
    if (parts_cloth(method)) can.push_back(method.name);
  return "tearing.mode: " + p.integrator + " does not part the cloth; methods that do: " + joined(can);
}

/// What is wrong with a motion of pins.
std::string motion_problem(const Preset& p, const Pins::Motion& motion) {
  if (const auto problem = sites_problem(p, motion.mode, motion.list); !problem.empty()) return "pins: " + problem;
  if (const auto problem = path_problem(motion.path); !problem.empty()) return "path" + problem;
  for (const auto& [key, v] : {std::pair("spin", motion.spin), std::pair("center", motion.center)})
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(v[c]) <= farthest_key)) return std::string(key) + " " + too_far(v[c]);
  if (!(motion.until >= 0 && motion.until <= farthest_key))
    return "until must be a number from 0 to 1000 s, not " + shortest_number(motion.until);
  return {};
}

std::string motions_problem(const Preset& p) {
  for (std::size_t n = 0; n < p.pins.motions.size(); ++n)
    if (const auto problem = motion_problem(p, p.pins.motions[n]); !problem.empty())
      return "[" + std::to_string(n) + "] " + problem;
  return {};
}

/// Where a motion picks no pinned particle, which only files and settings are asked for: pins come and go in the
/// window.
std::string idle_motion_problem(const Preset& p) {
  const std::vector<bool> moves = moves_pins(p);
  const auto idle = std::find(moves.begin(), moves.end(), false);
  return idle == moves.end() ? ""
                             : "[" + std::to_string(idle - moves.begin()) +
                                   "] pins: none of these particles is pinned; allowed: those of cloth.pins";
}

/// The section that has the key, in quotes, or where else it belongs; empty if it is unknown everywhere.
std::string home_of(std::string_view key) {
  const auto is_one_of = [&](std::initializer_list<std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  const auto quantities = fabric_quantities();
  std::string_view section;
  if (is_one_of({"tyglab_preset", "kind", "name", "description", "bodies", "fabric"})) return "the top level";
  if (is_one_of({"pins", "pin_motions"}))
    section = "cloth";
  else if (is_one_of({"engine", "precision"}))
    section = "solver";
  else if (const PresetRow* row = find_row(key))
    section = row->section;
  else if (std::any_of(quantities.begin(), quantities.end(), [&](const auto& one) { return one.key == key; }))
    section = "fabric";
  return section.empty() ? "" : "\"" + std::string(section) + "\"";
}

/// Reads values of one source (a file, a --set) into a preset; knows how to complain.
class Reader {
 public:
  /// `at`: what stands before the keys' names where the preset is a part of something else.
  explicit Reader(std::string_view source, std::string_view at = {}) : source_(source), at_(at) {}

  [[noreturn]] void fail(int line, const std::string& path, const std::string& why) const {
    const std::string key = at_ + (at_.empty() || path.empty() ? "" : ".") + path;
    throw PresetError(printable(excerpt(source_, 300) + (line > 0 ? ":" + std::to_string(line) : "") + ": " +
                                excerpt(key, 200) + (key.empty() ? "" : ": ") + why));
  }
  [[noreturn]] void wrong_type(const JsonNode& node, const std::string& path, std::string_view expected) const {
    constexpr std::size_t short_enough = 30;  // bytes of a text that is worth repeating
    const bool told = node.type == Type::text && !node.text.empty() && node.text.size() <= short_enough;
    fail(node.line, path,
         "must be " + std::string(expected) + ", not " +
             (told ? "the string \"" + node.text + "\"" : std::string(type_name(node.type))));
  }

  /// Refuses what is no list of that many.
  void check_list(const JsonNode& node, const std::string& path, std::string_view expected, std::size_t size) const {
    if (node.type != Type::list) wrong_type(node, path, expected);
    const std::size_t count = node.items.size();
    if (count != size)
      fail(node.line, path,
           "must be " + std::string(expected) + ", not of " + std::to_string(count) +
               (count == 1 ? " number" : " numbers"));
  }

  /// The other constant's key in place of a number: this one is absent. What stands for that is no number that a file
  /// may contain.
  template <class T>
  bool take_otherwise(const JsonNode& node, const std::string& path, const Row<T>& row, T& object) const {
    if (node.type == Type::text && node.text == row.otherwise) {
      object.*std::get<double T::*>(row.field) = left_out;
      return true;
    }
    if (!node.is_number()) wrong_type(node, path, "a number, or " + std::string(row.otherwise));
    if (const auto problem = range_problem(row, node.number); !problem.empty()) fail(node.line, path, problem);
    return false;
  }

  template <class T>
  void field(const JsonNode& node, const std::string& path, const Row<T>& row, T& object) const {
    if (const std::string problem = whole_number_problem(row, node); !problem.empty()) fail(node.line, path, problem);
    if (!row.otherwise.empty() && take_otherwise(node, path, row, object)) return;
    std::visit([&](auto member) { value(node, path, object.*member); }, row.field);
    if (const auto problem = value_problem(row, object); !problem.empty()) fail(node.line, path, problem);
  }

  template <class Enum, std::size_t N>
  void choice(const JsonNode& node, const std::string& path, const std::array<std::string_view, N>& names,
              Enum& out) const {
    if (node.type != Type::text) wrong_type(node, path, "a string, one of " + joined(names));
    const auto it = std::find(names.begin(), names.end(), node.text);
    if (it == names.end())
      fail(node.line, path,
           "\"" + excerpt(node.text) + "\" is not known" + did_you_mean(node.text, names, ".") +
               " Allowed: " + joined(names));
    out = Enum(it - names.begin());
  }

  void value(const JsonNode& node, const std::string& path, double& out) const {
    if (!node.is_number()) wrong_type(node, path, "a number");
    out = node.number;
  }
  void value(const JsonNode& node, const std::string& path, int& out) const {
    if (node.type == Type::number) fail(node.line, path, "must be written as a whole number, like 32");
    if (node.type != Type::integer) wrong_type(node, path, "a whole number");
    out = int(std::clamp(node.number, -2147483648.0, 2147483647.0));
  }
  void value(const JsonNode& node, const std::string& path, std::string& out) const {
    if (node.type != Type::text) wrong_type(node, path, "a string");
    out = node.text;
  }
  /// A text that is drawn in every frame, of at most that many bytes.
  void words(const JsonNode& node, const std::string& path, std::size_t most, std::string& out) const {
    value(node, path, out);
    if (out.size() > most)
      fail(node.line, path,
           "must be a string of at most " + std::to_string(most) + " bytes; it has " + std::to_string(out.size()));
  }
  void value(const JsonNode& node, const std::string& path, glm::dvec3& out) const {
    check_list(node, path, "a list of three numbers", 3);
    for (int c = 0; c < 3; ++c) value(node.items[c], path + "[" + std::to_string(c) + "]", out[c]);
  }

  void sites(const JsonNode& node, const std::string& path, Pins::Mode& mode, std::vector<Pins::Site>& list) const {
    list.clear();
    if (node.type == Type::text) {
      choice(node, path,
             std::to_array<std::string_view>(
                 {"none", "top_row", "top_corners", "four_corners", "left_column", "boundary"}),
             mode);
      return;
    }
    if (node.type != Type::list) wrong_type(node, path, "a name or a list of [row, column]");
    mode = Pins::Mode::list;
    for (std::size_t n = 0; n < node.items.size(); ++n) {
      const JsonNode& item = node.items[n];
      const std::string item_path = path + "[" + std::to_string(n) + "]";
      check_list(item, item_path, "[row, column]", 2);
      Pins::Site site;
      value(item.items[0], item_path, site.i);
      value(item.items[1], item_path, site.j);
      list.push_back(site);
    }
  }

  void pin_motion(const JsonNode& node, const std::string& path, Pins::Motion& out) const {
    if (node.type != Type::object) wrong_type(node, path, "an object {…}");
    for (const auto& [key, child] : node.members) {
      const std::string at = path + "." + key;
      if (key == "pins")
        sites(child, at, out.mode, out.list);
      else if (key == "path")
        keys(child, at, out.path);
      else if (key == "spin" || key == "center")
        value(child, at, key == "spin" ? out.spin : out.center);
      else if (key == "until")
        value(child, at, out.until);
      else
        unknown(child.line, at, key, {"pins", "path", "spin", "center", "until"});
    }
    if (node.find("pins") == nullptr) fail(node.line, path, "has no pins: which of the pinned particles it moves");
    if (out.until != 0 && out.spin == glm::dvec3(0))
      fail(node.find("until")->line, path + ".until", "ends a spin, and there is none; add spin, or remove until");
  }

  void pin_motions(const JsonNode& node, const std::string& path, std::vector<Pins::Motion>& out) const {
    if (node.type != Type::list) wrong_type(node, path, "a list of motions");
    out.assign(node.items.size(), {});
    for (std::size_t n = 0; n < out.size(); ++n)
      pin_motion(node.items[n], path + "[" + std::to_string(n) + "]", out[n]);
  }

  void keys(const JsonNode& node, const std::string& path, std::vector<PathKey>& out) const {
    if (node.type != Type::list) wrong_type(node, path, "a list of [t, x, y, z]");
    if (node.items.size() > most_keys)
      fail(node.line, path, "must be a list of at most " + std::to_string(most_keys) + " keys");
    out.assign(node.items.size(), {});
    for (std::size_t n = 0; n < out.size(); ++n) {
      const JsonNode& item = node.items[n];
      const std::string item_path = path + "[" + std::to_string(n) + "]";
      check_list(item, item_path, "[t, x, y, z]", 4);
      value(item.items[0], item_path, out[n].t);
      for (int c = 0; c < 3; ++c) value(item.items[std::size_t(c) + 1], item_path, out[n].x[c]);
    }
  }

  void body_key(const std::string& key, const JsonNode& node, const std::string& path, Body& body) const {
    if (key == "shape") return choice(node, path, shape_names, body.shape);
    if (key == "path") return keys(node, path, body.path);
    if (const BodyRow* row = find_body_row(key)) return field(node, path, *row, body);
    std::vector<std::string_view> known{"shape", "path"};
    for (const BodyRow& row : body_notation()) known.push_back(row.key);
    unknown(node.line, path, key, known);
  }

  void body(const JsonNode& node, const std::string& path, Body& out) const {
    if (node.type != Type::object) wrong_type(node, path, "an object {…}");
    out = {};
    for (const auto& [key, child] : node.members) body_key(key, child, path + "." + key, out);
    if (const auto problem = path_problem(out); !problem.empty()) fail(node.line, path + ".path", problem);
    drop_other_shapes(out);
  }

  void bodies(const JsonNode& node, const std::string& path, std::vector<Body>& out) const {
    if (node.type != Type::list) wrong_type(node, path, "a list of bodies");
    out.assign(node.items.size(), {});
    for (std::size_t n = 0; n < out.size(); ++n) body(node.items[n], path + "[" + std::to_string(n) + "]", out[n]);
  }

  /// One inner key. `section` empty: any section (as in --set).
  void key(std::string_view section, const std::string& name, const JsonNode& node, const std::string& path,
           Preset& p) const {
    const auto in = [&](std::string_view s) { return section.empty() || section == s; };
    if (in("cloth") && name == "pins") return sites(node, path, p.pins.mode, p.pins.list);
    if (in("cloth") && name == "pin_motions") return pin_motions(node, path, p.pins.motions);
    if (in("solver") && name == "engine") return choice(node, path, engine_names, p.engine);
    if (in("solver") && name == "precision") return choice(node, path, precision_names, p.precision);
    const PresetRow* row = section.empty() ? nullptr : find_row(std::string(section) + "." + name);
    if (row == nullptr) row = find_row(name);
    if (row && in(row->section)) return field(node, path, *row, p);
    if (const std::string home = home_of(name); !section.empty() && !home.empty())
      misplaced(node.line, path, name, home);
    std::vector<std::string_view> known;
    if (in("cloth")) known.insert(known.end(), {"pins", "pin_motions"});
    if (in("solver")) known.insert(known.end(), {"engine", "precision"});
    if (section.empty()) known.insert(known.end(), {"kind", "name", "description", "bodies"});
    for (const PresetRow& one : notation())
      if (in(one.section)) known.push_back(section.empty() ? one.key : one.key_in_section());
    unknown(node.line, path, name, known);
  }

  /// The section of quantities of a fabric, which are turned into constants of the forces.
  void fabric(const JsonNode& node, const std::string& path, Preset& p) const {
    if (node.type != Type::object) wrong_type(node, path, "an object {…}");
    std::vector<std::string_view> known;
    for (const FabricQuantity& quantity : fabric_quantities()) known.push_back(quantity.key);
    for (const auto& [key, child] : node.members)
      if (std::find(known.begin(), known.end(), key) == known.end()) unknown(child.line, path + "." + key, key, known);
    const auto path_of = [&](const FabricQuantity& quantity) { return path + "." + std::string(quantity.key); };
    FabricValues values(known.size());
    for (std::size_t n = 0; n < values.size(); ++n)
      if (const JsonNode* child = node.find(known[n]))
        value(*child, path_of(fabric_quantities()[n]), values[n].emplace());
    if (const auto problem = set_fabric(p, values)) {
      const JsonNode* child = node.find(problem->quantity->key);
      fail((child != nullptr ? child : &node)->line, path_of(*problem->quantity), problem->why);
    }
  }

  /// A key of the file's top level that is not a section.
  bool top_key(const std::string& name, const JsonNode& node, Preset& p) const {
    if (name == "kind") return choice(node, name, kind_names, p.kind), true;
    if (name == "name") return words(node, name, 200, p.name), true;
    if (name == "description") return words(node, name, 4000, p.description), true;
    if (name == "bodies") return bodies(node, name, p.bodies), true;
    return false;
  }

  [[noreturn]] void misplaced(int line, const std::string& path, const std::string& key,
                              const std::string& home) const {
    fail(line, path, "unknown key; " + key + " belongs to " + home);
  }
  [[noreturn]] void unknown(int line, const std::string& path, const std::string& key,
                            const std::vector<std::string_view>& known) const {
    fail(line, path, "unknown key" + did_you_mean(key, known, "; known: " + joined(known)));
  }

 private:
  std::string source_, at_;
};

void check_version(const Reader& reader, const JsonNode& node) {
  if (node.type == Type::number)
    reader.fail(node.line, "tyglab_preset",
                "must be written as a whole number, like " + std::to_string(preset_version));
  if (node.type != Type::integer) reader.wrong_type(node, "tyglab_preset", "a whole number");
  if (node.number > preset_version)
    reader.fail(node.line, "tyglab_preset",
                "this preset has version " + shortest_number(node.number) +
                    ", made by a newer Tyglab; this one reads up to " + std::to_string(preset_version) +
                    ". Update Tyglab, or save the preset in the older form");
  if (node.number < 1) reader.fail(node.line, "tyglab_preset", "versions begin at 1");
}

/// Keys whose values are words, even where they begin like numbers: name=3 sheets, texture=./mine.png.
bool is_text_key(const std::string& key) {
  constexpr std::array<std::string_view, 5> words{"name", "description", "kind", "engine", "precision"};
  const PresetRow* row = find_row(key);
  return std::find(words.begin(), words.end(), key) != words.end() ||
         (row && std::holds_alternative<std::string Preset::*>(row->field));
}

/// A number as people type it: also .5 and 5.
JsonNode setting_number(const std::string& key, const std::string& text, const Reader& reader) {
  JsonNode node;
  const char* end = text.data() + text.size();
  const auto [stop, error] = read_number(text.data(), end, node.number);
  if (error == std::errc::result_out_of_range && stop == end)
    reader.fail(0, key, "'" + excerpt(text) + "' is too large or too small for a number");
  if (text.empty() || error != std::errc{} || stop != end)
    reader.fail(0, key, "'" + excerpt(text) + "' is not a number; write it like 1.5 or 2e-3");
  node.type = text.find_first_of(".eE") == std::string::npos ? Type::integer : Type::number;
  return node;
}

/// Value of a setting: a bare word (integrator=euler, name=3 sheets), otherwise JSON. `key` without its block's name.
JsonNode setting_value(const Setting& setting, const std::string& key, const Reader& reader) {
  const std::string& text = setting.value;
  const bool word = !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0) && text != "null" &&
                    text != "true" && text != "false";
  if (word || (is_text_key(key) && !text.starts_with('"'))) {
    try {
      nlohmann::json(text).dump();
    } catch (const nlohmann::json::exception&) {
      reader.fail(0, setting.key, "must be UTF-8 text");
    }
    JsonNode node;
    node.type = Type::text;
    node.text = text;
    return node;
  }
  if (text.empty() || std::string_view("[{\"").find(text[0]) == std::string_view::npos)
    return setting_number(setting.key, text, reader);
  return parse_json(text, setting.typed, Lines::one);
}

/// "bodies[2].r" -> index 2, key "r".
bool body_setting(const std::string& key, std::size_t& index, std::string& inner) {
  if (key.rfind("bodies[", 0) != 0) return false;
  const auto close = key.find("].");
  if (close == std::string::npos) return false;
  const char* begin = key.data() + 7;
  const auto result = std::from_chars(begin, key.data() + close, index);
  inner = key.substr(close + 2);
  return result.ec == std::errc{} && result.ptr == key.data() + close;
}

/// A key of a body: bodies[0].r. Of whole bodies there is only the whole list.
void apply_to_body(const std::string& key, const JsonNode& node, const Reader& reader, Preset& p) {
  std::size_t index = 0;
  std::string inner;
  if (!body_setting(key, index, inner))
    reader.fail(0, key, "set one value of a body like bodies[0].r=0.3, and all bodies like bodies=[{\"r\": 0.3}]");
  const std::size_t count = p.bodies.size();
  if (index >= count)
    reader.fail(0, key,
                count == 0   ? "there are no bodies; bodies=[{\"r\": 0.3}] makes one"
                : count == 1 ? "there is one body, bodies[0]"
                             : "there are " + std::to_string(count) + " bodies, counted from 0");
  reader.body_key(inner, node, key, p.bodies[index]);
}

/// x_0.y sets one component. False if the key is none.
bool apply_to_component(const std::string& key, const JsonNode& node, const Reader& reader, Preset& p) {
  if (key.size() <= 2 || key[key.size() - 2] != '.' || key.back() < 'x' || key.back() > 'z') return false;
  const PresetRow* row = find_row(key.substr(0, key.size() - 2));
  const auto* vector = row ? std::get_if<glm::dvec3 Preset::*>(&row->field) : nullptr;
  if (!vector) return false;
  reader.value(node, key, (p.**vector)[key.back() - 'x']);
  if (const auto problem = value_problem(*row, p); !problem.empty()) reader.fail(0, key, problem);
  return true;
}

void apply_setting(const Setting& setting, Preset& p) {
  const Reader reader(setting.typed);
  std::string key = setting.key;
  std::string_view section;
  if (const auto dot = key.find('.'); dot != std::string::npos) {
    const auto it = std::find(section_names.begin(), section_names.end(), key.substr(0, dot));
    if (it != section_names.end()) section = *it, key.erase(0, dot + 1);
  }
  if (key == "fabric" || key.starts_with("fabric."))
    reader.fail(0, key, "the section fabric stands only in files; set m, B, k_warp, k_weft and k_shear");
  const JsonNode node = setting_value(setting, key, reader);
  if (section.empty() && reader.top_key(key, node, p)) return;
  if (section.empty() && key.starts_with("bodies[")) return apply_to_body(key, node, reader, p);
  if (!apply_to_component(key, node, reader, p)) reader.key(section, key, node, key, p);
}

/// Refuses a value of a body whose shape, once all settings are made, has none of that name.
void check_shape(const Setting& setting, const Preset& p) {
  std::size_t index = 0;
  std::string inner;
  if (!body_setting(setting.key, index, inner) || index >= p.bodies.size()) return;
  const Body::Shape shape = p.bodies[index].shape;
  if (shape_has(shape, inner)) return;
  std::vector<std::string_view> keys;
  for (const BodyRow& row : body_notation())
    if (shape_has(shape, row.key)) keys.push_back(row.key);
  Reader(setting.typed)
      .fail(0, setting.key, "a " + std::string(name_of(shape)) + " has no " + inner + "; it has " + joined(keys));
}

}  // namespace

std::string texture_problem(const std::string& texture, const std::filesystem::path& folder) {
  const std::string advice =
      "; allowed: a shipped texture's name, or an image in the preset's own folder or below it. Copy the image there, "
      "or choose it with --set texture=FILE";
  const std::filesystem::path named(texture);
  if (named.is_absolute() || std::find(named.begin(), named.end(), "..") != named.end())
    return "'" + excerpt(texture, 200) + "' lies outside the preset's folder" + advice;
  std::error_code error;
  const std::filesystem::path inside = std::filesystem::canonical(folder, error);
  const std::filesystem::path image = std::filesystem::canonical(folder / named, error);
  if (error) return {};  // it is missing, which is no error
  const auto [end, rest] = std::mismatch(inside.begin(), inside.end(), image.begin(), image.end());
  return end == inside.end()
             ? ""
             : "'" + excerpt(texture, 200) + "' is a link that leads out of the preset's folder" + advice;
}

Preset parse_preset(std::string_view text, std::string_view source, const std::filesystem::path& folder) {
  return preset_from(parse_json(text, source, Lines::told), source, folder);
}

Preset preset_from(const JsonNode& root, std::string_view source, const std::filesystem::path& folder,
                   std::string_view at) {
  const Reader reader(source, at);
  if (root.type != Type::object) reader.wrong_type(root, "", "an object {…}");
  if (const JsonNode* version = root.find("tyglab_preset")) check_version(reader, *version);
  Preset preset;
  int pins_line = 0, motions_line = 0, texture_line = 0;
  for (const auto& [name, node] : root.members) {
    if (name == "tyglab_preset" || name == "fabric" || reader.top_key(name, node, preset)) continue;
    if (std::find(section_names.begin(), section_names.end(), name) == section_names.end()) {
      if (const std::string home = home_of(name); !home.empty()) reader.misplaced(node.line, name, name, home);
      std::vector<std::string_view> known(section_names.begin(), section_names.end());
      known.insert(known.end(), {"tyglab_preset", "kind", "name", "description", "fabric"});
      reader.unknown(node.line, name, name, known);
    }
    if (node.type != Type::object) reader.wrong_type(node, name, "an object {…}");
    for (const auto& [key, child] : node.members) {
      reader.key(name, key, child, name + "." + key, preset);
      if (key == "pins") pins_line = child.line;
      if (key == "pin_motions") motions_line = child.line;
      if (key == "texture") texture_line = child.line;
    }
  }
  if (const auto problem = sites_problem(preset, preset.pins.mode, preset.pins.list); !problem.empty())
    reader.fail(pins_line, "cloth.pins", problem);
  if (const auto problem = motions_problem(preset); !problem.empty())
    reader.fail(motions_line, "cloth.pin_motions", problem);
  if (const auto problem = idle_motion_problem(preset); !problem.empty())
    reader.fail(motions_line, "cloth.pin_motions", problem);
  // After all others, since it depends on L: what they say is right, so whatever is not is due to the fabric.
  if (const JsonNode* fabric = root.find("fabric")) {
    reader.fabric(*fabric, "fabric", preset);
    if (const auto problem = check_preset(preset); !problem.empty()) reader.fail(fabric->line, "fabric", problem);
  }
  if (!folder.empty())
    if (const auto problem = texture_problem(preset.texture, folder); !problem.empty())
      reader.fail(texture_line, "view.texture", problem);
  return preset;
}

Setting parse_setting(const std::string& text) {
  const auto equals = text.find('=');
  Setting setting{"--set " + text, text.substr(0, equals), {}};
  if (equals == std::string::npos || equals == 0)
    Reader(setting.typed).fail(0, "", "must be KEY=VALUE, for example k_s=500");
  setting.value = text.substr(equals + 1);
  return setting;
}

Preset with_parsed_settings(const Preset& preset, const std::vector<Setting>& settings) {
  Preset changed = preset;
  for (const Setting& setting : settings) apply_setting(setting, changed);
  for (const Setting& setting : settings) check_shape(setting, changed);
  for (Body& body : changed.bodies) drop_other_shapes(body);
  if (const auto problem = check_preset(changed); !problem.empty()) throw PresetError("--set: " + problem);
  for (const Setting& setting : settings)
    if (setting.key == "pin_motions" || setting.key == "cloth.pin_motions")
      if (const auto problem = idle_motion_problem(changed); !problem.empty())
        Reader(setting.typed).fail(0, setting.key, problem);
  return changed;
}

Preset with_settings(const Preset& preset, const std::vector<std::string>& settings) {
  std::vector<Setting> parsed;
  parsed.reserve(settings.size());
  for (const std::string& text : settings) parsed.push_back(parse_setting(text));
  return with_parsed_settings(preset, parsed);
}

std::string check_preset(const Preset& preset) {
  for (const PresetRow& row : notation())
    if (const auto problem = value_problem(row, preset); !problem.empty())
      return std::string(row.section) + "." + std::string(row.key_in_section()) + ": " + problem;
  for (std::size_t n = 0; n < preset.bodies.size(); ++n)
    if (const auto problem = path_problem(preset.bodies[n]); !problem.empty())
      return "bodies[" + std::to_string(n) + "].path: " + problem;
  for (std::size_t n = 0; n < preset.bodies.size(); ++n)
    for (const BodyRow& row : body_notation())
      if (const auto problem = value_problem(row, preset.bodies[n]); !problem.empty())
        return "bodies[" + std::to_string(n) + "]." + std::string(row.key) + ": " + problem;
  if (const auto problem = sites_problem(preset, preset.pins.mode, preset.pins.list); !problem.empty())
    return "cloth.pins: " + problem;
  if (const auto problem = motions_problem(preset); !problem.empty()) return "cloth.pin_motions: " + problem;
  if (const auto problem = parting_problem(preset); !problem.empty()) return problem;
  return self_contact_problem(preset);
}

namespace {

constexpr std::uintmax_t max_file_size = 16u << 20;

}  // namespace

Preset load_preset(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found)
    throw PresetError(file.string() + ": there is no such file; `tyglab presets` lists the shipped ones");
  std::string text;
  try {
    text = read_input(file, "preset", max_file_size);
  } catch (const InputError& problem) {
    throw PresetError(problem.what());
  }
  return parse_preset(text, file.string(), file.has_parent_path() ? file.parent_path() : ".");
}

void save_preset(const Preset& preset, const std::filesystem::path& file) {
  write_atomically(file, preset_to_json(preset));
}

}  // namespace tyglab
