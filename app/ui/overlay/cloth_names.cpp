// Which cloth a picture shows, at its foot, while there are copies.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/base/numbers.h"
#include "app/base/text_lines.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/cloth_style.h"

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

}  // namespace

void cloth_names(Ui& ui, ImDrawList& draw) {
  const Copies& copies = ui.session.copies;
  if (copies.lockstep.empty()) return;
  const Tokens& c = ui.theme.colors;
  const bool narrow = ui.viewport.size().x < ui.theme.px(narrow_at_1);
  const ImFont& font = narrow ? *ui.fonts.small : *ui.fonts.text;
  const float pad = ui.theme.px(8), edge = narrow ? pad : 2 * pad, sample = ui.theme.px(narrow ? 14 : 24),
              line = font.FontSize + pad / 2;
  const int count = int(copies.lockstep.size());
  float foot = ui.viewport.origin(0).y + ui.viewport.size().y - edge;
  for (int n = count - 1; n >= Copies::original; --n) {
    const glm::vec2 origin = ui.viewport.origin(copies.overlaid ? 0 : n + 1);
    if (!copies.overlaid) foot = origin.y + ui.viewport.size().y - edge;
    const auto words =
        name_lines(name_of_cloth(ui.session, n), state_of(ui, n), ui.viewport.size().x - sample - 3 * pad - 2 * edge,
                   most_lines, [&font](std::string_view piece) { return text_width(font, piece); });
    float width = 0;
    for (const std::string& text : words) width = std::max(width, text_width(font, text));
    const glm::vec2 size = glm::ceil(glm::vec2(sample + 3 * pad + width, line * float(words.size()) + pad / 2));
    const glm::vec2 lo = glm::round(glm::vec2(origin.x + edge, foot - size.y));
    draw.AddRectFilled(vec(lo), vec(lo + size), faded(c.ground, 0.85f), ui.theme.px(6));
    ui.placing.take("name " + std::to_string(n + 1), {lo, lo + size});
    name_area(ui, n, lo, size);
    const float middle = std::round(lo.y + pad / 2 + font.FontSize / 2);
    const ImVec2 ends[2] = {{lo.x + pad, middle}, {lo.x + pad + sample, middle}};
    CurveStyle style = cloth_style(ui.theme.colors, ui.session, n);
    if (copies.overlaid) style.line = LineStyle::solid;  // as the nets are drawn
    draw_styled_line(draw, ends, 2, style, ui.theme.scale);
    for (std::size_t k = 0; k < words.size(); ++k)
      draw_text(draw, font, {lo.x + 2 * pad + sample, lo.y + pad / 2 + line * float(k)},
                cloth_of(ui.session, n).divergence() ? c.danger : c.text, words[k]);
    foot = lo.y;
  }
}

}  // namespace tyglab
