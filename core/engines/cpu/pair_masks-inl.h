// Masks of a block: which lanes have springs and triangles, and which may move, at the ends of rows, in the last rows,
// and near torn, pinned or held particles. Included once for each SIMD target, so the guard toggles.
#if defined(TYGLAB_PAIR_MASKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_PAIR_MASKS_INL_H_
#undef TYGLAB_PAIR_MASKS_INL_H_
#else
#define TYGLAB_PAIR_MASKS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/pair_sweep.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

/// Whether `count` bytes, rounded up to eights, all hold `value`.
template <int count>
HWY_INLINE bool all_equal(const std::uint8_t* bytes, std::uint8_t value) {
  const std::uint64_t pattern = value * 0x0101010101010101ull;
  std::uint64_t difference = 0;
  for (int n = 0; n < count; n += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + n, sizeof word);
    difference |= word ^ pattern;
  }
  return difference == 0;
}

/// Lanes of one row of a block: springs that exist and are whole, whole triangles (index: which of a quad), free
/// particles.
template <class D>
struct Masks {
  hn::Mask<D> E, S, SE, SW, EE, SS, triangle[2], moving;
};

/// Lanes whose quad has an odd number i + j, so that its diagonal runs the other way (figure 2.7). Rows 0 and 1 of a
/// pair; the same for every block of a row, unless that is one lane.
template <class D>
HWY_INLINE hn::Mask<D> odd_quads(int row, int j) {
  constexpr hn::RebindToUnsigned<D> du;
  using U = hn::TFromD<decltype(du)>;
  const U first = U(hn::MaxLanes(D()) == 1 ? row + j : row);
  return hn::RebindMask(D(), hn::TestBit(hn::Iota(du, first), hn::Set(du, U(1))));
}

/// A triangle is whole while its three edge springs are.
template <class D>
HWY_INLINE void mask_torn_triangles(const std::uint8_t* own, const std::uint8_t* below, hn::Mask<D> odd, Masks<D>& m) {
  const auto S_right = bits_set<D>(own + 1, bit_S), E_below = bits_set<D>(below, bit_E);
  const auto choose = [&](hn::Mask<D> yes, hn::Mask<D> no) { return hn::Or(hn::And(odd, yes), hn::AndNot(odd, no)); };
  m.triangle[0] = hn::And(m.triangle[0], hn::And(m.S, choose(hn::And(m.E, m.SW), hn::And(E_below, m.SE))));
  m.triangle[1] = hn::And(m.triangle[1], hn::And(S_right, choose(hn::And(E_below, m.SW), hn::And(m.E, m.SE))));
}

/// Of row `row` (0, 1) of the pair, for the block at column j.
template <class R, class D>
HWY_INLINE Masks<D> masks_of(const PairTask<R>& t, int row, int j) {
  assert((row == 0 || row == 1) && j >= 0 && j < t.columns);
  constexpr D d;
  const auto first = [&](int lanes) { return hn::FirstN(d, std::size_t(std::max(0, lanes))); };
  const int under = t.rows_below - row;
  const int right = under >= 0 ? t.columns - j : 0;
  const int below = under >= 1 ? right : 0, below2 = under >= 2 ? right : 0;
  auto quads = first(below - 1);
  Masks<D> m{first(right - 1), first(below),  quads,          quads,
             first(right - 2), first(below2), {quads, quads}, first(right)};
  if (t.whole && under >= 0) {
    const std::uint8_t *own = t.whole + row * t.columns + j, *next = own + (under >= 1 ? t.columns : 0);
    m.E = hn::And(m.E, bits_set<D>(own, bit_E));
    m.S = hn::And(m.S, bits_set<D>(own, bit_S));
    m.SE = hn::And(m.SE, bits_set<D>(own, bit_SE));
    m.SW = hn::And(m.SW, bits_set<D>(own + 1, bit_SW));
    m.EE = hn::And(m.EE, bits_set<D>(own, bit_EE));
    m.SS = hn::And(m.SS, bits_set<D>(own, bit_SS));
    mask_torn_triangles<D>(own, next, odd_quads<D>(row, j), m);
  }
  if (t.fixed[row]) m.moving = hn::AndNot(bits_set<D>(t.fixed[row] + j, 1), m.moving);
  return m;
}

/// Whether nothing in the block at column j is torn, pinned or held.
template <class R, class D>
HWY_INLINE bool untouched(const PairTask<R>& t, int j) {
  constexpr int lanes = int(hn::MaxLanes(D()));
  for (const std::uint8_t* fixed : t.fixed)
    if (fixed && !all_equal<lanes>(fixed + j, 0)) return false;
  if (t.whole)
    for (int row = 0; row < 3; ++row)
      if (!all_equal<lanes + 1>(t.whole + row * t.columns + j, all_springs)) return false;
  return true;
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
