// Implicit stages (core/engines/newton.h): the linearized force, conjugate gradients, and the sums that Newton's method
// requests. No matrix is stored, only four numbers per spring for its resistance, and the diagonal blocks. A particle
// gathers its part of A p from its twelve springs, both in vectors and in single particles.
//
// Assumptions: as in cloth.cl. Coefficients have the layout of masks, each row as its 24 parts (for each direction a.x,
// a.y, a.z, t) of mask_pitch numbers with 16 zeros on either side; blocks likewise, with 6 parts per row (xx, yy, zz,
// yz, zx, xy of the inverse; 0 for a fixed particle). Vectors are 0 beyond the cloth.

#define SUM BODY_REAL  // sums are made in double where the device has it
typedef JOIN(BODY_REAL, 2) sum2;
enum { spring_parts = 4, particle_parts = 24, block_parts = 6 };

/// As DeviceLinear in device_constants.h.
typedef struct {
  REAL weft, warp, shear, bend, k_d;  // times h²/m, the last h/m
  REAL own;                          // of A's diagonal beside the springs
  REAL straight, diagonal, bending;  // rest lengths
  REAL shortest;                     // the length under which a bending spring has no direction
  REAL linear;                       // h²/m, of the constants of LINEAR
} Linear;

/// As DeviceGradients in device_constants.h: how far conjugate gradients are, a group's part of it.
typedef struct {
  SUM squared, preconditioned;  // Σ r·r and Σ r·z, of the group's particles
  SUM curvature;                // Σ p·q, likewise
  SUM enough, before;           // of all particles: r·r where they end; r·z of the step before
  int count, unused;            // steps made
} Gradients;

/// The system, and what a step of conjugate gradients works on: d is the solution, r what it leaves, z = B r.
typedef struct {
  global const uchar* masks;
  global REAL *coefficients, *blocks, *d, *r, *z, *q;
  int stride, mask_pitch, rows, columns;
  Linear linear;
} System;
#define SYSTEM_ARGUMENTS                                                                                            \
  global const uchar *masks, global REAL *coefficients, global REAL *blocks, global REAL *d, global REAL *r,        \
      global REAL *z, global REAL *q, int stride, int mask_pitch, int rows, int columns, const Linear linear
#define SYSTEM {masks, coefficients, blocks, d, r, z, q, stride, mask_pitch, rows, columns, linear}

/// A work-item's particles: on processors some whole rows, in blocks of WIDTH; on cards every n-th particle.
#define ITEM const int item = (int)get_global_id(0), items = (int)get_global_size(0)
#if WIDTH == 1
#define FOR_ROWS for (int n = item; n < rows * columns; n += items)
#define FOR_BLOCKS for (int row = n / columns, column = n % columns, once = 1; once; once = 0)
#else
#define FOR_ROWS for (int row = rows * item / items; row < rows * (item + 1) / items; ++row)
#define FOR_BLOCKS for (int column = 0; column < columns; column += WIDTH)
#endif

INLINE REAL lane_sum(realv a) {
#if WIDTH == 16
  const JOIN(REAL, 8) b = a.lo + a.hi;
  const JOIN(REAL, 4) c = b.lo + b.hi;
#elif WIDTH == 8
  const JOIN(REAL, 4) c = a.lo + a.hi;
#elif WIDTH == 4
  const realv c = a;
#endif
#if WIDTH == 1
  return a;
#else
  const JOIN(REAL, 2) e = c.lo + c.hi;
  return e.x + e.y;
#endif
}

