// Steps on a device: they are queued in batches, as long as the guard expects that none needs examining, and checked by
// their reports.
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "core/engines/opencl/device.h"
#include "core/engines/opencl/opencl_engine.h"
#include "core/forces/force.h"

namespace tyglab::opencl {

template <class R>
void OpenClEngine<R>::enqueue_tear(int slot) {
  assert(slot >= 0 && slot < StepGuard::steps_between_backups);
  assert(tears_watched());
  const auto set = [&](auto exact) {
    using B = decltype(exact);
    const double straight = directions[0].rest * preset_.L, diagonal = directions[2].rest * preset_.L;
    const auto [weft, warp, shear, bend] = spring_constants(preset_);
    const auto certain = [&](double k, double rest) {
      return R(std::pow(rest + preset_.F_max / k, 2) * (1 - rounding<R>));
    };
    const cl_mem x = state_.vector(vector_x), springs = state_.springs(), guards = guards_.get(),
                 reports = reports_.get();
    set_arguments(kernels_.tear, 0, x, springs, guards, reports, cl_int(slot), cl_int(state_.stride()),
                  cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns), B(weft), B(warp),
                  B(shear), B(straight), B(diagonal), B(preset_.F_max), certain(weft, straight),
                  certain(warp, straight), certain(shear, diagonal));
  };
  device_->facts().fp64 ? set(double()) : set(float());
  constexpr int of_card = 32;  // work-items a row
  launch_rows(kernels_.tear, width_ == 1 ? of_card : 1);
  derive(reports_.get(), slot);
}

template <class R>
bool OpenClEngine<R>::run(int count, bool tear_each) {
  assert(count >= 1 && count <= StepGuard::steps_between_backups);  // each has its report
  const auto begun = std::chrono::steady_clock::now();
  state_.end_views();
  if (bodies_move_) upload_bodies(count);
  const cl_uint zero = 0;
  const std::size_t bytes = std::size_t(count) * sizeof(DeviceStepMeasures);
  check(clEnqueueFillBuffer(device_->queue(), reports_.get(), &zero, sizeof zero, 0, bytes, 0, nullptr, nullptr),
        "clearing a buffer");
  if (synchronized_ && !scheme_->start.empty()) start();
  const int most = tear_each ? 1 : levels_;
  for (int n = 0, levels = 1; n < count; n += levels) {
    levels = std::min(most, count - n);
    if (solver_) solver_->begin_step();
    for (std::size_t p = 0; p < resolved_.size(); ++p)
      if (resolved_[p].work != Work::solution)
        enqueue_sweep(kernels_.passes[p], resolved_[p], n, levels);
      else if (!solve(resolved_[p], n))
        return false;
    if (tear_each) enqueue_tear(n);
    if (n == 0) check(clFlush(device_->queue()), "starting a step");
  }
  count_steps(count);
  report_.resize(std::size_t(count));
  check(clEnqueueReadBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, bytes, report_.data(), 0, nullptr, nullptr),
        "making a step");
  seconds_per_step_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() / count;
  if (!noted_run_) device_->note_run(program_name(preset_, options_)), noted_run_ = true;
  if (held_.particle < 0) return true;
  hand_forces_.resize(4 * std::size_t(count));
  check(clEnqueueReadBuffer(device_->queue(), hand_.get(), CL_TRUE, 0, hand_forces_.size() * sizeof(R),
                            hand_forces_.data(), 0, nullptr, nullptr),
        "making a step");
  return true;
}

/// A batch cannot be stopped, so where somebody may want to it is no longer than a person notices.
template <class R>
int OpenClEngine<R>::steps_of_batch(int most) const {
  assert(most >= 1);
  if (solver_) return 1;              // to solve is to wait anyway
  constexpr double unnoticed = 0.03;  // s
  const int batch = guard_.steps_ahead(most, tears_each_);
  return stop() && seconds_per_step_ > 0 ? std::clamp(int(unnoticed / seconds_per_step_), 1, batch) : batch;
}

template <class R>
double OpenClEngine<R>::tear_slack(const DeviceStepMeasures& report) const {
  const auto left = [&](const Direction& to, float longest2) {
    const double longest = to.rest * preset_.L + preset_.F_max / spring_constant(preset_, to);
    return longest * (1 - rounding<R>)-std::sqrt(double(longest2));
  };
  return std::min({left(directions[0], report.straight), left(directions[1], report.bending),
                   left(directions[2], report.diagonal)});
}

/// Reported into the first slot, which has been read after the batch.
template <class R>
template <class Launch>
DeviceStepMeasures OpenClEngine<R>::report_of(const Launch& launch) {
  const DeviceStepMeasures nothing{};
  check(
      clEnqueueWriteBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, sizeof nothing, &nothing, 0, nullptr, nullptr),
      "writing to the device");
  launch();
  DeviceStepMeasures report;
  check(clEnqueueReadBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, sizeof report, &report, 0, nullptr, nullptr),
        "examining the springs");
  return report;
}

template <class R>
void OpenClEngine<R>::read_tears(Tears& tears) {
  if (tears_unread_) state_.download(tears);
  tears_unread_ = false;
}

template <class R>
double OpenClEngine<R>::tear_overloaded(Tears& tears) {
  const DeviceStepMeasures report = report_of([&] { enqueue_tear(0); });
  tears_unread_ |= report.torn != 0;
  read_tears(tears);
  return tear_slack(report);
}

