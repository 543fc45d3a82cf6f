#include "core/analysis/tolerance.h"

#include <algorithm>
#include <cmath>

#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

std::string number(double value) {
  return short_number(value, 2);
}

std::string settings_of(const ErrorPoint& point) {
  const std::string step =
      point.tolerance > 0 ? "tolerance = " + number(point.tolerance) + " m" : "dt = " + number(point.dt) + " s";
  return point.integrator + ", " + step + ", " + std::string(name_of(point.precision));
}

/// Why there is nothing for the tolerance. Its figures are rounded away from it, so that they never contradict it.
std::string why_refused(const SettingsSearch& search, double tolerance) {
  if (search.margin() * search.agreement_rms_m > tolerance)
    return shortest_number(tolerance) + " m cannot be guaranteed over the first " + number(search.seconds) +
           " s: fine runs (" + search.references + ") differ by " + number(two_digits_above(search.agreement_rms_m)) +
           " m, and a tolerance must be at least " + number(search.margin()) + " times that";
  const ErrorPoint* best = nullptr;
  const double least = least_reliable_error(search, &best);
  return "no method reaches " + shortest_number(tolerance) + " m here with a margin of two" +
         (best != nullptr ? "; the best was " + settings_of(*best) + " with " + number(two_digits_above(least)) + " m"
                          : "") +
         (search.goal.keeps.integrator ? "; more are possible without a fixed method" : "") +
         (search.goal.keeps.precision && search.of.precision == Precision::float_
              ? "; more are possible in double precision"
              : "");
}

}  // namespace

std::string ToleranceChoice::words(double tolerance) const {
  ErrorPoint used = chosen;
  if (used.tolerance == 0) used.dt = preset.dt;
  const std::string within =
      used.tolerance > 0 ? " (with inner steps within dt = " + number(preset.dt) + " s)" : std::string();
  std::string text =
      settings_of(used) + within + ": error " + (chosen.resolved ? "" : "below ") +
      number(chosen.resolved ? chosen.error_rms_m : std::max(chosen.error_rms_m, reference_margin * agreement_rms_m)) +
      " m (rms) over the first " + number(seconds) + " s, where " + number(tolerance) + " m was requested; it takes " +
      number(chosen.cost) + " s of CPU time per simulated second.";
  if (reached.size() > 1)
    text += " The next best is " + settings_of(reached[1]) + ", at " + number(reached[1].cost / chosen.cost) +
            " times that cost.";
  return text + " Errors grow with time, so later results may be less accurate.";
}

std::vector<ErrorPoint> reached_or_refused(const SettingsSearch& search, double tolerance) {
  if (!search.problem.empty()) throw ToleranceError(search.problem, std::nullopt);
  std::vector<ErrorPoint> reached = settings_for(search, tolerance);
  if (!reached.empty()) return reached;
  constexpr double largest = 1;  // m; more says nothing
  const double tightest = tightest_tolerance(search);
  const bool told = tightest <= largest;
  throw ToleranceError(why_refused(search, tolerance) +
                           (told ? ". The tightest tolerance that can be guaranteed is " + number(tightest) + " m"
                                 : ". No tolerance up to 1 m can be guaranteed here"),
                       told ? std::optional(tightest) : std::nullopt);
}

ToleranceChoice choose_for_tolerance(const Preset& preset, const SettingsGoal& goal, const Stop& stop,
                                     const std::function<void(const SettingsSearch&)>& found) {
  const SettingsSearch search = search_settings({preset, std::nullopt}, goal, stop, found);
  std::vector<ErrorPoint> reached = reached_or_refused(search, goal.tolerance);
  const ErrorPoint best = reached.front();
  return {with_setting(preset, best), best, std::move(reached), search.seconds, search.agreement_rms_m};
}

}  // namespace tyglab
