#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/projection_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
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

/// Something of both ends of a vector of springs.
template <class D>
struct Ends {
  Lanes<D> a, b;
};
template <class D>
struct Ends3 {
  Vec3<D> a, b;
};

/// The springs from the n-th on between two rows.
template <class Some>
struct BetweenRows {
  using Tag = typename Some::Tag;
  using T = hn::TFromD<Tag>;
  Some some;
  int n;

  HWY_INLINE Ends<Tag> load(const T* a, const T* b) const { return {some.load(a + n), some.load(b + n)}; }
  HWY_INLINE void store(Ends<Tag> v, T* a, T* b) const { some.store(v.a, a + n), some.store(v.b, b + n); }
  HWY_INLINE Lanes<Tag> load_spring(const T* from) const { return some.load(from + n); }
  HWY_INLINE void store_spring(Lanes<Tag> v, T* to) const { some.store(v, to + n); }
};

/// From two vectors of a row's particles to the springs' first ends and their second ones, or back: what stands at the
/// second ends in the first vector changes places with what stands at the first ends in the second.
template <int reach, class D>
HWY_INLINE Ends<D> exchanged(Lanes<D> first, Lanes<D> second) {
#if HWY_TARGET == HWY_SCALAR
  return {first, second};
#else
  constexpr int lanes = int(hn::MaxLanes(D())), per_block = 16 / int(sizeof(hn::TFromD<D>));
  if constexpr (lanes == reach) {
    return {first, second};
  } else if constexpr (per_block == reach) {
    return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(second.v), first.v),
            hn::OddEvenBlocks(second.v, hn::SwapAdjacentBlocks(first.v))};
  } else if constexpr (per_block == 2 * reach) {
    const hn::Repartition<double, D> d;
    const auto from = hn::BitCast(d, first.v), to = hn::BitCast(d, second.v);
    return {hn::BitCast(D(), hn::InterleaveLower(d, from, to)), hn::BitCast(D(), hn::InterleaveUpper(d, from, to))};
  } else {
    return {hn::OddEven(hn::DupEven(second.v), first.v), hn::OddEven(second.v, hn::DupOdd(first.v))};
  }
#endif
}

/// The springs of two vectors of a row's particles, from the n-th particle on. Their own values lie side by side.
template <int reach, class Some>
struct WithinRow {
  using Tag = typename Some::Tag;
  using T = hn::TFromD<Tag>;
  static constexpr int lanes = int(hn::MaxLanes(Tag()));
  Some first, second;
  int n;

  HWY_INLINE Ends<Tag> load(const T* row, const T*) const {
    return exchanged<reach>(first.load(row + n), second.load(row + n + lanes));
  }
  HWY_INLINE void store(Ends<Tag> v, T* row, T*) const {
    const Ends<Tag> back = exchanged<reach>(v.a, v.b);
    first.store(back.a, row + n), second.store(back.b, row + n + lanes);
  }
  HWY_INLINE Lanes<Tag> load_spring(const T* from) const { return hn::LoadU(Tag(), from + n / 2); }
  HWY_INLINE void store_spring(Lanes<Tag> v, T* to) const { hn::StoreU(v.v, Tag(), to + n / 2); }
};

