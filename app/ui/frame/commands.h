// The commands: one row each, with its name, keys, action and condition. Keys, help, menus and the palette read it; a
// new command is one row in the file of its topic (motion_commands.cpp and the like), and nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/glfw_keys.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// A key with GLFW_MOD_… held; `repeats` while it is held down.
struct Chord {
  int key = 0, mods = 0;
  bool repeats = false;
};

/// What a command writes to a file that a dialog asks for.
struct Export {
  const char* title;  ///< of the dialog
  const char* holds;  ///< a sentence
  const char* file;   ///< proposed
  /// Throws OutputError, GraphicsError.
  void (*write)(Ui& ui, const std::filesystem::path& file);
};

struct CommandRow {
  const char* id;                                  ///< "restart"
  const char* name;                                ///< "Restart the motion"
  const char* keys;                                ///< as people call them, empty where there are none
  std::vector<Chord> chords;                       ///< all that lead to it
  const char* help;                                ///< what they do, in the list of keys; empty: the name says it
  const char* also;                                ///< words under which the palette finds it too
  void (*action)(Ui& ui);                          ///< null where it writes a file
  std::string (*why_not)(const Ui& ui) = nullptr;  ///< a sentence where it cannot be done now; empty or null: it can
  std::optional<Export> writes = {};
  bool (*on)(const Ui& ui) = nullptr;  ///< of what is on or off; null: it is neither
  bool opens_field = false;            ///< what is typed next is for a field that it opens
};

/// Of the keys of rows.
inline constexpr int ctrl = GLFW_MOD_CONTROL, ctrl_shift = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT;

// What many rows do.
template <void (*action)(Session&)>
void of_session(Ui& ui) {
  action(ui.session);
}
template <bool Ui::*flag>
void toggle(Ui& ui) {
  ui.*flag = !(ui.*flag);
}

/// Commands that belong together: a submenu, a table of the list of keys.
struct CommandTopic {
  const char* name;
  std::vector<CommandRow> rows;
};
/// All of them, in the order of menu, palette and help.
std::span<const CommandTopic> command_topics();

// The rows of each topic.
std::vector<CommandRow> file_rows();
std::vector<CommandRow> export_rows();  ///< those that write a file
std::vector<CommandRow> edit_rows();
std::vector<CommandRow> motion_rows();
std::vector<CommandRow> cloth_rows();
std::vector<CommandRow> card_rows();
std::vector<CommandRow> view_rows();
std::vector<CommandRow> help_rows();

/// Throws std::logic_error where there is no such command.
const CommandRow& row_of(std::string_view id);
/// Why it cannot be done now, a sentence; empty: it can.
std::string why_not(const Ui& ui, const CommandRow& row);

}  // namespace tyglab
