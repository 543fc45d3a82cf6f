#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/projection_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/projection_rows.h"
#include "core/forces/spring-inl.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;
using tyglab::HWY_NAMESPACE::shortest;

/// What of a row is worked on at a time: a whole vector,
template <class D>
struct AllLanes {
  using Tag = D;
  using T = hn::TFromD<D>;
  HWY_INLINE Lanes<D> load(const T* from) const { return hn::LoadU(D(), from); }
  HWY_INLINE void store(Lanes<D> v, T* to) const { hn::StoreU(v.v, D(), to); }
};
/// or, at its end, the first lanes of one. The others are read as zeros, between which no spring acts, and not written:
/// there another component begins, or a row that another thread has.
template <class D>
class FirstLanes {
 public:
  using Tag = D;
  using T = hn::TFromD<D>;
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  explicit HWY_INLINE FirstLanes(int lanes) : inside_(hn::FirstN(D(), std::size_t(lanes))) {}
  HWY_INLINE Lanes<D> load(const T* from) const {
    return hn::MaskedLoad(inside_, D(), from);
  }
  HWY_INLINE void store(Lanes<D> v, T* to) const {
    hn::BlendedStore(v.v, inside_, D(), to);
  }

 private:
  hn::Mask<D> inside_;
#else
  // Other instruction sets would read and write whole vectors here.
  explicit HWY_INLINE FirstLanes(int lanes) : bytes_(std::size_t(lanes) * sizeof(T)) {}
  HWY_INLINE Lanes<D> load(const T* from) const {
    alignas(64) T all[hn::MaxLanes(D())] = {};
    std::memcpy(all, from, bytes_);
    return hn::Load(D(), all);
  }
  HWY_INLINE void store(Lanes<D> v, T* to) const {
    alignas(64) T all[hn::MaxLanes(D())];
    hn::Store(v.v, D(), all);
    std::memcpy(to, all, bytes_);
  }

 private:
  std::size_t bytes_;
#endif
};

template <class Some, class T>
HWY_INLINE Vec3<typename Some::Tag> load(Some some, const T* from, std::ptrdiff_t stride) {
  return {some.load(from), some.load(from + stride), some.load(from + 2 * stride)};
}
template <class Some, class T>
HWY_INLINE void store(Some some, Vec3<typename Some::Tag> v, T* to, std::ptrdiff_t stride) {
  some.store(v.x, to), some.store(v.y, to + stride), some.store(v.z, to + 2 * stride);
}

