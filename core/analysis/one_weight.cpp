#include "core/analysis/one_weight.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/simulation.h"

namespace tyglab {
namespace {

/// exp(-δt) cos(wt) and exp(-δt) sin(wt)/w with w² = ω² - δ², continued to w² <= 0.
struct Waves {
  double c, s;
};

Waves waves(double omega2, double delta, double t) {
  const double w2 = omega2 - delta * delta, w = std::sqrt(std::abs(w2)), damped = std::exp(-delta * t);
  if (w * t < 1e-8) return {damped, t * damped};
  if (w2 > 0) return {damped * std::cos(w * t), damped * std::sin(w * t) / w};
  // Two decays in place of cosh and sinh, which overflow; δ - w as a quotient, since it may cancel.
  const double slow = std::exp(-omega2 / (delta + w) * t), fast = std::exp(-(delta + w) * t);
  return {(slow + fast) / 2, (slow - fast) / (2 * w)};
}

/// (exp(-z) - 1 + z)/z², z >= 0.
double second_remainder(double z) {
  if (z < 1e-2) return 0.5 - z / 6 + z * z / 24 - z * z * z / 120 + z * z * z * z / 720;
  return (std::expm1(-z) + z) / (z * z);
}

/// Without a spring: a fall, braked if k_d > 0.
WeightMotion falling(const Preset& p, double t) {
  const double y = p.x_0.y + p.offset, v = p.v_0.y, rate = p.k_d / p.m;
  const double way = rate == 0 ? t : -std::expm1(-rate * t) / rate;  // of a start with 1 m/s
  return {y + v * way - p.g * t * t * second_remainder(rate * t), v * std::exp(-rate * t) - p.g * way};
}

}  // namespace

WeightMotion exact_weight(const Preset& p, double t) {
  assert(p.kind == Kind::one_weight && t >= 0);
  if (p.k == 0) return falling(p, t);
  const double delta = p.k_d / (2 * p.m), omega2 = p.k / p.m;
  const double rest = p.x_0.y - p.m * p.g / p.k, A = p.x_0.y + p.offset - rest, v = p.v_0.y;
  const auto [c, s] = waves(omega2, delta, t);
  return {rest + A * c + (v + delta * A) * s, v * c - (delta * v + omega2 * A) * s};
}

WeightRun run_weight(const Preset& preset, int steps, const std::function<bool()>& stop) {
  WeightRun run{preset};
  Simulation simulation(preset);
  double squares = 0;
  for (int n = 0; n <= steps; ++n) {
    if (n > 0) simulation.advance(1);
    run.diverged = simulation.divergence().has_value();
    if (run.diverged || (n % 1024 == 0 && stop())) break;
    const double t = n * preset.dt;
    run.t.push_back(t), run.y.push_back(simulation.positions().at(0, 0).y);
    run.exact.push_back(exact_weight(preset, t).y);
    const double error = std::abs(run.y.back() - run.exact.back());
    run.error_largest_m = std::max(run.error_largest_m, error);
    squares += error * error;
  }
  if (run.t.size() > 1) run.error_rms_m = std::sqrt(squares / double(run.t.size() - 1));
  return run;
}

}  // namespace tyglab
