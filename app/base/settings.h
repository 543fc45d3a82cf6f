// Everything remembered between sessions: window, layout, text size, the last preset.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct Layout {
  float left_width = 320, right_width = 344;  ///< at scale 1
  bool left = true, right = true, status = true;
  bool inside = false;  ///< the picked particle's step, written out, stands among the plots
  bool map = false;     ///< the map of stiffness against dt stands among the plots
  std::set<std::string> folded{"Start",  "Fabric", "Stability",  "Accuracy",
                               "Copies", "Energy", "Performance"};  ///< sections that are closed
  bool operator==(const Layout&) const = default;
};

/// Settings of the pointer's tools.
struct ToolSettings {
  bool cut_along_path = false;  ///< a cut takes what the pointer's path crosses; otherwise springs upward (2.3.4)
  bool slow_hand = false;       ///< slow motion while the hand is in the cloth
  std::set<std::string> arrows{"F_s", "F_b", "F_d", "F_g"};  ///< variables drawn at the picked particle
  bool operator==(const ToolSettings&) const = default;
};

/// The preset of the last session, including unsaved changes.
struct LastSession {
  Preset preset;
  Preset saved;  ///< as it was opened or saved; a user's file is read again
  std::string label;
  std::filesystem::path file;  ///< the user's file, empty for a shipped preset
  bool operator==(const LastSession&) const = default;
};

struct Settings {
  int x = -1, y = -1, width = 0, height = 0;  ///< of the window; x < 0, width 0: let the system choose
  bool maximised = false;
  double ui_scale = 1;
  std::string theme = "dark";  ///< a Look's name
  Layout layout;
  ToolSettings handling;
  bool plot_log = false;
  bool all_effects = false;         ///< however slow they are to draw
  std::string color;                ///< name of the field that colors the cloth; empty: none
  bool tour_seen = false;           ///< or the start page, which leads to it
  bool cut_told = false;            ///< what the first cut says beside the pointer
  std::string course_page;          ///< address of the page that copied links begin with; empty: none
  std::vector<std::string> recent;  ///< files of presets that were opened or saved, the newest first
  std::map<std::string, int> labs;  ///< by its name: how many of a lab's steps are done
  std::optional<LastSession> session;
  bool operator==(const Settings&) const = default;
};

/// Folder of settings and the user's presets: $TYGLAB_CONFIG_DIR, or "tyglab" in settings_base(); empty where neither
/// is known.
std::filesystem::path config_folder();
std::filesystem::path user_preset_folder();

/// The settings, or the defaults and in `problem` a few sentences when the file is there but unusable. It is then
/// renamed to settings.json.broken, or settings.json.version-2 where a newer program wrote it, so that nothing of it is
/// lost.
Settings load_settings(std::string& problem);
/// Writes the values that differ from `known`, the values that this program read or wrote last, so that several windows
/// keep each other's changes: the latest change of a value counts. Throws OutputError.
void save_settings(const Settings& settings, const Settings& known);

// The running program, as the system identifies it.

/// Its file. Throws std::filesystem::filesystem_error where the system does not say.
std::filesystem::path program_file();
/// The path that starts this program again, even if its file has been replaced since.
std::string this_program_again();
/// The folder of the data files of a program that lies in `folder`.
std::filesystem::path data_folder_beside(const std::filesystem::path& folder);
/// Its run time, s.
double program_age_s();

}  // namespace tyglab
