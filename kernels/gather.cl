// One particle per work-item, which gathers the forces from its twelve neighbors, for devices with many small
// processors: there, computing a spring at both of its ends is faster than passing on its force.
#if WIDTH == 1
/// The block of particles that a work-item looks at: pointers to its first one.
typedef struct {
  global const REAL *x, *v;
  global const REAL* linear;  // of LINEAR: its springs' constants
  global const uchar* mask;
  int stride, mask_pitch;
  int row, column;  // of the first
} Block;

#ifdef LINEAR
/// The constant of a spring of that direction: of the particle itself, or of the one up or to the left that owns it.
INLINE realv linear_at(const Block* b, int number, int di, int dj) {
  const int owned = di > 0 || (di == 0 && dj > 0);
  return b->linear[number * b->mask_pitch + (owned ? 0 : di * linear_parts * b->mask_pitch + dj)];
}
#define LINEAR_AT(b, number, di, dj) linear_at(b, number, di, dj)
#else
#define LINEAR_AT(b, number, di, dj) ZERO
#endif

/// Adds a stretch spring and its damping, to the particle di rows below and dj columns to the right; `number` is that of
/// its direction.
INLINE vec with_stretch(vec f, const Constants* k, const Block* b, vec x, vec v, int number, int di, int dj, int masked,
                        maskv on) {
  const int to = di * 3 * b->stride + dj;
  const vec x_ij = minus(load(b->x + to, b->stride), x);
  const int warp = dj == 0, shear = di != 0 && dj != 0;
  realv factor = stretch_factor(shear ? k->shear : warp ? k->warp : k->weft,
                                shear ? k->shear_half : warp ? k->warp_half : k->weft_half, dot3(x_ij, x_ij));
  if (masked) factor = on ? factor : ZERO;
  factor += LINEAR_AT(b, number, di, dj);
  f = plus_times(f, factor, x_ij);
#ifdef DAMPING
  const vec v_ij = minus(load(b->v + to, b->stride), v);
  f = masked ? plus_times(f, on ? (realv)(k->k_d) : ZERO, v_ij) : plus_scaled(f, k->k_d, v_ij);
#endif
  return f;
}

#ifdef BENDING
INLINE vec with_bending(vec f, const Constants* k, const Block* b, vec x, int number, int di, int dj, int masked,
                        maskv on) {
  const vec x_ij = minus(load(b->x + di * 3 * b->stride + dj, b->stride), x);
  const realv factor = bend_factor(k->bend, k->bending, k->shortest2, dot3(x_ij, x_ij));
  return plus_times(f, (masked ? (on ? factor : ZERO) : factor) + LINEAR_AT(b, number, di, dj), x_ij);
}
#endif

#ifdef WIND
/// Adds wind and air on the triangles of one of the quads that the particle is a corner of: the quad's upper left particle
/// A stands di rows below and dj columns to the right of it (0 or -1). Even quads A B C E are split from A to E, odd
/// ones from C to B (figure 2.7); the first triangle always has A and C, the second B and E.
INLINE vec with_quad(vec f, const Constants* k, const Block* b, int di, int dj, int masked) {
  global const REAL* at = b->x + di * 3 * b->stride + dj;
  const vec A = load(at, b->stride), B = load(at + 1, b->stride), C = load(at + 3 * b->stride, b->stride),
            E = load(at + 3 * b->stride + 1, b->stride);
  const maskv odd = odd_quads(b->row + di + b->column + dj);
  const vec first_n = cross3(minus(C, A), pick(odd, minus(B, A), minus(E, C)));
  const vec second_n = cross3(minus(E, B), pick(odd, minus(E, C), minus(B, A)));
  vec first = wind_on_corner(k, first_n), second = wind_on_corner(k, second_n);
#ifdef AIR
  global const REAL* speed = b->v + di * 3 * b->stride + dj;
  const vec vA = load(speed, b->stride), vB = load(speed + 1, b->stride), vC = load(speed + 3 * b->stride, b->stride),
            vE = load(speed + 3 * b->stride + 1, b->stride);
  first = plus(first, air_on_corner(k, first_n, vA, vC, pick(odd, vB, vE)));
  second = plus(second, air_on_corner(k, second_n, vB, vE, pick(odd, vC, vA)));
#endif
  // A stands in both triangles of an even quad and in the first one of an odd quad, and so on.
  const int first_always = dj == 0, both_if_odd = di != dj;
  const maskv both = both_if_odd ? odd : ~odd;
  maskv in_first = first_always ? (maskv)(-1) : both, in_second = first_always ? both : (maskv)(-1);
  if (masked) {
    global const uchar *own = b->mask + di * b->mask_pitch + dj, *below = own + b->mask_pitch;
    const maskv own_E = has(1, own, bit_E), below_E = has(1, below, bit_E);
    const maskv slant = choose(odd, has(1, own + 1, bit_SW), has(1, own, bit_SE));
    in_first &= has(1, own, bit_S) & slant & choose(odd, own_E, below_E);
    in_second &= has(1, own + 1, bit_S) & slant & choose(odd, below_E, own_E);
  }
  return plus(plus(f, where(in_first, first)), where(in_second, second));
}
#endif

/// F_int + F_wind + F_g on the block's particles.
INLINE vec force_on(const Constants* k, const Block* b, vec x, vec v, int masked) {
  global const uchar* m = b->mask;
  const int up = -b->mask_pitch;
  vec f = {ZERO, ZERO, ZERO};
#ifdef ONE_WEIGHT
  f.y = -k->k * (x.y - k->middle) - k->k_d * v.y - k->weight;
  return f;
#else
  f = with_stretch(f, k, b, x, v, 0, 0, 1, masked, has(masked, m, bit_E));
  f = with_stretch(f, k, b, x, v, 0, 0, -1, masked, has(masked, m - 1, bit_E));
  f = with_stretch(f, k, b, x, v, 1, 1, 0, masked, has(masked, m, bit_S));
  f = with_stretch(f, k, b, x, v, 1, -1, 0, masked, has(masked, m + up, bit_S));
  f = with_stretch(f, k, b, x, v, 2, 1, 1, masked, has(masked, m, bit_SE));
  f = with_stretch(f, k, b, x, v, 2, -1, -1, masked, has(masked, m + up - 1, bit_SE));
  f = with_stretch(f, k, b, x, v, 3, 1, -1, masked, has(masked, m, bit_SW));
  f = with_stretch(f, k, b, x, v, 3, -1, 1, masked, has(masked, m + up + 1, bit_SW));
#ifdef BENDING
  f = with_bending(f, k, b, x, 4, 0, 2, masked, has(masked, m, bit_EE));
  f = with_bending(f, k, b, x, 4, 0, -2, masked, has(masked, m - 2, bit_EE));
  f = with_bending(f, k, b, x, 5, 2, 0, masked, has(masked, m, bit_SS));
  f = with_bending(f, k, b, x, 5, -2, 0, masked, has(masked, m + 2 * up, bit_SS));
#endif
#ifdef WIND
  f = with_quad(f, k, b, 0, 0, masked);
  f = with_quad(f, k, b, 0, -1, masked);
  f = with_quad(f, k, b, -1, 0, masked);
  f = with_quad(f, k, b, -1, -1, masked);
#endif
  f.y -= (realv)(k->weight);
  return f;
#endif
}
#endif
