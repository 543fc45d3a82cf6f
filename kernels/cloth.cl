// Common to all kernels: numbers and vectors of WIDTH particles, constants, the formulas of forces.
//
// Assumptions: vectors of particles have the layout of row_field.h, with x, y and z of each row, `stride` numbers each;
// memory includes two rows above and three below the cloth, and 16 numbers before. Masks have two rows of zeros above
// and below, and 16 zeros on either side of a row, so springs that would leave the cloth count as torn. Build options:
// REAL (float or double, with REAL_IS_DOUBLE), WIDTH (1, 4, 8 or 16), and the features of the scene: BENDING, DAMPING,
// LINEAR (which brings BENDING), WIND, AIR (which brings WIND), BODIES with BODY_REAL, ONE_WEIGHT. Constants are
// arguments.
#ifdef REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define BITS ulong
#define MASK long
#else
#define BITS uint
#define MASK int
#endif

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define INLINE __attribute__((always_inline)) static

#if WIDTH == 1
typedef REAL realv;
typedef BITS bitsv;
typedef int maskv;
#define LOAD(p) (*(p))
#define STORE(value, p) (*(p) = (value))
#define LOAD_MASK(p) ((int)*(p))
#define AS_BITS JOIN(as_, BITS)
#else
typedef JOIN(REAL, WIDTH) realv;
typedef JOIN(BITS, WIDTH) bitsv;
typedef JOIN(MASK, WIDTH) maskv;
#define LOAD(p) JOIN(vload, WIDTH)(0, p)
#define STORE(value, p) JOIN(vstore, WIDTH)(value, 0, p)
#define LOAD_MASK(p) JOIN(JOIN(convert_, MASK), WIDTH)(JOIN(vload, WIDTH)(0, p))
#define AS_BITS JOIN(JOIN(as_, BITS), WIDTH)
#endif
#define ZERO ((realv)(0))

enum { bit_E = 1, bit_S = 2, bit_SE = 4, bit_SW = 8, bit_EE = 16, bit_SS = 32, bit_free = 64, bit_plain = 128 };

/// Constants of forces that are linear in positions (linear_springs.h) have the layout of masks, each row as its six
/// directions, in the order of the bits.
enum { linear_parts = 6 };

/// A step's words in the report, which begins with zeros. Those from report_torn on are of looks at the springs.
enum {
  report_way = 0,
  report_inside = 1,
  report_contacts = 2,
  report_torn = 3,
  report_straight = 4,
  report_diagonal = 5,
  report_bending = 6,
  report_bad = 7,
  report_words = 8
};

#ifdef REAL_IS_DOUBLE
#define EPSILON 2.220446049250313e-16
#else
#define EPSILON 1.1920928955078125e-7f
#endif

/// As DeviceConstants in device_constants.h.
typedef struct {
  REAL weft, weft_half, warp, warp_half, shear, shear_half;  // …_half: minus the constant times half of the rest length
  REAL bend, bending, shortest2;  // shortest2: square of the length under which a spring has no direction
  REAL k_d;                      // divided by dt where velocities are kept as displacements
  REAL weight;                   // m g
  REAL wind[3];                  // W/3
  REAL air[3], air_across, air_along, air_most;  // as in PairTask of pair_sweep.h
  REAL smallest;                 // the least normal number
  REAL dt, to_way, to_velocity;  // what a stored velocity is multiplied with to be a way, m, and to be a velocity, m/s
  REAL k, middle;                // of the mass on a spring: its spring's, and the height where it rests
  REAL c[16];                    // of the sweep's sums
} Constants;

typedef struct {
  realv x, y, z;
} vec;

/// Where a particle stands in its array: two rows and 16 numbers lie before the first.
INLINE int place(int row, int column, int pitch) { return (row + 2) * pitch + 16 + column; }

