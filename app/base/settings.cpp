#include "app/base/settings.h"

#include <algorithm>
#include <concepts>
#include <nlohmann/json.hpp>

#include "core/io/json_tree.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/system_files.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int settings_version = 1;
constexpr std::uintmax_t most_bytes = 16u << 20;

fs::path settings_file() {
  const fs::path folder = config_folder();
  return folder.empty() ? fs::path() : folder / "settings.json";
}

/// An object of the file, which knows how it is called there.
class Section {
 public:
  Section(const JsonNode& node, std::string name) : node_(node), name_(std::move(name)) {
    if (node_.type != JsonNode::Type::object) wrong(node_, name_, "an object {…}");
  }
  /// Throws PresetError unless that key is there.
  void need(const char* key) const {
    if (node_.find(key) == nullptr)
      throw PresetError(":" + std::to_string(node_.line) + ": " + path(key) + " is missing");
  }
  /// Calls read(node, path) for that key, if it is there.
  template <class Read>
  void read(const char* key, const Read& read) const {
    if (const JsonNode* node = node_.find(key)) read(*node, path(key));
  }
  /// Replaces the value by what stands there, if anything does.
  template <class T>
  void take(const char* key, T& value) const {
    read(key, [&](const JsonNode& node, const std::string& path) { convert(node, path, value); });
  }

 private:
  [[noreturn]] static void wrong(const JsonNode& node, const std::string& path, const std::string& expected) {
    throw PresetError(":" + std::to_string(node.line) + ": " + (path.empty() ? "the file" : path) + " must be " +
                      expected + ", not " + std::string(type_name(node.type)));
  }
  static void convert(const JsonNode& node, const std::string& path, bool& value) {
    if (node.type != JsonNode::Type::boolean) wrong(node, path, "true or false");
    value = node.number != 0;
  }
  static void convert(const JsonNode& node, const std::string& path, double& value) {
    if (!node.is_number()) wrong(node, path, "a number");
    value = node.number;
  }
  static void convert(const JsonNode& node, const std::string& path, float& value) {
    double number = 0;
    convert(node, path, number);
    value = float(number);
  }
  static void convert(const JsonNode& node, const std::string& path, int& value) {
    constexpr double most = 1e9;
    double number = 0;
    convert(node, path, number);
    value = int(std::clamp(number, -most, most));
  }
  static void convert(const JsonNode& node, const std::string& path, std::string& value) {
    if (node.type != JsonNode::Type::text) wrong(node, path, "a string");
    value = node.text;
  }
  template <class Strings>
  requires std::same_as<typename Strings::value_type, std::string>
  static void convert(const JsonNode& node, const std::string& path, Strings& value) {
    if (node.type != JsonNode::Type::list) wrong(node, path, "a list of strings");
    value.clear();
    for (const JsonNode& item : node.items) {
      std::string text;
      convert(item, path, text);
      value.insert(value.end(), text);
    }
  }
  static void convert(const JsonNode& node, const std::string& path, std::map<std::string, int>& value) {
    if (node.type != JsonNode::Type::object) wrong(node, path, "an object {…}");
    value.clear();
    for (const auto& [key, child] : node.members) convert(child, path + "." + key, value[key]);
  }
  std::string path(const char* key) const { return name_.empty() ? key : name_ + "." + key; }

  const JsonNode& node_;
  std::string name_;
};

Layout layout_from(const Section& from) {
  Layout layout;
  from.take("left_width", layout.left_width);
  from.take("right_width", layout.right_width);
  from.take("left", layout.left);
  from.take("right", layout.right);
  from.take("status", layout.status);
  from.take("map", layout.map);
  from.take("inside", layout.inside);
  from.take("folded", layout.folded);
  layout.left_width = std::clamp(layout.left_width, 200.f, 900.f);
  layout.right_width = std::clamp(layout.right_width, 200.f, 1200.f);
  return layout;
}

ToolSettings handling_from(const Section& from) {
  ToolSettings handling;
  from.take("cut_along_path", handling.cut_along_path);
  from.take("slow_hand", handling.slow_hand);
  from.take("arrows", handling.arrows);
  return handling;
}

