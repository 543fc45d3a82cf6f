// Bodies (2.1.5) and what is shown of the cloth: the last sections of the constants.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "app/base/data_files.h"
#include "app/tools/wind_arrow.h"
#include "app/ui/constants/constant_row.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr std::size_t most_bodies = 64;

bool belongs(const BodyRow& row, Body::Shape shape) {
  if (row.key == "c" || row.key == "r") return shape == Body::Shape::sphere;
  if (row.key == "y") return shape == Body::Shape::plane;
  return true;
}

void add_body(App& app, Body::Shape shape) {
  Preset next = app.requested_preset();
  Body body;
  body.shape = shape;
  // Below the middle of the cloth, where it will be met.
  const double size = std::max(next.rows - 1, next.columns - 1) * next.L * next.initial_stretch;
  body.c = next.x_0 - glm::dvec3(0, 1.2 * size, 0);
  body.r = std::clamp(0.25 * size, 1e-3, 100.0);
  body.y = next.x_0.y - 1.6 * size;
  next.bodies.push_back(body);
  app.propose(std::move(next));
}

void remove_body(App& app, int index) {
  Preset next = app.requested_preset();
  next.bodies.erase(next.bodies.begin() + index);
  app.propose(std::move(next));
}

void body_block(App& app, int index) {
  const Body& body = app.requested_preset().bodies[index];
  const float side = app.theme.px(22);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = app.ui.row_width;
  char title[48];
  std::snprintf(title, sizeof title, "%s %d", body.shape == Body::Shape::sphere ? "Sphere" : "Plane", index + 1);
  draw_text(*ImGui::GetWindowDrawList(), *app.fonts.text, {lo.x, lo.y + app.theme.px(3)}, app.theme.colors.text, title);
  ImGui::SetCursorScreenPos({lo.x + width - side, lo.y});
  if (quiet_button(app, "remove", icon::trash, "remove", "Remove this body")) remove_body(app, index);
  for (const BodyRow& row : body_notation())
    if (belongs(row, body.shape)) body_row(app, row, index);
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

/// How the pointer's tools work.
void tool_rows(App& app) {
  const ToolSettings& handling = app.settings.handling;
  labelled_row(app, "cut", [&](float) {
    static constexpr const char* ways[] = {"upwards", "along the path"};
    const int now = handling.cut_along_path ? 1 : 0;
    if (const int k = segments(app, "cut", ways, 2, now); k >= 0 && k != now) app.command(Command::toggle_cut_path);
    tooltip(app, gui::item_id(),
            "What a left drag cuts: the springs upwards of each particle near it, as in the report, or every spring "
            "and edge of a triangle that it crosses, through all layers.",
            row_of(Command::toggle_cut_path).keys);
  });
  labelled_row(app, "hand", [&](float) {
    if (check(app, "slow motion", handling.slow_hand)) app.command(Command::toggle_slow_hand);
    tooltip(app, gui::item_id(), "A quarter of the speed while you grab or cut.",
            row_of(Command::toggle_slow_hand).keys);
    ImGui::SameLine(0, app.theme.px(16));
    if (check(app, "wind arrow", wind_arrow_shown(app))) app.command(Command::toggle_wind_arrow);
    tooltip(app, gui::item_id(), "The wind W as an arrow in the picture: drag its tip.",
            row_of(Command::toggle_wind_arrow).keys);
  });
}

void texture_row(App& app) {
  labelled_row(app, "texture", [&](float width) {
    const std::string now = std::filesystem::path(app.requested_preset().texture).filename().string();
    if (!begin_combo(app, "##texture", now.c_str(), width)) return;
    for (const std::string& name : shipped_textures())
      if (ImGui::Selectable(name.c_str(), name == app.requested_preset().texture) &&
          name != app.requested_preset().texture)
        app.request(request::LoadTexture{name});
    ImGui::Separator();
    if (ImGui::Selectable("Other file…")) app.command(Command::load_texture_dialog);
    end_combo();
  });
}

}  // namespace

void view_section(App& app) {
  if (!section(app, "View")) return;
  const bool cloth = app.requested_preset().kind == Kind::cloth;
  if (cloth) texture_row(app);
  labelled_row(app, "show", [&](float) {
    if (!cloth) {
      if (check(app, "shadows", app.view.shadows)) app.view.shadows = !app.view.shadows;
      return;
    }
    if (check(app, "arrows", app.ui.arrows)) app.ui.arrows = !app.ui.arrows;
    tooltip(app, gui::item_id(),
            "Of the variables that are ticked under “Picked particle”, in the colours of their curves.");
    ImGui::SameLine(0, app.theme.px(16));
    if (check(app, "shadows", app.view.shadows)) app.view.shadows = !app.view.shadows;
  });
  labelled_row(app, "effects", [&](float) {
    if (check(app, "all, however slow", app.effects.mode == Effects::Mode::all)) app.command(Command::toggle_effects);
    tooltip(
        app, gui::item_id(),
        "Where drawing takes longer than 20 ms, soft edges of shadows are left out, then smooth edges, then shadows; "
        "the status bar says so.");
  });
  if (cloth) tool_rows(app);
}

void body_sections(App& app) {
  if (!section(app, "Bodies")) return;
  for (int k = 0; k < int(app.requested_preset().bodies.size()); ++k) {
    ImGui::PushID(k);
    body_block(app, k);
    ImGui::PopID();
  }
  const bool room = app.requested_preset().bodies.size() < most_bodies;
  if (text_button(app, "Add sphere", false, room)) add_body(app, Body::Shape::sphere);
  ImGui::SameLine();
  if (text_button(app, "Add plane", false, room)) add_body(app, Body::Shape::plane);
}

}  // namespace tyglab
