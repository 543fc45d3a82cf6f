// Wind on a triangle (2.16), once for vectors of triangles and for one. Included once for each SIMD target.
#if defined(TYGLAB_WIND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_WIND_INL_H_
#undef TYGLAB_WIND_INL_H_
#else
#define TYGLAB_WIND_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {

/// A third of F = N (N·W), what each corner takes, for the triangle with edges e1, e2 from one corner; 0 for a triangle
/// of no area, which is one for which the square of twice its area is under `smallest`, the least normal number.
/// V3 is three components of V with cross, dot and V·V3.
template <class V3, class V>
HWY_INLINE V3 wind_on_corner(V3 e1, V3 e2, V3 W, V third, V smallest) {
  const V3 n = cross(e1, e2);
  const V n2 = dot(n, n);
  return if_greater(n2, smallest, third * dot(n, W) / n2) * n;
}

}  // namespace tyglab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
