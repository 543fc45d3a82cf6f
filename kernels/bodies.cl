// Collision with fixed bodies by contact.cl: one particle at a time, in double if the device supports it.
#ifdef BODIES
/// Whether a particle of the block may touch a body in the step from `old` to x.
INLINE int touches(global const Body* bodies, int count, vec old, vec x) {
  maskv near = (maskv)(0);
  const vec way = minus(x, old);
  const realv square = dot3(way, way);
  for (int n = 0; n < count; ++n) {
    global const Body* body = bodies + n;
    const realv c[3] = {(realv)((REAL)body->c[0]), (realv)((REAL)body->c[1]), (realv)((REAL)body->c[2])};
    const vec out = {x.x - c[0], x.y - c[1], x.z - c[2]};
    const realv reach = (realv)((REAL)body->reach);
    // The nearest point of the way, as a part of it back from its end.
    const realv part = square > ZERO ? clamp(dot3(out, way) / square, ZERO, (realv)(1)) : ZERO;
    const vec nearest = plus_times(out, -part, way);
    const realv n[3] = {(realv)((REAL)body->axes[3]), (realv)((REAL)body->axes[4]), (realv)((REAL)body->axes[5])};
    near |= body->shape == plane_shape ? (n[0] * x.x + n[1] * x.y + n[2] * x.z < reach)
                                       : (dot3(nearest, nearest) < reach * reach);
  }
#if WIDTH == 1
  return near;
#else
  return any(near);
#endif
}

/// What steps know of bodies: as many as there are follow, for each step of the batch if they move.
typedef struct {
  ContactRule rule;
  Body bodies[1];
} BodyList;

/// The contacts that the energy ledger asks for: as many as there are particles have room.
typedef struct {
  BODY_REAL x[3], v[3];
  int particle, unused;
} Contact;

/// Corrects the block's free particles. `first`: number of its first particle; `first_body`: of the step's first body.
INLINE void collide_block(global const BodyList* list, int first_body, int count, const Constants* k, int columns_left, int first,
                          int own, maskv fixed, vec old, vec old_v, vec* x, vec* v, vec* seen, int sees_itself,
                          global uint* report, global Contact* contacts) {
  global const Body* bodies = list->bodies + first_body;
  const ContactRule rule = list->rule;
  const BODY_REAL to_velocity = k->to_velocity;
  REAL o[3][WIDTH], u[3][WIDTH], p[3][WIDTH], w[3][WIDTH], s[3][WIDTH];
  MASK held[WIDTH];
  STORE(old.x, o[0]), STORE(old.y, o[1]), STORE(old.z, o[2]);
  STORE(old_v.x, u[0]), STORE(old_v.y, u[1]), STORE(old_v.z, u[2]);
  STORE(x->x, p[0]), STORE(x->y, p[1]), STORE(x->z, p[2]);
  STORE(v->x, w[0]), STORE(v->y, w[1]), STORE(v->z, w[2]);
  STORE(seen->x, s[0]), STORE(seen->y, s[1]), STORE(seen->z, s[2]);
  STORE(fixed, held);
  for (int lane = 0; lane < WIDTH && lane < columns_left; ++lane) {
    if (held[lane]) continue;
    BODY_REAL3 at = (BODY_REAL3)(p[0][lane], p[1][lane], p[2][lane]);
    const BODY_REAL3 from = (BODY_REAL3)(o[0][lane], o[1][lane], o[2][lane]);
    if (!meets(bodies, count, rule, from, at)) continue;
    BODY_REAL3 velocity = (BODY_REAL3)(w[0][lane], w[1][lane], w[2][lane]) * to_velocity;
    const BODY_REAL3 freely = at, free_velocity = velocity;
    const BODY_REAL3 velocity_before = (BODY_REAL3)(u[0][lane], u[1][lane], u[2][lane]) * to_velocity;
    if (collide(bodies, count, rule, from, velocity_before, &at, &velocity) && own) atomic_inc(report + report_inside);
    p[0][lane] = (REAL)at.x, p[1][lane] = (REAL)at.y, p[2][lane] = (REAL)at.z;
    // What damping sees is changed as much; at the ends of steps alone it becomes the same.
    const BODY_REAL3 stored = velocity / to_velocity, gained = (velocity - free_velocity) / to_velocity;
    const int same = sees_itself || rule.at_ends;
    w[0][lane] = (REAL)stored.x, s[0][lane] = same ? w[0][lane] : (REAL)(s[0][lane] + gained.x);
    w[1][lane] = (REAL)stored.y, s[1][lane] = same ? w[1][lane] : (REAL)(s[1][lane] + gained.y);
    w[2][lane] = (REAL)stored.z, s[2][lane] = same ? w[2][lane] : (REAL)(s[2][lane] + gained.z);
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
