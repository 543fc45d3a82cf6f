// Implicit stages: on one thread where a solver goes to the end, on all where each particle solves for itself.
#include "core/engines/cpu/cpu_engine.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
bool CpuEngine<R, Present>::solve_stage(int number, const ResolvedSweep& sweep, const Tears& tears) {
  // A mass on a spring is linear: one step of Newton's method solves it.
  if (scheme_->solver == Solver::blocks && cloth_.preset.kind == Kind::cloth) return descend(number, sweep, tears);
  team_->barrier();  // solving uses all bands, which their threads may still be preparing
  if (number == 0) abandoned_ = !solve(sweep, tears);
  team_->barrier();
  return !abandoned_;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::solve(const ResolvedSweep& sweep, const Tears& tears) {
  for (const auto& band : bands()) band->assign(sweep.before, false);
  const double stage = double(&sweep - sweeps_.data()), stages = double(sweeps_.size());
  const bool solved =
      solver_.solve(cloth_, sweep.position, sweep.velocity, sweep.solve_dt, tears,
                    [&](Field& out) { accelerations(sweep.position, sweep.velocity, tears, out, true); },
                    {repeating_ ? never_ : stop(), [&](double part) { set_step_progress((stage + part) / stages); }},
                    {scheme_->solver, springs_changed(tears)});
  if (solved) accept_springs(tears);
  return solved;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::descend(int number, const ResolvedSweep& sweep, const Tears& tears) {
  const int begin = band_begin(number), end = band_begin(number + 1), passes = cloth_.preset.iterations;
  Field &x = cloth_.vector(sweep.position), &v = cloth_.vector(sweep.velocity);
  bands_[std::size_t(number)]->assign(sweep.before, false);
  team_->barrier();
  if (number == 0) {
    solver_.begin_stage(cloth_, sweep.position, sweep.velocity);
    descent_.prepare(cloth_, tears, sweep.solve_dt, springs_changed(tears));
    accept_springs(tears);
  }
  team_->barrier();
  descent_.begin(x, v, begin, end);
  team_->barrier();
  if (number == 0) descent_.weigh();
  team_->barrier();
  descent_.fall(begin, end);
  for (int n = 0; n < passes; ++n) {
    if (!begin_pass(number, n, sweep, tears)) return false;
    descent_.pass(begin, end, *team_);
  }
  descent_.write_positions(x, begin, end), descent_.write_velocities(v, begin, end);
  team_->barrier();
  if (number == 0)
    solver_.measure_stage(
        sweep.solve_dt, tears, [&](Field& out) { accelerations(sweep.position, sweep.velocity, tears, out, true); },
        {never_, [](double) {}}, passes);
  team_->barrier();
  return true;
}

/// Asks whether to go on, and lets the wind blow on the present positions. Returns false, to all threads, where the
/// step was stopped.
template <class R, unsigned Present>
bool CpuEngine<R, Present>::begin_pass(int number, int pass, const ResolvedSweep& sweep, const Tears& tears) {
  const int begin = band_begin(number), end = band_begin(number + 1);
  const bool blows = (cloth_.features & wind) != 0;
  if (blows) {
    descent_.write_positions(cloth_.vector(sweep.position), begin, end);
    team_->barrier();
  }
  if (number == 0) {
    set_step_progress(double(pass) / cloth_.preset.iterations);
    abandoned_ = !repeating_ && stops();
    ResolvedSweep look;
    look.position = sweep.position, look.velocity = sweep.velocity, look.external = true;
    if (blows) accelerations(look, tears, acceleration_, false);
  }
  team_->barrier();
  if (abandoned_) return false;
  if (blows) descent_.accelerate(cloth_.vector(sweep.velocity), acceleration_, begin, end);
  return true;
}

#define TYGLAB_MAKE(R, present) \
  template bool CpuEngine<R, (present)>::solve_stage(int, const ResolvedSweep&, const Tears&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
