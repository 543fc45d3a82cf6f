#include "core/forces/contact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tyglab {
namespace contact {
namespace {

using glm::dot, std::sqrt, std::fabs, std::fmin, std::fmax;

glm::dvec3 center(const Body* body) {
  return body->c;
}
bool is_plane(const Body* body) {
  return body->shape == Body::Shape::plane;
}

#define BODIES
#define global
#define INLINE inline
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
  return {of.dt, of.epsilon, of.g, of.shape.position, of.shape.last_kick, of.lag, of.at_ends, 0};
}

}  // namespace
}  // namespace contact

double depth(const Body& body, const glm::dvec3& x) {
  return -contact::gap_at(&body, x);
}

double contact_tolerance(const Body& body, const glm::dvec3& x, double epsilon) {
  return contact::tolerance_at(&body, x, epsilon);
}

bool held_by_contact(std::span<const Body> bodies, double dt, double epsilon, const glm::dvec3& x, const glm::dvec3& v,
                     const glm::dvec3& a) {
  const glm::dvec3 free_x = x + dt * (v + dt * a);
  return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
    // What rounding leaves between a resting particle and the body is no distance.
    return depth(body, free_x) > -contact_tolerance(body, free_x, epsilon);
  });
}

Contacts contacts_of(const Preset& preset, double dt, double epsilon) {
  const Scheme& method = scheme(preset.integrator);
  return {preset.contact == "step", dt, preset.g, epsilon, step_shape(method), method.lag};
}

bool meets_within_steps(const Preset& preset) {
  return preset.kind == Kind::cloth && !preset.bodies.empty() && preset.contact != "step";
}

bool meets(std::span<const Body> bodies, const Contacts& rule, const ContactStep& step) {
  return contact::meets(bodies.data(), int(bodies.size()), contact::rule_of(rule), step.old_x, step.x) != 0;
}

bool collide(std::span<const Body> bodies, const Contacts& rule, ContactStep& step) {
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
