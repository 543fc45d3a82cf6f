// What bodies do to one particle in a step (2.1.5; docs/model.md, "Collision"). Both engines compile this file: the
// kernels after body.cl, the CPU engine in core/forces/contact.cpp. Whoever includes it has defined INLINE, BODY_REAL,
// BODY_REAL3, VECTOR(x, y, z) and Body, whose fields are those of PlacedBody in core/forces/contact.h.
//
// Times are those since the step began, and positions those in the world. A shape is what is said of it between the
// lines below: its distance, normal, curvature and nearest point, in its own frame, where it rests at the origin.

#ifdef BODIES

#define vector_of(v) VECTOR((v)[0], (v)[1], (v)[2])

/// How a step of the method moves a particle whose acceleration is constant, and what else contacts ask for.
typedef struct {
  BODY_REAL dt;       // s
  BODY_REAL epsilon;  // of the precision of the state
  BODY_REAL g;        // m/s²
  BODY_REAL share;    // x_1 = x_0 + dt (v + share dt a), v being the stored velocity before the step
  BODY_REAL kick;     // what the step's last sweep adds to the stored velocity, divided by dt a
  BODY_REAL lag;      // the stored velocity is that of lag dt ago
  int at_ends;        // the report's rule: contact is seen at the ends of steps alone
  int upright;        // the particle moves along y alone: the mass on a spring
} ContactRule;

/// A path with constant acceleration: position, velocity, acceleration.
typedef struct {
  BODY_REAL3 p, u, a;
} Path;

// ---- Shapes, each in its own frame ----------------------------------------------------------------------------------

/// As Body::Shape in core/model/preset.h. The axis of capsules and cylinders is y, a plane is y = 0.
enum { sphere_shape, plane_shape, box_shape, capsule_shape, cylinder_shape };

/// The point of a capsule's axis that is nearest to q; of a sphere its center.
INLINE BODY_REAL3 on_axis(global const Body* body, BODY_REAL3 q) {
  return VECTOR(0, body->shape == capsule_shape ? fmin(fmax(q.y, -body->size[1]), body->size[1]) : (BODY_REAL)(0), 0);
}

/// By how much q is beyond the faces of a box, or the side (x) and the ends (y) of a cylinder, m; negative inside.
INLINE BODY_REAL3 beyond_faces(global const Body* body, BODY_REAL3 q) {
  if (body->shape == cylinder_shape)
    return VECTOR(sqrt(q.x * q.x + q.z * q.z) - body->size[0], fabs(q.y) - body->size[1], -body->size[1]);
  return VECTOR(fabs(q.x) - body->size[0], fabs(q.y) - body->size[1], fabs(q.z) - body->size[2]);
}

/// Distance from the surface, m; negative inside.
INLINE BODY_REAL shape_gap(global const Body* body, BODY_REAL3 q) {
  if (body->shape == plane_shape) return q.y;
  if (body->shape == sphere_shape) return sqrt(dot(q, q)) - body->size[0];
  if (body->shape == capsule_shape) {
    const BODY_REAL3 out = q - on_axis(body, q);
    return sqrt(dot(out, out)) - body->size[0];
  }
  const BODY_REAL3 d = beyond_faces(body, q);
  const BODY_REAL3 out = VECTOR(fmax(d.x, (BODY_REAL)(0)), fmax(d.y, (BODY_REAL)(0)), fmax(d.z, (BODY_REAL)(0)));
  return sqrt(dot(out, out)) + fmin(fmax(fmax(d.x, d.y), d.z), (BODY_REAL)(0));
}

/// The direction in which that part of a distance grows: of beyond_faces' x, y and z.
INLINE BODY_REAL3 of_faces(global const Body* body, BODY_REAL3 q, BODY_REAL3 part) {
  const BODY_REAL y = q.y < 0 ? -part.y : part.y;
  if (body->shape != cylinder_shape) return VECTOR(q.x < 0 ? -part.x : part.x, y, q.z < 0 ? -part.z : part.z);
  const BODY_REAL across = sqrt(q.x * q.x + q.z * q.z);
  return across > 0 ? VECTOR(part.x * q.x / across, y, part.x * q.z / across) : VECTOR(part.x, y, 0);
}

