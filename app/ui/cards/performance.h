// The parts of a frame and a step: which ran, which were skipped, and their times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/ui/state/ui.h"

namespace tyglab {

enum class Activity { on, skipped, asleep };
std::string_view name_of(Activity activity);

/// A part of the work that a scene may need or not.
struct FeatureRow {
  std::string_view name, help;
  Activity activity;
  std::optional<double> ms;  ///< a frame; none where the step's one pass does it, which has a row of its own
};
std::vector<FeatureRow> feature_rows(const Ui& ui);

/// A number of the whole: name and value with its unit, and what is to be said of it, which may be nothing.
struct PerformanceFact {
  std::string_view name;
  std::string value, help = {};
};
std::vector<PerformanceFact> performance_facts(const Ui& ui);

/// The card at the foot of the plots column, closed unless the user has opened it, and its height (pixels).
void performance_card(Ui& ui, float height);
float performance_card_height(const Ui& ui, float width);

}  // namespace tyglab
