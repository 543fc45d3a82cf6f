// The gauge under dt: dt relative to the worst-case limit of linear theory, and to the limit of the present cloth.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/studies/stability_watch.h"

namespace tyglab {

struct Ui;

/// dt over the worst-case limit, as a bar with a number; marks where this cloth's own limit lies and from where on
/// every shape is unstable. Each mark has a tooltip, and the bar one for all.
void stability_row(Ui& ui);

/// The gauge's number: "57 %", "no limit", "unstable at any dt".
std::string stability_text(const StabilityLimits& limits, double dt);
/// "dt is 75 % of the worst-case limit and 58 % of this cloth's own, as it hangs now." Of the mass on a spring "dt is
/// 75 % of the limit." Empty where there is no limit, or none that is stable.
std::string part_words(const StabilityLimits& limits, double dt);
/// The bar's tooltip.
std::string stability_words(const StabilityLimits& limits, double dt);

/// A place on the gauge that has something to say.
struct GaugeMark {
  std::string_view name;  ///< "dt", "worst case", "this cloth", "every shape"
  double at;              ///< s
  std::string words;      ///< its tooltip
};
/// None where there is no limit, or none that is stable.
std::vector<GaugeMark> gauge_marks(const StabilityLimits& limits, double dt);
/// Where a dt is drawn along the bar, 0 to 1: the worst-case limit is always in the middle, and no dt is beyond the
/// end.
double gauge_position(const StabilityLimits& limits, double dt);

}  // namespace tyglab
