
#include "core/forces/contact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tyglab {
namespace {

constexpr int passes = 4;  // enough for the wedge of two bodies; more only helps where three meet

/// Unit normal of the body's surface seen from x; +y at a sphere's center.
glm::dvec3 normal(const Body& body, const glm::dvec3& x) {
  if (body.shape == Body::Shape::plane) return {0, 1, 0};
  const glm::dvec3 out = x - body.c;
  const double length = glm::length(out);
  return length > 0 ? out / length : glm::dvec3(0, 1, 0);
}

glm::dvec3 nearest_surface_point(const Body& body, const glm::dvec3& x, const glm::dvec3& center_normal) {
  if (body.shape == Body::Shape::plane) return {x.x, body.y, x.z};
  const glm::dvec3 n = x == body.c ? center_normal : normal(body, x);
  return body.c + body.r * n;
}

/// Where the line from x, inside, along n leaves the body.
glm::dvec3 way_out(const Body& body, const glm::dvec3& x, const glm::dvec3& n) {
  if (body.shape == Body::Shape::plane) return {x.x, body.y, x.z};
  const glm::dvec3 q = x - body.c;
  const double along = glm::dot(q, n);
  return x + (std::sqrt(along * along - glm::dot(q, q) + body.r * body.r) - along) * n;
}

/// Normal part removed or reversed with restitution e, tangential part shortened by at most μ times the change.
glm::dvec3 corrected_velocity(const Body& body, const ContactRule& rule, const glm::dvec3& v, const glm::dvec3& n) {
  const double inward = glm::dot(v, n);
  if (inward >= 0) return v;
  const double e = -inward < rest_speed(body, rule.g, rule.dt) ? 0 : body.restitution;
  const double change = (1 + e) * -inward;
  const glm::dvec3 tangential = v - inward * n;
  const double speed = glm::length(tangential);
  const double left = speed > 0 ? std::max(0.0, 1 - body.friction * change / speed) : 0;
  return left * tangential - e * inward * n;
}

void collide_one(const Body& body, const ContactRule& rule, ContactStep& p) {
  const glm::dvec3 n = normal(body, p.old_x);
  if (depth(body, p.old_x) > contact_tolerance(body, p.old_x, rule.epsilon)) {
    // It was inside already (the body was moved, a bad start): out along n, the nearest way from where it was. From a
    // sphere's center that is up, even if gravity has just moved it below.
    p.x = way_out(body, p.x, n);
    p.v -= std::min(0.0, glm::dot(p.v, n)) * n;
    return;
  }
  p.v = corrected_velocity(body, rule, p.v, n);
  p.x = p.old_x + rule.dt * p.v;
  if (depth(body, p.x) > 0) p.x = nearest_surface_point(body, p.x, n);
}

}  // namespace

double depth(const Body& body, const glm::dvec3& x) {
  return body.shape == Body::Shape::plane ? body.y - x.y : body.r - glm::length(x - body.c);
}

double contact_tolerance(const Body& body, const glm::dvec3& x, double epsilon) {
  const bool plane = body.shape == Body::Shape::plane;
  const double largest =
      plane ? std::max(std::abs(x.y), std::abs(body.y)) : std::max({glm::length(x), glm::length(body.c), body.r});
  return 8 * epsilon * largest;
}

double rest_speed(const Body& body, double g, double dt) {
  constexpr double most_restitution = 0.9;
  constexpr double error = 3.5;  // of g dt: Euler's 3, and some more, since some bounces are above their mean
  return body.restitution <= most_restitution ? error * g * dt / (1 - body.restitution) : 0;
}

bool held_by_contact(std::span<const Body> bodies, double dt, double epsilon, const glm::dvec3& x, const glm::dvec3& v,
                     const glm::dvec3& a) {
  const glm::dvec3 free_x = x + dt * (v + dt * a);
  return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
    // What rounding leaves between a resting particle and the body is no distance.
    return depth(body, free_x) > -contact_tolerance(body, free_x, epsilon);
  });
}

bool collide(std::span<const Body> bodies, const ContactRule& rule, ContactStep& p) {
  for (int pass = 0; pass < passes; ++pass) {
    bool touched = false;
    for (const Body& body : bodies)
      if (depth(body, p.x) > 0) {
        // From the second pass on, what rounding leaves is accepted; the first must see every contact.
        if (pass > 0 && depth(body, p.x) <= contact_tolerance(body, p.x, rule.epsilon)) continue;
        collide_one(body, rule, p);
        touched = true;
      }
    if (!touched) return true;
  }
  return std::none_of(bodies.begin(), bodies.end(),
                      [&](const Body& body) { return depth(body, p.x) > contact_tolerance(body, p.x, rule.epsilon); });
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
  if (gusts(preset)) preset.W *= gust_span(preset, t).factor;
  return preset;
}

}  // namespace tyglab
