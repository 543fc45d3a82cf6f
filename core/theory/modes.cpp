#include "core/theory/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/theory/amplification.h"

namespace tyglab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (ω, ζ) of a mode. One without stiffness decays alone; ω so small that its decay does not depend on it any more
/// stands for it.
struct Oscillator {
  double omega, zeta;
};
Oscillator oscillator_of(const Mode& mode) {
  constexpr double overdamped = 1000;
  const double omega = std::max(mode.omega(), mode.damping / (2 * overdamped));
  return {omega, omega > 0 ? mode.damping / (2 * omega) : 0};
}

}  // namespace

double Mode::omega() const {
  return stiffness > 0 ? std::sqrt(stiffness) : 0;
}

Mode any_configuration(const Preset& p) {
  if (p.kind == Kind::one_weight) return {p.k / p.m, p.k_d / p.m};
  return {(12 * p.k_s + 8 * p.k_b) / p.m, 12 * p.k_d / p.m};
}

std::vector<Mode> worst_modes(const Preset& p) {
  const Mode fastest = any_configuration(p);
  std::vector<Mode> worst{fastest};
  if (p.kind == Kind::one_weight || p.k_d == 0) return worst;
  worst.push_back({0, fastest.damping});  // nothing pulls, but damping acts on every whole spring
  // A bending spring has no damping of its own: K <= (k_s + 4 k_b)/k_d C.
  if (p.k_b > 0) worst.push_back({fastest.stiffness, fastest.stiffness * p.k_d / (p.k_s + 4 * p.k_b)});
  return worst;
}

Spectrum any_spectrum(const Preset& p) {
  const Mode fastest = any_configuration(p);
  const double stiffness = p.kind == Kind::one_weight ? p.k : p.k_s + 4 * p.k_b;  // as in worst_modes
  return {std::max(fastest.damping, fastest.omega()),
          stiffness == 0 ? 0
          : p.k_d > 0    ? stiffness / p.k_d
                         : infinity,
          fastest.omega()};
}

double dt_crit(const Scheme& scheme, std::span<const Mode> modes) {
  double least = infinity;
  if (!has_step_limit(scheme)) return least;
  for (const Mode& mode : modes)
    if (const auto [omega, zeta] = oscillator_of(mode); omega > 0)
      least = std::min(least, stability_limit(scheme, zeta) / omega);
  return least;
}

double stiffness_margin(const Scheme& scheme, std::span<const Mode> modes, double dt) {
  if (!has_step_limit(scheme)) return infinity;
  const auto holds = [&](double factor) {
    return std::all_of(modes.begin(), modes.end(), [&](Mode mode) {
      mode.stiffness *= factor;
      const auto [omega, zeta] = oscillator_of(mode);
      return spectral_radius(amplification(scheme, omega * dt, zeta)) <= 1 + 1e-9;
    });
  };
  double low = 1e-12, high = 1e12;
  if (!holds(low)) return 0;
  if (holds(high)) return infinity;
  while (high / low > 1 + 1e-7) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

double growth_per_step(const Scheme& scheme, std::span<const Mode> modes, double dt) {
  double most = -infinity;
  if (!has_step_limit(scheme)) return most;
  for (const Mode& mode : modes)
    if (const auto [omega, zeta] = oscillator_of(mode); omega > 0)
      most = std::max(most, std::log(spectral_radius(amplification(scheme, omega * dt, zeta))));
  return most;
}

}  // namespace tyglab
