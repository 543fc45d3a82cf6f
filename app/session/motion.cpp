#include "app/session/motion.h"

#include <cassert>
#include <glm/common.hpp>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/session/session.h"
#include "core/integrators/scheme.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double rewinds_s = 1;

/// The cloth is at another moment than it has come to by itself.
void go_on_from_here(Session& session) {
  copies_resume(session);
  ++session.counts.hands;
  session.recorded.go_on_from(session.simulation->time());
  session.pacing.restart_measure();
}

/// Brings a state back that an undo or a redo is about.
void bring_back(Session& session, const Snapshot& then) {
  leave_line(session, then.past.steps());
  then.t <= session.simulation->time() ? session.rewind.forget_after(then.t) : session.rewind.clear();
  session.simulation->restore(then);
  go_on_from_here(session);
}

}  // namespace

void restart(Session& session) {
  if (!apply_edit(session, edit::Restart{})) return;
  session.recorded.clear();
  session.pacing.restart_measure();
}

void go_back(Session& session, const Snapshot& then) {
  assert(!session.background_steps.busy());
  leave_line(session, then.past.steps());
  session.rewind.go_back(*session.simulation, then);
  session.history.go_back(session.simulation->time());
  go_on_from_here(session);
}

bool rewind(Session& session) {
  if (session.rebuild.holds_present()) return false;
  settle(session);
  const Snapshot* then = session.rewind.before(*session.simulation, session.simulation->time(), rewinds_s);
  if (then == nullptr) return false;
  go_back(session, *then);
  if (!session.copies.lockstep.empty())
    session.messages.note("Copies are not rewound separately: they also continue from this state.");
  return true;
}

bool rewind_and_say_what_stays(Session& session) {
  if (!rewind(session)) return false;
  const Preset* then = session.history.before(session.simulation->time());
  if (then == nullptr) return true;
  Preset now = session.requested_preset();
  now.mode = then->mode;
  if (now != *then)
    session.messages.note("Rewound the motion, not the constants: " + change_in_words(*then, now) +
                          " stays. Ctrl+Z undoes it.");
  return true;
}

bool take_back(Session& session, const Preset& preset) {
  if (session.auto_dt && preset.dt != AutoStep::choose(preset)) session.auto_dt.reset();
  return apply_edit(session, edit::Change{preset});
}

namespace {

/// What was said of an earlier undo or redo is no news any more.
void say_taken(Session& session, const std::string& said) {
  const std::vector<Message> list = session.messages.list();
  for (const Message& message : list)
    if (message.text.starts_with("Undone: ") || message.text.starts_with("Redone: "))
      session.messages.take_back(message.text);
  session.messages.note(said);
}

/// Undoes or redoes what was done with a copy; the cloth itself and its constants stay as they are.
void take_copy_from_history(Session& session, bool backwards, const std::string& what, const CopyChange& change) {
  if (session.rebuild.busy())
    return session.messages.note("Wait until the cloth has been built, then undo the " + what + ".");
  try {
    std::string said = (backwards ? "Undone: " : "Redone: ") + what;
    HistoryEntry now{session.requested_preset(), session.copies.t, what};
    now.copy = std::make_shared<const CopyChange>(undo_copy_change(session, change, said));
    session.history.take(backwards, std::move(now));
    say_taken(session, said + ".");
  } catch (const std::bad_alloc&) {
    session.messages.error("There is not enough memory for that copy. Nothing was changed.");
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
}

}  // namespace

void take_from_history(Session& session, bool backwards) {
  const HistoryEntry* entry = session.history.next(backwards);
  if (entry == nullptr)
    return session.messages.note(backwards ? "There is nothing to undo." : "There is nothing to redo.");
  settle(session);
  const Preset present = session.requested_preset();
  const std::string what = session.history.what(backwards, present);
  if (const auto copy = entry->copy) return take_copy_from_history(session, backwards, what, *copy);
  if (entry->too_large)
    return session.messages.note("The " + what +
                                 " cannot be undone: no earlier states are kept of a cloth this large.");
  if (entry->state && session.rebuild.holds_present())
    return session.messages.note("Wait until the cloth has been built, then undo the " + what + ".");
  History history = session.history;
  const bool named = !entry->what.empty();
  HistoryEntry now{present, session.simulation->time(), entry->what};
  if (entry->state) now = motion_entry(session, entry->what);  // after a divergence, of the last whole step
  const HistoryEntry then = history.take(backwards, std::move(now));
  Preset next = then.constants;
  next.mode = present.mode;  // the view is not a change to undo
  if (next != present && !take_back(session, next)) return;
  session.history = std::move(history);
  // Of constants, how they change now.
  std::string said = (backwards ? "Undone: " : "Redone: ") + (named ? what : change_in_words(present, next));
  if (then.state && session.simulation->fits(*then.state)) {
    bring_back(session, *then.state);
    said += ". The cloth is at t = " + time_number(then.t, next.dt) + " s again" +
            (session.copies.lockstep.empty() ? "" : ", and its copies start from there");
  }
  say_taken(session, said + ".");
}

void reset_everything(Session& session) {
  session.auto_dt.reset();
  take_back(session, session.document.saved);
  restart(session);
}

void move_hand(Session& session, const std::optional<glm::dvec3>& hand, int steps) {
  assert(steps >= 0);
  // To 0.1 µm, so that recordings are short.
  constexpr double finest = 1e7;
  if (hand && steps > 0) apply_edit(session, edit::MoveHand{glm::round(*hand * finest) / finest, steps});
}

void single_step(Session& session, const std::optional<glm::dvec3>& hand) {
  session.pacing.playing = false;
  if (session.rebuild.holds_present() || session.background_steps.busy() || awaits_prediction(session)) return;
  if (session.repetition && !make_recorded_events(session) && session.repetition) return;
  move_hand(session, hand, 1);
  sample_start(session);
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
                           " has no stable dt with these constants. Use another method, or a larger k_d.");
    return;
  }
  next.dt = *dt;
  const bool same = next == session.requested_preset();
  if (!same && !apply_edit(session, edit::Change{next})) return;
  session.auto_dt.emplace();
  const bool limited = has_step_limit(scheme(next.integrator)) && !is_implicit(scheme(next.integrator));
  session.messages.note("dt " + std::string(same ? "stays at " : "is now ") + quantity(*dt, "s") +
                        (limited ? ", at most 0.8 of the worst-case limit," : "") + " and follows the constants.");
}

