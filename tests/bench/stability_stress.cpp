// `tyglab stability stress`: random scenes, each of which must end bounded or be reported as diverged.
#include <array>
#include <cstdio>
#include <iostream>
#include <limits>
#include <map>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/child.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "tests/bench/stress.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct StressOptions : BenchOptions {
  std::int64_t cases = 0;  ///< 0: 1,000, or fewer where quick
  std::int64_t seed = 1, from = 1;
  std::int64_t only = 0;   ///< 0: all
  std::string integrator;  ///< empty: any
  /// What repeats these cases, but for their numbers.
  std::string repeated() const {
    return (integrator.empty() ? "" : "--integrator " + integrator + " ") + "--seed " + std::to_string(seed);
  }
};

Json case_json(std::int64_t number, const StressResult& result) {
  const Preset& p = result.preset;
  Json json = {{"case", number},
               {"kind", name_of(p.kind)},
               {"integrator", p.integrator},
               {"rows", p.rows},
               {"columns", p.columns},
               {"precision", name_of(p.precision)},
               {"threads", result.threads},
               {"dt", p.dt},
               {"steps", result.steps},
               {"edits", result.edits},
               {"unconverged_solves", result.unconverged},
               {"status", name_of(result.status)}};
  if (const auto& d = result.divergence)
    json.update(
        {{"t_s", d->t}, {"step", d->step}, {"i", d->i}, {"j", d->j}, {"cause", d->cause}, {"remedy", d->advice}});
  if (!result.problem.empty()) json["problem"] = result.problem;
  return json;
}

/// A case in its own process: what is thrown there is a violation too.
std::string run_case(const StressOptions& options, std::int64_t number) {
  const auto seed = std::uint64_t(options.seed);
  StressResult result;
  try {
    result = run_stress(seed, std::uint64_t(number), options.integrator);
  } catch (const std::exception& error) {
    result.preset = stress_preset(seed, std::uint64_t(number), options.integrator);
    result.status = StressStatus::failed;
    result.problem = std::string("an error was thrown: ") + error.what();
  }
  return case_json(number, result).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The row of a case, also where its process did not come to its end.
Json row_of(const StressOptions& options, std::int64_t number, const ChildExit& outcome) {
  Json row = outcome.result.empty() ? Json() : Json::parse(outcome.result, nullptr, false);
  if (!row.is_object()) {
    StressResult lost;
    lost.preset = stress_preset(std::uint64_t(options.seed), std::uint64_t(number), options.integrator);
    lost.status = StressStatus::failed;
    lost.problem = outcome.timed_out     ? "it did not end and was killed after a minute of processor time, or ten"
                   : outcome.signal != 0 ? "it crashed: " + signal_words(outcome.signal)
                                         : "its process ended without a result";
    row = case_json(number, lost);
  }
  row["seconds"] = outcome.seconds;
  return row;
}

/// How many cases of each method ended how.
using Tally = std::map<std::string, std::map<std::string, int>>;

void print_counts(std::ostream& out, const Tally& counts) {
  out << "\nintegrator            bounded  diverged  failed\n";
  std::map<std::string, int> sums;
  const auto print = [&](const std::string& name, const std::map<std::string, int>& by) {
    const auto of = [&](const char* status) { return by.contains(status) ? by.at(status) : 0; };
    std::array<char, 128> line;
    std::snprintf(line.data(), line.size(), "%-20s  %7d  %8d  %6d\n", name.c_str(), of("bounded"), of("diverged"),
                  of("failed"));
    out << line.data();
  };
  for (const auto& [name, by] : counts) {
    print(name, by);
    for (const auto& [status, count] : by) sums[status] += count;
  }
  print("all", sums);
  out << std::flush;
  flush_standard_output();
}

int stress(const StressOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const std::int64_t count = options.cases > 0 ? options.cases : options.quick ? 200 : 1000;
  const auto seed = std::uint64_t(options.seed);
  out << machine_line() << "\nRandom scenes of seed " << seed << ", cases " << options.from << " to "
      << options.from + count - 1 << ". Each must end bounded, or be reported as diverged.\n"
      << std::flush;
  Json rows = Json::array();
  Tally counts;
  int failed = 0;
  InterruptGuard guard;
  Progress progress("stability stress");
  const auto ended = [&](std::int64_t number, const ChildExit& outcome) {
    const Json row = row_of(options, number, outcome);
    ++counts[row["integrator"]][row["status"]];
    if (row["status"] == "failed") {
      ++failed;
      progress.clear();
      out << "case " << number << " failed: " << row["problem"].get<std::string>() << " (tyglab stability stress "
          << options.repeated() << " --only " << number << ")\n"
          << std::flush;
    }
    rows.push_back(row);
    progress.update(double(rows.size()) / double(count));
  };
  run_child_cases({.from = options.from,
                   .count = count,
                   .at_a_time = options.threads > 0 ? options.threads : processors(),
                   .work = [&](std::int64_t number) { return run_case(options, number); },
                   .ended = ended,
                   .stop = InterruptGuard::interrupted});
  progress.clear();
  print_counts(out, counts);
  if (!options.json.empty()) {
    Json all = bench_json("stability stress", rows);
    all["seed"] = seed, all["from"] = options.from, all["cases"] = rows.size(), all["failed"] = failed;
    write_output(options.json, json_text(all), bench_reach());
  }
  if (InterruptGuard::interrupted())
    std::cerr << "tyglab: Continue with " << options.repeated() << " --from "
              << options.from + std::int64_t(rows.size()) << " --cases " << count - std::int64_t(rows.size()) << "\n";
  if (const int code = bench_exit(options.outputs()); code != exit_done) return code;
  if (failed == 0) return exit_done;
  std::cerr << "tyglab: " << counted(failed, "case") << " failed; see above.\n";
  return exit_violation;
}

/// One case in this process, for use under other tools: its preset, what was done to it, and how it ended.
int only(const StressOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const auto seed = std::uint64_t(options.seed), number = std::uint64_t(options.only);
  out << preset_to_json(stress_preset(seed, number, options.integrator)) << std::flush;
  const StressResult result = run_stress(seed, number, options.integrator);
  const Json row = case_json(options.only, result);
  out << row.dump(2) << '\n' << std::flush;
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("stability stress", Json::array({row}))));
  return result.status == StressStatus::failed ? exit_violation : exit_done;
}

}  // namespace

