#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/row_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/row_sweep.h"
#include "core/engines/cpu/simd-inl.h"
#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::HWY_NAMESPACE;

/// Which springs of a block's lanes exist and are whole, and which lanes are free particles.
template <class D>
struct Masks {
  hn::Mask<D> E, S, SE, SW, EE, SS, moving;
};

/// Lanes whose bit is set in N bytes.
template <class D>
HWY_INLINE hn::Mask<D> bits_set(const std::uint8_t* bytes, unsigned bit) {
  using T = hn::TFromD<D>;
  constexpr hn::Rebind<std::uint32_t, D> d32;
  const auto words = hn::PromoteTo(d32, hn::LoadU(hn::Rebind<std::uint8_t, D>(), bytes));
  if constexpr (sizeof(T) == 4) {
    return hn::RebindMask(D(), hn::TestBit(words, hn::Set(d32, bit)));
  } else {
    constexpr hn::Rebind<std::uint64_t, D> d64;
    return hn::RebindMask(D(), hn::TestBit(hn::PromoteTo(d64, words), hn::Set(d64, std::uint64_t(bit))));
  }
}

template <class R, class D>
HWY_INLINE Masks<D> masks_of(const RowTask<R>& t, int j) {
  constexpr D d;
  const auto first = [&](int lanes) { return hn::FirstN(d, std::size_t(std::max(0, lanes))); };
  const int right = t.columns - j;
  const int below = t.rows_below >= 1 ? right : 0, below2 = t.rows_below >= 2 ? right : 0;
  Masks<D> m{first(right - 1), first(below),  first(below - 1), first(below - 1),
             first(right - 2), first(below2), first(right)};
  if (t.whole) {
    const std::uint8_t* own = t.whole + j;
    m.E = hn::And(m.E, bits_set<D>(own, bit_E));
    m.S = hn::And(m.S, bits_set<D>(own, bit_S));
    m.SE = hn::And(m.SE, bits_set<D>(own, bit_SE));
    m.SW = hn::And(m.SW, bits_set<D>(own + 1, bit_SW));
    m.EE = hn::And(m.EE, bits_set<D>(own, bit_EE));
    m.SS = hn::And(m.SS, bits_set<D>(own, bit_SS));
  }
  if (t.fixed) m.moving = hn::AndNot(bits_set<D>(t.fixed + j, 1), m.moving);
  return m;
}

/// One row, block by block. F: features; U: update.
template <class R, unsigned F, Update U>
class RowSweep {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;
  static constexpr int lanes = int(hn::MaxLanes(D()));

 public:
  explicit HWY_INLINE RowSweep(const RowTask<R>& task)
      : t_(task),
        straight_(Spring<L>::of(task.k_s, task.L * directions[0].rest, &L::all)),
        diagonal_(Spring<L>::of(task.k_s, task.L * directions[2].rest, &L::all)),
        bending_(Spring<L>::of(task.k_b, task.L * directions[4].rest, &L::all)),
        k_d_(L::all(task.k_d)),
        weight_(L::all(task.weight)),
        v_to_x_(L::all(task.v_to_x)),
        force_to_x_(L::all(task.force_to_x)),
        force_to_v_(L::all(task.force_to_v)),
        dt_v_(L::all(task.dt_v)),
        largest_(L::load(task.largest_way)) {}

  HWY_INLINE void run() {
    int j = 0;
    const bool plain = !t_.whole && !t_.fixed && t_.rows_below >= 2;
    if (plain)
      for (; j + lanes + 2 <= t_.columns; j += lanes) block<false>(j);
    for (; j < t_.columns; j += lanes) block<true>(j);
    largest_.store(t_.largest_way);
  }

 private:
  /// Force on p of the stretch spring from p to q, with its damping.
  HWY_INLINE V stretch(const Spring<L>& s, V p, V q, V vp, V vq) const {
    const V x_ij = q - p;
    const V pull = stretch_factor(s, dot(x_ij, x_ij), zero_) * x_ij;
    if constexpr ((F & damping) != 0)
      return multiply_add(k_d_, vq - vp, pull);
    else
      return pull;
  }
  HWY_INLINE V bend(V p, V q) const {
    const V x_ij = q - p;
    return bend_factor(bending_, dot(x_ij, x_ij), zero_) * x_ij;
  }

