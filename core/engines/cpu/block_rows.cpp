#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/block_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>
#include <limits>
#include <numbers>

#include "core/engines/cpu/block_rows.h"
#include "core/forces/spring-inl.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;
using tyglab::HWY_NAMESPACE::shortest;

/// The springs of one kind as lanes.
template <class D>
struct Kind {
  using L = Lanes<D>;
  L k, rest, least;
  bool bends;
  HWY_INLINE Kind(double stiffness, double length, bool pushes)
      : k(L::all(stiffness)), rest(L::all(length)), least(L::all(length * shortest)), bends(pushes) {}
  /// By how much the spring is too long, or for one that pushes too short: 0 where it does not act.
  HWY_INLINE L strain(L length) const {
    if (!bends) return positive(length - rest);
    return if_greater(length, least, positive(rest - length));
  }
};

/// A symmetric matrix and a vector, summed over a particle's springs.
template <class D>
struct System {
  using L = Lanes<D>;
  Vec3<D> force;
  L xx = L::all(1), yy = L::all(1), zz = L::all(1), yz, zx, xy;
  L above = L::all(1);  ///< the stiffness in all directions of a function that is nowhere below the energy
  L energy;             ///< of the springs

  HWY_INLINE explicit System(Vec3<D> inertia) : force(inertia) {}
  /// A spring along d with the force `factor`·d, which resists with `across` in all directions and `along`·d dᵀ more.
  HWY_INLINE void add(Vec3<D> d, L factor, L across, L along) {
    force = multiply_add(factor, d, force);
    const Vec3<D> a = along * d;
    xx = multiply_add(a.x, d.x, xx + across), yy = multiply_add(a.y, d.y, yy + across);
    zz = multiply_add(a.z, d.z, zz + across);
    yz = multiply_add(a.y, d.z, yz), zx = multiply_add(a.z, d.x, zx), xy = multiply_add(a.x, d.y, xy);
  }
  /// The matrix's inverse times the force, by L D Lᵀ. The mass alone makes each pivot 1 or more, whatever rounding
  /// says.
  HWY_INLINE Vec3<D> solve() const {
    const L one = L::all(1), per_x = one / xx, y_x = xy * per_x, z_x = zx * per_x;
    const L per_y = one / at_least(yy - y_x * xy, one), rest = yz - z_x * xy, z_y = rest * per_y;
    const L per_z = one / at_least(zz - z_x * zx - z_y * rest, one);
    const L second = force.y - y_x * force.x, third = force.z - z_x * force.x - z_y * second;
    const L z = third * per_z, y = second * per_y - z_y * z;
    return {force.x * per_x - y_x * y - z_x * z, y, z};
  }
  static HWY_INLINE L at_least(L a, L b) { return hn::Max(a.v, b.v); }
};

template <class D>
HWY_INLINE Lanes<D> one_over_root(Lanes<D> a) {
  return over_root(Lanes<D>::all(0.5), a, Lanes<D>());
}

/// What surrounds the particles at one column of a BlockRow.
template <class D>
class Blocks {
 public:
  using R = hn::TFromD<D>;
  using L = Lanes<D>;
  using V = Vec3<D>;

  HWY_INLINE explicit Blocks(const BlockRow<R>& row)
      : row_(row),
        kinds_{{row.constants.weft, row.constants.L, false},
               {row.constants.warp, row.constants.L, false},
               {row.constants.shear, row.constants.L * std::numbers::sqrt2, false},
               {row.constants.bend, 2 * row.constants.L, true}},
        damping_(L::all(row.constants.damping)),
        linear_(L::all(row.constants.linear)) {}

  HWY_INLINE void descend(int n) const {
    const V c = at(row_.c + n), q = at(row_.q + n), y = at(row_.y + n);
    System<D> system(y - q);
    for (const auto& link : row_.links) add(system, link, n, c, q);
    const V newton = system.solve(), safe = (L::all(1) / system.above) * system.force;
    // By how much Newton's step raises the energy: ½|q + s - y|² - ½|q - y|² of inertia, and what springs add.
    const V middle = multiply_add(L::all(0.5), newton, q - y);
    L rise = dot(newton, middle), inertia = dot(q - y, q - y);
    for (const auto& link : row_.links) rise = rise + change(link, n, c, q, newton);
    const L noise = L::all(16 * std::numeric_limits<R>::epsilon()) * (inertia + system.energy);
    const auto falls = hn::Le(rise.v, noise.v);
    const L free = L::load(row_.free + n);
    const V step = where<D>(hn::Gt(free.v, hn::Zero(D())), choose(falls, newton, safe));
    const V to = q + step;
    R* out = row_.q + n;
    hn::StoreU(to.x.v, D(), out), hn::StoreU(to.y.v, D(), out + row_.stride);
    hn::StoreU(to.z.v, D(), out + 2 * row_.stride);
  }

