// `tyglab bench accuracy`: error against run time, scene by scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

/// The scene of which only means can be compared beyond its time: nothing damps it.
constexpr std::string_view unpredictable = "swinging";

struct AccuracyOptions : BenchOptions {
  std::string scene;
};

/// The scenes asked for. Throws UsageError for a name that is none.
std::vector<AccuracyScene> chosen_scenes(const std::string& name, bool quick) {
  std::vector<AccuracyScene> all = accuracy_scenes();
  if (name.empty()) {
    if (quick) std::erase_if(all, [](const AccuracyScene& scene) { return scene.damped; });
    return all;
  }
  for (const AccuracyScene& scene : all)
    if (scene.name == name) return {scene};
  throw UsageError("--scene " + name + ": there is no such scene; known: " + joined(all, ", ", &AccuracyScene::name));
}

/// Methods that are measured on OpenCL too: one of each kind.
constexpr std::array<const char*, 3> on_opencl{"verlet", "rk4", "implicit_euler"};

/// One method to be measured in one precision.
struct Contestant {
  std::string name;
  Precision precision;
  EngineKind engine = EngineKind::cpu;
};

std::vector<Contestant> contestants(const AccuracyScene& scene, bool with_opencl) {
  std::vector<Contestant> list;
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const std::string_view name : integrator_names()) list.push_back({std::string(name), precision});
  if (with_opencl && !opencl_devices().devices.empty())
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const char* name : on_opencl) list.push_back({name, precision, EngineKind::opencl});
  if (odeint_can(scene))
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const std::string& name : odeint_methods()) list.push_back({name, precision});
  return list;
}

/// A contestant's rows; none where the device that they ask for does not run them.
std::vector<AccuracyRow> measure(AccuracyScene scene, const Reference& reference, const Contestant& contestant,
                                 const AccuracyEffort& effort, const Stop& stop) {
  const auto& [name, precision, engine] = contestant;
  if (name.starts_with("odeint_")) return measure_odeint(scene, reference, name, precision, effort, stop);
  scene.preset.engine = engine;
  try {
    return measure_integrator(scene, reference, name, precision, effort, stop);
  } catch (const EngineError&) {
    if (engine == EngineKind::cpu) throw;
    return {};
  }
}

constexpr double share_of_references = 0.2;  // of the whole time, for the display of progress

/// References of all scenes, on all processors, since no time is measured yet; those that are done when Ctrl-C comes.
std::vector<Reference> make_references(const std::vector<AccuracyScene>& scenes, bool quick, Progress& progress) {
  std::vector<Reference> all(scenes.size());
  std::size_t made = 0;
  try {
    in_parallel(
        int(scenes.size()), processors(),
        [&](int n) {
          all[std::size_t(n)] = make_reference(scenes[std::size_t(n)], quick, InterruptGuard::interrupted);
        },
        [&](int) { progress.update(share_of_references * double(++made) / double(scenes.size())); },
        InterruptGuard::interrupted);
  } catch (const Stopped&) {
  }
  all.resize(made);
  return all;
}

/// Measures one scene, the `number`-th of `of`; what is measured when Ctrl-C comes is kept.
AccuracyResult measure(const AccuracyScene& scene, const Reference& reference, bool quick, std::ostream& out,
                       Progress& progress, std::size_t number, std::size_t of) {
  const Stop stop = InterruptGuard::interrupted;
  const AccuracyEffort effort = quick ? AccuracyEffort{0.012, false, 1, 0.005} : AccuracyEffort{};
  AccuracyResult result{scene, reference, {}};
  progress.clear();
  print_scene(out, result);
  const auto list = contestants(scene, !quick || number == 0);  // programs take a while to be built
  for (std::size_t n = 0; n < list.size() && !stop(); ++n) {
    const auto rows = measure(scene, result.reference, list[n], effort, stop);
    progress.clear();
    print_method(out, rows, result.reference);
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    const double done = (double(number) + double(n + 1) / double(list.size())) / double(of);
    progress.update(share_of_references + (1 - share_of_references) * done);
  }
  progress.clear();
  print_winners(out, accuracy_winners(result.rows, result.reference));
  return result;
}

int accuracy(const AccuracyOptions& options) {
  const std::vector<AccuracyScene> scenes = chosen_scenes(options.scene, options.quick);
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  out << machine_line()
      << "\nCPU time in ms, on one thread (OpenCL: wall time), at which the rms error of all positions falls below the "
         "given number of meters;\n* is the method's largest stable dt, - an error that it does not reach or that the "
         "reference cannot resolve\n"
      << std::flush;
  std::vector<AccuracyResult> results;
  InterruptGuard guard;
  Progress progress("bench accuracy");
  const std::vector<Reference> references = make_references(scenes, options.quick, progress);
  for (std::size_t n = 0; n < references.size() && !InterruptGuard::interrupted(); ++n)
    results.push_back(measure(scenes[n], references[n], options.quick, out, progress, n, scenes.size()));
  std::vector<MotionStatistics> statistics;
  for (const AccuracyScene& scene : scenes)
    if (scene.name == unpredictable)
      statistics = measure_statistics(scene, options.quick, processors(), InterruptGuard::interrupted);
  progress.clear();
  print_statistics(out, statistics);
  if (!options.json.empty()) write_output(options.json, json_text(accuracy_json(results, statistics)), bench_reach());
  if (!options.png.empty())
    write_charts(options.png, accuracy_charts(results), bench_reach(), 2, 1.5f, accuracy_chart_height);
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_accuracy(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "accuracy",
      "Error against run time: every integrator, in float and double, some on OpenCL, and those of Boost.Odeint");
  const auto options = std::make_shared<AccuracyOptions>();
  add_quick(*command, *options,
            "Fewer dt, shorter runs, coarser references, OpenCL only in the first scene, no heavily damped ones");
  const std::string names = joined(accuracy_scenes(), ", ", &AccuracyScene::name);
  command->add_option("--scene", options->scene, "Only one scene: " + names)->type_name("NAME")->transform(not_empty());
  add_json(*command, *options);
  add_png(*command, *options, "Draw error over run time, one chart per scene");
  command->footer("Example: tyglab bench accuracy --json accuracy.json --png accuracy.png");
  command->callback([&action, options] { action = [options] { return accuracy(*options); }; });
}

}  // namespace tyglab
