// Contact of the cloth with itself (core/contact/self_contact.h) around the sweeps: forces before each, the guard after
// the last. One thread makes it, in double, and only while something is near; the others wait.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/engines/cpu/cpu_engine.h"
#include "core/forces/readout.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
void CpuEngine<R, Present>::fetch(const Field& field, double scale, std::vector<glm::dvec3>& out) const {
  const int columns = cloth_.lattice.columns, particles = self_->particles;
  out.resize(std::size_t(particles));
  for (int first = 0, i = 0; first < particles; first += columns, ++i) {
    const R *x = field.row(i, 0), *y = field.row(i, 1), *z = field.row(i, 2);
    glm::dvec3* to = out.data() + first;
    for (int j = 0; j < std::min(columns, particles - first); ++j) to[j] = scale * glm::dvec3(x[j], y[j], z[j]);
  }
}

/// Before a step: which parts are near.
template <class R, unsigned Present>
void CpuEngine<R, Present>::begin_self(const Tears& tears) {
  if (self_ == nullptr) return;
  self_->particles = tears.particles(), self_->solving = false;
  const bool guards = guards_itself(cloth_.preset);
  if (self_->contact.near() || self_->contact.stale(tears, self_->way)) {
    fetch(cloth_.vector(vector_x), 1, self_->x);
    self_->contact.follow(tears, self_->x);
    self_->way = 0;
  }
  if (guards) self_->rows_before = cloth_.vector(vector_x);
  self_->looked = self_->contact.near();
  if (self_->looked) self_->contact.look(self_->x, guards);
}

/// Before a sweep: the forces of layers, which it adds to those it computes, and what loose ones add.
template <class R, unsigned Present>
void CpuEngine<R, Present>::find_near_force(const ResolvedSweep& sweep) {
  using Air = ResolvedSweep::Air;
  const bool has_them = lags_contact(*scheme_) ? sweep.air != Air::none : !sweep.external && sweep.air != Air::alone;
  if (!has_them) return;
  if (self_->solving ? !self_->contact.solves_for_pairs() : !self_->contact.near()) return;
  std::vector<glm::dvec3>& F = self_->F;
  // The first sweep of a step is at the positions that its beginning has looked at.
  if (self_->solving) {
    fetch(cloth_.vector(sweep.position), 1, self_->x);
    self_->contact.look_in_solve(self_->x);
  } else if (sweep.position != vector_x || !self_->looked) {
    fetch(cloth_.vector(sweep.position), 1, self_->x);
    self_->contact.follow(self_->x);
    self_->contact.look(self_->x);
    self_->looked = false, self_->way = std::numeric_limits<double>::infinity();
  }
  if (!self_->contact.touches()) return;
  F.assign(self_->x.size(), glm::dvec3(0));
  self_->contact.add_forces(F);
  if (self_->contact.has_friction()) {
    fetch(cloth_.vector(sweep.velocity), sweep.per_velocity, self_->v);
    self_->contact.add_friction(self_->v, F);
  }
  if (self_->force.empty()) self_->force.resize(array_rows(), cloth_.stride);
  const int columns = cloth_.lattice.columns, particles = self_->particles;
  for (std::size_t n = 0; n < loose_.particles.size(); ++n) {
    glm::dvec3& one = F[std::size_t(loose_.particles[n])];
    one = loose_.per_share[n] * (one + loose_.F[n]);
  }
  for (int first = 0, i = 0; first < particles; first += columns, ++i)
    for (int c = 0; c < 3; ++c) {
      R* row = self_->force.row(i, c);
      for (int j = 0; j < std::min(columns, particles - first); ++j) row[j] = R(F[std::size_t(first + j)][c]);
    }
  cloth_.near_force = &self_->force, cloth_.near_rows = nullptr;
}

