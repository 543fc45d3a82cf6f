#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/implicit/multigrid_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/engines/implicit/multigrid_rows.h"
#include "core/engines/implicit/stiffness.h"
#include "core/simd/simd-inl.h"

#ifndef TYGLAB_MULTIGRID_TYPES_
#define TYGLAB_MULTIGRID_TYPES_
namespace tyglab::implicit {
template <class R>
using Given = const R*;
template <class R>
using Filled = R*;
}  // namespace tyglab::implicit
#endif

HWY_BEFORE_NAMESPACE();
namespace tyglab::implicit::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

/// A symmetric 3 x 3 block.
template <class D>
struct Block {
  using V = Vec3<D>;
  using T = hn::TFromD<D>;
  V on, off;  ///< xx, yy, zz and yz, zx, xy
  HWY_INLINE Block() {}
  HWY_INLINE Block(V a, V b) : on(a), off(b) {}
  static HWY_INLINE Block load(const T* p, std::ptrdiff_t stride) {
    return {V::load(p, stride), V::load(p + 3 * stride, stride)};
  }
  HWY_INLINE void store(T* p, std::ptrdiff_t stride) const { on.store(p, stride), off.store(p + 3 * stride, stride); }
  friend HWY_INLINE Block operator+(Block a, Block b) { return {a.on + b.on, a.off + b.off}; }
  friend HWY_INLINE Block operator*(Lanes<D> a, Block b) { return {a * b.on, a * b.off}; }
  friend HWY_INLINE V operator*(Block b, V v) {
    return {multiply_add(b.on.x, v.x, multiply_add(b.off.z, v.y, b.off.y * v.z)),
            multiply_add(b.off.z, v.x, multiply_add(b.on.y, v.y, b.off.x * v.z)),
            multiply_add(b.off.y, v.x, multiply_add(b.off.x, v.y, b.on.z * v.z))};
  }
};

template <class R>
void multiply_blocks(const BlockProduct<R>& t) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  using B = Block<D>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  const std::ptrdiff_t stride = t.stride, pitch = 3 * stride, block = block_parts * stride;
  Carry<1, D> E, SE, SW;
  for (int j = 0; j < t.columns; j += lanes) {
    const R *b = t.blocks + j, *p = t.p + j, *below = p + pitch;
    R* q = t.q + j;
    const V here = V::load(p, stride), right = V::load(p + 1, stride);
    const V under = V::load(below, stride), under_right = V::load(below + 1, stride);
    const B east = B::load(b + block, stride), south = B::load(b + 2 * block, stride);
    const B south_east = B::load(b + 3 * block, stride), south_west = B::load(b + 4 * block, stride);
    V own = B::load(b, stride) * here + (east * right + (south * under + south_east * under_right));
    own = own + (E(east * here) + SW(south_west * under));
    if (!t.first) own = own + V::load(q, stride);
    own.store(q, stride);
    (south * here + (south_west * right + SE(south_east * here))).store(q + pitch, stride);
  }
}

/// r where a particle is not fixed, which is where its inverse block is not 0.
template <class D>
HWY_INLINE Vec3<D> where_free(Vec3<D> diagonal, Vec3<D> v) {
  return where<D>(hn::Gt(diagonal.x.v, hn::Zero(D())), v);
}

template <class R>
void smooth(const SmoothTask<R>& t) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  const std::ptrdiff_t stride = t.stride;
  const Lanes<D> keep = Lanes<D>::all(t.keep), scale = Lanes<D>::all(t.scale);
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    const Block<D> inverse = Block<D>::load(t.inverse + j, stride);
    const V r = where_free(inverse.on, V::load(t.r + j, stride) - V::load(t.q + j, stride));
    r.store(t.r + j, stride);
    const V d = multiply_add(scale, inverse * r, keep * V::load(t.d + j, stride));
    d.store(t.d + j, stride);
    (V::load(t.x + j, stride) + d).store(t.x + j, stride);
  }
}

template <class R>
void start_smoothing(const SmoothTask<R>& t) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  const std::ptrdiff_t stride = t.stride;
  const Lanes<D> scale = Lanes<D>::all(t.scale);
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    const V d = scale * (Block<D>::load(t.inverse + j, stride) * V::load(t.r + j, stride));
    d.store(t.d + j, stride);
    d.store(t.x + j, stride);
  }
}

