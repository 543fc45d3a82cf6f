// Implicit stages: one thread leads solvers that run to convergence; all threads share methods in which each particle
// solves for itself.
#include <cassert>
#include <cstddef>

#include "core/engines/cpu/cpu_engine.h"
#include "core/forces/force.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
bool CpuEngine<R, Present>::solve_stage(int number, const ResolvedSweep& sweep, const Tears& tears) {
  // A mass on a spring is linear: one step of Newton's method solves it.
  if (scheme_->solver == Solver::blocks && cloth_.preset.kind == Kind::cloth) {
    bands_[std::size_t(number)]->assign(sweep.before, false);
    team_->barrier();
    return descend(number, sweep, tears);
  }
  team_->barrier();  // solving uses all bands, which their threads may still be preparing
  if (number == 0)
    abandoned_ = !solve(sweep, tears), crew_->dismiss();
  else
    crew_->help(number);
  if (abandoned_ || !solver_.left_to_passes()) return !abandoned_;
  team_->barrier();  // all have seen that before the stage begins again
  return descend(number, sweep, tears);
}

/// The air of an implicit stage, and layers in a method that lags them, as accelerations: at the positions and
/// velocities with which the stage begins. The held particle, which they do not accelerate, feels them too:
/// hand_force_.
template <class R, unsigned Present>
void CpuEngine<R, Present>::begin_lagged(const ResolvedSweep& sweep, const Tears& tears) {
  hand_force_ = {};
  const bool blows = (cloth_.features & air) != 0, lags_layers = self_ != nullptr && lags_contact(*scheme_);
  has_lagged_ = blows || (lags_layers && self_->contact.near());
  if (!has_lagged_) return;
  ResolvedSweep look;
  look.position = sweep.position, look.velocity = sweep.velocity, look.air = ResolvedSweep::Air::alone;
  accelerations_of(look, tears, lagged_, true);
  has_lagged_ = blows || self_->contact.touches();
  if (!has(part::hand) || cloth_.held.particle < 0) return;
  for (const auto& band : bands())
    if (band->has_hand()) hand_force_ = share_held() * band->hand_force();
}

/// Of a stage whose beginning has been looked at: a(x, v) with what is lagged.
template <class R, unsigned Present>
void CpuEngine<R, Present>::stage_accelerations(const ResolvedSweep& sweep, const Tears& tears, Field& out,
                                                bool of_step) {
  ResolvedSweep look;
  look.position = sweep.position, look.velocity = sweep.velocity, look.external = sweep.external;
  look.k_d = cloth_.preset.k_d, look.air = ResolvedSweep::Air::none;
  accelerations_of(look, tears, out, of_step);
  if (!has_lagged_) return;
  for (int i = 0; i < cloth_.lattice.rows; ++i)
    for (std::ptrdiff_t n = 0; n < lagged_.pitch(); ++n) out.row(i)[n] += lagged_.row(i)[n];
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::solve(const ResolvedSweep& sweep, const Tears& tears) {
  assert(&sweep >= sweeps_.data() && &sweep < sweeps_.data() + sweeps_.size());
  for (const auto& band : bands()) band->assign(sweep.before, false);
  begin_lagged(sweep, tears);
  const implicit::Beside* beside = begin_beside();
  const double stage = double(&sweep - sweeps_.data()), stages = double(sweeps_.size());
  const bool solved = solver_.solve(
      cloth_, sweep.position, sweep.velocity, sweep.solve_dt, tears,
      [&](Field& out) { stage_accelerations(sweep, tears, out, true); },
      {repeating_ ? never_ : stop(),
       {can_end_early(*scheme_) ? step_limit() : 0, [&](double part) { return out_of_time((stage + part) / stages); }},
       [&](double part) { set_step_progress((stage + part) / stages); },
       *crew_},
      {scheme_->solver, springs_changed(tears), has_lagged_ ? &lagged_ : nullptr, beside});
  if (self_ != nullptr) self_->solving = false;
  if (solved && scheme_->solver == Solver::alternation) accept_springs(tears);
  return solved;
}

/// Of a method that is not made of them, as many as there is time for.
template <class R, unsigned Present>
int CpuEngine<R, Present>::most_passes() const {
  constexpr int enough = 1000;
  return scheme_->solver == Solver::blocks ? cloth_.preset.iterations : enough;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::descend(int number, const ResolvedSweep& sweep, const Tears& tears) {
  const int begin = band_begin(number), end = band_begin(number + 1), passes = most_passes();
  assert(passes >= 1 && sweep.solve_dt > 0);
  Field &x = cloth_.vector(sweep.position), &v = cloth_.vector(sweep.velocity);
  if (number == 0) {
    solver_.begin_stage(cloth_, sweep.position, sweep.velocity);
    begin_lagged(sweep, tears);
    descent_.prepare(cloth_, tears, sweep.solve_dt, springs_changed(tears));
    accept_springs(tears);
  }
  team_->barrier();
  descent_.begin(x, v, begin, end);
  team_->barrier();
  if (number == 0) descent_.weigh();
  team_->barrier();
  descent_.fall(begin, end);
  int made = 0;
  for (; made < passes; ++made) {
    if (!begin_pass(number, made, sweep, tears)) return false;
    if (late_) break;
    descent_.pass(begin, end, *team_);
  }
  descent_.write_positions(x, begin, end), descent_.write_velocities(v, begin, end);
  team_->barrier();
  if (number == 0)
    solver_.measure_stage(
        sweep.solve_dt, tears, [&](Field& out) { stage_accelerations(sweep, tears, out, true); },
        {never_, {}, [](double) {}, *crew_}, made);
  team_->barrier();
  return true;
}

/// Asks whether to go on, and finds the forces at the present positions of which the descent has no energy. Returns
/// false, to all threads, where the step was stopped.
template <class R, unsigned Present>
bool CpuEngine<R, Present>::begin_pass(int number, int pass, const ResolvedSweep& sweep, const Tears& tears) {
  assert(pass >= 0 && pass < most_passes());
  const int begin = band_begin(number), end = band_begin(number + 1);
  const bool others = (cloth_.features & wind) != 0 || force::curl.on(cloth_.preset) || (pass == 0 && has_lagged_);
  if (others) {
    descent_.write_positions(cloth_.vector(sweep.position), begin, end);
    team_->barrier();
  }
  if (number == 0) {
    set_step_progress(double(pass) / most_passes());
    abandoned_ = !repeating_ && stops();
    late_ = pass > 0 && out_of_time(1);
    if (late_) solver_.note_late();
    ResolvedSweep look;
    look.position = sweep.position, look.velocity = sweep.velocity, look.external = true;
    if (others) stage_accelerations(look, tears, acceleration_, false);
  }
  team_->barrier();
  if (abandoned_) return false;
  if (others) descent_.accelerate(cloth_.vector(sweep.velocity), acceleration_, begin, end);
  return true;
}

#define TYGLAB_MAKE(R, present) \
  template bool CpuEngine<R, (present)>::solve_stage(int, const ResolvedSweep&, const Tears&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
