// Stepping on a device: steps are queued in batches, and judged by what they report. A batch is as long as the motion
// left before the next look at the springs lasts with a margin; if a step in it was faster than that, the engine
// returns to its backup and makes the steps up to that one again, which gives the same bits.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/engines/opencl/arguments.h"
#include "core/engines/opencl/opencl_engine.h"

namespace tyglab::opencl {

template <class R>
void OpenClEngine<R>::enqueue_tear(int slot) {
  const auto set = [&](auto exact) {
    using B = decltype(exact);
    const double straight = directions[0].rest * preset_.L, diagonal = directions[2].rest * preset_.L;
    const double F_over_k = preset_.F_max / preset_.k_s;
    const auto certain = [&](double rest) { return R(std::pow(rest + F_over_k, 2) * (1 - rounding<R>)); };
    const cl_mem x = state_.vector(vector_x), springs = state_.springs(), guards = guards_.get(),
                 reports = reports_.get();
    set_arguments(kernels_.tear, 0, x, springs, guards, reports, cl_int(slot), cl_int(state_.stride()),
                  cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns), B(preset_.k_s),
                  B(straight), B(diagonal), B(preset_.F_max), certain(straight), certain(diagonal));
  };
  device_->facts().fp64 ? set(double()) : set(float());
  constexpr int of_card = 32;  // work-items a row
  launch_rows(kernels_.tear, width_ == 1 ? of_card : 1);
  const cl_mem from = state_.springs(), to = state_.masks(), reports = reports_.get();
  set_arguments(kernels_.derive_masks, 0, from, to, reports, cl_int(slot), cl_int(state_.mask_pitch()),
                cl_int(lattice_.rows), cl_int(lattice_.columns));
  launch_rows(kernels_.derive_masks, lattice_.columns);
}

template <class R>
void OpenClEngine<R>::make_steps(int count, bool tear_each) {
  state_.take_back();
  const cl_uint zero = 0;
  const std::size_t bytes = std::size_t(count) * sizeof(StepReport);
  check(clEnqueueFillBuffer(device_->queue(), reports_.get(), &zero, sizeof zero, 0, bytes, 0, nullptr, nullptr),
        "clearing a buffer");
  const int most = tear_each ? 1 : levels_;
  for (int n = 0, levels = 1; n < count; n += levels) {
    levels = std::min(most, count - n);
    for (std::size_t p = 0; p < resolved_.size(); ++p)
      if (resolved_[p].work == Work::solution)
        solve(resolved_[p], n);
      else
        enqueue_sweep(kernels_.passes[p], resolved_[p], n, levels);
    if (tear_each) enqueue_tear(n);
    if (n == 0) check(clFlush(device_->queue()), "starting a step");
  }
  report_.resize(std::size_t(count));
  check(clEnqueueReadBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, bytes, report_.data(), 0, nullptr, nullptr),
        "making a step");
  if (!noted_run_) device_->note_run(program_name(preset_, options_)), noted_run_ = true;
  if (held_.particle < 0) return;
  hand_forces_.resize(4 * std::size_t(count));
  check(clEnqueueReadBuffer(device_->queue(), hand_.get(), CL_TRUE, 0, hand_forces_.size() * sizeof(R),
                            hand_forces_.data(), 0, nullptr, nullptr),
        "making a step");
}

template <class R>
int OpenClEngine<R>::steps_in_batch(int left) const {
  const double motion =
      tears_watched() && !tears_often_ ? std::min(divergence_budget_, tear_budget_) : divergence_budget_;
  if (!(motion > 0) || solver_) return 1;  // to solve is to wait anyway
  constexpr double margin = 2;             // motion does not double within a batch, unless something is going wrong
  return int(std::clamp(motion / (margin * growth_), 1.0, double(left)));
}

template <class R>
bool OpenClEngine<R>::releases(int step) const {
  if (held_.particle < 0 || !(preset_.F_release > 0)) return false;
  const R* f = hand_forces_.data() + 4 * std::size_t(step);
  return glm::length(glm::dvec3(f[0], f[1], f[2])) > preset_.F_release;
}

/// How much any spring may grow before one can be overloaded, m.
template <class R>
double OpenClEngine<R>::tear_slack(const StepReport& report) const {
  const auto left = [&](double rest, float longest2) {
    const double longest = rest * preset_.L + preset_.F_max / preset_.k_s;
    return longest * (1 - rounding<R>)-std::sqrt(double(longest2));
  };
  return std::min(left(directions[0].rest, report.straight), left(directions[2].rest, report.diagonal));
}

/// What is reported into the first slot, which a batch has been read of.
template <class R>
template <class Look>
StepReport OpenClEngine<R>::look_at_springs(const Look& look) {
  const StepReport nothing{};
  check(
      clEnqueueWriteBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, sizeof nothing, &nothing, 0, nullptr, nullptr),
      "writing to the device");
  look();
  StepReport report;
  check(clEnqueueReadBuffer(device_->queue(), reports_.get(), CL_TRUE, 0, sizeof report, &report, 0, nullptr, nullptr),
        "looking at the springs");
  return report;
}

