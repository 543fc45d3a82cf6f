#include "core/step_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/contact/self_contact.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

/// The state vectors round a particle where its next step begins, as far as that step can reach: two rows a sweep by
/// springs, one more by wind.
class Patch {
 public:
  Patch(const Simulation& simulation, int i, int j);
  /// Makes a sweep; what it does to the particle in the middle is returned.
  TracedStage sweep(const Sweep& sweep);
  glm::dvec3 middle(int vector) const { return at(vector, i_, j_); }
  /// Whether a particle is pinned or held.
  bool fixed(int i, int j) const;
  /// The force at the beginning, where the method's table says no more.
  TracedStage beginning() const {
    const Sweep& first = method_.sweeps.front();
    return evaluated(first, among(first), i_, j_);
  }

 private:
  glm::dvec3& at(int vector, int i, int j) { return vectors_[std::size_t(vector)][index(i, j)]; }
  const glm::dvec3& at(int vector, int i, int j) const { return vectors_[std::size_t(vector)][index(i, j)]; }
  std::size_t index(int i, int j) const { return std::size_t(i - top_) * std::size_t(right_ - left_ + 1) + j - left_; }
  bool contains(int i, int j) const { return i >= top_ && i <= bottom_ && j >= left_ && j <= right_; }
  /// The vectors at which a sweep evaluates the force, and what velocities there are times.
  struct Evaluated {
    int position, velocity;
    double per;
  };
  Evaluated at_of(const Sweep& sweep) const {
    // Where an implicit stage is solved, the table's vectors are not there yet: the beginning is what can be shown.
    const bool solves = sweep.solves != 0;
    return {solves ? vector_x : sweep.position, solves ? vector_v : sweep.velocity,
            std::pow(preset_.dt, sweep.velocity_dt_power)};
  }
  TracedStage evaluated(const Sweep& sweep, const ForcesAmong& among, int i, int j) const;
  ForcesAmong among(const Sweep& sweep) const;
  void add_loose(int particle, const Evaluated& vectors, TracedStage& stage) const;
  glm::dvec3 value_of(const Term& term, int i, int j, const glm::dvec3& a) const;
  void assign(const Sweep& sweep, int i, int j, const glm::dvec3& a, std::vector<TracedAssignment>* told);

  const Simulation& simulation_;
  const Preset preset_;  ///< with the wind of the step to come
  const Scheme& method_;
  int i_, j_, top_, bottom_, left_, right_;
  bool whole_ = false;  ///< the patch is all of the cloth
  std::vector<std::vector<glm::dvec3>> vectors_;
};

Patch::Patch(const Simulation& simulation, int i, int j)
    : simulation_(simulation),
      preset_(in_gusts(simulation.preset(), simulation.time())),
      method_(scheme(preset_.integrator)),
      i_(i),
      j_(j) {
  const Lattice& lattice = simulation.lattice();
  const bool starts = !method_.start.empty() && simulation.engine().stored(i, j).lag == 0;
  // Forces that no stencil of the lattice tells may come from anywhere.
  whole_ = simulation.tears().mesh() != nullptr || touches_itself(preset_);
  const int reach = whole_ ? lattice.size() : 2 * int(method_.sweeps.size() + starts) + Neighborhood::reach;
  top_ = std::max(i - reach, 0), bottom_ = std::min(i + reach, lattice.rows - 1);
  left_ = std::max(j - reach, 0), right_ = std::min(j + reach, lattice.columns - 1);
  vectors_.assign(std::size_t(std::max(method_.vectors, 2)),
                  std::vector<glm::dvec3>(std::size_t(bottom_ - top_ + 1) * std::size_t(right_ - left_ + 1)));
  const double dt = preset_.dt;
  const int seen = seen_velocity(method_);
  const int power = method_.sweeps.front().velocity_dt_power;
  for (int ni = top_; ni <= bottom_; ++ni)
    for (int nj = left_; nj <= right_; ++nj) {
      const StoredParticle stored = simulation.engine().stored(ni, nj);
      at(vector_x, ni, nj) = stored.x;
      at(vector_v, ni, nj) = method_.keeps_displacement && !starts ? dt * stored.v : stored.v;
      if (seen != vector_v) at(seen, ni, nj) = stored.v_seen * std::pow(dt, -power);
    }
  // What the next step begins with where the method starts with it.
  if (starts) sweep({vector_x, vector_v, 0, method_.start});
}

