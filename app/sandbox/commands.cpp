#include "app/sandbox/commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace tyglab {
namespace {

constexpr int control = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;

}  // namespace

std::span<const CommandRow> command_rows() {
  static const std::array<CommandRow, 38> rows{{
      {Command::toggle_play, "Run or pause", "Space", {{GLFW_KEY_SPACE, 0}}, "pauses and runs", "play stop"},
      {Command::step,
       "One step of dt",
       "→ or O",
       {{GLFW_KEY_RIGHT, 0, true}, {GLFW_KEY_O, 0, true}},
       "makes one step of dt",
       "single"},
      {Command::rewind, "Rewind a second", "←", {{GLFW_KEY_LEFT, 0, true}}, "goes a second back", "back"},
      {Command::restart,
       "Restart the motion",
       "R or Backspace",
       {{GLFW_KEY_R, 0}, {GLFW_KEY_BACKSPACE, 0}},
       "restarts the motion, keeps the constants",
       "begin again"},
      {Command::frame_cloth, "Frame the cloth", "F", {{GLFW_KEY_F, 0}}, "frames the cloth", "camera zoom view"},
      {Command::open_palette,
       "Find a command…",
       "Ctrl+P",
       {{GLFW_KEY_P, control}},
       "finds commands, presets, labs and constants"},
      {Command::toggle_help, "Mouse and keys", "F1", {{GLFW_KEY_F1, 0}}, "this help", "help shortcuts"},
      {Command::start_tour, "Take the tour", "", {}, "", "help introduction welcome"},
      {Command::choose_lab, "Labs…", "Ctrl+L", {{GLFW_KEY_L, control}}, "chooses a lab", "lessons exercises course"},
      {Command::leave_lab, "Leave the lab", "", {}, "", "quit end"},
      {Command::toggle_panels, "All panels", "Tab", {{GLFW_KEY_TAB, 0}}, "hides the panels", "show"},
      {Command::toggle_map,
       "Map of k_s and dt",
       "M",
       {{GLFW_KEY_M, 0}},
       "maps which k_s and dt are stable",
       "stability card"},
      {Command::toggle_inside,
       "Inside a step",
       "I",
       {{GLFW_KEY_I, 0}},
       "looks inside a step of the picked particle",
       "formula springs particle"},
      {Command::next_color,
       "Next colouring of the cloth",
       "C",
       {{GLFW_KEY_C, 0}},
       "colours the cloth by tension, strain, speed, …",
       "colors heat map"},
      {Command::measure_convergence, "Order of convergence", "", {}, "", "accuracy error dt slope measured"},
      {Command::full_screen, "Full screen", "F11", {{GLFW_KEY_F11, 0}}, "full screen", "window"},
      {Command::open_dialog, "Open…", "Ctrl+O", {{GLFW_KEY_O, control}}, "opens a preset", "file load"},
      {Command::save, "Save", "Ctrl+S", {{GLFW_KEY_S, control}}, "saves it", "file write"},
      {Command::save_as,
       "Save as…",
       "Ctrl+Shift+S",
       {{GLFW_KEY_S, control | shift}},
       "saves it under another name",
       "file write"},
      {Command::undo, "Undo", "Ctrl+Z", {{GLFW_KEY_Z, control, true}}, "takes back a change of constants"},
      {Command::redo,
       "Redo",
       "Ctrl+Shift+Z",
       {{GLFW_KEY_Z, control | shift, true}, {GLFW_KEY_Y, control, true}},
       "makes it again"},
      {Command::undo_and_restart, "Undo and restart", "", {}, ""},
      {Command::reset_constants,
       "Reset all constants to the preset",
       "Ctrl+R",
       {{GLFW_KEY_R, control}},
       "constants back to the preset"},
      {Command::reset_everything,
       "Reset everything",
       "Ctrl+Shift+R",
       {{GLFW_KEY_R, control | shift}},
       "everything back to the preset"},
      {Command::toggle_auto, "dt chosen by the program", "", {}, "", "automatic time step"},
      {Command::choose_engine, "Engine chosen by the program", "", {}, "", "automatic opencl cpu fastest"},
      {Command::load_texture_dialog, "Take a picture as texture…", "", {}, "", "image cloth"},
      {Command::export_forces, "Write the forces as CSV…", "", {}, "", "export plot series"},
      {Command::export_height, "Write the height of the weight as CSV…", "", {}, "", "export plot series"},
      {Command::export_map, "Write the map as CSV…", "", {}, "", "export stability"},
      {Command::export_copies, "Write the copies' distances as CSV…", "", {}, "", "export lockstep"},
      {Command::export_values,
       "Write every particle's values as CSV…",
       "",
       {},
       "",
       "export tension strain speed energy"},
      {Command::export_convergence, "Write the convergence as CSV…", "", {}, "", "export accuracy order"},
      {Command::larger_text,
       "Larger text",
       "Ctrl++",
       // "+" of Swedish keyboards is elsewhere.
       {{GLFW_KEY_EQUAL, control, true},
        {GLFW_KEY_EQUAL, control | shift, true},
        {GLFW_KEY_KP_ADD, control, true},
        {GLFW_KEY_RIGHT_BRACKET, control, true}},
       "larger text",
       "scale size"},
      {Command::smaller_text,
       "Smaller text",
       "Ctrl+-",
       {{GLFW_KEY_MINUS, control, true}, {GLFW_KEY_KP_SUBTRACT, control, true}, {GLFW_KEY_SLASH, control, true}},
       "smaller text",
       "scale size"},
      {Command::normal_text,
       "Normal text",
       "Ctrl+0",
       {{GLFW_KEY_0, control}, {GLFW_KEY_KP_0, control}},
       "normal text",
       "scale size"},
      {Command::next_theme,
       "Next theme: dark, light, projector",
       "Ctrl+T",
       {{GLFW_KEY_T, control}},
       "dark, light or projector theme",
       "colours look contrast"},
      {Command::quit, "Quit", "Ctrl+Q", {{GLFW_KEY_Q, control}}, "quits", "end close exit"},
  }};
  return rows;
}

const CommandRow& row_of(Command command) {
  const auto rows = command_rows();
  return *std::find_if(rows.begin(), rows.end(), [&](const CommandRow& row) { return row.command == command; });
}

}  // namespace tyglab
