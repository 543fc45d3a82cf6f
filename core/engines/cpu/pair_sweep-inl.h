// The sweep itself, for any precision and instruction set; pair_sweep_float.cpp and pair_sweep_double.cpp compile it.
// Included once for each SIMD target, so the guard toggles.
#if defined(TYGLAB_PAIR_SWEEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_PAIR_SWEEP_INL_H_
#undef TYGLAB_PAIR_SWEEP_INL_H_
#else
#define TYGLAB_PAIR_SWEEP_INL_H_
#endif

#include <hwy/highway.h>

#include <cassert>
#include <limits>
#include <utility>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/pair_masks-inl.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"
#include "core/simd/row_field.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::HWY_NAMESPACE;
using namespace tyglab::simd::HWY_NAMESPACE;
using simd::widest_vector;

/// Makes the compiler believe that something in memory has changed, so that it reads what was stored there where it is
/// used, as an operand of an instruction. Registers cannot hold all that a row computes (16 of AVX2, 32 of AVX-512),
/// and what compilers write to the stack and read again in order to free some costs more.
template <class T>
HWY_INLINE void settle(T& stored) {
  asm volatile("" : "+m"(stored));
}

/// Two rows, block by block. F: features; displacements: the task's update is Update::displacement.
template <class R, unsigned F, bool displacements>
class PairSweep {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;
  using M = hn::Mask<D>;
  static constexpr int lanes = int(hn::MaxLanes(D()));
  /// Otherwise all stretch springs have the weft's constant, which takes a register less.
  static constexpr bool own = (F & threads) != 0;

 public:
  explicit HWY_INLINE PairSweep(const PairTask<R>& task)
      : t_(task),
        stride_(task.stride),
        pitch_(3 * task.stride),
        columns_(task.columns),
        x_(task.x),
        v_(task.v),
        f_{task.f[0], task.f[1], task.f[2], task.f[3]},
        weft_(Spring<L>::of(task.weft, task.L * directions[0].rest, &L::all)),
        warp_(Spring<L>::of(own ? task.warp : task.weft, task.L * directions[1].rest, &L::all)),
        shear_(Spring<L>::of(own ? task.shear : task.weft, task.L * directions[2].rest, &L::all)),
        bending_(Spring<L>::of(task.bend, task.L * directions[4].rest, &L::all)),
        k_d_(L::all(task.k_d)),
        weight_(L::all(task.weight)),
        v_to_x_(L::all(task.v_to_x)),
        force_to_x_(L::all(task.force_to_x)),
        force_to_v_(L::all(task.force_to_v)),
        keeps_force_(task.update == Update::force),
        dt_v_(L::all(task.dt_v)),
        third_of_W_(L::all(task.W[0] / 3), L::all(task.W[1] / 3), L::all(task.W[2] / 3)),
        u_(L::all(task.u[0]), L::all(task.u[1]), L::all(task.u[2])),
        air_across_(L::all(task.air_across)),
        air_along_(L::all(task.air_along)),
        air_most_(L::all(task.air_most)),
        largest_(L::load(task.max_displacement)) {}

  HWY_INLINE void run() {
    assert(columns_ > 0 && columns_ <= stride_ && t_.rows_below >= 0);
    int j = 0;
    Carries carries;
    if (t_.rows_below >= 3) {
      const bool plain = !t_.whole && !t_.fixed[0] && !t_.fixed[1];
      for (; j + lanes + 2 <= columns_; j += lanes)
        if (plain || untouched<R, D>(t_, j))
          block<false>(j, carries);
        else
          block<true>(j, carries);
    }
    for (; j < columns_; j += lanes) block<true>(j, carries);
    largest_.store(t_.max_displacement);
  }

