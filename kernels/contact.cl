// What bodies do to one particle in a step (2.1.5; docs/model.md, "Collision"). Both engines compile this file: the
// kernels after bodies.cl, the CPU engine in core/forces/contact.cpp. Whoever includes it has defined INLINE, BODY_REAL,
// BODY_REAL3, VECTOR(x, y, z), and Body with c (through center()), r, y, friction, restitution, and is_plane().
//
// A new shape needs its distance, its normal and its curvature here, and nothing else.

#ifdef BODIES

/// How a step of the method moves a particle whose acceleration is constant, and what else contacts ask for.
typedef struct {
  BODY_REAL dt;       // s
  BODY_REAL epsilon;  // of the precision of the state
  BODY_REAL g;        // m/s²
  BODY_REAL share;    // x_1 = x_0 + dt (v + share dt a), v being the stored velocity before the step
  BODY_REAL kick;     // what the step's last sweep adds to the stored velocity, divided by dt a
  BODY_REAL lag;      // the stored velocity is that of lag dt ago
  int at_ends;        // the report's rule: contact is seen at the ends of steps alone
  int unused;
} ContactRule;

/// A path with constant acceleration: position, velocity, acceleration.
typedef struct {
  BODY_REAL3 p, u, a;
} Path;

/// Distance from the surface, m; negative inside.
INLINE BODY_REAL gap_at(global const Body* body, BODY_REAL3 x) {
  const BODY_REAL3 out = x - center(body);
  return is_plane(body) ? x.y - body->y : sqrt(dot(out, out)) - body->r;
}

/// Unit normal of the surface seen from x; +y at a sphere's center.
INLINE BODY_REAL3 normal_at(global const Body* body, BODY_REAL3 x) {
  const BODY_REAL3 up = VECTOR(0, 1, 0), out = x - center(body);
  const BODY_REAL length = sqrt(dot(out, out));
  return is_plane(body) || !(length > 0) ? up : out / length;
}

/// What the second derivative of the distance has beside that of the path: a particle that moves straight on at u leaves
/// a sphere's surface, 1/s².
INLINE BODY_REAL turn_at(global const Body* body, BODY_REAL3 n, BODY_REAL3 u) {
  const BODY_REAL inward = dot(u, n);
  return is_plane(body) ? (BODY_REAL)(0) : (dot(u, u) - inward * inward) / body->r;
}

/// The point of the surface that is nearest to x; at a sphere's center in the direction n.
INLINE BODY_REAL3 surface_at(global const Body* body, BODY_REAL3 x, BODY_REAL3 n) {
  const BODY_REAL3 out = x - center(body);
  if (is_plane(body)) return VECTOR(x.x, body->y, x.z);
  return center(body) + body->r * (dot(out, out) > 0 ? normal_at(body, x) : n);
}

/// Where the line from x, inside, along n leaves the body.
INLINE BODY_REAL3 way_out(global const Body* body, BODY_REAL3 x, BODY_REAL3 n) {
  if (is_plane(body)) return VECTOR(x.x, body->y, x.z);
  const BODY_REAL3 q = x - center(body);
  const BODY_REAL along = dot(q, n);
  return x + (sqrt(along * along - dot(q, q) + body->r * body->r) - along) * n;
}

/// 8 units in the last place of the largest of |x|, |c|, r: a bound on rounding errors, m.
INLINE BODY_REAL tolerance_at(global const Body* body, BODY_REAL3 x, BODY_REAL epsilon) {
  const BODY_REAL3 c = center(body);
  const BODY_REAL far = is_plane(body) ? fmax(fabs(x.y), fabs(body->y))
                                       : fmax(fmax(sqrt(dot(x, x)), sqrt(dot(c, c))), body->r);
  return 8 * epsilon * far;
}

/// Whether a particle that goes from one point to the other in a step may meet the body: it ends inside, or its way
/// leads through.
INLINE int crosses(global const Body* body, BODY_REAL3 from, BODY_REAL3 to, BODY_REAL tolerance) {
  if (gap_at(body, to) < tolerance) return 1;
  if (is_plane(body)) return 0;
  const BODY_REAL3 way = to - from, before = from - center(body);
  const BODY_REAL square = dot(way, way), along = -dot(before, way);
  if (!(along > 0 && along < square)) return 0;
  const BODY_REAL3 nearest = before + (along / square) * way;
  return dot(nearest, nearest) < body->r * body->r;
}

// ---- The report's rule: contact at the ends of steps ----------------------------------------------------------------

enum { passes = 4 };  // enough for the wedge of two bodies; more only helps where three meet