/// Within a row, lane n's partner is lane n ^ reach: what stands at the partner of each.
template <int reach, class D>
HWY_INLINE Lanes<D> partners(Lanes<D> v) {
  if constexpr (reach == 1) {
    return hn::Reverse2(D(), v.v);
  } else if constexpr (sizeof(hn::TFromD<D>) == 4) {
    const hn::RepartitionToWide<D> pairs;
    return hn::BitCast(D(), hn::Reverse2(pairs, hn::BitCast(pairs, v.v)));
  } else {
    return hn::SwapAdjacentBlocks(v.v);
  }
}
template <int reach, class D>
HWY_INLINE Vec3<D> partners(Vec3<D> v) {
  return {partners<reach>(v.x), partners<reach>(v.y), partners<reach>(v.z)};
}
/// What stands at the spring's first end, at both of its ends.
template <int reach, class D>
HWY_INLINE Lanes<D> first_ends(Lanes<D> v) {
  if constexpr (reach == 1) {
    return hn::DupEven(v.v);
  } else if constexpr (sizeof(hn::TFromD<D>) == 4) {
    const hn::RepartitionToWide<D> pairs;
    return hn::BitCast(D(), hn::DupEven(hn::BitCast(pairs, v.v)));
  } else {
    return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(v.v), v.v);
  }
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
HWY_INLINE Lanes<D> weighed_at_a(Weights<D> w, Lanes<D> part) {
  return w.a * part;
}
template <class D>
HWY_INLINE Lanes<D> weighed_at_a(AllFree<D>, Lanes<D> part) {
  return part;
}
template <class D>
HWY_INLINE Lanes<D> weighed_at_b(Weights<D> w, Lanes<D> part) {
  return w.b * part;
}
template <class D>
HWY_INLINE Lanes<D> weighed_at_b(AllFree<D>, Lanes<D> part) {
  return part;
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
template <bool masked, int reach, class D, class R>
HWY_INLINE auto weights_within(const SpringRow<R>& t, int n) {
  using L = Lanes<D>;
  if constexpr (masked) {
    const L own = L::load(t.free_a + n), whole = first_ends<reach>(L::load(t.whole + n));
    const L on_a = whole * own, on_b = whole * partners<reach>(own);
    return Weights<D>{on_a, on_b, on_a + on_b};
  } else {
    return AllFree<D>{};
  }
}

/// One step of Gauss-Seidel on a spring; apply() is the displacement of its end b where that weighs 1, in parts of the
/// way from a to b. `pushes`: as in ProjectionRow.
template <bool pushes, class R>
class Projection {
 public:
  explicit HWY_INLINE Projection(const ProjectionRow<R>& row) : row_(row), least_(row.rest * shortest) {}

  template <bool masked, class Some>
  HWY_INLINE void between(Some some, int n) const {
    using D = typename Some::Tag;
    const auto w = weights_at<masked, D>(row_, n);
    const Vec3<D> q_a = at(some, row_.q_a + n), q_b = at(some, row_.q_b + n);
    const Vec3<D> d = at(some, row_.x_b + n) - at(some, row_.x_a + n) + (q_b - q_a);
    const Lanes<D> part = apply(some, d, w, row_.lambda + n);
    store(some, subtract_times(weighed_at_a(w, part), d, q_a), row_.q_a + n, row_.stride);
    store(some, multiply_add(weighed_at_b(w, part), d, q_b), row_.q_b + n, row_.stride);
  }
  /// A vector of particles of one row and their partners: each lane works its own spring out.
  template <bool masked, int reach, class Some>
  HWY_INLINE void within(Some some, int n) const {
    using D = typename Some::Tag;
    const Vec3<D> x = at(some, row_.x_a + n), q = at(some, row_.q_a + n);
    const auto w = weights_within<masked, reach, D>(row_, n);
    const Vec3<D> d = partners<reach>(x) - x + (partners<reach>(q) - q);
    const Lanes<D> part = weighed_at_a(w, apply(some, d, w, row_.lambda + n));
    store(some, subtract_times(part, d, q), row_.q_a + n, row_.stride);
  }

 private:
  template <class Some>
  HWY_INLINE Vec3<typename Some::Tag> at(Some some, const R* from) const {
    return load(some, from, row_.stride);
  }
  template <class Some, class D, template <class> class Weight>
  HWY_INLINE Lanes<D> apply(Some some, Vec3<D> d, Weight<D> w, R* lambda) const {
    using L = Lanes<D>;
    const Root<D> length = root_of(dot(d, d));
    const L per = by_weight(w, L::all(row_.per_both), L::all(row_.per_one)), old = some.load(lambda);
    // (rest - compliance λ - length) per, with as little as can be after the length, for which everything waits.
    const L without_length = per * subtract_times(L::all(row_.compliance), old, L::all(row_.rest));
    const L wanted = subtract_times(length.root, per, without_length), none_left = L() - old;
    const L change = pushes ? hn::Max(wanted.v, none_left.v) : hn::Min(wanted.v, none_left.v);
    // Shorter than that a spring has no direction; nor is there anything to move between two fixed ends.
    auto acts = hn::Gt(length.root.v, L::all(least_).v);
    if constexpr (std::is_same_v<Weight<D>, Weights<D>>) acts = hn::And(acts, hn::Gt(w.sum.v, hn::Zero(D())));
    const L made = hn::IfThenElseZero(acts, change.v);
    some.store(old + made, lambda);
    return made * hn::IfThenElseZero(acts, length.inverse.v);
  }

  const ProjectionRow<R> row_;
  const double least_;
};

template <class R>
class Damping {
 public:
  explicit HWY_INLINE Damping(const DampingRow<R>& row) : row_(row) {}

  template <bool masked, class Some>
  HWY_INLINE void between(Some some, int n) const {
    using D = typename Some::Tag;
    const auto w = weights_at<masked, D>(row_, n);
    const Vec3<D> a = load(some, row_.v_a + n, row_.stride), b = load(some, row_.v_b + n, row_.stride);
    const Vec3<D> d = b - a;
    store(some, multiply_add(weighed_at_a(w, part_of(w)), d, a), row_.v_a + n, row_.stride);
    store(some, subtract_times(weighed_at_b(w, part_of(w)), d, b), row_.v_b + n, row_.stride);
  }
  template <bool masked, int reach, class Some>
  HWY_INLINE void within(Some some, int n) const {
    using D = typename Some::Tag;
    const Vec3<D> v = load(some, row_.v_a + n, row_.stride);
    const auto w = weights_within<masked, reach, D>(row_, n);
    store(some, multiply_add(weighed_at_a(w, part_of(w)), partners<reach>(v) - v, v), row_.v_a + n, row_.stride);
  }

 private:
  template <class D, template <class> class Weight>
  HWY_INLINE Lanes<D> part_of(Weight<D> w) const {
    return by_weight(w, Lanes<D>::all(row_.both), Lanes<D>::all(row_.one));
  }

  const DampingRow<R> row_;
};

/// The springs between two rows, [n, end).
template <bool masked, class R, class Operation>
HWY_INLINE void between_rows(const Operation& operation, int n, int end) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  for (; n + lanes <= end; n += lanes) operation.template between<masked>(AllLanes<D>(), n);
  if (n < end) operation.template between<masked>(FirstLanes<D>(end - n), n);
}