LastSession session_from(const Section& from) {
  LastSession session;
  const auto take = [&](const char* key, Preset& preset) {
    from.read(key, [&](const JsonNode& node, const std::string& path) { preset = preset_from(node, "", {}, path); });
  };
  take("preset", session.preset);
  session.saved = session.preset;
  take("saved", session.saved);
  from.take("label", session.label);
  std::string file;
  from.take("file", file);
  session.file = file;
  return session;
}

Settings settings_from(const JsonNode& root) {
  const Section all(root, "");
  Settings settings;
  const auto section = [&](const char* key, const auto& take) {
    all.read(key, [&](const JsonNode& node, const std::string& path) { take(Section(node, path)); });
  };
  section("window", [&](const Section& window) {
    window.take("x", settings.x), window.take("y", settings.y);
    window.take("width", settings.width), window.take("height", settings.height);
    window.take("maximised", settings.maximised);
    if (settings.width != 0) settings.width = std::clamp(settings.width, 480, 16384);
    if (settings.height != 0) settings.height = std::clamp(settings.height, 320, 16384);
  });
  all.take("ui_scale", settings.ui_scale);
  settings.ui_scale = settings.ui_scale > 0 ? std::clamp(settings.ui_scale, 0.5, 3.0) : 1;
  all.take("theme", settings.theme);
  all.take("plot_log", settings.plot_log);
  all.take("color", settings.color);
  all.take("all_effects", settings.all_effects);
  all.take("tour_seen", settings.tour_seen);
  all.take("cut_told", settings.cut_told);
  all.take("course_page", settings.course_page);
  all.take("recent", settings.recent);
  all.take("labs", settings.labs);
  section("layout", [&](const Section& layout) { settings.layout = layout_from(layout); });
  section("handling", [&](const Section& handling) { settings.handling = handling_from(handling); });
  section("session", [&](const Section& session) {
    session.need("preset");
    settings.session = session_from(session);
  });
  return settings;
}

/// The file as JSON; it may hold two presets. Throws InputError, PresetError.
JsonNode read_tree(const fs::path& file) {
  return parse_json(read_input(file, "settings file", most_bytes), "", Lines::told, 2 * max_json_values);
}

/// Of which version a file is; one that tells none is of the first.
int version_of(const JsonNode& root) {
  const JsonNode* version = root.find("tyglab_settings");
  return version != nullptr && version->is_number() ? int(std::clamp(version->number, 0.0, 1e9)) : 1;
}

/// Moves a file out of the way, under a name that no file has. Returns that; empty where it cannot be moved.
fs::path put_aside(const fs::path& file, const std::string& extension) {
  constexpr int most = 1000;
  std::error_code error;
  for (int n = 1; n <= most; ++n) {
    fs::path aside = file;
    aside += extension + (n == 1 ? "" : "-" + std::to_string(n));
    if (fs::exists(fs::symlink_status(aside, error))) continue;
    fs::rename(file, aside, error);
    return error ? fs::path() : aside;
  }
  return {};
}

/// The same, with what is said of it.
std::string kept_aside(const fs::path& file, const std::string& extension) {
  const fs::path aside = put_aside(file, extension);
  return aside.empty() ? "The file stays as it is, and the settings of this session will not be remembered."
                       : "The old file is kept as " + aside.string() + ".";
}

Json to_json(const Settings& settings) {
  Json json;
  json["tyglab_settings"] = settings_version;
  json["window"] = {{"x", settings.x},
                    {"y", settings.y},
                    {"width", settings.width},
                    {"height", settings.height},
                    {"maximised", settings.maximised}};
  json["ui_scale"] = settings.ui_scale;
  json["theme"] = settings.theme;
  json["plot_log"] = settings.plot_log;
  json["color"] = settings.color;
  json["all_effects"] = settings.all_effects;
  json["tour_seen"] = settings.tour_seen;
  json["cut_told"] = settings.cut_told;
  json["course_page"] = settings.course_page;
  json["recent"] = settings.recent;
  json["labs"] = settings.labs;
  const Layout& layout = settings.layout;
  json["layout"] = {{"left_width", layout.left_width},
                    {"right_width", layout.right_width},
                    {"left", layout.left},
                    {"right", layout.right},
                    {"status", layout.status},
                    {"map", layout.map},
                    {"inside", layout.inside},
                    {"folded", layout.folded}};
  const ToolSettings& handling = settings.handling;
  json["handling"] = {
      {"cut_along_path", handling.cut_along_path}, {"slow_hand", handling.slow_hand}, {"arrows", handling.arrows}};
  if (settings.session)
    json["session"] = {{"label", settings.session->label},
                       {"file", settings.session->file.string()},
                       {"preset", Json::parse(preset_to_json(settings.session->preset))},
                       {"saved", Json::parse(preset_to_json(settings.session->saved))}};
  return json;
}