template <class Springs, class T, class D = typename Springs::Tag>
HWY_INLINE Ends3<D> load(Springs springs, const T* a, const T* b, std::ptrdiff_t stride) {
  const Ends<D> x = springs.load(a, b), y = springs.load(a + stride, b + stride),
                z = springs.load(a + 2 * stride, b + 2 * stride);
  return {{x.a, y.a, z.a}, {x.b, y.b, z.b}};
}
template <class Springs, class T, class D = typename Springs::Tag>
HWY_INLINE void store(Springs springs, Vec3<D> at_a, Vec3<D> at_b, T* a, T* b, std::ptrdiff_t stride) {
  springs.store({at_a.x, at_b.x}, a, b), springs.store({at_a.y, at_b.y}, a + stride, b + stride);
  springs.store({at_a.z, at_b.z}, a + 2 * stride, b + 2 * stride);
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
HWY_INLINE Ends<D> weighed(Weights<D> w, Lanes<D> part) {
  return {w.a * part, w.b * part};
}
template <class D>
HWY_INLINE Ends<D> weighed(AllFree<D>, Lanes<D> part) {
  return {part, part};
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
template <bool masked, class Springs, class R>
HWY_INLINE auto weights_of(Springs springs, const SpringRow<R>& t) {
  using D = typename Springs::Tag;
  if constexpr (masked) {
    const Lanes<D> whole = springs.load(t.whole, t.whole).a;
    const Ends<D> free = springs.load(t.free_a, t.free_b);
    const Lanes<D> on_a = whole * free.a, on_b = whole * free.b;
    return Weights<D>{on_a, on_b, on_a + on_b};
  } else {
    return AllFree<D>{};
  }
}

/// One step of Gauss-Seidel on springs. `pushes`: as in ProjectionRow.
template <bool pushes, class R>
class Projection {
 public:
  explicit HWY_INLINE Projection(const ProjectionRow<R>& row) : row_(row), least_(row.rest * shortest) {}

  template <bool masked, class Springs>
  HWY_INLINE void operator()(Springs springs) const {
    using D = typename Springs::Tag;
    const auto w = weights_of<masked>(springs, row_);
    const Ends3<D> x = load(springs, row_.x_a, row_.x_b, row_.stride),
                   q = load(springs, row_.q_a, row_.q_b, row_.stride);
    const Vec3<D> d = x.b - x.a + (q.b - q.a);
    const Ends<D> part = weighed(w, moved(springs, d, w));
    store(springs, subtract_times(part.a, d, q.a), multiply_add(part.b, d, q.b), row_.q_a, row_.q_b, row_.stride);
  }

 private:
  /// The displacement of an end that weighs 1, in parts of d, the way from a to b.
  template <class Springs, class D, template <class> class Weight>
  HWY_INLINE Lanes<D> moved(Springs springs, Vec3<D> d, Weight<D> w) const {
    using L = Lanes<D>;
    const Root<D> length = root_of(dot(d, d));
    const L per = by_weight(w, L::all(row_.per_both), L::all(row_.per_one)), old = springs.load_spring(row_.lambda);
    // (rest - compliance λ - length) per, with as little as can be after the length, for which everything waits.
    const L without_length = per * subtract_times(L::all(row_.compliance), old, L::all(row_.rest));
    const L wanted = subtract_times(length.root, per, without_length), none_left = L() - old;
    const L change = pushes ? hn::Max(wanted.v, none_left.v) : hn::Min(wanted.v, none_left.v);
    // Shorter than that a spring has no direction; nor is there anything to move between two fixed ends.
    auto acts = hn::Gt(length.root.v, L::all(least_).v);
    if constexpr (std::is_same_v<Weight<D>, Weights<D>>) acts = hn::And(acts, hn::Gt(w.sum.v, hn::Zero(D())));
    const L made = hn::IfThenElseZero(acts, change.v);
    springs.store_spring(old + made, row_.lambda);
    return made * hn::IfThenElseZero(acts, length.inverse.v);
  }

  const ProjectionRow<R> row_;
  const double least_;
};

template <class R>
class Damping {
 public:
  explicit HWY_INLINE Damping(const DampingRow<R>& row) : row_(row) {}

  template <bool masked, class Springs>
  HWY_INLINE void operator()(Springs springs) const {
    using D = typename Springs::Tag;
    const auto w = weights_of<masked>(springs, row_);
    const Ends3<D> v = load(springs, row_.v_a, row_.v_b, row_.stride);
    const Vec3<D> d = v.b - v.a;
    const Ends<D> part = weighed(w, by_weight(w, Lanes<D>::all(row_.both), Lanes<D>::all(row_.one)));
    store(springs, multiply_add(part.a, d, v.a), subtract_times(part.b, d, v.b), row_.v_a, row_.v_b, row_.stride);
  }

 private:
  const DampingRow<R> row_;
};

/// The springs between two rows, [n, end).
template <bool masked, class R, class Operation>
HWY_INLINE void between_rows(const Operation& operation, int n, int end) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  for (; n + lanes <= end; n += lanes) operation.template operator()<masked>(BetweenRows<AllLanes<D>>{{}, n});
  if (n < end) operation.template operator()<masked>(BetweenRows<FirstLanes<D>>{FirstLanes<D>(end - n), n});
}

/// The springs within a row, likewise. `apart`: the operation with each particle's partner in the place of b.
template <bool masked, int reach, class R, class Operation>
HWY_INLINE void within_row(const Operation& operation, const Operation& apart, int count) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D())), group = 2 * reach;
  int n = 0;
  if constexpr (lanes >= reach) {
    for (; n + 2 * lanes <= count; n += 2 * lanes)
      operation.template operator()<masked>(WithinRow<reach, AllLanes<D>>{{}, {}, n});
    // Whole groups: what has no partner would be joined to a zero.
    if (const int left = (count - n) / group * group; left > 0) {
      const FirstLanes<D> first(std::min(left, lanes)), second(std::max(left - lanes, 0));
      operation.template operator()<masked>(WithinRow<reach, FirstLanes<D>>{first, second, n});
      n += left;
    }
  }
  // The value of such a spring lies where that of none is, or of one between two zeros.
  for (; n + reach < count; n += group) between_rows<masked, R>(apart, n, n + std::min(reach, count - n - reach));
}

/// Each particle's partner in the place of b.
template <class R>
HWY_INLINE void look_at_partners(ProjectionRow<R>& row) {
  row.x_b += row.reach, row.q_b += row.reach;
}
template <class R>
HWY_INLINE void look_at_partners(DampingRow<R>& row) {
  row.v_b += row.reach;
}

template <bool masked, class R, class Operation, class Row>
HWY_INLINE void through_row(const Row& row) {
  assert(row.count > 0 && row.stride > 0 && row.reach >= 0 && row.reach <= 2);
  assert(masked == (row.whole != nullptr) && masked == (row.free_a != nullptr) && masked == (row.free_b != nullptr));
  const Operation operation(row);
  if (row.reach == 0) return between_rows<masked, R>(operation, 0, row.count);
  Row partners = row;
  look_at_partners(partners);
  if (masked) partners.free_b += row.reach;
  const Operation apart(partners);
  row.reach == 1 ? within_row<masked, 1, R>(operation, apart, row.count)
                 : within_row<masked, 2, R>(operation, apart, row.count);
}

template <bool masked, class R>
void project(const ProjectionRow<R>& row) {
  assert(row.rest > 0 && row.compliance >= 0);
  row.pushes ? through_row<masked, R, Projection<true, R>>(row) : through_row<masked, R, Projection<false, R>>(row);
}
template <bool masked, class R>
void damp(const DampingRow<R>& row) {
  through_row<masked, R, Damping<R>>(row);
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
