#include "app/cli/stepping.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <utility>

#include "app/cli/command_line.h"
#include "app/process/interrupt.h"
#include "app/process/process.h"
#include "core/integrators/scheme.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/theory/advice.h"

namespace tyglab {

void Length::add_to(CLI::App& command, bool with_steps) {
  CLI::Option* by_time = command.add_option("--seconds", seconds, "Simulated time, s (default 4)");
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
  if (count > 1e12) throw UsageError("--seconds: more than 1e12 steps of dt; use fewer seconds");
  return std::llround(count);
}

void Length::warn_if_too_short(double dt) const {
  if (!seconds || *seconds == 0 || in_steps(dt, 0) > 0) return;
  std::string text = "tyglab: --seconds ";
  append_number(text, *seconds, 6);
  text += " is less than half a step of dt = ";
  append_number(text, dt, 6);
  std::cerr << text << " s, so no step is computed; use more seconds or a smaller --dt.\n";
}

RunLength length_of(const Length& length, const Preset& preset, const Experiment* experiment) {
  constexpr double default_seconds = 4;
  if (experiment != nullptr && !length.seconds && !length.steps)
    return {experiment->recording.steps(), std::llround(experiment->seconds / preset.dt)};
  const std::int64_t steps = length.in_steps(preset.dt, default_seconds);
  return {steps, steps};
}

FramePlan::FramePlan(std::optional<double> fps, double dt, std::int64_t steps)
    : fps_(fps.value_or(std::min(25.0, 1 / dt))), timeline_{dt} {
  constexpr double rounding = 1e-9;
  const double steps_a_frame = 1 / (fps_ * dt);
  if (steps_a_frame < 1 - rounding) {
    std::string limit;
    append_number(limit, 1 / dt, 6);
    throw UsageError("--fps: frames would be closer together than steps; at this dt the largest is " + limit);
  }
  count_ = static_cast<std::int64_t>(std::floor(double(steps) / steps_a_frame + rounding)) + 1;
}

std::int64_t FramePlan::step_of(std::int64_t frame) const {
  return timeline_.step_at(double(frame) / fps_);
}

std::int64_t Timeline::step_at(double time) const {
  return step + std::llround((time - t) / dt);
}

bool takes_long_to_show(const Simulation& simulation) {
  constexpr int most = 250'000;  // particles
  return simulation.lattice().size() > most;
}

void end_interrupted(const std::string& what_is_missing) {
  std::cout.flush(), std::cerr.flush();
  end_at_once(
      "tyglab: Interrupted; what was written so far has whole rows and frames, and no older file was replaced. " +
          what_is_missing + "\n",
      exit_interrupted);
}

Stepper::Stepper(Simulation& simulation, std::int64_t steps, const std::string& what, bool auto_dt, Playback* playback)
    : simulation_(simulation),
      steps_(steps),
      end_time_(double(steps) * simulation.preset().dt),
      timeline_{simulation.preset().dt},
      playback_(playback),
      progress_(what) {
  simulation_.stop_when(InterruptGuard::interrupted);
  if (const std::string coarse = precision_too_coarse(simulation.preset()); !coarse.empty()) {
    std::cerr << "tyglab: " << coarse << '\n';
    said_precision_ = true;
  }
  if (!auto_dt) return;
  auto_.emplace();
  simulation_.enable_ledger(true);
}

bool Stepper::changed() {
  return std::exchange(changed_, false);
}

bool Stepper::advance_to(std::int64_t step) {
  if (playback_ != nullptr) make_events();
  while (made() < step && !ended() && !interrupted_ && !changed_) {
    interrupted_ = InterruptGuard::interrupted();
    if (!interrupted_) advance_portion(step);
  }
  const bool reached = made() >= step && !changed_;
  if (!reached || made() >= steps_) progress_.clear();
  return reached;
}

void Stepper::advance_portion(std::int64_t step) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t between_looks = 64;
  auto portion = std::min({portion_, step - made(), auto_ ? between_looks : portion_});
  if (playback_ != nullptr && !playback_->over(simulation_))
    portion = std::min(portion, playback_->steps_to_next(simulation_));
  const auto start = Clock::now();
  simulation_.advance(static_cast<int>(portion));
  const double took = std::chrono::duration<double>(Clock::now() - start).count();
  seconds_ += took;
  // Portions that take about a twentieth of a second: short for a person, long beside the cost of a call.
  if (took < 0.025 && portion == portion_ && portion_ < 1'000'000) portion_ *= 2;
  if (took > 0.1 && portion_ > 1) portion_ /= 2;
  if (auto_) look_at_ledger();
  look_at_precision();
  progress_.update(double(made()) / double(steps_));
  if (playback_ != nullptr) make_events();
}

/// Those of the recording that are due.
void Stepper::make_events() {
  while (playback_->due(simulation_) != nullptr) playback_->apply_next(simulation_);
  const double dt = simulation_.preset().dt;
  if (dt == timeline_.dt) return;
  timeline_ = {dt, made(), timeline_.t + double(made() - timeline_.step) * timeline_.dt};
  changed_ = true;
}

/// Says with the first step that only more digits could solve what is in store.
void Stepper::look_at_precision() {
  const SolveCounts solves = simulation_.engine().solves();
  if (said_precision_ || solves.rounded == 0) return;
  said_precision_ = true;
  progress_.clear();
  std::cerr << "tyglab: " << solves_missed(solves, simulation_.steps(), simulation_.preset()) << '\n';
}

void Stepper::look_at_ledger() {
  const bool in_vain = auto_->in_vain();
  const auto dt = auto_->look(simulation_.preset(), simulation_.time(), *simulation_.ledger());
  if (auto_->in_vain() && !in_vain) {
    progress_.clear();
    std::cerr << "tyglab: a smaller dt has not kept " + std::string(scheme(simulation_.preset().integrator).title) +
                     " from adding energy, so dt stays; use another method.\n";
  }
  if (!dt) return;
  Preset next = simulation_.preset();
  next.dt = *dt;
  simulation_.apply(edit::Change{next});
  timeline_ = {*dt, simulation_.steps(), simulation_.time()};
  steps_ = timeline_.step_at(end_time_);
  changed_ = true;
  progress_.clear();
  std::string text = "tyglab: at t = ";
  append_number(text, timeline_.t, 4);
  text += " s " + std::string(scheme(next.integrator).title) + " was adding energy; dt is ";
  append_number(text, *dt, 3);
  std::cerr << text << " s from here on.\n";
}

}  // namespace tyglab