/// Breaks what is overloaded now.
template <class R>
void OpenClEngine<R>::tear_overloaded(Tears& tears) {
  const StepReport report = look_at_springs([&] { enqueue_tear(0); });
  tear_budget_ = tear_slack(report);
  if (report.torn != 0) state_.download(tears);
}

template <class R>
bool OpenClEngine<R>::finds_fault(const Tears& tears, Fault& fault) {
  if (remote() && preset_.kind == Kind::cloth && well_on_device()) return false;
  const StateView<R> now{state_.host(vector_x), state_.host(vector_v), state_.stride()};
  return find_fault(preset_, lattice_, tears, now, fault, divergence_budget_);
}

template <class R>
bool OpenClEngine<R>::well_on_device() {
  const StepReport report = look_at_springs([&] {
    const cl_mem x = state_.vector(vector_x), v = state_.vector(vector_v), masks = state_.masks(),
                 reports = reports_.get();
    set_arguments(kernels_.look, 0, x, v, masks, reports, cl_int(0), cl_int(state_.stride()),
                  cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns));
    launch_rows(kernels_.look, 32);
  });
  divergence_budget_ = growth_left<R>(preset_, {report.straight, report.diagonal, report.bending});
  return report.bad == 0 && divergence_budget_ > 0;
}

template <class R>
int OpenClEngine<R>::judge(int count, bool tear_each, Tears& tears, Fault& fault) {
  end_ = End::none;
  bool torn = false;
  for (int n = 0; n < count; ++n) {
    const StepReport& report = report_[std::size_t(n)];
    growth_ = std::isfinite(report.way) ? max_elongation(report.way) : std::numeric_limits<double>::infinity();
    divergence_budget_ -= growth_, tear_budget_ -= growth_;
    if (tear_each) tear_budget_ = tear_slack(report), torn |= report.torn != 0;
    left_inside_ = int(report.left_inside);
    const bool tear = tears_watched() && !tear_each && !(tear_budget_ > 0), look = !(divergence_budget_ > 0);
    if (!tear && !look && !releases(n)) continue;
    if (n < count - 1) {
      end_ = End::rolled_back;
      return n + 1;
    }
    if (tear) tear_overloaded(tears);
    if (tear_each && torn) state_.download(tears), torn = false;  // what has been torn is no fault
    if (look && finds_fault(tears, fault)) {
      end_ = End::fault;
      return n;
    }
    if (releases(n)) end_ = End::released;
  }
  if (tear_each && torn) state_.download(tears);
  if (held_.particle >= 0) {
    const R* f = hand_forces_.data() + 4 * std::size_t(count - 1);
    hand_force_ = {f[0], f[1], f[2]};
  }
  return count;
}

template <class R>
void OpenClEngine<R>::keep_backup(const Tears& tears) {
  state_.keep_backup();
  if (tears_watched()) tears_backup_ = tears;
  since_backup_ = 0;
}

/// Returns to the backup and makes that many steps again. Springs are looked at in each, since one may have been torn
/// in any of them.
template <class R>
void OpenClEngine<R>::repeat(int steps, Tears& tears) {
  const bool watched = tears_watched();
  state_.restore();
  if (watched) {
    tears = tears_backup_;
    upload_masks(tears);
  }
  if (steps > 0) make_steps(steps, watched);
  if (watched) state_.download(tears);
}

template <class R>
Advance OpenClEngine<R>::advance(int steps, Tears& tears) {
  Advance result;
  const int torn_before = tears.torn_count();
  Fault fault{};
  state_.take_back();
  take_changes(tears);
  while (result.steps < steps && !result.diverged && !result.released) {
    if (since_backup_ < 0 || since_backup_ >= steps_between_backups) keep_backup(tears);
    tears_often_ = tears_watched() && tear_budget_ < 8 * growth_ && growth_ < divergence_budget_;
    const int before = since_backup_;
    const int batch = steps_in_batch(std::min(steps - result.steps, steps_between_backups - before));
    make_steps(batch, tears_often_);
    int done = judge(batch, tears_often_, tears, fault);
    if (end_ == End::rolled_back) {
      repeat(before + done, tears);
      // What is left of the motion was spent by these very steps, of which the last one is looked at.
      report_.assign(1, report_.back());
      if (held_.particle >= 0) hand_forces_.erase(hand_forces_.begin(), hand_forces_.end() - 4);
      divergence_budget_ = tear_budget_ = 0;
      done += judge(1, false, tears, fault) - 1;
    }
    result.diverged = end_ == End::fault;
    result.released = end_ == End::released;
    if (result.diverged) {
      repeat(before + done, tears);
      invalidate_budgets();
    }
    result.steps += done;
    if (since_backup_ >= 0) since_backup_ = before + done;
    torn_ = tears.torn_count();
  }
  if (notes_contacts_ && !report_.empty() && meets_bodies(preset_)) read_contacts(report_.back().contacts);
  result.i = fault.i, result.j = fault.j, result.di = fault.di, result.dj = fault.dj, result.value = fault.value;
  if (result.diverged) result.quantity = fault.quantity;
  result.torn = tears.torn_count() - torn_before;
  result.left_inside = left_inside_;
  result.hand_force = held_.particle >= 0 ? hand_force_ : glm::dvec3(0);
  return result;
}

template <class R>
void OpenClEngine<R>::read_contacts(std::uint32_t count) {
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