/// Puts what differs between `known` and `now` into what stands in the file: who changed a value last has it. A session
/// is one value, since its parts belong together.
void put_changes(Json& file, const Json& known, const Json& now) {
  for (const auto& [key, value] : known.items())
    if (!now.contains(key)) file.erase(key);
  for (const auto& [key, value] : now.items()) {
    const bool both = known.contains(key) && file.contains(key);
    if (both && value == known[key]) continue;
    if (both && key != "session" && value.is_object() && known[key].is_object() && file[key].is_object())
      put_changes(file[key], known[key], value);
    else
      file[key] = value;
  }
}

/// What stands in the file now; empty where nothing does. What cannot be read is kept aside, as another program may
/// have left it meanwhile. Throws OutputError where a newer Tyglab wrote it.
Json settings_in(const fs::path& file) {
  std::error_code error;
  if (fs::status(file, error).type() == fs::file_type::not_found) return {};
  try {
    const std::string text = read_input(file, "settings file", most_bytes);
    if (version_of(parse_json(text, "", Lines::told, 2 * max_json_values)) > settings_version)
      throw OutputError(file.string() + ": a newer Tyglab has written it since");
    Json json = Json::parse(text);
    if (json.is_object()) return json;
  } catch (const InputError&) {
  } catch (const PresetError&) {
  }
  if (put_aside(file, ".broken").empty()) throw OutputError(file.string() + ": cannot be read or moved aside");
  return {};
}

/// A problem of a file, where the sentence has named the file already.
std::string without_name(std::string problem, const fs::path& file) {
  const std::string name = file.string() + ": ";
  if (problem.starts_with(name)) problem.erase(0, name.size());
  if (problem.starts_with(":")) problem = "line " + problem.substr(1);
  return problem;
}

}  // namespace

fs::path config_folder() {
  if (const fs::path own = environment("TYGLAB_CONFIG_DIR"); !own.empty()) return own;
  const fs::path base = settings_base();
  return base.empty() ? base : base / "tyglab";
}

fs::path user_preset_folder() {
  const fs::path folder = config_folder();
  return folder.empty() ? fs::path() : folder / "presets";
}

Settings load_settings(std::string& problem) {
  const fs::path file = settings_file();
  std::error_code ignored;
  if (file.empty() || fs::status(file, ignored).type() == fs::file_type::not_found) return {};
  try {
    const JsonNode root = read_tree(file);
    if (const int version = version_of(root); version > settings_version) {
      problem = "The settings in " + file.string() + " were written by a newer Tyglab (version " +
                std::to_string(version) + "; this one reads " + std::to_string(settings_version) +
                "). The defaults are used. " + kept_aside(file, ".version-" + std::to_string(version));
      return {};
    }
    return settings_from(root);
  } catch (const std::exception& error) {
    problem = "The settings in " + file.string() + " cannot be used: " + without_name(error.what(), file) +
              ". The defaults are used. " + kept_aside(file, ".broken");
    return {};
  }
}

void save_settings(const Settings& settings, const Settings& known) {
  const fs::path file = settings_file();
  if (file.empty()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw OutputError(file.parent_path().string() + ": the folder cannot be created: " + error.message());
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))
    throw OutputError(file.string() + ": is not a file, so the settings cannot be written there");
  OutputFile out(file);  // from here on nobody else writes it
  Json all = settings_in(file);
  const Json now = to_json(settings);
  if (all.empty())
    all = now;
  else
    put_changes(all, to_json(known), now);
  out.write(all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  out.end();
}

}  // namespace tyglab
