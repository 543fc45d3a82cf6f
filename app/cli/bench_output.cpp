#include "app/cli/bench_output.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "app/cli/command_line.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/io/output_file.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "tyglab_version.h"

namespace tyglab {
namespace {

/// "2026-11-21", the day on which something is measured (UTC).
std::string today() {
  const std::chrono::year_month_day date(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
  char text[16];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", int(date.year()), unsigned(date.month()), unsigned(date.day()));
  return text;
}

}  // namespace

CLI::Option* add_quick(CLI::App& command, BenchOptions& options, const std::string& does) {
  return command.add_flag("--quick", options.quick, does + "; under a minute");
}

void add_threads(CLI::App& command, BenchOptions& options, const std::string& does, const std::string& by_default) {
  command.add_option("--threads", options.threads, does + "; default: " + by_default)
      ->type_name("N")
      ->transform(whole_number_between(1, 256));
}

void add_json(CLI::App& command, BenchOptions& options, const std::string& does) {
  add_output(command, "--json", options.json, does + "; - is standard output")->type_name("F.json");
}

CLI::Option* add_png(CLI::App& command, BenchOptions& options, const std::string& does) {
  return add_output(command, "--png", options.png, does + "; - is standard output")
      ->type_name("F.png")
      ->check([](const std::string& file) {
        const std::string extension = std::filesystem::path(file).extension().string();
        return extension.empty() || extension == ".png" ? "" : "images are written as F.png, not as " + extension;
      });
}

nlohmann::ordered_json bench_json(const std::string& benchmark, nlohmann::ordered_json runs) {
  const Machine machine = this_machine();
  return {{"benchmark", benchmark},
          {"machine",
           {{"processor", machine.processor}, {"cores", machine.cores}, {"instruction_set", machine.instruction_set}}},
          {"version", TYGLAB_VERSION},
          {"build", build_description()},
          {"date", today()},
          {"runs", std::move(runs)}};
}

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

Reach bench_reach() {
  return InterruptGuard::interrupted() ? Reach::cut_short : Reach::whole;
}

int bench_exit(const std::vector<Output>& outputs) {
  if (!InterruptGuard::interrupted()) return exit_done;
  std::vector<std::string> kept;
  for (const Output& output : outputs)
    if (const std::filesystem::path file = incomplete_file(output.file); !file.empty())
      kept.push_back(output_name(file));
  std::cerr << "tyglab: Interrupted; the results measured so far are complete"
            << (kept.empty() ? "" : ", in " + joined(kept)) << ".\n";
  return exit_interrupted;
}

}  // namespace tyglab
