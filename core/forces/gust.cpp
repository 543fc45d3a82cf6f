#include "core/forces/gust.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyglab {
namespace {

constexpr double spans_in_a_period = 64;
constexpr double most_steps = 1e9;
constexpr double rounding = 1e-9;  // of a step: times are sums of steps

}  // namespace

double gust_wave(double t, double period) {
  const double phase = 2 * std::numbers::pi * t / period, golden = std::numbers::phi;
  return 0.5 * std::sin(phase) + 0.3 * std::sin(golden * phase + 1) + 0.2 * std::sin(golden * golden * phase + 2);
}

GustSpan gust_span(const Preset& preset, double t) {
  const double dt = preset.dt, length = preset.gust_period / spans_in_a_period, middle = t + dt / 2;
  if (dt >= length) return {1 + preset.gust * gust_wave(middle, preset.gust_period), 1};
  const double n = std::floor(middle / length + rounding);
  // Steps whose middle lies in the span.
  const double left = std::ceil(((n + 1) * length - middle) / dt - rounding);
  return {1 + preset.gust * gust_wave((n + 0.5) * length, preset.gust_period), int(std::clamp(left, 1.0, most_steps))};
}

Preset in_gusts(Preset preset, double t) {
  if (gusts(preset)) preset.W *= gust_span(preset, t).factor;
  return preset;
}

}  // namespace tyglab
