// Collision with fixed bodies, as in core/forces/contact.cpp: one particle at a time, in double if the device supports
// it.
#ifdef BODIES
#ifdef BODY_REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define BODY_REAL3 JOIN(BODY_REAL, 3)

/// As DeviceBody in device_constants.h.
typedef struct {
  BODY_REAL c[3], r, y, friction, restitution;
  BODY_REAL rest_speed;
  BODY_REAL touch;  // square of the distance from c (a plane: the height) under which a particle may touch it
  int plane, unused;
} Body;

enum { passes = 4 };  // as in contact.cpp

INLINE BODY_REAL3 center(global const Body* body) { return (BODY_REAL3)(body->c[0], body->c[1], body->c[2]); }

INLINE BODY_REAL depth_in(global const Body* body, BODY_REAL3 x) {
  return body->plane ? body->y - x.y : body->r - sqrt(dot(x - center(body), x - center(body)));
}

INLINE BODY_REAL3 normal_of(global const Body* body, BODY_REAL3 x) {
  const BODY_REAL3 up = (BODY_REAL3)(0, 1, 0), out = x - center(body);
  const BODY_REAL length2 = dot(out, out);
  return body->plane || !(length2 > 0) ? up : out / sqrt(length2);
}

/// 8 units in the last place of the largest of |x|, |c|, r.
INLINE BODY_REAL tolerance_at(global const Body* body, BODY_REAL3 x, BODY_REAL epsilon) {
  const BODY_REAL far = body->plane ? fmax(fabs(x.y), fabs(body->y))
                                    : fmax(fmax(sqrt(dot(x, x)), sqrt(dot(center(body), center(body)))), body->r);
  return 8 * epsilon * far;
}

/// Where the line from x, inside, along n leaves the body.
INLINE BODY_REAL3 way_out(global const Body* body, BODY_REAL3 x, BODY_REAL3 n) {
  if (body->plane) return (BODY_REAL3)(x.x, body->y, x.z);
  const BODY_REAL3 q = x - center(body);
  const BODY_REAL along = dot(q, n);
  return x + (sqrt(along * along - dot(q, q) + body->r * body->r) - along) * n;
}

/// Normal part removed or reversed with restitution e, tangential part shortened by at most μ times the change.
INLINE BODY_REAL3 corrected_velocity(global const Body* body, BODY_REAL3 v, BODY_REAL3 n) {
  const BODY_REAL inward = dot(v, n);
  if (inward >= 0) return v;
  const BODY_REAL e = -inward < body->rest_speed ? (BODY_REAL)(0) : body->restitution;
  const BODY_REAL change = (1 + e) * -inward;
  const BODY_REAL3 tangential = v - inward * n;
  const BODY_REAL speed = sqrt(dot(tangential, tangential));
  const BODY_REAL left = speed > 0 ? fmax((BODY_REAL)(0), 1 - body->friction * change / speed) : (BODY_REAL)(0);
  return left * tangential - e * inward * n;
}

INLINE void collide_one(global const Body* body, BODY_REAL dt, BODY_REAL3 old, BODY_REAL3* x, BODY_REAL3* v) {
  const BODY_REAL3 n = normal_of(body, old);
  if (depth_in(body, old) > tolerance_at(body, old, EPSILON)) {
    *x = way_out(body, *x, n);
    *v -= fmin((BODY_REAL)(0), dot(*v, n)) * n;
    return;
  }
  *v = corrected_velocity(body, *v, n);
  *x = old + dt * *v;
  if (!(depth_in(body, *x) > 0)) return;
  const int at_center = !body->plane && !(dot(*x - center(body), *x - center(body)) > 0);
  *x = body->plane ? (BODY_REAL3)((*x).x, body->y, (*x).z)
                   : center(body) + body->r * (at_center ? n : normal_of(body, *x));
}

/// Corrects x and v for all bodies; returns whether x is still inside one.
INLINE int collide(global const Body* bodies, int count, BODY_REAL dt, BODY_REAL3 old, BODY_REAL3* x, BODY_REAL3* v) {
  for (int pass = 0; pass < passes; ++pass) {
    int touched = 0;
    for (int n = 0; n < count; ++n) {
      const BODY_REAL depth = depth_in(bodies + n, *x);
      if (!(depth > 0) || (pass > 0 && depth <= tolerance_at(bodies + n, *x, EPSILON))) continue;
      collide_one(bodies + n, dt, old, x, v);
      touched = 1;
    }
    if (!touched) return 0;
  }
  int inside = 0;
  for (int n = 0; n < count; ++n) inside |= depth_in(bodies + n, *x) > tolerance_at(bodies + n, *x, EPSILON);
  return inside;
}