void watch_dt(Session& session) {
  assert(session.auto_dt);
  const auto ledger = session.simulation->ledger();
  if (!ledger) return;  // it is kept from the next update on, or once its program is there
  const bool in_vain = session.auto_dt->in_vain();
  const auto dt = session.auto_dt->look(session.preset(), session.simulation->time(), *ledger);
  if (session.auto_dt->in_vain() && !in_vain)
    session.messages.warning("A smaller dt has not kept " + std::string(scheme(session.preset().integrator).title) +
                             " from adding energy, so dt stays. Use another method.");
  if (!dt) return;
  Preset next = session.preset();
  next.dt = *dt;
  apply_edit(session, edit::Change{next});
  session.messages.note(next.integrator + " was adding energy: dt halved to " + quantity(*dt, "s") + ".");
}

double clock_time(const Session& session) {
  const auto& divergence = session.simulation->divergence();
  return divergence ? divergence->t : session.simulation->time();
}

std::string state_in_words(const Session& session) {
  const Preset& preset = session.preset();
  std::string words =
      preset.name + ", " + std::string(scheme(preset.integrator).title) + ", dt " + short_number(preset.dt) + " s";
  if (const auto& run = session.labs.run) {
    words += ". Lab “" + run->lab.title + "”, step " + std::to_string(run->step + 1) + " of " +
             std::to_string(run->lab.steps.size()) + ": " + run->now().title;
    words += run->record().done ? ", done" : run->to_be_predicted() ? ", waits for a prediction" : "";
  }
  if (const auto& divergence = session.simulation->divergence())
    return words + ": diverged at t = " + short_number(divergence->t) + " s";
  if (session.behind_page) return words + ": waits behind the start page";
  if (session.pacing.playing) return words + (session.asleep() ? ": at rest" : ": running");
  return words + ": paused at t = " + short_number(session.simulation->time()) + " s";
}

std::string tears_in_words(const Tears& tears) {
  const int torn = tears.torn_count();
  const std::string count = grouped(torn);
  if (tears.mesh() != nullptr) return count + (torn == 1 ? " particle" : " particles") + " parted";
  return count + (torn == 1 ? " spring" : " springs") + " torn or cut";
}

std::string time_in_words(const Session& session) {
  const Tears& tears = session.simulation->tears();
  return "t = " + time_number(clock_time(session), session.preset().dt) + " s" +
         (tears.untorn() ? "" : ", " + tears_in_words(tears)) +
         (session.repetition ? ", " + repetition_in_words(session) : "");
}

}  // namespace tyglab
