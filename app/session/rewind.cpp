
#include "app/session/rewind.h"

#include <algorithm>
#include <cassert>

#include "app/session/motion.h"
#include "app/session/session.h"

namespace tyglab {

void Rewind::look(Simulation& simulation) {
  if (simulation.divergence()) return;
  if (Snapshot::bytes(simulation.lattice()) > most_bytes / fewest) return clear();
  const double t = simulation.time();
  // A restart or another cloth: that past is another's.
  if (!kept_.empty() && (t < kept_.back().t || !simulation.fits(kept_.back()))) clear();
  if (changing_) changed_ = simulation.snapshot();
  changing_ = false;
  if (!kept_.empty() && t - kept_.back().t < interval) return;
  kept_.push_back(simulation.snapshot());
  // Of a large cloth more states count for more than the last bits of each.
  if (kept_.back().bytes() > most_bytes / fewest) kept_.back().held.reset();
  bytes_ += kept_.back().bytes();
  while (bytes_ > most_bytes || t - kept_.front().t > longest) {
    assert(bytes_ >= kept_.front().bytes());
    bytes_ -= kept_.front().bytes();
    kept_.pop_front();
  }
  assert(!kept_.empty());
}

const Snapshot* Rewind::before(const Simulation& simulation, double t, double seconds) const {
  assert(seconds >= 0);
  if (kept_.empty() || !simulation.fits(kept_.front())) return nullptr;
  for (auto at = kept_.rbegin(); at != kept_.rend(); ++at)
    if (t - at->t >= seconds) return &*at;
  return &kept_.front();
}

const Snapshot* Rewind::unchanged_before(const Simulation& simulation, double t, double seconds) const {
  const Snapshot* then = before(simulation, t, seconds);
  return then != nullptr && changed_ && changed_->t > then->t && simulation.fits(*changed_) ? &*changed_ : then;
}

void Rewind::go_back(Simulation& simulation, const Snapshot& then) {
  assert(simulation.fits(then));
  simulation.restore(then);
  forget_after(then.t);
}

void Rewind::forget_after(double t) {
  while (!kept_.empty() && kept_.back().t > t) {
    assert(bytes_ >= kept_.back().bytes());
    bytes_ -= kept_.back().bytes();
    kept_.pop_back();
  }
  assert(!kept_.empty() || bytes_ == 0);
  if (changed_ && changed_->t > t) changed_.reset();
}

namespace {

constexpr double silently_s = 0.5;  // that the way from the last state that is kept may take, without being shown
constexpr int late = 20;            // steps by which the divergence may come later than it did

/// Where it begins: early enough, if the motion was the same all the way.
const Snapshot* start_of(const Session& session) {
  const double back = Replay::steps * session.simulation->diverged_preset().dt;
  return session.rewind.unchanged_before(*session.simulation, session.simulation->time(), back);
}

/// The constants that the motion had when it diverged.
bool take_constants_back(Session& session) {
  Preset then = session.simulation->diverged_preset(), now = session.requested_preset();
  then.mode = now.mode, then.engine = now.engine, then.device = now.device, then.precision = now.precision;
  if (!apply_edit(session, edit::Change{then})) return false;
  session.messages.note("Restored the constants that diverged: " + change_in_words(now, then) +
                        ". Ctrl+Z undoes that.");
  return true;
}

}  // namespace

std::string nothing_to_replay(const Session& session) {
  const auto& divergence = session.simulation->divergence();
  if (!divergence) return "The simulation has not diverged.";
  if (session.rebuild.holds_present()) return "The cloth is being built.";
  return start_of(session) != nullptr ? "" : "No earlier states are kept of a cloth this large.";
}

void begin_replay(Session& session) {
  if (std::string why = nothing_to_replay(session); !why.empty()) return session.messages.note(std::move(why));
  settle(session);
  const Divergence of = *session.simulation->divergence();
  const Snapshot* start = start_of(session);
  if (changed_since_divergence(session) && !take_constants_back(session)) return;
  if (changed_since_divergence(session)) return;  // a large cloth takes them beside the frames
  Simulation& simulation = *session.simulation;
  const double dt = session.preset().dt, cost = session.pacing.step_cost_s(), former = session.pacing.speed;
  assert(start != nullptr);
  go_back(session, *start);
  // States are kept every tenth of a second.
  const std::int64_t left = of.step - 1 - Replay::steps - simulation.steps();
  const std::int64_t affordable = session.pacing.patient ? std::int64_t(session.pacing.most_patient)
                                  : cost > 0             ? std::int64_t(silently_s / cost)
                                                         : Replay::steps;
  if (left > 0) simulation.advance(int(std::min(left, affordable)));
  // What has fewer steps to show, since it diverged at once or was changed shortly before, shows them as long.
  const double shown = double(std::clamp<std::int64_t>(of.step - 1 - simulation.steps(), 1, Replay::steps));
  const Replay replay{of, simulation.steps() + 1, simulation.steps(), shown * dt / Replay::lasts,
                      session.replay ? session.replay->former_speed : former};
  session.pacing.speed = replay.speed;
  session.pacing.playing = true;
  session.replay = replay;
}

void watch_replay(Session& session) {
  if (!session.replay) return;
  const Simulation& simulation = *session.simulation;
  Replay& replay = *session.replay;
  const bool left = simulation.steps() < replay.at, diverged = simulation.divergence().has_value();
  const bool passed = simulation.steps() >= replay.of.step + late;
  replay.at = simulation.steps();
  if (!left && !diverged && !passed) return;
  if (session.pacing.speed == replay.speed) session.pacing.speed = replay.former_speed;
  if (passed && !left && !diverged) {
    session.pacing.playing = false;
    session.messages.note(
        "The motion did not diverge this time: a replay restarts the method from positions and velocities.");
  }
  session.pacing.restart_measure();
  session.replay.reset();
}

namespace {

constexpr double moving_pause = 0.25;  // s between two looks at a moving cloth

}  // namespace

void StepInspector::update(const Session& session) {
  const Simulation& simulation = *session.simulation;
  const bool there = session.picked && session.preset().kind == Kind::cloth && !simulation.divergence() &&
                     !session.rebuild.holds_present() && simulation.lattice().size() <= largest;
  if (!there) return drop();
  assert(simulation.has(session.picked->i, session.picked->j));
  const bool other = !trace_ || trace_->i != session.picked->i || trace_->j != session.picked->j;
  const bool moved = revision_ != simulation.revision();
  if (!other && (!moved || (session.pacing.playing && session.now < looked_ + moving_pause))) return;
  trace_ = trace_step(simulation, session.picked->i, session.picked->j);
  revision_ = simulation.revision();
  looked_ = session.now;
}

}  // namespace tyglab
