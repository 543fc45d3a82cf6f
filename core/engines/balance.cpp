#include "core/engines/balance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tyglab {
namespace {

template <class R>
struct Measure {
  const StageView<R>& stage;
  double scale;  // h²/m

  double x(int i, int j, int c) const { return double(stage.x[(3 * i + c) * stage.stride + j]); }

  /// The largest force of a row's springs of one direction, m.
  double spring_force(int d, int i) const {
    const Direction& to = directions[std::size_t(d)];
    const Preset& p = stage.preset;
    const double rest = to.rest * p.L, k = scale * (to.bending ? p.k_b : p.k_s);
    double most = 0;
    for (int j = 0; j < stage.lattice.columns; ++j) {
      if (!stage.lattice.has_spring(d, i, j) || !stage.tears.whole(d, i, j)) continue;
      double squared = 0;
      for (int c = 0; c < 3; ++c) {
        const double along = x(i + to.di, j + to.dj, c) - x(i, j, c);
        squared += along * along;
      }
      const double longer = std::sqrt(squared) - rest;
      most = std::max(most, k * (to.bending ? -longer : longer));
    }
    return most;
  }

  double largest_force() const {
    const Preset& p = stage.preset;
    double most = scale * p.m * p.g;
    if (p.kind == Kind::one_weight) return std::max(most, scale * p.k * std::abs(x(0, 0, 1) - p.x_0.y));
    for (int d = 0; d < int(directions.size()); ++d)
      for (int i = 0; i < stage.lattice.rows; ++i) most = std::max(most, spring_force(d, i));
    return most;
  }
};

}  // namespace

template <class R>
Balance balance_of(const StageView<R>& stage) {
  const Preset& p = stage.preset;
  assert(stage.h > 0 && p.m > 0);
  assert(stage.stride >= stage.lattice.columns);
  assert(stage.fixed.empty() || stage.fixed.size() >= std::size_t(stage.lattice.size()));
  assert(stage.tears.untorn() || stage.tears.lattice() == stage.lattice);
  const Measure<R> measure{stage, stage.h * stage.h / p.m};
  double squared = 0, size = 0;
  for (int i = 0; i < stage.lattice.rows; ++i)
    for (int j = 0; j < stage.lattice.columns; ++j) {
      if (!stage.fixed.empty() && stage.fixed[std::size_t(i) * stage.lattice.columns + j]) continue;
      double one = 0;
      for (int c = 0; c < 3; ++c) {
        const double r = double(stage.residual[(3 * i + c) * stage.stride + j]);
        one += r * r, size = std::max(size, std::abs(measure.x(i, j, c)));
      }
      if (!std::isfinite(one)) return {false, std::numeric_limits<double>::infinity()};
      squared = std::max(squared, one);
    }
  const double left = stage.h * std::sqrt(squared);
  const double k = p.kind == Kind::one_weight ? p.k : std::max(p.k_s, p.k_b);
  const double least = last_digits(std::numeric_limits<R>::epsilon(), size, measure.scale * k);
  const double force = measure.largest_force();
  if (left <= std::max(balance_tolerance<R> * force, least)) return {true, force > 0 ? left / force : 0};
  return {false, force > 0 ? left / force : std::numeric_limits<double>::infinity()};
}

template Balance balance_of(const StageView<float>&);
template Balance balance_of(const StageView<double>&);

}  // namespace tyglab
