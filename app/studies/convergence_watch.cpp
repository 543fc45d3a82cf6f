#include "app/studies/convergence_watch.h"

#include "core/model/changes.h"

namespace tyglab {
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
