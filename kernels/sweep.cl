// The common part of all sweeps, besides the forces and the sums that program_text.cpp writes for each method: the
// position of a work-item's particles, the force on the hand, bodies, the check of the largest displacement.

/// The bits of a number that is not negative, as a float not smaller than it; NaN and ∞ are larger than every number.
INLINE uint float_bits(REAL a) {
#ifdef REAL_IS_DOUBLE
  const uint bits = as_uint((float)a);
  return bits < 0x7f800000u ? bits + 1 : bits;
#else
  return as_uint(a);
#endif
}

INLINE bitsv size_bits(vec a) {
  return max(AS_BITS(fabs(a.x)), max(AS_BITS(fabs(a.y)), AS_BITS(fabs(a.z))));
}

/// The largest lane.
INLINE BITS largest_lane(bitsv a) {
#if WIDTH == 16
  const JOIN(BITS, 8) b = max(a.lo, a.hi);
  const JOIN(BITS, 4) c = max(b.lo, b.hi);
#elif WIDTH == 8
  const JOIN(BITS, 4) c = max(a.lo, a.hi);
#elif WIDTH == 4
  const bitsv c = a;
#endif
#if WIDTH == 1
  return a;
#else
  const JOIN(BITS, 2) d = max(c.lo, c.hi);
  return max(d.x, d.y);
#endif
}

/// The largest component of a way in this step so far, of all work-items. On devices with small work-items a group of
/// them agrees first; all of its work-items must come here.
#if WIDTH == 1
#define LOCAL_WATCH local uint of_group
#define WATCH(bits)                                                                                             \
  if (get_local_id(0) == 0 && get_local_id(1) == 0) of_group = 0;                                               \
  barrier(CLK_LOCAL_MEM_FENCE);                                                                                 \
  atomic_max(&of_group, bits);                                                                                  \
  barrier(CLK_LOCAL_MEM_FENCE);                                                                                 \
  if (get_local_id(0) == 0 && get_local_id(1) == 0) atomic_max(report + report_way, of_group)
#endif

/// The largest component of a particle's way, lane by lane, and of all lanes as a word of the report.
INLINE bitsv ways(vec old, vec x, vec v, REAL to_way) {
  return max(size_bits(minus(x, old)), size_bits(scaled(to_way, v)));
}
INLINE uint way_word(bitsv ways) {
#ifdef REAL_IS_DOUBLE
  return float_bits(as_double(largest_lane(ways)));
#else
  return largest_lane(ways);
#endif
}

/// The lanes that are pinned, held or beyond the row's end; their force is measured for the hand, then 0. `held` is -1
/// in rows that belong to another band: there the force is not complete.
INLINE maskv fix(global const uchar* mask, int row, int column, int columns, vec* f, int held, global REAL* hand) {
  const maskv fixed = (LOAD_MASK(mask) & bit_free) == 0;
  const int lane = held - (row * columns + column);
  if (held >= 0 && lane >= 0 && lane < WIDTH && column + lane < columns) {
    REAL x[WIDTH], y[WIDTH], z[WIDTH];
    STORE(f->x, x), STORE(f->y, y), STORE(f->z, z);
    hand[0] = x[lane], hand[1] = y[lane], hand[2] = z[lane];
  }
  f->x = fixed ? ZERO : f->x;
  f->y = fixed ? ZERO : f->y;
  f->z = fixed ? ZERO : f->z;
  return fixed;
}

/// What every sweep takes beside its vectors. `scratch`, bands, levels and band_numbers are of band.cl.
#define ARGUMENTS                                                                                                   \
  global REAL *scratch, int bands, int levels, int band_numbers, global const uchar *masks, int stride,             \
      int mask_pitch, int rows, int columns, const Constants constants, global uint *reports, global REAL *hands,   \
      int slot, int held, global const void *body_list, int body_count, int bodies_move,            \
      global void *contact_list,                                                                                    \
      global const REAL *linear

#ifdef BODIES
/// `own`: the particles are this work-item's alone, so what happens to them is counted.
#define MEET_BODIES(old, old_v, x, v, seen, sees_itself)                                                            \
  if (touches(((global const BodyList*)body_list)->bodies + FIRST_BODY, body_count, old, x))                        \
  collide_block((global const BodyList*)body_list, FIRST_BODY, body_count, k, columns - column,                     \
                row * columns + column, own, fixed, old, old_v, &x, &v, &seen, sees_itself, report,                 \
                (global Contact*)contact_list)
#if WIDTH == 1
#define FIRST_BODY (bodies_move * slot * body_count)
#else
#define FIRST_BODY (bodies_move * (slot + level) * body_count)
#endif
#else
#define MEET_BODIES(old, old_v, x, v, seen, sees_itself)
#endif

/// Of a block on which no force is computed.
#define FIND_FIXED(mask) const maskv fixed = (LOAD_MASK(mask) & bit_free) == 0

#if WIDTH == 1
/// Where a work-item's particle lies, and the force on it; x and v are the vectors that forces are computed from.
#define FIND_PARTICLE(x_field, v_field)                                                                             \
  const Constants* k = &constants;                                                                                  \
  global uint* report = reports + slot * report_words;                                                              \
  const int column = (int)get_global_id(0), row = (int)get_global_id(1), own = 1;                                   \
  const int at = place(row, column, 3 * stride);                                                                    \
  const Block block = {x_field + at, v_field + at, linear + place(row, column, linear_parts * mask_pitch),          \
                       masks + place(row, column, mask_pitch), stride, mask_pitch, row, column};                                                                                     \
  const int inside = row < rows && column < columns
