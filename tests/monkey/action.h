// What the monkey does, an action a line: controls by their names and places by parts of what they lie in, so that a
// recording survives another layout. tests/monkey/window reads the same lines.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab::monkey {

enum class Verb {
  click,         ///< NAME [right|middle|double]
  drag,          ///< NAME FROM TO: parts of the control's width
  wheel,         ///< NAME TICKS, upwards
  value,         ///< NAME TEXT: typed after Ctrl+click, ended by Enter
  fill,          ///< NAME TEXT: replaces that of a field
  key,           ///< CHORD as xdotool calls it: "ctrl+shift+z"
  type,          ///< TEXT
  find,          ///< TEXT: typed into the palette, ended by Enter
  grab,          ///< ROW COLUMN DX DY: the hand pulls a particle (quarters of the cloth) by parts of the viewport
  cut,           ///< ROW COLUMN ROW COLUMN: the knife goes from one particle to another
  pin,           ///< ROW COLUMN: right double-click
  pick,          ///< ROW COLUMN: right click
  stroke,        ///< X Y X Y [left|middle|right] [ctrl|shift]: a drag between two places in the viewport
  zoom,          ///< TICKS
  resize,        ///< WIDTH HEIGHT
  drop,          ///< FILE of the corpus, dropped on the window
  open,          ///< FILE of the corpus or one that was saved, through the dialog
  save,          ///< FILE: through the dialog, replacing what is there
  undo_redo,     ///< and the constants are as before
  wait,          ///< FRAMES
  quit_restart,  ///< the session ends, and the next one takes up what was remembered
};

std::string_view name_of(Verb verb);

struct Action {
  Verb verb = Verb::wait;
  std::vector<std::string> words;

  /// Throws std::runtime_error where there is no such word, or where it is no number.
  double number(std::size_t n) const;
  const std::string& word(std::size_t n) const;
  std::string line() const;
};

/// Throws std::runtime_error which names the line.
Action parse_action(std::string_view line);
/// Empty lines and those that begin with # are passed over.
std::vector<Action> read_recording(const std::filesystem::path& file);
void write_recording(const std::filesystem::path& file, const std::vector<Action>& actions, const std::string& why);

/// A key with its modifiers (GLFW's numbers); none where there is no such key.
struct Key {
  int key = 0, mods = 0;
};
std::optional<Key> key_called(std::string_view chord);
/// The chord's name; empty where it has none.
std::string name_of(Key key);
/// All keys that have a name, without modifiers.
std::vector<std::string> key_names();

}  // namespace tyglab::monkey
