// `tyglab bench convergence`: the measured order of a method in a scene.
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/cli/preset_argument.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/terminal.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct ConvergenceOptions {
  PresetArgument preset;
  BenchOptions bench;
  std::string csv;
  double seconds = 0.25;

  std::vector<Output> outputs() const {
    std::vector<Output> all = bench.outputs();
    all.push_back({"--csv", csv});
    return all;
  }
};

Json number_or_null(bool known, double value) {
  return known && std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json convergence_json(const std::string& label, const Convergence& study) {
  Json rows = Json::array();
  for (const ConvergencePoint& point : study.points) {
    const bool diverged = !std::isfinite(point.error_rms_m);
    rows.push_back({{"scene", label},
                    {"integrator", study.of.integrator},
                    {"dt", point.dt},
                    {"error_rms_m", number_or_null(study.referenced, point.error_rms_m)},
                    {"difference_rms_m", number_or_null(point.difference_rms_m >= 0, point.difference_rms_m)},
                    {"status", diverged         ? "diverged"
                               : point.resolved ? "ok"
                                                : "below_floor"}});
  }
  Json json = bench_json("convergence", rows);
  const auto order = measured_order(study);
  json["seconds"] = study.seconds;
  json["order"] = number_or_null(order.has_value(), order ? order->order : 0);
  json["nominal_order"] = nominal_order(study.of);
  json["words"] = convergence_words(study);
  return json;
}

void print_study(std::ostream& out, const std::string& label, const Convergence& study) {
  if (!study.problem.empty()) {
    out << convergence_words(study) << std::endl;
    return;
  }
  out << machine_line() << '\n'
      << in_one_line(label) << ", " << scheme(study.of.integrator).title << " in double, over " << study.seconds
      << " s\n"
      << "       dt, s    error, m  difference to dt/2, m\n";
  std::array<char, 120> line;
  for (const ConvergencePoint& point : study.points) {
    std::snprintf(line.data(), line.size(), "%12.4g%12.3g", point.dt, study.referenced ? point.error_rms_m : NAN);
    out << line.data();
    if (point.difference_rms_m >= 0) {
      std::snprintf(line.data(), line.size(), "%23.3g", point.difference_rms_m);
      out << line.data();
    }
    out << '\n';
  }
  out << convergence_words(study) << std::endl;
}

int convergence(const ConvergenceOptions& options) {
  if (options.preset.precision == name_of(Precision::float_))
    throw UsageError("--precision float: an order is measured in double, so that rounding does not hide it; omit it");
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const ResolvedPreset scene = options.preset.resolve("hanging");
  const StudyEffort effort = options.bench.quick ? StudyEffort{.reference = 1e8} : StudyEffort{.reference = 3e9};
  Convergence study;
  const InterruptGuard guard;
  Progress progress("bench convergence");
  try {
    measure_convergence({scene.preset, std::nullopt}, options.seconds, effort, InterruptGuard::interrupted,
                        [&](const Convergence& now) {
                          study = now;
                          progress.update(double(1 + now.points.size()) / (1 + convergence_levels));
                        });
  } catch (const Stopped&) {
  }
  progress.clear();
  if (study.done) print_study(out, scene.source.label, study);
  if (!options.bench.json.empty())
    write_output(options.bench.json, json_text(convergence_json(scene.source.label, study)), bench_reach());
  if (!options.csv.empty()) write_output(options.csv, convergence_csv(study), bench_reach());
  if (!options.bench.png.empty()) {
    Chart chart = convergence_chart(dark_tokens(), study);
    chart.title = "Error over dt: " + scene.source.label + ", " + std::string(scheme(study.of.integrator).title);
    std::array<char, 80> note;
    std::snprintf(note.data(), note.size(), "in double, over the first %.3g s", study.seconds);
    chart.note = note.data();
    chart.padding = 20;
    write_charts(options.bench.png, {chart}, bench_reach(), 1);
  }
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_convergence(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "convergence", "The measured order of a method in a scene: its error with dt, dt/2, dt/4, …");
  const auto options = std::make_shared<ConvergenceOptions>();
  options->preset.add_to(*command, false, Engines::cpu);
  command
      ->add_option("--seconds", options->seconds,
                   "Simulated time from the start over which runs are compared (default 0.25)")
      ->type_name("T")
      ->transform(number_between(1e-6, 60, "s"));
  add_quick(*command, options->bench, "A coarser reference");
  add_json(*command, options->bench);
  add_output(*command, "--csv", options->csv, "Write one row per dt");
  add_png(*command, options->bench, "Draw error over dt");
  command->footer("Example: tyglab bench convergence hanging --integrator rk4 --png convergence.png");
  command->callback([&action, options] { action = [options] { return convergence(*options); }; });
}

}  // namespace tyglab
