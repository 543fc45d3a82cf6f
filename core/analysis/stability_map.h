// A map of stiffness against dt: the values that a method tolerates in a scene, by linear theory and by short runs.
// Between the two limits of theory stability depends on the shape of the cloth, and the runs show the result.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/analysis/reference.h"
#include "core/model/preset.h"

namespace tyglab {

/// Cells of equal size in logarithms of stiffness (k_s, N/m; of a mass on a spring k) and dt (s).
struct MapGrid {
  double least_stiffness = 1, most_stiffness = 1, least_dt = 1, most_dt = 1;
  int columns = 1, rows = 1;  ///< of stiffness, of dt; the first row has the least dt
  int size() const { return columns * rows; }
  /// At a place in the grid: `at` 0 is its beginning, columns (or rows) its end; a cell's middle lies at n + ½.
  double stiffness(double at) const;
  double dt(double at) const;
  bool operator==(const MapGrid&) const = default;
};

/// Round the preset's stiffness and round the dt that theory allows for it, within what may be set, both of the
/// preset's values inside.
MapGrid map_grid(const Preset& preset, int columns, int rows);

/// The result of a short run in a cell.
struct MapCell {
  int column = 0, row = 0;
  double stiffness = 0, dt = 0;
  double dt_theory = 0;  ///< s; the worst-case limit at this stiffness; 0 where there is none
  bool diverged = false;
  double t = 0;      ///< s; when it diverged, or how long it ran
  double share = 0;  ///< energy that the method added (above 0) or removed, relative to the scene's most
};

/// The constant on the map's x axis: "k_s", or "k" of a mass on a spring; its value; and the preset with both set.
std::string stiffness_key(const Preset& preset);
double stiffness_of(const Preset& preset);
/// Why there is no map over it, a sentence without its end: it acts on nothing. Empty where it does.
std::string map_problem(const Preset& preset);
Preset at_place(Preset preset, double stiffness, double dt);
/// Whether both have one map: they differ at most in stiffness and dt, in the engine (cells run on the CPU's) and in
/// what no motion depends on.
bool same_map(const Preset& a, const Preset& b);

/// Runs the scene from its start with a cell's constants: half a second or 60 steps if that is more, but no more steps
/// than take some ten milliseconds. Throws Stopped.
MapCell measure_cell(const Preset& preset, const MapGrid& grid, int column, int row, const Stop& stop);

/// All cells of a grid (row · columns + column), coarsely spread first, so that the map can be read before it is whole.
std::vector<int> coarse_first(const MapGrid& grid);

/// Theory's borders over stiffness, places of the grid from left to right: up to `dt` the method is stable in any shape
/// of the cloth, above `every` (at least `dt`; infinity where there is none) it is unstable in every shape. Empty where
/// the method has no limit.
struct MapBoundary {
  std::vector<double> stiffness, dt, every;
};
/// The worst-case limit with the preset's own stiffness, s; 0 where there is none.
double map_limit(const Preset& preset);
MapBoundary map_boundary(const Preset& preset, const MapGrid& grid);

/// CSV: a comment, a header with units, a row a cell.
std::string map_csv(const Preset& preset, std::span<const MapCell> cells);

}  // namespace tyglab
