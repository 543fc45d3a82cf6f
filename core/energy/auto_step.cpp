#include "core/energy/auto_step.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr double least_dt = 1e-7;  // s, of presets

}  // namespace

double two_digits_below(double dt) {
  const double unit = std::pow(10, std::floor(std::log10(dt)) - 1);
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", std::floor(dt / unit * (1 + 1e-12)) * unit);
  return std::strtod(text, nullptr);
}

std::optional<double> AutoStep::choose(const Preset& preset) {
  const double limit = stable_dt(preset, preset.integrator);
  const double dt = std::min(margin * limit, longest);
  if (!(dt >= least_dt)) return std::nullopt;
  return std::max(two_digits_below(dt), least_dt);
}

std::optional<double> AutoStep::look(const Preset& preset, double t, const LedgerReading& ledger) {
  constexpr double window = 1;     // s
  constexpr double as_fast = 0.7;  // of the rate before: the least order of a method halves it
  if (in_vain()) return std::nullopt;
  const double made = ledger.made();
  if (begun_ && t >= t_ && made - made_ > allowed * ledger.scale && preset.dt / 2 >= least_dt) {
    begun_ = false;
    const double rate = (made - made_) / std::max(t - t_, preset.dt);
    in_vain_ = rate > as_fast * rate_ ? in_vain_ + 1 : 0;
    rate_ = rate;
    if (!in_vain()) return preset.dt / 2;
    return std::nullopt;
  }
  if (!begun_ || t < t_ || t - t_ >= window) begun_ = true, t_ = t, made_ = made;
  return std::nullopt;
}

}  // namespace tyglab
