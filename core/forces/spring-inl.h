// Forces of springs (2.3) to (2.8), each formula once. V is a SIMD vector (core/simd/simd-inl.h) or a plain double.
// V provides positive(a) = max(a, 0), negative(a) = min(a, 0), if_greater(a, b, then) = then where a > b else 0,
// and over_root(h, r2, c) = 2h/√r2 + c. Included once for each SIMD target (hwy/foreach_target.h), so the guard
// toggles.
#if defined(TYGLAB_SPRING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_SPRING_INL_H_
#undef TYGLAB_SPRING_INL_H_
#else
#define TYGLAB_SPRING_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {

/// A spring shorter than this part of its rest length has no direction: its force is 0.
inline constexpr double shortest = 1e-9;

/// 2h/√r2 + c. Twice h, since a Newton step for 1/√ takes a half of its factor.
HWY_INLINE double over_root(double h, double r2, double c) {
  return 2 * h / std::sqrt(r2) + c;
}
/// a where it is positive (negative), else 0; 0 for NaN.
HWY_INLINE double positive(double a) {
  return a > 0 ? a : 0;
}
HWY_INLINE double negative(double a) {
  return a < 0 ? a : 0;
}
HWY_INLINE double if_greater(double a, double b, double then) {
  return a > b ? then : 0;
}

/// A spring's constants as the formulas take them.
template <class V>
struct Spring {
  /// `fill` makes a V of a double.
  template <class Fill>
  static HWY_INLINE Spring of(double k, double rest, Fill fill) {
    const double least = shortest * rest;
    return {fill(k), fill(-k * rest / 2), fill(least * least)};
  }
  V k;           ///< N/m
  V minus_half;  ///< -k times half of the rest length, N
  V shortest2;   ///< square of the length under which a spring has no direction
};

/// F = factor · x_ij is F_s on particle i (2.5), for r2 = |x_ij|². Pulls only: 0 while |x_ij| <= rest.
template <class V>
HWY_INLINE V stretch_factor(const Spring<V>& s, V r2) {
  return positive(over_root(s.minus_half, r2, s.k));
}

/// F = factor · x_ij is F_b on particle i (2.7, 2.8). Pushes only: 0 while |x_ij| >= rest.
template <class V>
HWY_INLINE V bend_factor(const Spring<V>& s, V r2) {
  return if_greater(r2, s.shortest2, negative(over_root(s.minus_half, r2, s.k)));
}

/// F_s of (2.5) as a number, N: what tearing compares with F_max.
HWY_INLINE double stretch_tension(double k, double rest, double r2) {
  return std::max(0.0, k * (std::sqrt(r2) - rest));
}

/// Force of the mass on a spring's two-sided spring (2.3) and its damping: F = -k (x - x_0) - k_d v.
HWY_INLINE double hooke(double x, double x_0, double k, double v, double k_d) {
  return -k * (x - x_0) - k_d * v;
}

}  // namespace tyglab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
