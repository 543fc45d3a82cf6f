// One band of rows per work-item, in vectors of WIDTH particles, for processors. As in the CPU engine
// (pair_sweep-inl.h) the particle that owns a spring computes it once; the force on its right end is carried along the
// row, and forces on rows below wait in a ring of three rows. The two rows above a band are computed again for their
// forces on it. A sweep reads one set of arrays and writes another, so bands do not wait for each other.
#if WIDTH > 1

/// Lanes moved up by n; the lowest come from the top of `before`.
#if defined(__clang__)
#if WIDTH == 16
#define FROM_LEFT_1(a, b) __builtin_shufflevector(a, b, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30)
#define FROM_LEFT_2(a, b) __builtin_shufflevector(a, b, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29)
#elif WIDTH == 8
#define FROM_LEFT_1(a, b) __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14)
#define FROM_LEFT_2(a, b) __builtin_shufflevector(a, b, 6, 7, 8, 9, 10, 11, 12, 13)
#else
#define FROM_LEFT_1(a, b) __builtin_shufflevector(a, b, 3, 4, 5, 6)
#define FROM_LEFT_2(a, b) __builtin_shufflevector(a, b, 2, 3, 4, 5)
#endif
#else
#if WIDTH == 16
#define LANES (bitsv)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#elif WIDTH == 8
#define LANES (bitsv)(0, 1, 2, 3, 4, 5, 6, 7)
#else
#define LANES (bitsv)(0, 1, 2, 3)
#endif
#define FROM_LEFT_1(a, b) shuffle2(a, b, LANES + (bitsv)(WIDTH - 1))
#define FROM_LEFT_2(a, b) shuffle2(a, b, LANES + (bitsv)(WIDTH - 2))
#endif

INLINE vec from_left_1(vec before, vec now) {
  const vec v = {FROM_LEFT_1(before.x, now.x), FROM_LEFT_1(before.y, now.y), FROM_LEFT_1(before.z, now.z)};
  return v;
}
INLINE vec from_left_2(vec before, vec now) {
  const vec v = {FROM_LEFT_2(before.x, now.x), FROM_LEFT_2(before.y, now.y), FROM_LEFT_2(before.z, now.z)};
  return v;
}

/// A row of the sweep: x and v of it and of the rows below, the ring's rows for it and the two below, its masks, and the
/// constants of LINEAR.
typedef struct {
  global const REAL *x0, *x1, *x2, *v0, *v1;
  global REAL *f0, *f1, *f2;
  global const uchar* mask;
  int stride, mask_pitch, row;
  global const REAL* linear;
} Row;

/// What goes from a block of a row to the next: forces on right ends.
typedef struct {
  vec right, two_right, slant;
} Carry;

INLINE vec kept(int masked, maskv on, vec f) { return masked ? where(on, f) : f; }

#ifdef LINEAR
#define WITH_LINEAR(f, linear, x_ij) plus_times(f, linear, x_ij)
#define LINEAR_OF(r, number, j) LOAD((r)->linear + (number) * (r)->mask_pitch + (j))
#else
#define WITH_LINEAR(f, linear, x_ij) f
#define LINEAR_OF(r, number, j) ZERO
#endif

/// Force of a stretch spring with its damping, on its owner.
INLINE vec stretched(const Constants* k, REAL stiffness, REAL minus_half, vec x_ij, vec v_ij, realv linear, int masked, maskv on) {
  vec f = times(stretch_factor(stiffness, minus_half, dot3(x_ij, x_ij)), x_ij);
#ifdef DAMPING
  f = plus_scaled(f, k->k_d, v_ij);
#endif
  return WITH_LINEAR(kept(masked, on, f), linear, x_ij);
}

INLINE vec bent(const Constants* k, vec x_ij, realv linear, int masked, maskv on) {
  const vec f = times(bend_factor(k->bend, k->bending, k->shortest2, dot3(x_ij, x_ij)), x_ij);
  return WITH_LINEAR(kept(masked, on, f), linear, x_ij);
}

/// a + b where the mask is set, else a.
INLINE vec plus_where(maskv on, vec a, vec b) { return plus(a, where(on, b)); }