bool Patch::fixed(int i, int j) const {
  const auto held = simulation_.held();
  return simulation_.pinned(i, j) || (held && held->i == i && held->j == j);
}

TracedStage Patch::evaluated(const Sweep& sweep, const ForcesAmong& among, int i, int j) const {
  constexpr int reach = Neighborhood::reach;
  const auto [position, velocity, per] = at_of(sweep);
  Neighborhood near(i, j);
  for (int ni = std::max(i - reach, top_); ni <= std::min(i + reach, bottom_); ++ni)
    for (int nj = std::max(j - reach, left_); nj <= std::min(j + reach, right_); ++nj)
      near.x(ni, nj) = at(position, ni, nj), near.v(ni, nj) = per * at(velocity, ni, nj);
  TracedStage stage;
  stage.x = near.x(i, j), stage.v = near.v(i, j);
  const Tears& tears = simulation_.tears();
  const int particle = i * tears.lattice().columns + j;
  stage.forces = forces_on_particle(preset_, tears, near, i, j);
  among.add_to(stage.forces, std::size_t(particle));
  if (i == i_ && j == j_) {
    stage.stencils = stencils_on_particle(preset_, tears, near, i, j);
    add_loose(particle, at_of(sweep), stage);
  }
  if (!fixed(i, j)) stage.a = (stage.forces.F_int() + stage.forces.F_ext()) / (preset_.m * tears.share(particle));
  return stage;
}

/// The stencils of a cloth that has parted.
void Patch::add_loose(int particle, const Evaluated& vectors, TracedStage& stage) const {
  const int columns = simulation_.lattice().columns;
  const auto x_of = [&](int n) { return at(vectors.position, n / columns, n % columns); };
  const auto v_of = [&](int n) { return vectors.per * at(vectors.velocity, n / columns, n % columns); };
  for (const LooseStencil& loose : loose_stencils(preset_, simulation_.tears())) {
    const Stencil& stencil = *loose.stencil;
    const auto end = loose.at.begin() + stencil.points, own = std::find(loose.at.begin(), end, particle);
    if (own == end || loose.force->group != Force::Group::internal) continue;
    glm::dvec3 d{0};
    for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) d += stencil.at[n].weight * x_of(loose.at[n]);
    const int other = own == loose.at.begin() ? *(end - 1) : loose.at[0];
    stage.stencils.push_back({loose.force, other / columns, other % columns, glm::length(d), stencil.rest * preset_.L,
                              action_of(preset_, loose, x_of, v_of).F[std::size_t(own - loose.at.begin())]});
  }
}

/// What no stencil of the lattice tells, at the vectors of a sweep.
ForcesAmong Patch::among(const Sweep& sweep) const {
  if (!whole_) return {};
  const auto [position, velocity, per] = at_of(sweep);
  State state;
  const Lattice& lattice = simulation_.lattice();
  state.x.resize(std::size_t(lattice.size())), state.v.resize(std::size_t(lattice.size()));
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const auto n = std::size_t(i * lattice.columns + j);
      const glm::dvec3 x = at(position, i, j), v = per * at(velocity, i, j);
      state.x.x[n] = x.x, state.x.y[n] = x.y, state.x.z[n] = x.z;
      state.v.x[n] = v.x, state.v.y[n] = v.y, state.v.z[n] = v.z;
    }
  return forces_among(preset_, simulation_.tears(), state);
}

glm::dvec3 Patch::value_of(const Term& term, int i, int j, const glm::dvec3& a) const {
  return term.vector == acceleration ? a : at(term.vector, i, j);
}

