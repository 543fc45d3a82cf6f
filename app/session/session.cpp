
#include "app/session/session.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <new>

#include "app/base/text.h"
#include "app/session/motion.h"
#include "app/session/rebuild.h"
#include "core/analysis/pierced.h"
#include "core/forces/contact.h"
#include "core/model/effect.h"
#include "core/model/preset.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

/// The engine that was asked for as the fastest one, once it is known.
void take_engine_choice(Session& session) {
  const auto outcome = session.studies.engine.take();
  if (!outcome) return;
  if (const auto* error = std::get_if<JobError>(&*outcome)) {
    session.messages.error(error->what);
  } else {
    const EngineChoice& choice = std::get<EngineChoice>(*outcome);
    Preset next = session.requested_preset();
    next.engine = choice.engine;
    if (next.engine == EngineKind::opencl) next.device = choice.device;
    if (next != session.requested_preset()) session.propose(std::move(next));
    session.messages.note("Automatic: " + choice.why + ".");
  }
  session.pacing.restart_measure();
}

/// Where drawing alone takes longer than the display's frame (waiting for the display is none of it), steps may cost
/// as much again: they no longer decide whether the window keeps up.
double step_budget(const FrameCosts& costs, double frame_time) {
  double beside_ms = costs.recent_ms(Part::frame);
  for (const Part part : {Part::simulate, Part::swap}) beside_ms -= costs.recent_ms(part);
  return beside_ms > 1e3 * frame_time ? std::min(1e-3 * beside_ms, 0.2) : Pacing::usual_budget_s;
}

}  // namespace

bool Session::idle() const {
  const bool over = simulation->divergence().has_value() && !copies.lockstep.alive();
  return (!pacing.playing || behind_page || over || asleep()) && !rebuild.busy() && !background_steps.busy() &&
         !studies.engine.busy() && !copies.awaited && requests.empty();
}

StudyMoment Session::study_moment() const {
  StudyMoment moment{*simulation, now, last_change, !rebuild.holds_present()};
  moment.moving = pacing.playing && !behind_page && !simulation->divergence() && !sleep.asleep(*simulation);
  moment.document = counts.documents;
  return moment;
}

void Session::update(double real_seconds, const SessionInput& input) {
  assert(!(real_seconds < 0));  // the clock goes on
  now += real_seconds;
  try {
    advance(real_seconds, input);
  } catch (const std::bad_alloc&) {
    pacing.playing = false;
    messages.error(
        "There is not enough memory to continue, so the motion is paused; the cloth is unchanged. Use fewer rows and "
        "columns, or close other programs.");
  }
  steps_made = recorded.sampled = 0;
}

void Session::advance(double real_seconds, const SessionInput& input) {
  rebuild.poll(*this);
  poll_copies(*this);
  take_engine_choice(*this);
  apply_requests(*this);
  try {
    step(real_seconds, input);
  } catch (const EngineError& error) {
    fall_back(*this, error.what());
  }
  watch_replay(*this);
  // A copy of a cloth that parted may be gone: undone, or rewound.
  if (picked && !simulation->has(picked->i, picked->j)) picked.reset();
  costs.add_steps(steps_made);
  sample(*this);
  watch_lab(*this);
  wants |= lab_wants(*this);
  StudyMoment moment = study_moment();
  moment.dragging = input.dragging;
  studies.update(wants, moment);
  wants.step ? inspector.update(*this) : inspector.drop();
  again_at = moment.again_at;
}

bool Session::goes_on() const {
  return pacing.playing && !behind_page && !asleep() && !rebuild.holds_present() && !studies.engine.busy() &&
         !background_steps.busy() && !simulation->divergence();
}

void Session::step(double real_seconds, const SessionInput& input) {
  const FrameCosts::Timer timer(costs, Part::simulate);
  if (background_steps.busy()) {
    pacing.due(real_seconds, preset().dt);
    if (!background_steps.wait(Pacing::usual_budget_s)) return;
    take_steps();
    if (input.after_steps) input.after_steps();
    return;
  }
  if (simulation->step_limit() != step_limit) simulation->limit_steps(step_limit), warned_unconverged = false;
  for (std::size_t n = 0; n < copies.lockstep.size(); ++n) copies.lockstep[n].simulation->limit_steps(step_limit);
  if (awaits_prediction(*this)) pacing.playing = false;
  sleep.begin(*simulation);
  simulation->keep_hashes(!repetition);  // the recording has its own
  if (repetition && pacing.playing && !rebuild.busy()) make_recorded_events(*this);
  if (const bool wanted = wants.ledger || auto_dt; wanted != simulation->ledger().has_value())
    if (!wanted || rebuild.ledger_ready(*this)) simulation->enable_ledger(wanted);
  if (!pacing.playing || behind_page || asleep() || rebuild.holds_present() || studies.engine.busy()) return;
  const double dt = preset().dt;
  pacing.slow(input.slow_motion ? Pacing::slow_motion : 1);
  if (simulation->divergence()) {
    if (copies.lockstep.alive()) steps_made += copies_go_on(*this, pacing.due(real_seconds, dt));
    return;
  }
  warn_of_precision();
  rewind.look(*simulation), timeline.look(*simulation);
  const int due = up_to_stop(*this, pacing.due(real_seconds, dt));
  move_hand(*this, input.hand, due);
  if (input.body && due > 0)
    apply_edit(*this, edit::MoveBody{input.body->index, input.body->c, due}, input.body_gesture);
  pacing.budget_s = step_budget(costs, input.frame_time);
  make_steps(due, input);
  // A step of a lab may measure for how long nothing happens.
  const bool measures = labs.run && !labs.run->record().done;
  if (!background_steps.busy() && !scripted && !any_moves(preset().bodies) && preset().pins.motions.empty())
    sleep.look(*simulation, input.touched || repetition || !copies.lockstep.empty() || measures);
}

