#include "app/ui/kit/curve_plot.h"

namespace tyglab {
namespace {

/// 1, 2 or 5 times a power of ten.
double nice_step(double span) {
  const double power = std::pow(10, std::floor(std::log10(span)));
  const double lead = span / power;
  return power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

}  // namespace

PlotRange log_range(double least, double most, int most_decades) {
  PlotRange range;
  const double top = std::ceil(std::log10(most) - 1e-9);
  double bottom = std::floor(std::log10(least) + 1e-9);
  bottom = std::clamp(bottom, top - most_decades, top - 1);
  const double step = std::max(1.0, std::ceil((top - bottom) / 4));
  for (double decade = top; decade >= bottom; decade -= step) {
    range.ticks.push_back(std::pow(10, decade));
    // A single decade has but two ends.
    if (top - bottom < 1.5 && decade > bottom)
      for (const double part : {0.5, 0.2}) range.ticks.push_back(part * std::pow(10, decade));
  }
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

void add_headroom(PlotRange& range, double least, double most, bool log) {
  constexpr double headroom = 0.05, share = headroom / (1 - headroom);
  if (log) {
    const double bottom = std::log10(range.lo), top = std::log10(most);
    range.hi = std::max(range.hi, std::pow(10, top + share * (top - bottom)));
    return;
  }
  if (range.lo != 0) range.lo = std::min(range.lo, least - share * (range.hi - least));
  range.hi = std::max(range.hi, most + share * (most - range.lo));
}

}  // namespace tyglab
