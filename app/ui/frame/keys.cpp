#include "app/ui/frame/frame.h"

#include "app/base/glfw_keys.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/commands.h"
#include "app/ui/kit/imgui_compat.h"

namespace tyglab {
namespace {

constexpr int counted = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT | GLFW_MOD_SUPER;

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

/// Enter in the field of a lab's prediction gives it.
void lab_field_takes(Ui& ui, const KeyEvent& event) {
  ui.lab_field.enter |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
}

/// Keys of a text field: only those that end it matter here. True if the field has the key.
bool typing_takes(Ui& ui, const KeyEvent& event) {
  SliderState& slider = ui.slider;
  if (slider.typing == 0 && !gui::typing_text() && !ui.lab_field.again) return false;
  if (event.key == GLFW_KEY_Q && (event.mods & counted) == GLFW_MOD_CONTROL) {
    slider.cancel = true;  // a number half typed is no change that could be lost
    return false;
  }
  if (slider.typing != 0) {
    slider.commit |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER || event.key == GLFW_KEY_TAB;
    slider.cancel |= event.key == GLFW_KEY_ESCAPE;
  } else {
    lab_field_takes(ui, event);
  }
  return true;
}

/// A film goes on under all else, so it ends first.
bool film_takes(Ui& ui, const KeyEvent& event) {
  if (!ui.film || event.key != GLFW_KEY_ESCAPE) return false;
  ui.command("export_film");
  return true;
}

bool dialog_takes(Ui& ui, const KeyEvent& event) {
  if (ui.dialog.kind == Dialog::Kind::none) return false;
  if (event.key == GLFW_KEY_ESCAPE) ui.dialog.kind = Dialog::Kind::none;
  ui.dialog.enter |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  ui.gallery.go += (event.key == GLFW_KEY_DOWN ? 1 : 0) - (event.key == GLFW_KEY_UP ? 1 : 0);
  return true;
}

/// What rows and columns that were typed mean is answered by a key too.
bool resolution_takes(Ui& ui, const KeyEvent& event) {
  if (!resolution_question(ui) || (event.mods & counted & ~GLFW_MOD_SHIFT) != 0) return false;
  const bool enter = event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  if (enter) answer_resolution(ui, (event.mods & GLFW_MOD_SHIFT) == 0);
  if (event.key == GLFW_KEY_ESCAPE) ui.asked_lattice.reset();
  return enter || event.key == GLFW_KEY_ESCAPE;
}

bool slider_takes(Ui& ui, const KeyEvent& event) {
  if (ui.slider.focused == 0) return false;
  const bool plain = (event.mods & GLFW_MOD_ALT) == 0;
  if (!plain || std::find(slider_keys.begin(), slider_keys.end(), event.key) == slider_keys.end()) return false;
  ui.slider.keys.push_back(event);
  return true;
}

bool is_letter(int key) {
  return key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
}

/// What a number may begin with.
bool begins_number(int key) {
  constexpr std::array signs{GLFW_KEY_PERIOD, GLFW_KEY_COMMA, GLFW_KEY_MINUS, GLFW_KEY_KP_DECIMAL,
                             GLFW_KEY_KP_SUBTRACT};
  return (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) || (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) ||
         std::find(signs.begin(), signs.end(), key) != signs.end();
}

/// While a lab's question is shown and waits, a number that is typed is its answer, and letters lead to no command: who
/// types an answer without a click on its field would change the scene.
bool question_takes(Ui& ui, const KeyEvent& event) {
  const bool number = begins_number(event.key);
  if (!ui.lab_field.waits || (event.mods & counted & ~GLFW_MOD_SHIFT) != 0 || !(number || is_letter(event.key)))
    return false;
  if (number && ui.lab_field.shown) {
    ui.lab_field.again = ui.input.field_opens = true;
    return true;
  }
  ui.messages.note("The lab waits for your prediction. Until it is made, letters and digits are no shortcuts.");
  return true;
}

/// The palette takes what moves in its list and what ends it; letters go to its text field.
bool palette_takes(Ui& ui, const KeyEvent& event) {
  CommandPalette& palette = ui.palette;
  if (!palette.open) return false;
  if (palette.enter) {
    ui.later_keys.push_back(event);
    return true;
  }
  if (event.key == GLFW_KEY_ESCAPE || (event.key == GLFW_KEY_P && event.mods == GLFW_MOD_CONTROL)) palette.open = false;
  palette.go += (event.key == GLFW_KEY_DOWN ? 1 : 0) - (event.key == GLFW_KEY_UP ? 1 : 0);
  palette.enter |= event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  return true;
}

/// Of the tour's keys only those that lead through it; the others do what they always do.
bool tour_takes(Ui& ui, const KeyEvent& event) {
  Tour& tour = ui.tour;
  if (tour.card < 0 || (event.mods & counted) != 0) return false;
  const bool next = event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  const bool leave = event.key == GLFW_KEY_ESCAPE;
  tour.next |= next, tour.leave |= leave;
  return next || leave;
}

/// The help lies over everything but a dialog.
bool help_takes(Ui& ui, const KeyEvent& event) {
  if (!ui.help || event.key != GLFW_KEY_ESCAPE) return false;
  ui.help = false;
  return true;
}

/// Arrow keys and Enter choose in the list of methods.
bool methods_take(Ui& ui, const KeyEvent& event) {
  const bool enter = event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER;
  const int go = (event.key == GLFW_KEY_DOWN ? 1 : 0) - (event.key == GLFW_KEY_UP ? 1 : 0);
  if (!ui.methods.open || (!enter && go == 0)) return false;
  ui.methods.enter |= enter, ui.methods.go += go;
  return true;
}

bool list_takes(Ui& ui, const KeyEvent& event) {
  if (!ui.viewport.blocked || event.key != GLFW_KEY_ESCAPE) return false;
  return ui.close_lists = true;
}

bool copy_details_take(Ui& ui, const KeyEvent& event) {
  if (!ui.copy_details || event.key != GLFW_KEY_ESCAPE) return false;
  ui.copy_details.reset();
  return true;
}

/// Escape leaves presentation mode, as F5 does, where it ends nothing else.
bool presentation_takes(Ui& ui, const KeyEvent& event) {
  if (!ui.presenting || event.key != GLFW_KEY_ESCAPE) return false;
  ui.command("present");
  return true;
}

/// The command that a press of a key leads to; null: none.
const CommandRow* row_for(const KeyEvent& event) {
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows)
      for (const Chord& chord : row.chords)
        if (chord.key == event.key && chord.mods == (event.mods & counted) && (chord.repeats || !event.repeat))
          return &row;
  return nullptr;
}

void command_for(Ui& ui, const KeyEvent& event) {
  if (const auto mode = digit(event)) {
    Preset next = ui.session.requested_preset();
    next.mode = *mode;
    ui.session.propose(std::move(next));
    return;
  }
  if (const CommandRow* row = row_for(event)) ui.command(row->id);
}

void take_key(Ui& ui, const KeyEvent& event) {
  const bool taken = film_takes(ui, event) || dialog_takes(ui, event) || palette_takes(ui, event) ||
                     help_takes(ui, event) || methods_take(ui, event) || list_takes(ui, event) ||
                     typing_takes(ui, event) || resolution_takes(ui, event) || slider_takes(ui, event) ||
                     tour_takes(ui, event) || copy_details_take(ui, event) || presentation_takes(ui, event) ||
                     question_takes(ui, event);
  if (!taken) command_for(ui, event);
}

/// Characters that were typed after the n-th key are no part of what is looked for.
void forget_text_after(std::vector<InputEvent>& events, std::size_t n) {
  auto after = events.begin();
  for (std::size_t keys = 0; keys <= n && after != events.end(); ++after)
    keys += std::holds_alternative<KeyEvent>(*after);
  const auto is_text = [](const InputEvent& event) { return std::holds_alternative<TypedCharacter>(event); };
  events.erase(std::remove_if(after, events.end(), is_text), events.end());
}

}  // namespace

bool opens_field(const KeyEvent& event) {
  const CommandRow* row = row_for(event);
  return row != nullptr && row->opens_field;
}

void handle_keys(Ui& ui) {
  CommandPalette& palette = ui.palette;
  // What was pressed after the palette's Enter comes once that has acted; and what was after the key that opens it,
  // once it is open.
  if (!palette.enter)
    for (const KeyEvent& event : std::exchange(ui.later_keys, {})) take_key(ui, event);
  bool opening = false;
  for (std::size_t n = 0; n < ui.input.keys.size(); ++n) {
    const KeyEvent& event = ui.input.keys[n];
    if (opening) {
      ui.later_keys.push_back(event);
      continue;
    }
    const bool before = palette.enter;
    take_key(ui, event);
    if (palette.enter && !before) forget_text_after(ui.input.all, n);
    opening = opens_field(event);
  }
}

}  // namespace tyglab
