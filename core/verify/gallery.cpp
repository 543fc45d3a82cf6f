#include "core/verify/gallery.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/analysis/reference.h"
#include "core/analysis/study_run.h"
#include "core/verify/trial.h"

namespace tyglab::verify {

std::span<const Topic> topics() {
  static const std::array all{
      Topic{"Motion", motion_cases()},       Topic{"Methods", method_cases()},  Topic{"Statics", statics_cases()},
      Topic{"Vibration", vibration_cases()}, Topic{"Bending", bending_cases()}, Topic{"Contact", contact_cases()},
      Topic{"Tearing", tearing_cases()},     Topic{"Layers", self_cases()},
  };
  return all;
}

std::vector<const Case*> all_cases() {
  std::vector<const Case*> all;
  for (const Topic& topic : topics())
    for (const Case& one : topic.cases) all.push_back(&one);
  return all;
}

const Case* find_case(std::string_view name) {
  for (const Case* one : all_cases())
    if (one->name == name) return one;
  return nullptr;
}

bool Outcome::ok() const {
  if (!problem.empty() || comparisons == 0 || !(error <= of->allowed)) return false;
  if (of->order_within == 0) return true;
  return order && std::abs(order->measured - order->expected) <= of->order_within;
}

Outcome measure(const Case& of, const Conditions& conditions) {
  Outcome outcome;
  outcome.of = &of;
  Trial trial(conditions, outcome);
  const double start = thread_seconds();
  try {
    of.measure(trial);
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    outcome.problem = error.what();
  }
  outcome.seconds = thread_seconds() - start;
  if (outcome.comparisons == 0) outcome.error = std::numeric_limits<double>::infinity();
  return outcome;
}

Preset quiet_cloth(int rows, int columns, std::string_view integrator) {
  Preset preset = bending_cloth(rows, columns, integrator);
  preset.k_b = 0;
  return preset;
}

Preset bending_cloth(int rows, int columns, std::string_view integrator) {
  Preset preset;
  preset.rows = rows, preset.columns = columns;
  preset.integrator = integrator;
  preset.precision = Precision::double_;
  preset.g = preset.k_d = 0;
  preset.tilt_deg = 90;
  preset.pins.mode = Pins::Mode::none;
  return preset;
}

Preset quiet_weight(std::string_view integrator) {
  Preset preset;
  preset.kind = Kind::one_weight;
  preset.integrator = integrator;
  preset.precision = Precision::double_;
  preset.m = 0.1, preset.k = 40;
  preset.g = preset.k_d = 0;
  return preset;
}

Preset Trial::scene(Preset preset) const {
  if (conditions_.disturb) conditions_.disturb(preset);
  return preset;
}

void Trial::show(const Simulation& simulation) const {
  show(
      simulation.lattice().sites(), [&](int i, int j) { return simulation.position(i, j); },
      [&](int i, int j) { return simulation.pinned(i, j); });
  outcome_.picture.bodies = simulation.bodies();
}

void Trial::show(const Lattice& lattice, const std::function<glm::dvec3(int, int)>& x_of,
                 const std::function<bool(int, int)>& pinned) const {
  const auto drawn = [](int count) {
    std::vector<int> all;
    const int parts = std::min(count, Picture::most) - 1;
    for (int n = 0; n <= parts; ++n) all.push_back(parts > 0 ? int(std::lround(n * double(count - 1) / parts)) : 0);
    return all;
  };
  const std::vector<int> rows = drawn(lattice.rows), columns = drawn(lattice.columns);
  Picture picture{int(rows.size()), int(columns.size()), {}, {}, {}};
  for (const int i : rows)
    for (const int j : columns) {
      if (pinned(i, j)) picture.pinned.push_back(int(picture.x.size()));
      picture.x.push_back(x_of(i, j));
    }
  outcome_.picture = std::move(picture);
}

void Trial::look() const {
  if (conditions_.stop && conditions_.stop()) throw Stopped();
}

void Trial::advance(Simulation& simulation, std::int64_t steps) const {
  constexpr std::int64_t at_once = 1 << 20;
  for (; steps > 0 && !simulation.divergence(); steps -= at_once)
    advance_study(simulation, int(std::min(steps, at_once)), conditions_.stop);
  show(simulation);
  if (simulation.divergence()) throw std::runtime_error("the motion diverged");
}

double error_of(double exact, double measured) {
  return exact == 0 ? std::abs(measured) : std::abs(measured - exact) / std::abs(exact);
}

double Trial::compare(double exact, double measured, const std::string& at) {
  const double error = error_of(exact, measured);
  // The first one, a larger one, or one that is no number.
  if (outcome_.comparisons++ == 0 || !(error <= outcome_.error)) {
    outcome_.exact = exact, outcome_.measured = measured, outcome_.at = at;
    outcome_.error = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  }
  return error;
}

void Trial::converges(double expected, std::vector<double> errors, const std::string& of) {
  const double measured = std::log2(errors[errors.size() - 2] / errors.back());
  const auto off = [](double order, double from) { return std::abs(order - from); };
  if (outcome_.order && off(measured, expected) <= off(outcome_.order->measured, outcome_.order->expected)) return;
  outcome_.order = Refinement{expected, measured, of, std::move(errors)};
}

void Trial::refine(double expected, double exact, std::initializer_list<double> h,
                   const std::function<double(double)>& measured, const std::string& of) {
  std::vector<double> errors;
  double finest = 0;
  for (const double step : h) errors.push_back(error_of(exact, finest = measured(step)));
  compare(exact, finest, of);
  converges(expected, std::move(errors), of);
}

double bisect(double low, double high, double parts, const std::function<bool(double)>& holds) {
  while (high - low > low / parts) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace tyglab::verify
