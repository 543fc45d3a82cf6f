// Commands for undo and redo.
#include "app/session/document.h"
#include "app/session/motion.h"
#include "app/ui/frame/commands.h"
#include "core/model/effect.h"

namespace tyglab {
namespace {

std::string nothing_to_undo(const Ui& ui) {
  return ui.session.history.can_undo() ? "" : "There is nothing to undo.";
}

std::string nothing_to_redo(const Ui& ui) {
  return ui.session.history.can_redo() ? "" : "There is nothing to redo.";
}

void undo(Ui& ui) {
  take_from_history(ui.session, true);
}

void redo(Ui& ui) {
  take_from_history(ui.session, false);
}

void undo_and_restart(Ui& ui) {
  take_from_history(ui.session, true);
  restart(ui.session);
}

std::string nothing_changed(const Ui& ui) {
  // In a lab, and after it, there is something to reset though no work could be lost.
  const bool differ = !changes(ui.session.document.saved, ui.session.requested_preset()).within(Effect::view);
  return differ ? "" : "The constants already match the preset.";
}

void reset_constants(Ui& ui) {
  take_back(ui.session, ui.session.document.saved);
}

void reset_all(Ui& ui) {
  reset_everything(ui.session);
  ui.scene.wants_framing = true;
}

}  // namespace

std::vector<CommandRow> edit_rows() {
  return {{"undo", "Undo", "Ctrl+Z", {{GLFW_KEY_Z, ctrl, true}}, "undoes the last action", "", undo, nothing_to_undo},
          {"redo",
           "Redo",
           "Ctrl+Shift+Z",
           {{GLFW_KEY_Z, ctrl_shift, true}, {GLFW_KEY_Y, ctrl, true}},
           "redoes it",
           "",
           redo,
           nothing_to_redo},
          {"undo_and_restart", "Undo and restart", "", {}, "", "", undo_and_restart, nothing_to_undo},
          {"reset_constants",
           "Reset all constants to the preset",
           "Ctrl+R",
           {{GLFW_KEY_R, ctrl}},
           "constants back to the preset",
           "",
           reset_constants,
           nothing_changed},
          {"reset_everything",
           "Reset everything",
           "Ctrl+Shift+R",
           {{GLFW_KEY_R, ctrl_shift}},
           "everything back to the preset",
           "",
           reset_all}};
}

}  // namespace tyglab
