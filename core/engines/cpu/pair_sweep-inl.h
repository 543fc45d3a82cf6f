// The sweep itself, for any precision and instruction set; pair_sweep_float.cpp and pair_sweep_double.cpp compile it.
// Included once for each SIMD target, so the guard toggles.
#if defined(TYGLAB_PAIR_SWEEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYGLAB_PAIR_SWEEP_INL_H_
#undef TYGLAB_PAIR_SWEEP_INL_H_
#else
#define TYGLAB_PAIR_SWEEP_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>
#include <utility>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/pair_masks-inl.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::HWY_NAMESPACE;
using namespace tyglab::simd::HWY_NAMESPACE;

/// What a row of a block has four of, one for each stretch spring that its particles own or, for `crossing`, that their
/// right neighbors own. With A a particle, B to its right, C below it and E below B: A-B, A-C, A-E, B-C.
template <class D>
struct Four {
  using V = Vec3<D>;
  V right, down, diagonal, crossing;
  // Written out, as in Vec3.
  HWY_INLINE Four() {}
  HWY_INLINE Four(V r, V d, V g, V c) : right(r), down(d), diagonal(g), crossing(c) {}
};

/// Two rows, block by block. F: features; displacements: the task's update is Update::displacement.
template <class R, unsigned F, bool displacements>
class PairSweep {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  using V = Vec3<D>;
  using M = hn::Mask<D>;
  static constexpr int lanes = int(hn::MaxLanes(D()));

 public:
  explicit HWY_INLINE PairSweep(const PairTask<R>& task)
      : t_(task),
        stride_(task.stride),
        pitch_(3 * task.stride),
        x_(task.x),
        v_(task.v),
        f_{task.f[0], task.f[1], task.f[2], task.f[3]},
        straight_(Spring<L>::of(task.k_s, task.L * directions[0].rest, &L::all)),
        diagonal_(Spring<L>::of(task.k_s, task.L * directions[2].rest, &L::all)),
        bending_(Spring<L>::of(task.k_b, task.L * directions[4].rest, &L::all)),
        k_d_(L::all(task.k_d)),
        weight_(L::all(task.weight)),
        v_to_x_(L::all(task.v_to_x)),
        force_to_x_(L::all(task.force_to_x)),
        force_to_v_(L::all(task.force_to_v)),
        keeps_force_(task.update == Update::force),
        dt_v_(L::all(task.dt_v)),
        third_of_W_(L::all(task.W[0] / 3), L::all(task.W[1] / 3), L::all(task.W[2] / 3)),
        largest_(L::load(task.max_displacement)) {}

  HWY_INLINE void run() {
    int j = 0;
    if (t_.rows_below >= 3) {
      const bool plain = !t_.whole && !t_.fixed[0] && !t_.fixed[1];
      for (; j + lanes + 2 <= t_.columns; j += lanes)
        if (plain || untouched<R, D>(t_, j))
          block<false>(j);
        else
          block<true>(j);
    }
    for (; j < t_.columns; j += lanes) block<true>(j);
    largest_.store(t_.max_displacement);
  }

 private:
  template <bool masked>
  static HWY_INLINE V kept(M mask, V force) {
    if constexpr (masked)
      return where<D>(mask, force);
    else
      return (void)mask, force;
  }

