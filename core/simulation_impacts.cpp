// Steps that are split at every impact (solver.contact = global; docs/model.md, "Collision").
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/cloth/state.h"
#include "core/forces/contact.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

constexpr int most_impacts = 32;  // of a step, after which contacts are local

glm::dvec3 at(const VectorField<double>& field, std::size_t p) {
  return {field.x[p], field.y[p], field.z[p]};
}

}  // namespace

/// When a particle of the state `before`, at time t, meets a body, s later: Newton's method on the distance at the end
/// of the method's own steps, from a first guess. `after`: the state then, as if there were no bodies.
double Simulation::time_of_impact(const State& before, const Tears& tears, double t, int particle, int body,
                                  double first, State& after) {
  constexpr int most = 12;
  const double epsilon = rounding_unit(preset_.precision);
  Preset freely = acting();
  freely.bodies.clear();
  double length = first;
  for (int n = 0; n < most; ++n) {
    Tears unused = tears;
    freely.dt = length;
    engine_->set_preset(freely, unused);
    engine_->load(before, unused);
    if (engine_->advance(1, unused).steps != 1) break;
    engine_->read(after, unused);
    const std::size_t p = std::size_t(particle);
    const PlacedBody placed = placed_bodies(acting().bodies, t, length, epsilon)[std::size_t(body)];
    const auto [gap, rate] = approach(placed, length, at(after.x, p), at(after.v, p));
    const double enough = contact_tolerance(placed, at(after.x, p), epsilon) / 2;
    if (std::abs(gap) <= enough || !(rate > 0)) break;
    length = std::clamp(length + gap / rate, 0.1 * length, preset_.dt);
  }
  return length;
}

/// One dt, with a step of the engine up to each impact and one for the rest. What rests or slides is left to `local`.
AdvanceResult Simulation::step_to_impacts() {
  const double epsilon = rounding_unit(preset_.precision), begin = time();
  const Preset whole = acting();
  AdvanceResult all;
  State before, after;
  engine_->read(before, tears_);
  const State start = before;
  const Tears tears_at_start = tears_;
  double left = preset_.dt, t = begin;
  int torn = 0;
  for (int impacts = 0; left > 0; ++impacts) {
    // As if there were no bodies.
    const Tears tears = tears_;
    Preset part = whole;
    part.dt = left, part.bodies.clear();
    if (watch_) watch_->before_step(part, tears_);
    engine_->set_preset(part, tears_);
    engine_->next_step({t, 0});
    all = engine_->advance(1, tears_);
    if (all.steps != 1) break;
    engine_->read(after, tears_);
    // Who meets a body, and which impact is the first.
    const auto bodies = placed_bodies(whole.bodies, t, left, epsilon);
    std::optional<Impact> first;
    int particle = 0;
    bool met = false;
    for (int p = 0; p < lattice_.size(); ++p) {
      if (p >= tears_.particles() || pinned_mask_[std::size_t(p)] != 0 || p == held_.particle) continue;
      const std::size_t n = std::size_t(p);
      const auto impact = first_impact(bodies, left, epsilon, at(before.x, n), at(before.v, n), at(after.x, n), met);
      if (impact && (!first || impact->time < first->time)) first = impact, particle = p;
    }
    if (met) {
      // Again with bodies, up to the impact and so little further that it is met.
      double length = left;
      const bool splits = first && impacts < most_impacts;
      if (splits) length = time_of_impact(before, tears, t, particle, first->body, first->time, after);
      tears_ = tears;
      part = whole, part.dt = std::min(left, length + (splits ? 1e-9 * preset_.dt : 0)), part.contact = "local";
      if (watch_) watch_->before_step(part, tears_);
      engine_->set_preset(part, tears_);
      engine_->load(before, tears_);
      engine_->next_step({t, 0});
      all = engine_->advance(1, tears_);
      if (all.steps != 1) break;
      if (splits) {
        // What has the impact: as exactly as the method has come there.
        const std::size_t p = std::size_t(particle);
        const PlacedBody body = placed_bodies(whole.bodies, t, length, epsilon)[std::size_t(first->body)];
        const glm::dvec3 x = at(after.x, p), v = after_impact(body, length, x, at(after.v, p));
        engine_->read(before, tears_);
        before.x.x[p] = x.x, before.x.y[p] = x.y, before.x.z[p] = x.z;
        before.v.x[p] = v.x, before.v.y[p] = v.y, before.v.z[p] = v.z;
        engine_->load(before, tears_);
      }
    }
    if (watch_) watch_step(part);
    torn += all.torn;
    t += part.dt;
    left = met && part.dt < left ? begin + preset_.dt - t : 0;
    if (left > 0) engine_->read(before, tears_);
  }
  engine_->set_preset(whole, tears_);
  all.torn = all.steps == 1 ? torn : 0;
  if (all.steps == 1) return all;
  // It diverged or was stopped: nothing of the step counts.
  tears_ = tears_at_start;
  engine_->load(start, tears_);
  return all;
}

}  // namespace tyglab
