// Sets the number of steps of fixed dt per frame: simulated time runs at speed times real time, within the budget.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyglab {

class Pacing {
 public:
  bool playing = true;
  bool patient = false;  ///< all due steps are made, however long they take, so that they are the same on every machine
  double most_patient = 1e7;  ///< steps of a frame even so
  double speed = 1;           ///< simulated seconds per real second requested
  static constexpr double slow_motion = 0.25;
  double slowed = 1;  ///< times which, while the hand is in the cloth
  /// Simulated seconds per real second that are aimed at now.
  double aim() const { return speed * slowed; }
  /// Slow motion begins or ends.
  void slow(double factor) {
    assert(factor > 0);
    if (factor == slowed) return;
    slowed = factor;
    restart_measure();
  }
  static constexpr double usual_budget_s = 0.012;
  double budget_s = usual_budget_s;  ///< wall time that a frame may spend on steps

  /// Whole steps due after `real_seconds` more of real time (a pause in drawing counts as a tenth of a second at most),
  /// not more than the budget is likely to allow.
  int due(double real_seconds, double dt) {
    assert(dt > 0 && !(real_seconds < 0));
    const double wish = aim() * std::min(real_seconds, 0.1);
    requested_ += wish, elapsed_ += std::min(real_seconds, 0.1);
    owed_ += wish;
    const double steps = std::floor(owed_ / dt * (1 + 1e-12));
    if (patient) return int(std::min(steps, most_patient));
    const double affordable = step_cost_s_ > 0 ? std::max(1.0, budget_s / step_cost_s_) : first_guess;
    return int(std::min({steps, affordable, 1e7}));
  }
  /// Reports the steps made. Steps that could not be made are dropped: the simulation then runs slower than requested.
  void made(int steps, double dt, double wall_seconds) {
    assert(steps >= 0 && dt > 0 && !(wall_seconds < 0));
    if (steps > 0) {
      const double cost = wall_seconds / steps;
      step_cost_s_ = step_cost_s_ > 0 ? 0.7 * step_cost_s_ + 0.3 * cost : cost;
      steps_per_frame_ = steps;
    }
    got_ += steps * dt;
    owed_ = std::clamp(owed_ - steps * dt, 0.0, dt);
    if (elapsed_ < 0.5) return;
    reached_ = requested_ > 0 ? std::min(got_ / requested_, 1.0) * aim() : 0;
    requested_ = got_ = elapsed_ = 0;
  }
  void forget_cost() { step_cost_s_ = 0; }
  /// Restarts the measurement (after a pause or a change of speed).
  void restart_measure() { requested_ = got_ = elapsed_ = owed_ = 0; }

  double step_cost_s() const { return step_cost_s_; }
  int steps_per_frame() const { return steps_per_frame_; }
  /// Simulated seconds per real second reached over the last half second.
  double reached() const { return reached_; }

 private:
  static constexpr double first_guess = 8;
  double owed_ = 0, step_cost_s_ = 0;
  double requested_ = 0, got_ = 0, elapsed_ = 0, reached_ = 0;
  int steps_per_frame_ = 0;
};

}  // namespace tyglab
