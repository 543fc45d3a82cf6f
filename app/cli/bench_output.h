// Output common to all benchmarks: the machine and build of the measurements.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/outputs.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/accuracy.h"
#include "core/analysis/study_run.h"
#include "core/io/output_file.h"

namespace tyglab {

/// The options common to all benchmarks and experiments.
struct BenchOptions {
  bool quick = false;
  int threads = 0;  ///< 0: as many as there are processors
  std::string json, png;

  std::vector<Output> outputs() const { return {{"--json", json}, {"--png", png, true}}; }
};

/// --quick, --threads, --json and --png, each with what it does in this command.
CLI::Option* add_quick(CLI::App& command, BenchOptions& options, const std::string& does);
void add_threads(CLI::App& command, BenchOptions& options, const std::string& does,
                 const std::string& by_default = "one per CPU");
void add_json(CLI::App& command, BenchOptions& options, const std::string& does = "Write the figures for programs");
CLI::Option* add_png(CLI::App& command, BenchOptions& options, const std::string& does);

/// The frame of a benchmark's JSON: its name, the machine, the version and build, and the rows under "runs".
nlohmann::ordered_json bench_json(const std::string& benchmark, nlohmann::ordered_json runs);

/// null where a number is not finite, since JSON has no word for it.
nlohmann::ordered_json finite_or_null(double value);

/// The completeness of the results of a benchmark under an InterruptGuard, which Ctrl-C can cut short.
Reach bench_reach();
/// Its exit code; if Ctrl-C ended it, says so and where the results so far are.
int bench_exit(const std::vector<Output>& outputs);

// Reports the results of `tyglab bench accuracy`: a table for people, JSON for programs, charts.

struct AccuracyResult {
  AccuracyScene scene;
  Reference reference;
  std::vector<AccuracyRow> rows;  ///< those of a method one after the other, largest dt first
};

/// The scene, its references and the table's head.
void print_scene(std::ostream& out, const AccuracyResult& result);
/// A line with the time at which the method reaches each decade of error that the reference resolves.
void print_method(std::ostream& out, const std::vector<AccuracyRow>& rows, const Reference& reference);
void print_winners(std::ostream& out, const std::vector<AccuracyWinner>& winners);

/// Means over time of a motion that no longer can be predicted, a line a method.
void print_statistics(std::ostream& out, const std::vector<MotionStatistics>& statistics);

nlohmann::ordered_json accuracy_json(const std::vector<AccuracyResult>& results,
                                     const std::vector<MotionStatistics>& statistics);
inline constexpr float accuracy_chart_height = 560;  ///< points: its legend takes some lines
/// Error over run time, on logarithmic axes, one chart per scene.
std::vector<Chart> accuracy_charts(const std::vector<AccuracyResult>& results);

}  // namespace tyglab
