// Marks over the cloth: the particle to grab, the springs to cut, the picked particle with its forces.
#include "app/ui/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

/// While its step is written out: what every spring does to the particle, the strongest drawn about 80 pixels long.
void spring_arrows(Ui& ui, ImDrawList& draw, ImVec2 from) {
  const StepTrace* trace = ui.session.inspector.shown();
  if (trace == nullptr) return;
  const std::vector<StencilForce>& stencils = trace->stages.front().stencils;
  double strongest = 0;
  for (const StencilForce& one : stencils)
    if (one.force->conserves) strongest = std::max(strongest, glm::length(one.F));
  const glm::dvec3 x = ui.session.simulation->position(trace->i, trace->j);
  const double meters = ui.scene.camera.metres_per_pixel(x, ui.viewport.size().y) * ui.theme.px(80);
  for (const StencilForce& one : stencils) {
    if (!one.force->conserves || !(glm::length(one.F) > 0.02 * strongest)) continue;
    const auto to = on_screen(ui, 0, x + one.F / strongest * meters);
    if (!to) continue;
    const ImU32 color = curve_style(ui.theme.colors, one.force->symbol).color;
    draw.AddLine(from, *to, faded(ui.theme.colors.ground, 0.55f), ui.theme.px(4));
    draw.AddLine(from, *to, color, ui.theme.px(1.6f));
    draw.AddCircleFilled(*to, ui.theme.px(2.5f), color, 12);
  }
}

/// What is drawn over the ring of a divergence.
constexpr const char* marks_over_the_ring[] = {"views", "bending", "banner", "legend"};

/// What a ring means, beside it or below or above it; left out where none of these places in the picture is free.
void ring_label(Ui& ui, ImDrawList& draw, glm::vec2 at, float radius_at_1, const char* words) {
  const ImFont& font = *ui.fonts.small;
  const float pad = ui.theme.px(5), reach = ui.theme.px(radius_at_1 + 4);
  const glm::vec2 size = glm::ceil(glm::vec2(text_width(font, words) + 2 * pad, font.FontSize + pad));
  const Box picture{ui.viewport.origin(0), ui.viewport.origin(0) + ui.viewport.size()};
  std::vector<Box> places;
  for (const glm::vec2 lo :
       {glm::vec2(at.x + reach, at.y - size.y / 2), glm::vec2(at.x - reach - size.x, at.y - size.y / 2),
        glm::vec2(at.x - size.x / 2, at.y + reach), glm::vec2(at.x - size.x / 2, at.y - reach - size.y)}) {
    const Box box{glm::round(lo), glm::round(lo) + size};
    if (picture.contains(box.lo) && picture.contains(box.hi)) places.push_back(box);
  }
  const auto box = ui.placing.first_free(places);
  if (!box) return;
  ui.placing.take("ring", *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), faded(ui.theme.colors.ground, 0.85f), ui.theme.px(4));
  draw_text(draw, font, {box->lo.x + pad, std::round(box->lo.y + pad / 2)}, ui.theme.colors.danger, words);
}

}  // namespace

namespace {

/// Whether the cell below and right of a particle is drawn whole.
bool cell_drawn(const Simulation& cloth, int i, int j, double longest) {
  if (!cloth.lattice().has_site(i, j) || !cloth.lattice().has_site(i + 1, j + 1)) return false;
  const PositionView x = cloth.positions();
  const auto edge = [&](int a, int b, int c, int d) { return glm::distance(x.at(a, b), x.at(c, d)) <= longest; };
  return edge(i, j, i, j + 1) && edge(i, j, i + 1, j) && edge(i + 1, j, i + 1, j + 1) && edge(i, j + 1, i + 1, j + 1);
}

/// The particle of the drawn cloth that is nearest to a site by rows and columns; none where that would be elsewhere.
std::optional<Pins::Site> nearest_drawn(const Simulation& cloth, Pins::Site site, double longest) {
  constexpr int most = 6;  // rows or columns away
  std::optional<Pins::Site> nearest;
  int least = most * most + 1;
  for (int i = site.i - most; i <= site.i + most; ++i)
    for (int j = site.j - most; j <= site.j + most; ++j) {
      const int far = (i - site.i) * (i - site.i) + (j - site.j) * (j - site.j);
      if (far >= least || !cloth.lattice().contains(i, j)) continue;
      const bool drawn = cell_drawn(cloth, i, j, longest) || cell_drawn(cloth, i - 1, j, longest) ||
                         cell_drawn(cloth, i, j - 1, longest) || cell_drawn(cloth, i - 1, j - 1, longest);
      if (drawn) nearest = Pins::Site{i, j}, least = far;
    }
  return nearest;
}

/// Where a divergence is seen.
struct SeenSpring {
  ImVec2 from, to;
  bool beside = false;  ///< it is not drawn itself, and this is the drawn cloth beside it
};

std::optional<SeenSpring> seen_spring(Ui& ui, const Divergence& of) {
  const Simulation& cloth = *ui.session.simulation;
  const Pins::Site a{of.i, of.j}, b{of.i + of.di, of.j + of.dj};
  if (!cloth.lattice().contains(a.i, a.j) || !cloth.lattice().contains(b.i, b.j)) return std::nullopt;
  const double longest = longest_drawn_edge(cloth);
  const PositionView x = cloth.positions();
  const bool spring = of.di != 0 || of.dj != 0;
  // Of a spring whose ends have flown apart, the middle may be anywhere. A particle alone may have flown off as well.
  const bool drawn = longest == 0 || (spring ? glm::distance(x.at(a.i, a.j), x.at(b.i, b.j)) <= longest
                                             : nearest_drawn(cloth, a, longest) == a);
  const std::optional<Pins::Site> near = drawn ? a : nearest_drawn(cloth, a, longest);
  if (!near) return std::nullopt;
  const auto from = particle_on_screen(ui, 0, *near), to = drawn ? particle_on_screen(ui, 0, b) : from;
  if (!from || !to) return std::nullopt;
  return SeenSpring{*from, *to, !drawn};
}

}  // namespace

