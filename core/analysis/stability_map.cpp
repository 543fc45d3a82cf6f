#include "core/analysis/stability_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/analysis/study_run.h"
#include "core/cloth/state.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/simulation.h"
#include "core/theory/modes.h"
#include "core/theory/zones.h"

namespace tyglab {
namespace {

constexpr double stiffness_reach = 100, dt_reach = 20;  // factors on either side of what is
constexpr double run_seconds = 0.5;                     // of a short run
constexpr int least_steps = 60, most_steps = 4000;
constexpr double most_work = 2e6;  // particles times steps: with the ledger some 20 ns each
constexpr int piece = 64;          // steps between two looks at whether to stop

double Preset::*stiffness_field(const Preset& preset) {
  return preset.kind == Kind::cloth ? &Preset::k_s : &Preset::k;
}

/// `center` with that much on either side, within what the constant may be, and with `inside`.
std::pair<double, double> span_of(std::string_view key, double center, double reach, double inside) {
  const PresetRow& row = *find_row(key);
  const double least = row.min > 0 ? row.min : 1e-3;
  const auto allowed = [&](double value) { return std::clamp(value, least, row.max); };
  return {allowed(std::min(center / reach, inside / 1.5)), allowed(std::max(center * reach, inside * 1.5))};
}

double between(double least, double most, double part) {
  return least * std::pow(most / least, part);
}

}  // namespace

double map_limit(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  if (!has_step_limit(method)) return 0;
  const double limit = dt_crit(method, worst_modes(preset));
  return std::isfinite(limit) ? limit : 0;
}

double MapGrid::stiffness(double at) const {
  return between(least_stiffness, most_stiffness, at / columns);
}
double MapGrid::dt(double at) const {
  return between(least_dt, most_dt, at / rows);
}

std::string stiffness_key(const Preset& preset) {
  return preset.kind == Kind::cloth ? "k_s" : "k";
}
double stiffness_of(const Preset& preset) {
  return preset.*stiffness_field(preset);
}

std::string map_problem(const Preset& preset) {
  const std::string key = stiffness_key(preset), others = replaced_by(*find_row(key), preset);
  return others.empty() ? "" : key + " has no effect while " + others + " are set, so there is no map over it";
}

Preset at_place(Preset preset, double stiffness, double dt) {
  preset.*stiffness_field(preset) = stiffness;
  preset.dt = dt;
  return preset;
}

bool same_map(const Preset& a, const Preset& b) {
  return changes(at_place(a, stiffness_of(b), b.dt), b).within(motionless | Effect::device | Effect::engine);
}

MapGrid map_grid(const Preset& preset, int columns, int rows) {
  MapGrid grid;
  grid.columns = columns, grid.rows = rows;
  const double stiffness = std::max(stiffness_of(preset), 1e-3);
  std::tie(grid.least_stiffness, grid.most_stiffness) =
      span_of(stiffness_key(preset), stiffness, stiffness_reach, stiffness);
  const double limit = map_limit(preset);
  std::tie(grid.least_dt, grid.most_dt) = span_of("dt", limit > 0 ? limit : preset.dt, dt_reach, preset.dt);
  return grid;
}

MapCell measure_cell(const Preset& preset, const MapGrid& grid, int column, int row, const Stop& stop) {
  MapCell cell{.column = column, .row = row, .stiffness = grid.stiffness(column + 0.5), .dt = grid.dt(row + 0.5)};
  Preset own = at_place(preset, cell.stiffness, cell.dt);
  own.engine = EngineKind::cpu;
  cell.dt_theory = map_limit(own);
  Simulation simulation(own);
  simulation.enable_ledger(true);
  const double affordable = most_work / simulation.lattice().size();
  int left = int(std::min({std::max(std::ceil(run_seconds / own.dt), double(least_steps)), double(most_steps),
                           std::max(affordable, double(least_steps))}));
  while (left > 0 && !simulation.divergence()) {
    if (stop()) throw Stopped();
    advance_study(simulation, std::min(left, piece), stop);
    left -= piece;
  }
  cell.diverged = simulation.divergence().has_value();
  cell.t = cell.diverged ? simulation.divergence()->t : simulation.time();
  cell.share = simulation.ledger()->share();
  return cell;
}

std::vector<int> coarse_first(const MapGrid& grid) {
  std::vector<int> order;
  std::vector<bool> taken(std::size_t(grid.size()));
  int step = 1;
  while (2 * step < std::max(grid.columns, grid.rows)) step *= 2;
  for (; step >= 1; step /= 2)
    for (int row = step / 2; row < grid.rows; row += step)
      for (int column = step / 2; column < grid.columns; column += step) {
        const int cell = row * grid.columns + column;
        if (!taken[std::size_t(cell)]) taken[std::size_t(cell)] = true, order.push_back(cell);
      }
  return order;
}

MapBoundary map_boundary(const Preset& preset, const MapGrid& grid) {
  constexpr int samples = 64;
  MapBoundary boundary;
  for (int n = 0; n <= samples; ++n) {
    const double stiffness = grid.stiffness(grid.columns * double(n) / samples);
    const Preset there = at_place(preset, stiffness, preset.dt);
    const double limit = map_limit(there);
    if (limit <= 0) continue;
    boundary.stiffness.push_back(stiffness), boundary.dt.push_back(limit);
    boundary.every.push_back(every_shape_limit(there));
  }
  return boundary;
}

std::string map_csv(const Preset& preset, std::span<const MapCell> cells) {
  const std::string key = stiffness_key(preset);
  std::string text = "# tyglab stability map, " + preset.integrator + ", preset hash " + preset_hash(preset) + "\n" +
                     key + " [N/m],dt [s],outcome,t [s],energy error,dt by theory [s]\n";
  for (const MapCell& cell : cells) {
    append_number(text, cell.stiffness, 9);
    text += ',';
    append_number(text, cell.dt, 9);
    text += cell.diverged ? ",diverged," : ",bounded,";
    append_number(text, cell.t, 9);
    text += ',';
    append_number(text, cell.share, 9);
    text += ',';
    if (cell.dt_theory > 0) append_number(text, cell.dt_theory, 9);
    text += '\n';
  }
  return text;
}

}  // namespace tyglab
