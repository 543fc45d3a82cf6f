#include "app/studies/settings_watch.h"

#include <utility>

#include "core/model/effect.h"

namespace tyglab {

void SettingsWatch::drop() {
  work_.drop();
  tolerance_.reset();
  asked_ = stopped_ = false;
}

void SettingsWatch::stop() {
  if (!searching()) return;
  // What another error was asked for before is no answer to this one.
  if (asked_) return drop();
  stopped_ = true;
  work_.cancel();
}

bool SettingsWatch::searching() const {
  if (asked_) return true;
  const auto known = search();
  return known && !known->done && !stopped_;
}

bool SettingsWatch::is_about(const SettingsSearch& search, const Preset& preset) {
  Preset same = preset;
  const Preset& then = search.of;
  same.integrator = then.integrator, same.dt = then.dt, same.precision = then.precision;
  same.tolerance = then.tolerance, same.engine = then.engine, same.device = then.device;
  return changes(then, same).within(motionless);
}

void SettingsWatch::ask(double tolerance, const Preset& preset) {
  tolerance_ = tolerance;
  stopped_ = false;
  const auto known = search();
  asked_ = !known || !known->done || known->goal.tolerance > tolerance || !is_about(*known, preset);
}

void SettingsWatch::poll(StudyMoment& moment) {
  if (work_.working()) moment.ask_again_in(0.1);
  if (!asked_) return;
  // The search of before ends soon, but is not waited for.
  if (work_.working()) work_.cancel();
  if (moment.simulation.divergence() || moment.simulation.held() || !moment.readable || work_.working())
    return moment.ask_again_in(0.1);
  asked_ = false;
  SettingsSearch first;
  first.of = moment.preset(), first.t = moment.simulation.time();
  first.goal = {.tolerance = *tolerance_, .seconds = window, .keeps = {}, .present = true};
  StudyStart start{moment.preset(), moment.simulation.snapshot()};
  const SettingsGoal goal = first.goal;
  work_.begin(std::move(first), [start = std::move(start), goal](Work::Shared& shared, const JobControl& control) {
    try {
      search_settings(
          start, goal, [&] { return control.cancelled(); },
          [&](const SettingsSearch& now) { shared.update([&](SettingsSearch& search) { search = now; }); });
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
      shared.update([&](SettingsSearch& search) { search.problem = error.what(), search.done = true; });
    }
  });
  moment.ask_again_in(0.1);
}

}  // namespace tyglab