void divergence_mark(Ui& ui, ImDrawList& draw) {
  const Session& session = ui.session;
  const auto& now = session.simulation->divergence();
  const Divergence* of = session.replay ? &session.replay->of : now ? &*now : nullptr;
  if (of == nullptr || session.preset().kind != Kind::cloth) return;
  const auto seen = seen_spring(ui, *of);
  if (!seen) return;
  const auto& [from, to, beside] = *seen;
  const ImVec2 middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
  // A spring that has left the picture is named by the banner; a ring that buttons or the banner cut off says nothing.
  constexpr float least = 11, most = 40, line = 4;  // px at scale 1
  const glm::vec2 lo = ui.viewport.origin(0), hi = lo + ui.viewport.size(), at(middle.x, middle.y);
  if (!Box{lo, hi}.contains(at)) return;
  const auto cut_off = [&](float radius) {
    const glm::vec2 reach(ui.theme.px(radius + line));
    const Box box{at - reach, at + reach};
    return std::any_of(std::begin(marks_over_the_ring), std::end(marks_over_the_ring), [&](const char* name) {
      const Box* mark = ui.placing.find(name);
      return mark != nullptr && overlap(*mark, box);
    });
  };
  const float half = std::hypot(to.x - from.x, to.y - from.y) / 2 / ui.theme.scale;
  float radius = std::clamp(half + 8, least, most);
  if (cut_off(radius)) radius = least;
  if (cut_off(radius)) return;
  draw.PushClipRect(vec(lo), vec(hi), true);
  ring(ui, draw, middle, radius, ui.theme.colors.danger, 3);
  draw.PopClipRect();
  ring_label(ui, draw, at, radius + line,
             session.replay ? "diverges first"
             : beside       ? "diverged first beside this"
                            : "diverged first");
}

void picked_overlay(Ui& ui, ImDrawList& draw) {
  if (!ui.session.picked || ui.session.preset().kind != Kind::cloth) return;
  for (int tile = 0; tile < ui.session.copies.tiles(); ++tile) {
    const auto at = particle_on_screen(ui, tile, *ui.session.picked);
    if (!at) continue;
    const glm::vec2 lo = ui.viewport.origin(tile), hi = lo + ui.viewport.size();
    draw.PushClipRect(vec(lo), vec(hi), true);  // what points far stays in its own picture
    if (tile == 0) spring_arrows(ui, draw, *at);
    if (ui.arrows && !cloth_in_tile(ui.scene, tile).divergence()) particle_arrows(ui, draw, tile, *at);
    ring(ui, draw, *at, 7, ui.theme.colors.text, 2);
    draw.PopClipRect();
  }
}

namespace {

/// Where a mark of that size stands at the edge of a picture: on the way from its middle, or beside that.
std::optional<Box> place_at_edge(const Ui& ui, int tile, glm::vec2 way, glm::vec2 size) {
  const float margin = ui.theme.px(10);
  const glm::vec2 lo = ui.viewport.origin(tile) + margin, hi = lo + ui.viewport.size() - 2 * margin - size;
  if (hi.x < lo.x || hi.y < lo.y) return std::nullopt;
  const glm::vec2 half = (hi - lo) / 2.f, share = glm::abs(way) / glm::max(half, glm::vec2(1));
  const glm::vec2 at = (lo + hi) / 2.f + way / std::max({share.x, share.y, 1e-6f});
  const glm::vec2 along = share.x > share.y ? glm::vec2(0, size.y) : glm::vec2(size.x, 0);
  std::vector<Box> places;
  for (const float k : {0.f, 1.f, -1.f, 2.f, -2.f, 3.f, -3.f, 4.f, -4.f}) {
    const glm::vec2 place = glm::round(glm::clamp(at + k * along, lo, hi));
    places.push_back({place, place + size});
  }
  return ui.placing.first_free(places);
}

}  // namespace

