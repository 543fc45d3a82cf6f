#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/implicit/barrier_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/cloth/lattice.h"
#include "core/engines/implicit/barrier_rows.h"
#include "core/engines/implicit/stiffness.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::implicit::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using L = Lanes<D>;
using V = Vec3<D>;
constexpr int lanes = int(hn::MaxLanes(D()));
constexpr double shortest = 1e-9;  // of its rest length, under which a spring has no direction

HWY_INLINE L larger(L a, L b) {
  return hn::Max(a.v, b.v);
}

/// A spring between two ends: its direction from the owner on, 0 if it has none, and its length.
struct Length {
  V n;
  L r;
};
HWY_INLINE Length length_of(V apart, double rest) {
  const L least = L::all(shortest * rest), r = hn::Sqrt(dot(apart, apart).v), per = L::all(1) / larger(r, least);
  return {per * apart, r};
}

/// From the owner (SW: the upper end) of the spring of direction d at column j to its other end, in field p.
template <int d>
HWY_INLINE V apart(const double* p, std::ptrdiff_t stride) {
  const std::ptrdiff_t pitch = 3 * stride;
  if constexpr (d == 0) return V::load(p + 1, stride) - V::load(p, stride);
  if constexpr (d == 1) return V::load(p + pitch, stride) - V::load(p, stride);
  if constexpr (d == 2) return V::load(p + pitch + 1, stride) - V::load(p, stride);
  if constexpr (d == 3) return V::load(p + pitch, stride) - V::load(p + 1, stride);
  if constexpr (d == 4) return V::load(p + 2, stride) - V::load(p, stride);
  if constexpr (d == 5) return V::load(p + 2 * pitch, stride) - V::load(p, stride);
}

/// Calls what(direction) for each, the direction a constant.
template <class What, int... d>
HWY_INLINE void for_each(const What& what, std::integer_sequence<int, d...>) {
  (what(std::integral_constant<int, d>()), ...);
}
using Stretch = std::make_integer_sequence<int, stretch_directions>;

/// The forces of one block of columns on the springs' owners; scatters them to both ends.
struct Scatter {
  HWY_INLINE Scatter() {}
  Carry<1, D> E, SE, SW;
  Carry<2, D> EE;
  HWY_INLINE void operator()(const V* f, double* to, std::ptrdiff_t stride) {
    const std::ptrdiff_t pitch = 3 * stride;
    const V own = f[0] + f[1] + (f[2] + (f[4] + f[5])) - (E(f[0]) - SW(f[3])) - EE(f[4]);
    (V::load(to, stride) + own).store(to, stride);
    (V::load(to + pitch, stride) - (f[1] + f[3] + SE(f[2]))).store(to + pitch, stride);
    (V::load(to + 2 * pitch, stride) - f[5]).store(to + 2 * pitch, stride);
  }
};

/// A stretch spring with its tension and slack.
struct Taut {
  V n;
  L r, tension, slack, whole;
  L gap;  ///< r - rest - tension/k + slack
  L per;  ///< k/(tension + k slack)
};
template <int d>
HWY_INLINE Taut taut(const BarrierRow& row, int j) {
  const double rest = directions[d].rest * row.constants.L;
  const std::ptrdiff_t at = d * row.stride + j;
  const Length length = length_of(apart<d>(row.x + j, row.stride), rest);
  const L k = L::all(row.constants.stretch[d]), tension = L::load(row.tension + at), slack = L::load(row.slack + at);
  const L gap = length.r - L::all(rest) - tension * L::all(1 / row.constants.stretch[d]) + slack;
  return {length.n, length.r, tension, slack, L::load(row.whole + at), gap, k / multiply_add(k, slack, tension)};
}

void begin(const BarrierRow& row, double mu) {
  const auto one = [&](auto d) HWY_ATTR {
    const double rest = directions[d].rest * row.constants.L;
    const double k = row.constants.stretch[d];
    const L half = L::all(k / 2), root = L::all(4 * mu / k), fill = L::all(mu);
    for (int j = 0; j < row.columns; j += lanes) {
      const L r = hn::Sqrt(dot(apart<d>(row.x + j, row.stride), apart<d>(row.x + j, row.stride)).v);
      const L longer = r - L::all(rest), both = hn::Sqrt(multiply_add(longer, longer, root).v);
      // Of t²/k - longer·t - μ = 0 the positive solution, without a difference of like numbers.
      const L sum = L(hn::Abs(longer.v)) + both;
      const L tension = hn::IfThenElse(hn::Gt(longer.v, hn::Zero(D())), (half * sum).v, ((fill + fill) / sum).v);
      tension.store(row.tension + d * row.stride + j);
      (fill / tension).store(row.slack + d * row.stride + j);
    }
  };
  for_each(one, Stretch());
}

