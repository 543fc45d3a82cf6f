#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/simd/row_distances.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "core/simd/row_field.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::simd::HWY_NAMESPACE {

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

template <class R>
double strain(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, R rest, bool pushes) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const auto sign = hn::Set(D(), pushes ? R(-1) : R(1)), length = hn::Set(D(), rest);
  auto sum = hn::Zero(D());
  for (int j = begin; j < end; j += lanes) {
    const V way = V::load(x + j + other, stride) - V::load(x + j, stride);
    const auto longer = hn::Max(hn::Mul(sign, hn::Sub(hn::Sqrt(dot(way, way).v), length)), hn::Zero(D()));
    const auto kept = hn::IfThenElseZero(hn::FirstN(D(), std::size_t(end - j)), longer);
    sum = hn::MulAdd(kept, kept, sum);
  }
  return double(hn::GetLane(hn::SumOfLanes(D(), sum)));
}

template <class R>
R nearest(const R* from, const R* x, std::ptrdiff_t stride, int columns, const R* point) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const auto far = hn::Set(D(), std::numeric_limits<R>::infinity());
  const V center{{hn::Set(D(), point[0])}, {hn::Set(D(), point[1])}, {hn::Set(D(), point[2])}};
  auto least = far;
  for (int j = 0; j < columns; j += lanes) {
    // The nearest point of the way, as a part of it back from its end.
    const V end = V::load(x + j, stride) - center, way = V::load(x + j, stride) - V::load(from + j, stride);
    const auto square = dot(way, way).v, zero = hn::Zero(D());
    const auto back = hn::IfThenElse(hn::Gt(square, zero), hn::Div(dot(end, way).v, square), zero);
    const auto part = hn::Max(zero, hn::Min(back, hn::Set(D(), R(1))));
    const V nearest = end - typename V::L{part} * way;
    const auto inside = hn::FirstN(D(), std::size_t(columns - j));
    least = hn::Min(least, hn::IfThenElse(inside, dot(nearest, nearest).v, far));
  }
  return hn::GetLane(hn::MinOfLanes(D(), least));
}

template <class R>
R lowest_y(const R* x, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const auto far = hn::Set(D(), std::numeric_limits<R>::infinity());
  auto least = far;
  for (int j = 0; j < columns; j += lanes) {
    const auto inside = hn::FirstN(D(), std::size_t(columns - j));
    least = hn::Min(least, hn::IfThenElse(inside, hn::Load(D(), x + stride + j), far));
  }
  return hn::GetLane(hn::MinOfLanes(D(), least));
}

float longest_float(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return longest(x, stride, other, begin, end);
}
double longest_double(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return longest(x, stride, other, begin, end);
}
double strain_float(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, float rest,
                    bool pushes) {
  return strain(x, stride, other, begin, end, rest, pushes);
}
double strain_double(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, double rest,
                     bool pushes) {
  return strain(x, stride, other, begin, end, rest, pushes);
}
float nearest_float(const float* from, const float* x, std::ptrdiff_t stride, int columns, const float* point) {
  return nearest(from, x, stride, columns, point);
}
double nearest_double(const double* from, const double* x, std::ptrdiff_t stride, int columns, const double* point) {
  return nearest(from, x, stride, columns, point);
}
float lowest_float(const float* x, std::ptrdiff_t stride, int columns) {
  return lowest_y(x, stride, columns);
}
double lowest_double(const double* x, std::ptrdiff_t stride, int columns) {
  return lowest_y(x, stride, columns);
}

}  // namespace tyglab::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::simd {

HWY_EXPORT(longest_float);
HWY_EXPORT(longest_double);
HWY_EXPORT(strain_float);
HWY_EXPORT(strain_double);
HWY_EXPORT(nearest_float);
HWY_EXPORT(nearest_double);
HWY_EXPORT(lowest_float);
HWY_EXPORT(lowest_double);

template <>
float longest_squared(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return HWY_DYNAMIC_DISPATCH(longest_float)(x, stride, other, begin, end);
}
template <>
double longest_squared(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end) {
  return HWY_DYNAMIC_DISPATCH(longest_double)(x, stride, other, begin, end);
}
template <>
double strain_squared(const float* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, float rest,
                      bool pushes) {
  return HWY_DYNAMIC_DISPATCH(strain_float)(x, stride, other, begin, end, rest, pushes);
}
template <>
double strain_squared(const double* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, double rest,
                      bool pushes) {
  return HWY_DYNAMIC_DISPATCH(strain_double)(x, stride, other, begin, end, rest, pushes);
}
template <>
float nearest_squared(const float* from, const float* x, std::ptrdiff_t stride, int columns, const float point[3]) {
  return HWY_DYNAMIC_DISPATCH(nearest_float)(from, x, stride, columns, point);
}
template <>
double nearest_squared(const double* from, const double* x, std::ptrdiff_t stride, int columns, const double point[3]) {
  return HWY_DYNAMIC_DISPATCH(nearest_double)(from, x, stride, columns, point);
}
template <>
float lowest(const float* x, std::ptrdiff_t stride, int columns) {
  return HWY_DYNAMIC_DISPATCH(lowest_float)(x, stride, columns);
}
template <>
double lowest(const double* x, std::ptrdiff_t stride, int columns) {
  return HWY_DYNAMIC_DISPATCH(lowest_double)(x, stride, columns);
}

}  // namespace tyglab::simd
#endif
