// Steps: bands side by side or in waves, then the work on the whole cloth: tearing and the search for faults.
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/engines/cpu/cpu_engine.h"
#include "core/forces/readout.h"
#include "core/forces/spring-inl.h"
#include "core/simd/row_field.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
StateView<R> CpuEngine<R, Present>::view() const {
  return {cloth_.row(vector_x, 0, 0), cloth_.row(vector_v, 0, 0), cloth_.stride};
}

/// Breaks what is overloaded, and says by how much any other spring may still grow, m.
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_overloaded(Tears& tears) {
  assert(cloth_.preset.F_max > 0);
  double slack = loose_slack(tears);
  for (int d = 0; d < stretch_directions; ++d) {
    const double longest =
        directions[d].rest * cloth_.preset.L + cloth_.preset.F_max / spring_constant(cloth_.preset, directions[d]);
    for (int i = 0; i + directions[d].di < cloth_.lattice.rows; ++i)
      slack = std::min(slack, longest * (1 - rounding<R>)-std::sqrt(tear_row(tears, d, i)));
  }
  return slack;
}

/// Breaks the overloaded springs of a row in one direction; returns the square of the longest one that it leaves and
/// that could break, m². Infinity, and none is broken, if one parts the cloth.
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_row(Tears& tears, int d, int i) {
  assert(d >= 0 && d < stretch_directions);
  const Direction& dir = directions[d];
  const double rest = dir.rest * cloth_.preset.L, k = spring_constant(cloth_.preset, dir);
  const double longest = rest + cloth_.preset.F_max / k;
  const int begin = std::max(0, -dir.dj), end = cloth_.lattice.columns - std::max(0, dir.dj);
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be overloaded.
  const double found = double(simd::longest_squared(cloth_.row(vector_x, i, 0), cloth_.stride,
                                                    dir.di * cloth_.vector(vector_x).pitch() + dir.dj, begin, end));
  if (found <= longest * longest * (1 - rounding<R>)) return found;
  double left = 0;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j) || guarded(i, j) || guarded(i + dir.di, j + dir.dj)) continue;
    const double r2 = distance2(view(), i, j, dir);
    const bool over = HWY_NAMESPACE::stretch_tension(k, rest, r2) > cloth_.preset.F_max;
    if (over && parts(cloth_.preset)) return std::numeric_limits<double>::infinity();
    if (over)
      tears.tear(d, i, j);
    else
      left = std::max(left, r2);
  }
  return left;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::find_fault(Tears& tears, Fault& fault, double& divergence_budget) {
  return tyglab::find_fault(cloth_.preset, cloth_.lattice, tears, view(), fault, divergence_budget);
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::find_runaway(const MotionLimit& limit, Fault& fault) {
  return tyglab::find_runaway(limit, cloth_.lattice, view(), 1 / cloth_.velocity_scale(), fault);
}

template <class R, unsigned Present>
Motion CpuEngine<R, Present>::motion(const Tears& tears) {
  place_next_bodies();
  return motion_of(cloth_.preset, cloth_.lattice, tears, cloth_.bodies.front(), view(), 1 / cloth_.velocity_scale());
}

template <class R, unsigned Present>
StepMeasures CpuEngine<R, Present>::measures(int step) {
  assert(step >= 0 && step < std::max(together_, 1));
  std::span<const std::unique_ptr<Band<R, Present>>> judged = bands();
  if (together_ > 1) judged = std::span(waves_).subspan(std::size_t(step + 1) * sweeps_.size() - 1, 1);
  const bool hand = has(part::hand) && cloth_.held.particle >= 0, projected = projects(*scheme_);
  double largest = 0;
  StepMeasures result;
  for (const auto& band : judged) {
    largest = std::max(largest, band->max_displacement());
    result.left_inside += band->left_inside();
    if (hand && !projected && band->has_hand()) result.hand_force = share_held() * band->hand_force();
  }
  if (hand && (projected || is_implicit(*scheme_)))
    result.hand_force = result.hand_force.value_or(glm::dvec3(0)) + hand_force_;
  result.elongation = max_elongation(largest), result.dt = cloth_.dt;
  if (step_limit() > 0 && can_end_early(*scheme_)) result.limited_seconds = step_seconds();
  const Balance balance = solves_damping(*scheme_) ? damping_balance() : solver_.solved();
  result.residual = balance.residual, result.converged = balance.solved, result.rounded = balance.rounded;
  return result;
}

/// What the solution for the damping lacks is a force that is missing.
template <class R, unsigned Present>
Balance CpuEngine<R, Present>::damping_balance() const {
  const auto [solution, lacking] = constant_.size();
  if (lacking == 0) return {true, 0};
  const Preset& p = cloth_.preset;
  const double square = p.dt * p.dt;
  return judge({.left = square * lacking,
                .largest = square * (solution + lacking),
                .weight = weight_scale(p.g, p.dt),
                .digits = 0,
                .weightless = p.g == 0},
               balance_tolerance<R>);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::step_in_bands(int number, const Tears& tears) {
  Band<R, Present>& band = *bands_[std::size_t(number)];
  band.reset_watch();
  if (number == 0) solver_.begin_step(), begin_limit(), begin_self(tears);
  for (const ResolvedSweep& sweep : sweeps_) {
    const bool last = &sweep == &sweeps_.back();
    if (sweep.projects) {
      if (!project(number, sweep, tears, last)) return;
      continue;
    }
    if (sweep.solve_dt != 0) {
      if (!solve_stage(number, sweep, tears)) return;
      band.assign(sweep.assignments, last);
      team_->barrier();
      continue;
    }
    if (sweep.damps_dt != 0) {
      if (number == 0) prepare_damping(tears), damping_products_ += 2 * constant_.products();
      team_->barrier();
      constant_.solve(cloth_.vector(sweep.velocity), band_begin(number), band_begin(number + 1),
                      [&] { team_->barrier(); });
      band.assign(sweep.assignments, last);
      team_->barrier();
      continue;
    }
    if (number == 0) find_given_force(sweep);
    band.copy_halo(sweep);
    team_->barrier();
    band.sweep(sweep, tears, last);
    team_->barrier();
  }
  if (number == 0) end_self();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::prepare_damping(const Tears& tears) {
  const Preset& p = cloth_.preset;
  assert(solves_damping(*scheme_));
  constexpr double tolerance = sizeof(R) == 8 ? 1e-12 : 1e-6;
  constant_.prepare(cloth_, tears, {scheme_->sweeps.back().damps * p.dt * p.k_d / p.m * SpringConstants{1, 1, 1, 0}},
                    tolerance, springs_changed(tears), ConstantSolver<R>::Beyond::factorizes);
  accept_springs(tears);
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::project(int number, const ResolvedSweep& sweep, const Tears& tears, bool last) {
  const int begin = band_begin(number), end = band_begin(number + 1);
  if (number == 0) projector_.prepare(cloth_, tears, springs_changed(tears)), accept_springs(tears);
  team_->barrier();
  const int iterations = cloth_.preset.iterations;
  const bool finished = projector_.project(cloth_, sweep.velocity, begin, end, *team_, [&](int n) {
    set_step_progress(double(n) / iterations);
    return repeating_ || !stops_within_steps() || !stops();
  });
  if (!finished) {
    if (number == 0) abandoned_ = true;
    return false;
  }
  bands_[std::size_t(number)]->assign(sweep.assignments, last);
  team_->barrier();
  projector_.damp(cloth_, begin, end, *team_);
  if (number == 0 && has(part::hand) && cloth_.held.particle >= 0) read_hand(tears);
  return true;
}

/// The springs' part of the force on the held particle is in no sweep of a method that projects.
template <class R, unsigned Present>
void CpuEngine<R, Present>::read_hand(const Tears& tears) {
  const int i = cloth_.held.particle / cloth_.lattice.columns, j = cloth_.held.particle % cloth_.lattice.columns;
  assert(cloth_.lattice.contains(i, j));
  constexpr int reach = 2;
  Neighborhood near(i, j);
  for (int ni = std::max(i - reach, 0); ni <= std::min(i + reach, cloth_.lattice.rows - 1); ++ni)
    for (int nj = std::max(j - reach, 0); nj <= std::min(j + reach, cloth_.lattice.columns - 1); ++nj) {
      const StoredParticle particle = stored(ni, nj);
      near.x(ni, nj) = particle.x, near.v(ni, nj) = particle.v;
    }
  const ParticleForces forces = forces_on_particle(cloth_.preset, tears, near, i, j);
  hand_force_ = forces.F_int() + forces.F_ext();
  if (cloth_.near_force != nullptr) hand_force_ += self_->F[std::size_t(cloth_.held.particle)];
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::steps_in_wave(int left) const {
  const int most = std::min(left, wave_steps_);
  const bool hand = has(part::hand) && cloth_.held.particle >= 0 && cloth_.preset.F_release > 0;
  return most <= 1 || hand || !loose_.particles.empty() ? 1 : guard_.steps_ahead(most);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::step_in_waves(int number, int steps, const Tears& tears) {
  constexpr int behind = 2;  // rows: a pair reads the two rows below it, which the sweep before has left
  const int rows = cloth_.lattice.rows, sweeps = int(sweeps_.size()), all = steps * sweeps, threads = team_->size();
  const int first = all * number / threads, end = all * (number + 1) / threads;
  assert(steps > 1 && std::size_t(all) <= waves_.size());
  for (int n = first; n < end; ++n) {
    const ResolvedSweep& sweep = sweeps_[std::size_t(n % sweeps)];
    waves_[std::size_t(n)]->reset_watch();
    waves_[std::size_t(n)]->begin_sweep(sweep, tears, n % sweeps == sweeps - 1, n / sweeps);
  }
  Progress& mine = progress_[std::size_t(number)];
  for (int i = 0; i < rows + behind * (end - first - 1); i += 2) {
    if (number > 0) progress_[std::size_t(number) - 1].wait_for(std::min(i + 2 + behind, rows));
    for (int n = first; n < end; ++n)
      if (const int row = i - behind * (n - first); row >= 0 && row < rows) waves_[std::size_t(n)]->sweep_pair(row);
    if (threads > 1) mine.finished(std::clamp(i - behind * (end - first - 1) + 2, 0, rows));
  }
}

template <class R, unsigned Present>
BatchResult CpuEngine<R, Present>::run_together(int steps, Tears& tears, Fault& fault, bool waves) {
  made_ = {};
  abandoned_ = false;
  assert(steps >= 1);
  const auto plan = [&] {
    int left = made_.end == BatchEnd::complete ? steps - made_.count : 0;
    if (abandoned_ || (left > 0 && !repeating_ && stops())) made_.end = BatchEnd::stopped, left = 0;
    if (left > 0) follow_springs(tears);
    together_ = left > 0 && waves ? steps_in_wave(left) : std::min(left, 1);
    if (together_ > 0 && cloth_.bodies_move) cloth_.bodies = bodies_in(together_);
    for (Progress& progress : progress_) progress.restart();
  };
  const auto judge = [&] {
    const BatchResult judged = guard_.judge(*this, together_, tears, fault);
    made_ = {made_.count + judged.count, judged.end};
    assert(judged.count <= together_ && made_.count <= steps);
  };
  plan();
  if (together_ > 0 && synchronized_ && !scheme_->start.empty()) start(tears);
  team_->run([&](int number) {
    while (together_ > 0) {
      if (together_ > 1) {
        step_in_waves(number, together_, tears);
        team_->barrier();
      } else if (chooses_steps(*scheme_)) {
        step_adaptively(number, tears, fault);
      } else {
        step_in_bands(number, tears);
      }
      if (number == 0) {
        count_steps(together_);
        if (!chooses_steps(*scheme_) && !abandoned_) judge();  // inner steps have been checked
        plan();
      }
      team_->barrier();
    }
  });
  return made_;
}

/// How many of the `left` steps to make before the governor may change the number of threads.
template <class R, unsigned Present>
int CpuEngine<R, Present>::steps_of_run(int left) const {
  assert(left >= 1);
  const int least = std::max(wave_steps_, 1);
  if (forced_threads_) return std::min(least, left);
  if (team_->capacity() == 1) return left;
  const double most = governor_.run_seconds() * steps_per_second_;
  return most < left ? std::min(std::max(least, int(most) / least * least), left) : left;
}

template <class R, unsigned Present>
BatchResult CpuEngine<R, Present>::run(int steps, Tears& tears, Fault& fault, bool waves) {
  using Clock = std::chrono::steady_clock;
  BatchResult all;
  while (all.count < steps && all.end == BatchEnd::complete) {
    crew_->insist(forced_threads_ != nullptr);
    resize_team(forced_threads_ ? forced_threads_() : governor_.threads());
    const std::int64_t evaluations = control_.counts().force_evaluations;
    const auto begin = Clock::now();
    const BatchResult made = run_together(steps_of_run(steps - all.count), tears, fault, waves);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    all = {all.count + made.count, made.end};
    if (made.count == 0) continue;
    steps_per_second_ = made.count / seconds;
    // Inner steps differ in number from step to step.
    governor_.worked(chooses_steps(*scheme_) ? double(control_.counts().force_evaluations - evaluations) : made.count,
                     seconds);
  }
  assert(all.count <= steps);
  return all;
}

template <class R, unsigned Present>
BatchResult CpuEngine<R, Present>::make_steps(int most, Tears& tears, Fault& fault) {
  return run(most, tears, fault, true);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::keep_backup() {
  for (std::size_t n = 0; n < backup_.size(); ++n) backup_[n] = cloth_.vectors[n];
  if (self_ != nullptr) self_->held_back_then = self_->held_back;
  control_backup_ = control_, synchronized_backup_ = synchronized_, step_backup_ = step();
}

/// Without waves, which would overwrite states that are to be examined.
template <class R, unsigned Present>
void CpuEngine<R, Present>::repeat(int steps, Tears& tears) {
  assert(steps >= 0 && !repeating_);
  for (std::size_t n = 0; n < backup_.size(); ++n) cloth_.vectors[n] = backup_[n];
  control_ = control_backup_, knows_first_a_ = false;
  forget_self();
  if (self_ != nullptr) self_->held_back = self_->held_back_then;
  set_synchronized(synchronized_backup_);
  return_to(step_backup_);
  Fault known{};
  repeating_ = true;
  try {
    run(steps, tears, known, false);
  } catch (...) {
    repeating_ = false;
    throw;
  }
  repeating_ = false;
}

template <class R, unsigned Present>
AdvanceResult CpuEngine<R, Present>::advance(int steps, Tears& tears) {
  if (guard_.springs_cut(tears)) restart_control(), guard_.accept_cuts(tears);
  return guard_.advance(*this, steps, tears, stop(), step_limit() > 0);
}

// What the engine's other files need of this one.
#define TYGLAB_MAKE(R, present)                                                    \
  template AdvanceResult CpuEngine<R, (present)>::advance(int, Tears&);            \
  template BatchResult CpuEngine<R, (present)>::make_steps(int, Tears&, Fault&);   \
  template StepMeasures CpuEngine<R, (present)>::measures(int);                    \
  template Balance CpuEngine<R, (present)>::damping_balance() const;               \
  template double CpuEngine<R, (present)>::tear_overloaded(Tears&);                \
  template bool CpuEngine<R, (present)>::find_fault(Tears&, Fault&, double&);      \
  template bool CpuEngine<R, (present)>::find_runaway(const MotionLimit&, Fault&); \
  template Motion CpuEngine<R, (present)>::motion(const Tears&);                   \
  template StateView<R> CpuEngine<R, (present)>::view() const;                     \
  template void CpuEngine<R, (present)>::prepare_damping(const Tears&);            \
  template void CpuEngine<R, (present)>::keep_backup();                            \
  template void CpuEngine<R, (present)>::repeat(int, Tears&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
