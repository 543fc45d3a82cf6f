#include "app/studies/convergence_watch.h"

#include <algorithm>

#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr double calm = 0.3;  // s after the last change of constants
constexpr StudyEffort convergence_effort{.reference = 2e8, .point = 1e8};

}  // namespace

void ConvergenceWatch::drop() {
  work_.drop();
  changed_ = -1;
}

std::optional<Convergence> ConvergenceWatch::study() const {
  return work_.shared() ? std::optional(work_.shared()->findings()) : std::nullopt;
}

void ConvergenceWatch::begin(App& app) {
  drop();
  Convergence first;
  first.of = app.preset(), first.t = app.simulation->time();
  StudyStart start{app.preset(), app.simulation->snapshot()};
  work_.begin(std::move(first), [start = std::move(start)](Background<Convergence>::Shared& shared) {
    try {
      measure_convergence(
          start, window, convergence_effort, [&] { return shared.stopped(); },
          [&](const Convergence& now) { shared.tell([&](Convergence& study) { study = now; }); });
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
      shared.tell([&](Convergence& study) { study.problem = error.what(), study.done = true; });
    }
  });
}

void ConvergenceWatch::poll(App& app) {
  const auto soon = [&](double wait) { app.ui.draw_by = std::min(app.ui.draw_by, app.ui.now + wait); };
  const auto known = study();
  const bool changed = known && moving(known->of) != moving(app.preset());
  if (changed) {
    work_.stop();
    if (changed_ < 0) changed_ = app.ui.now;
  }
  if (work_.busy()) return soon(0.1);
  if (known && !changed) return;
  if (app.simulation->divergence() || app.simulation->held() || app.building.holds_present()) return;
  if (changed && app.ui.now < std::max(changed_, app.ui.last_change) + calm) return soon(0.1);
  begin(app);
  soon(0.1);
}

}  // namespace tyglab