/// The speed toward the body, m/s, below which a particle rests on it rather than bounces. A step that finds a contact at
/// its end errs in the speed of the bounce, by g dt (Verlet) to 3 g dt (Euler), so with a restitution e, bounces of up to
/// 3 g dt/(1 - e) regain the energy that they lose and would never end. 0 above e = 0.9, where it would end real bounces.
INLINE BODY_REAL rest_speed(global const Body* body, ContactRule rule) {
  const BODY_REAL error = 3.5f;  // of g dt: Euler's 3, and some more, since some bounces are above their mean
  return body->restitution <= (BODY_REAL)(9) / 10 ? error * rule.g * rule.dt / (1 - body->restitution) : (BODY_REAL)(0);
}

/// Normal part removed or reversed with restitution e, tangential part shortened by at most μ times the change.
INLINE BODY_REAL3 corrected_velocity(global const Body* body, ContactRule rule, BODY_REAL3 v, BODY_REAL3 n) {
  const BODY_REAL inward = dot(v, n);
  if (inward >= 0) return v;
  const BODY_REAL e = -inward < rest_speed(body, rule) ? (BODY_REAL)(0) : body->restitution;
  const BODY_REAL change = (1 + e) * -inward;
  const BODY_REAL3 tangential = v - inward * n;
  const BODY_REAL speed = sqrt(dot(tangential, tangential));
  const BODY_REAL left = speed > 0 ? fmax((BODY_REAL)(0), 1 - body->friction * change / speed) : (BODY_REAL)(0);
  return left * tangential - e * inward * n;
}

INLINE void collide_one(global const Body* body, ContactRule rule, BODY_REAL3 old, BODY_REAL3* x, BODY_REAL3* v) {
  const BODY_REAL3 n = normal_at(body, old);
  if (-gap_at(body, old) > tolerance_at(body, old, rule.epsilon)) {
    // It was inside already (the body was moved, a bad start): out along n, the nearest way from where it was. From a
    // sphere's center that is up, even if gravity has just moved it below.
    *x = way_out(body, *x, n);
    *v -= fmin((BODY_REAL)(0), dot(*v, n)) * n;
    return;
  }
  *v = corrected_velocity(body, rule, *v, n);
  *x = old + rule.dt * *v;
  if (gap_at(body, *x) < 0) *x = surface_at(body, *x, n);
}

/// Corrects x and v for all bodies, in list order and repeatedly; returns whether x is still inside one.
INLINE int collide_at_end(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3* x,
                          BODY_REAL3* v) {
  for (int pass = 0; pass < passes; ++pass) {
    int touched = 0;
    for (int n = 0; n < count; ++n) {
      const BODY_REAL depth = -gap_at(bodies + n, *x);
      // From the second pass on, what rounding leaves is accepted; the first must see every contact.
      if (!(depth > 0) || (pass > 0 && depth <= tolerance_at(bodies + n, *x, rule.epsilon))) continue;
      collide_one(bodies + n, rule, old, x, v);
      touched = 1;
    }
    if (!touched) return 0;
  }
  int inside = 0;
  for (int n = 0; n < count; ++n) inside |= -gap_at(bodies + n, *x) > tolerance_at(bodies + n, *x, rule.epsilon);
  return inside;
}

// ---- Contact when it happens ----------------------------------------------------------------------------------------

enum { most_events = 8 };  // of a particle in a step

INLINE BODY_REAL3 on_path(Path path, BODY_REAL t) { return path.p + t * (path.u + (t / 2) * path.a); }

/// When the path comes within `tolerance` of the body, s: 0 where it begins there, -1 where it does not until `end`.
INLINE BODY_REAL first_touch(global const Body* body, Path path, BODY_REAL end, BODY_REAL tolerance) {
  const BODY_REAL3 last = path.u + end * path.a;
  const BODY_REAL fastest = sqrt(fmax(dot(path.u, path.u), dot(last, last)));
  BODY_REAL t = 0, gap = gap_at(body, path.p);
  if (gap <= tolerance) return 0;
  if (!(fastest > 0)) return -1;
  // Marching by the distance that nothing can cover faster cannot miss the surface; Newton's method then ends near it,
  // from outside where the distance is convex along the path.
  for (int n = 0; n < 12 && gap > tolerance && !is_plane(body); ++n) {
    t += gap / fastest;
    if (!(t < end)) return gap_at(body, on_path(path, end)) <= tolerance ? end : (BODY_REAL)(-1);
    gap = gap_at(body, on_path(path, t));
  }
  const BODY_REAL near = fmax(tolerance, 1e-11f * fastest * end);
  for (int n = 0; n < 24 && fabs(gap) > near; ++n) {
    const BODY_REAL3 x = on_path(path, t);
    const BODY_REAL rate = dot(path.u + t * path.a, normal_at(body, x));
    // A root of the distance's parabola, which a plane's distance is: Newton's step would fail at its top.
    const BODY_REAL bend = dot(path.a, normal_at(body, x)), square = rate * rate - 2 * bend * gap;
    const BODY_REAL step = is_plane(body) && square >= 0 ? 2 * gap / (sqrt(square) - rate) : -gap / rate;
    if (!(fabs(step) <= end)) break;
    t = fmin(fmax(t + step, (BODY_REAL)(0)), end);
    gap = gap_at(body, on_path(path, t));
  }
  // What is left of a path that only grazes the body, or ends on it.
  return gap <= near ? t : gap_at(body, on_path(path, end)) <= tolerance ? end : (BODY_REAL)(-1);
}

