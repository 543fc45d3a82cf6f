// Frozen: see register_limit.h. Changes of the formulas belong here only if the model itself changes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/register_limit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/engines/cpu/register_limit.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

/// A spring's constants and its formulas as they stood when this loop was frozen.
template <class D>
struct FrozenSpring {
  using L = Lanes<D>;
  using T = hn::TFromD<D>;
  L k, minus_tension, rest2, shortest2;

  static HWY_INLINE FrozenSpring of(double k, double rest) {
    const double least = 1e-9 * rest;
    return {L::all(k), L::all(-k * rest), L::all(rest * rest), L::all(least * least)};
  }
  static HWY_INLINE L inverse_sqrt(L r2) {
    if constexpr (sizeof(T) == 4) {
      const auto y = hn::ApproximateReciprocalSqrt(r2.v);
      const auto error = hn::NegMulAdd(hn::Mul(r2.v, y), y, hn::Set(D(), T(1)));
      return hn::MulAdd(hn::Mul(y, hn::Set(D(), T(0.5))), error, y);
    } else {
      return hn::Div(hn::Set(D(), T(1)), hn::Sqrt(r2.v));
    }
  }
  HWY_INLINE L tension(L r2) const { return multiply_add(minus_tension, inverse_sqrt(r2), k); }
  HWY_INLINE L stretch_factor(L r2) const { return if_greater(r2, rest2, tension(r2)); }
  HWY_INLINE L bend_factor(L r2) const { return if_greater(r2, shortest2, if_greater(rest2, r2, tension(r2))); }
};

/// Makes the compiler believe that the registers have changed, so that it computes every spring again.
template <class D>
HWY_INLINE void forget([[maybe_unused]] Vec3<D>& v) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  asm volatile("" : "+v"(v.x.v.raw), "+v"(v.y.v.raw), "+v"(v.z.v.raw));
#endif
}

/// Forces of one step on registers: three positions and two velocities stand for all that a particle's springs join.
template <class R>
class Limit {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;
  using Spring = FrozenSpring<D>;

 public:
  explicit HWY_INLINE Limit(double seed)
      : straight_(Spring::of(50, 1.0)),
        diagonal_(Spring::of(50, 1.4)),
        bending_(Spring::of(5, 2.0)),
        k_d_(L::all(1e-6)),
        weight_(L::all(1e-3)),
        to_v_(L::all(1e-9 * seed)),
        A_(L::all(0.1 * seed), L::all(0.2), L::all(0.3)),
        B_(L::all(1.1 * seed), L::all(0.2), L::all(0.3)),
        C_(L::all(0.1 * seed), L::all(1.2), L::all(0.3)),
        vA_(L(), L::all(seed), L()),
        vB_(L::all(seed), L(), L()) {}

  HWY_INLINE double run(int steps) {
    V A = A_, B = B_, C = C_, vA = vA_, vB = vB_, other;
    for (int n = 0; n < steps; ++n) {
      V own = other;
      own.y = own.y - weight_;
      const auto add = [&](V force) HWY_ATTR {
        own = own + force;
        other = other - force;
      };
      add(pull(straight_, A, B, vA, vB)), forget(B), forget(vB);
      add(pull(straight_, A, C, vA, vB)), forget(C), forget(vB);
      add(pull(diagonal_, A, B, vA, vB)), forget(B), forget(vB);
      add(pull(diagonal_, B, C, vA, vB)), forget(B), forget(C);
      add(push(A, B)), forget(B);
      add(push(A, C)), forget(C);
      vB = multiply_add(to_v_, own, vB);
      B = B + vB;
      forget(A), forget(vA);
    }
    return double(hn::GetLane((A.x + B.y + C.z + vA.y + vB.x + other.x + other.y + other.z).v));
  }

 private:
  HWY_INLINE V pull(const Spring& s, V p, V q, V vp, V vq) const {
    const V x_ij = q - p;
    return multiply_add(k_d_, vq - vp, s.stretch_factor(dot(x_ij, x_ij)) * x_ij);
  }
  HWY_INLINE V push(V p, V q) const {
    const V x_ij = q - p;
    return bending_.bend_factor(dot(x_ij, x_ij)) * x_ij;
  }

  const Spring straight_, diagonal_, bending_;
  const L k_d_, weight_, to_v_;
  const V A_, B_, C_, vA_, vB_;
};

template <class R>
double nanoseconds(double seed, double& sink) {
  constexpr int steps = 200000;
  const auto start = std::chrono::steady_clock::now();
  sink += Limit<R>(seed).run(steps);
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  return time.count() / steps / double(hn::MaxLanes(hn::ScalableTag<R>()));
}
double nanoseconds_float(double seed, double& sink) {
  return nanoseconds<float>(seed, sink);
}
double nanoseconds_double(double seed, double& sink) {
  return nanoseconds<double>(seed, sink);
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(nanoseconds_float);
HWY_EXPORT(nanoseconds_double);

double register_limit_ns(Precision precision, int repeats) {
  double best = std::numeric_limits<double>::infinity();
  volatile double kept = 0;  // what the loop computes must be used
  for (int n = 0; n < repeats; ++n) {
    double sink = 0;
    const double seed = 1 + 1e-3 * n;
    best = std::min(best, precision == Precision::float_ ? HWY_DYNAMIC_DISPATCH(nanoseconds_float)(seed, sink)
                                                         : HWY_DYNAMIC_DISPATCH(nanoseconds_double)(seed, sink));
    kept = kept + sink;
  }
  return best;
}

}  // namespace tyglab::cpu
#endif
