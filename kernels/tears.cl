// Examines every spring, at the particle that owns it (lattice.h): which are overloaded and tear, and whether one is so
// long that the motion has diverged.

#ifdef BODY_REAL_IS_DOUBLE
#define EXACT double
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#else
#define EXACT float
#endif

/// Whether the spring from one particle to another is overloaded; its tension as stretch_tension() has it.
INLINE int overloaded(global const REAL* a, global const REAL* b, int stride, EXACT k, EXACT rest, EXACT F_max,
                      EXACT* r2) {
  EXACT sum = 0;
  for (int c = 0; c < 3; ++c) {
    const EXACT d = (EXACT)b[c * stride] - (EXACT)a[c * stride];
    sum += d * d;
  }
  *r2 = sum;
  return k * (sqrt(sum) - rest) > F_max;
}

/// Breaks the overloaded springs in one direction of a block's particles, unless one of their ends is guarded; returns
/// the square of the longest of those left that could break.
INLINE REAL tear_direction(global const REAL* x, int stride, int mask_pitch, global uchar* springs,
                           global const uchar* guards, global uint* report, int di, int dj, int bit, EXACT k,
                           EXACT rest, EXACT F_max, REAL certain2) {
  const int to = di * 3 * stride + dj, mask_to = di * mask_pitch + dj;
  const vec x_ij = minus(load(x + to, stride), load(x, stride));
  const realv r2 = (LOAD_MASK(springs) & bit) != 0 ? dot3(x_ij, x_ij) : ZERO;
  const REAL longest = JOIN(as_, REAL)(largest_lane(AS_BITS(r2)));
  if (longest <= certain2) return longest;
  REAL left = 0;
  for (int lane = 0; lane < WIDTH; ++lane) {
    if ((springs[lane] & bit) == 0 || guards[lane] || guards[mask_to + lane]) continue;
    EXACT length2;
    if (overloaded(x + lane, x + to + lane, stride, k, rest, F_max, &length2)) {
      springs[lane] &= (uchar)~bit;
      atomic_or(report + report_torn, 1);
    } else {
      left = fmax(left, (REAL)length2);
    }
  }
  return left;
}

#define TEAR(di, dj, bit, k, rest, certain2) \
  tear_direction(at, stride, mask_pitch, own, guard, report, di, dj, bit, k, rest, F_max, certain2)

/// Breaks what is overloaded, and reports how long the springs are that are left. A row of work-items a row of
/// particles; as few as keep the device busy, since they all report to the same words. certain_…2: squares of lengths
/// up to which rounding cannot matter.
kernel void tear(global const REAL* x, global uchar* springs, global const uchar* guards, global uint* report, int slot,
                 int stride, int mask_pitch, int rows, int columns, EXACT weft, EXACT warp, EXACT shear, EXACT straight,
                 EXACT diagonal, EXACT F_max, REAL certain_weft2, REAL certain_warp2, REAL certain_shear2) {
  const int row = (int)get_global_id(1);
  if (row >= rows) return;
  report += slot * report_words;
  REAL weft2 = 0, warp2 = 0, shear2 = 0;
  for (int column = (int)get_global_id(0) * WIDTH; column < columns; column += (int)get_global_size(0) * WIDTH) {
    global const REAL* at = x + place(row, column, 3 * stride);
    global uchar* own = springs + place(row, column, mask_pitch);
    global const uchar* guard = guards + place(row, column, mask_pitch);
    weft2 = fmax(weft2, TEAR(0, 1, bit_E, weft, straight, certain_weft2));
    warp2 = fmax(warp2, TEAR(1, 0, bit_S, warp, straight, certain_warp2));
    const REAL SE = TEAR(1, 1, bit_SE, shear, diagonal, certain_shear2);
    const REAL SW = TEAR(1, -1, bit_SW, shear, diagonal, certain_shear2);
    shear2 = fmax(shear2, fmax(SE, SW));
  }
  atomic_max(report + report_straight, float_bits(weft2));
  atomic_max(report + report_bending, float_bits(warp2));
  atomic_max(report + report_diagonal, float_bits(shear2));
}

