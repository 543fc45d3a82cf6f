#include "core/engines/balance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/forces/force.h"

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
    const double rest = to.rest * p.L, k = scale * spring_constant(p, to);
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

  double largest_spring_force() const {
    const Preset& p = stage.preset;
    if (p.kind == Kind::one_weight) return scale * p.k * std::abs(x(0, 0, 1) - p.x_0.y);
    double most = 0;
    for (int d = 0; d < int(directions.size()); ++d)
      for (int i = 0; i < stage.lattice.rows; ++i) most = std::max(most, spring_force(d, i));
    return most;
  }
};

}  // namespace

Balance judge(const StageForces& forces, double tolerance) {
  const auto [left, largest, weight, digits, weightless] = forces;
  if (!std::isfinite(left)) return {false, std::numeric_limits<double>::infinity()};
  if (weightless && std::max(left, largest) <= digits) return {true, 0};  // nothing acts
  const double scale = std::max(largest, weight);
  // A solution within the tolerance is then rounded.
  const bool solved = left <= tolerance * scale + std::min(digits, most_excused * scale);
  return {solved, left / scale, !solved && left <= tolerance * scale + digits};
}

template <class R>
Balance balance_of(const StageView<R>& stage) {
  const Preset& p = stage.preset;
  assert(stage.h > 0 && p.m > 0);
  assert(stage.stride >= stage.lattice.columns);
  assert(stage.fixed.empty() || stage.fixed.size() >= std::size_t(stage.lattice.size()));
  assert(stage.tears.untorn() || stage.tears.lattice() == stage.lattice);
  const Measure<R> measure{stage, stage.h * stage.h / p.m};
  double left = 0, change = 0, size = 0, speed = 0;  // the first two of velocities, squared
  for (int i = 0; i < stage.lattice.rows; ++i)
    for (int j = 0; j < stage.lattice.columns; ++j) {
      if (!stage.fixed.empty() && stage.fixed[std::size_t(i) * stage.lattice.columns + j]) continue;
      double one_left = 0, one_change = 0;
      for (int c = 0; c < 3; ++c) {
        const std::ptrdiff_t n = (3 * i + c) * stage.stride + j;
        const double r = double(stage.residual[n]), dv = double(stage.v[n]) - double(stage.c_v[n]);
        one_left += r * r, one_change += dv * dv;
        size = std::max(size, std::abs(measure.x(i, j, c))), speed = std::max(speed, std::abs(double(stage.v[n])));
      }
      left = one_left <= left ? left : one_left;  // which a number that is none becomes
      change = std::max(change, one_change);
    }
  const bool weight = p.kind == Kind::one_weight;
  const Digits digits{.epsilon = std::numeric_limits<R>::epsilon(),
                      .size = size,
                      .way = stage.h * speed,
                      .stiffness = measure.scale * sum_of(&Force::at_particle, p),
                      .damping = stage.h / p.m * (weight ? 1 : 8) * p.k_d};
  return judge({.left = stage.h * std::sqrt(left),
                .largest = std::max(stage.h * std::sqrt(change), measure.largest_spring_force()),
                .weight = weight_scale(p.g, stage.h),
                .digits = last_digits(digits),
                .weightless = p.g == 0},
               balance_tolerance<R>);
}

template Balance balance_of(const StageView<float>&);
template Balance balance_of(const StageView<double>&);

}  // namespace tyglab
