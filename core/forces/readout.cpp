#include "core/forces/readout.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"

namespace tyglab {
namespace {
using namespace HWY_NAMESPACE;  // the formulas for one double

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

template <class Look>
SpringForce spring_force(const Preset& p, const Look& look, const Direction& d, int i, int j, int oi, int oj) {
  const glm::dvec3 x_ij = look.x(oi, oj) - look.x(i, j);
  const double r2 = glm::dot(x_ij, x_ij), rest = d.rest * p.L;
  SpringForce spring{oi, oj, d.bending, std::sqrt(r2), rest};
  if (d.bending) {
    spring.F = bend_factor(Spring<double>::of(p.k_b, rest, std::identity()), r2) * x_ij;
  } else {
    spring.F = stretch_factor(Spring<double>::of(p.k_s, rest, std::identity()), r2) * x_ij;
    spring.F_d = -p.k_d * (look.v(i, j) - look.v(oi, oj));
  }
  return spring;
}

/// Calls visit(SpringForce) for every whole spring at a particle.
template <class Look, class Visit>
void each_spring(const Preset& p, const Tears& tears, const Look& look, int i, int j, const Visit& visit) {
  const Lattice& lattice = tears.lattice();
  for (int d = 0; d < int(directions.size()); ++d) {
    const Direction& dir = directions[d];
    if (lattice.has_spring(d, i, j) && tears.whole(d, i, j))
      visit(spring_force(p, look, dir, i, j, i + dir.di, j + dir.dj));
    const int oi = i - dir.di, oj = j - dir.dj;
    if (lattice.has_spring(d, oi, oj) && tears.whole(d, oi, oj)) visit(spring_force(p, look, dir, i, j, oi, oj));
  }
}

template <class Look>
void add_wind(const Preset& p, const Tears& tears, const Look& look, int i, int j, ParticleForces& sum) {
  const Lattice& lattice = tears.lattice();
  for (int qi = i - 1; qi <= i; ++qi)
    for (int qj = j - 1; qj <= j; ++qj)
      for (int which = 0; which < 2; ++which) {
        if (!lattice.contains(qi, qj) || !lattice.contains(qi + 1, qj + 1)) continue;
        const auto& corners = quad_triangles[(qi + qj) & 1][which];
        bool mine = false;
        glm::dvec3 x[3];
        for (int n = 0; n < 3; ++n) {
          x[n] = look.x(qi + corners[n].di, qj + corners[n].dj);
          mine |= qi + corners[n].di == i && qj + corners[n].dj == j;
        }
        if (!mine || !tears.triangle_whole(qi, qj, which)) continue;
        sum.F_wind += wind_on_corner(cross(x[1] - x[0], x[2] - x[0]), p.W / 3.0, std::numeric_limits<double>::min());
      }
}

template <class Look>
ParticleForces forces_at(const Preset& p, const Tears& tears, const Look& look, int i, int j) {
  ParticleForces sum;
  sum.F_g = {0, -p.m * p.g, 0};
  if (p.kind == Kind::one_weight) {
    sum.F_s.y = hooke(look.x(0, 0).y, p.x_0.y, p.k, 0.0, 0.0);
    sum.F_d.y = -p.k_d * look.v(0, 0).y;
    return sum;
  }
  each_spring(p, tears, look, i, j, [&](const SpringForce& spring) {
    (spring.bending ? sum.F_b : sum.F_s) += spring.F;
    sum.F_d += spring.F_d;
  });
  if (p.W != glm::dvec3(0)) add_wind(p, tears, look, i, j, sum);
  return sum;
}

}  // namespace

ParticleForces forces_on_particle(const Preset& p, const Tears& tears, const State& state, int i, int j) {
  return forces_at(p, tears, StateLook{state, tears.lattice().columns}, i, j);
}

ParticleForces forces_on_particle(const Preset& p, const Tears& tears, const Neighborhood& near, int i, int j) {
  return forces_at(p, tears, near, i, j);
}

std::vector<SpringForce> springs_on_particle(const Preset& p, const Tears& tears, const Neighborhood& near, int i,
                                             int j) {
  std::vector<SpringForce> springs;
  each_spring(p, tears, near, i, j, [&](const SpringForce& spring) { springs.push_back(spring); });
  return springs;
}

}  // namespace tyglab