/// F_int + F_wind + F_g on the block at column j, once all blocks to the left and above have been here. With A a
/// particle, B to its right, C below it and E below B, A looks at the springs A-B, A-C, A-E, B-C.
INLINE vec force_in_row(const Constants* k, const Row* r, int j, int masked, Carry* carry) {
  const int s = r->stride;
#ifdef ONE_WEIGHT
  const vec x = load(r->x0 + j, s), v = load(r->v0 + j, s);
  const vec pull = {ZERO, -k->k * (x.y - k->middle) - k->k_d * v.y - k->weight, ZERO};
  return pull;
#else
  global const uchar* m = r->mask + j;
  const vec A = load(r->x0 + j, s), B = load(r->x0 + j + 1, s), C = load(r->x1 + j, s), E = load(r->x1 + j + 1, s);
  const vec to_right = minus(B, A), to_below = minus(C, A), to_slant = minus(E, A), to_cross = minus(C, B);
#if defined(DAMPING) || defined(AIR)
  const vec vA = load(r->v0 + j, s), vB = load(r->v0 + j + 1, s), vC = load(r->v1 + j, s), vE = load(r->v1 + j + 1, s);
#endif
#ifdef DAMPING
  const vec v_right = minus(vB, vA), v_below = minus(vC, vA), v_slant = minus(vE, vA), v_cross = minus(vC, vB);
#else
  const vec v_right = A, v_below = A, v_slant = A, v_cross = A;
#endif
  const maskv on_S = has(masked, m, bit_S), on_SE = has(masked, m, bit_SE), on_SW = has(masked, m + 1, bit_SW);
  const maskv on_E = has(masked, m, bit_E);
  const vec right = stretched(k, k->weft, k->weft_half, to_right, v_right, LINEAR_OF(r, 0, j), masked, on_E);
  const vec below = stretched(k, k->warp, k->warp_half, to_below, v_below, LINEAR_OF(r, 1, j), masked, on_S);
  const vec slant = stretched(k, k->shear, k->shear_half, to_slant, v_slant, LINEAR_OF(r, 2, j), masked, on_SE);
  const vec crossing = stretched(k, k->shear, k->shear_half, to_cross, v_cross, LINEAR_OF(r, 3, j + 1), masked, on_SW);
  vec on_A = plus(plus(right, below), slant), on_B = minus(crossing, right);
  vec from_C = plus(below, crossing), from_E = slant;
#ifdef WIND
  // The first triangle of a quad always has A and C, the second B and E (figure 2.7).
  const maskv odd = odd_quads(r->row + j);
  const vec C_to_E = minus(E, C), B_to_E = minus(E, B);
  const vec first_n = cross3(to_below, pick(odd, to_right, C_to_E));
  const vec second_n = cross3(B_to_E, pick(odd, C_to_E, to_right));
  vec first = wind_on_corner(k, first_n), second = wind_on_corner(k, second_n);
#ifdef AIR
  first = plus(first, air_on_corner(k, first_n, vA, vC, pick(odd, vB, vE)));
  second = plus(second, air_on_corner(k, second_n, vB, vE, pick(odd, vC, vA)));
#endif
  if (masked) {
    const maskv below_E = has(1, m + r->mask_pitch, bit_E), split = choose(odd, on_SW, on_SE);
    first = where(on_S & split & choose(odd, on_E, below_E), first);
    second = where(has(1, m + 1, bit_S) & split & choose(odd, below_E, on_E), second);
  }
  on_A = plus_where(~odd, plus(on_A, first), second);
  on_B = plus_where(odd, plus(on_B, second), first);
  from_C = minus(from_C, plus_where(odd, first, second));
  from_E = minus(from_E, plus_where(~odd, second, first));
#endif
#ifdef BENDING
  from_C = plus(from_C, load(r->f1 + j, s));
  const vec two_right = bent(k, minus(load(r->x0 + j + 2, s), A), LINEAR_OF(r, 4, j), masked, has(masked, m, bit_EE));
  const vec two_below = bent(k, minus(load(r->x2 + j, s), A), LINEAR_OF(r, 5, j), masked, has(masked, m, bit_SS));
  on_A = minus(plus(on_A, plus(two_below, two_right)), from_left_2(carry->two_right, two_right));
  carry->two_right = two_right;
  store(two_below, r->f2 + j, s);
#endif
  const vec F = minus(plus(on_A, from_left_1(carry->right, on_B)), load(r->f0 + j, s));
  store(plus(from_C, from_left_1(carry->slant, from_E)), r->f1 + j, s);
  carry->right = on_B, carry->slant = from_E;
  const vec weighted = {F.x, F.y - (realv)(k->weight), F.z};
  return weighted;
#endif
}

enum { ring_rows = 3, level_rows = 4 };

/// The first of the rows that a level of a launch makes: each level needs two rows more on either side than the next.
INLINE int level_begin(int begin, int further) { return max(begin - 2 * further, 0); }

INLINE void clear_row(global REAL* row, int numbers) {
  for (int n = 0; n < numbers; n += WIDTH) STORE(ZERO, row + n);
}
#endif
