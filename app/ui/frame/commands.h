// The commands: one row each, with its name and its keys. Keys, help, menus and the palette read it.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "app/session/requests.h"

namespace tyglab {

/// A key with GLFW_MOD_… held; `repeats` while it is held down.
struct Chord {
  int key = 0, mods = 0;
  bool repeats = false;
};

struct CommandRow {
  Command command;
  const char* name;           ///< "Restart the motion"
  const char* keys;           ///< as people call them, empty where there are none
  std::vector<Chord> chords;  ///< all that lead to it
  const char* help;           ///< what they do, in the list of keys; empty: the name says it
  const char* also = "";      ///< words under which the palette finds it too
};

std::span<const CommandRow> command_rows();
const CommandRow& row_of(Command command);

}  // namespace tyglab
