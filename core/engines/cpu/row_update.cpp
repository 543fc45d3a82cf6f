#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/row_update.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/engines/cpu/row_update.h"
#include "core/simd/row_field.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;
using simd::widest_vector;

/// A sum with its pointers at a row, which no store can change.
template <int terms, class R>
class Sum {
  using D = hn::ScalableTag<R>;
  static constexpr int lanes = int(hn::MaxLanes(D()));

 public:
  HWY_INLINE Sum(const RowSum<R>& s, std::ptrdiff_t offset, const R* force) : target_(s.target + offset) {
    for (int n = 0; n < terms; ++n) {
      source_[n] = s.source[n] != nullptr ? s.source[n] + offset : force;
      factor_[n] = hn::Set(D(), s.factor[n]);
    }
  }
  /// Elements [at, end). Two vectors a turn, since a turn's bookkeeping costs as much as a vector.
  HWY_INLINE void make(std::ptrdiff_t at, std::ptrdiff_t end) const {
    for (; at + 2 * lanes <= end; at += 2 * lanes) {
      hn::Store(sum(at), D(), target_ + at);
      hn::Store(sum(at + lanes), D(), target_ + at + lanes);
    }
    if (at + lanes <= end) hn::Store(sum(at), D(), target_ + at), at += lanes;
    if (at < end) hn::BlendedStore(sum(at), hn::FirstN(D(), std::size_t(end - at)), D(), target_ + at);
  }

 private:
  HWY_INLINE hn::Vec<D> sum(std::ptrdiff_t at) const {
    auto value = hn::Mul(factor_[0], hn::Load(D(), source_[0] + at));
    for (int n = 1; n < terms; ++n) value = hn::MulAdd(factor_[n], hn::Load(D(), source_[n] + at), value);
    return value;
  }

  R* target_;
  const R* source_[terms];
  hn::Vec<D> factor_[terms];
};

template <int terms, class R>
void sum_of(const RowSum<R>& given, std::ptrdiff_t offset, const R* force, RowRun run) {
  assert(run.rows > 0 && run.columns > 0 && run.columns <= run.stride);
  const Sum<terms, R> sum(given, offset, force);
  // Without gaps all are one.
  if (run.columns == run.stride) return sum.make(0, 3 * run.rows * run.stride);
  for (int c = 0; c < 3 * run.rows; ++c) sum.make(c * run.stride, c * run.stride + run.columns);
}

template <class R>
void make_all(const RowSums<R>& sums, std::ptrdiff_t offset, const R* force, RowRun run) {
  static_assert(RowSum<R>::most_terms == 8);
  assert(sums.count >= 0 && sums.count <= RowSums<R>::most);
  for (const RowSum<R>* s = sums.sum; s < sums.sum + sums.count; ++s) switch (s->terms) {
      case 1:
        sum_of<1>(*s, offset, force, run);
        break;
      case 2:
        sum_of<2>(*s, offset, force, run);
        break;
      case 3:
        sum_of<3>(*s, offset, force, run);
        break;
      case 4:
        sum_of<4>(*s, offset, force, run);
        break;
      case 5:
        sum_of<5>(*s, offset, force, run);
        break;
      case 6:
        sum_of<6>(*s, offset, force, run);
        break;
      case 7:
        sum_of<7>(*s, offset, force, run);
        break;
      case 8:
        sum_of<8>(*s, offset, force, run);
        break;
    }
}

template <class R>
void watch(const R* x, const R* old, const R* v, R dt, RowRun run, R* largest) {
  assert(run.rows > 0 && run.columns > 0 && run.columns <= run.stride);
  using D = hn::ScalableTag<R>;
  constexpr hn::RebindToUnsigned<D> du;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const auto by = hn::Set(D(), dt);
  // Compared as integers, since then NaN and ∞ are larger than every number.
  auto most = hn::BitCast(du, hn::Load(D(), largest));
  const auto larger = [&](std::ptrdiff_t at) HWY_ATTR {
    const auto way = hn::Abs(hn::Sub(hn::Load(D(), x + at), hn::Load(D(), old + at)));
    const auto next = hn::Abs(hn::Mul(by, hn::Load(D(), v + at)));
    return hn::Max(hn::BitCast(du, way), hn::BitCast(du, next));
  };
  const bool gaps = run.columns < run.stride;
  const std::ptrdiff_t together = gaps ? run.columns : 3 * run.rows * run.stride;
  for (int c = 0; c < (gaps ? 3 * run.rows : 1); ++c) {
    std::ptrdiff_t at = c * run.stride;
    const std::ptrdiff_t end = at + together;
    for (; at + lanes <= end; at += lanes) most = hn::Max(most, larger(at));
    if (at == end) continue;
    const auto inside = hn::FirstN(D(), std::size_t(end - at));
    most = hn::Max(most, hn::BitCast(du, hn::IfThenElseZero(inside, hn::BitCast(D(), larger(at)))));
  }
  hn::Store(hn::BitCast(D(), most), D(), largest);
}