 private:
  using Link = typename BlockRow<R>::Link;
  HWY_INLINE V at(const R* p) const { return V::load(p, row_.stride); }
  static HWY_INLINE V choose(hn::Mask<D> mask, V a, V b) {
    return {hn::IfThenElse(mask, a.x.v, b.x.v), hn::IfThenElse(mask, a.y.v, b.y.v), hn::IfThenElse(mask, a.z.v, b.z.v)};
  }
  HWY_INLINE void add(System<D>& system, const Link& link, int n, V c, V q) const {
    const Kind<D>& kind = kinds_[link.kind];
    const L whole = L::load(link.whole + n), k = whole * kind.k;
    const V moved = at(row_.q + n + link.to) - q, d = at(row_.c + n + link.to) - c + moved;
    const L square = dot(d, d), per_length = one_over_root(square), length = square * per_length;
    const L strain = kind.strain(length);
    const auto acts = hn::Gt(strain.v, hn::Zero(D()));
    const L pull = hn::IfThenElseZero(acts, (k * strain * per_length).v);
    const L full = hn::IfThenElseZero(acts, k.v), per_square = hn::IfThenElseZero(acts, (per_length * per_length).v);
    system.energy = multiply_add(L::all(0.5) * full, strain * strain, system.energy);
    if (kind.bends) {
      system.add(d, L() - pull, L(), full * per_square);
      system.above = system.above + k;
    } else {
      const L damped = whole * damping_;
      system.add(d, pull, pull + damped, (full - pull) * per_square);
      system.force = multiply_add(damped, moved, system.force);
      system.above = system.above + k + damped;
      system.energy = multiply_add(L::all(0.5) * damped, dot(moved, moved), system.energy);
    }
    if (link.linear != nullptr) {
      const L constant = linear_ * L::load(link.linear + n);
      system.add(d, constant, constant, L());
      system.above = system.above + constant;
      system.energy = multiply_add(L::all(0.5) * L(hn::Abs(constant.v)), square, system.energy);
    }
  }
  /// By how much the particles' steps raise the energy of their springs to one neighbor.
  HWY_INLINE L change(const Link& link, int n, V c, V q, V step) const {
    const Kind<D>& kind = kinds_[link.kind];
    const L whole = L::load(link.whole + n), half = L::all(0.5);
    const V moved = at(row_.q + n + link.to) - q, d = at(row_.c + n + link.to) - c + moved, next = d - step;
    const L before = dot(d, d), after = dot(next, next);
    const L old_strain = kind.strain(before * one_over_root(before));
    const L new_strain = kind.strain(after * one_over_root(after));
    L sum = half * kind.k * (new_strain - old_strain) * (new_strain + old_strain);
    if (!kind.bends) sum = sum - damping_ * dot(step, moved - half * step);
    if (link.linear != nullptr) sum = sum - linear_ * L::load(link.linear + n) * dot(step, d - half * step);
    return hn::IfThenElseZero(hn::Gt(whole.v, hn::Zero(D())), sum.v);
  }

  const BlockRow<R>& row_;
  const Kind<D> kinds_[4];
  const L damping_, linear_;
};

template <class R>
void descend(const BlockRow<R>& row) {
  using D = hn::ScalableTag<R>;
  assert(row.count > 0 && row.stride >= row.count);
  const Blocks<D> blocks(row);
  for (int n = 0; n < row.count; n += int(hn::MaxLanes(D()))) blocks.descend(n);
}

#define TYGLAB_DEFINE(R, name)                  \
  void descend_##name(const BlockRow<R>& row) { \
    descend(row);                               \
  }
TYGLAB_DEFINE(float, float)
TYGLAB_DEFINE(double, double)
#undef TYGLAB_DEFINE

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

#define TYGLAB_DISPATCH(R, name)               \
  HWY_EXPORT(descend_##name);                  \
  template <>                                  \
  void descend_row(const BlockRow<R>& row) {   \
    HWY_DYNAMIC_DISPATCH(descend_##name)(row); \
  }
TYGLAB_DISPATCH(float, float)
TYGLAB_DISPATCH(double, double)
#undef TYGLAB_DISPATCH

}  // namespace tyglab::cpu
#endif