#define FIND_FORCE                                                                                                  \
  const vec own_x = load(block.x, stride), own_v = load(block.v, stride);                                           \
  vec F;                                                                                                            \
  int fixed = 0;                                                                                                    \
  if (plain(block.mask)) {                                                                                          \
    F = force_on(k, &block, own_x, own_v, 0);                                                                       \
  } else {                                                                                                          \
    F = force_on(k, &block, own_x, own_v, 1);                                                                       \
    fixed = fix(block.mask, row, column, columns, &F, held, hands + 4 * slot);                                      \
  }
#else
/// What a work-item does: its band, and level after level, each three rows behind the one before, its rows. Of the
/// work-items that belong to a band the last does it all. The others are there since drivers deal groups out in runs,
/// as pocl does, whose first thread takes one more than its share: of as many groups as threads it would take two.
#define FOR_EACH_ROW                                                                                                \
  const Constants* k = &constants;                                                                                  \
  const int items = (int)get_global_size(0) / bands, pitch = 3 * stride, band = (int)get_global_id(0) / items;      \
  if (((int)get_global_id(0) + 1) % items != 0) return;                                                             \
  const int begin = (int)((long)rows * band / bands), end = (int)((long)rows * (band + 1) / bands);                 \
  scratch += (size_t)band * band_numbers;                                                                           \
  for (int time = level_begin(begin, levels); time < end + 3 * (levels - 1); ++time)                                \
    for (int level = 0; level < levels; ++level)
/// Which row that is; `updates`: it is not only looked at for what it does to the rows below.
#define FIND_ROW(vectors)                                                                                           \
  const int row = time - 3 * level, further = levels - 1 - level;                                                   \
  const int first = level_begin(begin, further + 1), updates = row >= level_begin(begin, further);                  \
  if (row < first || row >= min(end + 2 * further, rows)) continue;                                                 \
  const int own = row >= begin && row < end;                                                                        \
  global uint* report = reports + (slot + level) * report_words;                                                    \
  global REAL* from = scratch + (level - 1) * (vectors) * level_rows * pitch;                                       \
  global REAL* to = from + (vectors) * level_rows * pitch;                                                          \
  global REAL* ring = scratch + ((levels - 1) * (vectors) * level_rows + level * ring_rows) * pitch
#define IN(n, in, further_down)                                                                                     \
  (level == 0 ? in + place(row + further_down, 0, pitch)                                                            \
              : from + ((n) * level_rows + ((row + further_down) & 3)) * pitch)
#define OUT(n, out) (level == levels - 1 ? out + place(row, 0, pitch) : to + ((n) * level_rows + (row & 3)) * pitch)
#define RING(further_down) (ring + (row + further_down) % ring_rows * pitch)
#define FIND_FORCE                                                                                                  \
  vec F;                                                                                                            \
  maskv fixed = (maskv)(0);                                                                                         \
  if (plain(r.mask + column)) {                                                                                     \
    F = force_in_row(k, &r, column, 0, &carry);                                                                     \
  } else {                                                                                                          \
    F = force_in_row(k, &r, column, 1, &carry);                                                                     \
    fixed = fix(r.mask + column, row, column, columns, &F, own ? held : -1, hands + 4 * (slot + level));            \
  }                                                                                                                 \
  TAKE_BLOCK
/// The same with less code, which takes less time to build: for kernels that run seldom.
#define FIND_FORCE_SLOWLY                                                                                           \
  vec F = force_in_row(k, &r, column, 1, &carry);                                                                   \
  fix(r.mask + column, row, column, columns, &F, own ? held : -1, hands + 4 * (slot + level));                      \
  TAKE_BLOCK
#define TAKE_BLOCK                                                                                                  \
  if (!updates) continue;                                                                                           \
  const int at = column;                                                                                            \
  const vec own_x = load(r.x0 + at, stride), own_v = load(r.v0 + at, stride)
#endif

/// Sets the stored velocity of pinned particles to 0 and that of the held one to the hand's. A work-item each.
kernel void set_fixed(global REAL* v, global REAL* seen, global const int* list, int count, int held, REAL hand_x,
                      REAL hand_y, REAL hand_z, int stride, int columns) {
  const int n = (int)get_global_id(0);
  if (n > count || (n == count && held < 0)) return;
  const int particle = n < count ? list[n] : held;
  const int at = place(particle / columns, particle % columns, 3 * stride);
  const int moves = particle == held;
  v[at] = seen[at] = moves ? hand_x : 0;
  v[at + stride] = seen[at + stride] = moves ? hand_y : 0;
  v[at + 2 * stride] = seen[at + 2 * stride] = moves ? hand_z : 0;
}

/// Stores the velocities of pinned particles that move, and with `put` also where they are. A work-item each.
kernel void drive_pins(global REAL* x, global REAL* v, global REAL* seen, global const int* list,
                       global const REAL* values, int put, int stride, int columns) {
  const int n = (int)get_global_id(0);
  const int at = place(list[n] / columns, list[n] % columns, 3 * stride);
  for (int c = 0; c < 3; ++c) {
    if (put) x[at + c * stride] = values[6 * n + c];
    v[at + c * stride] = seen[at + c * stride] = values[6 * n + 3 + c];
  }
}

/// d = keep d + add a, for all numbers of a field.
kernel void combine(global REAL* d, global const REAL* a, REAL keep, REAL add) {
  const int n = (int)get_global_id(0);
  d[n] = keep * d[n] + add * a[n];
}

#ifdef REAL_IS_DOUBLE
/// The same numbers in float, for who draws: eight a work-item.
kernel void to_float(global const REAL* x, global float* out) {
  const size_t n = get_global_id(0);
  vstore8(convert_float8(vload8(n, x)), n, out);
}
#endif
