#include "app/base/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/io/files.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int settings_version = 1;

fs::path settings_file() {
  const fs::path folder = config_folder();
  return folder.empty() ? fs::path() : folder / "settings.json";
}

/// A sentence about what is wrong with the file, in plain words.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An object of the file, which knows how it is called there.
class Section {
 public:
  Section(const Json& json, std::string name) : json_(json), name_(std::move(name)) {
    if (!json_.is_object()) throw Fault((name_.empty() ? "the file" : "“" + name_ + "”") + " is not an object { … }");
  }
  bool has(const char* key) const { return json_.contains(key); }
  const Json& at(const char* key) const {
    if (!has(key)) throw Fault("“" + path(key) + "” is missing");
    return json_.at(key);
  }
  Section section(const char* key) const { return {at(key), path(key)}; }
  /// Replaces the value by what stands there, if anything does.
  template <class T>
  void take(const char* key, T& value) const {
    if (!has(key)) return;
    try {
      value = json_.at(key).get<T>();
    } catch (const Json::exception&) {
      throw Fault("“" + path(key) + "” has a value of the wrong type");
    }
  }

 private:
  std::string path(const char* key) const { return name_.empty() ? key : name_ + "." + key; }
  const Json& json_;
  std::string name_;
};

Json parsed(const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(end), '\n');
    throw Fault("it is not JSON at line " + std::to_string(line));
  }
}

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
  session.preset = parse_preset(from.at("preset").dump(), "the last session's preset");
  session.saved = session.preset;
  if (from.has("saved")) session.saved = parse_preset(from.at("saved").dump(), "the last session's saved preset");
  from.take("label", session.label);
  std::string file;
  from.take("file", file);
  session.file = file;
  return session;
}

Settings settings_from(const Json& json) {
  const Section all(json, "");
  Settings settings;
  if (all.has("window")) {
    const Section window = all.section("window");
    window.take("x", settings.x), window.take("y", settings.y);
    window.take("width", settings.width), window.take("height", settings.height);
    window.take("maximised", settings.maximised);
    settings.width = std::clamp(settings.width, 480, 16384);
    settings.height = std::clamp(settings.height, 320, 16384);
  }
  all.take("ui_scale", settings.ui_scale);
  settings.ui_scale = settings.ui_scale > 0 ? std::clamp(settings.ui_scale, 0.5, 3.0) : 1;
  all.take("theme", settings.theme);
  all.take("plot_log", settings.plot_log);
  all.take("color", settings.color);
  all.take("all_effects", settings.all_effects);
  all.take("tour_seen", settings.tour_seen);
  all.take("labs", settings.labs);
  if (all.has("layout")) settings.layout = layout_from(all.section("layout"));
  if (all.has("handling")) settings.handling = handling_from(all.section("handling"));
  if (all.has("session")) settings.session = session_from(all.section("session"));
  return settings;
}

/// Moves a file that is unusable out of the way; says where to, or what became of it.
std::string put_aside(const fs::path& file) {
  fs::path aside = file;
  aside += ".broken";
  std::error_code error;
  fs::rename(file, aside, error);
  if (error) return "It will be overwritten when the window closes; copy it if you need it.";
  return "The old file is kept as " + aside.string() + ".";
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

}  // namespace

fs::path config_folder() {
  const auto variable = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value != nullptr ? fs::path(value) : fs::path();
  };
  if (const fs::path own = variable("TYGLAB_CONFIG_DIR"); !own.empty()) return own;
  if (const fs::path xdg = variable("XDG_CONFIG_HOME"); xdg.is_absolute()) return xdg / "tyglab";
  if (const fs::path home = variable("HOME"); !home.empty()) return home / ".config" / "tyglab";
  return {};
}

fs::path user_preset_folder() {
  const fs::path folder = config_folder();
  return folder.empty() ? fs::path() : folder / "presets";
}

Settings load_settings(std::string& problem) {
  const fs::path file = settings_file();
  std::error_code ignored;
  if (file.empty() || !fs::exists(file, ignored)) return {};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  try {
    if (!in) throw Fault("it cannot be opened");
    return settings_from(parsed(text.str()));
  } catch (const std::exception& error) {
    problem = "The settings in " + file.string() + " cannot be used: " + error.what() + ". The defaults are used. " +
              put_aside(file);
    return {};
  }
}

void save_settings(const Settings& settings) {
  const fs::path file = settings_file();
  if (file.empty()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw OutputError(file.parent_path().string() + ": the folder cannot be created: " + error.message());
  write_atomically(file, to_json(settings).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace tyglab