template <class R>
void subtract(const SmoothTask<R>& t) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  const std::ptrdiff_t stride = t.stride;
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D())))
    where_free(V::load(t.inverse + j, stride), V::load(t.r + j, stride) - V::load(t.q + j, stride))
        .store(t.r + j, stride);
}

template <class R>
double descend(const SmoothTask<R>& t, double part) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  const std::ptrdiff_t stride = t.stride;
  const Lanes<D> forward = Lanes<D>::all(part), back = Lanes<D>::all(-part);
  Lanes<D> squares;
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    multiply_add(forward, V::load(t.d + j, stride), V::load(t.x + j, stride)).store(t.x + j, stride);
    const V r = where_free(V::load(t.inverse + j, stride),
                           multiply_add(back, V::load(t.q + j, stride), V::load(t.r + j, stride)));
    r.store(t.r + j, stride);
    squares = squares + dot(r, r);
  }
  return double(hn::GetLane(hn::SumOfLanes(D(), squares.v)));
}

/// By A = L D Lᵀ: cofactors would lose all digits where a block resists much more in one direction than in another.
template <class R>
void invert_blocks(const R* blocks, R* inverse, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  const L one = L::all(1), none = L::all(0);
  for (int j = 0; j < columns; j += int(hn::MaxLanes(D()))) {
    const Block<D> a = Block<D>::load(blocks + j, stride);
    const auto any = hn::Gt(a.on.x.v, hn::Zero(D()));
    const auto reciprocal = [&](L d) HWY_ATTR {
      return L(hn::IfThenElseZero(any, (one / L(hn::IfThenElse(any, d.v, one.v))).v));
    };
    const L dx = reciprocal(a.on.x), lxy = a.off.z * dx, lxz = a.off.y * dx;
    const L dy = reciprocal(a.on.y - lxy * a.off.z), yz = a.off.x - lxy * a.off.y, lyz = yz * dy;
    const L dz = reciprocal(a.on.z - lxz * a.off.y - lyz * yz);
    // The rows of L⁻¹: (1, 0, 0), (-lxy, 1, 0), (m, -lyz, 1).
    const L m = lxy * lyz - lxz, zy = none - lyz * dz, zx = m * dz, yx = none - lxy * dy;
    const L yy = multiply_add(lyz * lyz, dz, dy), xx = multiply_add(lxy * lxy, dy, multiply_add(m, zx, dx));
    Block<D>({xx, yy, dz}, {zy, zx, multiply_add(m, zy, yx)}).store(inverse + j, stride);
  }
}

/// What lies beyond the last column is 0.
template <class D>
HWY_INLINE Lanes<D> within(int columns, int j, Lanes<D> v) {
  return hn::IfThenElseZero(hn::FirstN(D(), std::size_t(std::max(0, columns - j))), v.v);
}

/// Of p: its elements at 2J - 1, 2J and 2J + 1.
template <class D>
struct Three {
  Lanes<D> before, at, after;
  static HWY_INLINE Three load(const hn::TFromD<D>* p) {
    hn::Vec<D> left, before, at, after;
    hn::LoadInterleaved2(D(), p - 2, left, before);
    hn::LoadInterleaved2(D(), p, at, after);
    return {before, at, after};
  }
};

template <class R>
void restriction(const R* p, std::ptrdiff_t stride, R* t, std::ptrdiff_t coarse_stride, int coarse_columns, int parts) {
  using D = hn::ScalableTag<R>;
  const Lanes<D> half = Lanes<D>::all(0.5);
  for (int part = 0; part < parts; ++part)
    for (int j = 0; j < coarse_columns; j += int(hn::MaxLanes(D()))) {
      const Three<D> at = Three<D>::load(p + part * stride + 2 * j);
      within<D>(coarse_columns, j, multiply_add(half, at.before + at.after, at.at)).store(t + part * coarse_stride + j);
    }
}

