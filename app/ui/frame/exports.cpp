// What the window writes to files: a row each.
#include <array>

#include "app/base/glfw_keys.h"
#include "app/session/recorded.h"
#include "app/ui/frame/commands.h"
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

std::string series(const Ui& ui, const Series& of, const std::vector<std::string>& names) {
  return of.csv(names, "tyglab series, t in s, preset hash " + preset_hash(ui.session.preset()));
}

std::string forces(Ui& ui) {
  return series(ui, ui.session.recorded.forces, force_column_names());
}

std::string height(Ui& ui) {
  return series(ui, ui.session.recorded.height, height_column_names());
}

std::string map(Ui& ui) {
  const auto known = ui.session.studies.map.findings();
  return known ? map_csv(known->of, known->cells) : map_csv(ui.session.preset(), {});
}

/// Cloths that are not there keep their empty columns.
std::string copies(Ui& ui) {
  const bool energy = ui.session.copies.plotted == Copies::Quantity::energy;
  std::vector<std::string> names;
  for (int n = Copies::original; n < int(Lockstep::most); ++n) {
    const bool there = n < int(ui.session.copies.lockstep.size());
    std::string name = there ? name_of_cloth(ui.session, n) : "copy " + std::to_string(n + 1);
    for (char& letter : name)
      if (letter == ',') letter = ';';  // it stands in a comma's file
    names.push_back(name + (energy ? " [J]" : " [m]"));
  }
  return series(ui, energy ? ui.session.copies.energy : ui.session.copies.distance, names);
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

template <std::string (*text)(Ui&)>
void text_file(Ui& ui, const std::filesystem::path& file) {
  write_atomically(file, text(ui));
}

void map_picture(Ui& ui, const std::filesystem::path& file) {
  const auto known = ui.session.studies.map.findings();
  if (!known) throw OutputError("There is no map yet; open it (M), and let some of it be measured.");
  const Preset here =
      at_place(known->of, stiffness_of(ui.session.requested_preset()), ui.session.requested_preset().dt);
  const Chart page = map_page(ui.theme.colors, here, ui.session.document.label, machine_line(), known->grid,
                              known->boundary, known->cells);
  write_png(file, picture_of({page}, 1));
}

constexpr const char* rows_of_frames =
    "One row for each drawn frame, as the plot holds them: t and a column for each curve, units in the header.";

std::string export_no_weight(const Ui& ui) {
  return ui.session.preset().kind == Kind::one_weight ? "" : "That belongs to the mass on a spring; this is a cloth.";
}
std::string export_no_cloth(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "That takes a cloth, and this is one weight.";
}
std::string no_mesh(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "An OBJ holds cloth, and this is one weight.";
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
  add("export_forces", "Write the forces as CSV…", "export plot series",
      {"Write the forces as CSV", rows_of_frames, "forces.csv", text_file<forces>});
  add("export_height", "Write the height of the weight as CSV…", "export plot series",
      {"Write the height of the weight as CSV", rows_of_frames, "height.csv", text_file<height>}, export_no_weight);
  add("export_map", "Write the map as CSV…", "export stability",
      {"Write the map of stiffness and dt as CSV",
       "One row for each cell that has been measured: stiffness, dt, what the short run came to, theory's dt.",
       "map.csv", text_file<map>});
  add("export_map_picture", "Write the map as PNG…", "export stability picture",
      {"Write the map of stiffness and dt as PNG", "A picture of the map as far as it has been measured.", "map.png",
       map_picture});
  add("export_copies", "Write the copies' distances as CSV…", "export lockstep",
      {"Write what the copies' plot holds as CSV", rows_of_frames, "copies.csv", text_file<copies>}, export_no_copies);
  add("export_values", "Write every particle's values as CSV…", "export tension strain speed energy",
      {"Write every particle's values as CSV",
       "One row for each particle as it is now, one column for each quantity that can colour the cloth.", "values.csv",
       text_file<values>},
      export_no_cloth);
  CommandRow& obj = add("export_mesh", "Export OBJ…", "write cloth mesh wavefront blender 3d geometry",
                        {"Export OBJ",
                         "A mesh for other programs: positions in m, texture coordinates, normals, and the triangles "
                         "that are whole.",
                         "cloth.obj", text_file<mesh>},
                        no_mesh);
  obj.keys = "Ctrl+E", obj.chords = {{GLFW_KEY_E, GLFW_MOD_CONTROL}}, obj.help = "exports the cloth as a mesh";
  add("export_state", "Write the state as CSV…", "export every particle's position velocity coordinates",
      {"Write the state as CSV", "One row for each particle as it is now: x and ẋ, with all digits that it has.",
       "state.csv", text_file<state>});
  add("export_convergence", "Write the convergence as CSV…", "export accuracy order",
      {"Write the convergence as CSV", "One row for each dt, units in the header.", "convergence.csv",
       text_file<convergence>},
      no_convergence);
  return rows;
}

}  // namespace tyglab
