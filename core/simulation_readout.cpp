// Read-outs of a simulation: the whole state, the variables of table B.1 for one particle, sums over the cloth.

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/forces/contact.h"
#include "core/forces/readout.h"
#include "core/simulation.h"

namespace tyglab {
namespace {}  // namespace

const State& Simulation::read() {
  if (state_revision_ == revision_) return state_;
  const std::lock_guard lock(*reading_);
  engine_->read(state_, tears_), state_revision_ = revision_;
  return state_;
}

State Simulation::read_raw() {
  State state;
  const std::lock_guard lock(*reading_);
  engine_->read_raw(state, tears_);
  return state;
}

/// The velocity that belongs to the position of a particle; `near` holds the velocities that damping sees.
glm::dvec3 Simulation::velocity_at(const Neighborhood& near, const StoredParticle& stored, int i, int j) const {
  if (stored.lag == 0 || pinned(i, j) || held_.particle == i * lattice_.columns + j) return stored.v;
  const ParticleForces forces = forces_on_particle(acting(), tears_, near, i, j);
  return stored.v + stored.lag / preset_.m * (forces.F_int() + forces.F_ext());
}

ParticleReadout Simulation::particle(int i, int j) const {
  assert(has(i, j));
  // Only what stands round it: to read a whole cloth takes longer than all the rest of a frame.
  constexpr int reach = Neighborhood::reach;
  Neighborhood near(i, j);
  const auto visit = [&](int far, const auto& what) {
    for (int ni = std::max(i - far, 0); ni <= std::min(i + far, lattice_.rows - 1); ++ni)
      for (int nj = std::max(j - far, 0); nj <= std::min(j + far, lattice_.columns - 1); ++nj) what(ni, nj);
  };
  const std::size_t p = std::size_t(i) * lattice_.columns + j;
  ParticleForces forces;
  Neighborhood now = near;
  if (tears_.mesh() == nullptr && !force::self.on(acting())) {
    visit(reach, [&](int ni, int nj) {
      const StoredParticle stored = engine_->stored(ni, nj);
      near.x(ni, nj) = stored.x, near.v(ni, nj) = stored.v_seen;
    });
    now = near;
    visit(1, [&](int ni, int nj) { now.v(ni, nj) = velocity_at(near, engine_->stored(ni, nj), ni, nj); });
    forces = forces_on_particle(acting(), tears_, now, i, j);
  } else {
    // What no stencil of the lattice tells may come from anywhere.
    State all;
    {
      const std::lock_guard lock(*reading_);
      engine_->read(all, tears_);
    }
    forces = forces_on_particle(acting(), tears_, all, i, j);
    forces_among(acting(), tears_, all).add_to(forces, p);
    now.x(i, j) = {all.x.x[p], all.x.y[p], all.x.z[p]}, now.v(i, j) = {all.v.x[p], all.v.y[p], all.v.z[p]};
  }
  ParticleReadout out;
  out.forces = by_key(forces);
  out.pinned = pinned(i, j);
  out.held = held_.particle == int(p);
  // What holds a particle (pin or hand) tolerates the rest of its force; the hand's belongs to F_ext.
  if (out.held) out.forces.give_hand(-out["F"]);
  out.x = now.x(i, j), out.v = now.v(i, j);
  out.a = out.pinned ? glm::dvec3(0) : out["F"] / (preset_.m * tears_.share(int(p)));
  out.on_body = !out.pinned && !out.held &&
                held_by_contact(placed_bodies(acting().bodies, time(), preset_.dt, rounding_unit(preset_.precision)),
                                preset_.dt, rounding_unit(preset_.precision), out.x, out.v, out.a);
  return out;
}

ForceSummary Simulation::forces(Reduction reduction) {
  const State& state = read();
  const ForcesAmong among = forces_among(acting(), tears_, state);
  ForceSummary all;
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j) {
      ParticleForces forces = forces_on_particle(acting(), tears_, state, i, j);
      among.add_to(forces, std::size_t(i) * lattice_.columns + std::size_t(j));
      const auto on = by_key(forces);
      for (std::size_t n = 0; n < on.values.size(); ++n) {
        const double size = glm::length(on.values[n]);
        all.values[n] = reduction == Reduction::sum ? all.values[n] + size : std::max(all.values[n], size);
      }
    }
  return all;
}

// The energy ledger of a simulation, kept only on request.

EnergyReading Simulation::energy() {
  return read_energy(acting(), tears_, read(), held_, driven_);
}

void Simulation::enable_ledger(bool on) {
  std::optional<EnergyWatch> watch;
  if (on) watch.emplace().begin(preset_, energy(), time());
  engine_->note_contacts(on);
  watch_ = std::move(watch);
}

std::optional<LedgerReading> Simulation::ledger() const {
  if (!watch_) return std::nullopt;
  LedgerReading reading = watch_->ledger().reading();
  reading.bodies_move = any_moves(acting().bodies);
  return reading;
}

void Simulation::watch_edit(Ledger::Source source) {
  if (!watch_) return;
  ++revision_;
  watch_->edited(energy(), source);
}

void Simulation::watch_step(const Preset& made) {
  ++revision_;
  watch_->after_step(made, tears_, read(), held_, driven_, engine_->contacts());
}

}  // namespace tyglab