template <class R>
void prolongation(const R* t, std::ptrdiff_t coarse_stride, R* p, std::ptrdiff_t stride, int columns, int parts) {
  using D = hn::ScalableTag<R>;
  const Lanes<D> half = Lanes<D>::all(0.5);
  for (int part = 0; part < parts; ++part)
    for (int j = 0; 2 * j < columns; j += int(hn::MaxLanes(D()))) {
      const R* from = t + part * coarse_stride + j;
      const Lanes<D> at = Lanes<D>::load(from), next = Lanes<D>::load(from + 1);
      hn::StoreInterleaved2(at.v, (half * (at + next)).v, D(), p + part * stride + 2 * j);
    }
}

template <class R>
void combination(double a, const R* p, double b, const R* q, R* sum, int count) {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  const L first = L::all(a), second = L::all(b);
  for (int j = 0; j < count; j += int(hn::MaxLanes(D())))
    multiply_add(first, L::load(p + j), second * L::load(q + j)).store(sum + j);
}

template <class R>
void correction(const R* p, const R* inverse, R* d, R* x, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  using V = Vec3<D>;
  for (int j = 0; j < columns; j += int(hn::MaxLanes(D()))) {
    const V moved = where_free(V::load(inverse + j, stride), V::load(p + j, stride));
    moved.store(d + j, stride);
    (V::load(x + j, stride) + moved).store(x + j, stride);
  }
}

/// A spring's block t 1 + a aᵀ from its four parts at one column.
template <class D>
HWY_INLINE Block<D> spring_block(const hn::TFromD<D>* c, std::ptrdiff_t stride) {
  const Vec3<D> a = Vec3<D>::load(c, stride);
  const Lanes<D> t = Lanes<D>::load(c + 3 * stride);
  return {{multiply_add(a.x, a.x, t), multiply_add(a.y, a.y, t), multiply_add(a.z, a.z, t)},
          {a.y * a.z, a.z * a.x, a.x * a.y}};
}

template <class R>
void diagonal(const R* coefficients, R* to, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  using B = Block<D>;
  const std::ptrdiff_t spring = spring_parts * stride, row = block_parts * stride;
  Carry<1, D> E_on, E_off, SE_on, SE_off, SW_on, SW_off;
  Carry<2, D> EE_on, EE_off;
  for (int j = 0; j < columns; j += int(hn::MaxLanes(D()))) {
    const R* c = coefficients + j;
    const B E = spring_block<D>(c, stride), S = spring_block<D>(c + spring, stride);
    const B SE = spring_block<D>(c + 2 * spring, stride), SW = spring_block<D>(c + 3 * spring, stride);
    const B EE = spring_block<D>(c + 4 * spring, stride), SS = spring_block<D>(c + 5 * spring, stride);
    const B from_left(E_on(E.on) + SW_on(SW.on) + EE_on(EE.on), E_off(E.off) + SW_off(SW.off) + EE_off(EE.off));
    (B::load(to + j, stride) + E + S + SE + EE + SS + from_left).store(to + j, stride);
    (B::load(to + row + j, stride) + S + SW + B(SE_on(SE.on), SE_off(SE.off))).store(to + row + j, stride);
    (B::load(to + 2 * row + j, stride) + SS).store(to + 2 * row + j, stride);
  }
}

/// The links of a row, whether or not a particle at their ends is fixed.
template <class R>
void nine_point_links(const NinePointTask<R>& t) {
  using D = hn::ScalableTag<R>;
  using B = Block<D>;
  const std::ptrdiff_t stride = t.stride, spring = spring_parts * stride, block = block_parts * t.row_stride;
  const Lanes<D> twice = Lanes<D>::all(2);
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    const R* c = t.coefficients + j;
    const B along = spring_block<D>(c + 4 * spring, stride) + spring_block<D>(c + 4 * spring - 1, stride);
    (spring_block<D>(c, stride) + twice * along).store(t.row + block + j, t.row_stride);
    B down = spring_block<D>(c + 5 * spring, stride);
    if (t.above) down = down + spring_block<D>(t.above + 5 * spring + j, stride);
    (spring_block<D>(c + spring, stride) + twice * down).store(t.row + 2 * block + j, t.row_stride);
    spring_block<D>(c + 2 * spring, stride).store(t.row + 3 * block + j, t.row_stride);
    spring_block<D>(c + 3 * spring, stride).store(t.row + 4 * block + j, t.row_stride);
  }
}

