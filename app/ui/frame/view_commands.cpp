// Commands for the window: panels, text, theme.
#include <algorithm>

#include "app/session/lab_state.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/commands.h"

namespace tyglab {
namespace {

template <bool Layout::*there>
void toggle_part(Ui& ui) {
  ui.settings.layout.*there = !(ui.settings.layout.*there);
}

/// All effects however long they take, or as many as the machine draws in time.
void toggle_effects(Ui& ui) {
  Effects& effects = ui.scene.effects;
  const bool all = effects.mode != Effects::Mode::all;
  effects.mode = all ? Effects::Mode::all : Effects::Mode::automatic;
  ui.settings.all_effects = all;
}

void toggle_panels(Ui& ui) {
  ui.panels = !ui.panels, ui.panels_hidden = !ui.panels;
}

void toggle_full_screen(Ui& ui) {
  ui.toggle_full_screen = true;
}

void scale_text(Ui& ui, double scale) {
  ui.settings.ui_scale = std::clamp(scale, 0.5, 3.0);
  ui.scale_changed = true;
}

void larger_text(Ui& ui) {
  scale_text(ui, ui.settings.ui_scale * 1.1);
}

void smaller_text(Ui& ui) {
  scale_text(ui, ui.settings.ui_scale / 1.1);
}

void normal_text(Ui& ui) {
  scale_text(ui, 1);
}

/// Dark, light, projector, and again.
void next_theme(Ui& ui) {
  const auto all = looks();
  const auto now = std::size_t(&look(ui.settings.theme) - all.data());
  ui.settings.theme = all[(now + 1) % all.size()].name;
  ui.scale_changed = ui.scene.redraw = true;
}

void present(Ui& ui) {
  ui.presenting = !ui.presenting;
  ui.panels = ui.scale_changed = ui.scene.redraw = true;
  constexpr const char* way_back = "F5 or Esc brings the panels back; Ctrl+T changes the theme.";
  ui.presenting ? ui.messages.note(way_back) : ui.messages.take_back(way_back);
  if (ui.presenting && ui.session.labs.run) show_for_lab(ui, ui.session.labs.run->shown());
}

}  // namespace

std::vector<CommandRow> view_rows() {
  return {{"present",
           "Presentation mode",
           "F5",
           {{GLFW_KEY_F5, 0}},
           "presents: a large cloth, few controls",
           "projector lecture beamer talk",
           present,
           nullptr,
           {},
           [](const Ui& ui) { return ui.presenting; }},
          {"full_screen",
           "Full screen",
           "F11",
           {{GLFW_KEY_F11, 0}},
           "full screen",
           "window",
           toggle_full_screen,
           nullptr,
           {},
           [](const Ui& ui) { return ui.full_screen; }},
          {"toggle_panels",
           "All panels",
           "Tab",
           {{GLFW_KEY_TAB, 0}},
           "hides the panels",
           "show",
           toggle_panels,
           nullptr,
           {},
           [](const Ui& ui) { return ui.panels; }},
          {"toggle_constants",
           "Constants",
           "",
           {},
           "",
           "panel column left hide show",
           toggle_part<&Layout::left>,
           nullptr,
           {},
           [](const Ui& ui) { return ui.settings.layout.left; }},
          {"toggle_plots",
           "Plots",
           "",
           {},
           "",
           "panel column right cards hide show",
           toggle_part<&Layout::right>,
           nullptr,
           {},
           [](const Ui& ui) { return ui.settings.layout.right; }},
          {"toggle_hints",
           "Hints",
           "",
           {},
           "",
           "status bar below hide show",
           toggle_part<&Layout::status>,
           nullptr,
           {},
           [](const Ui& ui) { return ui.settings.layout.status; }},
          {"larger_text",
           "Larger text",
           "Ctrl++",  // "+" of Swedish keyboards is elsewhere.
           {{GLFW_KEY_EQUAL, ctrl, true},
            {GLFW_KEY_EQUAL, ctrl_shift, true},
            {GLFW_KEY_KP_ADD, ctrl, true},
            {GLFW_KEY_RIGHT_BRACKET, ctrl, true}},
           "larger text",
           "scale size",
           larger_text},
          {"smaller_text",
           "Smaller text",
           "Ctrl+-",
           {{GLFW_KEY_MINUS, ctrl, true}, {GLFW_KEY_KP_SUBTRACT, ctrl, true}, {GLFW_KEY_SLASH, ctrl, true}},
           "smaller text",
           "scale size",
           smaller_text},
          {"normal_text",
           "Normal text",
           "Ctrl+0",
           {{GLFW_KEY_0, ctrl}, {GLFW_KEY_KP_0, ctrl}},
           "normal text",
           "scale size",
           normal_text},
          {"next_theme",
           "Next theme: dark, light, projector",
           "Ctrl+T",
           {{GLFW_KEY_T, ctrl}},
           "dark, light or projector theme",
           "colors look contrast",
           next_theme},
          {"toggle_effects",
           "Full quality (may be slow)",
           "",
           {},
           "",
           "all effects shadows smooth edges graphics",
           toggle_effects,
           nullptr,
           {},
           [](const Ui& ui) { return ui.settings.all_effects; }}};
}

}  // namespace tyglab
