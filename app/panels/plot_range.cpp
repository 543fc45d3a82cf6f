#include <algorithm>
#include <cmath>

#include "app/panels/plot.h"

namespace tyglab {
namespace {

constexpr double most_decades = 6;

/// The finite values that the window shows, thinned to a bounded number.
std::vector<double> values_in(std::span<const double> x, std::span<const PlotCurve> curves, const PlotFrame& frame) {
  const auto first = std::size_t(std::lower_bound(x.begin(), x.end(), frame.x_min) - x.begin());
  const auto last = std::size_t(std::upper_bound(x.begin(), x.end(), frame.x_max) - x.begin());
  const std::size_t stride = std::max<std::size_t>(1, (last - first) / 1000);
  std::vector<double> values;
  for (const PlotCurve& curve : curves)
    for (std::size_t n = first; n < last; n += stride)
      if (std::isfinite(curve.y[n]) && (!frame.log || curve.y[n] > 0)) values.push_back(curve.y[n]);
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& sorted, double q) {
  return sorted[std::size_t(q * double(sorted.size() - 1))];
}

/// 1, 2 or 5 times a power of ten.
double nice_step(double span) {
  const double power = std::pow(10, std::floor(std::log10(span)));
  const double lead = span / power;
  return power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

PlotRange log_range(double least, double most) {
  PlotRange range;
  const double top = std::ceil(std::log10(most) - 1e-9);
  double bottom = std::floor(std::log10(least) + 1e-9);
  bottom = std::clamp(bottom, top - most_decades, top - 1);
  const double step = std::max(1.0, std::ceil((top - bottom) / 4));
  for (double decade = top; decade >= bottom; decade -= step) range.ticks.push_back(std::pow(10, decade));
  range.lo = std::pow(10, bottom), range.hi = std::pow(10, top);
  return range;
}

PlotRange linear_range(double least, double most, bool from_zero) {
  PlotRange range;
  if (from_zero && least > 0) least = 0;
  if (most <= least) {
    const double pad = least == 0 ? 1 : 0.1 * std::abs(least);
    most += pad;
    if (least != 0) least -= pad;
  }
  const double step = nice_step((most - least) / 4);
  range.lo = std::floor(least / step + 1e-9) * step;
  range.hi = std::ceil(most / step - 1e-9) * step;
  for (int k = 0; range.lo + k * step <= range.hi + step / 2; ++k) {
    const double tick = range.lo + k * step;
    range.ticks.push_back(std::abs(tick) < step * 1e-6 ? 0 : tick);
  }
  return range;
}

}  // namespace

PlotRange plot_range(std::span<const double> x, std::span<const PlotCurve> curves, const PlotFrame& frame) {
  const std::vector<double> values = values_in(x, curves, frame);
  if (values.empty()) return frame.log ? log_range(1e-3, 1) : linear_range(0, 1, true);
  // Nearly all of the values count; beyond three times their spread begins what leaves the scale.
  const double low = quantile(values, 0.02), high = quantile(values, 0.97);
  if (frame.log) return log_range(std::max(values.front(), low * 1e-2), std::min(values.back(), high * 1e3));
  const double reach = 3 * std::max({high - low, 0.1 * std::abs(high), 1e-300});
  return linear_range(std::max(values.front(), low - reach), std::min(values.back(), high + reach), frame.from_zero);
}

}  // namespace tyglab
