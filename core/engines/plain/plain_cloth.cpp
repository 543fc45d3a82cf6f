#include "core/engines/plain/plain_cloth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/contact/self_contact.h"
#include "core/forces/contact.h"

namespace tyglab::plain {

Vector forces(const Preset& preset, const Tears& tears, const Vector& x, const Vector& v, bool external_only) {
  const Lattice& lattice = tears.lattice();
  assert(x.size() == std::size_t(lattice.size()) && v.size() == x.size());
  Vector F(x.size(), glm::dvec3(0));
  for (const Force* force : force::all) {
    if (!force->on(preset) || (external_only && force->group == Force::Group::internal)) continue;
    if (force->among != nullptr) force->among(preset, tears, x, v, F);
    for (const Stencil& stencil : force->stencils(preset))
      for (int i = 0; i < lattice.rows; ++i)
        for (int j = 0; j < lattice.columns; ++j) {
          if (!stencil.acts(tears, i, j)) continue;
          // The stencil's particles, what the force does to them, and where that goes.
          std::array<std::size_t, Stencil::most_points> particle{};
          Points points;
          for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) {
            particle[n] =
                std::size_t(i + stencil.at[n].di) * std::size_t(lattice.columns) + std::size_t(j + stencil.at[n].dj);
            points.x[n] = x[particle[n]], points.v[n] = v[particle[n]];
          }
          ForceAction action;
          force->act(preset, stencil, points, action);
          for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) F[particle[n]] += action.F[n];
        }
  }
  // Where the cloth has parted.
  const auto x_of = [&](int n) { return x[std::size_t(n)]; };
  const auto v_of = [&](int n) { return v[std::size_t(n)]; };
  for (const LooseStencil& loose : loose_stencils(preset, tears)) {
    if (external_only && loose.force->group == Force::Group::internal) continue;
    const ForceAction action = action_of(preset, loose, x_of, v_of);
    for (std::size_t n = 0; n < std::size_t(loose.stencil->points); ++n) F[std::size_t(loose.at[n])] += action.F[n];
  }
  return F;
}

Vector Cloth::accelerations(int position, int velocity, double per, const Tears& tears, bool external_only) {
  Vector v = vectors[std::size_t(velocity)];
  for (glm::dvec3& one : v) one *= per;
  Vector a = forces(preset, tears, vectors[std::size_t(position)], v, external_only);
  if (held >= 0) hand_force = a[std::size_t(held)];
  for (std::size_t p = 0; p < a.size(); ++p)
    a[p] = fixed[p] != 0 ? glm::dvec3(0) : a[p] / (preset.m * tears.share(int(p)));
  return a;
}

/// Sums of vectors, in the order of the table.
void Cloth::assign(const std::vector<Assignment>& assignments, const Vector& a) {
  for (const Assignment& assignment : assignments)
    for (std::size_t p = 0; p < a.size(); ++p) {
      glm::dvec3 sum{0};
      for (const Term& term : assignment.terms)
        sum += term.factor * power(preset.dt, term.dt_power) *
               (term.vector == acceleration ? a : vectors[std::size_t(term.vector)])[p];
      vectors[std::size_t(assignment.target)][p] = sum;
    }
}

void Cloth::start(const Tears& tears) {
  assign(scheme->start, accelerations(vector_x, vector_v, 1, tears));
  synchronized = false;
}

std::vector<PlacedBody> Cloth::bodies(double t) const {
  return placed_bodies(preset.bodies, t, preset.dt, std::numeric_limits<double>::epsilon());
}

void Cloth::step(const Tears& tears, double t) {
  if (synchronized && !scheme->start.empty()) start(tears);
  Vector x_before, v_before;
  for (const Sweep& sweep : scheme->sweeps) {
    const double per = power(preset.dt, sweep.velocity_dt_power);
    x_before = vectors[vector_x], v_before = vectors[vector_v];
    assign(sweep.assignments, accelerations(sweep.position, sweep.velocity, per, tears, sweep.external));
  }
  collide(x_before, v_before, t);
  if (guards_itself(preset)) hold_back(tears, x_before);
}

