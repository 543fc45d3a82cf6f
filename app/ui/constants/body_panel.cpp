// Bodies (2.1.5) and the display options of the cloth: the last sections of the constants.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "app/base/files.h"
#include "app/tools/tools.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/forces/contact.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr std::size_t most_bodies = 64;

bool seen_whole(const Ui& ui, const Bounds& box) {
  const glm::vec2 size = ui.viewport.size();
  const auto part = size.x > 1 && size.y > 1 ? part_of_picture(ui.scene.camera, box, size.x / size.y) : std::nullopt;
  return part && part->lo.x >= 0 && part->lo.y >= 0 && part->hi.x <= 1 && part->hi.y <= 1;
}

/// A length with as many decimals as a hundredth of `size` has, so that it is read easily.
double in_hundredths(double length, double size) {
  const double decimals = 2 - std::round(std::log10(size)), power = std::pow(10, std::abs(decimals));
  const double near = decimals >= 0 ? std::round(length * power) / power : std::round(length / power) * power;
  return near + 0.0;  // no -0
}

/// "Sphere", or "Sphere 2" where there are several.
std::string name_of_body(const std::vector<Body>& bodies, int index) {
  const Body::Shape shape = bodies[std::size_t(index)].shape;
  const auto same = [shape](const Body& body) { return body.shape == shape; };
  const std::string name(title_of(shape));
  if (std::count_if(bodies.begin(), bodies.end(), same) == 1) return name;
  return name + " " + std::to_string(std::count_if(bodies.begin(), bodies.begin() + index + 1, same));
}

void remove_body(Ui& ui, int index) {
  Preset next = ui.session.requested_preset();
  next.bodies.erase(next.bodies.begin() + index);
  ui.session.propose(std::move(next));
}

void body_block(Ui& ui, int index) {
  const std::vector<Body>& bodies = ui.session.requested_preset().bodies;
  const Body::Shape shape = bodies[std::size_t(index)].shape;
  const float side = ui.theme.px(22);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ui.row_width;
  draw_text(*ImGui::GetWindowDrawList(), *ui.fonts.text, {lo.x, lo.y + ui.theme.px(3)}, ui.theme.colors.text,
            name_of_body(bodies, index));
  ImGui::SetCursorScreenPos({lo.x + width - side, lo.y});
  if (quiet_button(ui, "remove", icon::trash, "remove", "Remove this body")) return remove_body(ui, index);
  const ImVec2 below = ImGui::GetCursorScreenPos();
  const Body& body = bodies[std::size_t(index)];
  const bool moves = any_moves({&body, 1}) || body.turn != glm::dvec3(0);
  bool* shown = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("motion"), moves);
  ImGui::SetCursorScreenPos({lo.x + width - 2 * side - ui.theme.px(4), lo.y});
  if (quiet_button(ui, "motion", icon::move, "motion",
                   *shown ? "Hide how it is turned and moves" : "Show how it is turned and moves"))
    *shown = !*shown;
  ImGui::SetCursorScreenPos(below);
  for (const BodyRow& row : body_notation()) {
    const bool motion = row.key == "turn" || row.key == "velocity" || row.key == "spin";
    if (shape_has(shape, row.key) && (!motion || *shown || moves)) body_row(ui, row, index);
  }
  if (!body.path.empty())
    labeled_row(ui, "path", [&](float) {
      ImGui::TextUnformatted((std::to_string(body.path.size()) + " keys, from the file").c_str());
    });
}

std::vector<std::string> shipped_textures() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "textures", ignored)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".png" || extension == ".jpg") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A second check beside the first one, or under it where it has no room in a row of that width, px.
void next_check(const Ui& ui, const char* first, const char* second, float width) {
  const float gap = ui.theme.px(16), left = ImGui::GetItemRectMin().x, bottom = ImGui::GetItemRectMax().y;
  if (check_width(ui, first) + gap + check_width(ui, second) <= width)
    ImGui::SameLine(0, gap);
  else
    ImGui::SetCursorScreenPos({left, bottom + ui.theme.px(2)});
}

/// How the pointer's tools work.
void tool_rows(Ui& ui) {
  const ToolSettings& handling = ui.settings.handling;
  labeled_row(ui, "cut", [&](float width) {
    static constexpr const char* ways[] = {"upward", "along the path"};
    const int now = handling.cut_along_path ? 1 : 0;
    if (const int k = segments(ui, "cut", ways, 2, now, 11, width); k >= 0 && k != now) ui.command("toggle_cut_path");
    tooltip(ui, gui::item_id(),
            "Choose what a left drag cuts: the springs above each particle near its path, or every spring and triangle "
            "edge that it crosses, through all layers.",
            ui.keys_of("toggle_cut_path"));
  });
  labeled_row(ui, "hand", [&](float width) {
    if (check(ui, "slow motion", handling.slow_hand)) ui.command("toggle_slow_hand");
    tooltip(ui, gui::item_id(), "Runs at a quarter of the speed while you grab or cut.",
            ui.keys_of("toggle_slow_hand"));
    next_check(ui, "slow motion", "wind arrow", width);
    if (check(ui, "wind arrow", wind_arrow_shown(ui.tools))) ui.command("toggle_wind_arrow");
    tooltip(
        ui, gui::item_id(),
        "Shows the wind W as an arrow in the scene, or where there is air but no W the air's velocity u: drag its tip.",
        ui.keys_of("toggle_wind_arrow"));
  });
}