  /// A block of lanes at columns j…: A is the particle, B its right neighbour, C below, E below right.
  template <bool masked>
  HWY_INLINE void block(int j) {
    const std::ptrdiff_t s = t_.stride;
    const Masks<D> m = masked ? masks_of<R, D>(t_, j) : Masks<D>{};
    const auto kept = [](hn::Mask<D> mask, V force) {
      if constexpr (masked)
        return where<D>(mask, force);
      else
        return (void)mask, force;
    };
    const V A = V::load(t_.x, j), B = V::load(t_.x, j + 1), C = V::load(t_.x, j + s), E = V::load(t_.x, j + s + 1);
    const V vA = V::load(t_.v, j);
    V vB, vC, vE;
    if constexpr ((F & damping) != 0)
      vB = V::load(t_.v, j + 1), vC = V::load(t_.v, j + s), vE = V::load(t_.v, j + s + 1);

    const V right = kept(m.E, stretch(straight_, A, B, vA, vB));
    const V crossing = kept(m.SW, stretch(diagonal_, B, C, vB, vC));  // from B down to the left
    V force = right + to_right_(crossing - right);
    const V down = kept(m.S, stretch(straight_, A, C, vA, vC));
    const V diagonal = kept(m.SE, stretch(diagonal_, A, E, vA, vE));
    force = force + down + diagonal;
    (V::load(t_.f[1], j) - down - crossing - below_right_(diagonal)).store(t_.f[1], j);
    V two_down;
    if constexpr ((F & bending) != 0) {
      const V two_right = kept(m.EE, bend(A, V::load(t_.x, j + 2)));
      two_down = kept(m.SS, bend(A, V::load(t_.x, j + 2 * s)));
      force = force + two_right - to_right2_(two_right) + two_down;
    }
    (V() - two_down).store(t_.f[2], j);
    force = force + V::load(t_.f[0], j);
    force.y = force.y - weight_;
    update<masked>(j, A, vA, force, m);
  }

  template <bool masked>
  HWY_INLINE void update(int j, V x, V v, V force, const Masks<D>& m) {
    if constexpr (U == Update::force) {
      force.store(t_.f[0], j);
      return;
    }
    if constexpr (masked) {
      if (t_.fixed) force.store(t_.f[0], j);  // the hand's force is read there
      force = where<D>(m.moving, force);
    }
    if constexpr (U == Update::displacement) {
      const V d = multiply_add(force_to_v_, force, v);
      watch(d);
      d.store(t_.v, j);
      (x + d).store(t_.x, j);
    } else {
      const V way = multiply_add(force_to_x_, force, v_to_x_ * v);
      const V next = multiply_add(force_to_v_, force, v);
      watch(way);
      watch(dt_v_ * next);
      next.store(t_.v, j);
      (x + way).store(t_.x, j);
    }
  }

  /// Keeps the largest |component|. Compared as integers, since then NaN and ∞ are larger than every number.
  HWY_INLINE void watch(V way) {
    constexpr hn::RebindToUnsigned<D> du;
    const auto bits = [&](L c) { return hn::BitCast(du, hn::Abs(c.v)); };
    const auto most = hn::Max(bits(way.x), hn::Max(bits(way.y), bits(way.z)));
    largest_ = hn::BitCast(D(), hn::Max(hn::BitCast(du, largest_.v), most));
  }

  const RowTask<R>& t_;
  const Spring<L> straight_, diagonal_, bending_;
  const L k_d_, weight_, v_to_x_, force_to_x_, force_to_v_, dt_v_;
  const L zero_;
  L largest_;
  Carry<1, D> to_right_, below_right_;
  Carry<2, D> to_right2_;
};

/// Wind on the two triangles of each quad: A left above, B right above, C left below, E right below.
template <class R>
class RowWind {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;
  using M = hn::Mask<D>;
  static constexpr int lanes = int(hn::MaxLanes(D()));

 public:
  explicit HWY_INLINE RowWind(const RowTask<R>& task)
      : t_(task), W_(L::all(task.W[0]), L::all(task.W[1]), L::all(task.W[2])), third_(L::all(1.0 / 3)) {}

  HWY_INLINE void run() {
    for (int j = 0; j < t_.columns; j += lanes) block(j);
  }

