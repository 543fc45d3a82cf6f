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

/// The usable setting with the least error; null where there is none.
const ErrorPoint* most_accurate(const std::vector<ErrorPoint>& points) {
  const ErrorPoint* least = nullptr;
  for (const ErrorPoint& point : points)
    if (std::isfinite(point.error_rms_m) && (least == nullptr || point.error_rms_m < least->error_rms_m))
      least = &point;
  return least;
}

/// Why there is nothing for the tolerance.
std::string why_refused(const SettingsSearch& search, double tolerance) {
  if (10 * search.agreement_rms_m > tolerance)
    return number(tolerance) + " m cannot be promised over the first " + number(search.seconds) + " s: fine runs (" +
           search.references + ") differ by " + number(search.agreement_rms_m) +
           " m, and must agree to well below the tolerance";
  const ErrorPoint* least = most_accurate(search.points);
  return "no method reaches " + number(tolerance) + " m here with a margin of two" +
         (least != nullptr ? "; the best was " + settings_of(*least) + " with " + number(least->error_rms_m) + " m"
                           : "") +
         (search.goal.keeps.integrator ? "; leave the method open for more" : "") +
         (search.goal.keeps.precision && search.of.precision == Precision::float_
              ? "; leave the precision open for more"
              : "");
}

}  // namespace

std::string ToleranceChoice::words(double tolerance) const {
  ErrorPoint used = chosen;
  if (used.tolerance == 0) used.dt = preset.dt;
  const std::string within =
      used.tolerance > 0 ? " (in steps of its own within dt = " + number(preset.dt) + " s)" : std::string();
  std::string text = settings_of(used) + within + ": error " + (chosen.resolved ? "" : "below ") +
                     number(chosen.resolved ? chosen.error_rms_m : std::max(chosen.error_rms_m, 10 * agreement_rms_m)) +
                     " m (rms) over the first " + number(seconds) + " s, where " + number(tolerance) +
                     " m was requested; it takes " + number(chosen.cost) + " s of CPU time per simulated second.";
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
                           (told ? ". The tightest tolerance that can be promised is " + number(tightest) + " m"
                                 : ". No tolerance up to 1 m can be promised here"),
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
