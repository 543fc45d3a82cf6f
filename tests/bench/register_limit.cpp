#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/register_limit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <limits>

#include "core/forces/spring-inl.h"
#include "core/simd/simd-inl.h"
#include "tests/bench/throughput.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::HWY_NAMESPACE;
using namespace tyglab::simd::HWY_NAMESPACE;

/// Makes the compiler believe that the registers have changed, so that it computes every spring again.
template <class D>
HWY_INLINE void forget(Vec3<D>& v) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  asm volatile("" : "+v"(v.x.v.raw), "+v"(v.y.v.raw), "+v"(v.z.v.raw));
#else
  asm volatile("" : "+m"(v));  // through memory, where the name of a register's kind is not known
#endif
}

/// The operations of one step, in as many numbers and of the same kinds as those of the sweep, but on so few values
/// that 16 registers nearly hold them: one vector stands for all particles and velocities, which are looked at from one
/// place. Nothing but sums is handed from a turn to the next, so what is measured is how many operations of this mix
/// the processor makes at a time, and not how long one waits for another.
template <class R>
class Limit {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;

 public:
  explicit HWY_INLINE Limit(double seed)
      : straight_(Spring<L>::of(50, 1.0, &L::all)),
        diagonal_(Spring<L>::of(50, 1.4, &L::all)),
        bending_(Spring<L>::of(5, 2.0, &L::all)),
        k_d_(L::all(1e-6)),
        weight_(L::all(1e-3)),
        to_v_(L::all(1e-9 * seed)),
        from_(L::all(0.1 * seed)) {}

  HWY_INLINE double run(int steps) {
    V there(L::all(1.1), L::all(0.2), L::all(0.3)), own, other;
    for (int n = 0; n < steps; ++n) {
      own.y = own.y - weight_;
      add(pull(straight_, there), own, other);
      add(pull(straight_, there), own, other);
      add(pull(diagonal_, there), own, other);
      add(pull(diagonal_, there), own, other);
      add(push(there), own, other);
      add(push(there), own, other);
      other = other + multiply_add(to_v_, there, there);
    }
    return double(hn::GetLane((own.x + own.y + own.z + other.x + other.y + other.z).v));
  }

 private:
  static HWY_INLINE void add(V force, V& own, V& other) { own = own + force, other = other - force; }
  HWY_INLINE V away(V& there) const {
    forget(there);
    return {there.x - from_, there.y - from_, there.z - from_};
  }
  HWY_INLINE V pull(const Spring<L>& s, V& there) const {
    const V x_ij = away(there);
    const V force = stretch_factor(s, dot(x_ij, x_ij)) * x_ij;
    return multiply_add(k_d_, away(there), force);
  }
  HWY_INLINE V push(V& there) const {
    const V x_ij = away(there);
    return bend_factor(bending_, dot(x_ij, x_ij)) * x_ij;
  }

  const Spring<L> straight_, diagonal_, bending_;
  const L k_d_, weight_, to_v_, from_;
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
  assert(repeats >= 1);
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