template <class R>
RowMeasures measure(const RowEstimate<R>& given, std::ptrdiff_t stride, int columns) {
  assert(given.terms >= 0 && given.terms <= RowEstimate<R>::most_terms && columns <= stride);
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  constexpr hn::RebindToUnsigned<D> du;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const RowEstimate<R> e = given;
  const L dt = L::all(double(e.dt));
  auto error = hn::BitCast(du, hn::Zero(D())), farthest = error;  // as integers: NaN is larger than every number
  L xx, xv, vv, xa, va;
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < columns; j += lanes) {
      const std::ptrdiff_t at = c * stride + j;
      L error_x, error_v, x, v, a;
      for (int n = 0; n < e.terms; ++n) {
        const L from = hn::Load(D(), e.source[n] + at);
        error_x = multiply_add(hn::Set(D(), e.error_x[n]), from, error_x);
        error_v = multiply_add(hn::Set(D(), e.error_v[n]), from, error_v);
        x = multiply_add(hn::Set(D(), e.stage_x[n]), from, x);
        v = multiply_add(hn::Set(D(), e.stage_v[n]), from, v);
        a = multiply_add(hn::Set(D(), e.stage_a[n]), from, a);
      }
      const auto inside = hn::FirstN(D(), std::size_t(columns - j));
      const auto kept = [&](L value) HWY_ATTR { return L(hn::IfThenElseZero(inside, value.v)); };
      const auto bits = [&](L value) HWY_ATTR { return hn::BitCast(du, hn::Abs(kept(value).v)); };
      error = hn::Max(error, hn::Max(bits(error_x), bits(dt * error_v)));
      farthest = hn::Max(farthest, bits(hn::Load(D(), e.x + at)));
      x = kept(x), v = kept(v), a = kept(a);
      xx = multiply_add(x, x, xx), xv = multiply_add(x, v, xv), vv = multiply_add(v, v, vv);
      xa = multiply_add(x, a, xa), va = multiply_add(v, a, va);
    }
  const auto sum = [](L value) HWY_ATTR { return double(hn::GetLane(hn::SumOfLanes(D(), value.v))); };
  const auto most = [](auto value) HWY_ATTR {
    alignas(widest_vector) R by_lane[widest_vector / sizeof(R)];
    hn::Store(hn::BitCast(D(), value), D(), by_lane);
    double largest = 0;
    for (int n = 0; n < lanes; ++n) {
      if (!(by_lane[n] <= std::numeric_limits<R>::max())) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, double(by_lane[n]));
    }
    return largest;
  };
  return {most(error), most(farthest), sum(xx), sum(xv), sum(vv), sum(xa), sum(va)};
}

RowMeasures measure_float(const RowEstimate<float>& e, std::ptrdiff_t stride, int columns) {
  return measure(e, stride, columns);
}
RowMeasures measure_double(const RowEstimate<double>& e, std::ptrdiff_t stride, int columns) {
  return measure(e, stride, columns);
}
void sums_float(const RowSums<float>& s, std::ptrdiff_t offset, const float* force, RowRun run) {
  make_all(s, offset, force, run);
}
void sums_double(const RowSums<double>& s, std::ptrdiff_t offset, const double* force, RowRun run) {
  make_all(s, offset, force, run);
}
void watch_float(const float* x, const float* old, const float* v, float dt, RowRun run, float* largest) {
  watch(x, old, v, dt, run, largest);
}
void watch_double(const double* x, const double* old, const double* v, double dt, RowRun run, double* largest) {
  watch(x, old, v, dt, run, largest);
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(measure_float);
HWY_EXPORT(measure_double);
HWY_EXPORT(sums_float);
HWY_EXPORT(sums_double);
HWY_EXPORT(watch_float);
HWY_EXPORT(watch_double);

template <>
RowMeasures measure_row(const RowEstimate<float>& e, std::ptrdiff_t stride, int columns) {
  return HWY_DYNAMIC_DISPATCH(measure_float)(e, stride, columns);
}
template <>
RowMeasures measure_row(const RowEstimate<double>& e, std::ptrdiff_t stride, int columns) {
  return HWY_DYNAMIC_DISPATCH(measure_double)(e, stride, columns);
}
template <>
void make_sums(const RowSums<float>& s, std::ptrdiff_t offset, const float* force, RowRun run) {
  HWY_DYNAMIC_DISPATCH(sums_float)(s, offset, force, run);
}
template <>
void make_sums(const RowSums<double>& s, std::ptrdiff_t offset, const double* force, RowRun run) {
  HWY_DYNAMIC_DISPATCH(sums_double)(s, offset, force, run);
}
template <>
void watch_displacements(const float* x, const float* old, const float* v, float dt, RowRun run, float* largest) {
  HWY_DYNAMIC_DISPATCH(watch_float)(x, old, v, dt, run, largest);
}
template <>
void watch_displacements(const double* x, const double* old, const double* v, double dt, RowRun run, double* largest) {
  HWY_DYNAMIC_DISPATCH(watch_double)(x, old, v, dt, run, largest);
}

}  // namespace tyglab::cpu
#endif