void texture_row(Ui& ui) {
  labeled_row(ui, "texture", [&](float width) {
    const std::string now = std::filesystem::path(ui.session.requested_preset().texture).filename().string();
    if (!begin_combo(ui, "##texture", now.c_str(), width)) return;
    for (const std::string& name : shipped_textures())
      if (ImGui::Selectable(name.c_str(), name == ui.session.requested_preset().texture) &&
          name != ui.session.requested_preset().texture)
        ui.session.request(request::LoadTexture{name});
    ImGui::Separator();
    if (ImGui::Selectable("Other file…")) ui.command("load_texture_dialog");
    end_combo();
  });
}

}  // namespace

void add_body(Ui& ui, Body::Shape shape) {
  constexpr double farthest = 1e3, usual_friction = 0.5;  // m, of c and y
  Preset next = ui.session.requested_preset();
  const bool readable = !ui.session.rebuild.holds_present() && !ui.session.simulation->divergence();
  const Bounds scene = scene_bounds(next), cloth = readable ? bounds(ui.session.simulation->positions()) : scene;
  const double size = std::max(next.rows - 1, next.columns - 1) * next.L * next.initial_stretch;
  const glm::dvec3 middle = glm::dvec3(cloth.lo + cloth.hi) / 2.0;
  Body body;
  body.shape = shape;
  body.friction = usual_friction;
  Bounds shown;
  if (shape != Body::Shape::plane) {
    body.r = std::clamp(in_hundredths((shape == Body::Shape::sphere ? 0.25 : 0.12) * size, size), 1e-3, 100.0);
    body.length = std::clamp(in_hundredths(0.6 * size, size), 1e-3, 200.0);
    body.size = glm::dvec3(std::clamp(in_hundredths(0.4 * size, size), 1e-3, 200.0));
    // Lying, as a rod over which cloth is hung.
    if (shape_has(shape, "length")) body.turn.z = 90;
    const double half = shape == Body::Shape::box ? body.size.y / 2 : body.r, clear = 1.3 * half;
    const auto floor = floor_height(next);
    const bool lies = floor && cloth.lo.y - clear - half < *floor;
    const glm::dvec3 c(middle.x, lies ? cloth.hi.y + clear : cloth.lo.y - clear, middle.z);
    for (int k = 0; k < 3; ++k) body.c[k] = std::clamp(in_hundredths(c[k], size), -farthest, farthest);
    shown = body_bounds(body, cloth).value_or(cloth);
  } else {
    const double y = std::min(scene.lo.y, cloth.lo.y) - 0.05 * size;
    body.y = std::clamp(in_hundredths(y, size), -farthest, farthest);
    shown.add(glm::vec3(middle.x, body.y, middle.z));
  }
  if (!seen_whole(ui, shown)) ui.scene.wants_framing = true;
  ui.slider.shown_key = "bodies[" + std::to_string(next.bodies.size()) + "]." + std::string(body_notation().back().key);
  next.bodies.push_back(body);
  ui.session.propose(std::move(next));
}

std::string no_more_bodies(const Ui& ui) {
  const Preset& preset = ui.session.requested_preset();
  if (preset.kind != Kind::cloth) return "Bodies are added to a cloth; a mass on a spring has those of its preset.";
  return preset.bodies.size() < most_bodies ? "" : "A scene has at most " + std::to_string(most_bodies) + " bodies.";
}

void view_section(Ui& ui) {
  if (!section(ui, "View")) return;
  const bool cloth = ui.session.requested_preset().kind == Kind::cloth;
  if (cloth) texture_row(ui);
  labeled_row(ui, "show", [&](float width) {
    if (!cloth) {
      if (check(ui, "shadows", ui.scene.view.shadows)) ui.scene.view.shadows = !ui.scene.view.shadows;
      return;
    }
    if (check(ui, "arrows", ui.arrows)) ui.arrows = !ui.arrows;
    tooltip(ui, gui::item_id(), "For the variables checked under “Picked particle”, in the colors of their curves.");
    next_check(ui, "arrows", "shadows", width);
    if (check(ui, "shadows", ui.scene.view.shadows)) ui.scene.view.shadows = !ui.scene.view.shadows;
  });
  labeled_row(ui, "effects", [&](float) {
    if (check(ui, "full quality (may be slow)", ui.scene.effects.mode == Effects::Mode::all))
      ui.command("toggle_effects");
    tooltip(ui, gui::item_id(),
            "If drawing takes longer than 20 ms, soft shadow edges are turned off, then smooth edges, then shadows; "
            "the status bar says so.");
  });
  if (cloth) tool_rows(ui);
}

void body_sections(Ui& ui) {
  if (!section(ui, "Bodies")) return;
  for (int k = 0; k < int(ui.session.requested_preset().bodies.size()); ++k) {
    ImGui::PushID(k);
    body_block(ui, k);
    ImGui::PopID();
  }
  if (!ui.session.requested_preset().bodies.empty())
    word_row(
        ui, "contact", "contact", &Preset::contact, contact_names, contact_titles,
        "When bodies act: at the time of contact within the step (order 2 without damping), at the end of the step "
        "as in the report (order 1), or in steps that are split at every impact (the method's order, slow).");
  const bool room = no_more_bodies(ui).empty();
  if (text_button(ui, "Add sphere", false, room)) add_body(ui, Body::Shape::sphere);
  ImGui::SameLine();
  if (text_button(ui, "Add plane", false, room)) add_body(ui, Body::Shape::plane);
  if (begin_combo(ui, "##other bodies", "Add another body", ui.row_width)) {
    for (const Body::Shape shape : {Body::Shape::box, Body::Shape::capsule, Body::Shape::cylinder})
      if (ImGui::Selectable(std::string(title_of(shape)).c_str(), false, room ? 0 : ImGuiSelectableFlags_Disabled))
        add_body(ui, shape);
    end_combo();
  }
}

}  // namespace tyglab