/// Before an implicit stage: until it ends, pairs keep their sides. Returns whether there are any, by their distances
/// where the step begins.
template <class R, unsigned Present>
bool CpuEngine<R, Present>::begin_self_solve() {
  const bool elsewhere = self_->way == std::numeric_limits<double>::infinity();  // the last stage has looked there
  if (self_->contact.near() || elsewhere) fetch(cloth_.vector(vector_x), 1, self_->x);
  if (!self_->looked && (self_->contact.near() || elsewhere)) self_->contact.follow(self_->x), self_->way = 0;
  self_->contact.begin_solve(self_->x);
  self_->solving = true;
  if (!self_->contact.solves_for_pairs()) return false;
  self_->looked = false, self_->way = std::numeric_limits<double>::infinity();
  beside_.renew = [this] {
    self_->contact.follow(self_->x);
    self_->contact.renew_solve(self_->x);
  };
  return true;
}

/// How layers in contact resist, where forces were computed last.
template <class R, unsigned Present>
void CpuEngine<R, Present>::add_self_couplings(double h, std::vector<implicit::Coupling>& out) const {
  if (self_ == nullptr || !self_->solving || !self_->contact.touches()) return;
  const std::ptrdiff_t pitch = cloth_.vector(vector_x).pitch();
  const int columns = cloth_.lattice.columns;
  for (const auto& [at, weights, normal, along, across] : self_->contact.resistances(self_->v)) {
    implicit::Coupling one{.points = int(at.size()), .weights = weights, .along = normal};
    for (std::size_t n = 0; n < at.size(); ++n) one.at[n] = at[n] / columns * pitch + at[n] % columns;
    one.all = h * across / cloth_.preset.m, one.extra = h * h * along / cloth_.preset.m - one.all;
    out.push_back(one);
  }
}

/// After a step: the guard. Returns whether it has changed anything.
template <class R, unsigned Present>
bool CpuEngine<R, Present>::end_self() {
  if (self_ == nullptr) return false;
  double largest = 0;
  for (const auto& band : bands()) largest = std::max(largest, band->max_displacement());
  const double way = std::sqrt(3.0) * largest;
  self_->way += way, self_->looked = false;
  if (!guards_itself(cloth_.preset) || way <= self_->contact.least_room()) return false;
  const int columns = cloth_.lattice.columns, absent = cloth_.lattice.size() - self_->particles;
  const bool free = std::ssize(all_fixed_) == absent;  // nothing is pinned or held
  std::vector<glm::dvec3>& before = self_->v;
  fetch(self_->rows_before, 1, before);
  fetch(cloth_.vector(vector_x), 1, self_->x);
  const auto held = self_->contact.hold_back(before, self_->x, free);
  self_->way = std::numeric_limits<double>::infinity();
  const glm::dvec3 common = self_->contact.common_way() * (cloth_.velocity_scale() / cloth_.dt);
  for (const auto [particle, part] : held) {
    const int i = particle / columns, j = particle % columns;
    const bool fixed = !cloth_.fixed.empty() && cloth_.fixed[std::size_t(particle)] != 0;
    for (int c = 0; c < 3; ++c) {
      cloth_.row(vector_x, i, c)[j] = R(self_->x[std::size_t(particle)][c]);
      if (fixed) continue;
      for (const int vector : {int(vector_v), cloth_.seen_velocity}) {
        R& v = cloth_.row(vector, i, c)[j];
        v = R(common[c] + part * (double(v) - common[c]));
        if (cloth_.seen_velocity == vector_v) break;
      }
    }
  }
  self_->held_back += std::int64_t(held.size());
  return !held.empty();
}

// What the engine's other files need of this one.
#define TYGLAB_MAKE(R, present)                                                                              \
  template void CpuEngine<R, (present)>::begin_self(const Tears&);                                           \
  template void CpuEngine<R, (present)>::find_near_force(const ResolvedSweep&);                              \
  template bool CpuEngine<R, (present)>::begin_self_solve();                                                 \
  template void CpuEngine<R, (present)>::add_self_couplings(double, std::vector<implicit::Coupling>&) const; \
  template bool CpuEngine<R, (present)>::end_self();
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
