// Wind (2.16) and air on a triangle, for vectors of triangles and for a single one. Included once for each SIMD target.
#if defined(TYGLAB_WIND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_WIND_INL_H_
#undef TYGLAB_WIND_INL_H_
#else
#define TYGLAB_WIND_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {

HWY_INLINE double divided(double a, double b) {
  return a / b;
}

/// A third of F = N (N·W), what each corner takes, for the triangle with normal n, which is twice its area long; 0 for
/// a triangle of no area, which is one for which |n|² is under `smallest`, the least normal number. V3 is three
/// components of V with dot and V·V3; V brings divided(a, b).
template <class V3, class V>
HWY_INLINE V3 wind_on_corner(V3 n, V3 third_of_W, V smallest) {
  const V n2 = dot(n, n);
  return if_greater(n2, smallest, divided(dot(n, third_of_W), n2)) * n;
}

/// What the air does to a corner of the triangle with normal n, as above, where its velocity relative to the triangle
/// is u: `across`, `along` and `most` as in PairTask.
template <class V3, class V>
HWY_INLINE V3 air_on_corner(V3 n, V3 u, V across, V along, V most, V smallest) {
  const V n2 = dot(n, n), through = dot(n, u);
  const V resists = least_of(along * root(n2 * dot(u, u)), most);
  const V more = (least_of(across * absolute(through), most) - resists) * through;
  return multiply_add(if_greater(n2, smallest, divided(more, n2)), n, if_greater(n2, smallest, resists) * u);
}

}  // namespace tyglab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
