#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/implicit/stiffness.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>

#include "core/engines/implicit/stiffness.h"
#include "core/simd/simd-inl.h"

#ifndef TYGLAB_STIFFNESS_TYPES_
#define TYGLAB_STIFFNESS_TYPES_
namespace tyglab::implicit {
template <class R>
using Input = const R*;
template <class R>
using Output = R*;
}  // namespace tyglab::implicit
#endif

HWY_BEFORE_NAMESPACE();
namespace tyglab::implicit::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

/// What a spring resists with when its ends are moved apart by d: t d + a (a·d). `c`: its four parts at one column.
template <class D>
HWY_INLINE Vec3<D> resistance(const hn::TFromD<D>* c, std::ptrdiff_t stride, Vec3<D> d) {
  const Vec3<D> a = Vec3<D>::load(c, stride);
  const Lanes<D> t = Lanes<D>::load(c + 3 * stride), along = dot(a, d);
  return {multiply_add(t, d.x, a.x * along), multiply_add(t, d.y, a.y * along), multiply_add(t, d.z, a.z * along)};
}

template <class R>
double multiply(const ProductTask<R>& t) {
  assert(t.columns > 0 && t.columns <= t.stride && !(t.m < 0));
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const std::ptrdiff_t stride = t.stride, pitch = 3 * stride, spring = spring_parts * stride;
  const Lanes<D> m = Lanes<D>::all(t.m);
  Lanes<D> sum;
  Carry<1, D> E, SE, SW;
  Carry<2, D> EE;
  for (int j = 0; j < t.columns; j += lanes) {
    const R *c = t.coefficients + j, *p = t.p + j, *below = p + pitch;
    R* q = t.q + j;
    const V here = V::load(p, stride), right = V::load(p + 1, stride), under = V::load(below, stride);
    const V f_E = resistance<D>(c, stride, right - here);
    const V f_S = resistance<D>(c + spring, stride, under - here);
    const V f_SE = resistance<D>(c + 2 * spring, stride, V::load(below + 1, stride) - here);
    const V f_SW = resistance<D>(c + 3 * spring, stride, under - right);
    const V f_EE = resistance<D>(c + 4 * spring, stride, V::load(p + 2, stride) - here);
    const V f_SS = resistance<D>(c + 5 * spring, stride, V::load(below + pitch, stride) - here);
    // q_i = m p_i - Σ of what the springs to its other ends resist with; the other ends take the opposite.
    V own = V(m * here.x, m * here.y, m * here.z) - (f_E + f_S + (f_SE + (f_EE + f_SS)));
    own = own + (E(f_E) - SW(f_SW)) + EE(f_EE);
    V next = f_S + f_SW + SE(f_SE);
    if (!t.first) own = own + V::load(q, stride), next = next + V::load(q + pitch, stride);
    own.store(q, stride);
    next.store(q + pitch, stride);
    f_SS.store(q + 2 * pitch, stride);
    sum = sum + dot(own, here);
  }
  return double(hn::GetLane(hn::SumOfLanes(D(), sum.v)));
}

template <class R>
Residual update(const UpdateTask<R>& t) {
  assert(t.columns > 0 && t.columns <= t.stride);
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  using L = Lanes<D>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const std::ptrdiff_t stride = t.stride;
  const L alpha = L::all(t.alpha), minus = L::all(-t.alpha);
  L squared, preconditioned;
  for (int j = 0; j < t.columns; j += lanes) {
    multiply_add(alpha, V::load(t.p + j, stride), V::load(t.d + j, stride)).store(t.d + j, stride);
    const R* b = t.blocks + j;
    const V diagonal = V::load(b, stride), mixed = V::load(b + 3 * stride, stride);
    // Where the block is 0 a particle is fixed: what pulls at it is no residual.
    const V r = where<D>(hn::Gt(diagonal.x.v, hn::Zero(D())),
                         multiply_add(minus, V::load(t.q + j, stride), V::load(t.r + j, stride)));
    r.store(t.r + j, stride);
    const V z(multiply_add(diagonal.x, r.x, multiply_add(mixed.z, r.y, mixed.y * r.z)),
              multiply_add(mixed.z, r.x, multiply_add(diagonal.y, r.y, mixed.x * r.z)),
              multiply_add(mixed.y, r.x, multiply_add(mixed.x, r.y, diagonal.z * r.z)));
    z.store(t.z + j, stride);
    squared = squared + dot(r, r), preconditioned = preconditioned + dot(r, z);
  }
  return {double(hn::GetLane(hn::SumOfLanes(D(), squared.v))),
          double(hn::GetLane(hn::SumOfLanes(D(), preconditioned.v)))};
}

template <class R>
void add_scaled(const R* x, double beta, R* y, int count) {
  assert(count >= 0 && x != y);
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  const L factor = L::all(beta);
  for (int j = 0; j < count; j += int(hn::MaxLanes(D())))
    multiply_add(factor, L::load(y + j), L::load(x + j)).store(y + j);
}

template <class R>
double inner(const R* a, const R* b, int count) {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  L sum;
  for (int j = 0; j < count; j += int(hn::MaxLanes(D()))) sum = multiply_add(L::load(a + j), L::load(b + j), sum);
  return double(hn::GetLane(hn::SumOfLanes(D(), sum.v)));
}

#define TYGLAB_DEFINE(R, name)                                       \
  double multiply_##name(const ProductTask<R>& t) {                  \
    return multiply(t);                                              \
  }                                                                  \
  Residual update_##name(const UpdateTask<R>& t) {                   \
    return update(t);                                                \
  }                                                                  \
  void add_##name(Input<R> x, double beta, Output<R> y, int count) { \
    add_scaled(x, beta, y, count);                                   \
  }                                                                  \
  double dot_##name(Input<R> a, Input<R> b, int count) {             \
    return inner(a, b, count);                                       \
  }
TYGLAB_DEFINE(float, float)
TYGLAB_DEFINE(double, double)
#undef TYGLAB_DEFINE

}  // namespace tyglab::implicit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::implicit {

#define TYGLAB_DISPATCH(R, name)                                         \
  HWY_EXPORT(multiply_##name);                                           \
  HWY_EXPORT(update_##name);                                             \
  HWY_EXPORT(add_##name);                                                \
  HWY_EXPORT(dot_##name);                                                \
  template <>                                                            \
  double multiply_row(const ProductTask<R>& t) {                         \
    return HWY_DYNAMIC_DISPATCH(multiply_##name)(t);                     \
  }                                                                      \
  template <>                                                            \
  Residual update_row(const UpdateTask<R>& t) {                          \
    return HWY_DYNAMIC_DISPATCH(update_##name)(t);                       \
  }                                                                      \
  template <>                                                            \
  void add_scaled_row(Input<R> x, double beta, Output<R> y, int count) { \
    HWY_DYNAMIC_DISPATCH(add_##name)(x, beta, y, count);                 \
  }                                                                      \
  template <>                                                            \
  double dot_row(Input<R> a, Input<R> b, int count) {                    \
    return HWY_DYNAMIC_DISPATCH(dot_##name)(a, b, count);                \
  }
TYGLAB_DISPATCH(float, float)
TYGLAB_DISPATCH(double, double)
#undef TYGLAB_DISPATCH

}  // namespace tyglab::implicit
#endif