/// Makes the masks that sweeps read from those of the stretch springs and of what is free: says which bending springs
/// live, and which particles have everything. A work-item a particle. `report`: of the look before; if that has torn
/// nothing, nothing is done.
kernel void derive_masks(global const uchar* springs, global uchar* masks, global const uint* report, int slot,
                         int mask_pitch, int rows, int columns) {
  const int j = (int)get_global_id(0), i = (int)get_global_id(1);
  if (i >= rows || j >= columns || (report != 0 && report[slot * report_words + report_torn] == 0)) return;
  const int at = place(i, j, mask_pitch);
  global const uchar* own = springs + at;
  const int stretch = bit_E | bit_S | bit_SE | bit_SW;
  int mask = own[0];
  if ((own[0] & own[1] & bit_E) != 0) mask |= bit_EE;
  if ((own[0] & own[mask_pitch] & bit_S) != 0) mask |= bit_SS;
#if WIDTH == 1
  // Everything round it, whatever it reads of it.
  int around = own[0];
  for (int di = -2; di <= 1; ++di)
    for (int dj = -2; dj <= 1; ++dj) around &= own[di * mask_pitch + dj] | ~stretch;
  const int plain = (around & (stretch | bit_free)) == (stretch | bit_free);
#else
  // The springs and triangles that it looks at in its row (band.cl).
  const int looked_at = bit_E | bit_S | bit_SE | bit_free;
  const int plain = (own[0] & looked_at) == looked_at && (own[1] & (bit_S | bit_SW)) == (bit_S | bit_SW) &&
                    (own[mask_pitch] & bit_E) != 0 && (mask & (bit_EE | bit_SS)) == (bit_EE | bit_SS);
#endif
  if (plain) mask |= bit_plain;
  masks[at] = (uchar)mask;
}

#ifdef LINEAR
enum { most_stencil_springs = 6 };

/// What a stencil of a force that is linear in positions adds to one of its springs, as DeviceShare in
/// device_constants.h.
typedef struct {
  REAL adds;                                        // N/m
  int direction, di, dj;                            // of the spring; its owner, as the stencil's sees it
  int last_row, first_column, last_column, springs;  // how far its points reach; how many springs must be whole
  int bit[most_stencil_springs], spring_di[most_stencil_springs], spring_dj[most_stencil_springs];
} Share;

/// The constants of forces that are linear in positions, as LinearSprings::compute makes them. A work-item a particle.
/// `report`: as in derive_masks.
kernel void derive_linear(global const uchar* springs, global REAL* linear, global const uint* report, int slot,
                          int mask_pitch, int rows, int columns, global const Share* shares, int count) {
  const int j = (int)get_global_id(0), i = (int)get_global_id(1);
  if (i >= rows || j >= columns || (report != 0 && report[slot * report_words + report_torn] == 0)) return;
  REAL sums[linear_parts] = {0, 0, 0, 0, 0, 0};
  for (int n = 0; n < count; ++n) {
    global const Share* share = shares + n;
    const int row = i - share->di, column = j - share->dj;  // of the stencil's owner
    int acts = row >= 0 && row + share->last_row < rows && column + share->first_column >= 0 &&
               column + share->last_column < columns;
    for (int s = 0; acts && s < share->springs; ++s)
      acts = (springs[place(row + share->spring_di[s], column + share->spring_dj[s], mask_pitch)] & share->bit[s]) != 0;
    if (acts) sums[share->direction] += share->adds;
  }
  for (int d = 0; d < linear_parts; ++d) linear[place(i, j, linear_parts * mask_pitch) + d * mask_pitch] = sums[d];
}
#endif

/// The square of a whole spring's length; 0 for one that is torn or leaves the cloth.
INLINE REAL whole_squared(global const REAL* x, int stride, int mask, int bit, int di, int dj) {
  REAL sum = 0;
  if ((mask & bit) != 0)
    for (int c = 0; c < 3; ++c) {
      const REAL d = x[(di * 3 + c) * stride + dj] - x[c * stride];
      sum += d * d;
    }
  return sum;
}

/// Reports the squares of the longest whole springs, and whether a number of x or v is not finite. Work-items as those
/// of `tear`. NaN counts as longer than every number.
kernel void look(global const REAL* x, global const REAL* v, global const uchar* masks, global uint* report, int slot,
                 int stride, int mask_pitch, int rows, int columns) {
  const int row = (int)get_global_id(1);
  if (row >= rows) return;
  report += slot * report_words;
  uint straight2 = 0, diagonal2 = 0, bending2 = 0, bad = 0;
  for (int column = (int)get_global_id(0); column < columns; column += (int)get_global_size(0)) {
    const int at = place(row, column, 3 * stride), mask = masks[place(row, column, mask_pitch)];
#define SQUARED(bit, di, dj) float_bits(whole_squared(x + at, stride, mask, bit, di, dj))
    straight2 = max(straight2, max(SQUARED(bit_E, 0, 1), SQUARED(bit_S, 1, 0)));
    diagonal2 = max(diagonal2, max(SQUARED(bit_SE, 1, 1), SQUARED(bit_SW, 1, -1)));
    bending2 = max(bending2, max(SQUARED(bit_EE, 0, 2), SQUARED(bit_SS, 2, 0)));
    for (int c = 0; c < 3; ++c) bad |= !isfinite(x[at + c * stride]) || !isfinite(v[at + c * stride]);
  }
  atomic_max(report + report_straight, straight2);
  atomic_max(report + report_diagonal, diagonal2);
  atomic_max(report + report_bending, bending2);
  atomic_max(report + report_bad, bad);
}