INLINE vec load(global const REAL* p, int stride) {
  const vec a = {LOAD(p), LOAD(p + stride), LOAD(p + 2 * stride)};
  return a;
}
INLINE void store(vec a, global REAL* p, int stride) {
  STORE(a.x, p);
  STORE(a.y, p + stride);
  STORE(a.z, p + 2 * stride);
}
INLINE vec minus(vec a, vec b) {
  const vec d = {a.x - b.x, a.y - b.y, a.z - b.z};
  return d;
}
INLINE vec plus(vec a, vec b) {
  const vec s = {a.x + b.x, a.y + b.y, a.z + b.z};
  return s;
}
INLINE vec times(realv k, vec a) {
  const vec p = {k * a.x, k * a.y, k * a.z};
  return p;
}
INLINE vec plus_times(vec s, realv k, vec a) {
  const vec sum = {s.x + k * a.x, s.y + k * a.y, s.z + k * a.z};
  return sum;
}
INLINE vec scaled(REAL k, vec a) { return times((realv)(k), a); }
INLINE vec plus_scaled(vec s, REAL k, vec a) { return plus_times(s, (realv)(k), a); }
INLINE realv dot3(vec a, vec b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
INLINE vec where(maskv on, vec a) {
  const vec w = {on ? a.x : ZERO, on ? a.y : ZERO, on ? a.z : ZERO};
  return w;
}

/// 2h/√a + c. For float, processors have an approximation of 1/√a to 11 or 14 bits, which a Newton step takes to 2 units
/// in the last place, and for which twice h is what is wanted; OpenCL's own rsqrt is as exact, and where there is no such
/// instruction as fast. NaN for 0 and ∞ is allowed.
INLINE realv over_root(REAL h, realv a, REAL c) {
#if defined(REAL_IS_DOUBLE)
  return (2 * h) / sqrt(a) + c;
#elif WIDTH == 16 && defined(__AVX512F__)
  const realv y = __builtin_ia32_rsqrt14ps512_mask(a, a, (ushort)0xffff);
#elif WIDTH == 8 && defined(__AVX__)
  const realv y = __builtin_ia32_rsqrtps256(a);
#elif WIDTH == 4 && defined(__SSE__)
  const realv y = __builtin_ia32_rsqrtps(a);
#else
#define EXACT_ROOT
  return (2 * h) * rsqrt(a) + c;
#endif
#if !defined(REAL_IS_DOUBLE) && !defined(EXACT_ROOT)
  return (h * y) * ((realv)(3) - (a * y) * y) + c;
#endif
}

/// factor · x_ij is F_s on particle i (2.5): pulls only; 0 for NaN.
INLINE realv stretch_factor(REAL k, REAL minus_half, realv r2) {
  const realv a = over_root(minus_half, r2, k);
  return a > ZERO ? a : ZERO;
}
/// factor · x_ij is F_b on particle i (2.7, 2.8): pushes only; 0 for NaN and where the spring has no direction.
INLINE realv bend_factor(REAL k, REAL minus_half, REAL shortest2, realv r2) {
  const realv a = over_root(minus_half, r2, k);
  const realv push = a < ZERO ? a : ZERO;
  return r2 > (realv)(shortest2) ? push : ZERO;
}

/// Lanes whose bit is set; without masks all.
INLINE maskv has(int masked, global const uchar* mask, int bit) {
  return masked ? ((LOAD_MASK(mask) & bit) != 0) : (maskv)(-1);
}

#ifdef WIND
INLINE vec cross3(vec a, vec b) {
  const vec c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return c;
}
/// A third of F = N (N·W), what each corner takes (2.16), for a triangle whose normal n is twice its area long; 0 for
/// one of no area.
INLINE vec wind_on_corner(const Constants* k, vec n) {
  const realv n2 = dot3(n, n);
  const realv push = (k->wind[0] * n.x + (k->wind[1] * n.y + k->wind[2] * n.z)) / n2;
  return times(n2 > (realv)(k->smallest) ? push : ZERO, n);
}
#ifdef AIR
/// What the air does to a corner of the triangle with normal n that moves as the mean of corners with those velocities.
INLINE vec air_on_corner(const Constants* k, vec n, vec a, vec b, vec c) {
  const vec sum = plus(plus(a, b), c);
  const REAL third = (REAL)1 / 3;
  const vec u = {(realv)(k->air[0]) - third * sum.x, (realv)(k->air[1]) - third * sum.y,
                 (realv)(k->air[2]) - third * sum.z};
  const realv n2 = dot3(n, n), through = dot3(n, u);
  const realv resists = fmin((realv)(k->air_along) * sqrt(n2 * dot3(u, u)), (realv)(k->air_most));
  const realv more = (fmin((realv)(k->air_across) * fabs(through), (realv)(k->air_most)) - resists) * through / n2;
  const vec f = plus_times(times(more, n), resists, u), none = {ZERO, ZERO, ZERO};
  const vec on = {n2 > (realv)(k->smallest) ? f.x : none.x, n2 > (realv)(k->smallest) ? f.y : none.y,
                  n2 > (realv)(k->smallest) ? f.z : none.z};
  return on;
}
#endif
INLINE maskv choose(maskv odd, maskv yes, maskv no) { return (odd & yes) | (~odd & no); }
INLINE vec pick(maskv odd, vec yes, vec no) {
  const vec p = {odd ? yes.x : no.x, odd ? yes.y : no.y, odd ? yes.z : no.z};
  return p;
}
/// Lanes for which row + column of the quad is odd; `sum`: of the first lane's.
INLINE maskv odd_quads(int sum) {
#if WIDTH == 16
  const maskv odd = {0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1};
#elif WIDTH == 8
  const maskv odd = {0, -1, 0, -1, 0, -1, 0, -1};
#elif WIDTH == 4
  const maskv odd = {0, -1, 0, -1};
#else
  const maskv odd = 0;
#endif
  return (sum & 1) != 0 ? ~odd : odd;
}

#endif

/// Whether all particles of the block have all springs and triangles, and are free.
INLINE int plain(global const uchar* mask) {
#if WIDTH == 16
  const ulong2 m = as_ulong2(vload16(0, mask));
  return (m.x & m.y & 0x8080808080808080ul) == 0x8080808080808080ul;
#elif WIDTH == 8
  return (as_ulong(vload8(0, mask)) & 0x8080808080808080ul) == 0x8080808080808080ul;
#elif WIDTH == 4
  return (as_uint(vload4(0, mask)) & 0x80808080u) == 0x80808080u;
#else
  return (*mask & bit_plain) != 0;
#endif
}