 private:
  /// The springs that a particle A of a row owns, with B to its right, C below it and E below B: A-B, A-C, A-E, and B-C
  /// in place of its left neighbor's; then A to the second particle to its right and below it.
  enum Of { right, down, diagonal, crossing, two_right, two_down, springs };
  using Difference = R[3][lanes];
  /// What the differences along them are multiplied by.
  struct Factors {
    L right, down, diagonal, crossing, two_right, two_down;
    HWY_INLINE Factors() {}
  };
  /// Where a component of a row of a block is: positions, velocities, and forces on the row and on rows i+2 and i+3.
  struct Place {
    R *x, *v, *f, *f_below, *f_below2;
    HWY_INLINE void next(std::ptrdiff_t stride) {
      x += stride, v += stride, f += stride, f_below += stride, f_below2 += stride;
    }
  };
  /// Forces on the right ends of springs: of rows i and i+1 and reactions in row i+2, by component; then those on
  /// particles two to the right, in rows i and i+1.
  struct Carries {
    LaneCarry<1, D> right[3][3];
    LaneCarry<2, D> two_right[2][3];
    HWY_INLINE Carries() {}
  };
  /// What a row takes from the particles below it, as forces to subtract, by component: from C below, its right
  /// neighbor E, and G two rows below.
  struct Reactions {
    alignas(widest_vector) Difference c, e, g;
  };
  /// Wind on the two triangles of each quad A B C E, as forces on their corners, by component. Even quads are split
  /// from A to E, odd ones from C to B (figure 2.7); the first triangle always has A and C, the second B and E.
  struct OnTriangles {
    L first[3], second[3];
    HWY_INLINE OnTriangles() {}
  };

  template <bool masked>
  static HWY_INLINE L kept(M mask, L force) {
    if constexpr (masked)
      return hn::IfThenElseZero(mask, force.v);
    else
      return (void)mask, force;
  }

  HWY_INLINE V load(const R* p) const { return V::load(p, stride_); }

  /// |d|²; stores d.
  static HWY_INLINE L squared(V d, Difference& to) {
    d.x.store(to[0]), d.y.store(to[1]), d.z.store(to[2]);
    return dot(d, d);
  }

  /// Springs of the particles at x…, one after another: their differences and factors.
  HWY_INLINE Factors measure(const R* x, const R* constants, Difference (&x_ij)[springs]) const {
    Factors s;
    const R* const below = x + pitch_;
    const V A = load(x), B = load(x + 1);
    s.right = stretch_factor(weft_, squared(B - A, x_ij[right]));
    const V C = load(below);
    s.crossing = stretch_factor(shear_, squared(C - B, x_ij[crossing]));
    s.down = stretch_factor(own ? warp_ : weft_, squared(C - A, x_ij[down]));
    s.diagonal = stretch_factor(shear_, squared(load(below + 1) - A, x_ij[diagonal]));
    if constexpr ((F & bending) != 0) {
      s.two_right = bend_factor(bending_, squared(load(x + 2) - A, x_ij[two_right]));
      s.two_down = bend_factor(bending_, squared(load(below + pitch_) - A, x_ij[two_down]));
    }
    if constexpr ((F & linear) != 0) {
      L* const factors[] = {&s.right, &s.down, &s.diagonal, &s.crossing, &s.two_right, &s.two_down};
      for (int n = 0; n < springs; ++n) *factors[n] = *factors[n] + L::load(constants + n * stride_);
    }
    return s;
  }

  static HWY_INLINE V pick(M mask, V yes, V no) {
    return {hn::IfThenElse(mask, yes.x.v, no.x.v), hn::IfThenElse(mask, yes.y.v, no.y.v),
            hn::IfThenElse(mask, yes.z.v, no.z.v)};
  }
  template <bool masked>
  HWY_INLINE OnTriangles blow(M odd, const Difference (&x_ij)[springs], const R* v, const Masks<D>& m) const {
    const auto difference = [&](int n) HWY_ATTR { return V::load(x_ij[n][0], lanes); };
    const V to_B = difference(right), to_C = difference(down), to_E = difference(diagonal);
    const V below = to_E - to_C, beside = to_E - to_B;  // C-E, B-E
    const V first_n = cross(to_C, pick(odd, to_B, below)), second_n = cross(beside, pick(odd, below, to_B));
    V first = wind_on_corner(first_n, third_of_W_, smallest_);
    V second = wind_on_corner(second_n, third_of_W_, smallest_);
    if constexpr ((F & air) != 0) {
      const V A = load(v), B = load(v + 1), C = load(v + pitch_), E = load(v + pitch_ + 1);
      const L third = L::all(1.0 / 3);
      const auto resist = [&](V n, V sum) HWY_ATTR {
        return air_on_corner(n, u_ - third * sum, air_across_, air_along_, air_most_, smallest_);
      };
      first = first + resist(first_n, (A + C) + pick(odd, B, E));
      second = second + resist(second_n, (B + E) + pick(odd, C, A));
    }
    OnTriangles w;
    w.first[0] = first.x, w.first[1] = first.y, w.first[2] = first.z;
    w.second[0] = second.x, w.second[1] = second.y, w.second[2] = second.z;
    for (int c = 0; c < 3; ++c)
      w.first[c] = kept<masked>(m.triangle[0], w.first[c]), w.second[c] = kept<masked>(m.triangle[1], w.second[c]);
    return w;
  }

