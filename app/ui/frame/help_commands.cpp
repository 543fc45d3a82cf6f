// Commands for help and labs.
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"

namespace tyglab {
namespace {

std::string palette_is_open(const Ui& ui) {
  return ui.palette.open ? "The command palette is open." : "";
}

void find_command(Ui& ui) {
  open_palette(ui);
}

void open_start_page(Ui& ui) {
  open_dialog(ui, Dialog::Kind::start);
}

void choose_lab(Ui& ui) {
  open_palette(ui, true);
}

/// After the last lab the list shows what is left.
void go_on_to_next_lab(Ui& ui) {
  if (next_lab(ui.session)) return;
  leave_lab(ui.session);
  choose_lab(ui);
}

std::string no_lab(const Ui& ui) {
  return ui.session.labs.run ? "" : "There is no lab in progress.";
}

std::string no_experiment(const Ui& ui) {
  return ui.session.labs.kept.empty() ? "No experiment was changed before a lab." : "";
}

}  // namespace

std::vector<CommandRow> help_rows() {
  return {{"open_palette",
           "Find a command…",
           "Ctrl+P",
           {{GLFW_KEY_P, ctrl}},
           "finds commands, presets, labs and constants",
           "",
           find_command,
           palette_is_open,
           {},
           nullptr,
           true},
          {"toggle_help",
           "Mouse and keys",
           "F1",
           {{GLFW_KEY_F1, 0}},
           "this help",
           "help shortcuts",
           toggle<&Ui::help>,
           nullptr,
           {},
           [](const Ui& ui) { return ui.help; }},
          {"start_page", "Start page", "", {}, "", "scenes labs recent welcome home", open_start_page},
          {"start_tour", "Take the tour", "", {}, "", "help introduction welcome", start_tour},
          {"choose_lab",
           "Labs…",
           "Ctrl+L",
           {{GLFW_KEY_L, ctrl}},
           "chooses a lab",
           "lessons exercises course",
           choose_lab,
           nullptr,
           {},
           nullptr,
           true},
          {"next_lab", "Next lab", "", {}, "", "lesson following go on", go_on_to_next_lab, no_lab},
          {"leave_lab", "Leave the lab", "", {}, "", "quit end", of_session<leave_lab>, no_lab},
          {"back_to_experiment",
           "Back to your experiment",
           "",
           {},
           "",
           "lab before unsaved return",
           of_session<back_to_experiment>,
           no_experiment}};
}

}  // namespace tyglab