  /// Forces of the four stretch springs on the ends that they are listed with. Written step by step over all four, so
  /// that a processor always has four chains of operations to go on with.
  template <bool masked>
  HWY_INLINE Four<D> stretch(const Four<D>& x_ij, const R* v, const Masks<D>& m) const {
    const L right2 = dot(x_ij.right, x_ij.right), down2 = dot(x_ij.down, x_ij.down),
            diagonal2 = dot(x_ij.diagonal, x_ij.diagonal), crossing2 = dot(x_ij.crossing, x_ij.crossing);
    const L right = stretch_factor(straight_, right2), down = stretch_factor(straight_, down2),
            diagonal = stretch_factor(diagonal_, diagonal2), crossing = stretch_factor(diagonal_, crossing2);
    Four<D> f{right * x_ij.right, down * x_ij.down, diagonal * x_ij.diagonal, crossing * x_ij.crossing};
    if constexpr ((F & damping) != 0) {
      const Four<D> v_ij = differences(v);
      f = {multiply_add(k_d_, v_ij.right, f.right), multiply_add(k_d_, v_ij.down, f.down),
           multiply_add(k_d_, v_ij.diagonal, f.diagonal), multiply_add(k_d_, v_ij.crossing, f.crossing)};
    }
    return {kept<masked>(m.E, f.right), kept<masked>(m.S, f.down), kept<masked>(m.SE, f.diagonal),
            kept<masked>(m.SW, f.crossing)};
  }
  template <bool masked>
  HWY_INLINE V bend(M mask, V p, V q) const {
    const V x_ij = q - p;
    return kept<masked>(mask, bend_factor(bending_, dot(x_ij, x_ij)) * x_ij);
  }

  HWY_INLINE V load(const R* p) const { return V::load(p, stride_); }

  /// Differences of positions or velocities along the four springs of the particles at p….
  HWY_INLINE Four<D> differences(const R* p) const {
    const V a = load(p), b = load(p + 1), c = load(p + pitch_), e = load(p + pitch_ + 1);
    return {b - a, c - a, e - a, c - b};
  }
  static HWY_INLINE V pick(M mask, V yes, V no) {
    return {hn::IfThenElse(mask, yes.x.v, no.x.v), hn::IfThenElse(mask, yes.y.v, no.y.v),
            hn::IfThenElse(mask, yes.z.v, no.z.v)};
  }

  /// Wind on the two triangles of each quad A B C E, as forces on their corners. Even quads are split from A to E, odd
  /// ones from C to B (figure 2.7); the first triangle always has A and C, the second B and E.
  struct OnTriangles {
    V first, second;
  };
  template <bool masked>
  HWY_INLINE OnTriangles blow(M odd, const Four<D>& x_ij, const Masks<D>& m) const {
    const V below = x_ij.diagonal - x_ij.down, beside = x_ij.diagonal - x_ij.right;  // C-E, B-E
    return {kept<masked>(m.triangle[0],
                         wind_on_corner(cross(x_ij.down, pick(odd, x_ij.right, below)), third_of_W_, smallest_)),
            kept<masked>(m.triangle[1],
                         wind_on_corner(cross(beside, pick(odd, below, x_ij.right)), third_of_W_, smallest_))};
  }

  /// What a row takes from the particles below it, as forces to subtract: from C below, its right neighbor E, and G
  /// two rows below.
  struct Reactions {
    V c, e, g;
  };

  /// One row of a block; updates it. `above`: what the upper row takes from the lower.
  template <bool masked, int row>
  HWY_INLINE Reactions sweep(int j, const Reactions& above) {
    R *const x = x_ + row * pitch_ + j, *const v = v_ + row * pitch_ + j;
    const Masks<D> m = masked ? masks_of<R, D>(t_, row, j) : Masks<D>{};
    const Four<D> x_ij = differences(x);
    const Four<D> f = stretch<masked>(x_ij, v, m);
    V on_A = f.right + f.down + f.diagonal, on_B = f.crossing - f.right;
    V c = f.down + f.crossing, e = f.diagonal, g;
    if constexpr (row == 1) on_A = on_A - above.c, on_B = on_B - above.e;
    if constexpr ((F & wind) != 0) {
      const M odd = odd_quads<D>(row, j), even = hn::Not(odd);
      const OnTriangles w = blow<masked>(odd, x_ij, m);
      on_A = add_where<D>(even, on_A + w.first, w.second), on_B = add_where<D>(odd, on_B + w.second, w.first);
      c = c - add_where<D>(odd, w.first, w.second), e = e - add_where<D>(even, w.second, w.first);
    }
    if constexpr ((F & bending) != 0) {
      const V A = load(x);
      const V two_right = bend<masked>(m.EE, A, load(x + 2));
      g = bend<masked>(m.SS, A, load(x + 2 * pitch_));
      on_A = on_A + g + two_right - two_right_[row](two_right);
    }
    update<masked, row>(j, x, v, on_A + right_[row](on_B) - load(f_[row] + j), m.moving);
    return {c, e, g};
  }

