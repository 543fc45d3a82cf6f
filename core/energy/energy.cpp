#include "core/energy/energy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/cloth/state.h"
#include "core/forces/readout.h"
#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"

namespace tyglab {
namespace {
using namespace HWY_NAMESPACE;  // the formulas for one double

class Reader {
 public:
  Reader(const Preset& preset, const Tears& tears, const State& state)
      : p_(preset), tears_(tears), state_(state), lattice_(tears.lattice()) {}

  EnergyReading read(const Held& held) const {
    EnergyReading sum;
    add_particles(held, sum);
    if (p_.kind == Kind::one_weight) {
      add_weight(sum);
      return sum;
    }
    for (int d = 0; d < int(directions.size()); ++d)
      for (int i = 0; i + directions[std::size_t(d)].di < lattice_.rows; ++i) add_row(d, i, sum);
    if (p_.W != glm::dvec3(0)) add_wind(sum.power);
    if (held.particle >= 0) {
      const ParticleForces f =
          forces_on_particle(p_, tears_, state_, held.particle / lattice_.columns, held.particle % lattice_.columns);
      sum.power.hand = -glm::dot(f.F_int() + f.F_ext(), held.velocity);
    }
    return sum;
  }

 private:
  glm::dvec3 x(std::size_t n) const { return {state_.x.x[n], state_.x.y[n], state_.x.z[n]}; }
  glm::dvec3 v(std::size_t n) const { return {state_.v.x[n], state_.v.y[n], state_.v.z[n]}; }

  void add_particles(const Held& held, EnergyReading& sum) const {
    double squares = 0, heights = 0;
    const std::size_t all = std::size_t(lattice_.size());
    for (const auto* component : {&state_.v.x, &state_.v.y, &state_.v.z})
      for (std::size_t n = 0; n < all; ++n) squares += (*component)[n] * (*component)[n];
    for (std::size_t n = 0; n < all; ++n) heights += state_.x.y[n];
    if (held.particle >= 0) squares -= glm::dot(v(std::size_t(held.particle)), v(std::size_t(held.particle)));
    sum.energy.kinetic = p_.m / 2 * squares;
    sum.energy.gravity = p_.m * p_.g * heights;
  }

  void add_weight(EnergyReading& sum) const {
    const double away = state_.x.y[0] - p_.x_0.y, speed = state_.v.y[0];
    sum.energy.stretch = p_.k / 2 * away * away;
    sum.power.damping = -p_.k_d * speed * speed;
  }

  void add_row(int d, int i, EnergyReading& sum) const {
    const Direction& to = directions[std::size_t(d)];
    const std::size_t row = std::size_t(i) * lattice_.columns;
    SpringRow springs{{&state_.x.x[row], &state_.x.y[row], &state_.x.z[row]},
                      {&state_.v.x[row], &state_.v.y[row], &state_.v.z[row]},
                      std::ptrdiff_t(to.di) * lattice_.columns + to.dj,
                      std::max(0, -to.dj),
                      lattice_.columns - std::max(0, to.dj),
                      to.rest * p_.L};
    SpringSums found;
    const std::uint8_t* masks = tears_.row(i);
    const int end = springs.end;
    for (int j = springs.begin; j < end;) {  // from tear to tear
      int next = j;
      while (next < end && (masks == nullptr || (masks[next] >> d & 1) != 0)) next = masks == nullptr ? end : next + 1;
      springs.begin = j, springs.end = next;
      const SpringSums part = next > j ? spring_sums(springs) : SpringSums{};
      found.longer += part.longer, found.shorter += part.shorter, found.speed += part.speed;
      j = next + 1;
    }
    if (to.bending) {
      sum.energy.bending += p_.k_b / 2 * found.shorter;
    } else {
      sum.energy.stretch += p_.k_s / 2 * found.longer;
      sum.power.damping -= p_.k_d * found.speed;
    }
  }

  void add_wind(Power& power) const {
    for (int i = 0; i + 1 < lattice_.rows; ++i)
      for (int j = 0; j + 1 < lattice_.columns; ++j)
        for (int which = 0; which < 2; ++which) {
          if (!tears_.triangle_whole(i, j, which)) continue;
          glm::dvec3 corner[3], speed{0};
          for (int n = 0; n < 3; ++n) {
            const Corner& at = quad_triangles[std::size_t((i + j) & 1)][std::size_t(which)][std::size_t(n)];
            const std::size_t p = std::size_t(i + at.di) * lattice_.columns + std::size_t(j + at.dj);
            corner[n] = x(p), speed += v(p);
          }
          const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
          power.wind += glm::dot(wind_on_corner(normal, p_.W / 3.0, std::numeric_limits<double>::min()), speed);
        }
  }

  const Preset& p_;
  const Tears& tears_;
  const State& state_;
  const Lattice& lattice_;
};

}  // namespace

EnergyReading read_energy(const Preset& preset, const Tears& tears, const State& state, const Held& held) {
  assert(state.x.x.size() == std::size_t(lattice_of(preset).size()));
  return Reader(preset, tears, state).read(held);
}

}  // namespace tyglab
