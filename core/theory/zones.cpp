#include "core/theory/zones.h"

#include <cmath>

#include "core/integrators/scheme.h"
#include "core/theory/amplification.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr double near_limit = 0.9;
constexpr double rounding = 1e-7;  // of the spectral radius, by repeated squaring

bool grows(const Scheme& method, const Mode& mode, double dt) {
  const double omega = mode.omega();
  if (omega == 0) return false;
  return spectral_radius(amplification(method, omega * dt, mode.damping / (2 * omega))) > 1 + rounding;
}

/// The value within a thousandth of which the zone becomes another.
double border(Preset preset, double Preset::*field, double from, double to, Zone zone) {
  while (to > from * 1.001) {
    const double middle = std::sqrt(from * to);
    preset.*field = middle;
    (zone_of(preset) == zone ? from : to) = middle;
  }
  return std::sqrt(from * to);
}

}  // namespace

Zone zone_of(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  if (!has_step_limit(method)) return Zone::stable;
  const Mode fastest = any_configuration(preset);
  if (grows(method, fastest, preset.dt)) return Zone::unstable;
  return grows(method, fastest, preset.dt / near_limit) ? Zone::near : Zone::stable;
}

std::vector<ZoneSpan> stability_zones(const Preset& preset, double Preset::*field, double least, double most) {
  constexpr int samples = 40;
  Preset probe = preset;
  const auto at = [&](double value) {
    probe.*field = value;
    return zone_of(probe);
  };
  std::vector<ZoneSpan> zones{{least, least, at(least)}};
  double before = least;
  for (int n = 1; n <= samples; ++n) {
    const double value = n == samples ? most : least * std::pow(most / least, double(n) / samples);
    const Zone zone = at(value);
    // Between two samples may lie more than one border: near its limit a method is only over a ninth.
    while (zone != zones.back().zone) {
      const double edge = border(preset, field, before, value, zones.back().zone);
      zones.back().to = edge;
      before = std::min(edge * 1.001, value);
      zones.push_back({edge, edge, at(before)});
    }
    zones.back().to = before = value;
  }
  const bool may_be_0 = field != &Preset::m && field != &Preset::dt && field != &Preset::L;
  if (may_be_0 && at(0) == zones.front().zone) zones.front().from = 0;
  return zones;
}

}  // namespace tyglab
