// Stepping: bands side by side, then what needs the whole cloth: tearing, the hand's release, the watch for divergence.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/engines/cpu/cpu_engine.h"
#include "core/forces/readout.h"
#include "core/forces/spring-inl.h"
#include "core/simd/row_distances.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
StateView<R> CpuEngine<R, Present>::view() const {
  return {cloth_.row(vector_x, 0, 0), cloth_.row(vector_v, 0, 0), cloth_.stride};
}

/// Breaks what is overloaded, and says by how much any other spring may still grow, m.
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_overloaded(Tears& tears) {
  double slack = std::numeric_limits<double>::infinity();
  for (int d = 0; d < stretch_directions; ++d) {
    const double longest = directions[d].rest * cloth_.preset.L + cloth_.preset.F_max / cloth_.preset.k_s;
    for (int i = 0; i + directions[d].di < cloth_.lattice.rows; ++i)
      slack = std::min(slack, longest * (1 - rounding<R>)-std::sqrt(tear_row(tears, d, i)));
  }
  return slack;
}

/// Breaks the overloaded springs of a row in one direction; returns the square of the longest one that it leaves and
/// that could break, m².
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_row(Tears& tears, int d, int i) {
  const Direction& dir = directions[d];
  const double rest = dir.rest * cloth_.preset.L, longest = rest + cloth_.preset.F_max / cloth_.preset.k_s;
  const int begin = std::max(0, -dir.dj), end = cloth_.lattice.columns - std::max(0, dir.dj);
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be overloaded.
  const double found = double(longest_squared(cloth_.row(vector_x, i, 0), cloth_.stride,
                                              dir.di * cloth_.vector(vector_x).pitch() + dir.dj, begin, end));
  if (found <= longest * longest * (1 - rounding<R>)) return found;
  double left = 0;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j) || guarded(i, j) || guarded(i + dir.di, j + dir.dj)) continue;
    const double r2 = distance2(view(), i, j, dir);
    if (HWY_NAMESPACE::stretch_tension(cloth_.preset.k_s, rest, r2) > cloth_.preset.F_max)
      tears.tear(d, i, j);
    else
      left = std::max(left, r2);
  }
  return left;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::find_fault(const Tears& tears, Fault& fault) {
  return tyglab::find_fault(cloth_.preset, cloth_.lattice, tears, view(), fault, divergence_budget_);
}

