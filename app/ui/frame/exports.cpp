// Files that the window can export, one row each.
#include <array>

#include "app/base/experiment_file.h"
#include "app/platform/platform.h"
#include "app/session/recorded.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/output/obj.h"
#include "core/output/state_csv.h"

namespace tyglab {
namespace {

std::string series(const Ui& ui, const Series& of, const std::vector<SeriesColumn>& columns,
                   const std::string& about = {}) {
  return of.csv(columns, about + "preset hash " + preset_hash(ui.session.preset()));
}

std::string forces(Ui& ui) {
  const Source source = force_source(ui.session);
  const auto site = ui.session.picked.value_or(Pins::Site{});
  const std::string of = source == Source::particle
                             ? "particle " + std::to_string(site.i) + " " + std::to_string(site.j)
                             : "all particles";
  return series(ui, ui.session.recorded.forces, force_columns(source), "magnitudes of the forces on " + of + ", ");
}

std::string energies(Ui& ui) {
  return series(ui, ui.session.recorded.energy, energy_column_list());
}

std::string height(Ui& ui) {
  return series(ui, ui.session.recorded.height, height_columns());
}

std::string map(Ui& ui) {
  const auto known = ui.session.studies.map.findings();
  return known ? map_csv(known->of, known->cells) : map_csv(ui.session.preset(), {});
}

/// Cloths that are not there keep their empty columns.
std::string copies(Ui& ui) {
  const bool energy = ui.session.copies.plotted == Copies::Quantity::energy;
  std::vector<SeriesColumn> columns;
  for (int n = Copies::original; n < int(Lockstep::most); ++n) {
    const bool there = n < int(ui.session.copies.lockstep.size());
    std::string name = there ? settings_of_cloth(ui.session, n) : "copy " + std::to_string(n + 1);
    for (char& letter : name)
      if (letter == ',') letter = ';';  // it stands in a comma's file
    columns.push_back({name, energy ? "J" : "m"});
  }
  return series(ui, energy ? ui.session.copies.energy : ui.session.copies.distance, columns);
}

std::string convergence(Ui& ui) {
  return convergence_csv(ui.session.studies.convergence.study().value_or(Convergence{}));
}

std::string values(Ui& ui) {
  Simulation* reference =
      ui.session.copies.lockstep.empty() ? nullptr : &cloth_of(ui.session, ui.session.copies.reference);
  return values_csv(*ui.session.simulation, reference);
}

std::string state(Ui& ui) {
  return state_csv(*ui.session.simulation);
}

/// As other programs read it, without bodies.
std::string mesh(Ui& ui) {
  Simulation& cloth = *ui.session.simulation;
  return obj_text(cloth.tears(), cloth.read().x, {.name = ui.session.preset().name, .t = cloth.time(), .fps = 0});
}

void experiment(Ui& ui, const std::filesystem::path& file) {
  if (!is_experiment(file)) throw OutputError("An experiment is called NAME.tyglab; change the ending.");
  settle(ui.session);
  save_experiment(experiment_of(present_line(ui.session), *ui.session.simulation), file);
}

template <std::string (*text)(Ui&)>
void text_file(Ui& ui, const std::filesystem::path& file) {
  write_atomically(file, text(ui));
}

void map_picture(Ui& ui, const std::filesystem::path& file) {
  const auto known = ui.session.studies.map.findings();
  if (!known) throw OutputError("There is no map yet; open it (M) and wait for the first cells.");
  const Preset here =
      at_place(known->of, stiffness_of(ui.session.requested_preset()), ui.session.requested_preset().dt);
  const Chart page = map_page(ui.theme.colors, here, ui.session.document.label, machine_line(), known->grid,
                              known->boundary, known->cells);
  write_png(file, picture_of({page}, 1));
}

constexpr const char* rows_of_samples =
    "One row per sample in the plot: t and a column for each curve, units in the header.";

std::string no_energies(const Ui& ui) {
  return ui.session.recorded.energy.empty() ? "No energies have been recorded: open the Energy card and run." : "";
}
std::string export_no_weight(const Ui& ui) {
  return ui.session.preset().kind == Kind::one_weight ? "" : "That needs the mass on a spring; this is a cloth.";
}
std::string export_no_cloth(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "That needs a cloth; this is a mass on a spring.";
}
std::string no_film(const Ui& ui) {
  if (files_are_handed_out()) return "A page cannot write a folder of images: record the screen, or use the program.";
  return ui.session.simulation->divergence() ? "The cloth has diverged; restart it before a film." : "";
}
void film_dialog_or_stop(Ui& ui) {
  if (!ui.film) return open_dialog(ui, Dialog::Kind::film);
  ui.film->count = ui.film->frame;  // ends it
}
std::string no_mesh(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "OBJ export needs a cloth; this is a mass on a spring.";
}
std::string export_no_copies(const Ui& ui) {
  return ui.session.copies.lockstep.empty() ? "There is no copy to measure; add one first." : "";
}
std::string no_convergence(const Ui& ui) {
  return ui.session.studies.convergence.study() ? "" : "The order of convergence has not been measured yet.";
}

}  // namespace

std::vector<CommandRow> export_rows() {
  std::vector<CommandRow> rows;
  const auto add = [&](const char* id, const char* name, const char* also, Export writes,
                       std::string (*why_not)(const Ui&) = nullptr) -> CommandRow& {
    return rows.emplace_back(CommandRow{id, name, "", {}, "", also, nullptr, why_not, writes});
  };
  add("save_experiment", "Save the experiment…", "repeat replay share write tyglab history",
      {"Save the experiment",
       "The preset, everything done to it since it was opened, and checks of the positions. Opened, it repeats all of "
       "that, step by step.",
       "experiment.tyglab", experiment});
  add("export_forces", "Export forces as CSV…", "plot series",
      {"Export forces as CSV",
       "One row per sample in the plot: t and the magnitude of each force, units in the header.", "forces.csv",
       text_file<forces>});
  add("export_energy", "Export energies as CSV…", "plot series kinetic elastic ledger",
      {"Export energies as CSV", rows_of_samples, "energy.csv", text_file<energies>}, no_energies);
  add("export_height", "Export height as CSV…", "plot series weight mass",
      {"Export height as CSV", rows_of_samples, "height.csv", text_file<height>}, export_no_weight);
  add("export_map", "Export map as CSV…", "stability",
      {"Export map of stiffness and dt as CSV",
       "One row per measured cell: stiffness, dt, the short run's result, the worst-case limit of dt.", "map.csv",
       text_file<map>});
  add("export_map_picture", "Export map as PNG…", "stability picture image",
      {"Export map of stiffness and dt as PNG", "An image of the map with the cells measured so far.", "map.png",
       map_picture});
  add("export_copies", "Export distances of the copies as CSV…", "write lockstep",
      {"Export the copies' plot as CSV", rows_of_samples, "copies.csv", text_file<copies>}, export_no_copies);
  add("export_values", "Export every particle's values as CSV…", "write tension strain speed energy",
      {"Export every particle's values as CSV",
       "One row per particle in its present state, one column for each quantity that can color the cloth.",
       "values.csv", text_file<values>},
      export_no_cloth);
  rows.push_back({"export_film",
                  "Export film…",
                  "",
                  {},
                  "",
                  "video record movie animation clip images sequence png",
                  film_dialog_or_stop,
                  no_film});
  CommandRow& obj = add("export_mesh", "Export OBJ…", "write cloth mesh wavefront blender 3d geometry",
                        {"Export OBJ",
                         "A mesh for other programs: positions in m, texture coordinates, normals, and the triangles "
                         "that are not torn.",
                         "cloth.obj", text_file<mesh>},
                        no_mesh);
  obj.keys = "Ctrl+E", obj.chords = {{GLFW_KEY_E, ctrl}}, obj.help = "exports the cloth as a mesh";
  add("export_state", "Export state as CSV…", "write every particle's position velocity coordinates",
      {"Export state as CSV", "One row per particle in its present state: x and ẋ, with all significant digits.",
       "state.csv", text_file<state>});
  add("export_convergence", "Export convergence as CSV…", "write accuracy order",
      {"Export convergence as CSV", "One row per dt, units in the header.", "convergence.csv", text_file<convergence>},
      no_convergence);
  return rows;
}

}  // namespace tyglab
