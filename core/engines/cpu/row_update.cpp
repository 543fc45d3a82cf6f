#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/row_update.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/engines/cpu/row_update.h"
#include "core/engines/cpu/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {

/// The sum at one vector's place.
template <int terms, class R>
HWY_INLINE auto sum_at(const RowSum<R>& s, std::ptrdiff_t at) {
  using D = hn::ScalableTag<R>;
  auto sum = hn::Mul(hn::Set(D(), s.factor[0]), hn::Load(D(), s.source[0] + at));
  if constexpr (terms > 1) sum = hn::MulAdd(hn::Set(D(), s.factor[1]), hn::Load(D(), s.source[1] + at), sum);
  if constexpr (terms > 2) sum = hn::MulAdd(hn::Set(D(), s.factor[2]), hn::Load(D(), s.source[2] + at), sum);
  if constexpr (terms > 3) sum = hn::MulAdd(hn::Set(D(), s.factor[3]), hn::Load(D(), s.source[3] + at), sum);
  return sum;
}

template <int terms, class R>
void sum_of(const RowSum<R>& given, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const RowSum<R> s = given;  // which no store can change
  for (int c = 0; c < 3; ++c) {
    std::ptrdiff_t at = c * stride;
    const std::ptrdiff_t end = at + columns;
    for (; at + lanes <= end; at += lanes) hn::Store(sum_at<terms>(s, at), D(), s.target + at);
    if (at < end) hn::BlendedStore(sum_at<terms>(s, at), hn::FirstN(D(), std::size_t(end - at)), D(), s.target + at);
  }
}

template <class R>
void sum(const RowSum<R>& s, std::ptrdiff_t stride, int columns) {
  if (s.terms == 1) return sum_of<1>(s, stride, columns);
  if (s.terms == 2) return sum_of<2>(s, stride, columns);
  if (s.terms == 3) return sum_of<3>(s, stride, columns);
  sum_of<4>(s, stride, columns);
}

template <class R>
void watch(const R* x, const R* old, const R* v, R dt, std::ptrdiff_t stride, int columns, R* largest) {
  using D = hn::ScalableTag<R>;
  constexpr hn::RebindToUnsigned<D> du;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const auto by = hn::Set(D(), dt);
  // Compared as integers, since then NaN and ∞ are larger than every number.
  auto most = hn::BitCast(du, hn::Load(D(), largest));
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < columns; j += lanes) {
      const std::ptrdiff_t at = c * stride + j;
      const auto inside = hn::FirstN(D(), std::size_t(columns - j));
      const auto way = hn::Abs(hn::Sub(hn::Load(D(), x + at), hn::Load(D(), old + at)));
      const auto next = hn::Abs(hn::Mul(by, hn::Load(D(), v + at)));
      const auto larger = hn::Max(hn::BitCast(du, way), hn::BitCast(du, next));
      most = hn::Max(most, hn::BitCast(du, hn::IfThenElseZero(inside, hn::BitCast(D(), larger))));
    }
  hn::Store(hn::BitCast(D(), most), D(), largest);
}

void sum_float(const RowSum<float>& s, std::ptrdiff_t stride, int columns) {
  sum(s, stride, columns);
}
void sum_double(const RowSum<double>& s, std::ptrdiff_t stride, int columns) {
  sum(s, stride, columns);
}
void watch_float(const float* x, const float* old, const float* v, float dt, std::ptrdiff_t stride, int columns,
                 float* largest) {
  watch(x, old, v, dt, stride, columns, largest);
}
void watch_double(const double* x, const double* old, const double* v, double dt, std::ptrdiff_t stride, int columns,
                  double* largest) {
  watch(x, old, v, dt, stride, columns, largest);
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(sum_float);
HWY_EXPORT(sum_double);
HWY_EXPORT(watch_float);
HWY_EXPORT(watch_double);

template <>
void make_sum(const RowSum<float>& s, std::ptrdiff_t stride, int columns) {
  HWY_DYNAMIC_DISPATCH(sum_float)(s, stride, columns);
}
template <>
void make_sum(const RowSum<double>& s, std::ptrdiff_t stride, int columns) {
  HWY_DYNAMIC_DISPATCH(sum_double)(s, stride, columns);
}
template <>
void watch_ways(const float* x, const float* old, const float* v, float dt, std::ptrdiff_t stride, int columns,
                float* largest) {
  HWY_DYNAMIC_DISPATCH(watch_float)(x, old, v, dt, stride, columns, largest);
}
template <>
void watch_ways(const double* x, const double* old, const double* v, double dt, std::ptrdiff_t stride, int columns,
                double* largest) {
  HWY_DYNAMIC_DISPATCH(watch_double)(x, old, v, dt, stride, columns, largest);
}

}  // namespace tyglab::cpu
#endif
