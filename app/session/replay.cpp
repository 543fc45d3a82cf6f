#include "app/session/replay.h"

#include <algorithm>

#include "app/session/motion.h"
#include "app/session/session.h"

namespace tyglab {
namespace {

constexpr double silently_s = 0.5;  // that the way from the last state that is kept may take, without being shown
constexpr int late = 20;            // steps by which the divergence may come later than it did

}  // namespace

std::string nothing_to_replay(const Session& session) {
  const auto& divergence = session.simulation->divergence();
  if (!divergence) return "The simulation has not diverged.";
  if (session.rebuild.holds_present()) return "The cloth is being built.";
  const double back = Replay::steps * session.preset().dt;
  return session.rewind.before(*session.simulation, session.simulation->time(), back) != nullptr
             ? ""
             : "No earlier states are kept of a cloth this large.";
}

void begin_replay(Session& session) {
  if (std::string why = nothing_to_replay(session); !why.empty()) return session.messages.note(std::move(why));
  Simulation& simulation = *session.simulation;
  const Divergence of = *simulation.divergence();
  const double dt = session.preset().dt, cost = session.pacing.step_cost_s();
  // What diverged at once has fewer steps to show, and shows them as long.
  const double shown = double(std::clamp<std::int64_t>(of.step - 1, 1, Replay::steps));
  Replay replay{of, 0, shown * dt / Replay::lasts, session.pacing.speed};
  if (session.replay) replay.former_speed = session.replay->former_speed;
  go_back(session, Replay::steps * dt);
  // States are kept every tenth of a second.
  const std::int64_t left = of.step - 1 - Replay::steps - simulation.steps();
  const std::int64_t affordable = cost > 0 ? std::int64_t(silently_s / cost) : Replay::steps;
  if (left > 0) simulation.advance(int(std::min(left, affordable)));
  replay.at = simulation.steps();
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
        "This time it did not diverge: going back starts the method again from positions and velocities.");
  }
  session.pacing.restart_measure();
  session.replay.reset();
}

}  // namespace tyglab
