#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/cloth/state.h"
#include "core/io/json_tree.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
std::string json_text(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

std::string list_text(const glm::dvec3& v) {
  return "[" + shortest_number(v.x) + ", " + shortest_number(v.y) + ", " + shortest_number(v.z) + "]";
}

template <class T>
std::string field_text(const Row<T>& row, const T& object) {
  return std::visit(
      [&](auto field) -> std::string {
        const auto& value = object.*field;
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::string>)
          return json_text(value);
        else if constexpr (std::is_same_v<Value, glm::dvec3>)
          return list_text(value);
        else
          return is_absent(row, double(value)) ? json_text(row.otherwise) : shortest_number(double(value));
      },
      row.field);
}

std::string sites_text(Pins::Mode mode, const std::vector<Pins::Site>& list) {
  if (mode != Pins::Mode::list) return json_text(name_of(mode));
  const auto site = [](const Pins::Site& pin) {
    return "[" + std::to_string(pin.i) + ", " + std::to_string(pin.j) + "]";
  };
  return "[" + joined(list, ", ", site) + "]";
}

std::string path_text(const std::vector<PathKey>& path) {
  const auto key_text = [](const PathKey& at) {
    return "[" + shortest_number(at.t) + ", " + shortest_number(at.x.x) + ", " + shortest_number(at.x.y) + ", " +
           shortest_number(at.x.z) + "]";
  };
  return "[" + joined(path, ", ", key_text) + "]";
}

/// Without motions that pick no pinned particle: nothing reads them.
std::string motions_text(const Preset& p) {
  const std::vector<bool> moves = moves_pins(p);
  std::vector<Pins::Motion> motions;
  for (std::size_t n = 0; n < moves.size(); ++n)
    if (moves[n]) motions.push_back(p.pins.motions[n]);
  const auto text_of = [](const Pins::Motion& motion) {
    std::string text = "{\"pins\": " + sites_text(motion.mode, motion.list);
    if (!motion.path.empty()) text += ", \"path\": " + path_text(motion.path);
    if (motion.spin != glm::dvec3(0)) text += ", \"spin\": " + list_text(motion.spin);
    if (motion.center != glm::dvec3(0)) text += ", \"center\": " + list_text(motion.center);
    if (motion.until != 0 && motion.spin != glm::dvec3(0)) text += ", \"until\": " + shortest_number(motion.until);
    return text + "}";
  };
  return "[" + joined(motions, ", ", text_of) + "]";
}

std::string body_text(const Body& body) {
  std::string text = "{\"shape\": " + json_text(name_of(body.shape));
  for (const BodyRow& row : body_notation()) {
    // What the first release did not have is left out where it has its default, so that hashes stay.
    const bool later = row.key == "turn" || row.key == "velocity" || row.key == "spin";
    if (!shape_has(body.shape, row.key) || (later && field_text(row, body) == field_text(row, Body{}))) continue;
    text += ", " + json_text(row.key) + ": " + field_text(row, body);
  }
  if (!body.path.empty()) text += ", \"path\": " + path_text(body.path);
  return text + "}";
}

std::string bodies_text(const std::vector<Body>& bodies) {
  return bodies.empty() ? "[]" : "[\n    " + joined(bodies, ",\n    ", body_text) + "\n  ]";
}

/// Constants that the first release did not have. A hash leaves them out where they have their defaults, so that a
/// scene without them keeps its own; and so it does a section of nothing else.
constexpr std::array<std::string_view, 16> later{
    "tearing.mode", "self",    "thickness",   "friction", "B",   "twist", "contact",    "k_warp",
    "k_weft",       "k_shear", "air_density", "u",        "C_N", "C_T",   "kappa_warp", "kappa_weft"};
bool is_left_out(const PresetRow& row, const Preset& p) {
  return std::find(later.begin(), later.end(), row.key) != later.end() &&
         field_text(row, p) == field_text(row, Preset{});
}

