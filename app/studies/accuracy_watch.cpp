#include "app/studies/accuracy_watch.h"

#include <algorithm>
#include <array>

#include "app/ui/app.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr std::array methods{"verlet", "velocity_verlet", "rk4", "dopri5", "implicit_euler", "implicit_midpoint"};
constexpr double settles = 0.3;  // s after the last change of constants
constexpr double again = 4;      // s from one study of a moving cloth to the next
constexpr double enough = 1e-7;  // m
constexpr StudyEffort effort{.reference = 1e8, .point = 3e7};

}  // namespace

Preset moving(Preset preset) {
  preset.mode = 1, preset.texture.clear(), preset.name.clear(), preset.description.clear();
  return preset;
}

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

/// Fills the study in as it goes, so that what is known first is seen first.
void AccuracyWatch::work(Work::Shared& shared, const StudyStart& start) {
  const Stop stop = [&] { return shared.stopped(); };
  try {
    const StudyReference reference = study_reference(start, window, effort, stop);
    const ErrorPoint present = measure_point(start, reference, stop);
    StudyReference shown = reference;
    shown.track.clear();  // not for people, and copied in every frame
    shared.tell([&](AccuracyStudy& study) { study.reference = std::move(shown), study.present = present; });
    for (const char* method : methods) {
      StudyStart other = start;
      other.preset.integrator = method;
      const std::vector<ErrorPoint> ladder = error_ladder(other, reference, enough, effort, stop);
      shared.tell([&](AccuracyStudy& study) { study.points.insert(study.points.end(), ladder.begin(), ladder.end()); });
    }
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    shared.tell([&](AccuracyStudy& study) { study.problem = error.what(); });
  }
  shared.tell([](AccuracyStudy& study) { study.done = true; });
}

void AccuracyWatch::begin(App& app) {
  begun_ = app.ui.now;
  if (const auto& last = work_.shared(); last && last->findings().present) shown_ = last;
  AccuracyStudy first;
  first.of = app.preset(), first.t = app.simulation->time();
  StudyStart start{app.preset(), app.simulation->snapshot()};
  work_.begin(std::move(first), [start = std::move(start)](Work::Shared& shared) { work(shared, start); });
}

void AccuracyWatch::poll(App& app) {
  const auto soon = [&](double wait) { app.ui.draw_by = std::min(app.ui.draw_by, app.ui.now + wait); };
  const std::optional<AccuracyStudy> newest = work_.shared() ? std::optional(work_.shared()->findings()) : std::nullopt;
  const bool changed = newest && moving(newest->of) != moving(app.preset());
  if (changed) {
    work_.stop();
    if (changed_ < 0) changed_ = app.ui.now;
  }
  if (work_.busy()) return soon(0.1);
  if (app.simulation->divergence() || app.simulation->held() || app.building.holds_present()) return;
  if (app.simulation->lattice().size() > largest) return;
  if (changed) {
    if (app.ui.now < std::max(changed_, app.ui.last_change) + settles) return soon(0.1);
  } else if (newest && (newest->t == app.simulation->time() || app.ui.now < begun_ + again)) {
    return;
  }
  changed_ = -1;
  begin(app);
  soon(0.1);
}

}  // namespace tyglab
