#include "core/forces/contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

namespace tyglab {
namespace contact {
namespace {

using Body = PlacedBody;
using glm::cross, glm::dot, std::cos, std::fabs, std::fmax, std::fmin, std::sin, std::sqrt;

#define BODIES
#define global
#define INLINE [[gnu::always_inline]] inline
#define BODY_REAL double
#define BODY_REAL3 glm::dvec3
#define VECTOR(x, y, z) glm::dvec3(x, y, z)
#include "kernels/contact.cl"
#undef VECTOR
#undef BODY_REAL3
#undef BODY_REAL
#undef INLINE
#undef global
#undef BODIES

ContactRule rule_of(const Contacts& of) {
  return {of.dt, of.epsilon, of.g, of.shape.position, of.shape.last_kick, of.lag, of.at_ends, of.upright};
}

}  // namespace
}  // namespace contact

namespace {

glm::dvec3 center_at(const Body& body, double t) {
  if (body.path.empty())
    return (body.shape == Body::Shape::plane ? glm::dvec3(0, body.y, 0) : body.c) + t * body.velocity;
  return on_path(body.path, t);
}

void store(const glm::dvec3& from, double* to) {
  for (int c = 0; c < 3; ++c) to[c] = from[c];
}

/// The body at time t, s, as if it rested there.
PlacedBody placed_at(const Body& body, double t) {
  using Shape = Body::Shape;
  PlacedBody at{};
  store(center_at(body, t), at.c);
  // Turned about x, y and z in that order, then by what it has spun.
  glm::dquat turn = glm::identity<glm::dquat>();
  for (int n = 0; n < 3; ++n) {
    glm::dvec3 axis{0};
    axis[n] = 1;
    if (body.turn[n] != 0) turn = glm::angleAxis(glm::radians(body.turn[n]), axis) * turn;
  }
  if (const double rate = glm::length(body.spin); rate > 0) turn = glm::angleAxis(rate * t, body.spin / rate) * turn;
  const bool turns = body.turn != glm::dvec3(0) || body.spin != glm::dvec3(0);
  const glm::dmat3 axes = glm::mat3_cast(turn);
  for (int n = 0; n < 3; ++n) store(axes[n], at.axes + 3 * n);
  const bool box = body.shape == Shape::box;
  store(box ? body.size / 2.0 : glm::dvec3(body.r, body.length / 2, 0), at.size);
  at.extent = box                             ? glm::length(body.size) / 2
              : body.shape == Shape::capsule  ? body.r + body.length / 2
              : body.shape == Shape::cylinder ? std::hypot(body.r, body.length / 2)
              : body.shape == Shape::sphere   ? body.r
                                              : 0;
  at.friction = body.friction, at.restitution = body.restitution;
  at.shape = std::int32_t(body.shape);
  at.turns = turns && body.shape != Shape::sphere;
  return at;
}

/// Whether the spin turns the surface into itself.
bool is_round(Body::Shape shape, const PlacedBody& body, const glm::dvec3& spin) {
  constexpr double rounding = 1e-12;
  if (spin == glm::dvec3(0) || shape == Body::Shape::sphere) return true;
  const glm::dvec3 axis(body.axes[3], body.axes[4], body.axes[5]);
  return shape != Body::Shape::box && glm::length(glm::cross(axis, spin)) < rounding * glm::length(spin);
}

/// BodyAt::reach. What positions may lack by rounding is added.
double reach_of(const PlacedBody& body, double dt, double epsilon) {
  const double way = dt * std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]);
  const glm::dvec3 c(body.c[0], body.c[1], body.c[2]), up(body.axes[3], body.axes[4], body.axes[5]);
  if (body.shape != std::int32_t(Body::Shape::plane)) return body.extent + way + contact_tolerance(body, c, epsilon);
  if (!body.turns) return c.y + way + contact_tolerance(body, c, 2 * epsilon);
  constexpr double farthest = 1e4;  // m, of what is simulated
  return body.spins ? std::numeric_limits<double>::infinity() : glm::dot(up, c) + way + 8 * epsilon * farthest;
}

}  // namespace

