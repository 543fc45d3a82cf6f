#include "app/sandbox/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/sandbox/app.h"

namespace tyglab {
namespace {

constexpr int control = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;
constexpr int counted = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT | GLFW_MOD_SUPER;

struct Shortcut {
  int key, mods;
  Command command;
  bool repeats = false;
};

constexpr std::array<Shortcut, 29> shortcuts{{
    {GLFW_KEY_SPACE, 0, Command::toggle_play},
    {GLFW_KEY_RIGHT, 0, Command::step, true},
    {GLFW_KEY_O, 0, Command::step, true},
    {GLFW_KEY_LEFT, 0, Command::rewind, true},
    {GLFW_KEY_BACKSPACE, 0, Command::restart},
    {GLFW_KEY_R, 0, Command::restart},
    {GLFW_KEY_F1, 0, Command::toggle_help},
    {GLFW_KEY_TAB, 0, Command::toggle_panels},
    {GLFW_KEY_F, 0, Command::frame_cloth},
    {GLFW_KEY_M, 0, Command::toggle_map},
    {GLFW_KEY_F11, 0, Command::full_screen},
    {GLFW_KEY_S, control, Command::save},
    {GLFW_KEY_S, control | shift, Command::save_as},
    {GLFW_KEY_O, control, Command::open_dialog},
    {GLFW_KEY_Z, control, Command::undo, true},
    {GLFW_KEY_Z, control | shift, Command::redo, true},
    {GLFW_KEY_Y, control, Command::redo, true},
    {GLFW_KEY_Q, control, Command::quit},
    {GLFW_KEY_EQUAL, control, Command::larger_text, true},
    {GLFW_KEY_EQUAL, control | shift, Command::larger_text, true},
    {GLFW_KEY_MINUS, control, Command::smaller_text, true},
    {GLFW_KEY_KP_ADD, control, Command::larger_text, true},
    {GLFW_KEY_KP_SUBTRACT, control, Command::smaller_text, true},
    {GLFW_KEY_0, control, Command::normal_text},
    {GLFW_KEY_KP_0, control, Command::normal_text},
    {GLFW_KEY_RIGHT_BRACKET, control, Command::larger_text, true},  // "+" of Swedish keyboards is elsewhere
    {GLFW_KEY_SLASH, control, Command::smaller_text, true},
    {GLFW_KEY_R, control, Command::reset_constants},
    {GLFW_KEY_R, control | shift, Command::reset_everything},
}};

constexpr std::array slider_keys{GLFW_KEY_LEFT,  GLFW_KEY_RIGHT,    GLFW_KEY_UP,        GLFW_KEY_DOWN,
                                 GLFW_KEY_HOME,  GLFW_KEY_END,      GLFW_KEY_PAGE_DOWN, GLFW_KEY_TAB,
                                 GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER, GLFW_KEY_PAGE_UP,   GLFW_KEY_ESCAPE,
                                 GLFW_KEY_DELETE};

/// "1" to "5", of the digits' row or the keypad.
std::optional<int> digit(const KeyEvent& event) {
  if ((event.mods & counted) != 0) return std::nullopt;
  if (event.key >= GLFW_KEY_1 && event.key <= GLFW_KEY_5) return event.key - GLFW_KEY_0;
  if (event.key >= GLFW_KEY_KP_1 && event.key <= GLFW_KEY_KP_5) return event.key - GLFW_KEY_KP_0;
  return std::nullopt;
}

/// Keys of a text field: only those that end it matter here. True if the field has the key.
bool typing_takes(App& app, const KeyEvent& event) {
  SliderState& slider = app.ui.slider;
  if (slider.typing == 0 && !ImGui::GetIO().WantTextInput) return false;
  if (event.key == GLFW_KEY_Q && (event.mods & counted) == control) {
    slider.cancel = true;  // a number half typed is no change that could be lost
    return false;
  }
  if (slider.typing != 0) {
    slider.commit |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER || event.key == GLFW_KEY_TAB;
    slider.cancel |= event.key == GLFW_KEY_ESCAPE;
  }
  return true;
}

bool dialog_takes(App& app, const KeyEvent& event) {
  if (app.ui.dialog.kind == Dialog::Kind::none) return false;
  if (event.key == GLFW_KEY_ESCAPE) app.ui.dialog.kind = Dialog::Kind::none;
  app.ui.dialog.enter |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  return true;
}

bool slider_takes(App& app, const KeyEvent& event) {
  if (app.ui.slider.focused == 0) return false;
  const bool plain = (event.mods & GLFW_MOD_ALT) == 0;
  if (!plain || std::find(slider_keys.begin(), slider_keys.end(), event.key) == slider_keys.end()) return false;
  app.ui.slider.keys.push_back(event);
  return true;
}

/// The help lies over everything but a dialog.
bool help_takes(App& app, const KeyEvent& event) {
  if (!app.ui.help || event.key != GLFW_KEY_ESCAPE) return false;
  app.ui.help = false;
  return true;
}

bool list_takes(App& app, const KeyEvent& event) {
  if (!app.viewport.blocked || event.key != GLFW_KEY_ESCAPE) return false;
  return app.ui.close_lists = true;
}

void command_for(App& app, const KeyEvent& event) {
  if (const auto mode = digit(event)) {
    Preset next = app.wished();
    next.mode = *mode;
    app.propose(std::move(next));
    return;
  }
  for (const Shortcut& shortcut : shortcuts)
    if (shortcut.key == event.key && shortcut.mods == (event.mods & counted) && (shortcut.repeats || !event.repeat))
      return app.command(shortcut.command);
}

}  // namespace

void handle_keys(App& app) {
  for (const KeyEvent& event : app.input.keys) {
    if (dialog_takes(app, event) || help_takes(app, event) || list_takes(app, event) || typing_takes(app, event) ||
        slider_takes(app, event))
      continue;
    command_for(app, event);
  }
}

}  // namespace tyglab
