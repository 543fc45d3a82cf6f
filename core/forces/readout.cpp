#include "core/forces/readout.h"

#include <glm/geometric.hpp>

#include "core/forces/parted.h"

namespace tyglab {
namespace {

struct StateLook {
  const State& state;
  int columns;
  glm::dvec3 x(int i, int j) const { return at(state.x, i, j); }
  glm::dvec3 v(int i, int j) const { return at(state.v, i, j); }
  glm::dvec3 at(const VectorField<double>& f, int i, int j) const {
    const std::size_t p = std::size_t(i) * columns + j;
    return {f.x[p], f.y[p], f.z[p]};
  }
};

/// Calls visit(force, stencil, owner's i and j, points, action, which of the points the particle is) for everything
/// that acts on a particle.
template <class Look, class Visit>
void for_each_action(const Preset& p, const Tears& tears, const Look& look, int i, int j, const Visit& visit) {
  for_each_stencil(p, [&](const Force& force, const Stencil& stencil) {
    for (std::size_t own = 0; own < std::size_t(stencil.points); ++own) {
      const int oi = i - stencil.at[own].di, oj = j - stencil.at[own].dj;
      if (!tears.lattice().contains(oi, oj) || !stencil.acts(tears, oi, oj)) continue;
      const Points points = points_of(
          stencil, oi, oj, [&](int pi, int pj) { return look.x(pi, pj); },
          [&](int pi, int pj) { return look.v(pi, pj); });
      ForceAction action;
      force.act(p, stencil, points, action);
      visit(force, stencil, oi, oj, points, action, own);
    }
  });
}

template <class Look>
ParticleForces forces_at(const Preset& p, const Tears& tears, const Look& look, int i, int j) {
  ParticleForces sum;
  for_each_action(p, tears, look, i, j,
                  [&](const Force& force, const Stencil&, int, int, const Points&, const ForceAction& action,
                      std::size_t own) { sum[force] += action.F[own]; });
  return sum;
}

}  // namespace

std::span<const std::string_view> force_keys() {
  static const auto keys = [] {
    std::array<std::string_view, force::all.size() + 3> all{"F"};
    for (std::size_t n = 0; n < force::all.size(); ++n) all[n + 1] = force::all[n]->symbol;
    all[force::all.size() + 1] = "F_int", all[force::all.size() + 2] = "F_ext";
    return all;
  }();
  return keys;
}

std::vector<std::string_view> shown_force_keys(const Preset& preset) {
  std::vector<std::string_view> keys(force_keys().begin(), force_keys().end());
  std::erase_if(keys, [&](std::string_view key) {
    return std::any_of(force::all.begin(), force::all.end(), [&](const Force* force) {
      return force->symbol == key && !force->in_report && !force->on(preset);
    });
  });
  return keys;
}

ForcesByKey<glm::dvec3> by_key(const ParticleForces& on) {
  ForcesByKey<glm::dvec3> all;
  std::copy(on.of.begin(), on.of.end(), all.values.begin() + 1);
  all.values[force::all.size() + 1] = on.F_int(), all.values[force::all.size() + 2] = on.F_ext();
  all.values[0] = on.F_int() + on.F_ext();
  return all;
}

ForcesAmong forces_among(const Preset& p, const Tears& tears, const State& state) {
  ForcesAmong found;
  const auto at = [](const VectorField<double>& field) {
    return [&field](int n) {
      const auto particle = std::size_t(n);
      return glm::dvec3(field.x[particle], field.y[particle], field.z[particle]);
    };
  };
  for (const LooseStencil& loose : loose_stencils(p, tears)) {
    const ForceAction action = action_of(p, loose, at(state.x), at(state.v));
    std::vector<glm::dvec3>& F = found.forces[*loose.force];
    if (F.empty()) F.assign(std::size_t(tears.lattice().size()), glm::dvec3(0));
    found.energy[*loose.force] += action.energy;
    for (std::size_t n = 0; n < std::size_t(loose.stencil->points); ++n) F[std::size_t(loose.at[n])] += action.F[n];
  }
  std::vector<glm::dvec3> x, v;
  for (const Force* force : force::all) {
    if (force->among == nullptr || !force->on(p)) continue;
    for (std::size_t n = x.size(); n < std::size_t(tears.lattice().size()); ++n)
      x.emplace_back(state.x.x[n], state.x.y[n], state.x.z[n]),
          v.emplace_back(state.v.x[n], state.v.y[n], state.v.z[n]);
    found.forces[*force].assign(x.size(), glm::dvec3(0));
    found.energy[*force] = force->among(p, tears, x, v, found.forces[*force]);
  }
  return found;
}

ParticleForces forces_on_particle(const Preset& p, const Tears& tears, const State& state, int i, int j) {
  return forces_at(p, tears, StateLook{state, tears.lattice().columns}, i, j);
}

ParticleForces forces_on_particle(const Preset& p, const Tears& tears, const Neighborhood& near, int i, int j) {
  return forces_at(p, tears, near, i, j);
}

std::vector<StencilForce> stencils_on_particle(const Preset& p, const Tears& tears, const Neighborhood& near, int i,
                                               int j) {
  std::vector<StencilForce> all;
  for_each_action(
      p, tears, near, i, j,
      [&](const Force& force, const Stencil& stencil, int oi, int oj, const Points& points, const ForceAction& action,
          std::size_t own) {
        if (force.group != Force::Group::internal) return;
        glm::dvec3 d{0};
        for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) d += stencil.at[n].weight * points.x[n];
        const auto& other = stencil.at[own == 0 ? std::size_t(stencil.points - 1) : 0];
        all.push_back({&force, oi + other.di, oj + other.dj, glm::length(d), stencil.rest * p.L, action.F[own]});
      });
  return all;
}

}  // namespace tyglab