std::vector<PlacedBody> placed_bodies(std::span<const Body> bodies, double t, double dt, double epsilon) {
  std::vector<PlacedBody> all;
  place_bodies(bodies, t, dt, epsilon, all);
  return all;
}

void place_bodies(std::span<const Body> bodies, double t, double dt, double epsilon, std::vector<PlacedBody>& all) {
  assert(dt > 0);
  all.clear();
  all.reserve(bodies.size());
  for (const Body& body : bodies) {
    all.push_back(placed_at(body, t));
    const glm::dvec3 velocity = (center_at(body, t + dt) - center_at(body, t)) / dt;
    store(body.path.empty() ? body.velocity : velocity, all.back().velocity);
    store(body.spin, all.back().spin);
    all.back().moves = body.spin != glm::dvec3(0) || velocity != glm::dvec3(0);
    all.back().spins = !is_round(body.shape, all.back(), body.spin);
    all.back().reach = reach_of(all.back(), dt, epsilon);
  }
}

PlacedBody placed(const Body& body) {
  return placed_at(body, 0);
}

Body body_at(const Body& body, double t) {
  if (!any_moves({&body, 1}) && body.path.empty()) return body;
  Body at = body;
  at.c = center_at(body, t);
  at.velocity = at.spin = glm::dvec3(0), at.path.clear();
  if (body.shape == Body::Shape::plane) at.y = at.c.y;
  if (body.spin == glm::dvec3(0)) return at;
  // The angles about x, y and z, in that order, that lead to its axes.
  const PlacedBody placed = placed_at(body, t);
  const double *x = placed.axes, *y = x + 3, *z = y + 3;
  const double flat = std::hypot(x[0], x[1]);
  at.turn =
      glm::degrees(flat > 1e-9 ? glm::dvec3(std::atan2(y[2], z[2]), std::atan2(-x[2], flat), std::atan2(x[1], x[0]))
                               : glm::dvec3(std::atan2(-z[1], y[1]), std::atan2(-x[2], flat), 0));
  return at;
}

bool any_moves(std::span<const Body> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) {
    return body.velocity != glm::dvec3(0) || body.spin != glm::dvec3(0) || body.path.size() > 1;
  });
}

double depth(const PlacedBody& body, const glm::dvec3& x) {
  return -contact::gap_at(&body, x, 0);
}

glm::dvec3 body_normal(const PlacedBody& body, const glm::dvec3& x) {
  return contact::normal_at(&body, x, 0);
}

double contact_tolerance(const PlacedBody& body, const glm::dvec3& x, double epsilon) {
  return contact::tolerance_at(&body, x, epsilon);
}

bool held_by_contact(std::span<const PlacedBody> bodies, double dt, double epsilon, const glm::dvec3& x,
                     const glm::dvec3& v, const glm::dvec3& a) {
  const glm::dvec3 free_x = x + dt * (v + dt * a);
  return std::any_of(bodies.begin(), bodies.end(), [&](const PlacedBody& body) {
    // What rounding leaves between a resting particle and the body is no distance.
    return -contact::gap_at(&body, free_x, dt) > -contact_tolerance(body, free_x, epsilon);
  });
}

double rounding_unit(Precision precision) {
  return precision == Precision::float_ ? double(std::numeric_limits<float>::epsilon())
                                        : std::numeric_limits<double>::epsilon();
}

Contacts contacts_of(const Preset& preset, double dt, double epsilon) {
  const Scheme& method = scheme(preset.integrator);
  return {preset.contact == "step",       dt, preset.g, epsilon, step_shape(method), method.lag,
          preset.kind == Kind::one_weight};
}

bool meets_within_steps(const Preset& preset) {
  return !preset.bodies.empty() && preset.contact != "step";
}