/// Whether a particle of the block may touch a body.
INLINE int touches(global const Body* bodies, int count, vec x) {
  maskv near = (maskv)(0);
  for (int n = 0; n < count; ++n) {
    global const Body* body = bodies + n;
    const realv c[3] = {(realv)((REAL)body->c[0]), (realv)((REAL)body->c[1]), (realv)((REAL)body->c[2])};
    const vec out = {x.x - c[0], x.y - c[1], x.z - c[2]};
    const realv touch = (realv)((REAL)body->touch);
    near |= body->plane ? (x.y < touch) : (dot3(out, out) < touch);
  }
#if WIDTH == 1
  return near;
#else
  return any(near);
#endif
}

/// The contacts that the energy ledger asks for: as many as there are particles have room.
typedef struct {
  BODY_REAL x[3], v[3];
  int particle, unused;
} Contact;

/// Corrects the block's free particles. `first`: number of its first particle.
INLINE void collide_block(global const Body* bodies, int count, const Constants* k, int columns_left, int first,
                          int own, maskv fixed, vec old, vec* x, vec* v, vec* seen, global uint* report,
                          global Contact* contacts) {
  REAL o[3][WIDTH], p[3][WIDTH], w[3][WIDTH], s[3][WIDTH];
  MASK held[WIDTH];
  STORE(old.x, o[0]), STORE(old.y, o[1]), STORE(old.z, o[2]);
  STORE(x->x, p[0]), STORE(x->y, p[1]), STORE(x->z, p[2]);
  STORE(v->x, w[0]), STORE(v->y, w[1]), STORE(v->z, w[2]);
  STORE(seen->x, s[0]), STORE(seen->y, s[1]), STORE(seen->z, s[2]);
  STORE(fixed, held);
  for (int lane = 0; lane < WIDTH && lane < columns_left; ++lane) {
    if (held[lane]) continue;
    BODY_REAL3 at = (BODY_REAL3)(p[0][lane], p[1][lane], p[2][lane]);
    int inside = 0;
    for (int n = 0; n < count; ++n) inside |= depth_in(bodies + n, at) > 0;
    if (!inside) continue;
    const BODY_REAL to_velocity = k->to_velocity;
    BODY_REAL3 velocity = (BODY_REAL3)(w[0][lane], w[1][lane], w[2][lane]) * to_velocity;
    const BODY_REAL3 freely = at, free_velocity = velocity;
    const BODY_REAL3 from = (BODY_REAL3)(o[0][lane], o[1][lane], o[2][lane]);
    if (collide(bodies, count, k->dt, from, &at, &velocity) && own) atomic_inc(report + report_inside);
    p[0][lane] = (REAL)at.x, p[1][lane] = (REAL)at.y, p[2][lane] = (REAL)at.z;
    velocity /= to_velocity;
    w[0][lane] = s[0][lane] = (REAL)velocity.x;
    w[1][lane] = s[1][lane] = (REAL)velocity.y;
    w[2][lane] = s[2][lane] = (REAL)velocity.z;
#ifdef CONTACTS
    if (!own) continue;
    global Contact* note = contacts + atomic_inc(report + report_contacts);
    note->particle = first + lane;
    for (int c = 0; c < 3; ++c) {
      note->x[c] = (c == 0 ? freely.x : c == 1 ? freely.y : freely.z) - p[c][lane];
      note->v[c] = (c == 0 ? free_velocity.x : c == 1 ? free_velocity.y : free_velocity.z) - w[c][lane] * to_velocity;
    }
#endif
  }
  x->x = LOAD(p[0]), x->y = LOAD(p[1]), x->z = LOAD(p[2]);
  v->x = LOAD(w[0]), v->y = LOAD(w[1]), v->z = LOAD(w[2]);
  seen->x = LOAD(s[0]), seen->y = LOAD(s[1]), seen->z = LOAD(s[2]);
}
#endif