void ways_to_cloth(Ui& ui, ImDrawList& draw) {
  const ImFont& font = *ui.fonts.text;
  const char* what = ui.session.preset().kind == Kind::cloth ? "Cloth" : "Mass";
  const float pad = ui.theme.px(8), tip = ui.theme.px(7);
  const glm::vec2 size = glm::ceil(glm::vec2(text_width(font, what) + 3 * pad + 2 * tip, font.FontSize + pad));
  for (int tile = 0; tile < ui.session.copies.tiles(); ++tile) {
    const auto way = ui.scene.views.way_to_cloth(ui.scene, tile);
    const auto box = way ? place_at_edge(ui, tile, *way, size) : std::nullopt;
    if (!box) continue;
    const std::string name = "way_to_cloth" + (tile == 0 ? "" : std::to_string(tile));
    ui.placing.take(name, *box);
    cover_viewport(ui, vec(box->lo), vec(box->hi));
    ImGui::SetCursorScreenPos(vec(box->lo));
    if (gui::press_area(name.c_str(), vec(size))) ui.command("frame_cloth");
    report_control(ui, name);
    const Tokens& c = ui.theme.colors;
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    tooltip(ui, gui::item_id(), "Out of view. Click to frame it.", ui.keys_of("frame_cloth"));
    draw.AddRectFilled(vec(box->lo), vec(box->hi), hovered ? c.field_hover : c.panel, ui.theme.px(6));
    draw.AddRect(vec(box->lo), vec(box->hi), c.accent, ui.theme.px(6), 0, std::max(1.f, ui.theme.px(1)));
    const glm::vec2 ahead = glm::normalize(*way), across(-ahead.y, ahead.x),
                    middle(box->lo.x + pad + tip, (box->lo.y + box->hi.y) / 2);
    draw.AddTriangleFilled(vec(middle + tip * ahead), vec(middle - tip * 0.6f * ahead + tip * 0.8f * across),
                           vec(middle - tip * 0.6f * ahead - tip * 0.8f * across), c.accent);
    draw_text(draw, font, {box->lo.x + 2 * pad + 2 * tip, std::round(middle.y - font.FontSize / 2)}, c.text, what);
  }
}

void pointer_overlay(Ui& ui, ImDrawList& draw) {
  ui.scene.colors.under_pointer.reset();
  const Tokens& c = ui.theme.colors;
  const ImVec2 mouse = vec(ui.input.at);
  const float r = ui.theme.px(8);
  switch (ui.tools.tool.kind) {
    case Tool::Kind::cut: {
      ImGui::SetMouseCursor(ImGuiMouseCursor_None);
      const char* scissors = icon_or(ui.fonts, icon::scissors, "×");
      draw_text(draw, *ui.fonts.large_icons, {mouse.x - r + 1, mouse.y - r + 1}, c.ground, scissors);
      draw_text(draw, *ui.fonts.large_icons, {mouse.x - r, mouse.y - r}, c.magenta, scissors);
      return;
    }
    case Tool::Kind::grab:
      if (const auto held = ui.session.simulation->held())
        if (const auto at = particle_on_screen(ui, ui.tools.tool.tile, *held)) {
          if (std::hypot(at->x - mouse.x, at->y - mouse.y) > r)
            draw.AddLine(*at, mouse, faded(c.accent, 0.8f), ui.theme.px(1.5f));
          ring(ui, draw, *at, 10, c.accent, 2.5f);
          draw.AddCircleFilled(*at, ui.theme.px(3.5f), c.accent, 16);
        }
      return;
    case Tool::Kind::orbit:
    case Tool::Kind::pan:
    case Tool::Kind::body:
    case Tool::Kind::wind:
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
      return;
    case Tool::Kind::right:
    case Tool::Kind::none:
      break;
  }
  if (ui.session.preset().kind != Kind::cloth) return;
  if (wind_under_pointer(ui.tools) || body_under_pointer(ui.tools)) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return;
  }
  if (ui.settings.handling.cut_along_path) springs_to_cut(ui, draw);
  if (const auto site = particle_under_pointer(ui.tools)) {
    const int tile = ui.viewport.tile_at(ui.input.at);
    ui.scene.colors.under_pointer = ui.scene.colors.value(tile, *site);
    if (const auto at = particle_on_screen(ui, tile, *site)) {
      const bool pinned = ui.session.simulation->pinned(site->i, site->j);
      ring(ui, draw, *at, 5, pinned ? c.warning : c.accent, 2);
    }
  }
}

}  // namespace tyglab