/// The guard of contact with itself shortens ways, and velocities as much.
void Cloth::hold_back(const Tears& tears, const Vector& x_before) {
  SelfContact contact(tears.lattice());
  contact.set_preset(preset, layer_constant(preset));
  const auto particles = std::size_t(tears.particles());
  const std::span<const glm::dvec3> before = std::span(x_before).first(particles);
  const std::span<glm::dvec3> now = std::span(vectors[vector_x]).first(particles);
  contact.follow(tears, before);
  contact.look(before, true);
  const bool free = std::all_of(fixed.begin(), fixed.begin() + tears.particles(), [](auto one) { return one == 0; });
  const double scale = velocity_scale();
  for (const auto [particle, part] : contact.hold_back(before, now, free)) {
    ++held_back;
    if (fixed[std::size_t(particle)] != 0) continue;
    const glm::dvec3 common = contact.common_way() / preset.dt * scale;
    for (Vector* v : {&vectors[vector_v], &seen()}) {
      glm::dvec3& one = (*v)[std::size_t(particle)];
      one = common + part * (one - common);
      if (&seen() == &vectors[vector_v]) break;
    }
  }
}

/// Bodies correct the positions and velocities of particles that meet them in the step. Vectors: before its last sweep,
/// up to which no position changes.
void Cloth::collide(const Vector& x_before, const Vector& v_before, double t) {
  const double scale = velocity_scale();
  const Contacts rule = contacts_of(preset, preset.dt, std::numeric_limits<double>::epsilon());
  const std::vector<PlacedBody> placed = bodies(t);
  contacts.clear(), left_inside = 0, largest = 0;
  Vector &x = vectors[vector_x], &v = vectors[vector_v];
  for (std::size_t p = 0; p < x.size(); ++p) {
    ContactStep now{x_before[p], v_before[p] / scale, x[p], v[p] / scale};
    const ContactStep freely = now;
    if (fixed[p] == 0 && meets(placed, rule, now)) {
      if (!tyglab::collide(placed, rule, now)) ++left_inside;
      const glm::dvec3 seen_then = rule.at_ends ? now.v * scale : seen()[p] + (now.v - freely.v) * scale;
      x[p] = now.x, v[p] = now.v * scale;
      if (&seen() != &v) seen()[p] = seen_then;
      contacts.push_back({int(p), freely.x - now.x, freely.v - now.v});
    }
    for (int c = 0; c < 3; ++c)
      for (const double way : {now.x[c] - now.old_x[c], preset.dt * now.v[c]})
        largest = std::isfinite(way) ? std::max(largest, std::abs(way)) : std::numeric_limits<double>::infinity();
  }
}

double Cloth::tear_overloaded(Tears& tears) const {
  const Lattice& lattice = tears.lattice();
  std::vector<int> still;
  for (std::size_t n = 0; n < fixed.size(); ++n)
    if (fixed[n] != 0) still.push_back(int(n));
  const std::vector<std::uint8_t> guards = guarded_sites(tears, still);
  const auto guarded = [&](int i, int j) { return guards[std::size_t(i * lattice.columns + j)] != 0; };
  double slack = std::numeric_limits<double>::infinity();
  for (const LooseStencil& loose : loose_stencils(preset, tears)) {
    if (loose.force != &force::stretch || !overload_parts(tears, guards, loose.at[0], loose.at[1])) continue;
    const Vector& x = vectors[vector_x];
    const double length = glm::distance(x[std::size_t(loose.at[0])], x[std::size_t(loose.at[1])]);
    const double k = spring_constant(preset, directions[std::size_t(loose.stencil->spring[0].direction)]);
    slack = std::min(slack, std::max(preset.F_max / k - (length - loose.stencil->rest * preset.L), 0.0));
  }
  for (int d = 0; d < stretch_directions; ++d)
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j) {
        const auto [di, dj, rest, bending] = directions[std::size_t(d)];
        if (!lattice.has_spring(d, i, j) || !tears.whole(d, i, j) || guarded(i, j) || guarded(i + di, j + dj)) continue;
        const Vector& x = vectors[vector_x];
        const double length =
            glm::distance(x[std::size_t(i * lattice.columns + j)], x[std::size_t((i + di) * lattice.columns + j + dj)]);
        const double longer = length - rest * preset.L;
        const double k = spring_constant(preset, directions[std::size_t(d)]);
        if (parts(preset) && k * longer > preset.F_max)
          slack = 0;
        else if (k * longer > preset.F_max)
          tears.tear(d, i, j);
        else
          slack = std::min(slack, preset.F_max / k - longer);
      }
  return slack;
}

}  // namespace tyglab::plain
