#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/row_lengths.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/engines/cpu/row_lengths.h"
#include "core/engines/cpu/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {

template <class R>
R longest(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  constexpr hn::RebindToUnsigned<D> du;
  constexpr int lanes = int(hn::MaxLanes(D()));
  // Compared as integers, since then NaN and ∞ are larger than every number.
  auto most = hn::Zero(du);
  for (int j = begin; j < end; j += lanes) {
    const V way = V::load(x + j + other, stride) - V::load(x + j, stride);
    const auto squared = hn::IfThenElseZero(hn::FirstN(D(), std::size_t(end - j)), dot(way, way).v);
    most = hn::Max(most, hn::BitCast(du, squared));
  }
  return hn::GetLane(hn::BitCast(D(), hn::MaxOfLanes(du, most)));
}
float longest_float(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return longest(x, stride, other, begin, end);
}
double longest_double(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return longest(x, stride, other, begin, end);
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(longest_float);
HWY_EXPORT(longest_double);

template <>
float longest_squared(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return HWY_DYNAMIC_DISPATCH(longest_float)(x, stride, other, begin, end);
}
template <>
double longest_squared(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return HWY_DYNAMIC_DISPATCH(longest_double)(x, stride, other, begin, end);
}

}  // namespace tyglab::cpu
#endif
