// Commands for the cloth in the viewport: camera, colors, knife, wind and bodies.
#include "app/tools/tools.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/commands.h"

namespace tyglab {
namespace {

void toggle_cut_path(Ui& ui) {
  bool& along = ui.settings.handling.cut_along_path;
  along = !along;
  ui.messages.note(along ? "A left drag cuts every spring that its path crosses."
                         : "A left drag cuts the springs above the particles near it.");
}

void toggle_wind_arrow(Ui& ui) {
  ui.tools.wind_arrow = !wind_arrow_shown(ui.tools);
}

void frame_cloth(Ui& ui) {
  ui.scene.wants_framing = true;
}

std::string no_cloth(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "Only a cloth can be colored; this is a mass on a spring.";
}

void next_color(Ui& ui) {
  ui.color_by(next_field(ui.scene));
}

template <Body::Shape shape>
void add(Ui& ui) {
  ui.panels = ui.settings.layout.left = true, ui.side = Side::constants;
  ui.settings.layout.folded.erase("Bodies");
  add_body(ui, shape);
}

}  // namespace

std::vector<CommandRow> cloth_rows() {
  return {
      {"frame_cloth", "Frame the cloth", "F", {{GLFW_KEY_F, 0}}, "frames the cloth", "camera zoom view", frame_cloth},
      {"next_color",
       "Next coloring of the cloth",
       "K",
       {{GLFW_KEY_K, 0}},
       "colors the cloth by tension, strain, speed, …",
       "colors heat map",
       next_color,
       no_cloth},
      {"toggle_cut_path",
       "Cut along the path, or upward",
       "C",
       {{GLFW_KEY_C, 0}},
       "cuts along the pointer's path, or upward",
       "knife scissors tool mode springs",
       toggle_cut_path,
       nullptr,
       {},
       [](const Ui& ui) { return ui.settings.handling.cut_along_path; }},
      {"finger_cuts",
       "Cut with one finger",
       "",
       {},
       "",
       "touch screen tablet pen knife",
       [](Ui& ui) { ui.tools.finger_cuts = !ui.tools.finger_cuts; },
       nullptr,
       {},
       [](const Ui& ui) { return ui.tools.finger_cuts; }},
      {"toggle_wind_arrow",
       "Wind arrow",
       "W",
       {{GLFW_KEY_W, 0}},
       "shows the wind as an arrow to drag",
       "gust blow air velocity",
       toggle_wind_arrow,
       nullptr,
       {},
       [](const Ui& ui) { return wind_arrow_shown(ui.tools); }},
      {"add_sphere", "Add a sphere", "", {}, "", "ball body new collision", add<Body::Shape::sphere>, no_more_bodies},
      {"add_plane",
       "Add a plane",
       "",
       {},
       "",
       "floor ground body new collision",
       add<Body::Shape::plane>,
       no_more_bodies},
      {"add_box", "Add a box", "", {}, "", "cube table body new collision", add<Body::Shape::box>, no_more_bodies},
      {"add_capsule", "Add a capsule", "", {}, "", "rod body new collision", add<Body::Shape::capsule>, no_more_bodies},
      {"add_cylinder",
       "Add a cylinder",
       "",
       {},
       "",
       "rod drum can body new collision",
       add<Body::Shape::cylinder>,
       no_more_bodies}};
}

}  // namespace tyglab
