#include "app/session/motion.h"

#include "app/base/numbers.h"
#include "app/session/edits.h"

namespace tyglab {
namespace {

constexpr double rewinds_s = 1;

}  // namespace

void restart(Session& session) {
  if (!apply_edit(session, edit::Restart{})) return;
  session.recorded.clear();
  session.pacing.restart_measure();
}

bool rewind(Session& session) {
  const double t = session.simulation->time();
  if (session.rebuild.holds_present() || session.rewind.before(*session.simulation, t, rewinds_s) == nullptr)
    return false;
  settle(session);
  session.rewind.go_back(*session.simulation, t, rewinds_s);
  copies_resume(session);
  if (!session.copies.lockstep.empty())
    session.messages.note("Copies are not rewound separately: they also continue from this state.");
  ++session.counts.hands;
  session.recorded.clear();
  session.pacing.restart_measure();
  return true;
}

bool take_back(Session& session, const Preset& preset) {
  if (session.auto_dt && preset.dt != AutoStep::choose(preset)) session.auto_dt.reset();
  return apply_edit(session, edit::Change{preset});
}

void take_from_history(Session& session, bool backwards) {
  const auto preset =
      backwards ? session.history.undo(session.requested_preset()) : session.history.redo(session.requested_preset());
  if (!preset) {
    session.messages.note(backwards ? "There is nothing to undo." : "There is nothing to redo.");
    return;
  }
  History kept = session.history;
  Preset next = *preset;
  next.mode = session.requested_preset().mode;  // the view is not a change to undo
  take_back(session, next);
  session.history = std::move(kept);
}

void reset_everything(Session& session) {
  session.auto_dt.reset();
  take_back(session, session.document.saved);
  restart(session);
}

void move_hand(Session& session, const std::optional<glm::dvec3>& hand, int steps) {
  if (hand && steps > 0) apply_edit(session, edit::MoveHand{*hand, steps});
}

void single_step(Session& session, const std::optional<glm::dvec3>& hand) {
  session.pacing.playing = false;
  if (session.rebuild.holds_present() || session.background_steps.busy()) return;
  move_hand(session, hand, 1);
  if (BackgroundSteps::wanted(session)) return session.background_steps.start(session, 1);
  session.steps_made += session.simulation->advance(1).steps;
  copies_follow(session, 0);
}

void toggle_auto_dt(Session& session) {
  if (session.auto_dt) return session.auto_dt.reset();
  Preset next = session.requested_preset();
  const auto dt = AutoStep::choose(next);
  if (!dt) {
    session.messages.error(next.integrator +
                           " has no stable dt with these constants. Use another method, or more k_d.");
    return;
  }
  next.dt = *dt;
  if (next == session.requested_preset() || apply_edit(session, edit::Change{next})) session.auto_dt.emplace();
}

void watch_dt(Session& session) {
  const auto dt = session.auto_dt->look(session.preset(), session.simulation->time(), *session.simulation->ledger());
  if (!dt) return;
  Preset next = session.preset();
  next.dt = *dt;
  apply_edit(session, edit::Change{next});
  session.messages.note(next.integrator + " was adding energy: dt is halved to " + short_number(*dt) + " s.");
}

}  // namespace tyglab