  /// One component of the forces of a row's springs and triangles, and its update. `across`: see sweep().
  template <bool masked, int row, int c>
  HWY_INLINE void move(const Place& p, const Difference (&x_ij)[springs], const Factors& s, const OnTriangles& w, M odd,
                       const Masks<D>& m, Carries& carries, Reactions& across) {
    const L v_A = L::load(p.v);
    L f_right = s.right * L::load(x_ij[right][c]), f_down = s.down * L::load(x_ij[down][c]);
    L f_diagonal = s.diagonal * L::load(x_ij[diagonal][c]), f_crossing = s.crossing * L::load(x_ij[crossing][c]);
    if constexpr ((F & damping) != 0) {
      const L v_B = L::load(p.v + 1), v_C = L::load(p.v + pitch_), v_E = L::load(p.v + pitch_ + 1);
      f_right = multiply_add(k_d_, v_B - v_A, f_right);
      f_down = multiply_add(k_d_, v_C - v_A, f_down);
      f_crossing = multiply_add(k_d_, v_C - v_B, f_crossing);
      f_diagonal = multiply_add(k_d_, v_E - v_A, f_diagonal);
    }
    f_right = kept<masked>(m.E, f_right), f_down = kept<masked>(m.S, f_down);
    f_diagonal = kept<masked>(m.SE, f_diagonal), f_crossing = kept<masked>(m.SW, f_crossing);
    L on_A = f_right + f_down + f_diagonal, on_B = f_crossing - f_right;
    L from_C = f_down + f_crossing, from_E = f_diagonal;
    if constexpr (row == 1) on_A = on_A - L::load(across.c[c]), on_B = on_B - L::load(across.e[c]);
    if constexpr ((F & wind) != 0) {
      const M even = hn::Not(odd);
      const L first = w.first[c], second = w.second[c];
      on_A = add_where<D>(even, on_A + first, second), on_B = add_where<D>(odd, on_B + second, first);
      from_C = from_C - add_where<D>(odd, first, second), from_E = from_E - add_where<D>(even, second, first);
    }
    if constexpr (row == 0)
      from_C.store(across.c[c]), from_E.store(across.e[c]);
    else
      (L::load(across.g[c]) + from_C + carries.right[2][c](from_E)).store(p.f_below);
    L from_G;
    if constexpr ((F & bending) != 0) {
      const L f_two_right = kept<masked>(m.EE, s.two_right * L::load(x_ij[two_right][c]));
      from_G = kept<masked>(m.SS, s.two_down * L::load(x_ij[two_down][c]));
      on_A = on_A + from_G + f_two_right;
      on_A = on_A - carries.two_right[row][c](f_two_right);
    }
    if constexpr (row == 0)
      from_G.store(across.g[c]);
    else
      from_G.store(p.f_below2);
    const L moved = carries.right[row][c](on_B);
    L force = on_A + moved - L::load(p.f);
    if constexpr (c == 1) force = force - weight_;
    update<masked, row>(p, v_A, force, m.moving);
  }

  /// One row of a block, in two passes, since its differences do not fit in registers: lengths need all components, and
  /// forces need one at a time. x and v go on to the next row. `across`: what the upper row takes from the lower.
  template <bool masked, int row>
  HWY_INLINE void sweep(int j, R*& x, R*& v, Carries& carries, Reactions& across) {
    Masks<D> m = masked ? masks_of<R, D>(t_, row, j) : Masks<D>{};
    alignas(widest_vector) Difference x_ij[springs];
    Factors s = measure(x, (F & linear) != 0 ? t_.linear[row] + j : nullptr, x_ij);
    OnTriangles w;
    const M odd = odd_quads<D>(row, j);
    if constexpr ((F & wind) != 0) w = blow<masked>(odd, x_ij, v, m);
    settle(x_ij);
    Place p{x, v, f_[row] + j, f_[2] + j, f_[3] + j};
    move<masked, row, 0>(p, x_ij, s, w, odd, m, carries, across), p.next(stride_);
    move<masked, row, 1>(p, x_ij, s, w, odd, m, carries, across), p.next(stride_);
    move<masked, row, 2>(p, x_ij, s, w, odd, m, carries, across), p.next(stride_);
    x = p.x, v = p.v;
  }