 private:
  HWY_INLINE void block(int j) {
    constexpr D d;
    const std::ptrdiff_t s = t_.stride;
    const V A = V::load(t_.x, j), B = V::load(t_.x, j + 1), C = V::load(t_.x, j + s), E = V::load(t_.x, j + s + 1);
    constexpr hn::RebindToUnsigned<D> du;
    using U = hn::TFromD<decltype(du)>;
    const auto number = hn::Iota(du, U(j + t_.parity));
    const M odd = hn::RebindMask(d, hn::TestBit(number, hn::Set(du, U(1))));
    // Even quads are split from A to E, odd ones from C to B (figure 2.7).
    M whole1 = hn::FirstN(d, std::size_t(std::max(0, t_.columns - 1 - j))), whole2 = whole1;
    if (t_.whole) torn(j, odd, whole1, whole2);
    const V first = where<D>(whole1, wind_on_corner(C - A, pick(odd, B, E) - A, W_, third_, L()));
    const V from = pick(odd, C, A);
    const V second = where<D>(whole2, wind_on_corner(E - from, B - from, W_, third_, L()));
    const V first_odd = where<D>(odd, first), second_odd = where<D>(odd, second);
    const V on_A = first + (second - second_odd), on_B = second + first_odd;
    const V on_C = first + second_odd, on_E = second + (first - first_odd);
    (V::load(t_.f[0], j) + on_A + above_right_(on_B)).store(t_.f[0], j);
    (V::load(t_.f[1], j) + on_C + below_right_(on_E)).store(t_.f[1], j);
  }

  static HWY_INLINE V pick(M mask, V yes, V no) {
    return {hn::IfThenElse(mask, yes.x.v, no.x.v), hn::IfThenElse(mask, yes.y.v, no.y.v),
            hn::IfThenElse(mask, yes.z.v, no.z.v)};
  }

  /// A triangle is whole while its three edge springs are.
  HWY_INLINE void torn(int j, M odd, M& whole1, M& whole2) const {
    const std::uint8_t *own = t_.whole + j, *below = own + t_.columns;
    const M E = bits_set<D>(own, bit_E), S = bits_set<D>(own, bit_S), SE = bits_set<D>(own, bit_SE),
            SW = bits_set<D>(own + 1, bit_SW);
    const M S_right = bits_set<D>(own + 1, bit_S), E_below = bits_set<D>(below, bit_E);
    const auto choose = [&](M yes, M no) { return hn::Or(hn::And(odd, yes), hn::AndNot(odd, no)); };
    whole1 = hn::And(whole1, hn::And(S, choose(hn::And(E, SW), hn::And(E_below, SE))));
    whole2 = hn::And(whole2, hn::And(S_right, choose(hn::And(E_below, SW), hn::And(E, SE))));
  }

  const RowTask<R>& t_;
  const V W_;
  const L third_;
  Carry<1, D> above_right_, below_right_;
};

template <class R, unsigned F, Update U>
void sweep_row(const RowTask<R>& task) {
  RowSweep<R, F, U>(task).run();
}
template <class R>
void wind_row(const RowTask<R>& task) {
  RowWind<R>(task).run();
}

template <class R>
RowSweeps<R> table() {
  using enum Update;
  return {{{&sweep_row<R, 0, displacement>, &sweep_row<R, 0, general>, &sweep_row<R, 0, force>},
           {&sweep_row<R, 1, displacement>, &sweep_row<R, 1, general>, &sweep_row<R, 1, force>},
           {&sweep_row<R, 2, displacement>, &sweep_row<R, 2, general>, &sweep_row<R, 2, force>},
           {&sweep_row<R, 3, displacement>, &sweep_row<R, 3, general>, &sweep_row<R, 3, force>}},
          &wind_row<R>,
          int(hn::MaxLanes(hn::ScalableTag<R>())),
          hwy::TargetName(HWY_TARGET)};
}
RowSweeps<float> table_float() {
  return table<float>();
}
RowSweeps<double> table_double() {
  return table<double>();
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(table_float);
HWY_EXPORT(table_double);

template <>
RowSweeps<float> row_sweeps<float>() {
  return HWY_DYNAMIC_DISPATCH(table_float)();
}
template <>
RowSweeps<double> row_sweeps<double>() {
  return HWY_DYNAMIC_DISPATCH(table_double)();
}

}  // namespace tyglab::cpu
#endif