std::optional<Impact> first_impact(std::span<const PlacedBody> bodies, double dt, double epsilon,
                                   const glm::dvec3& old_x, const glm::dvec3& old_v, const glm::dvec3& x, bool& met) {
  std::optional<Impact> first;
  const contact::Path path{old_x, old_v, 2.0 / (dt * dt) * (x - old_x - dt * old_v)};
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const PlacedBody* body = &bodies[n];
    const double tolerance = contact_tolerance(*body, old_x, epsilon);
    if (!contact::crosses(body, old_x, 0, x, dt, tolerance)) continue;
    const double t = contact::first_touch(body, path, 0, dt, tolerance);
    if (t < 0) continue;
    met = true;
    if (t == 0 || (first && first->time <= t)) continue;
    contact::Flight ridden{{contact::on_path(path, t), path.u + t * path.a, path.a}, dt - t, x, path.u + dt * path.a};
    if (body->moves) contact::mount(body, t, &ridden);
    const contact::Path& own = ridden.path;
    const glm::dvec3 normal = contact::normal_at(body, own.p, t);
    const double outward = dot(own.u, normal);
    const double press = -dot(own.a, normal) - contact::turn_at(body, own.p, normal, own.u, t);
    if (outward < 0 && !contact::rests(body, outward, press, dt)) first = Impact{int(n), t};
  }
  return first;
}

Approach approach(const PlacedBody& body, double time, const glm::dvec3& x, const glm::dvec3& v) {
  return {contact::gap_at(&body, x, time),
          -dot(v - contact::surface_velocity(&body, x, time), contact::normal_at(&body, x, time))};
}

glm::dvec3 after_impact(const PlacedBody& body, double time, const glm::dvec3& x, const glm::dvec3& v) {
  contact::Flight flight{{x, v, glm::dvec3(0)}, 0, x, v};
  contact::bounce(&body, contact::normal_at(&body, x, time), v - contact::surface_velocity(&body, x, time), &flight);
  return flight.v;
}

bool meets(std::span<const PlacedBody> bodies, const Contacts& rule, const ContactStep& step) {
  return contact::meets(bodies.data(), int(bodies.size()), contact::rule_of(rule), step.old_x, step.x) != 0;
}

bool collide(std::span<const PlacedBody> bodies, const Contacts& rule, ContactStep& step) {
  return contact::collide(bodies.data(), int(bodies.size()), contact::rule_of(rule), step.old_x, step.old_v, &step.x,
                          &step.v) == 0;
}

namespace {

constexpr double spans_in_a_period = 64;
constexpr double most_steps = 1e9;
constexpr double rounding = 1e-6;  // of a step: times are sums of steps

}  // namespace

double gust_wave(double t, double period) {
  const double phase = 2 * std::numbers::pi * t / period, golden = std::numbers::phi;
  return 0.5 * std::sin(phase) + 0.3 * std::sin(golden * phase + 1) + 0.2 * std::sin(golden * golden * phase + 2);
}

GustSpan gust_span(const Preset& preset, double t) {
  const double dt = preset.dt, length = preset.gust_period / spans_in_a_period;
  const auto factor = [&](double at) { return 1 + preset.gust * gust_wave(at, preset.gust_period); };
  if (dt >= length) return {factor(t + dt / 2), 1};
  const double n = std::floor((t + rounding * dt) / length), middle = (n + 0.5) * length;
  const double left = ((n + 1) * length - t) / dt;  // steps, in this span
  if (const double whole = std::floor(left + rounding); whole >= 1)
    return {factor(middle), int(std::min(whole, most_steps))};
  return {left * factor(middle) + (1 - left) * factor(middle + length), 1};
}

Preset in_gusts(Preset preset, double t) {
  if (gusts(preset)) {
    const double factor = gust_span(preset, t).factor;
    preset.W *= factor, preset.u *= factor;
  }
  return preset;
}

}  // namespace tyglab
