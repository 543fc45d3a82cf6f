#include "app/sandbox/accuracy_watch.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "app/sandbox/app.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr std::array methods{"verlet", "velocity_verlet", "rk4", "dopri5", "implicit_euler", "implicit_midpoint"};
constexpr double settles = 0.3;  // s after the last change of constants
constexpr double again = 4;      // s from one study of a moving cloth to the next
constexpr double enough = 1e-7;  // m
constexpr StudyEffort effort{.reference = 1e8, .point = 3e7};

/// Constants without what no motion depends on.
Preset moving(Preset preset) {
  preset.mode = 1, preset.texture.clear(), preset.name.clear(), preset.description.clear();
  return preset;
}

}  // namespace

bool AccuracyWatch::busy() const {
  return work_.valid() && work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

void AccuracyWatch::drop() {
  if (shared_) shared_->stop = true;
  if (work_.valid()) work_.wait();
  work_ = {};
  shared_.reset(), shown_.reset();
  begun_ = -1;
}

std::optional<AccuracyStudy> AccuracyWatch::study() const {
  for (const auto& of : {shared_, shown_}) {
    if (!of) continue;
    const std::lock_guard lock(of->mutex);
    if (of->study.present || !of->study.problem.empty() || of == shown_) return of->study;
  }
  return std::nullopt;
}

/// Fills the study in as it goes, so that what is known first is seen first.
void AccuracyWatch::work(Shared& shared, const StudyStart& start) {
  setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone: frames come first
  const Stop stop = [&] { return shared.stop.load(); };
  const auto tell = [&](const auto& what) {
    const std::lock_guard lock(shared.mutex);
    what(shared.study);
  };
  try {
    const StudyReference reference = study_reference(start, window, effort, stop);
    const ErrorPoint present = measure_point(start, reference, stop);
    StudyReference shown = reference;
    shown.track.clear();  // not for people, and copied in every frame
    tell([&](AccuracyStudy& study) { study.reference = std::move(shown), study.present = present; });
    for (const char* method : methods) {
      StudyStart other = start;
      other.preset.integrator = method;
      const std::vector<ErrorPoint> ladder = error_ladder(other, reference, enough, effort, stop);
      tell([&](AccuracyStudy& study) { study.points.insert(study.points.end(), ladder.begin(), ladder.end()); });
    }
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    tell([&](AccuracyStudy& study) { study.problem = error.what(); });
  }
  tell([](AccuracyStudy& study) { study.done = true; });
}

void AccuracyWatch::begin(App& app) {
  begun_ = app.ui.now;
  if (shared_ && shared_->study.present) shown_ = shared_;
  shared_ = std::make_shared<Shared>();
  shared_->study.of = app.preset(), shared_->study.t = app.simulation->time();
  StudyStart start{app.preset(), app.simulation->snapshot()};
  work_ = std::async(std::launch::async, [shared = shared_, start = std::move(start)] { work(*shared, start); });
}

void AccuracyWatch::poll(App& app) {
  const auto soon = [&](double wait) { app.ui.draw_by = std::min(app.ui.draw_by, app.ui.now + wait); };
  const bool changed = shared_ && moving(shared_->study.of) != moving(app.preset());
  if (changed) {
    shared_->stop = true;
    if (changed_ < 0) changed_ = app.ui.now;
  }
  if (busy()) return soon(0.1);
  if (app.simulation->divergence() || app.simulation->held() || app.building.holds_present()) return;
  if (app.simulation->lattice().size() > largest) return;
  if (changed) {
    if (app.ui.now < std::max(changed_, app.ui.last_change) + settles) return soon(0.1);
  } else if (shared_ && (shared_->study.t == app.simulation->time() || app.ui.now < begun_ + again)) {
    return;
  }
  changed_ = -1;
  begin(app);
  soon(0.1);
}

}  // namespace tyglab