/// Ends a step on one thread: says whether to go on.
template <class R, unsigned Present>
typename CpuEngine<R, Present>::End CpuEngine<R, Present>::finish_step(
    std::span<const std::unique_ptr<Band<R, Present>>> bands, Tears& tears, Fault& fault) {
  const Preset& preset = cloth_.preset;
  double largest = 0;
  left_inside_ = 0;
  for (const auto& band : bands) {
    largest = std::max(largest, band->max_displacement());
    left_inside_ += band->left_inside();
    if (has(part::hand) && band->has_hand() && !projects(*scheme_)) hand_force_ = band->hand_force();
  }
  growth_ = max_elongation(largest);
  if (tears_watched()) {
    tear_budget_ -= growth_;
    if (!(tear_budget_ > 0)) tear_budget_ = tear_overloaded(tears);
  }
  divergence_budget_ -= growth_;
  if (!(divergence_budget_ > 0) && find_fault(tears, fault)) return End::fault;
  if (has(part::hand) && cloth_.held.particle >= 0 && preset.F_release > 0 &&
      glm::length(hand_force_) > preset.F_release)
    return End::released;
  return End::none;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::step_in_bands(int number, const Tears& tears) {
  Band<R, Present>& band = *bands_[std::size_t(number)];
  band.begin_watch();
  for (const ResolvedSweep& sweep : sweeps_) {
    const bool last = &sweep == &sweeps_.back();
    if (sweep.projects) {
      project(number, sweep, tears, last);
      continue;
    }
    if (sweep.solve_dt != 0) {
      if (number == 0) solve(sweep, tears);
      team_->barrier();
      band.assign(sweep.assignments, last);
      team_->barrier();
      continue;
    }
    band.copy_halo(sweep);
    team_->barrier();
    band.sweep(sweep, tears, last);
    team_->barrier();
  }
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::project(int number, const ResolvedSweep& sweep, const Tears& tears, bool last) {
  const int begin = band_begin(number), end = band_begin(number + 1);
  if (number == 0) {
    projector_.prepare(cloth_, tears, springs_changed_ || projected_torn_ != tears.torn_count());
    springs_changed_ = false, projected_torn_ = tears.torn_count();
  }
  team_->barrier();
  projector_.project(cloth_, sweep.velocity, begin, end, *team_);
  bands_[std::size_t(number)]->assign(sweep.assignments, last);
  team_->barrier();
  projector_.damp(cloth_, begin, end, *team_);
  if (number == 0 && has(part::hand) && cloth_.held.particle >= 0) read_hand(tears);
}

/// The springs' part of the force on the held particle is in no sweep of a method that projects.
template <class R, unsigned Present>
void CpuEngine<R, Present>::read_hand(const Tears& tears) {
  const int i = cloth_.held.particle / cloth_.lattice.columns, j = cloth_.held.particle % cloth_.lattice.columns;
  constexpr int reach = 2;
  Neighbourhood near(i, j);
  for (int ni = std::max(i - reach, 0); ni <= std::min(i + reach, cloth_.lattice.rows - 1); ++ni)
    for (int nj = std::max(j - reach, 0); nj <= std::min(j + reach, cloth_.lattice.columns - 1); ++nj) {
      const StoredParticle particle = stored(ni, nj);
      near.x(ni, nj) = particle.x, near.v(ni, nj) = particle.v;
    }
  const ParticleForces forces = forces_on_particle(cloth_.preset, tears, near, i, j);
  hand_force_ = forces.F_int() + forces.F_ext();
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::steps_in_wave(int left) const {
  const int most = std::min(left, wave_steps_);
  const bool hand = has(part::hand) && cloth_.held.particle >= 0 && cloth_.preset.F_release > 0;
  const double motion = tears_watched() ? std::min(divergence_budget_, tear_budget_) : divergence_budget_;
  if (most <= 1 || hand || !(motion > 0)) return 1;
  constexpr double margin = 2;  // motion does not double within a wave, unless something is going wrong
  return int(std::clamp(motion / (margin * growth_), 1.0, double(most)));
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::step_in_waves(int number, int steps, const Tears& tears) {
  constexpr int behind = 2;  // rows: a pair reads the two rows below it, which the sweep before has left
  const int rows = cloth_.lattice.rows, sweeps = int(sweeps_.size()), all = steps * sweeps, threads = team_->size();
  const int first = all * number / threads, end = all * (number + 1) / threads;
  for (int n = first; n < end; ++n) {
    const ResolvedSweep& sweep = sweeps_[std::size_t(n % sweeps)];
    waves_[std::size_t(n)]->begin_watch();
    waves_[std::size_t(n)]->begin_sweep(sweep, tears, n % sweeps == sweeps - 1);
  }
  Progress& mine = progress_[std::size_t(number)];
  for (int i = 0; i < rows + behind * (end - first - 1); i += 2) {
    if (number > 0) progress_[std::size_t(number) - 1].wait_for(std::min(i + 2 + behind, rows));
    for (int n = first; n < end; ++n)
      if (const int row = i - behind * (n - first); row >= 0 && row < rows) waves_[std::size_t(n)]->sweep_pair(row);
    if (threads > 1) mine.finished(std::clamp(i - behind * (end - first - 1) + 2, 0, rows));
  }
}

/// Returns the steps without fault.
template <class R, unsigned Present>
int CpuEngine<R, Present>::finish_wave(int steps, Tears& tears, Fault& fault) {
  const std::size_t sweeps = sweeps_.size();
  for (int n = 0; n < steps; ++n) {
    const std::span last(&waves_[std::size_t(n + 1) * sweeps - 1], 1);
    const double growth = max_elongation(last[0]->max_displacement());
    const bool look = !(divergence_budget_ - growth > 0) || (tears_watched() && !(tear_budget_ - growth > 0));
    if (look && n < steps - 1) {
      end_ = End::rolled_back;  // its positions are gone
      return n;
    }
    end_ = finish_step(last, tears, fault);
  }
  return end_ == End::fault ? steps - 1 : steps;
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::run_together(int steps, Tears& tears, Fault& fault, bool waves) {
  int done = 0, together = 1;
  const auto plan = [&] {
    together = end_ != End::none || done == steps ? 0 : waves ? steps_in_wave(steps - done) : 1;
    for (Progress& progress : progress_) progress.restart();
  };
  plan();
  team_->run([&](int number) {
    while (together > 0) {
      if (together > 1) {
        step_in_waves(number, together, tears);
        team_->barrier();
        if (number == 0) done += finish_wave(together, tears, fault);
      } else if (chooses_steps(*scheme_)) {
        step_adaptively(number, tears, fault);
        if (number == 0 && end_ != End::fault) ++done;
      } else {
        step_in_bands(number, tears);
        if (number == 0) {
          end_ = finish_step(bands(), tears, fault);
          if (end_ != End::fault) ++done;
        }
      }
      if (number == 0) plan();
      team_->barrier();
    }
  });
  return done;
}

/// How many of the `left` steps to make before the governor may change the number of threads.
template <class R, unsigned Present>
int CpuEngine<R, Present>::steps_of_run(int left) const {
  const int least = std::max(wave_steps_, 1);
  if (forced_threads_) return std::min(least, left);
  if (team_->capacity() == 1) return left;
  const double most = governor_.run_seconds() * steps_per_second_;
  return most < left ? std::min(std::max(least, int(most) / least * least), left) : left;
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::run(int steps, Tears& tears, Fault& fault, bool waves) {
  using Clock = std::chrono::steady_clock;
  end_ = End::none;
  int done = 0;
  while (done < steps && end_ == End::none) {
    resize_team(forced_threads_ ? forced_threads_() : governor_.threads());
    const std::int64_t evaluations = control_.counts().force_evaluations;
    const auto begin = Clock::now();
    const int made = run_together(steps_of_run(steps - done), tears, fault, waves);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    done += made;
    if (made == 0) continue;
    steps_per_second_ = made / seconds;
    // Inner steps differ in number from step to step.
    governor_.worked(chooses_steps(*scheme_) ? double(control_.counts().force_evaluations - evaluations) : made,
                     seconds);
  }
  return done;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::keep_backup(const Tears& tears) {
  for (std::size_t n = 0; n < backup_.size(); ++n) backup_[n] = cloth_.vectors[n];
  control_backup_ = control_;
  if (tears_watched()) tears_backup_ = tears;
  since_backup_ = 0;
}

/// The sweep works in place: return to the backup and repeat that many good steps, which gives the same bits.
template <class R, unsigned Present>
void CpuEngine<R, Present>::repeat(int steps, Tears& tears) {
  for (std::size_t n = 0; n < backup_.size(); ++n) cloth_.vectors[n] = backup_[n];
  control_ = control_backup_, knows_first_a_ = false;
  if (tears_watched()) tears = tears_backup_;
  invalidate_budgets();
  Fault none{};
  const End end = end_;
  run(steps, tears, none, false);
  invalidate_budgets();
  end_ = end;
}

template <class R, unsigned Present>
Advance CpuEngine<R, Present>::advance(int steps, Tears& tears) {
  Advance result;
  const int torn_before = tears.torn_count();
  Fault fault{};
  while (result.steps < steps && !result.diverged && !result.released) {
    if (torn_ != tears.torn_count()) restart_control();  // cut from outside
    if (since_backup_ < 0 || since_backup_ >= steps_between_backups || torn_ != tears.torn_count()) keep_backup(tears);
    const int before = since_backup_, batch = std::min(steps - result.steps, steps_between_backups - before);
    int done = run(batch, tears, fault, true);
    if (end_ == End::rolled_back) {
      repeat(before, tears);
      done = run(batch, tears, fault, false);
    }
    result.diverged = end_ == End::fault;
    result.released = end_ == End::released;
    if (result.diverged) repeat(before + done, tears);
    result.steps += done;
    since_backup_ =
        is_implicit(*scheme_) || chooses_steps(*scheme_) ? -1 : before + done;  // such steps cost more than a copy
    torn_ = tears.torn_count();
  }
  result.i = fault.i, result.j = fault.j, result.di = fault.di, result.dj = fault.dj, result.value = fault.value;
  if (result.diverged) result.quantity = fault.quantity;
  result.torn = tears.torn_count() - torn_before;
  result.left_inside = left_inside_;
  result.hand_force = has(part::hand) && cloth_.held.particle >= 0 ? hand_force_ : glm::dvec3(0);
  return result;
}

// What cpu_engine.cpp, where the class is instantiated, needs of this file.
#define TYGLAB_MAKE(R, present) template Advance CpuEngine<R, (present)>::advance(int, Tears&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
