#include "app/studies/accuracy_watch.h"

#include <algorithm>
#include <array>

#include "core/integrators/scheme.h"
#include "core/model/effect.h"

namespace tyglab {
namespace {

constexpr std::array<const char*, AccuracyWatch::methods> compared_methods{
    "verlet", "velocity_verlet", "rk4", "dopri5", "implicit_euler", "implicit_midpoint"};
constexpr double again = 4;      // s from one study of a moving cloth to the next
constexpr double enough = 1e-7;  // m
constexpr StudyEffort effort{.reference = 1e8, .point = 3e7};

}  // namespace

void AccuracyWatch::drop() {
  work_.drop();
  shown_.reset();
  begun_ = -1;
}

std::optional<AccuracyStudy> AccuracyWatch::study() const {
  if (const auto& newest = work_.shared()) {
    const AccuracyStudy study = newest->findings();
    if (study.present || !study.problem.empty() || newest == shown_) return study;
  }
  return shown_ ? std::optional(shown_->findings()) : std::nullopt;
}

std::optional<AccuracyStudy> AccuracyWatch::measuring() const {
  std::optional<AccuracyStudy> newest = work_.findings();
  if (!newest || newest->present || newest->done || !newest->problem.empty()) return std::nullopt;
  return newest;
}

/// Fills the study in as it goes, so that what is known first is seen first.
void AccuracyWatch::work(Work::Shared& shared, const StudyStart& start, const JobControl& control) {
  const Stop stop = [&] { return control.cancelled(); };
  try {
    const StudyReference reference = study_reference(start, window, effort, stop, [&](double seconds, double part) {
      shared.update([&](AccuracyStudy& study) { study.reference.seconds = seconds, study.reference_part = part; });
    });
    const ErrorPoint present = measure_point(start, reference, stop);
    StudyReference shown = reference;
    shown.track.clear();  // not for people, and copied in every frame
    shared.update([&](AccuracyStudy& study) { study.reference = std::move(shown), study.present = present; });
    for (const char* method : compared_methods) {
      StudyStart other = start;
      other.preset.integrator = method;
      const std::vector<ErrorPoint> ladder = error_ladder(other, reference, enough, effort, stop);
      shared.update([&](AccuracyStudy& study) {
        study.points.insert(study.points.end(), ladder.begin(), ladder.end());
        ++study.methods_done;
      });
    }
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    shared.update([&](AccuracyStudy& study) { study.problem = error.what(); });
  }
  shared.update([](AccuracyStudy& study) { study.done = true; });
}

void AccuracyWatch::begin(StudyMoment& moment) {
  begun_ = moment.now;
  if (const auto& last = work_.shared(); last && last->findings().present) shown_ = last;
  AccuracyStudy first;
  first.of = moment.preset(), first.at = moment.mark();
  StudyStart start{moment.preset(), moment.simulation.snapshot()};
  work_.begin(std::move(first), [start = std::move(start)](Work::Shared& shared, const JobControl& control) {
    work(shared, start, control);
  });
}

void AccuracyWatch::poll(StudyMoment& moment) {
  const std::optional<AccuracyStudy> newest = work_.findings();
  const bool moved = newest && newest->at != moment.mark();
  // A cloth that moves is somewhere else when a study ends: it says of a moment gone by how accurate the motion was.
  const bool changed =
      newest && (!changes(newest->of, moment.preset()).within(motionless) || (moved && !moment.moving));
  if (changed) {
    work_.cancel();
    if (changed_ < 0) changed_ = moment.now;
  } else {
    changed_ = -1;
  }
  if (work_.working()) return moment.ask_again_in(0.1);
  const Simulation& simulation = moment.simulation;
  if (simulation.divergence() || simulation.held() || !moment.readable) return;
  if (simulation.lattice().size() > largest) return;
  if (changed) {
    if (!moment.settled(changed_)) return moment.ask_again_in(0.1);
  } else if (newest && (!moved || moment.now < begun_ + again)) {
    return;
  }
  changed_ = -1;
  begin(moment);
  moment.ask_again_in(0.1);
}

}  // namespace tyglab
