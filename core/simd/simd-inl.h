// SIMD vectors with the operations of the formulas in core/forces, on top of Highway. Included once for each target
// (hwy/foreach_target.h), so the guard toggles.
#if defined(TYGLAB_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_SIMD_INL_H_
#undef TYGLAB_SIMD_INL_H_
#else
#define TYGLAB_SIMD_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tyglab::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A SIMD vector of numbers, and the operations that the formulas use.
template <class D>
struct Lanes {
  using V = hn::Vec<D>;
  using T = hn::TFromD<D>;
  V v;

  HWY_INLINE Lanes() : v(hn::Zero(D())) {}
  HWY_INLINE Lanes(V from) : v(from) {}
  static HWY_INLINE Lanes all(double value) { return hn::Set(D(), T(value)); }
  static HWY_INLINE Lanes load(const T* p) { return hn::LoadU(D(), p); }
  HWY_INLINE void store(T* p) const { hn::Store(v, D(), p); }
  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
  friend HWY_INLINE Lanes multiply_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
  /// c - a b
  friend HWY_INLINE Lanes subtract_times(Lanes a, Lanes b, Lanes c) { return hn::NegMulAdd(a.v, b.v, c.v); }
  friend HWY_INLINE Lanes if_greater(Lanes a, Lanes b, Lanes then) {
    return hn::IfThenElseZero(hn::Gt(a.v, b.v), then.v);
  }
  friend HWY_INLINE Lanes least_of(Lanes a, Lanes b) { return hn::Min(a.v, b.v); }
  friend HWY_INLINE Lanes root(Lanes a) { return hn::Sqrt(a.v); }
  friend HWY_INLINE Lanes absolute(Lanes a) { return hn::Abs(a.v); }
  /// a where it is positive (negative), else 0; 0 for NaN.
  friend HWY_INLINE Lanes positive(Lanes a) {
#if HWY_ARCH_X86
    return hn::Max(a.v, hn::Zero(D()));  // of which x86 returns the second if one is NaN
#else
    return hn::IfThenElseZero(hn::Gt(a.v, hn::Zero(D())), a.v);
#endif
  }
  friend HWY_INLINE Lanes negative(Lanes a) {
#if HWY_ARCH_X86
    return hn::Min(a.v, hn::Zero(D()));
#else
    return hn::IfThenElseZero(hn::Lt(a.v, hn::Zero(D())), a.v);
#endif
  }
  /// 2h/√r2 + c. In float the approximation y of 1/√r2 that x86 has, good to 11 bits, and one Newton step,
  /// 2/√r2 = y (3 - r2 y²), within 2 ulp. In double, and elsewhere, exact roots and quotients; with AVX-512, where
  /// those are slow, its 14-bit approximation and the series of 2/√(1 - e), e = 1 - r2 y², |e| < 2^-13, to the power
  /// e³: what is left out is under e⁴/3 < 2^-53, half of a rounding.
  friend HWY_INLINE Lanes over_root(Lanes h, Lanes r2, Lanes c) {
    if constexpr (sizeof(T) == 4 && HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR) {
      const V y = hn::ApproximateReciprocalSqrt(r2.v);
      return hn::MulAdd(hn::Mul(y, h.v), hn::NegMulAdd(hn::Mul(r2.v, y), y, hn::Set(D(), T(3))), c.v);
    } else {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
      const V y{_mm512_rsqrt14_pd(r2.v.raw)};
      const V e = hn::NegMulAdd(hn::Mul(r2.v, y), y, hn::Set(D(), T(1)));
      V sum = hn::MulAdd(hn::Set(D(), T(5.0 / 8)), e, hn::Set(D(), T(3.0 / 4)));
      sum = hn::MulAdd(sum, e, hn::Set(D(), T(1)));
      return hn::MulAdd(h.v, hn::MulAdd(y, hn::Mul(sum, e), hn::Add(y, y)), c.v);
#else
      return hn::MulAdd(hn::Add(h.v, h.v), hn::Div(hn::Set(D(), T(1)), hn::Sqrt(r2.v)), c.v);
#endif
    }
  }
};

/// √r2 and 1/√r2, likewise; of 0 neither is a number.
template <class D>
struct Root {
  Lanes<D> root, inverse;
};
template <class D>
HWY_INLINE Root<D> root_of(Lanes<D> r2) {
  using T = hn::TFromD<D>;
  [[maybe_unused]] const auto half = hn::Set(D(), T(0.5));
  if constexpr (sizeof(T) == 4 && HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR) {
    // Neither waits for the other.
    const auto y = hn::ApproximateReciprocalSqrt(r2.v), r2_y = hn::Mul(r2.v, y);
    const auto correction = hn::NegMulAdd(r2_y, y, hn::Set(D(), T(3)));
    return {hn::Mul(hn::Mul(r2_y, half), correction), hn::Mul(hn::Mul(y, half), correction)};
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  } else if constexpr (sizeof(T) == 8) {
    const Lanes<D> inverse = over_root(Lanes<D>(half), r2, Lanes<D>());
    return {r2 * inverse, inverse};
#endif
  } else {
    const auto root = hn::Sqrt(r2.v);
    return {root, hn::Div(hn::Set(D(), T(1)), root)};
  }
}

