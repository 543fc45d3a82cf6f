
#include "app/studies/studies.h"

#include "app/platform/platform.h"
#include "app/studies/job.h"
#include "core/model/effect.h"

namespace tyglab {

Wants& Wants::operator|=(const Wants& other) {
  for (const auto want : {&Wants::stability, &Wants::accuracy, &Wants::convergence, &Wants::settings,
                          &Wants::settings_kept, &Wants::map, &Wants::crossings, &Wants::verification, &Wants::ledger,
                          &Wants::step, &Wants::forces, &Wants::height, &Wants::copies})
    this->*want |= other.*want;
  return *this;
}

void Studies::update(const Wants& wants, StudyMoment& moment) {
  if (wants.stability) stability.poll(moment);
  wants.accuracy ? accuracy.poll(moment) : accuracy.drop();
  wants.convergence ? convergence.poll(moment) : convergence.drop();
  if (wants.settings)
    settings.poll(moment);
  else if (!wants.settings_kept)
    settings.drop();
  wants.map ? map.poll(moment) : map.drop();
  wants.crossings ? crossings.poll(moment) : crossings.drop();
  wants.verification ? verification.poll(moment) : verification.drop();
}

void DeviceSearch::begin() {
  if (!found_ && !busy()) work_.start(Priority::normal, [](const JobControl&) { return opencl_devices(); });
}

const OpenClInventory* DeviceSearch::found() {
  if (work_.ready()) {
    auto outcome = work_.take();
    auto* inventory = std::get_if<OpenClInventory>(&outcome);
    found_ = inventory != nullptr ? std::move(*inventory) : OpenClInventory{{}, std::get<JobError>(outcome).what};
  }
  return found_ ? &*found_ : nullptr;
}

void EngineSearch::begin(const Preset& preset, int threads) {
  if (busy()) return;
  work_.start(Priority::normal, [preset, threads](const JobControl&) { return choose_engine(preset, threads); });
}

std::optional<std::variant<EngineChoice, JobError>> EngineSearch::take() {
  return work_.ready() ? std::optional(work_.take()) : std::nullopt;
}

namespace {

std::atomic<bool> work_yields = true;

}  // namespace

void let_work_yield(bool yields) {
  work_yields = yields;
}

void run_below_frames() {
  if (work_yields) lower_own_priority();
}

namespace {

constexpr StudyEffort convergence_effort{.reference = 2e8, .point = 1e8};

}  // namespace

void ConvergenceWatch::drop() {
  work_.drop();
  changed_ = -1;
}

std::optional<Convergence> ConvergenceWatch::study() const {
  return work_.findings();
}

void ConvergenceWatch::begin(StudyMoment& moment) {
  drop();
  Convergence first;
  first.of = moment.preset(), first.t = moment.simulation.time();
  StudyStart start{moment.preset(), moment.simulation.snapshot()};
  using Shared = Study<Convergence>::Shared;
  work_.begin(std::move(first), [start = std::move(start)](Shared& shared, const JobControl& control) {
    try {
      measure_convergence(
          start, window, convergence_effort, [&] { return control.cancelled(); },
          [&](const Convergence& now) { shared.update([&](Convergence& study) { study = now; }); });
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
      shared.update([&](Convergence& study) { study.problem = error.what(), study.done = true; });
    }
  });
}

void ConvergenceWatch::poll(StudyMoment& moment) {
  const auto known = study();
  const bool changed = known && !changes(known->of, moment.preset()).within(motionless);
  if (changed) {
    work_.cancel();
    if (changed_ < 0) changed_ = moment.now;
  }
  if (work_.working()) return moment.ask_again_in(0.1);
  if (known && !changed) return;
  if (moment.simulation.divergence() || moment.simulation.held() || !moment.readable) return;
  if (changed && !moment.settled(changed_)) return moment.ask_again_in(0.1);
  begin(moment);
  moment.ask_again_in(0.1);
}

}  // namespace tyglab
