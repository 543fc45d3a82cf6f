#include "app/commands/stepping.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/commands/command_line.h"
#include "app/commands/interrupt.h"
#include "core/output/text.h"

namespace tyglab {

void Length::add_to(CLI::App& command, bool with_steps) {
  CLI::Option* by_time = command.add_option("--seconds", seconds, "Simulated time, s (4 if it is not given)");
  by_time->type_name("T")->transform(number_between(0, 1e9, "s"));
  if (with_steps)
    command.add_option("--steps", steps, "Number of steps, instead of a time")
        ->type_name("N")
        ->transform(whole_number_between(0, 1'000'000'000'000))
        ->excludes(by_time);
}

std::int64_t Length::in_steps(double dt, double default_seconds) const {
  if (steps) return *steps;
  const double count = seconds.value_or(default_seconds) / dt;
  if (count > 1e12) throw UsageError("--seconds: that many seconds are more than 1e12 steps of dt; ask for fewer");
  return std::llround(count);
}

FramePlan::FramePlan(std::optional<double> fps, double dt, std::int64_t steps)
    : fps_(fps.value_or(std::min(25.0, 1 / dt))), steps_a_frame_(1 / (fps_ * dt)) {
  constexpr double rounding = 1e-9;
  if (steps_a_frame_ < 1 - rounding) {
    std::string limit;
    append_number(limit, 1 / dt, 6);
    throw UsageError("--fps: frames would lie closer together than the steps; at this dt it is at most " + limit);
  }
  count_ = static_cast<std::int64_t>(std::floor(double(steps) / steps_a_frame_ + rounding)) + 1;
}

std::int64_t FramePlan::step_of(std::int64_t frame) const {
  return std::llround(double(frame) * steps_a_frame_);
}

Stepper::Stepper(Simulation& simulation, std::int64_t steps, const std::string& what)
    : simulation_(simulation), steps_(steps), progress_(what) {}

bool Stepper::advance_to(std::int64_t step) {
  while (simulation_.steps() < step && !simulation_.divergence() && !interrupted_) {
    interrupted_ = InterruptGuard::interrupted();
    if (!interrupted_) advance_portion(step);
  }
  const bool reached = simulation_.steps() >= step;
  if (!reached || simulation_.steps() >= steps_) progress_.clear();
  return reached;
}

void Stepper::advance_portion(std::int64_t step) {
  using Clock = std::chrono::steady_clock;
  const auto portion = std::min(portion_, step - simulation_.steps());
  const auto start = Clock::now();
  simulation_.advance(static_cast<int>(portion));
  const double took = std::chrono::duration<double>(Clock::now() - start).count();
  seconds_ += took;
  // Portions that take about a twentieth of a second: short for a person, long beside the cost of a call.
  if (took < 0.025 && portion == portion_ && portion_ < 1'000'000) portion_ *= 2;
  if (took > 0.1 && portion_ > 1) portion_ /= 2;
  progress_.update(double(simulation_.steps()) / double(steps_));
}

std::string divergence_text(const Divergence& d) {
  std::string text = "diverged at t = ";
  append_number(text, d.t, 6);
  text += " s (step " + std::to_string(d.step) + "), particle (" + std::to_string(d.i) + ", " + std::to_string(d.j) +
          "): " + d.quantity + " = ";
  append_number(text, d.value, 4);
  return text + "; " + d.cause + ". " + d.remedy;
}

}  // namespace tyglab
