// The name of each cloth at the foot of its picture, while there are copies.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/ui.h"

namespace tyglab {
namespace {

constexpr std::size_t most_lines = 3;
constexpr float narrow_at_1 = 220;  // pixels of a picture's width, under which its name is written small

/// What there is to tell beside the name; empty: nothing.
std::string state_of(const Ui& ui, int n) {
  if (const auto& divergence = cloth_of(ui.session, n).divergence())
    return "diverged at t = " + time_number(divergence->t, cloth_of(ui.session, n).preset().dt) + " s";
  return n == ui.session.copies.reference ? "reference" : "";
}

/// No press on a name goes through to the cloth; one on the name of a cloth that has diverged tells why.
void name_area(Ui& ui, int n, glm::vec2 lo, glm::vec2 size) {
  if (ui.picture && !ui.picture->whole_window) return;
  cover_viewport(ui, vec(lo), vec(lo + size));
  if (!cloth_of(ui.session, n).divergence()) return;
  const std::string id = n == Copies::original ? "name_of_original" : "name_of_copy" + std::to_string(n);
  ImGui::SetCursorScreenPos(vec(lo));
  if (gui::press_area(id.c_str(), vec(size))) ui.show_why_diverged(n);
  report_control(ui, id);
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  ImGui::GetWindowDrawList()->AddRect(vec(lo), vec(lo + size), ui.theme.colors.danger, ui.theme.px(6));
  tooltip(ui, gui::item_id(), "Click to see why it diverged.");
}

/// How names are written in pictures as narrow as these.
struct NameStyle {
  const ImFont& font;
  float pad, edge, sample, line;  ///< px
};

NameStyle name_style(const Ui& ui) {
  const bool narrow = ui.viewport.size().x < ui.theme.px(narrow_at_1);
  const ImFont& font = narrow ? *ui.fonts.small : *ui.fonts.text;
  const float pad = ui.theme.px(8);
  return {font, pad, narrow ? pad : 2 * pad, ui.theme.px(narrow ? 14 : 24), font.FontSize + pad / 2};
}

std::vector<std::string> words_of(const Ui& ui, const NameStyle& style, int n) {
  const float room = ui.viewport.size().x - style.sample - 3 * style.pad - 2 * style.edge;
  return name_lines(name_of_cloth(ui.session, n), state_of(ui, n), room, most_lines,
                    [&](std::string_view piece) { return text_width(style.font, piece); });
}

float height_of(const NameStyle& style, const std::vector<std::string>& words) {
  return std::ceil(style.line * float(words.size()) + style.pad / 2);
}

/// A cloth is as wide as a picture that is higher than wide: overlaid, the names then stand above it.
bool names_above(const Ui& ui) {
  return ui.session.copies.overlaid && ui.viewport.size().x < ui.viewport.size().y;
}

/// Draws one whose lower edge is at `foot`. Returns its upper edge.
float name(Ui& ui, ImDrawList& draw, const NameStyle& style, int n, float left, float foot) {
  const Tokens& c = ui.theme.colors;
  const auto words = words_of(ui, style, n);
  float width = 0;
  for (const std::string& text : words) width = std::max(width, text_width(style.font, text));
  const float before = style.pad + style.sample + style.pad;
  const glm::vec2 size(std::ceil(before + width + style.pad), height_of(style, words)),
      lo = glm::round(glm::vec2(left, foot - size.y));
  draw.AddRectFilled(vec(lo), vec(lo + size), faded(c.ground, 0.85f), ui.theme.px(6));
  ui.placing.take("name " + std::to_string(n + 1), {lo, lo + size});
  name_area(ui, n, lo, size);
  const float middle = std::round(lo.y + style.pad / 2 + style.font.FontSize / 2);
  const ImVec2 ends[2] = {{lo.x + style.pad, middle}, {lo.x + style.pad + style.sample, middle}};
  CurveStyle curve = cloth_style(c, ui.session, n);
  if (ui.session.copies.overlaid) curve.line = LineStyle::solid;  // as the nets are drawn
  draw_styled_line(draw, ends, 2, curve, ui.theme.scale);
  for (std::size_t k = 0; k < words.size(); ++k)
    draw_text(draw, style.font, {lo.x + before, lo.y + style.pad / 2 + style.line * float(k)},
              cloth_of(ui.session, n).divergence() ? c.danger : c.text, words[k]);
  return lo.y;
}

}  // namespace

float names_above_height(const Ui& ui) {
  const Copies& copies = ui.session.copies;
  if (copies.lockstep.empty() || !names_above(ui)) return 0;
  const NameStyle style = name_style(ui);
  float sum = style.pad;
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) sum += height_of(style, words_of(ui, style, n));
  return sum;
}

float names_below_height(const Ui& ui) {
  const Copies& copies = ui.session.copies;
  if (copies.lockstep.empty() || copies.overlaid) return 0;
  const NameStyle style = name_style(ui);
  float most = 0;
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n)
    most = std::max(most, height_of(style, words_of(ui, style, n)));
  return most + style.edge;
}

void cloth_names(Ui& ui, ImDrawList& draw) {
  const Copies& copies = ui.session.copies;
  if (copies.lockstep.empty()) return;
  const NameStyle style = name_style(ui);
  const float height = ui.viewport.size().y;
  float foot = ui.viewport.origin(0).y + (names_above(ui) ? ui.viewport.buttons - style.pad : height - style.edge);
  for (int n = int(copies.lockstep.size()) - 1; n >= Copies::original; --n) {
    const glm::vec2 origin = ui.viewport.origin(copies.overlaid ? 0 : n + 1);
    if (!copies.overlaid) foot = origin.y + height - style.edge;
    foot = name(ui, draw, style, n, origin.x + style.edge, foot);
  }
}

}  // namespace tyglab
