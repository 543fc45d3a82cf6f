// What the sweep needs of Highway beyond its own operations, for the target that is being compiled. Included once for
// each target (hwy/foreach_target.h), so the guard toggles.
#if defined(TYGLAB_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_SIMD_INL_H_
#undef TYGLAB_SIMD_INL_H_
#else
#define TYGLAB_SIMD_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A vector of N numbers and the operations that the formulas use.
template <class D>
struct Lanes {
  using V = hn::Vec<D>;
  using T = hn::TFromD<D>;
  V v;

  HWY_INLINE Lanes() : v(hn::Zero(D())) {}
  HWY_INLINE Lanes(V from) : v(from) {}
  static HWY_INLINE Lanes all(double value) { return hn::Set(D(), T(value)); }
  static HWY_INLINE Lanes load(const T* p) { return hn::LoadU(D(), p); }
  static HWY_INLINE Lanes load_aligned(const T* p) { return hn::Load(D(), p); }
  HWY_INLINE void store(T* p) const { hn::Store(v, D(), p); }
  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
  friend HWY_INLINE Lanes multiply_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
  friend HWY_INLINE Lanes if_greater(Lanes a, Lanes b, Lanes yes, Lanes no) {
    return hn::IfThenElse(hn::Gt(a.v, b.v), yes.v, no.v);
  }
  /// 1/sqrt(r2). In float the hardware's approximation and one Newton step (Hennessy, Patterson: y + y/2 (1 - r2 y²)),
  /// within 2 ulp; in double exact roots and quotients.
  friend HWY_INLINE Lanes inverse_sqrt(Lanes r2) {
    if constexpr (sizeof(T) == 4) {
      const V y = hn::ApproximateReciprocalSqrt(r2.v);
      const V error = hn::NegMulAdd(hn::Mul(r2.v, y), y, hn::Set(D(), T(1)));
      return hn::MulAdd(hn::Mul(y, hn::Set(D(), T(0.5))), error, y);
    } else {
      return hn::Div(hn::Set(D(), T(1)), hn::Sqrt(r2.v));
    }
  }
};

/// Lanes moved up by n (1 or 2); the lowest come from the top of `before`: what lane j-n held, for each j.
template <int n, class D>
HWY_INLINE Lanes<D> from_left(Lanes<D> before, Lanes<D> now) {
#if HWY_TARGET == HWY_SCALAR
  (void)now;
  return before;
#else
  [[maybe_unused]] constexpr D d;
  using T = hn::TFromD<D>;
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  if constexpr (sizeof(T) == 4) {
    return typename Lanes<D>::V{_mm512_castsi512_ps(
        _mm512_alignr_epi32(_mm512_castps_si512(now.v.raw), _mm512_castps_si512(before.v.raw), 16 - n))};
  } else {
    return typename Lanes<D>::V{_mm512_castsi512_pd(
        _mm512_alignr_epi64(_mm512_castpd_si512(now.v.raw), _mm512_castpd_si512(before.v.raw), 8 - n))};
  }
#elif HWY_TARGET == HWY_AVX2
  // [before's upper half, now's lower half], then a shift inside each half.
  const auto middle = hn::ConcatLowerUpper(d, now.v, before.v);
  if constexpr (n * sizeof(T) == 16)
    return middle;
  else
    return hn::CombineShiftRightBytes<16 - n * sizeof(T)>(d, now.v, middle);
#else
  if constexpr (n * sizeof(T) == 16)
    return before;
  else
    return hn::CombineShiftRightBytes<16 - n * sizeof(T)>(d, now.v, before.v);
#endif
#endif
}

/// Three components.
template <class D>
struct Vec3 {
  using Tag = D;
  using L = Lanes<D>;
  using T = hn::TFromD<D>;
  L x, y, z;
  // Written out: what the compiler generates by itself it generates for the baseline, and cannot inline here.
  HWY_INLINE Vec3() {}
  HWY_INLINE Vec3(L a, L b, L c) : x(a), y(b), z(c) {}
  static HWY_INLINE Vec3 load(const T* const* p, std::ptrdiff_t at) {
    return {L::load(p[0] + at), L::load(p[1] + at), L::load(p[2] + at)};
  }
  HWY_INLINE void store(T* const* p, std::ptrdiff_t at) const {
    x.store(p[0] + at), y.store(p[1] + at), z.store(p[2] + at);
  }
  friend HWY_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HWY_INLINE Vec3 operator*(L a, Vec3 b) { return {a * b.x, a * b.y, a * b.z}; }
  friend HWY_INLINE Vec3 multiply_add(L a, Vec3 b, Vec3 c) {
    return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)};
  }
  friend HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend HWY_INLINE L dot(Vec3 a, Vec3 b) { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
};

/// Where the mask is set, else 0.
template <class D>
HWY_INLINE Vec3<D> where(hn::Mask<D> mask, Vec3<D> v) {
  return {hn::IfThenElseZero(mask, v.x.v), hn::IfThenElseZero(mask, v.y.v), hn::IfThenElseZero(mask, v.z.v)};
}

/// Carries forces on the right ends of springs over to the lanes of those ends, block after block along a row.
template <int n, class D>
struct Carry {
  static constexpr int blocks = hn::MaxLanes(D()) == 1 ? n : 1;  // one lane a block: n blocks lie between the ends
  Vec3<D> before[blocks];
  HWY_INLINE Carry() {}
  HWY_INLINE Vec3<D> operator()(Vec3<D> now) {
    const Vec3<D> last = before[blocks - 1];
    const Vec3<D> moved{from_left<n>(last.x, now.x), from_left<n>(last.y, now.y), from_left<n>(last.z, now.z)};
    for (int b = blocks - 1; b > 0; --b) before[b] = before[b - 1];
    before[0] = now;
    return moved;
  }
};

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
