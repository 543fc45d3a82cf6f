#include "app/ui/state/ui.h"

#include <algorithm>
#include <utility>

#include "app/ui/cards/cards.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/panels.h"

namespace tyglab {

void Ui::run_actions() {
  // What these ask for in turn is done in the next frame.
  for (const auto& action : std::exchange(actions, {})) action(*this);
}

void Ui::show_why_diverged(int n) {
  if (n == Copies::original)
    banner_whole = true;
  else
    copy_details = CopyDetails{.copy = std::size_t(n), .happened = {}, .why = {}};
}

void Ui::color_by(std::optional<ParticleField> field) {
  scene.colors.choose(field);
  settings.color = field ? info(*field).name : "";
}

void Ui::color_replay() {
  const auto& chosen = scene.colors.chosen;
  if (!color_before_replay_) color_before_replay_.emplace(chosen ? std::optional(chosen->field) : std::nullopt);
  scene.colors.choose(ParticleField::strain);
  scene.colors.update(scene, 0, 1);  // of what it leads to, whose scale the replay keeps
}

/// The replay's coloring stays while what it led to is seen; what was chosen meanwhile stays altogether.
void Ui::follow_replay() {
  if (!color_before_replay_ || session.replay || session.simulation->divergence()) return;
  const auto& chosen = scene.colors.chosen;
  if (chosen && chosen->field == ParticleField::strain) scene.colors.choose(*color_before_replay_);
  color_before_replay_.reset();
}

/// A file of the user's that is open; a lab's cloth is none.
void Ui::remember_recent() {
  constexpr std::size_t most = 8;
  const std::string file = session.document.file.string();
  std::vector<std::string>& recent = settings.recent;
  if (file.empty() || session.labs.run || (!recent.empty() && recent.front() == file)) return;
  std::erase(recent, file);
  recent.insert(recent.begin(), file);
  recent.resize(std::min(recent.size(), most));
}

namespace {

/// The constant that a check of the lab's step is about; null where it is about none that plays a part in this scene.
const PresetRow* checked_constant(const Ui& ui, const Condition& check) {
  const PresetRow* row = find_row(check.name.substr(0, check.name.find('.')));
  return row != nullptr && applies(*row, ui.session.requested_preset()) ? row : nullptr;
}

}  // namespace

std::vector<const PresetRow*> checked_constants(const Ui& ui) {
  std::vector<const PresetRow*> rows;
  if (!ui.session.labs.run) return rows;
  for (const Condition& check : ui.session.labs.run->now().checks)
    if (const PresetRow* row = checked_constant(ui, check);
        row != nullptr && std::count(rows.begin(), rows.end(), row) == 0)
      rows.push_back(row);
  return rows;
}

/// What a step of a lab tells to change is to be in sight, in a low column too: the first constant that it checks, or
/// one of the choices among the constants.
void Ui::show_what_to_change() {
  for (const Condition& check : session.labs.run->now().checks) {
    const PresetRow* row = checked_constant(*this, check);
    if (row != nullptr || check.name == "contact" || check.name == "self" || check.name == "tearing.mode")
      return bring_into_sight(*this, row != nullptr ? row->key : check.name);
  }
}

/// A left drag cuts, which a newcomer has not known: how to pull instead, and how to take it back.
void Ui::tell_of_first_cut() {
  constexpr double read_in = 8;  // s
  const auto kind = tools.tool.kind;
  if (kind == Tool::Kind::grab || session.counts.hands != seen_.hands) cut_hint.reset();
  if (session.counts.touches == seen_.touches || kind != Tool::Kind::cut || settings.cut_told) return;
  settings.cut_told = true;
  cut_hint = CutHint{input.at, now + read_in};
}

void Ui::follow() {
  const SessionCounts& counts = session.counts;
  tell_of_first_cut();
  if (counts.documents != seen_.documents) slider = SliderState{}, constants_to_top = true;
  remember_recent();
  follow_replay();
  if (counts.copies_added != seen_.copies_added) {
    settings.layout.folded.erase(card_name::copies);
    if (!in_front(*this, card_name::copies)) plots.wanted = card_name::distances;
  }
  const bool lab_begins = counts.labs_begun != seen_.labs_begun;
  if (!session.labs.run || lab_begins) close_lab_cards(*this);
  if (lab_begins) side = Side::main;
  if (counts.lab_steps != seen_.lab_steps && session.labs.run) {
    // Begun at a later step, it lacks the card that one before has opened.
    show_for_lab(*this, lab_begins ? session.labs.run->shown() : session.labs.run->now().show);
  }
  // The step's preset may come frames after the step, and brings the constants back to their top.
  if (session.labs.run && (counts.lab_steps != seen_.lab_steps || counts.documents != seen_.documents))
    show_what_to_change();
  seen_ = counts;
  if (const auto question = std::exchange(session.question, std::nullopt)) {
    const bool unsaved = question->about == Question::About::unsaved_changes;
    ask(*this, unsaved ? Dialog::Kind::unsaved : Dialog::Kind::large_cloth, question->text, question->then);
  }
  if (const auto problem = std::exchange(session.not_saved, std::nullopt))
    show_save_problem(*this, problem->file, problem->name, problem->why);
}

}  // namespace tyglab
