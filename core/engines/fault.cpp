#include "core/engines/fault.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/simd/row_distances.h"

namespace tyglab {
namespace {

constexpr double longest_factor = 1000;  // a spring longer than that many rest lengths has diverged

/// Whether all values of a row are finite. The loop does not stop early, so that the compiler can use SIMD.
template <class R>
bool finite_row(const R* field, std::ptrdiff_t stride, int i, int columns) {
  int bad = 0;
  for (int c = 0; c < 3; ++c) {
    const R* row = StateView<R>::row(field, stride, i, c);
    for (int j = 0; j < columns; ++j) bad |= int(!(std::abs(row[j]) <= std::numeric_limits<R>::max()));
  }
  return bad == 0;
}

template <class R>
bool finite(const Lattice& lattice, const StateView<R>& state, Fault& fault) {
  for (int i = 0; i < lattice.rows; ++i) {
    if (finite_row(state.x, state.stride, i, lattice.columns) && finite_row(state.v, state.stride, i, lattice.columns))
      continue;
    for (int j = 0; j < lattice.columns; ++j)
      for (const bool position : {true, false})
        for (int c = 0; c < 3; ++c) {
          const double value = position ? state.x_row(i, c)[j] : state.v_row(i, c)[j];
          if (std::isfinite(value)) continue;
          fault = {i, j, position ? "position" : "velocity", value};
          return false;
        }
  }
  return true;
}

/// By how much any spring of a row in one direction may still grow, m; less than 0: `fault` is too long.
template <class R>
double growth_left(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state, int d,
                   int i, Fault& fault) {
  const Direction& dir = directions[d];
  const double bound = longest_factor * dir.rest * preset.L;
  const int columns = lattice.columns;
  const int begin = std::max(0, -dir.dj), end = columns - std::max(0, dir.dj);
  if (begin >= end) return bound;
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be too long or torn.
  const std::uint8_t* masks = tears.row(i);
  if (masks == nullptr || std::all_of(masks + begin, masks + end, [&](auto mask) { return (mask >> d & 1) != 0; })) {
    const R longest =
        simd::longest_squared(state.x_row(i, 0), state.stride, dir.di * 3 * state.stride + dir.dj, begin, end);
    const double left = bound - std::sqrt(double(longest)) * (1 + rounding<R>);
    if (left >= 0) return left;
  }
  double slack = bound;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j)) continue;
    const double length = std::sqrt(distance2(state, i, j, dir));
    if (bound - length < 0) fault = {i, j, "spring length", length, dir.di, dir.dj};
    if (bound - length < 0) return bound - length;
    slack = std::min(slack, bound - length);
  }
  return slack;
}

template <class R>
bool within_bounds(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                   Fault& fault, double& divergence_budget) {
  double slack = std::numeric_limits<double>::infinity();
  if (preset.kind == Kind::one_weight) {
    const double bound = longest_factor * std::max(preset.L, std::abs(preset.offset));
    const double away = std::abs(double(state.x_row(0, 1)[0]) - preset.x_0.y);
    fault = {0, 0, "distance from x_0", away};
    divergence_budget = bound - away;
    return divergence_budget >= 0;
  }
  for (int d = 0; d < int(directions.size()); ++d)
    for (int i = 0; i + directions[d].di < lattice.rows; ++i) {
      slack = std::min(slack, growth_left(preset, lattice, tears, state, d, i, fault));
      if (slack < 0) return false;
    }
  divergence_budget = slack;
  return true;
}

}  // namespace

double max_elongation(double max_displacement) {
  return 2 * std::numbers::sqrt3 * max_displacement;
}

template <class R>
double growth_left(const Preset& preset, const LongestSquared& longest) {
  double slack = std::numeric_limits<double>::infinity();
  for (const auto& [direction, squared] : {std::pair(0, longest.straight), std::pair(2, longest.diagonal),
                                           std::pair(int(stretch_directions), longest.bending)}) {
    const double left = longest_factor * directions[direction].rest * preset.L - std::sqrt(squared) * (1 + rounding<R>);
    if (!(left >= slack)) slack = left;
  }
  return slack;
}

template <class R>
double distance2(const StateView<R>& state, int i, int j, const Direction& to) {
  double r2 = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = double(state.x_row(i + to.di, c)[j + to.dj]) - double(state.x_row(i, c)[j]);
    r2 += d * d;
  }
  return r2;
}

template <class R>
bool find_fault(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                Fault& fault, double& divergence_budget) {
  return !finite(lattice, state, fault) || !within_bounds(preset, lattice, tears, state, fault, divergence_budget);
}

template double growth_left<float>(const Preset&, const LongestSquared&);
template double growth_left<double>(const Preset&, const LongestSquared&);
template double distance2(const StateView<float>&, int, int, const Direction&);
template double distance2(const StateView<double>&, int, int, const Direction&);
template bool find_fault(const Preset&, const Lattice&, const Tears&, const StateView<float>&, Fault&, double&);
template bool find_fault(const Preset&, const Lattice&, const Tears&, const StateView<double>&, Fault&, double&);

}  // namespace tyglab