void Patch::assign(const Sweep& sweep, int i, int j, const glm::dvec3& a, std::vector<TracedAssignment>* told) {
  for (const Assignment& assignment : sweep.assignments) {
    glm::dvec3 sum{0};
    TracedAssignment traced{assignment.target, {}, {}};
    for (const Term& term : assignment.terms) {
      const glm::dvec3 value = value_of(term, i, j, a);
      sum += term.factor * std::pow(preset_.dt, term.dt_power) * value;
      traced.terms.push_back({term.vector, term.factor, term.dt_power, value});
    }
    traced.result = at(assignment.target, i, j) = sum;
    if (told != nullptr) told->push_back(std::move(traced));
  }
}

TracedStage Patch::sweep(const Sweep& sweep) {
  // All forces first: no particle moves before its neighbors have looked at it.
  constexpr int reach = Neighborhood::reach;
  std::vector<glm::dvec3> accelerations(vectors_[0].size());
  const ForcesAmong forces = among(sweep);
  TracedStage traced;
  const Lattice& lattice = simulation_.lattice();
  for (int i = top_; i <= bottom_; ++i)
    for (int j = left_; j <= right_; ++j) {
      // At the patch's own edge something is missing; the middle does not feel it within this step.
      const bool known = (i - reach >= top_ || top_ == 0) && (i + reach <= bottom_ || bottom_ == lattice.rows - 1) &&
                         (j - reach >= left_ || left_ == 0) && (j + reach <= right_ || right_ == lattice.columns - 1);
      if (!known) continue;
      if (i * lattice.columns + j >= simulation_.tears().particles()) continue;
      TracedStage stage = evaluated(sweep, forces, i, j);
      accelerations[index(i, j)] = stage.a;
      if (i == i_ && j == j_) traced = std::move(stage);
    }
  for (int i = top_; i <= bottom_; ++i)
    for (int j = left_; j <= right_; ++j)
      assign(sweep, i, j, accelerations[index(i, j)], i == i_ && j == j_ ? &traced.assignments : nullptr);
  return traced;
}

/// Whether an assignment to `target` in the last sweep begins with that vector: it gathers the result.
bool gathers(const Scheme& scheme, int vector, int target) {
  for (const Assignment& assignment : scheme.sweeps.back().assignments)
    if (assignment.target == target)
      for (const Term& term : assignment.terms)
        if (term.vector == vector) return true;
  return false;
}

}  // namespace

std::string vector_name(const Scheme& scheme, int vector) {
  if (vector == acceleration) return "a";
  if (vector == vector_x) return "x";
  if (vector == vector_v) return scheme.keeps_displacement ? "d" : "v";
  for (const Sweep& sweep : scheme.sweeps) {
    if (sweep.position == vector) return "x*";
    if (sweep.velocity == vector) return "v*";
  }
  return gathers(scheme, vector, vector_x) ? "X" : "V";
}

StepTrace trace_step(const Simulation& simulation, int i, int j) {
  const Preset& preset = simulation.preset();
  const Scheme& method = scheme(preset.integrator);
  StepTrace trace;
  trace.i = i, trace.j = j, trace.dt = preset.dt, trace.integrator = preset.integrator;
  trace.whole = is_written_out(method);
  Patch patch(simulation, i, j);
  trace.fixed = patch.fixed(i, j);
  trace.x = patch.middle(vector_x), trace.v = patch.middle(vector_v);
  if (trace.whole)
    for (const Sweep& sweep : method.sweeps) trace.stages.push_back(patch.sweep(sweep));
  else
    trace.stages.push_back(patch.beginning());
  trace.x_after = patch.middle(vector_x);
  if (trace.whole) return trace;
  const auto next = simulation.rebuilt(edit::Change{preset});
  next->advance(1);
  trace.x_after = next->position(i, j);
  return trace;
}

}  // namespace tyglab
