#include "app/ui/frame/exports.h"

#include <array>

#include "app/ui/app.h"
#include "app/ui/kit/curves.h"
#include "app/ui/kit/map_chart.h"
#include "core/analysis/machine.h"
#include "core/io/files.h"
#include "core/io/preset_io.h"
#include "core/output/obj.h"
#include "core/output/state_csv.h"
#include "core/output/values_csv.h"

namespace tyglab {
namespace {

std::string series(const App& app, const Series& of, const std::vector<std::string>& names) {
  return of.csv(names, "tyglab series, t in s, preset hash " + preset_hash(app.preset()));
}

std::string forces(App& app) {
  return series(app, app.ui.plots.forces, force_column_names());
}

std::string height(App& app) {
  return series(app, app.ui.plots.height, height_column_names());
}

std::string map(App& app) {
  const auto known = app.map.findings();
  return known ? map_csv(known->of, known->cells) : map_csv(app.preset(), {});
}

/// Cloths that are not there keep their empty columns.
std::string copies(App& app) {
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

std::string convergence(App& app) {
  return convergence_csv(app.convergence.study().value_or(Convergence{}));
}

std::string values(App& app) {
  Simulation* reference = app.copies.lockstep.empty() ? nullptr : &cloth_of(app, app.copies.reference);
  return values_csv(*app.simulation, reference);
}

std::string state(App& app) {
  return state_csv(*app.simulation);
}

/// As other programs read it, without bodies.
std::string mesh(App& app) {
  Simulation& cloth = *app.simulation;
  return obj_text(cloth.tears(), cloth.read().x, {.name = app.preset().name, .t = cloth.time(), .fps = 0});
}

template <std::string (*text)(App&)>
void text_file(App& app, const std::filesystem::path& file) {
  write_atomically(file, text(app));
}

void map_picture(App& app, const std::filesystem::path& file) {
  const auto known = app.map.findings();
  if (!known) throw OutputError("There is no map yet; open it (M), and let some of it be measured.");
  const Preset here = at_place(known->of, stiffness_of(app.requested_preset()), app.requested_preset().dt);
  const Chart page =
      map_page(app.theme.colors, here, app.document.label, machine_line(), known->grid, known->boundary, known->cells);
  write_png(file, picture_of({page}, 1));
}

constexpr const char* rows_of_frames =
    "One row for each drawn frame, as the plot holds them: t and a column for each curve, units in the header.";

}  // namespace

const Export& export_of(ExportSource source) {
  static constexpr std::array<Export, 9> exports{
      {{"Write the forces as CSV", rows_of_frames, "forces.csv", text_file<forces>},
       {"Write the height of the weight as CSV", rows_of_frames, "height.csv", text_file<height>},
       {"Write the map of stiffness and dt as CSV",
        "One row for each cell that has been measured: stiffness, dt, what the short run came to, theory's dt.",
        "map.csv", text_file<map>},
       {"Write what the copies' plot holds as CSV", rows_of_frames, "copies.csv", text_file<copies>},
       {"Write every particle's values as CSV",
        "One row for each particle as it is now, one column for each quantity that can colour the cloth.", "values.csv",
        text_file<values>},
       {"Write the convergence as CSV", "One row for each dt, units in the header.", "convergence.csv",
        text_file<convergence>},
       {"Write the map of stiffness and dt as PNG", "A picture of the map as far as it has been measured.", "map.png",
        map_picture},
       {"Write the cloth as OBJ",
        "A mesh for other programs: positions in m, texture coordinates, normals, and the triangles that are whole.",
        "cloth.obj", text_file<mesh>},
       {"Write the state as CSV", "One row for each particle as it is now: x and ẋ, with all digits that it has.",
        "state.csv", text_file<state>}}};
  return exports[std::size_t(source)];
}

}  // namespace tyglab