/// The springs within a row, likewise. `apart`: the operation with each particle's partner in the place of b.
template <bool masked, int reach, class R, class Operation>
HWY_INLINE void within_row(const Operation& operation, const Operation& apart, int count) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D())), group = 2 * reach;
  int n = 0;
  if constexpr (lanes >= group) {
    for (; n + lanes <= count; n += lanes) operation.template within<masked, reach>(AllLanes<D>(), n);
    // Whole groups: what has no partner would be joined to a zero.
    if (const int left = (count - n) / group * group; left > 0) {
      operation.template within<masked, reach>(FirstLanes<D>(left), n);
      n += left;
    }
  }
  for (; n + reach < count; n += group) between_rows<masked, R>(apart, n, n + std::min(reach, count - n - reach));
}

template <bool masked, bool pushes, class R>
void project(const ProjectionRow<R>& row) {
  const Projection<pushes, R> projection(row);
  if (row.reach == 0) return between_rows<masked, R>(projection, 0, row.count);
  ProjectionRow<R> partners = row;
  partners.x_b += row.reach, partners.q_b += row.reach;
  if (masked) partners.free_b += row.reach;
  const Projection<pushes, R> apart(partners);
  row.reach == 1 ? within_row<masked, 1, R>(projection, apart, row.count)
                 : within_row<masked, 2, R>(projection, apart, row.count);
}

template <bool masked, class R>
void damp(const DampingRow<R>& row) {
  const Damping<R> damping(row);
  if (row.reach == 0) return between_rows<masked, R>(damping, 0, row.count);
  DampingRow<R> partners = row;
  partners.v_b += row.reach;
  if (masked) partners.free_b += row.reach;
  const Damping<R> apart(partners);
  row.reach == 1 ? within_row<masked, 1, R>(damping, apart, row.count)
                 : within_row<masked, 2, R>(damping, apart, row.count);
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