/// The links' share of the diagonals, and what is left where particles are fixed.
template <class R>
void nine_point(const NinePointTask<R>& t) {
  using D = hn::ScalableTag<R>;
  using B = Block<D>;
  using L = Lanes<D>;
  nine_point_links(t);
  const std::ptrdiff_t stride = t.row_stride, block = block_parts * stride;
  const B mass({L::all(t.m), L::all(t.m), L::all(t.m)}, {});
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    R* b = t.row + j;
    const auto link = [&](int which, int shift) HWY_ATTR { return B::load(b + which * block + shift, stride); };
    const L free = L::load(t.free + j);
    (free * (B::load(b, stride) + (link(1, 0) + link(1, -1)) + (link(2, 0) + link(3, 0) + link(4, -1))))
        .store(b, stride);
    (mass + link(2, 0) + link(3, -1) + link(4, 0)).store(t.below + j, stride);
  }
  for (int j = 0; j < t.columns; j += int(hn::MaxLanes(D()))) {
    R* b = t.row + j;
    const L free = L::load(t.free + j), right = L::load(t.free + j + 1), under = L::load(t.free_below + j);
    const L ends[] = {free * right, free * under, free * L::load(t.free_below + j + 1), right * under};
    for (int which = 1; which < blocks_of_a_particle; ++which)
      (L::all(-1) * ends[which - 1] * B::load(b + which * block, stride)).store(b + which * block, stride);
  }
}

template <class R>
void coarser_columns(const R* row, std::ptrdiff_t stride, R* coarse, std::ptrdiff_t coarse_stride, int coarse_columns) {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  const L half = L::all(0.5), quarter = L::all(0.25);
  for (int part = 0; part < block_parts; ++part)
    for (int j = 0; j < coarse_columns; j += int(hn::MaxLanes(D()))) {
      const auto at = [&](int which)
                          HWY_ATTR { return Three<D>::load(row + (which * block_parts + part) * stride + 2 * j); };
      const Three<D> d = at(0), E = at(1), S = at(2), SE = at(3), SW = at(4);
      const L sums[] = {
          multiply_add(quarter, d.before + d.after, d.at) + (E.before + E.at),
          multiply_add(half, E.at + E.after, quarter * d.after),
          multiply_add(quarter, S.before + S.after, S.at) + half * (SE.before + SE.at + (SW.before + SW.at)),
          multiply_add(half, SE.at + SE.after, quarter * S.after),
          multiply_add(half, SW.at + SW.after, quarter * S.after),
      };
      for (int which = 0; which < blocks_of_a_particle; ++which)
        within<D>(coarse_columns, j, sums[which]).store(coarse + (which * block_parts + part) * coarse_stride + j);
    }
}

template <class R>
void coarser_rows(const R* above, const R* at, const R* below, R* coarse, std::ptrdiff_t stride, int columns) {
  using D = hn::ScalableTag<R>;
  using L = Lanes<D>;
  const L half = L::all(0.5), quarter = L::all(0.25);
  const std::ptrdiff_t block = block_parts * stride;
  for (int part = 0; part < block_parts; ++part)
    for (int j = 0; j < columns; j += int(hn::MaxLanes(D()))) {
      const std::ptrdiff_t n = part * stride + j;
      const auto of = [&](const R* row, int which) HWY_ATTR { return L::load(row + which * block + n); };
      (multiply_add(quarter, of(above, 0) + of(below, 0), of(at, 0)) + (of(above, 2) + of(at, 2))).store(coarse + n);
      (multiply_add(quarter, of(above, 1) + of(below, 1), of(at, 1)) +
       half * (of(at, 3) + of(above, 3) + (of(at, 4) + of(above, 4))))
          .store(coarse + block + n);
      multiply_add(half, of(at, 2) + of(below, 2), quarter * of(below, 0)).store(coarse + 2 * block + n);
      multiply_add(half, of(at, 3) + of(below, 3), quarter * of(below, 1)).store(coarse + 3 * block + n);
      multiply_add(half, of(at, 4) + of(below, 4), quarter * of(below, 1)).store(coarse + 4 * block + n);
    }
}

