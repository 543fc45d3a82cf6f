#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/constant_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/constant_solve.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

template <bool bends, class R>
void iterate(const ConstantRow<R>& t) {
  assert(t.columns > 0 && t.columns <= t.stride && t.mask_stride > t.stride);
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  constexpr int lanes = int(hn::MaxLanes(D())), stretching = 2 * stretch_directions;
  constexpr int neighbors = 2 * int(bends ? directions.size() : stretch_directions);
  const std::ptrdiff_t mask_pitch = std::ptrdiff_t(directions.size()) * t.mask_stride, pitch = 3 * t.stride;
  // Each spring from both of its ends: where its mask is, and its other end.
  const R* mask[neighbors];
  std::ptrdiff_t other[neighbors];
  for (int d = 0; 2 * d < neighbors; ++d) {
    const Direction& to = directions[std::size_t(d)];
    const R* own = t.whole + d * t.mask_stride;
    mask[2 * d] = own, mask[2 * d + 1] = own - to.di * mask_pitch - to.dj;
    other[2 * d] = to.di * pitch + to.dj, other[2 * d + 1] = -other[2 * d];
  }
  const L stretch = L::all(t.stretch), bending = L::all(t.bending);
  const L per_middle = L::all(t.per_middle), omega = L::all(t.omega);
  for (int j = 0; j < t.columns; j += lanes) {
    const L free = L::load(t.free + j);
    for (int c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = c * t.stride + j;
      const R* x = t.x + at;
      const L here = L::load(x);
      const auto pull = [&](int n) HWY_ATTR { return L::load(mask[n] + j) * (L::load(x + other[n]) - here); };
      L sum;
      for (int n = 0; n < stretching; ++n) sum = sum + pull(n);
      sum = stretch * sum;
      if constexpr (bends) {
        L more;
        for (int n = stretching; n < neighbors; ++n) more = more + pull(n);
        sum = multiply_add(bending, more, sum);
      }
      const L before = L::load(t.before + at), residual = L::load(t.r + at) - here + sum;
      const L next = multiply_add(omega, multiply_add(per_middle, residual, here - before), before);
      (free * next).store(t.out + at);
    }
  }
}

#define TYGLAB_DEFINE(R, name)                                   \
  void iterate_##name(const ConstantRow<R>& row) {               \
    row.bending != 0 ? iterate<true>(row) : iterate<false>(row); \
  }
TYGLAB_DEFINE(float, float)
TYGLAB_DEFINE(double, double)
#undef TYGLAB_DEFINE

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

#define TYGLAB_DISPATCH(R, name)                \
  HWY_EXPORT(iterate_##name);                   \
  template <>                                   \
  void iterate_row(const ConstantRow<R>& row) { \
    HWY_DYNAMIC_DISPATCH(iterate_##name)(row);  \
  }
TYGLAB_DISPATCH(float, float)
TYGLAB_DISPATCH(double, double)
#undef TYGLAB_DISPATCH

}  // namespace tyglab::cpu
#endif