/// Stores numbers in the precision of the linear system.
template <class R>
HWY_INLINE void store_as(L value, R* to) {
  if constexpr (sizeof(R) == sizeof(double)) {
    value.store(to);
  } else {
    constexpr hn::Rebind<float, D> single;
    hn::StoreU(hn::DemoteTo(single, value.v), single, to);
  }
}
template <class R>
HWY_INLINE void store_spring(V a, L t, R* to, std::ptrdiff_t stride) {
  store_as(a.x, to), store_as(a.y, to + stride), store_as(a.z, to + 2 * stride), store_as(t, to + 3 * stride);
}

/// Adds to numbers in that precision.
template <class R>
HWY_INLINE void add_across(L value, R* to) {
  if constexpr (sizeof(R) == sizeof(double)) {
    (L::load(to) + value).store(to);
  } else {
    constexpr hn::Rebind<float, D> single;
    store_as(L(hn::PromoteTo(D(), hn::LoadU(single, to))) + value, to);
  }
}

template <class R>
BarrierSums linearize(const BarrierRow& row, double* forces, double* right, R* coefficients, std::ptrdiff_t to) {
  const std::ptrdiff_t stride = row.stride;
  const L push_k = L::all(row.constants.bend), k_d = L::all(row.constants.damping);
  Scatter scatter_forces, scatter_right;
  L products, force;
  for (int j = 0; j < row.columns; j += lanes) {
    V f[6], g[6];
    const auto stretch = [&](auto d) HWY_ATTR {
      const std::ptrdiff_t at = d * stride + j;
      const L k_s = L::all(row.constants.stretch[d]);
      Taut spring = taut<d>(row, j);
      // The gap that is negative is filled up by slack.
      const L fill = L(hn::Zero(D())) - negative(spring.gap);
      spring.slack = spring.slack + fill, spring.gap = spring.gap + fill;
      spring.slack.store(row.slack + at);
      const L along = k_s * spring.tension / multiply_add(k_s, spring.slack, spring.tension);
      const L rest = L::all(directions[d].rest * row.constants.L);
      const L pull = positive(k_s * (spring.r - rest)) * spring.whole;
      const L damping = k_d * spring.whole;
      const V damped = damping * (apart<d>(row.x + j, stride) - apart<d>(row.c + j, stride));
      f[d] = multiply_add(pull, spring.n, damped);
      g[d] = multiply_add((spring.tension + along * (spring.gap - spring.slack)) * spring.whole, spring.n, damped);
      const L across = L(hn::Min((spring.tension / larger(spring.r, L::all(0.01) * rest)).v, along.v));
      const L root = hn::Sqrt(((along - across) * spring.whole).v);
      store_spring(root * spring.n, multiply_add(across, spring.whole, damping),
                   coefficients + d * spring_parts * to + j, to);
      products = products + spring.tension * spring.slack * spring.whole, force = larger(force, pull);
    };
    for_each(stretch, Stretch());
    const auto bend = [&](auto d) HWY_ATTR {
      const double rest = directions[d].rest * row.constants.L;
      const Length length = length_of(apart<d>(row.x + j, stride), rest);
      const L whole = L::load(row.whole + d * stride + j);
      const L shorter = negative(length.r - L::all(rest));
      const L push = if_greater(length.r, L::all(shortest * rest), push_k * shorter * whole);
      f[d] = g[d] = push * length.n;
      const L root = hn::Sqrt(L(hn::IfThenElseZero(hn::Lt(push.v, hn::Zero(D())), push_k.v)).v);
      store_spring(root * length.n, L(), coefficients + d * spring_parts * to + j, to);
      force = larger(force, L(hn::Neg(push.v)));
    };
    for_each(bend, std::integer_sequence<int, 4, 5>());
    const auto add_linear = [&](auto d) HWY_ATTR {
      const L constant = L::load(row.linear + d * stride + j);
      const V pull = constant * apart<d>(row.x + j, stride);
      f[d] = f[d] + pull, g[d] = g[d] + pull;
      add_across(constant, coefficients + (d * spring_parts + 3) * to + j);
    };
    if (row.linear != nullptr) for_each(add_linear, std::make_integer_sequence<int, springs_of_a_particle>());
    scatter_forces(f, forces + j, stride), scatter_right(g, right + j, stride);
  }
  return {hn::GetLane(hn::SumOfLanes(D(), products.v)), hn::GetLane(hn::MaxOfLanes(D(), force.v))};
}

/// σμ less the product of the last step's parts.
HWY_INLINE L target(const BarrierRow& row, std::ptrdiff_t at, L mu) {
  return mu - L::load(row.d_tension + at) * L::load(row.d_slack + at);
}