/// Unit normal of the surface seen from q; +y at the center of a sphere, +x on the axis of a capsule.
INLINE BODY_REAL3 shape_normal(global const Body* body, BODY_REAL3 q) {
  if (body->shape == plane_shape) return VECTOR(0, 1, 0);
  if (body->shape == sphere_shape || body->shape == capsule_shape) {
    const BODY_REAL3 out = q - on_axis(body, q);
    const BODY_REAL length = sqrt(dot(out, out));
    if (length > 0) return out / length;
    return body->shape == sphere_shape ? VECTOR(0, 1, 0) : VECTOR(1, 0, 0);
  }
  const BODY_REAL3 d = beyond_faces(body, q);
  const BODY_REAL3 out = VECTOR(fmax(d.x, (BODY_REAL)(0)), fmax(d.y, (BODY_REAL)(0)), fmax(d.z, (BODY_REAL)(0)));
  const BODY_REAL length = sqrt(dot(out, out));
  if (length > 0) return of_faces(body, q, out / length);
  return of_faces(body, q, d.y >= d.x && d.y >= d.z ? VECTOR(0, 1, 0) : d.x >= d.z ? VECTOR(1, 0, 0) : VECTOR(0, 0, 1));
}

/// The point of the surface that is nearest to q; at a sphere's center in the direction n.
INLINE BODY_REAL3 shape_surface(global const Body* body, BODY_REAL3 q, BODY_REAL3 n) {
  if (body->shape == plane_shape) return VECTOR(q.x, 0, q.z);
  if (body->shape == sphere_shape) return body->size[0] * (dot(q, q) > 0 ? shape_normal(body, q) : n);
  if (body->shape == capsule_shape) return on_axis(body, q) + body->size[0] * shape_normal(body, q);
  const BODY_REAL3 m = shape_normal(body, q), d = beyond_faces(body, q);
  const BODY_REAL gap = shape_gap(body, q);
  // Onto flat faces exactly: what lies on one does not hover above it.
  BODY_REAL3 s = q - gap * m;
  if (d.y >= 0 || fabs(m.y) == 1) s.y = q.y < 0 ? -body->size[1] : body->size[1];
  if (body->shape != box_shape) return s;
  if (d.x >= 0 || fabs(m.x) == 1) s.x = q.x < 0 ? -body->size[0] : body->size[0];
  if (d.z >= 0 || fabs(m.z) == 1) s.z = q.z < 0 ? -body->size[2] : body->size[2];
  return s;
}

/// Whether the surface turns below a particle that slides on it where its normal is n.
INLINE int shape_curved(global const Body* body, BODY_REAL3 n) {
  if (body->shape == cylinder_shape) return fabs(n.y) < 0.5f;
  return body->shape == sphere_shape || body->shape == capsule_shape;
}

/// Whether q is beyond the edge of the face whose normal is n.
INLINE int beyond_edge(global const Body* body, BODY_REAL3 q, BODY_REAL3 n) {
  if (body->shape != box_shape && body->shape != cylinder_shape) return 0;
  const BODY_REAL3 d = beyond_faces(body, q);
  const int on_x = body->shape == box_shape ? fabs(n.x) > 0.5f : fabs(n.y) < 0.5f;
  return (d.x > 0 && !on_x) || (d.y > 0 && !(fabs(n.y) > 0.5f)) || (d.z > 0 && !(fabs(n.z) > 0.5f));
}

/// What the second derivative of the distance has beside that of the path: a particle that moves straight on at u leaves
/// a curved surface, 1/s².
INLINE BODY_REAL shape_turn(global const Body* body, BODY_REAL3 q, BODY_REAL3 n, BODY_REAL3 u) {
  if (!shape_curved(body, n)) return 0;
  const int round = body->shape == sphere_shape || fabs(q.y) > body->size[1];
  const BODY_REAL inward = dot(u, n), along = round ? (BODY_REAL)(0) : u.y;
  return (dot(u, u) - inward * inward - along * along) / body->size[0];
}