/// a/b; in float on x86 by the approximation of 1/b and a Newton step, within 2 ulp.
template <class D>
HWY_INLINE Lanes<D> divided(Lanes<D> a, Lanes<D> b) {
  if constexpr (sizeof(hn::TFromD<D>) == 4 && HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR) {
    const auto y = hn::ApproximateReciprocal(b.v);
    return hn::Mul(a.v, hn::Mul(y, hn::NegMulAdd(b.v, y, hn::Set(D(), hn::TFromD<D>(2)))));
  } else {
    return a / b;
  }
}

/// Lanes moved up by n (1 or 2), with the lowest from the top of `before`: for each lane j, what was in lane j - n.
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
  // [before's upper half, now's lower half], then a shift inside each half. Written so that `before` can be read from
  // memory in the same instruction.
  typename Lanes<D>::V middle;
  if constexpr (sizeof(T) == 4)
    middle.raw = _mm256_permute2f128_ps(now.v.raw, before.v.raw, 0x03);
  else
    middle.raw = _mm256_permute2f128_pd(now.v.raw, before.v.raw, 0x03);
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
  /// Components are `stride` apart.
  static HWY_INLINE Vec3 load(const T* p, std::ptrdiff_t stride) {
    return {L::load(p), L::load(p + stride), L::load(p + 2 * stride)};
  }
  HWY_INLINE void store(T* p, std::ptrdiff_t stride) const { x.store(p), y.store(p + stride), z.store(p + 2 * stride); }
  friend HWY_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HWY_INLINE Vec3 operator*(L a, Vec3 b) { return {a * b.x, a * b.y, a * b.z}; }
  friend HWY_INLINE Vec3 multiply_add(L a, Vec3 b, Vec3 c) {
    return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)};
  }
  friend HWY_INLINE Vec3 subtract_times(L a, Vec3 b, Vec3 c) {
    return {subtract_times(a, b.x, c.x), subtract_times(a, b.y, c.y), subtract_times(a, b.z, c.z)};
  }
  friend HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) {
    return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
  }
  static HWY_INLINE L minor(L a, L b, L c, L d) { return hn::MulSub(a.v, b.v, (c * d).v); }
  friend HWY_INLINE L dot(Vec3 a, Vec3 b) { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
};

/// Where the mask is set, else 0.
template <class D>
HWY_INLINE Vec3<D> where(hn::Mask<D> mask, Vec3<D> v) {
  return {hn::IfThenElseZero(mask, v.x.v), hn::IfThenElseZero(mask, v.y.v), hn::IfThenElseZero(mask, v.z.v)};
}

/// a + b where the mask is set, else a.
template <class D>
HWY_INLINE Lanes<D> add_where(hn::Mask<D> mask, Lanes<D> a, Lanes<D> b) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  using V = typename Lanes<D>::V;
  if constexpr (sizeof(hn::TFromD<D>) == 4)
    return V{_mm512_mask_add_ps(a.v.raw, mask.raw, a.v.raw, b.v.raw)};
  else
    return V{_mm512_mask_add_pd(a.v.raw, mask.raw, a.v.raw, b.v.raw)};
#else
  return hn::Add(a.v, hn::IfThenElseZero(mask, b.v));
#endif
}

/// Carries a component of forces on the right ends of springs, n to the right, over to the lanes of those ends, block
/// after block along a row.
template <int n, class D>
struct LaneCarry {
  static constexpr int blocks = hn::MaxLanes(D()) == 1 ? n : 1;  // one lane a block: n blocks lie between the ends
  Lanes<D> before[blocks];
  HWY_INLINE LaneCarry() {}
  HWY_INLINE Lanes<D> operator()(Lanes<D> now) {
    const Lanes<D> moved = from_left<n>(before[blocks - 1], now);
    for (int b = blocks - 1; b > 0; --b) before[b] = before[b - 1];
    before[0] = now;
    return moved;
  }
};

/// The same for all three components.
template <int n, class D>
struct Carry {
  LaneCarry<n, D> x, y, z;
  HWY_INLINE Carry() {}
  HWY_INLINE Vec3<D> operator()(Vec3<D> now) { return {x(now.x), y(now.y), z(now.z)}; }
};

}  // namespace tyglab::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
