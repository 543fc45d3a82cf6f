// Reports the results of `tyglab bench accuracy`: a table for people, JSON for programs, charts.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/ui/kit/chart.h"
#include "core/analysis/accuracy.h"
#include "core/analysis/statistics.h"

namespace tyglab {

struct AccuracyResult {
  AccuracyScene scene;
  Reference reference;
  std::vector<AccuracyRow> rows;  ///< those of a method one after the other, largest dt first
};

/// The scene, its references and the table's head.
void print_scene(std::ostream& out, const AccuracyResult& result);
/// A line: when the method reaches each decade of error that the reference can tell.
void print_method(std::ostream& out, const std::vector<AccuracyRow>& rows, const Reference& reference);
void print_winners(std::ostream& out, const std::vector<AccuracyWinner>& winners);

/// Means over time of a motion that no longer can be predicted, a line a method.
void print_statistics(std::ostream& out, const std::vector<MotionStatistics>& statistics);

nlohmann::ordered_json accuracy_json(const std::vector<AccuracyResult>& results,
                                     const std::vector<MotionStatistics>& statistics);
inline constexpr float accuracy_chart_height = 560;  ///< points: its legend takes some lines
/// Error over run time, logarithmic both, a chart a scene.
std::vector<Chart> accuracy_charts(const std::vector<AccuracyResult>& results);

}  // namespace tyglab
