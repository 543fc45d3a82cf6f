#include "core/forces/gust.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyglab {
namespace {

constexpr double spans_in_a_period = 64;
constexpr double most_steps = 1e9;
constexpr double rounding = 1e-6;  // of a step: times are sums of steps

}  // namespace

double gust_wave(double t, double period) {
  const double phase = 2 * std::numbers::pi * t / period, golden = std::numbers::phi;
  return 0.5 * std::sin(phase) + 0.3 * std::sin(golden * phase + 1) + 0.2 * std::sin(golden * golden * phase + 2);
}

GustSpan gust_span(const Preset& preset, double t) {
  const double dt = preset.dt, length = preset.gust_period / spans_in_a_period;
  const auto factor = [&](double at) { return 1 + preset.gust * gust_wave(at, preset.gust_period); };
  if (dt >= length) return {factor(t + dt / 2), 1};
  const double n = std::floor((t + rounding * dt) / length), middle = (n + 0.5) * length;
  const double left = ((n + 1) * length - t) / dt;  // steps, in this span
  if (const double whole = std::floor(left + rounding); whole >= 1)
    return {factor(middle), int(std::min(whole, most_steps))};
  return {left * factor(middle) + (1 - left) * factor(middle + length), 1};
}

Preset in_gusts(Preset preset, double t) {
  if (gusts(preset)) preset.W *= gust_span(preset, t).factor;
  return preset;
}

}  // namespace tyglab