  template <bool masked>
  HWY_INLINE void block(int j) {
    const Reactions upper = sweep<masked, 0>(j, {V(), V(), V()});
    const Reactions lower = sweep<masked, 1>(j, upper);
    (upper.g + lower.c + right_[2](lower.e)).store(f_[2] + j, stride_);
    lower.g.store(f_[3] + j, stride_);
  }

  /// What becomes of the force on a row.
  template <bool masked, int row>
  HWY_INLINE void update(int j, R* x_at, R* v_at, V force, M moving) {
    force.y = force.y - weight_;
    if constexpr (!displacements)
      if (keeps_force_) return force.store(f_[row] + j, stride_);
    if constexpr (masked) {
      if (t_.fixed[row]) force.store(f_[row] + j, stride_);  // the hand's force is read there
      force = where<D>(moving, force);
    }
    const V x = load(x_at), v = load(v_at);
    if constexpr (displacements) {
      const V d = multiply_add(force_to_v_, force, v);
      watch(d);
      d.store(v_at, stride_);
      (x + d).store(x_at, stride_);
    } else {
      const V way = multiply_add(force_to_x_, force, v_to_x_ * v);
      const V next = multiply_add(force_to_v_, force, v);
      watch(way);
      watch(dt_v_ * next);
      next.store(v_at, stride_);
      (x + way).store(x_at, stride_);
    }
  }

  /// Keeps the largest |component|. Compared as integers, since then NaN and ∞ are larger than every number.
  HWY_INLINE void watch(V way) {
    constexpr hn::RebindToUnsigned<D> du;
    const auto bits = [&](L c) HWY_ATTR { return hn::BitCast(du, hn::Abs(c.v)); };
    const auto most = hn::Max(bits(way.x), hn::Max(bits(way.y), bits(way.z)));
    largest_ = hn::BitCast(D(), hn::Max(hn::BitCast(du, largest_.v), most));
  }

  const PairTask<R>& t_;
  // Copies, since a compiler must think that stores into the arrays might change the task.
  const std::ptrdiff_t stride_, pitch_;
  R *const x_, *const v_, *const f_[4];
  const Spring<L> straight_, diagonal_, bending_;
  const L k_d_, weight_, v_to_x_, force_to_x_, force_to_v_;
  const bool keeps_force_;
  const L dt_v_;
  const V third_of_W_;
  const L smallest_ = L::all(double(std::numeric_limits<R>::min()));
  L largest_;
  Carry<1, D> right_[3];      ///< forces on the right neighbors, rows i and i+1; reactions, row i+2
  Carry<2, D> two_right_[2];  ///< reactions on those two to the right, rows i and i+1
};

/// The fallbacks of processors from before AVX2 (2013) have all features compiled in; what is off has constants of 0
/// there. Each would take as long to compile as an instruction set that is used.
constexpr bool fallback = HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSE4;

template <class R, unsigned F, bool displacements>
void sweep_pair(const PairTask<R>& task) {
  constexpr unsigned all = feature_sets - 1;
  if constexpr (fallback && F != all) {
    PairTask<R> t = task;
    if ((F & bending) == 0) t.k_b = 0;
    if ((F & damping) == 0) t.k_d = 0;
    if ((F & wind) == 0) t.W[0] = t.W[1] = t.W[2] = 0;
    sweep_pair<R, all, displacements>(t);
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
