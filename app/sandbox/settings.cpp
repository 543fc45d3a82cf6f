#include "app/sandbox/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/notation/preset_io.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int settings_version = 1;

fs::path settings_file() {
  const fs::path folder = config_folder();
  return folder.empty() ? fs::path() : folder / "settings.json";
}

template <class T>
void take(const Json& from, const char* key, T& value) {
  if (from.contains(key)) value = from.at(key).get<T>();
}

Layout layout_from(const Json& json) {
  Layout layout;
  take(json, "left_width", layout.left_width);
  take(json, "right_width", layout.right_width);
  take(json, "left", layout.left);
  take(json, "right", layout.right);
  take(json, "status", layout.status);
  if (json.contains("folded")) layout.folded = json.at("folded").get<std::set<std::string>>();
  layout.left_width = std::clamp(layout.left_width, 200.f, 900.f);
  layout.right_width = std::clamp(layout.right_width, 200.f, 1200.f);
  return layout;
}

Settings settings_from(const Json& json) {
  Settings settings;
  if (json.contains("window")) {
    const Json& window = json.at("window");
    take(window, "x", settings.x), take(window, "y", settings.y);
    take(window, "width", settings.width), take(window, "height", settings.height);
    take(window, "maximised", settings.maximised);
    settings.width = std::clamp(settings.width, 480, 16384);
    settings.height = std::clamp(settings.height, 320, 16384);
  }
  take(json, "ui_scale", settings.ui_scale);
  settings.ui_scale = settings.ui_scale > 0 ? std::clamp(settings.ui_scale, 0.5, 3.0) : 1;
  take(json, "plot_log", settings.plot_log);
  if (json.contains("layout")) settings.layout = layout_from(json.at("layout"));
  if (json.contains("session")) {
    const Json& from = json.at("session");
    Session session;
    session.preset = parse_preset(from.at("preset").dump(), "the last session's preset");
    session.saved = session.preset;
    if (from.contains("saved"))
      session.saved = parse_preset(from.at("saved").dump(), "the last session's saved preset");
    take(from, "label", session.label);
    session.file = from.value("file", std::string());
    settings.session = std::move(session);
  }
  return settings;
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
  json["plot_log"] = settings.plot_log;
  const Layout& layout = settings.layout;
  json["layout"] = {{"left_width", layout.left_width}, {"right_width", layout.right_width}, {"left", layout.left},
                    {"right", layout.right},           {"status", layout.status},           {"folded", layout.folded}};
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
    return settings_from(Json::parse(text.str()));
  } catch (const std::exception& error) {
    problem = "The settings in " + file.string() + " could not be read (" + error.what() +
              "). The defaults are used, and the file is replaced when the window closes.";
    return {};
  }
}

void save_settings(const Settings& settings) {
  const fs::path file = settings_file();
  if (file.empty()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw OutputError("The folder " + file.parent_path().string() + " could not be made: " + error.message());
  write_atomically(file, to_json(settings).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace tyglab
