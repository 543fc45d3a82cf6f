#include "core/integrators/stabilized.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace tyglab {
namespace {

constexpr double slow = 0.5;  // |λ| h up to which an undamped oscillation hardly grows

}  // namespace

double longest_step(const Scheme& scheme, const Spectrum& spectrum) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (spectrum.radius == 0) return infinity;
  double longest = 0, best = 0;
  for (const StageTable& table : scheme.tables) {
    const double by_circle =
        spectrum.fastest > 0 ? std::max(table.disc / spectrum.circle, slow / spectrum.fastest) : infinity;
    const double h = std::min(table.reach / spectrum.radius, by_circle);
    if (h / table.stages > best) best = h / table.stages, longest = h;
  }
  return longest;
}

std::size_t table_for(const Scheme& scheme, const Spectrum& spectrum, double h) {
  assert(!scheme.tables.empty());
  const double size = spectrum.fastest > 0 ? h * spectrum.circle : 0;
  const bool any = h * spectrum.fastest <= slow || size > scheme.tables.back().disc;
  const auto fits = [&](const StageTable& table) {
    return h * spectrum.radius <= table.reach && (any || size <= table.disc);
  };
  const auto found = std::find_if(scheme.tables.begin(), scheme.tables.end() - 1, fits);
  return std::size_t(found - scheme.tables.begin());
}

}  // namespace tyglab