std::string section_text(std::string_view section, const Preset& p, bool hashed) {
  if (section == "bodies") return "  \"bodies\": " + bodies_text(p.bodies);
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    text += (text.empty() ? "" : ", ") + json_text(key) + ": " + value;
  };
  for (const PresetRow& row : notation())
    if (row.section == section && !is_absent(row, p) && !(hashed && is_left_out(row, p)))
      add(row.key_in_section(), field_text(row, p));
  if (section == "cloth") add("pins", sites_text(p.pins.mode, p.pins.list));
  if (const std::string motions = section == "cloth" ? motions_text(p) : "[]"; motions != "[]")
    add("pin_motions", motions);
  if (section == "solver")
    add("engine", json_text(name_of(p.engine))), add("precision", json_text(name_of(p.precision)));
  return "  " + json_text(section) + ": {" + text + "}";
}

/// A word as --set takes it, in quotes where it could be read as JSON.
std::string setting_text(const std::string& text) {
  return text.starts_with('"') || text.empty() ? json_text(text) : text;
}

template <class T>
std::string setting_text(const Row<T>& row, const T& object) {
  if (is_absent(row, object)) return std::string(row.otherwise);
  const auto* const word = std::get_if<std::string T::*>(&row.field);
  return word != nullptr ? setting_text(object.**word) : field_text(row, object);
}

/// JSON without what stands between its parts.
std::string compact(const std::string& json) {
  std::string text;
  bool quoted = false;
  for (const char letter : json) {
    if (letter == '"' && !text.ends_with('\\')) quoted = !quoted;
    if (quoted || (letter != ' ' && letter != '\n')) text += letter;
  }
  return text;
}

}  // namespace

std::vector<std::string> settings_between(const Preset& from, const Preset& to) {
  std::vector<std::string> settings;
  const auto add = [&](std::string_view key, const std::string& before, const std::string& after) {
    if (before != after) settings.push_back(std::string(key) + "=" + after);
  };
  add("kind", std::string(name_of(from.kind)), std::string(name_of(to.kind)));
  add("name", setting_text(from.name), setting_text(to.name));
  for (const PresetRow& row : notation()) add(row.key, setting_text(row, from), setting_text(row, to));
  add("pins", compact(sites_text(from.pins.mode, from.pins.list)), compact(sites_text(to.pins.mode, to.pins.list)));
  add("pin_motions", compact(motions_text(from)), compact(motions_text(to)));
  add("engine", std::string(name_of(from.engine)), std::string(name_of(to.engine)));
  add("precision", std::string(name_of(from.precision)), std::string(name_of(to.precision)));
  add("bodies", compact(bodies_text(from.bodies)), compact(bodies_text(to.bodies)));
  return settings;
}

std::string shortest_number(double v) {
  std::array<char, 40> text{};
  const bool plain = v == 0 || (std::abs(v) >= 1e-5 && std::abs(v) < 1e9);
  const auto end = plain ? std::to_chars(text.data(), text.data() + text.size(), v, std::chars_format::fixed).ptr
                         : std::to_chars(text.data(), text.data() + text.size(), v).ptr;
  std::string number(text.data(), end);
  // 1e+09 and 1e-07 as people write them: 1e9, 1e-7.
  if (const auto e = number.find('e'); e != std::string::npos) {
    if (number[e + 1] == '+') number.erase(e + 1, 1);
    const auto digits = number.find_first_of("0123456789", e);
    if (number[digits] == '0') number.erase(digits, 1);
  }
  return number;
}

namespace {

std::string json_of(const Preset& p, bool hashed) {
  std::string text = "{\n  \"tyglab_preset\": " + std::to_string(preset_version) +
                     ", \"kind\": " + json_text(name_of(p.kind)) + ",\n  \"name\": " + json_text(p.name) +
                     ",\n  \"description\": " + json_text(p.description);
  for (std::string_view section : section_names)
    if (const std::string values = section_text(section, p, hashed); !hashed || !values.ends_with("{}"))
      text += ",\n" + values;
  return text + "\n}\n";
}

}  // namespace

std::string preset_to_json(const Preset& p) {
  return json_of(p, false);
}

std::string preset_hash(const Preset& preset) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : json_of(cleared(preset, appearance), true))
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace tyglab
