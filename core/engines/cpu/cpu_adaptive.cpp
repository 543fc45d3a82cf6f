// Methods that choose their own steps: dt is divided into inner steps, each of which is tried, checked, and then
// accepted or rejected. Threads sweep together; the first one decides between two barriers.
//
// All sweeps of a step write stage vectors, and the last one measures every row as it passes (measure_row). One thread
// decides (core/integrators/step_control.h, plain numbers), and only an accepted step writes x and v, in the pass that
// also handles bodies and the divergence budget.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/engines/cpu/cpu_engine.h"
#include "core/theory/modes.h"

namespace tyglab::cpu {
namespace {

ResolvedEstimate::Share* share_of(ResolvedEstimate& estimate, int vector) {
  const auto it = std::find_if(estimate.shares.begin(), estimate.shares.end(),
                               [&](const ResolvedEstimate::Share& share) { return share.vector == vector; });
  return it == estimate.shares.end() ? nullptr : &*it;
}

}  // namespace

/// The last sweep keeps its a and measures the step; what it assigns besides waits. The first sweep's a may be known.
template <class R, unsigned Present>
void CpuEngine<R, Present>::resolve_estimate() {
  const Estimate& from = *scheme_->estimate;
  estimate_.shares.clear();
  for (const auto* terms : {&from.x, &from.v, &from.stage_x, &from.stage_v, &from.stage_a})
    for (const Term& term : *terms)
      if (share_of(estimate_, term.vector) == nullptr) estimate_.shares.push_back({.vector = term.vector});
  assert(estimate_.shares.size() <= std::size_t(RowEstimate<R>::most_terms));
  scale_estimate();
  auto &first = sweeps_.front().assignments, &last = sweeps_.back().assignments;
  assert(!first.empty() && !last.empty());
  next_stage_.assign(first.begin() + 1, first.end());
  accepting_.assign(last.begin() + 1, last.end());
  last.resize(1);
  sweeps_.back().estimate = &estimate_;
  cloth_.measures.resize(std::size_t(cloth_.lattice.rows));
  resolve_tables();
  if (is_stabilized(*scheme_)) change_dt(cloth_.dt);
}

/// All of them now, so that steps allocate nothing.
template <class R, unsigned Present>
void CpuEngine<R, Present>::resolve_tables() {
  tables_.clear();
  spectrum_ = any_spectrum(cloth_.preset);
  if (!is_stabilized(*scheme_)) return;
  tables_.resize(table_for(*scheme_, spectrum_, cloth_.preset.dt) + 1);
  for (std::size_t n = 1; n < tables_.size(); ++n) {
    for (const Sweep& sweep : scheme_->tables[n].sweeps) tables_[n].push_back(resolve(sweep));
    tables_[n].back().assignments.resize(1);
    tables_[n].back().estimate = &estimate_;
  }
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::scale_estimate() {
  using Share = ResolvedEstimate::Share;
  const auto scale = [&](const std::vector<Term>& terms, double Share::*factor) {
    for (const Term& term : terms) {
      assert(share_of(estimate_, term.vector) != nullptr);
      share_of(estimate_, term.vector)->*factor = term.factor * power(cloth_.dt, term.dt_power);
    }
  };
  const Estimate& from = *scheme_->estimate;
  scale(from.x, &Share::error_x), scale(from.v, &Share::error_v);
  scale(from.stage_x, &Share::stage_x), scale(from.stage_v, &Share::stage_v), scale(from.stage_a, &Share::stage_a);
}

/// Nothing but the terms' factors depends on it, and the number of stages; what the last sweep assigns besides a does
/// not at all.
template <class R, unsigned Present>
void CpuEngine<R, Present>::change_dt(double dt) {
  assert(dt > 0);
  cloth_.dt = dt;
  if (is_stabilized(*scheme_)) {
    sweeps_.swap(tables_[table_]);
    table_ = std::min(table_for(*scheme_, spectrum_, dt), tables_.size() - 1);
    sweeps_.swap(tables_[table_]);
  }
  assert(table().size() == sweeps_.size());
  for (std::size_t n = 0; n < sweeps_.size(); ++n)
    for (std::size_t k = 0; k < sweeps_[n].assignments.size(); ++k)
      scale(table()[n].assignments[k], sweeps_[n].assignments[k]);
  const auto& first = sweeps_.front().assignments;
  assert(next_stage_.size() + 1 == first.size());
  std::copy(first.begin() + 1, first.end(), next_stage_.begin());
  scale_estimate();
}

/// The first step's length, by Hairer's rule; the first a is known then.
template <class R, unsigned Present>
void CpuEngine<R, Present>::begin_control(const Tears& tears) {
  assert(sweeps_.size() >= 2);
  Field &a = cloth_.vector(sweeps_.front().assignments.front().target),
        &changed = cloth_.vector(sweeps_[1].assignments.front().target), &x = cloth_.vector(sweeps_[1].position),
        &v = cloth_.vector(sweeps_[1].velocity);
  const auto largest = [](std::span<const R> values) {
    double most = 0;
    for (const R value : values) most = std::isfinite(value) ? std::max(most, std::abs(double(value))) : most;
    return most;
  };
  accelerations(vector_x, vector_v, tears, a);
  const double largest_v = largest(cloth_.vector(vector_v).all()), largest_a = largest(a.all());
  const double probe = std::min(first_probe(cloth_.preset.L, largest_v, largest_a), cloth_.preset.dt);
  const auto euler = [&](Field& to, const Field& from, const Field& slope) {
    for (int i = 0; i < cloth_.lattice.rows; ++i)
      for (std::ptrdiff_t n = 0; n < to.pitch(); ++n) to.row(i)[n] = from.row(i)[n] + R(probe) * slope.row(i)[n];
  };
  euler(x, cloth_.vector(vector_x), cloth_.vector(vector_v)), euler(v, cloth_.vector(vector_v), a);
  accelerations(sweeps_[1].position, sweeps_[1].velocity, tears, changed);
  double change = 0;
  for (int i = 0; i < cloth_.lattice.rows; ++i)
    for (std::ptrdiff_t n = 0; n < a.pitch(); ++n)
      change = std::max(change, std::abs(double(changed.row(i)[n]) - double(a.row(i)[n])));
  control_.begin(first_step(cloth_.preset.tolerance, largest_v, largest_a, change, probe, scheme_->estimate->order));
  control_.count_evaluations(2);
  knows_first_a_ = true;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::take_next_dt() {
  assert(left_of_dt_ > 0 && left_of_dt_ <= cloth_.preset.dt);
  if (const double next = control_.next(left_of_dt_, cloth_.preset.dt); next != cloth_.dt) change_dt(next);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::begin_interval(const Tears& tears) {
  constexpr double safety = 0.98;  // inner steps may be a hundredth longer than the control wishes
  control_.set_method(scheme_->estimate->order, is_stabilized(*scheme_) ? safety * longest_step(*scheme_, spectrum_)
                                                                        : std::numeric_limits<double>::infinity());
  left_of_dt_ = cloth_.preset.dt;
  for (const Contact& contact : inner_contacts_) inner_contact_of_[std::size_t(contact.particle)] = -1;
  inner_contacts_.clear();
  if (!control_.begun()) begin_control(tears);
  take_next_dt();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::try_inner_step(int number, const Tears& tears) {
  Band<R, Present>& band = *bands_[std::size_t(number)];
  if (number == 0) begin_self(tears);
  for (const ResolvedSweep& sweep : sweeps_) {
    if (&sweep == &sweeps_.front() && knows_first_a_) {
      band.assign(next_stage_, false);
    } else {
      if (number == 0) find_given_force(sweep);
      band.copy_halo(sweep);
      team_->barrier();
      band.sweep(sweep, tears, false);
    }
    team_->barrier();
  }
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::judge_inner_step() {
  assert(cloth_.measures.size() == std::size_t(cloth_.lattice.rows));
  TriedStep tried{.tolerance = cloth_.preset.tolerance};
  StageProducts products;
  double farthest = 0;
  for (const RowMeasures& row : cloth_.measures) {
    tried.error = std::max(tried.error, row.error), farthest = std::max(farthest, row.farthest);
    products.xx += row.xx, products.xv += row.xv, products.vv += row.vv;
    products.xa += row.xa, products.va += row.va;
  }
  tried.last_digit = double(std::numeric_limits<R>::epsilon()) * (std::isfinite(farthest) ? farthest : 0);
  tried.unstable = beyond_stability(*scheme_->estimate, products, cloth_.dt);
  control_.count_evaluations(int(sweeps_.size()) - (knows_first_a_ ? 1 : 0));
  knows_first_a_ = true;
  accepted_ = control_.judge(tried);
  if (accepted_ && cloth_.bodies_move) place_next_bodies();
  if (!accepted_) take_next_dt();
}

/// One entry a particle, however many inner steps touch a body.
template <class R, unsigned Present>
void CpuEngine<R, Present>::add_inner_contacts() {
  inner_contact_of_.resize(std::size_t(cloth_.lattice.size()), -1);
  for (const auto& band : bands())
    for (const Contact& contact : band->contacts()) {
      assert(contact.particle >= 0 && contact.particle < cloth_.lattice.size());
      int& place = inner_contact_of_[std::size_t(contact.particle)];
      if (place < 0) {
        place = int(inner_contacts_.size());
        inner_contacts_.push_back({contact.particle, glm::dvec3(0), glm::dvec3(0)});
      }
      Contact& sum = inner_contacts_[std::size_t(place)];
      sum.x += contact.x, sum.v += contact.v;
    }
}

/// What the end of a step asks for; then the next inner step, or the end of dt.
template <class R, unsigned Present>
void CpuEngine<R, Present>::finish_inner_step(Tears& tears, Fault& fault) {
  assert(accepted_ && !abandoned_);
  const int torn = tears.torn_count();
  if (cloth_.notes_contacts) add_inner_contacts();
  const bool held_back = end_self();
  const BatchEnd end = guard_.judge(*this, 1, tears, fault).end;
  follow_springs(tears);
  if (end != BatchEnd::complete) made_.end = end;
  left_of_dt_ = end == BatchEnd::fault ? 0 : left_of_dt_ - cloth_.dt;
  if (left_of_dt_ <= 0 && made_.end != BatchEnd::fault) ++made_.count;
  // The last a is the next step's first, unless something else than the method has moved the particles or the springs.
  std::swap(cloth_.vector(sweeps_.front().assignments.front().target),
            cloth_.vector(sweeps_.back().assignments.front().target));
  knows_first_a_ = torn == tears.torn_count() && !held_back &&
                   std::none_of(bands().begin(), bands().end(), [](const auto& band) { return band->collided(); });
  if (left_of_dt_ > 0) take_next_dt();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::step_adaptively(int number, Tears& tears, Fault& fault) {
  Band<R, Present>& band = *bands_[std::size_t(number)];
  if (number == 0) begin_interval(tears);
  team_->barrier();
  do {
    try_inner_step(number, tears);
    if (number == 0) {
      judge_inner_step();
      if (!repeating_ && stops()) abandoned_ = true, accepted_ = false, left_of_dt_ = 0;
      set_step_progress(1 - left_of_dt_ / cloth_.preset.dt);
    }
    team_->barrier();
    if (!accepted_) continue;
    band.reset_watch();
    band.assign(accepting_, true);
    team_->barrier();
    if (number == 0) finish_inner_step(tears, fault);
    team_->barrier();
  } while (left_of_dt_ > 0);
}

// What the engine's other files need of this one.
#define TYGLAB_MAKE(R, present)                              \
  template void CpuEngine<R, (present)>::resolve_estimate(); \
  template void CpuEngine<R, (present)>::step_adaptively(int, Tears&, Fault&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
