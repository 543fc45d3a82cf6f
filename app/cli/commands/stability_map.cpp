// `tyglab stability map`: the stiffnesses and dt that a method tolerates in a scene, by theory and by short runs.
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
#include "app/cli/preset_argument.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/theory/zones.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct MapOptions {
  PresetArgument preset;
  BenchOptions bench;
  std::string csv;

  std::vector<Output> outputs() const {
    std::vector<Output> all = bench.outputs();
    all.push_back({"--csv", csv});
    return all;
  }
};

Json map_json(const Preset& preset, const std::string& label, const std::vector<MapCell>& cells) {
  Json rows = Json::array();
  for (const MapCell& cell : cells)
    rows.push_back({{stiffness_key(preset), cell.stiffness},
                    {"dt", cell.dt},
                    {"dt_theory", cell.dt_theory > 0 ? Json(cell.dt_theory) : Json(nullptr)},
                    {"diverged", cell.diverged},
                    {"t", cell.t},
                    {"energy_error", cell.share}});
  Json json = bench_json("stability map", rows);
  json["scene"] = label, json["integrator"] = preset.integrator;
  return json;
}

/// Theory's zones of dt with the preset's own stiffness.
std::string borders_here(const Preset& preset, double limit) {
  const auto border = [&](Zone zone, const char* side, double dt) {
    return std::string(zone_name(zone, preset.kind)) + " " + side + " " + short_number(dt, 3) + " s";
  };
  const double every = every_shape_limit(preset);
  std::string text = "| worst-case limit, by theory: " + border(Zone::stable, "up to", limit);
  if (preset.kind == Kind::cloth && std::isfinite(every)) text += ", " + border(Zone::unstable, "above", every);
  return text + ", at " + stiffness_key(preset) + " = " + short_number(stiffness_of(preset)) + " N/m\n";
}

/// The map as letters, from cells row by row: stiffness to the right and dt upward: × diverged, · stayed bounded. A
/// stroke stands in each row where the worst-case limit is passed.
void print_map(std::ostream& out, const Preset& preset, const MapGrid& grid, const std::vector<MapCell>& cells) {
  std::array<char, 200> line;
  for (auto cell = cells.begin(); cell != cells.end();) {
    const int row = cell->row;
    int column = 0;  // an interrupted map has gaps
    bool stable = true;
    std::snprintf(line.data(), line.size(), "dt %9.3g s  ", cell->dt);
    out << line.data();
    for (; cell != cells.end() && cell->row == row; ++cell, ++column) {
      for (; column < cell->column; ++column) out << "  ";
      const bool passed = cell->dt_theory > 0 && cell->dt > cell->dt_theory;
      out << (stable && passed ? '|' : ' ') << (cell->diverged ? "×" : "·");
      stable = !passed;
    }
    out << '\n';
  }
  out << stiffness_key(preset) << " from " << short_number(grid.stiffness(0.5), 3) << " to "
      << short_number(grid.stiffness(grid.columns - 0.5), 3) << " N/m; × diverged, · bounded in a short run\n";
  const double here = map_limit(preset);
  out << (here > 0 ? borders_here(preset, here) : "In theory " + preset.integrator + " has no largest stable dt.\n");
}

int map(const MapOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const ResolvedPreset scene = options.preset.resolve("hanging");
  if (const std::string problem = map_problem(scene.preset); !problem.empty())
    throw UsageError(in_one_line(scene.source.label) + ": " + problem +
                     "; set one of them to k_s, as in --set k_weft=k_s");
  const MapGrid grid = options.bench.quick ? map_grid(scene.preset, 12, 8) : map_grid(scene.preset, 36, 26);
  const std::vector<int> order = coarse_first(grid);
  out << machine_line() << '\n'
      << in_one_line(scene.source.label) << ", " << scheme(scene.preset.integrator).title << '\n';
  std::vector<MapCell> cells(order.size());
  std::size_t done = 0;
  InterruptGuard guard;
  Progress progress("stability map");
  in_parallel(
      int(order.size()), scene.threads,
      [&](int n) {
        const int cell = order[std::size_t(n)];
        cells[std::size_t(n)] =
            measure_cell(scene.preset, grid, cell % grid.columns, cell / grid.columns, [] { return false; });
      },
      [&](int) { progress.update(double(++done) / double(order.size())); }, InterruptGuard::interrupted);
  progress.clear();
  cells.resize(done);
  std::sort(cells.begin(), cells.end(),
            [](const MapCell& a, const MapCell& b) { return a.row != b.row ? a.row > b.row : a.column < b.column; });
  print_map(out, scene.preset, grid, cells);
  if (!options.bench.json.empty())
    write_output(options.bench.json, json_text(map_json(scene.preset, scene.source.label, cells)), bench_reach());
  if (!options.csv.empty()) write_output(options.csv, map_csv(scene.preset, cells), bench_reach());
  if (!options.bench.png.empty()) {
    const Chart page = map_page(dark_tokens(), scene.preset, scene.source.label, machine_line(), grid,
                                map_boundary(scene.preset, grid), cells);
    write_charts(options.bench.png, {page}, bench_reach(), 1);
  }
  return bench_exit(options.outputs());
}

}  // namespace

void add_stability_map(CLI::App& stability, Action& action) {
  CLI::App* command = stability.add_subcommand(
      "map", "Which k_s and dt a method tolerates in a scene, by theory and by short runs (mass on a spring: k)");
  const auto options = std::make_shared<MapOptions>();
  options->preset.add_to(*command, false, Engines::cpu);
  add_quick(*command, options->bench, "Fewer cells");
  add_json(*command, options->bench);
  add_output(*command, "--csv", options->csv, "Write one row per cell");
  add_png(*command, options->bench, "Draw the map");
  command->footer(
      "The map is over k_s, so k_warp, k_weft and k_shear must not all be set.\n"
      "Example: tyglab stability map hanging --integrator rk4 --png map.png");
  command->callback([&action, options] { action = [options] { return map(*options); }; });
}

}  // namespace tyglab