/// A particle in a step: where it would end, and on what path from the last event on.
typedef struct {
  Path path;
  BODY_REAL left;  // s, until the end of the step
  BODY_REAL3 x, v;  // at the end of the step; v is the velocity at that time, not the stored one
} Flight;

/// A vector in the tangent plane at n as it is in the one at m, as long as before.
INLINE BODY_REAL3 transported(BODY_REAL3 t, BODY_REAL3 n, BODY_REAL3 m) {
  return t - (dot(t, m) / (1 + dot(n, m))) * (n + m);
}

/// An impact: the normal velocity is reversed with restitution e, the tangential one shortened (Coulomb).
INLINE void bounce(global const Body* body, BODY_REAL3 n, Flight* f) {
  const BODY_REAL inward = -dot(f->path.u, n), change = (1 + body->restitution) * inward;
  const BODY_REAL3 tangential = f->path.u + inward * n;
  const BODY_REAL speed = sqrt(dot(tangential, tangential));
  const BODY_REAL lost = speed > 0 ? fmin((BODY_REAL)(1), body->friction * change / speed) : (BODY_REAL)(0);
  const BODY_REAL3 dv = change * n - lost * tangential;
  f->path.u += dv;
  f->v += dv;
  f->x += f->left * dv;
}

/// What friction leaves of a motion along a surface in `left` s: from `begin`, with the acceleration a, it would take
/// `most` m/s at most, and slows by `slows` m/s² at first. Returns the velocity at the end; `moved`: the way.
INLINE BODY_REAL3 rubbed(BODY_REAL3 begin, BODY_REAL3 a, BODY_REAL left, BODY_REAL most, BODY_REAL slows,
                         BODY_REAL3* moved) {
  const BODY_REAL3 freely = begin + left * a, middle = begin + (left / 2) * a;
  const BODY_REAL mean = sqrt(dot(middle, middle)), speed = sqrt(dot(begin, begin));
  if (sqrt(dot(freely, freely)) > most && mean > 0) {
    const BODY_REAL3 end = freely - (most / mean) * middle;
    *moved = (left / 2) * (begin + end);
    return end;
  }
  // It stops after u²/(2 f), and friction holds it there.
  const BODY_REAL slowed = speed > 0 ? slows - dot(a, begin) / speed : (BODY_REAL)(0);
  *moved = ((slowed > 0 ? fmin(speed / slowed, left) : left) / 2) * begin;
  return VECTOR(0, 0, 0);
}

/// The rest of the step on the body, which presses with `press` m/s²: it slides, or sticks where friction holds it.
INLINE void slide(global const Body* body, BODY_REAL3 n, BODY_REAL press, Flight* f) {
  const BODY_REAL left = f->left, outward = dot(f->path.u, n);
  const BODY_REAL3 u = f->path.u - outward * n;
  BODY_REAL3 a = f->path.a - dot(f->path.a, n) * n;
  // The normal velocity that the body takes from now on, of which the impact takes the first part.
  const BODY_REAL all = fmax((BODY_REAL)(0), -dot(f->v, n) - left * turn_at(body, n, u));
  const BODY_REAL impact = fmin(fmax(-outward, (BODY_REAL)(0)), all), speed = sqrt(dot(u, u));
  const BODY_REAL kept = speed > 0 ? fmax((BODY_REAL)(0), 1 - body->friction * impact / speed) : (BODY_REAL)(0);
  const BODY_REAL3 begin = kept * u, there = on_path(f->path, left);
  BODY_REAL pressed = all - impact;
  BODY_REAL3 moved, end = rubbed(begin, a, left, body->friction * pressed, body->friction * press, &moved), m = n;
  if (!is_plane(body)) {
    // Once more with the means of both ends, between which the surface turns.
    m = normal_at(body, f->x + moved + (f->path.p - there));
    const BODY_REAL3 along = f->path.a - dot(f->path.a, m) * m;
    const BODY_REAL press_then = -dot(f->path.a, m) - turn_at(body, m, transported(end, n, m));
    a = (BODY_REAL)(0.5f) * (a + transported(along, m, n));
    pressed = fmax((BODY_REAL)(0), pressed + (left / 2) * (press_then - press));
    end = rubbed(begin, a, left, body->friction * pressed, body->friction * press, &moved);
  }
  f->x += moved + (f->path.p - there);
  f->v += end - f->path.u - left * f->path.a;
  // Onto the surface, with a velocity along it.
  if (!is_plane(body)) m = normal_at(body, f->x);
  f->x = surface_at(body, f->x, n);
  f->v -= dot(f->v, n) * n;
  if (!is_plane(body)) f->v = transported(f->v, n, m);
  f->path.u = begin;
  f->path.a = left > 0 ? (end - begin) / left : VECTOR(0, 0, 0);
}