/// In pieces, so that a wrong guess of a step's cost cannot hold the window up.
void Session::make_steps(int due, const SessionInput& input) {
  assert(due >= 0);
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const double dt = preset().dt;
  const int samples = steps_between_samples(*this);
  int made = 0;
  double stepping_s = 0;
  if (due > 0) sample_start(*this);
  while (made < due && (made == 0 || pacing.patient || spent() < pacing.budget_s)) {
    if ((repetition && !make_recorded_events(*this)) || simulation->divergence()) break;
    const double cost = pacing.step_cost_s();
    const int to_sample = std::max(samples - int(steps_made - recorded.sampled), 1);
    const int piece = cost > 0 && !input.after_steps
                          ? std::clamp(int(0.25 * pacing.budget_s / cost), 1,
                                       std::min(up_to_next_event(*this, due - made), to_sample))
                          : 1;
    assert(piece >= 1 && piece <= due - made);
    const double before = spent();
    AdvanceResult advance;
    if (BackgroundSteps::wanted(*this)) {
      background_steps.start(*this, piece);
      if (!background_steps.wait(std::max(pacing.budget_s - before, 0.0))) break;
      const BackgroundResult beside = background_steps.take(*this);
      copies_note(*this, beside.t, beside.computing_s);
      advance = beside.advance;
    } else {
      const EngineKind engine = preset().engine;
      const double begun = computing_seconds(engine);
      advance = simulation->advance(piece);
      copies_follow(*this, computing_seconds(engine) - begun);
    }
    assert(advance.steps >= 0 && advance.steps <= piece);
    stepping_s = spent();
    made += advance.steps, steps_made += advance.steps;
    if (steps_made - recorded.sampled >= samples) sample(*this);
    if (input.after_steps) input.after_steps();
    warn_of(advance);
    if (advance.steps < piece) break;
  }
  made_steps(made, stepping_s, dt);
}

void Session::take_steps() {
  const double dt = preset().dt;
  const BackgroundResult beside = background_steps.take(*this);
  copies_note(*this, beside.t, beside.computing_s);
  warn_of(beside.advance);
  steps_made += beside.steps;
  made_steps(beside.steps, beside.seconds, dt);
}

void Session::made_steps(int steps, double seconds, double dt) {
  assert(recorded.sampled <= steps_made);
  pacing.made(steps, dt, seconds);
  pause_at_stop(*this);
  if (auto_dt && !repetition && !simulation->divergence()) watch_dt(*this);
}

/// Before the steps whose motion it concerns.
void Session::warn_of_precision() {
  const std::string coarse = precision_too_coarse(preset());
  if (!coarse.empty() && !warned_coarse) messages.warning(coarse);
  warned_coarse = !coarse.empty();
}

void Session::warn_of(const AdvanceResult& advance) {
  if (advance.left_inside > 0 && !warned_left_inside) {
    messages.note("Overlapping bodies leave some particles inside one of them; move the bodies apart.");
    warned_left_inside = true;
  }
  std::string missed = solves_missed(simulation->engine().solves(), simulation->steps(), simulation->preset());
  if (missed.empty()) missed = tolerance_missed(simulation->preset(), simulation->engine().inner_steps());
  if (!missed.empty() && !warned_unconverged) {
    messages.warning(missed);
    warned_unconverged = true;
  }
  // About a second, longer where a look takes long. In a lab finding it out is the student's task.
  const int between_looks = 64 * (1 + simulation->lattice().size() / (256 * 256));  // updates
  if (!labs.run && !advance.diverged && ++updates_unlooked >= between_looks) {
    updates_unlooked = 0;
    const bool said = energy_warning_preset && changes(*energy_warning_preset, preset()).within(motionless);
    std::string excess = said ? "" : energy_in_excess(simulation->excess(), preset());
    if (!excess.empty()) messages.warning(std::move(excess)), energy_warning_preset = preset();
    std::string pierced = warned_pierced ? "" : pierced_in_words(*simulation);
    if (!pierced.empty()) messages.warning(std::move(pierced)), warned_pierced = true;
  }
  if (advance.released) messages.note("The hand let go: its force exceeded F_release.");
}

void fall_back(Session& session, const std::string& why) {
  assert(!session.background_steps.busy());
  Preset next = session.preset();
  if (next.engine == EngineKind::cpu) throw EngineError(why);
  next.engine = EngineKind::cpu;
  auto simulation = std::make_unique<Simulation>(next, session.threads);
  const Snapshot* then = session.rewind.before(*simulation, session.simulation->time(), 0);
  leave_line(session, then != nullptr ? then->past.steps() : session.simulation->past().steps());
  then != nullptr ? simulation->restore(*then) : simulation->continue_recording(*session.simulation);
  session.messages.error(why + " The CPU engine continues from t = " + time_number(simulation->time(), next.dt) +
                         " s.");
  ++session.counts.hands;
  swap_in(session, std::move(simulation));
}

}  // namespace tyglab
