#include "app/sandbox/exports.h"

#include <array>

#include "app/panels/curves.h"
#include "app/sandbox/app.h"
#include "core/notation/preset_io.h"

namespace tyglab {
namespace {

std::string series(const App& app, const Series& of, const std::vector<std::string>& names) {
  return of.csv(names, "tyglab series, t in s, preset hash " + preset_hash(app.preset()));
}

std::string forces(const App& app) {
  return series(app, app.ui.plots.forces, force_column_names());
}

std::string height(const App& app) {
  return series(app, app.ui.plots.height, height_column_names());
}

std::string map(const App& app) {
  const auto known = app.map.findings();
  return known ? map_csv(known->of, known->cells) : map_csv(app.preset(), {});
}

/// Cloths that are not there keep their empty columns.
std::string copies(const App& app) {
  const bool energy = app.copies.plotted == Copies::Quantity::energy;
  std::vector<std::string> names;
  for (int n = Copies::original; n < int(Lockstep::most); ++n) {
    const bool there = n < int(app.copies.lockstep.size());
    std::string name = there ? name_of_cloth(app, n) : "copy " + std::to_string(n + 1);
    for (char& letter : name)
      if (letter == ',') letter = ';';  // it stands in a comma's file
    names.push_back(name + (energy ? " [J]" : " [m]"));
  }
  return series(app, energy ? app.copies.energy : app.copies.distance, names);
}

}  // namespace

const CsvExport& csv_export(CsvSource source) {
  static constexpr std::array<CsvExport, 4> exports{
      {{"Write the forces as CSV", "forces.csv", forces},
       {"Write the height of the weight as CSV", "height.csv", height},
       {"Write the map of stiffness and dt as CSV", "map.csv", map},
       {"Write what the copies' plot holds as CSV", "copies.csv", copies}}};
  return exports[std::size_t(source)];
}

}  // namespace tyglab