/// The sum over a group of work-items, for all of them: in a tree, so that it has the same bits in every run. On
/// processors a group is one work-item.
#if WIDTH == 1
#define ROOM local sum2 room[GROUP]
#define GROUP_SUM(mine) group_sum(mine, room)
#define SYNC barrier(CLK_GLOBAL_MEM_FENCE)
INLINE sum2 group_sum(sum2 mine, local sum2* room) {
  const int me = (int)get_local_id(0);
  barrier(CLK_LOCAL_MEM_FENCE);
  room[me] = mine;
  for (int half_of = (int)get_local_size(0) / 2; half_of > 0; half_of /= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (me < half_of) room[me] += room[me + half_of];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  return room[0];
}
#else
#define ROOM
#define GROUP_SUM(mine) (mine)
#define SYNC
#endif

/// What a spring resists with when its ends are moved apart by d: t d + a (a·d).
INLINE vec resistance(global const REAL* c, int pitch, vec d) {
  const vec a = load(c, pitch);
  return plus_times(times(LOAD(c + 3 * pitch), d), dot3(a, d), a);
}

/// What one spring of each particle of the block resists with.
INLINE void linearise_spring(const System* s, global const REAL* x, int to, maskv on, REAL rest, REAL k, int bends,
                             REAL damped, realv linear, global REAL* out) {
  const vec x_ij = minus(load(x + to, s->stride), load(x, s->stride));
  const realv length = sqrt(dot3(x_ij, x_ij));
  // Along the spring k, across it k (1 - rest/length), where that is positive.
  const realv across = bends ? ZERO : (realv)(k) * ((realv)(1) - (realv)(rest) / length);
  const maskv acts =
      on & (bends ? (length < (realv)(rest)) & (length > (realv)(s->linear.shortest)) : length > (realv)(rest));
  const realv along = acts ? sqrt((realv)(k) - across) / length : ZERO;
  store(times(along, x_ij), out, s->mask_pitch);
  STORE((on ? (realv)(damped) : ZERO) + (acts ? across : ZERO) + linear, out + 3 * s->mask_pitch);
}

#ifdef LINEAR
#define LINEAR_PART(number) ((realv)(l->linear) * LOAD(own + (number) * s->mask_pitch))
#else
#define LINEAR_PART(number) ZERO
#endif

INLINE void linearise_share(const System* s, global const REAL* x_field, global const REAL* linear, int item,
                            int items) {
  const int rows = s->rows, columns = s->columns, below = 3 * s->stride;
  const Linear* l = &s->linear;
  FOR_ROWS FOR_BLOCKS {
    global const REAL* x = x_field + place(row, column, 3 * s->stride);
    global REAL* out = s->coefficients + place(row, column, particle_parts * s->mask_pitch);
    global const uchar* m = s->masks + place(row, column, s->mask_pitch);
#ifdef LINEAR
    global const REAL* own = linear + place(row, column, linear_parts * s->mask_pitch);
#endif
#define LINEARISE(number, to, bit, rest, k, bends, damped)                                       \
  linearise_spring(s, x, to, has(1, m, bit), rest, k, bends, damped, LINEAR_PART(number), \
                   out + (number) * spring_parts * s->mask_pitch)
    LINEARISE(0, 1, bit_E, l->straight, l->weft, 0, l->k_d);
    LINEARISE(1, below, bit_S, l->straight, l->warp, 0, l->k_d);
    LINEARISE(2, below + 1, bit_SE, l->diagonal, l->shear, 0, l->k_d);
    LINEARISE(3, below - 1, bit_SW, l->diagonal, l->shear, 0, l->k_d);
#ifdef BENDING
    LINEARISE(4, 2, bit_EE, l->bending, l->bend, 1, 0);
    LINEARISE(5, 2 * below, bit_SS, l->bending, l->bend, 1, 0);
#endif
  }
}

/// The block of A's diagonal: sums over the springs of t 1 + a aᵀ.
typedef struct {
  vec diagonal, mixed;  // xx, yy, zz; yz, zx, xy
} Block3;

INLINE void add_spring(Block3* b, global const REAL* c, int pitch) {
  const vec a = load(c, pitch);
  const realv t = LOAD(c + 3 * pitch);
  const vec squares = {t + a.x * a.x, t + a.y * a.y, t + a.z * a.z}, products = {a.y * a.z, a.z * a.x, a.x * a.y};
  b->diagonal = plus(b->diagonal, squares), b->mixed = plus(b->mixed, products);
}

/// The inverse of the block of a block of particles, 0 where they are fixed.
INLINE Block3 inverse_block(const System* s, int row, int column) {
  const int pitch = s->mask_pitch, up = particle_parts * pitch, spring = spring_parts * pitch;
  global const REAL* c = s->coefficients + place(row, column, up);
  const realv own = (realv)(s->linear.own);
  Block3 b = {{own, own, own}, {ZERO, ZERO, ZERO}};
  add_spring(&b, c, pitch), add_spring(&b, c - 1, pitch);
  add_spring(&b, c + spring, pitch), add_spring(&b, c + spring - up, pitch);
  add_spring(&b, c + 2 * spring, pitch), add_spring(&b, c + 2 * spring - up - 1, pitch);
  add_spring(&b, c + 3 * spring, pitch), add_spring(&b, c + 3 * spring - up + 1, pitch);
#ifdef BENDING
  add_spring(&b, c + 4 * spring, pitch), add_spring(&b, c + 4 * spring - 2, pitch);
  add_spring(&b, c + 5 * spring, pitch), add_spring(&b, c + 5 * spring - 2 * up, pitch);
#endif
  const realv xx = b.diagonal.x, yy = b.diagonal.y, zz = b.diagonal.z, yz = b.mixed.x, zx = b.mixed.y, xy = b.mixed.z;
  const realv cx = yy * zz - yz * yz, cy = zx * yz - xy * zz, cz = xy * yz - yy * zx;
  const maskv is_free = has(1, s->masks + place(row, column, pitch), bit_free);
  const realv per = is_free ? (realv)(1) / (xx * cx + xy * cy + zx * cz) : ZERO;
  const Block3 inverse = {{cx * per, (xx * zz - zx * zx) * per, (xx * yy - xy * xy) * per},
                          {(xy * zx - xx * yz) * per, cz * per, cy * per}};
  return inverse;
}

/// z = B r; returns Σ r·r and Σ r·z lane by lane in the two sums.
INLINE void precondition(const System* s, int at, Block3 b, vec r, realv* squared, realv* preconditioned) {
  const vec d = b.diagonal, m = b.mixed;
  const vec z = {d.x * r.x + (m.z * r.y + m.y * r.z), m.z * r.x + (d.y * r.y + m.x * r.z),
                 m.y * r.x + (m.x * r.y + d.z * r.z)};
  store(r, s->r + at, s->stride);
  store(z, s->z + at, s->stride);
  *squared += dot3(r, r), *preconditioned += dot3(r, z);
}

/// Inverts the blocks and begins at d = 0: r is the residual, without what pulls at fixed particles.
INLINE sum2 begin_share(const System* s, global const REAL* residual, global REAL* p, int item, int items) {
  const int rows = s->rows, columns = s->columns;
  const vec zero = {ZERO, ZERO, ZERO};
  sum2 sum = (sum2)(0);
  FOR_ROWS {
    realv squared = ZERO, preconditioned = ZERO;
    FOR_BLOCKS {
      const int at = place(row, column, 3 * s->stride);
      const Block3 b = inverse_block(s, row, column);
      global REAL* block = s->blocks + place(row, column, block_parts * s->mask_pitch);
      store(b.diagonal, block, s->mask_pitch), store(b.mixed, block + 3 * s->mask_pitch, s->mask_pitch);
      store(zero, s->d + at, s->stride), store(zero, p + at, s->stride);
      precondition(s, at, b, where(b.diagonal.x > ZERO, load(residual + at, s->stride)), &squared, &preconditioned);
    }
    sum += (sum2)(lane_sum(squared), lane_sum(preconditioned));
  }
  return sum;
}

/// The new direction z + keep p of a block.
INLINE vec direction(const System* s, global const REAL* p, REAL keep, int at) {
  return plus_scaled(load(s->z + at, s->stride), keep, load(p + at, s->stride));
}

/// p = z + keep p, and q = A p; returns Σ p·q. The directions of neighbors are worked out again, so that nobody waits
/// for them.
INLINE SUM multiply_share(const System* s, global const REAL* from, global REAL* to, REAL keep, int item, int items) {
  const int rows = s->rows, columns = s->columns, pitch = s->mask_pitch, below = 3 * s->stride;
  const int up = particle_parts * pitch, spring = spring_parts * pitch;
  SUM sum = 0;
  FOR_ROWS {
    realv curvature = ZERO;
    FOR_BLOCKS {
      const int at = place(row, column, 3 * s->stride);
      global const REAL* c = s->coefficients + place(row, column, up);
      const vec own = direction(s, from, keep, at);
      vec f = scaled(s->linear.own, own);
#define RESIST(coefficient, neighbor) \
  f = minus(f, resistance(coefficient, pitch, minus(direction(s, from, keep, at + (neighbor)), own)))
      RESIST(c, 1), RESIST(c - 1, -1);
      RESIST(c + spring, below), RESIST(c + spring - up, -below);
      RESIST(c + 2 * spring, below + 1), RESIST(c + 2 * spring - up - 1, -below - 1);
      RESIST(c + 3 * spring, below - 1), RESIST(c + 3 * spring - up + 1, -below + 1);
#ifdef BENDING
      RESIST(c + 4 * spring, 2), RESIST(c + 4 * spring - 2, -2);
      RESIST(c + 5 * spring, 2 * below), RESIST(c + 5 * spring - 2 * up, -2 * below);
#endif
      store(own, to + at, s->stride), store(f, s->q + at, s->stride);
      curvature += dot3(own, f);
    }
    sum += lane_sum(curvature);
  }
  return sum;
}

/// d += α p, r -= α q, z = B r.
INLINE sum2 update_share(const System* s, global const REAL* p, REAL alpha, int item, int items) {
  const int rows = s->rows, columns = s->columns;
  sum2 sum = (sum2)(0);
  FOR_ROWS {
    realv squared = ZERO, preconditioned = ZERO;
    FOR_BLOCKS {
      const int at = place(row, column, 3 * s->stride);
      global const REAL* block = s->blocks + place(row, column, block_parts * s->mask_pitch);
      const Block3 b = {load(block, s->mask_pitch), load(block + 3 * s->mask_pitch, s->mask_pitch)};
      store(plus_scaled(load(s->d + at, s->stride), alpha, load(p + at, s->stride)), s->d + at, s->stride);
      const vec left = plus_scaled(load(s->r + at, s->stride), -alpha, load(s->q + at, s->stride));
      precondition(s, at, b, where(b.diagonal.x > ZERO, left), &squared, &preconditioned);
    }
    sum += (sum2)(lane_sum(squared), lane_sum(preconditioned));
  }
  return sum;
}

/// Whether another step of conjugate gradients is due.
INLINE int goes_on(SUM squared, SUM enough, int count, int most) {
  return count < most && isfinite(squared) && squared > enough;
}
INLINE REAL kept_direction(sum2 now, SUM before) { return before > 0 ? (REAL)(now.y / before) : (REAL)(0); }

kernel void linearise(SYSTEM_ARGUMENTS, global const REAL* x, global const REAL* constants) {
  const System s = SYSTEM;
  ITEM;
  linearise_share(&s, x, constants, item, items);
}

/// Conjugate gradients from beginning to end, by one group: for small cloths, whose launches would take longer than
/// their work.
kernel void gradients(SYSTEM_ARGUMENTS, global const REAL* residual, global REAL* p, global REAL* other_p, int most,
                      SUM tolerance2, global Gradients* out) {
  const System s = SYSTEM;
  ITEM;
  ROOM;
  sum2 now = GROUP_SUM(begin_share(&s, residual, p, item, items));
  const SUM enough = tolerance2 * now.x;
  SUM before = 0;
  int count = 0;
  global REAL *from = p, *to = other_p;
  for (; goes_on(now.x, enough, count, most); ++count) {
    SYNC;
    const sum2 curvature = (sum2)(multiply_share(&s, from, to, kept_direction(now, before), item, items), 0);
    before = now.y;
    const SUM of_all = GROUP_SUM(curvature).x;
    SYNC;
    now = GROUP_SUM(update_share(&s, to, (REAL)(before / of_all), item, items));
    global REAL* const swapped = from;
    from = to, to = swapped;
  }
  if (item == 0) out->squared = now.x, out->enough = enough, out->count = count;
}

/// What all groups have found, for every work-item.
#if WIDTH == 1
#define TOTAL(groups_of, what)                                                                  \
  sum2 mine = (sum2)(0);                                                                        \
  for (int g = (int)get_local_id(0); g < (int)get_num_groups(0); g += (int)get_local_size(0)) { \
    global const Gradients* part = (groups_of) + g;                                             \
    mine += what;                                                                               \
  }                                                                                             \
  mine = group_sum(mine, room)
#else
#define TOTAL(groups_of, what)                           \
  sum2 mine = (sum2)(0);                                 \
  for (int g = 0; g < (int)get_num_groups(0); ++g) {     \
    global const Gradients* part = (groups_of) + g;      \
    mine += what;                                        \
  }
#endif

/// The same in launches, by as many groups as there is work for: begin_gradients, then multiply and update in turn.
/// Launches that come after the last step hand on what it has left.
kernel void begin_gradients(SYSTEM_ARGUMENTS, global const REAL* residual, global REAL* p, global Gradients* out) {
  const System s = SYSTEM;
  ITEM;
  ROOM;
  const sum2 sum = GROUP_SUM(begin_share(&s, residual, p, item, items));
  const Gradients begun = {sum.x, sum.y, 0, -1, 0, 0, 0};
  if (get_local_id(0) == 0) out[get_group_id(0)] = begun;
}

/// `now`: of the step before. Where that was none, its `enough` is still to be worked out.
kernel void multiply(SYSTEM_ARGUMENTS, global const REAL* from, global REAL* to, int most, SUM tolerance2,
                     global Gradients* now) {
  const System s = SYSTEM;
  ITEM;
  ROOM;
  TOTAL(now, ((sum2)(part->squared, part->preconditioned)));
  const SUM enough = now->count == 0 ? tolerance2 * mine.x : now->enough;
  if (!goes_on(mine.x, enough, now->count, most)) return;
  const SUM product = multiply_share(&s, from, to, kept_direction(mine, now->before), item, items);
  const SUM curvature = GROUP_SUM(((sum2)(product, 0))).x;
  if (get_local_id(0) == 0) now[get_group_id(0)].curvature = curvature;
}

kernel void update(SYSTEM_ARGUMENTS, global const REAL* p, int most, SUM tolerance2, global const Gradients* now,
                   global Gradients* next) {
  const System s = SYSTEM;
  ITEM;
  ROOM;
  TOTAL(now, ((sum2)(part->squared, part->preconditioned)));
  const sum2 before = mine;
  const SUM enough = now->count == 0 ? tolerance2 * before.x : now->enough;
  Gradients left = now[get_group_id(0)];
  if (goes_on(before.x, enough, now->count, most)) {
    SUM curvature = 0;
    {
      TOTAL(now, ((sum2)(part->curvature, 0)));
      curvature = mine.x;
    }
    const sum2 sum = GROUP_SUM(update_share(&s, p, (REAL)(before.y / curvature), item, items));
    left.squared = sum.x, left.preconditioned = sum.y;
    left.enough = enough, left.before = before.y, left.count = now->count + 1;
  }
  if (get_local_id(0) == 0) next[get_group_id(0)] = left;
}

/// v = v_from + part · step, x = c_x + h v. `part` 0: where there is no step yet.
kernel void go(global const REAL* v_from, global const REAL* step, global const REAL* c_x, global REAL* v,
               global REAL* x, REAL part, REAL h, int stride, int rows, int columns) {
  ITEM;
  FOR_ROWS FOR_BLOCKS {
    const int at = place(row, column, 3 * stride);
    vec there = load(v_from + at, stride);
    if (part != 0) there = plus_scaled(there, part, load(step + at, stride));
    store(there, v + at, stride);
    store(plus_scaled(load(c_x + at, stride), h, there), x + at, stride);
  }
}

/// Each group's part of a·a, a·b and b·b.
kernel void inner_products(global const REAL* a_field, global const REAL* b_field, int stride, int rows, int columns,
                           global SUM* out) {
  ITEM;
  ROOM;
  sum2 firsts = (sum2)(0), seconds = (sum2)(0);
  FOR_ROWS {
    realv aa = ZERO, ab = ZERO, bb = ZERO;
    FOR_BLOCKS {
      const int at = place(row, column, 3 * stride);
      const vec a = load(a_field + at, stride), b = load(b_field + at, stride);
      aa += dot3(a, a), ab += dot3(a, b), bb += dot3(b, b);
    }
    firsts += (sum2)(lane_sum(aa), lane_sum(ab)), seconds.x += lane_sum(bb);
  }
  firsts = GROUP_SUM(firsts), seconds = GROUP_SUM(seconds);
  if (get_local_id(0) != 0) return;
  global SUM* to = out + 3 * get_group_id(0);
  to[0] = firsts.x, to[1] = firsts.y, to[2] = seconds.x;
}