template <class R>
bool OpenClEngine<R>::find_fault(Tears& tears, Fault& fault, double& divergence_budget) {
  read_tears(tears);  // what has been torn is no fault
  if (remote() && preset_.kind == Kind::cloth && well_on_device(divergence_budget)) return false;
  return tyglab::find_fault(preset_, lattice_, tears, view(), fault, divergence_budget);
}

template <class R>
bool OpenClEngine<R>::find_runaway(const MotionLimit& limit, Fault& fault) {
  return tyglab::find_runaway(limit, lattice_, view(), 1 / velocity_scale(), fault);
}

template <class R>
Motion OpenClEngine<R>::motion(const Tears& tears) {
  const auto bodies =
      placed_bodies(preset_.bodies, time_after(0, preset_.dt), preset_.dt, std::numeric_limits<R>::epsilon());
  return motion_of(preset_, lattice_, tears, bodies, view(), 1 / velocity_scale());
}

template <class R>
bool OpenClEngine<R>::well_on_device(double& divergence_budget) {
  const DeviceStepMeasures report = report_of([&] {
    const cl_mem x = state_.vector(vector_x), v = state_.vector(vector_v), masks = state_.masks(),
                 reports = reports_.get();
    set_arguments(kernels_.look, 0, x, v, masks, reports, cl_int(0), cl_int(state_.stride()),
                  cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns));
    launch_rows(kernels_.look, 32);
  });
  divergence_budget = growth_left<R>(preset_, {report.straight, report.diagonal, report.bending});
  return report.bad == 0 && divergence_budget > 0;
}

template <class R>
StepMeasures OpenClEngine<R>::measures(int step) {
  assert(step >= 0 && std::size_t(step) < report_.size());
  assert(held_.particle < 0 || 4 * (std::size_t(step) + 1) <= hand_forces_.size());
  const DeviceStepMeasures& report = report_[std::size_t(step)];
  StepMeasures result;
  result.elongation = max_elongation(report.way), result.dt = preset_.dt;
  result.left_inside = int(report.left_inside);
  if (solver_) {
    const auto [solved, residual, rounded] = solver_->solved();
    result.residual = residual, result.converged = solved, result.rounded = rounded;
  }
  if (tears_each_) result.tear_budget = tear_slack(report), tears_unread_ |= report.torn != 0;
  if (held_.particle >= 0) {
    const R* f = hand_forces_.data() + 4 * std::size_t(step);
    result.hand_force = {f[0], f[1], f[2]};
  }
  return result;
}

template <class R>
BatchResult OpenClEngine<R>::make_steps(int most, Tears& tears, Fault& fault) {
  constexpr int soon = 8;  // steps: where springs must be examined that often, each step had better do so by itself
  tears_each_ = guard_.overload_within(soon);
  const int batch = steps_of_batch(most);
  if (!run(batch, tears_each_)) return {0, BatchEnd::stopped};
  const BatchResult made = guard_.judge(*this, batch, tears, fault);
  read_tears(tears);
  return made;
}

/// Springs are examined in each step, since one may have been torn in any of them.
template <class R>
void OpenClEngine<R>::repeat(int steps, Tears& tears) {
  assert(steps >= 0 && !repeating_);
  const bool watched = tears_watched();
  state_.restore();
  synchronized_ = synchronized_backup_;
  return_to(step_backup_);
  if (watched) upload_masks(tears);
  if (steps > 0) {
    repeating_ = true;
    try {
      run(steps, watched);
    } catch (...) {
      repeating_ = false;
      throw;
    }
    repeating_ = false;
    assert(report_.size() == std::size_t(steps));
    report_.erase(report_.begin(), report_.end() - 1);
    if (held_.particle >= 0) hand_forces_.erase(hand_forces_.begin(), hand_forces_.end() - 4);
  }
  if (watched) state_.download(tears);
  tears_each_ = tears_unread_ = false;
}

template <class R>
AdvanceResult OpenClEngine<R>::advance(int steps, Tears& tears) {
  state_.end_views();
  accept_changes(tears);
  const AdvanceResult result = guard_.advance(*this, steps, tears, stop());
  if (notes_contacts_ && !report_.empty() && meets_bodies(preset_)) read_contacts(report_.back().contacts);
  return result;
}

template <class R>
void OpenClEngine<R>::read_contacts(std::uint32_t count) {
  assert(count <= std::uint32_t(lattice_.size()));  // one a particle
  contacts_.clear();
  const auto take = [&](auto example) {
    std::vector<decltype(example)> list(count);
    if (count == 0) return;
    check(clEnqueueReadBuffer(device_->queue(), contact_list_.get(), CL_TRUE, 0, count * sizeof example, list.data(), 0,
                              nullptr, nullptr),
          "reading from the device");
    for (const auto& c : list) contacts_.push_back({c.particle, {c.x[0], c.x[1], c.x[2]}, {c.v[0], c.v[1], c.v[2]}});
  };
  device_->facts().fp64 ? take(DeviceContact<double>()) : take(DeviceContact<float>());
  // Work-items note them in any order.
  std::sort(contacts_.begin(), contacts_.end(),
            [](const Contact& a, const Contact& b) { return a.particle < b.particle; });
}

template class OpenClEngine<float>;
template class OpenClEngine<double>;

}  // namespace tyglab::opencl