/// What the first body on the path does, and when. Returns its number, or -1 where none is met; `last` was met before.
INLINE int meet_next(global const Body* bodies, int count, ContactRule rule, int last, Flight* f) {
  int hit = -1;
  BODY_REAL soonest = f->left;
  for (int n = 0; n < count; ++n) {
    global const Body* body = bodies + n;
    const BODY_REAL tolerance = tolerance_at(body, f->path.p, rule.epsilon);
    if (n == last || !crosses(body, f->path.p, f->x, tolerance)) continue;
    const BODY_REAL t = first_touch(body, f->path, f->left, tolerance);
    if (t >= 0 && (hit < 0 || t < soonest)) hit = n, soonest = t;
  }
  if (hit < 0) return -1;
  global const Body* body = bodies + hit;
  const BODY_REAL3 at = on_path(f->path, soonest), n = normal_at(body, at);
  const int buried = soonest == 0 && gap_at(body, at) < -tolerance_at(body, at, rule.epsilon);
  f->path.p = at;
  f->path.u += soonest * f->path.a;
  f->left -= soonest;
  if (buried) {  // the body was moved, a bad start: out, without an impact, unless it gets out by itself
    if (gap_at(body, f->x) > 0) return hit;
    f->x = way_out(body, f->x, n);
    f->v -= fmin((BODY_REAL)(0), dot(f->v, n)) * n;
    return hit;
  }
  // The next flight would last 2 e u_n/press; one that ends within a step is none.
  const BODY_REAL outward = dot(f->path.u, n), press = -dot(f->path.a, n) - turn_at(body, n, f->path.u);
  const BODY_REAL leaves = outward > 0 ? outward : -body->restitution * outward;
  if (press > 0 && 2 * leaves <= 1.0001f * press * rule.dt)
    slide(body, n, press, f);
  else if (outward < 0)
    bounce(body, n, f);
  return hit;
}

/// Takes a particle through a step in which it may meet bodies. `old`: where it was; `v_before`: its stored velocity
/// before the step's last sweep; x, v: where the step would end without bodies, and where it ends with them. Returns
/// whether x is still inside a body.
INLINE int collide_on_path(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3 v_before,
                           BODY_REAL3* x, BODY_REAL3* v) {
  const BODY_REAL3 a = (*v - v_before) / (rule.kick * rule.dt), lagging = (rule.lag * rule.dt) * a;
  Flight f = {{old, *v + ((rule.share - 1.5f) * rule.dt) * a, a}, rule.dt, *x, *v + lagging};
  for (int event = 0, last = -1; event < most_events; ++event) {
    last = meet_next(bodies, count, rule, last, &f);
    if (last < 0) break;
  }
  // A wedge, or more events than were followed: out, without an impact.
  for (int pass = 0, touched = 1; pass < passes && touched; ++pass) {
    touched = 0;
    for (int n = 0; n < count; ++n) {
      const BODY_REAL gap = gap_at(bodies + n, f.x);
      if (!(gap < 0) || (pass > 0 && -gap <= tolerance_at(bodies + n, f.x, rule.epsilon))) continue;
      const BODY_REAL3 normal = normal_at(bodies + n, f.x);
      f.x = surface_at(bodies + n, f.x, normal);
      f.v -= fmin((BODY_REAL)(0), dot(f.v, normal)) * normal;
      touched = 1;
    }
  }
  *x = f.x;
  *v = f.v - lagging;
  int inside = 0;
  for (int n = 0; n < count; ++n) inside |= -gap_at(bodies + n, f.x) > tolerance_at(bodies + n, f.x, rule.epsilon);
  return inside;
}

/// Whether the step from `old` to x meets a body.
INLINE int meets(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3 x) {
  int any = 0;
  for (int n = 0; n < count; ++n)
    any |= rule.at_ends ? gap_at(bodies + n, x) < 0
                        : crosses(bodies + n, old, x, tolerance_at(bodies + n, x, rule.epsilon));
  return any;
}

/// Takes a particle that meets bodies through a step, by the rule.
INLINE int collide(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3 v_before,
                   BODY_REAL3* x, BODY_REAL3* v) {
  return rule.at_ends ? collide_at_end(bodies, count, rule, old, x, v)
                      : collide_on_path(bodies, count, rule, old, v_before, x, v);
}

#endif
