#include "core/energy/energy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/cloth/state.h"
#include "core/forces/readout.h"

namespace tyglab {
namespace {

class Reader {
 public:
  Reader(const Preset& preset, const Tears& tears, const State& state)
      : p_(preset), tears_(tears), state_(state), lattice_(tears.lattice()) {}

  EnergyReading read(const Held& held, std::span<const DrivenPin> driven) const {
    EnergyReading sum;
    add_particles(held, driven, sum);
    if (p_.kind == Kind::cloth)
      for (int d = 0; d < int(directions.size()); ++d)
        for (int i = 0; i + directions[std::size_t(d)].di < lattice_.rows; ++i) add_row(d, i, sum);
    for_each_stencil(p_, [&](const Force& force, const Stencil& stencil) {
      if (!by_rows(force)) add(force, stencil, sum);
    });
    const ForcesAmong among = forces_among(p_, tears_, state_);
    for (const Force* force : force::all) {
      const std::vector<glm::dvec3>& F = among.forces[*force];
      if (force->conserves) sum.energy.of[*force] += among.energy[*force];
      for (std::size_t n = 0; !force->conserves && n < F.size(); ++n) sum.power.of[*force] += glm::dot(F[n], v(n));
    }
    const auto drive = [&](int particle, const glm::dvec3& velocity) {
      ParticleForces f =
          forces_on_particle(p_, tears_, state_, particle / lattice_.columns, particle % lattice_.columns);
      among.add_to(f, std::size_t(particle));
      sum.power.hand -= glm::dot(f.F_int() + f.F_ext(), velocity);
    };
    if (held.particle >= 0) drive(held.particle, held.velocity);
    for (const DrivenPin& pin : driven) drive(pin.particle, pin.v);
    return sum;
  }

 private:
  glm::dvec3 x(std::size_t n) const { return {state_.x.x[n], state_.x.y[n], state_.x.z[n]}; }
  glm::dvec3 v(std::size_t n) const { return {state_.v.x[n], state_.v.y[n], state_.v.z[n]}; }

  void add_particles(const Held& held, std::span<const DrivenPin> driven, EnergyReading& sum) const {
    double squares = 0, heights = 0;
    const std::size_t all = std::size_t(lattice_.size());
    for (const auto* component : {&state_.v.x, &state_.v.y, &state_.v.z})
      for (std::size_t n = 0; n < all; ++n) squares += (*component)[n] * (*component)[n];
    for (std::size_t n = 0; n < all; ++n) heights += state_.x.y[n];
    // Particles at parted sites have a share of a mass; their weight is among the forces of loose stencils.
    for (std::size_t n = 0; tears_.mesh() != nullptr && n < all; ++n) {
      squares -= (1 - tears_.share(int(n))) * glm::dot(v(n), v(n));
      if (tears_.parted(int(n) / lattice_.columns, int(n) % lattice_.columns)) heights -= state_.x.y[n];
    }
    const auto leave_out = [&](int p) { squares -= tears_.share(p) * glm::dot(v(std::size_t(p)), v(std::size_t(p))); };
    if (held.particle >= 0) leave_out(held.particle);
    for (const DrivenPin& pin : driven) leave_out(pin.particle);
    sum.energy.kinetic = p_.m / 2 * squares;
    sum.energy.of[force::gravity] = p_.m * p_.g * heights;
  }

  /// Whether add_particles() or add_row() has added it.
  bool by_rows(const Force& force) const {
    if (&force == &force::gravity) return true;
    return p_.kind == Kind::cloth && (&force == &force::stretch || &force == &force::bend || &force == &force::damping);
  }

  /// One stencil at all its owners.
  void add(const Force& force, const Stencil& stencil, EnergyReading& sum) const {
    double energy = 0, power = 0;
    const auto place = [&](int i, int j) { return std::size_t(i) * lattice_.columns + std::size_t(j); };
    for_each_action(
        p_, tears_, force, stencil, [&](int i, int j) { return x(place(i, j)); },
        [&](int i, int j) { return v(place(i, j)); },
        [&](const Points& points, const ForceAction& action) {
          energy += action.energy;
          for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) power += glm::dot(action.F[n], points.v[n]);
        });
    (force.conserves ? sum.energy.of : sum.power.of)[force] += force.conserves ? energy : power;
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
    sum.energy.of[spring_force(to)] += spring_constant(p_, to) / 2 * (to.bending ? found.shorter : found.longer);
    if (!to.bending) sum.power.of[force::damping] -= p_.k_d * found.speed;
  }

  const Preset& p_;
  const Tears& tears_;
  const State& state_;
  const Lattice& lattice_;
};

}  // namespace

EnergyReading read_energy(const Preset& preset, const Tears& tears, const State& state, const Held& held,
                          std::span<const DrivenPin> driven) {
  assert(state.x.x.size() == std::size_t(tears.lattice().size()));
  return Reader(preset, tears, state).read(held, driven);
}

}  // namespace tyglab