#define TYGLAB_DEFINE(R, name)                                                                                   \
  void multiply_blocks_##name(const BlockProduct<R>& t) {                                                        \
    multiply_blocks(t);                                                                                          \
  }                                                                                                              \
  void smooth_##name(const SmoothTask<R>& t) {                                                                   \
    smooth(t);                                                                                                   \
  }                                                                                                              \
  void start_##name(const SmoothTask<R>& t) {                                                                    \
    start_smoothing(t);                                                                                          \
  }                                                                                                              \
  void subtract_##name(const SmoothTask<R>& t) {                                                                 \
    subtract(t);                                                                                                 \
  }                                                                                                              \
  double descend_##name(const SmoothTask<R>& t, double part) {                                                   \
    return descend(t, part);                                                                                     \
  }                                                                                                              \
  void invert_##name(Given<R> blocks, Filled<R> inverse, std::ptrdiff_t stride, int columns) {                   \
    invert_blocks(blocks, inverse, stride, columns);                                                             \
  }                                                                                                              \
  void restrict_##name(Given<R> p, std::ptrdiff_t stride, Filled<R> t, std::ptrdiff_t to, int columns, int n) {  \
    restriction(p, stride, t, to, columns, n);                                                                   \
  }                                                                                                              \
  void prolong_##name(Given<R> t, std::ptrdiff_t from, Filled<R> p, std::ptrdiff_t stride, int columns, int n) { \
    prolongation(t, from, p, stride, columns, n);                                                                \
  }                                                                                                              \
  void combine_##name(double a, Given<R> p, double b, Given<R> q, Filled<R> sum, int count) {                    \
    combination(a, p, b, q, sum, count);                                                                         \
  }                                                                                                              \
  void correct_##name(Given<R> p, Given<R> inverse, Filled<R> d, Filled<R> x, std::ptrdiff_t stride, int n) {    \
    correction(p, inverse, d, x, stride, n);                                                                     \
  }                                                                                                              \
  void diagonal_##name(Given<R> coefficients, Filled<R> to, std::ptrdiff_t stride, int columns) {                \
    diagonal(coefficients, to, stride, columns);                                                                 \
  }                                                                                                              \
  void nine_point_##name(const NinePointTask<R>& t) {                                                            \
    nine_point(t);                                                                                               \
  }                                                                                                              \
  void columns_##name(Given<R> row, std::ptrdiff_t stride, Filled<R> coarse, std::ptrdiff_t to, int columns) {   \
    coarser_columns(row, stride, coarse, to, columns);                                                           \
  }                                                                                                              \
  void rows_##name(Given<R> above, Given<R> at, Given<R> below, Filled<R> to, std::ptrdiff_t stride, int n) {    \
    coarser_rows(above, at, below, to, stride, n);                                                               \
  }
// clang-format off
TYGLAB_DEFINE(float, float)
TYGLAB_DEFINE(double, double)
// clang-format on
#undef TYGLAB_DEFINE

}  // namespace tyglab::implicit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::implicit {