void add_stability_stress(CLI::App& stability, Action& action) {
  CLI::App* command = stability.add_subcommand(
      "stress", "Random scenes, edited while they move: each ends bounded, or is reported as diverged");
  const auto options = std::make_shared<StressOptions>();
  constexpr std::int64_t most = 1000000000;
  CLI::Option* quick = add_quick(*command, *options, "200 cases");
  command->add_option("--cases", options->cases, "Number of cases (default 1000)")
      ->type_name("N")
      ->transform(whole_number_between(1, most))
      ->excludes(quick);
  command->add_option("--seed", options->seed, "Seed of the random scenes (default 1)")
      ->type_name("S")
      ->transform(whole_number_between(0, most));
  CLI::Option* from = command
                          ->add_option("--from", options->from,
                                       "The first case, to continue after another run. A case depends only on the seed "
                                       "and its number")
                          ->type_name("N")
                          ->transform(whole_number_between(1, most));
  command->add_option("--only", options->only, "Run one case with full output, for debuggers and profilers")
      ->type_name("N")
      ->transform(whole_number_between(1, most))
      ->excludes(quick)
      ->excludes("--cases")
      ->excludes(from);
  command->add_option("--integrator", options->integrator, "Use only this method (default: any)")
      ->type_name("NAME")
      ->check(CLI::Validator(
          [](const std::string& name) {
            return is_integrator(name)
                       ? std::string()
                       : "no integrator is called " + name + did_you_mean(name, integrator_names(), ".");
          },
          ""));
  add_threads(*command, *options, "Simultaneous cases");
  add_json(*command, *options, "Write every case for programs");
  command->footer(
      "Examples: tyglab stability stress --cases 1000 --seed 1\n"
      "          tyglab stability stress --cases 2000 --integrator vbd\n"
      "          tyglab stability stress --seed 1 --only 17");
  command->callback(
      [&action, options] { action = [options] { return options->only > 0 ? only(*options) : stress(*options); }; });
}

}  // namespace tyglab