// ---- Bodies in the world: placed, and perhaps moving ----------------------------------------------------------------

/// The vector turned about the axis of `spin` (rad/s) for that time.
INLINE BODY_REAL3 turned(BODY_REAL3 v, BODY_REAL3 spin, BODY_REAL time) {
  const BODY_REAL rate = sqrt(dot(spin, spin));
  if (!(rate > 0)) return v;
  const BODY_REAL3 axis = spin / rate;
  const BODY_REAL c = cos(rate * time), s = sin(rate * time);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

INLINE BODY_REAL3 center_at(global const Body* body, BODY_REAL time) {
  const BODY_REAL3 c = vector_of(body->c);
  return body->moves ? c + time * vector_of(body->velocity) : c;
}

/// A direction of the world in the body's frame, and back.
INLINE BODY_REAL3 into(global const Body* body, BODY_REAL3 d, BODY_REAL time) {
  if (body->spins) d = turned(d, vector_of(body->spin), -time);
  if (!body->turns) return d;
  return VECTOR(dot(vector_of(body->axes), d), dot(vector_of(body->axes + 3), d), dot(vector_of(body->axes + 6), d));
}
INLINE BODY_REAL3 out_of(global const Body* body, BODY_REAL3 d, BODY_REAL time) {
  if (body->turns) d = d.x * vector_of(body->axes) + d.y * vector_of(body->axes + 3) + d.z * vector_of(body->axes + 6);
  return body->spins ? turned(d, vector_of(body->spin), time) : d;
}
INLINE BODY_REAL3 local_at(global const Body* body, BODY_REAL3 x, BODY_REAL time) {
  return into(body, x - center_at(body, time), time);
}

/// Distance from the surface, m; negative inside.
INLINE BODY_REAL gap_at(global const Body* body, BODY_REAL3 x, BODY_REAL time) {
  return shape_gap(body, local_at(body, x, time));
}
/// Unit normal of the surface seen from x.
INLINE BODY_REAL3 normal_at(global const Body* body, BODY_REAL3 x, BODY_REAL time) {
  return out_of(body, shape_normal(body, local_at(body, x, time)), time);
}
/// The point of the surface that is nearest to x; at a sphere's center in the direction n.
INLINE BODY_REAL3 surface_at(global const Body* body, BODY_REAL3 x, BODY_REAL3 n, BODY_REAL time) {
  if (body->shape == plane_shape && !body->turns) return VECTOR(x.x, center_at(body, time).y, x.z);
  const BODY_REAL3 q = local_at(body, x, time);
  return center_at(body, time) + out_of(body, shape_surface(body, q, into(body, n, time)), time);
}
/// shape_turn of a surface that moves no more, for a path relative to it.
INLINE BODY_REAL turn_at(global const Body* body, BODY_REAL3 x, BODY_REAL3 n, BODY_REAL3 u, BODY_REAL time) {
  return shape_turn(body, local_at(body, x, time), into(body, n, time), into(body, u, time));
}
/// Of the point of the body that is at x, m/s.
INLINE BODY_REAL3 surface_velocity(global const Body* body, BODY_REAL3 x, BODY_REAL time) {
  if (!body->moves) return VECTOR(0, 0, 0);
  return vector_of(body->velocity) + cross(vector_of(body->spin), x - center_at(body, time));
}

/// Where the line from x, inside, along n leaves a sphere; out of other shapes by the nearest way.
INLINE BODY_REAL3 way_out(global const Body* body, BODY_REAL3 x, BODY_REAL3 n, BODY_REAL time) {
  if (body->shape != sphere_shape) return surface_at(body, x, n, time);
  const BODY_REAL r = body->size[0];
  const BODY_REAL3 q = x - center_at(body, time);
  const BODY_REAL along = dot(q, n);
  return x + (sqrt(along * along - dot(q, q) + r * r) - along) * n;
}

/// 8 units in the last place of the largest of |x|, |c| and the body's size: a bound on rounding errors, m.
INLINE BODY_REAL tolerance_at(global const Body* body, BODY_REAL3 x, BODY_REAL epsilon) {
  const BODY_REAL3 c = vector_of(body->c);
  const BODY_REAL far = body->shape == plane_shape && !body->turns
                            ? fmax(fabs(x.y), fabs(c.y))
                            : fmax(fmax(sqrt(dot(x, x)), sqrt(dot(c, c))), body->extent);
  return 8 * epsilon * far;
}

/// Whether a particle that goes from one point to the other in a step of dt may meet the body: it ends inside, or its way
/// leads through.
INLINE int crosses(global const Body* body, BODY_REAL3 from, BODY_REAL begin, BODY_REAL3 to, BODY_REAL end,
                   BODY_REAL tolerance) {
  const BODY_REAL3 last = local_at(body, to, end);
  const BODY_REAL gap = shape_gap(body, last);
  if (gap < tolerance) return 1;
  if (body->shape == plane_shape) return 0;
  const BODY_REAL3 before = local_at(body, from, begin), way = last - before;
  const BODY_REAL square = dot(way, way);
  // No way that is shorter than both gaps together leads through.
  if (body->shape != sphere_shape) return gap + shape_gap(body, before) - sqrt(square) < 2 * tolerance;
  const BODY_REAL along = -dot(before, way);
  if (!(along > 0 && along < square)) return 0;
  const BODY_REAL3 nearest = before + (along / square) * way;
  return dot(nearest, nearest) < body->size[0] * body->size[0];
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
  const BODY_REAL3 n = normal_at(body, old, 0), with = surface_velocity(body, *x, rule.dt);
  if (-gap_at(body, old, 0) > tolerance_at(body, old, rule.epsilon)) {
    // It was inside already (the body was moved, a bad start): out along n, the nearest way from where it was. From a
    // sphere's center that is up, even if gravity has just moved it below.
    *x = way_out(body, *x, n, rule.dt);
    *v -= fmin((BODY_REAL)(0), dot(*v - with, n)) * n;
    return;
  }
  *v = corrected_velocity(body, rule, *v - with, n) + with;
  *x = old + rule.dt * *v;
  if (gap_at(body, *x, rule.dt) < 0) *x = surface_at(body, *x, n, rule.dt);
}

/// Whether a particle that is at x at the end of the step is inside a body.
INLINE int is_inside(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 x) {
  int inside = 0;
  for (int n = 0; n < count; ++n) inside |= -gap_at(bodies + n, x, rule.dt) > tolerance_at(bodies + n, x, rule.epsilon);
  return inside;
}

/// Corrects x and v for all bodies, in list order and repeatedly; returns whether x is still inside one.
INLINE int collide_at_end(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3* x,
                          BODY_REAL3* v) {
  for (int pass = 0; pass < passes; ++pass) {
    int touched = 0;
    for (int n = 0; n < count; ++n) {
      const BODY_REAL depth = -gap_at(bodies + n, *x, rule.dt);
      // From the second pass on, what rounding leaves is accepted; the first must see every contact.
      if (!(depth > 0) || (pass > 0 && depth <= tolerance_at(bodies + n, *x, rule.epsilon))) continue;
      collide_one(bodies + n, rule, old, x, v);
      touched = 1;
    }
    if (!touched) return 0;
  }
  return is_inside(bodies, count, rule, *x);
}

// ---- Contact when it happens ----------------------------------------------------------------------------------------

enum { most_events = 8 };  // of a particle in a step

INLINE BODY_REAL3 on_path(Path path, BODY_REAL t) { return path.p + t * (path.u + (t / 2) * path.a); }

/// No particle on the path comes nearer to a point of the body faster than that, m/s.
INLINE BODY_REAL fastest_approach(global const Body* body, Path path, BODY_REAL begin, BODY_REAL end) {
  const BODY_REAL3 last = path.u + end * path.a;
  if (!body->moves) return sqrt(fmax(dot(path.u, path.u), dot(last, last)));
  const BODY_REAL3 with = vector_of(body->velocity), spin = vector_of(body->spin), first = path.u - with;
  const BODY_REAL3 in = path.p - center_at(body, begin), out = on_path(path, end) - center_at(body, begin + end);
  const BODY_REAL straight = sqrt(fmax(dot(first, first), dot(last - with, last - with)));
  return straight + sqrt(dot(spin, spin)) * (sqrt(fmax(dot(in, in), dot(out, out))) + end * straight);
}

/// When the path, which begins at the time `begin`, comes within `tolerance` of the body, s later: 0 where it begins
/// there, -1 where it does not until `end`.
INLINE BODY_REAL first_touch(global const Body* body, Path path, BODY_REAL begin, BODY_REAL end, BODY_REAL tolerance) {
  const BODY_REAL fastest = fastest_approach(body, path, begin, end);
  const int flat = body->shape == plane_shape && !body->spins;
  BODY_REAL t = 0, gap = gap_at(body, path.p, begin);
  if (gap <= tolerance) return 0;
  if (!(fastest > 0)) return -1;
  // Marching by the distance that nothing can cover faster cannot miss the surface; Newton's method then ends near it,
  // from outside where the distance is convex along the path.
  for (int n = 0; n < 12 && gap > tolerance && !flat; ++n) {
    t += gap / fastest;
    if (!(t < end)) return gap_at(body, on_path(path, end), begin + end) <= tolerance ? end : (BODY_REAL)(-1);
    gap = gap_at(body, on_path(path, t), begin + t);
  }
  const BODY_REAL near = fmax(tolerance, 1e-11f * fastest * end);
  for (int n = 0; n < 24 && fabs(gap) > near; ++n) {
    const BODY_REAL3 x = on_path(path, t), normal = normal_at(body, x, begin + t);
    const BODY_REAL rate = dot(path.u + t * path.a - surface_velocity(body, x, begin + t), normal);
    // A root of the distance's parabola, which a plane's distance is: Newton's step would fail at its top.
    const BODY_REAL bend = dot(path.a, normal), square = rate * rate - 2 * bend * gap;
    const BODY_REAL step = flat && square >= 0 ? 2 * gap / (sqrt(square) - rate) : -gap / rate;
    if (!(fabs(step) <= end)) break;
    t = fmin(fmax(t + step, (BODY_REAL)(0)), end);
    gap = gap_at(body, on_path(path, t), begin + t);
  }
  // What is left of a path that only grazes the body, or ends on it.
  return gap <= near ? t : gap_at(body, on_path(path, end), begin + end) <= tolerance ? end : (BODY_REAL)(-1);
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

/// An impact at u relative to the body: the normal velocity is reversed with restitution e, the tangential one
/// shortened (Coulomb).
INLINE void bounce(global const Body* body, BODY_REAL3 n, BODY_REAL3 u, Flight* f) {
  const BODY_REAL inward = -dot(u, n), change = (1 + body->restitution) * inward;
  const BODY_REAL3 tangential = u + inward * n;
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

/// The flight from that time on as seen by who rides on the body, for whom it rests as it is at that time.
INLINE void mount(global const Body* body, BODY_REAL time, Flight* f) {
  const BODY_REAL3 velocity = vector_of(body->velocity), spin = vector_of(body->spin);
  const BODY_REAL3 c = center_at(body, time), arm = f->path.p - c, reached = f->x - c - f->left * velocity;
  f->path.u -= velocity + cross(spin, arm);
  f->path.a -= (BODY_REAL)(2) * cross(spin, f->path.u) + cross(spin, cross(spin, arm));
  f->v = turned(f->v - velocity - cross(spin, reached), spin, -f->left);
  f->x = c + turned(reached, spin, -f->left);
}

/// The flight as the world sees it, again.
INLINE void dismount(global const Body* body, BODY_REAL time, Flight* f) {
  const BODY_REAL3 velocity = vector_of(body->velocity), spin = vector_of(body->spin);
  const BODY_REAL3 c = center_at(body, time), arm = f->path.p - c, reached = turned(f->x - c, spin, f->left);
  f->path.a += (BODY_REAL)(2) * cross(spin, f->path.u) + cross(spin, cross(spin, arm));
  f->path.u += velocity + cross(spin, arm);
  f->v = turned(f->v, spin, f->left) + velocity + cross(spin, reached);
  f->x = c + reached + f->left * velocity;
}

/// The rest of the step on a body at rest, as it is at that time, which presses with `press` m/s²: it slides, or sticks
/// where friction holds it.
INLINE void slide(global const Body* body, BODY_REAL3 n, BODY_REAL press, BODY_REAL time, Flight* f) {
  const BODY_REAL left = f->left, outward = dot(f->path.u, n);
  const BODY_REAL3 u = f->path.u - outward * n;
  BODY_REAL3 a = f->path.a - dot(f->path.a, n) * n;
  // The normal velocity that the body takes from now on, of which the impact takes the first part.
  const BODY_REAL all = fmax((BODY_REAL)(0), -dot(f->v, n) - left * turn_at(body, f->path.p, n, u, time));
  const BODY_REAL impact = fmin(fmax(-outward, (BODY_REAL)(0)), all), speed = sqrt(dot(u, u));
  const BODY_REAL kept = speed > 0 ? fmax((BODY_REAL)(0), 1 - body->friction * impact / speed) : (BODY_REAL)(0);
  const BODY_REAL3 begin = kept * u, there = on_path(f->path, left);
  // Seen from a body that turns, Coriolis forces follow what the body changes in the velocity: impacts at once, the rest
  // little by little.
  const BODY_REAL3 spin = vector_of(body->spin);
  const BODY_REAL3 turning = -cross(spin, (all + impact) * n + (BODY_REAL)(2) * (begin - u));
  a += turning - dot(turning, n) * n;
  BODY_REAL pressed = fmax((BODY_REAL)(0), all - impact - left * dot(turning, n));
  BODY_REAL3 moved, end = rubbed(begin, a, left, body->friction * pressed, body->friction * press, &moved), m = n;
  const BODY_REAL3 face = into(body, n, time), reached = f->x + moved + (f->path.p - there);
  const int off = beyond_edge(body, local_at(body, reached, time), face), bends = shape_curved(body, face) && !off;
  if (bends || body->moves) {
    // Once more with the means of both ends, between which the surface turns, and with the friction's Coriolis force.
    const BODY_REAL3 rubbing = dot(end, end) > 0 ? -cross(spin, end - begin - left * a) : VECTOR(0, 0, 0);
    if (bends) {
      m = normal_at(body, reached, time);
      const BODY_REAL3 along = f->path.a - dot(f->path.a, m) * m + turning - dot(turning, n) * n;
      const BODY_REAL press_then = -dot(f->path.a, m) - turn_at(body, reached, m, transported(end, n, m), time);
      a = (BODY_REAL)(0.5f) * (a + transported(along, m, n));
      pressed += (left / 2) * (press_then - press);
    }
    a += rubbing - dot(rubbing, n) * n;
    pressed = fmax((BODY_REAL)(0), pressed - left * dot(rubbing, n));
    end = rubbed(begin, a, left, body->friction * pressed, body->friction * press, &moved);
  }
  f->x += moved + (f->path.p - there);
  f->v += end - f->path.u - left * f->path.a;
  // Onto the surface, unless it has slid over an edge, with a velocity along it.
  if (bends) m = normal_at(body, f->x, time);
  if (!off) f->x = surface_at(body, f->x, n, time);
  f->v -= dot(f->v, n) * n;
  if (bends) f->v = transported(f->v, n, m);
  f->path.u = begin;
  f->path.a = left > 0 ? (end - begin) / left : VECTOR(0, 0, 0);
}

/// Whether what has met a body, at that speed away from it, rests there: the next flight would last 2 e u_n/press, and one
/// that ends within a step is none.
INLINE int rests(global const Body* body, BODY_REAL outward, BODY_REAL press, BODY_REAL dt) {
  const BODY_REAL leaves = outward > 0 ? outward : -body->restitution * outward;
  return press > 0 && 2 * leaves <= 1.0001f * press * dt;
}

/// What the first body on the path does, and when. Returns its number, or -1 where none is met; `last` was met before.
INLINE int meet_next(global const Body* bodies, int count, ContactRule rule, int last, Flight* f) {
  int hit = -1;
  const BODY_REAL begin = rule.dt - f->left;
  BODY_REAL soonest = f->left;
  for (int n = 0; n < count; ++n) {
    global const Body* body = bodies + n;
    const BODY_REAL tolerance = tolerance_at(body, f->path.p, rule.epsilon);
    if (n == last || !crosses(body, f->path.p, begin, f->x, rule.dt, tolerance)) continue;
    BODY_REAL t = first_touch(body, f->path, begin, f->left, tolerance);
    // The step itself may end a little deeper than the path.
    if (t < 0 && gap_at(body, f->x, rule.dt) < 0) t = f->left;
    if (t >= 0 && (hit < 0 || t < soonest)) hit = n, soonest = t;
  }
  if (hit < 0) return -1;
  global const Body* body = bodies + hit;
  const BODY_REAL now = begin + soonest;
  const BODY_REAL3 at = on_path(f->path, soonest), n = normal_at(body, at, now);
  const int buried = soonest == 0 && gap_at(body, at, now) < -tolerance_at(body, at, rule.epsilon);
  f->path.p = at;
  f->path.u += soonest * f->path.a;
  f->left -= soonest;
  if (buried) {  // the body was moved, a bad start: out, without an impact, unless it gets out by itself
    if (gap_at(body, f->x, rule.dt) > 0) return hit;
    f->x = way_out(body, f->x, n, rule.dt);
    f->v -= fmin((BODY_REAL)(0), dot(f->v - surface_velocity(body, f->x, rule.dt), n)) * n;
    return hit;
  }
  const Flight seen = *f;
  if (body->moves) mount(body, now, f);
  const BODY_REAL3 u = f->path.u;
  const BODY_REAL outward = dot(u, n), press = -dot(f->path.a, n) - turn_at(body, at, n, u, now);
  if (rests(body, outward, press, rule.dt)) {
    slide(body, n, press, now, f);
    if (body->moves) dismount(body, now, f);
    return hit;
  }
  if (body->moves) *f = seen;
  if (outward < 0) bounce(body, n, u, f);
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
      const BODY_REAL gap = gap_at(bodies + n, f.x, rule.dt);
      if (!(gap < 0) || (pass > 0 && -gap <= tolerance_at(bodies + n, f.x, rule.epsilon))) continue;
      const BODY_REAL3 normal = normal_at(bodies + n, f.x, rule.dt);
      const BODY_REAL3 with = surface_velocity(bodies + n, f.x, rule.dt);
      f.x = surface_at(bodies + n, f.x, normal, rule.dt);
      f.v -= fmin((BODY_REAL)(0), dot(f.v - with, normal)) * normal;
      touched = 1;
    }
  }
  *x = f.x;
  *v = f.v - lagging;
  return is_inside(bodies, count, rule, f.x);
}

/// Whether the step from `old` to x meets a body.
INLINE int meets(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3 x) {
  int any = 0;
  for (int n = 0; n < count; ++n)
    any |= rule.at_ends ? gap_at(bodies + n, x, rule.dt) < 0
                        : crosses(bodies + n, old, 0, x, rule.dt, tolerance_at(bodies + n, x, rule.epsilon));
  return any;
}

/// Takes a particle that meets bodies through a step, by the rule.
INLINE int collide(global const Body* bodies, int count, ContactRule rule, BODY_REAL3 old, BODY_REAL3 v_before,
                   BODY_REAL3* x, BODY_REAL3* v) {
  const int left = rule.at_ends ? collide_at_end(bodies, count, rule, old, x, v)
                                : collide_on_path(bodies, count, rule, old, v_before, x, v);
  if (!rule.upright) return left;
  *x = VECTOR(old.x, x->y, old.z);
  *v = VECTOR(0, v->y, 0);
  return is_inside(bodies, count, rule, *x);
}

#endif