void correct(const BarrierRow& row, double mu, double* right) {
  Scatter scatter;
  for (int j = 0; j < row.columns; j += lanes) {
    V f[6];
    const auto stretch = [&](auto d) HWY_ATTR {
      const Taut spring = taut<d>(row, j);
      f[d] = (target(row, d * row.stride + j, L::all(mu)) * spring.per * spring.whole) * spring.n;
    };
    for_each(stretch, Stretch());
    scatter(f, right + j, row.stride);
  }
}

BarrierStep step(const BarrierRow& row, const double* moved, bool corrects, double mu) {
  const std::ptrdiff_t stride = row.stride;
  L tension, slack, with_slack, with_tension, both;
  for (int j = 0; j < row.columns; j += lanes) {
    const auto stretch = [&](auto d) HWY_ATTR {
      const std::ptrdiff_t at = d * stride + j;
      const Taut spring = taut<d>(row, j);
      const L one = L::all(1), longer = dot(spring.n, apart<d>(moved + j, stride));
      const L goal = corrects ? target(row, at, L::all(mu)) : L(), per_tension = one / spring.tension;
      const L over = goal * per_tension - spring.slack;
      const L d_tension = spring.whole * (spring.per * spring.tension * (longer + spring.gap + over));
      const L d_slack = spring.whole * (over - spring.slack * per_tension * d_tension);
      d_tension.store(row.d_tension + at), d_slack.store(row.d_slack + at);
      const L none = L::all(0);
      tension = larger(tension, (none - d_tension) * per_tension);
      slack = larger(slack, (none - d_slack) / spring.slack);
      with_slack = multiply_add(spring.tension, d_slack, with_slack);
      with_tension = multiply_add(spring.slack, d_tension, with_tension);
      both = multiply_add(d_tension, d_slack, both);
    };
    for_each(stretch, Stretch());
  }
  const auto sum = [](L of) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(D(), of.v)); };
  const auto most = [](L of) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(D(), of.v)); };
  return {most(tension), most(slack), sum(with_slack), sum(with_tension), sum(both)};
}

double finish(const double* x, const double* y, const double* free, double* forces, double* right,
              std::ptrdiff_t stride, int columns) {
  L most;
  for (int j = 0; j < columns; j += lanes) {
    const V own = V::load(y + j, stride) - V::load(x + j, stride);
    const L moves = L::load(free + j);
    const V residual = moves * (own + V::load(forces + j, stride));
    residual.store(forces + j, stride);
    (moves * (own + V::load(right + j, stride))).store(right + j, stride);
    most = larger(most, dot(residual, residual));
  }
  return hn::GetLane(hn::Sqrt(hn::MaxOfLanes(D(), most.v)));
}

BarrierSums linearize_float(const BarrierRow& row, double* forces, double* right, float* to, std::ptrdiff_t stride) {
  return linearize(row, forces, right, to, stride);
}
BarrierSums linearize_double(const BarrierRow& row, double* forces, double* right, double* to, std::ptrdiff_t stride) {
  return linearize(row, forces, right, to, stride);
}

}  // namespace tyglab::implicit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::implicit {

HWY_EXPORT(begin);
HWY_EXPORT(linearize_float);
HWY_EXPORT(linearize_double);
HWY_EXPORT(correct);
HWY_EXPORT(step);
HWY_EXPORT(finish);

void begin_tensions(const BarrierRow& row, double mu) {
  HWY_DYNAMIC_DISPATCH(begin)(row, mu);
}

template <>
BarrierSums linearize_row(const BarrierRow& row, double* forces, double* right, float* to, std::ptrdiff_t stride) {
  return HWY_DYNAMIC_DISPATCH(linearize_float)(row, forces, right, to, stride);
}

template <>
BarrierSums linearize_row(const BarrierRow& row, double* forces, double* right, double* to, std::ptrdiff_t stride) {
  return HWY_DYNAMIC_DISPATCH(linearize_double)(row, forces, right, to, stride);
}

void correct_row(const BarrierRow& row, double mu, double* right) {
  HWY_DYNAMIC_DISPATCH(correct)(row, mu, right);
}

BarrierStep step_row(const BarrierRow& row, const double* step, bool corrects, double mu) {
  return HWY_DYNAMIC_DISPATCH(step)(row, step, corrects, mu);
}

double finish_row(const double* x, const double* y, const double* free, double* forces, double* right,
                  std::ptrdiff_t stride, int columns) {
  return HWY_DYNAMIC_DISPATCH(finish)(x, y, free, forces, right, stride, columns);
}

}  // namespace tyglab::implicit
#endif
