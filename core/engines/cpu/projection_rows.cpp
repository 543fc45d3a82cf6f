#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/projection_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <type_traits>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/projection_rows.h"
#include "core/forces/spring-inl.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;
using tyglab::HWY_NAMESPACE::shortest;

template <class D>
HWY_INLINE void put(Vec3<D> v, hn::TFromD<D>* to, std::ptrdiff_t stride) {
  hn::StoreU(v.x.v, D(), to), hn::StoreU(v.y.v, D(), to + stride), hn::StoreU(v.z.v, D(), to + 2 * stride);
}

/// 1/√a. The short form that springs take (simd-inl.h) is there for whole vectors alone.
template <class D>
HWY_INLINE Lanes<D> one_over_root(Lanes<D> a) {
  if constexpr (hn::MaxLanes(D()) == hn::MaxLanes(hn::ScalableTag<hn::TFromD<D>>()))
    return over_root(Lanes<D>::all(0.5), a, Lanes<D>());
  else
    return hn::Div(hn::Set(D(), 1), hn::Sqrt(a.v));
}

/// What the two ends of springs weigh: 1 or 0 each, and 0 for both where a spring is torn.
template <class D>
struct Weights {
  Lanes<D> a, b, sum;
};
/// Where all weigh 1: nothing that has to be looked up, compared or multiplied by.
template <class D>
struct AllFree {};
template <class D>
HWY_INLINE Vec3<D> weighed(Weights<D> w, Vec3<D> way) {
  return w.a * way;
}
template <class D>
HWY_INLINE Vec3<D> weighed(AllFree<D>, Vec3<D> way) {
  return way;
}
template <class D>
HWY_INLINE Vec3<D> weighed_at_b(Weights<D> w, Vec3<D> way) {
  return w.b * way;
}
template <class D>
HWY_INLINE Vec3<D> weighed_at_b(AllFree<D>, Vec3<D> way) {
  return way;
}
/// `both` where both ends are free, otherwise `one`.
template <class D>
HWY_INLINE Lanes<D> by_weight(Weights<D> w, Lanes<D> both, Lanes<D> one) {
  return hn::IfThenElse(hn::Gt(w.sum.v, Lanes<D>::all(1.5).v), both.v, one.v);
}
template <class D>
HWY_INLINE Lanes<D> by_weight(AllFree<D>, Lanes<D> both, Lanes<D>) {
  return both;
}
template <bool masked, class D, class R>
HWY_INLINE auto weights_at(const SpringRow<R>& t, int n) {
  using L = Lanes<D>;
  if constexpr (masked) {
    const L whole = L::load(t.whole + n), on_a = whole * L::load(t.free_a + n), on_b = whole * L::load(t.free_b + n);
    return Weights<D>{on_a, on_b, on_a + on_b};
  } else {
    return AllFree<D>{};
  }
}
/// Within a row: `a` is the lane's own end, `b` its partner's.
template <bool masked, class D, class R, class Partners>
HWY_INLINE auto weights_within(const SpringRow<R>& t, int n, Partners partners) {
  using L = Lanes<D>;
  if constexpr (masked) {
    const L own = L::load(t.free_a + n), whole = partners.of_first(L::load(t.whole + n));
    const L on_a = whole * own, on_b = whole * partners(own);
    return Weights<D>{on_a, on_b, on_a + on_b};
  } else {
    return AllFree<D>{};
  }
}

/// One step of Gauss-Seidel on a spring; apply() is the displacement of its end b where that weighs 1. `pushes`: as in
/// ProjectionRow.
template <bool pushes, class R>
class Projection {
 public:
  explicit HWY_INLINE Projection(const ProjectionRow<R>& row) : row_(row), least_(row.rest * shortest) {}
  const SpringRow<R>& springs() const { return row_; }