#define TYGLAB_EXPORT(R, name)        \
  HWY_EXPORT(multiply_blocks_##name); \
  HWY_EXPORT(smooth_##name);          \
  HWY_EXPORT(start_##name);           \
  HWY_EXPORT(subtract_##name);        \
  HWY_EXPORT(descend_##name);         \
  HWY_EXPORT(invert_##name);          \
  HWY_EXPORT(restrict_##name);        \
  HWY_EXPORT(prolong_##name);         \
  HWY_EXPORT(combine_##name);         \
  HWY_EXPORT(correct_##name);         \
  HWY_EXPORT(diagonal_##name);        \
  HWY_EXPORT(nine_point_##name);      \
  HWY_EXPORT(columns_##name);         \
  HWY_EXPORT(rows_##name);
#define TYGLAB_DISPATCH(R, name)                                                                                  \
  template <>                                                                                                     \
  void multiply_blocks_row(const BlockProduct<R>& t) {                                                            \
    HWY_DYNAMIC_DISPATCH(multiply_blocks_##name)(t);                                                              \
  }                                                                                                               \
  template <>                                                                                                     \
  void smooth_row(const SmoothTask<R>& t) {                                                                       \
    HWY_DYNAMIC_DISPATCH(smooth_##name)(t);                                                                       \
  }                                                                                                               \
  template <>                                                                                                     \
  void start_smoothing_row(const SmoothTask<R>& t) {                                                              \
    HWY_DYNAMIC_DISPATCH(start_##name)(t);                                                                        \
  }                                                                                                               \
  template <>                                                                                                     \
  void subtract_row(const SmoothTask<R>& t) {                                                                     \
    HWY_DYNAMIC_DISPATCH(subtract_##name)(t);                                                                     \
  }                                                                                                               \
  template <>                                                                                                     \
  double descend_row(const SmoothTask<R>& t, double part) {                                                       \
    return HWY_DYNAMIC_DISPATCH(descend_##name)(t, part);                                                         \
  }                                                                                                               \
  template <>                                                                                                     \
  void invert_blocks_row(Given<R> blocks, Filled<R> inverse, std::ptrdiff_t stride, int columns) {                \
    HWY_DYNAMIC_DISPATCH(invert_##name)(blocks, inverse, stride, columns);                                        \
  }                                                                                                               \
  template <>                                                                                                     \
  void restrict_columns(Given<R> p, std::ptrdiff_t stride, Filled<R> t, std::ptrdiff_t to, int columns, int n) {  \
    HWY_DYNAMIC_DISPATCH(restrict_##name)(p, stride, t, to, columns, n);                                          \
  }                                                                                                               \
  template <>                                                                                                     \
  void prolong_columns(Given<R> t, std::ptrdiff_t from, Filled<R> p, std::ptrdiff_t stride, int columns, int n) { \
    HWY_DYNAMIC_DISPATCH(prolong_##name)(t, from, p, stride, columns, n);                                         \
  }                                                                                                               \
  template <>                                                                                                     \
  void combine_rows(double a, Given<R> p, double b, Given<R> q, Filled<R> sum, int count) {                       \
    HWY_DYNAMIC_DISPATCH(combine_##name)(a, p, b, q, sum, count);                                                 \
  }                                                                                                               \
  template <>                                                                                                     \
  void add_correction_row(Given<R> p, Given<R> inverse, Filled<R> d, Filled<R> x, std::ptrdiff_t stride, int n) { \
    HWY_DYNAMIC_DISPATCH(correct_##name)(p, inverse, d, x, stride, n);                                            \
  }                                                                                                               \
  template <>                                                                                                     \
  void diagonal_row(Given<R> coefficients, Filled<R> to, std::ptrdiff_t stride, int columns) {                    \
    HWY_DYNAMIC_DISPATCH(diagonal_##name)(coefficients, to, stride, columns);                                     \
  }                                                                                                               \
  template <>                                                                                                     \
  void nine_point_row(const NinePointTask<R>& t) {                                                                \
    HWY_DYNAMIC_DISPATCH(nine_point_##name)(t);                                                                   \
  }                                                                                                               \
  template <>                                                                                                     \
  void coarsen_columns(Given<R> row, std::ptrdiff_t stride, Filled<R> coarse, std::ptrdiff_t to, int columns) {   \
    HWY_DYNAMIC_DISPATCH(columns_##name)(row, stride, coarse, to, columns);                                       \
  }                                                                                                               \
  template <>                                                                                                     \
  void coarsen_rows(Given<R> above, Given<R> at, Given<R> below, Filled<R> to, std::ptrdiff_t stride, int n) {    \
    HWY_DYNAMIC_DISPATCH(rows_##name)(above, at, below, to, stride, n);                                           \
  }
TYGLAB_EXPORT(float, float)
TYGLAB_EXPORT(double, double)
TYGLAB_DISPATCH(float, float)
TYGLAB_DISPATCH(double, double)
#undef TYGLAB_DISPATCH
#undef TYGLAB_EXPORT

}  // namespace tyglab::implicit
#endif