  template <bool masked>
  HWY_INLINE void block(int j, Carries& carries) {
    R *x = x_ + j, *v = v_ + j;
    Reactions across;
    sweep<masked, 0>(j, x, v, carries, across);
    settle(across);
    sweep<masked, 1>(j, x, v, carries, across);
    settle(carries);
  }

  /// What becomes of a component of the force on a row.
  template <bool masked, int row>
  HWY_INLINE void update(const Place& p, L v, L force, M moving) {
    if constexpr (!displacements)
      if (keeps_force_) return force.store(p.f);
    if constexpr (masked) {
      if (t_.fixed[row]) force.store(p.f);  // the hand's force is read there
      force = kept<true>(moving, force);
    }
    const L x = L::load(p.x);
    if constexpr (displacements) {
      const L d = multiply_add(force_to_v_, force, v);
      watch(d);
      d.store(p.v);
      (x + d).store(p.x);
    } else {
      const L way = multiply_add(force_to_x_, force, v_to_x_ * v);
      const L next = multiply_add(force_to_v_, force, v);
      watch(way);
      watch(dt_v_ * next);
      next.store(p.v);
      (x + way).store(p.x);
    }
  }

  /// Keeps the largest |component|. Compared as integers, since then NaN and ∞ are larger than every number.
  HWY_INLINE void watch(L way) {
    constexpr hn::RebindToUnsigned<D> du;
    largest_ = hn::BitCast(D(), hn::Max(hn::BitCast(du, largest_.v), hn::BitCast(du, hn::Abs(way.v))));
  }

  const PairTask<R>& t_;
  // Copies, since a compiler must think that stores into the arrays might change the task.
  const std::ptrdiff_t stride_, pitch_;
  const int columns_;
  R *const x_, *const v_, *const f_[4];
  const Spring<L> weft_, warp_, shear_, bending_;
  const L k_d_, weight_, v_to_x_, force_to_x_, force_to_v_;
  const bool keeps_force_;
  const L dt_v_;
  const V third_of_W_, u_;
  const L air_across_, air_along_, air_most_;
  const L smallest_ = L::all(double(std::numeric_limits<R>::min()));
  L largest_;
};

/// The fallbacks of processors from before AVX2 (2013) have all features compiled in; what is off has constants of 0
/// there. Each would take as long to compile as an instruction set that is used. For the same reason `linear` and
/// `threads` bring bending and damping with them, and `air` these and wind. A page, whose sweeps are loaded before its
/// first frame, has a quarter as many: each takes 20 kB.
constexpr bool fallback = HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSE4;
constexpr bool page = HWY_ARCH_WASM;

/// The features with which those of F are compiled.
template <bool displacements>
constexpr unsigned compiled_with(unsigned F) {
  constexpr unsigned every_scene = bending | damping | wind;
  const bool few = (F & (linear | air | threads)) != 0;
  if (page) return F | damping | (displacements ? 0u : every_scene) | (few ? every_scene | air | threads : 0u);
  if (fallback) return F | every_scene | threads;
  if ((F & air) != 0) return F | every_scene;
  return few ? F | bending | damping : F;
}

template <class R, unsigned F, bool displacements>
void sweep_pair(const PairTask<R>& task) {
  constexpr unsigned compiled = compiled_with<displacements>(F);
  if constexpr (F != compiled) {
    PairTask<R> t = task;
    if ((F & bending) == 0) t.bend = 0;
    if ((F & damping) == 0) t.k_d = 0;
    if ((F & wind) == 0) t.W[0] = t.W[1] = t.W[2] = 0;
    if ((F & air) == 0) t.air_across = t.air_along = t.air_most = 0;
    sweep_pair<R, compiled, displacements>(t);
  } else {
    PairSweep<R, F, displacements>(task).run();
  }
}

template <class R, std::size_t... F>
PairSweeps<R> table_of(std::index_sequence<F...>) {
  return {{{&sweep_pair<R, F, true>, &sweep_pair<R, F, false>}...},
          int(hn::MaxLanes(hn::ScalableTag<R>())),
          HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86 ? "AVX-512" : hwy::TargetName(HWY_TARGET)};
}
template <class R>
PairSweeps<R> table() {
  return table_of<R>(std::make_index_sequence<feature_sets>());
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