  template <bool masked, class D>
  HWY_INLINE void between(D, int n) const {
    const auto w = weights_at<masked, D>(row_, n);
    const Vec3<D> q_a = at<D>(row_.q_a + n), q_b = at<D>(row_.q_b + n);
    const Vec3<D> d = at<D>(row_.x_b + n) - at<D>(row_.x_a + n) + (q_b - q_a);
    const Vec3<D> way = apply(d, w, row_.lambda + n);
    put<D>(q_a - weighed(w, way), row_.q_a + n, row_.stride);
    put<D>(q_b + weighed_at_b(w, way), row_.q_b + n, row_.stride);
  }
  /// A vector of particles of one row and their partners: each lane works its own spring out.
  template <bool masked, class D, class Partners>
  HWY_INLINE void within(D, int n, Partners partners) const {
    const Vec3<D> x = at<D>(row_.x_a + n), q = at<D>(row_.q_a + n);
    const auto w = weights_within<masked, D>(row_, n, partners);
    const Vec3<D> d = partners(x) - x + (partners(q) - q);
    put<D>(q - weighed(w, apply(d, w, row_.lambda + n)), row_.q_a + n, row_.stride);
  }

 private:
  template <class D>
  HWY_INLINE Vec3<D> at(const R* p) const {
    return Vec3<D>::load(p, row_.stride);
  }
  template <class D, template <class> class Weight>
  HWY_INLINE Vec3<D> apply(Vec3<D> d, Weight<D> w, R* lambda) const {
    using L = Lanes<D>;
    const L square = dot(d, d), per_length = one_over_root(square), length = square * per_length;
    const L old = L::load(lambda), error = multiply_add(L::all(row_.compliance), old, length - L::all(row_.rest));
    const L wanted = old - error * by_weight(w, L::all(row_.per_both), L::all(row_.per_one));
    const L next = pushes ? positive(wanted) : negative(wanted);
    // Shorter than that a spring has no direction; nor is there anything to move between two fixed ends.
    auto acts = hn::Gt(length.v, L::all(least_).v);
    if constexpr (std::is_same_v<Weight<D>, Weights<D>>) acts = hn::And(acts, hn::Gt(w.sum.v, hn::Zero(D())));
    const L change = hn::IfThenElseZero(acts, (next - old).v);
    hn::StoreU((old + change).v, D(), lambda);
    return L(hn::IfThenElseZero(acts, (change * per_length).v)) * d;
  }

  const ProjectionRow<R> row_;
  const double least_;
};

template <class R>
class Damping {
 public:
  explicit HWY_INLINE Damping(const DampingRow<R>& row) : row_(row) {}
  const SpringRow<R>& springs() const { return row_; }

  template <bool masked, class D>
  HWY_INLINE void between(D, int n) const {
    const auto w = weights_at<masked, D>(row_, n);
    const Vec3<D> a = Vec3<D>::load(row_.v_a + n, row_.stride), b = Vec3<D>::load(row_.v_b + n, row_.stride);
    const Vec3<D> part = part_of(w) * (b - a);
    put<D>(a + weighed(w, part), row_.v_a + n, row_.stride);
    put<D>(b - weighed_at_b(w, part), row_.v_b + n, row_.stride);
  }
  template <bool masked, class D, class Partners>
  HWY_INLINE void within(D, int n, Partners partners) const {
    const Vec3<D> v = Vec3<D>::load(row_.v_a + n, row_.stride);
    const auto w = weights_within<masked, D>(row_, n, partners);
    put<D>(v + weighed(w, part_of(w) * (partners(v) - v)), row_.v_a + n, row_.stride);
  }

 private:
  template <class D, template <class> class Weight>
  HWY_INLINE Lanes<D> part_of(Weight<D> w) const {
    return by_weight(w, Lanes<D>::all(row_.both), Lanes<D>::all(row_.one));
  }

  const DampingRow<R> row_;
};

/// Lane n's partner is lane n ^ reach.
template <class D>
class Partners {
 public:
  HWY_INLINE explicit Partners(int reach) {
    static constexpr Tables of_reach[] = {tables(1), tables(2)};
    const Tables& mine = of_reach[reach - 1];
    other_ = hn::SetTableIndices(D(), mine.other), first_ = hn::SetTableIndices(D(), mine.first);
  }
  HWY_INLINE Lanes<D> operator()(Lanes<D> v) const { return hn::TableLookupLanes(v.v, other_); }
  HWY_INLINE Vec3<D> operator()(Vec3<D> v) const { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }
  /// What stands at the spring's first end, at both of its ends.
  HWY_INLINE Lanes<D> of_first(Lanes<D> v) const { return hn::TableLookupLanes(v.v, first_); }

 private:
  using Index = hn::TFromD<hn::RebindToSigned<D>>;
  struct Tables {
    alignas(64) Index other[hn::MaxLanes(D())], first[hn::MaxLanes(D())];
  };
  static constexpr Tables tables(int reach) {
    Tables made{};
    for (std::size_t n = 0; n < hn::MaxLanes(D()); ++n)
      made.other[n] = Index(int(n) ^ reach), made.first[n] = Index(int(n) & ~reach);
    return made;
  }
  decltype(hn::SetTableIndices(D(), static_cast<const Index*>(nullptr))) other_, first_;
};

/// The springs between two rows from the n-th on: vector by vector, what is left in ever shorter ones.
template <bool masked, class R, int lanes, class Operation>
HWY_INLINE void between_rows(const Operation& operation, int n, int count) {
  const hn::CappedTag<R, lanes> d;
  for (; n + lanes <= count; n += lanes) operation.template between<masked>(d, n);
  if constexpr (lanes > 1) between_rows<masked, R, lanes / 2>(operation, n, count);
}
template <class R>
constexpr int widest = int(hn::MaxLanes(hn::ScalableTag<R>()));

/// The springs within a row, likewise; `rest` does those for which no vector is short enough.
template <bool masked, class R, int lanes, class Operation, class Rest>
HWY_INLINE void within_row(const Operation& operation, int n, Rest rest) {
  const int reach = operation.springs().reach, count = operation.springs().count;
  if constexpr (lanes > 1) {
    if (lanes >= 2 * reach && n + lanes <= count) {
      const hn::CappedTag<R, lanes> d;
      const Partners<hn::CappedTag<R, lanes>> partners(reach);
      for (; n + lanes <= count; n += lanes) operation.template within<masked>(d, n, partners);
    }
    within_row<masked, R, lanes / 2>(operation, n, rest);
  } else {
    for (; n < count; n += 2 * reach)
      for (int k = n; k < n + reach && k + reach < count; ++k) rest(k);
  }
}

template <bool masked, bool pushes, class R>
void project(const ProjectionRow<R>& row) {
  const Projection<pushes, R> projection(row);
  if (row.reach == 0) return between_rows<masked, R, widest<R>>(projection, 0, row.count);
  ProjectionRow<R> apart = row;  // with the partner in the place of b
  apart.x_b += row.reach, apart.q_b += row.reach;
  if (masked) apart.free_b += row.reach;
  const Projection<pushes, R> single(apart);
  within_row<masked, R, widest<R>>(projection, 0,
                                   [&](int k) HWY_ATTR { single.template between<masked>(hn::CappedTag<R, 1>(), k); });
}

template <bool masked, class R>
void damp(const DampingRow<R>& row) {
  const Damping<R> damping(row);
  if (row.reach == 0) return between_rows<masked, R, widest<R>>(damping, 0, row.count);
  DampingRow<R> apart = row;
  apart.v_b += row.reach;
  if (masked) apart.free_b += row.reach;
  const Damping<R> single(apart);
  within_row<masked, R, widest<R>>(damping, 0,
                                   [&](int k) HWY_ATTR { single.template between<masked>(hn::CappedTag<R, 1>(), k); });
}

template <bool masked, class R>
void project(const ProjectionRow<R>& row) {
  row.pushes ? project<masked, true>(row) : project<masked, false>(row);
}

#define TYGLAB_DEFINE(R, name)                                       \
  void project_##name(const ProjectionRow<R>& row) {                 \
    row.whole != nullptr ? project<true>(row) : project<false>(row); \
  }                                                                  \
  void damp_##name(const DampingRow<R>& row) {                       \
    row.whole != nullptr ? damp<true>(row) : damp<false>(row);       \
  }
TYGLAB_DEFINE(float, float)
TYGLAB_DEFINE(double, double)
#undef TYGLAB_DEFINE

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

#define TYGLAB_DISPATCH(R, name)                  \
  HWY_EXPORT(project_##name);                     \
  HWY_EXPORT(damp_##name);                        \
  template <>                                     \
  void project_row(const ProjectionRow<R>& row) { \
    HWY_DYNAMIC_DISPATCH(project_##name)(row);    \
  }                                               \
  template <>                                     \
  void damp_row(const DampingRow<R>& row) {       \
    HWY_DYNAMIC_DISPATCH(damp_##name)(row);       \
  }
TYGLAB_DISPATCH(float, float)
TYGLAB_DISPATCH(double, double)
#undef TYGLAB_DISPATCH

}  // namespace tyglab::cpu
#endif
