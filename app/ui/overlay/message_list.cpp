// What the program tells, over the cloth for a few seconds.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/base/text_lines.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/overlay/viewport_panel.h"

namespace tyglab {
namespace {

constexpr float widest_at_1 = 460, lowest_at_1 = 36, padding_at_1 = 12, above_at_1 = 9;  // pixels at scale 1
constexpr float icon_at_1 = 24, close_at_1 = 22, between_at_1 = 8, edge_at_1 = 16;

/// A message in lines.
struct Note {
  std::string text;
  glm::vec2 size;  ///< px
};

std::vector<Note> notes_in_lines(const Ui& ui) {
  const ImFont& font = *ui.fonts.text;
  const float beside = ui.theme.px(2 * padding_at_1 + icon_at_1 + close_at_1);
  const float most = std::min(ui.theme.px(widest_at_1), ui.viewport.whole().x - ui.theme.px(2 * edge_at_1));
  std::vector<Note> notes;
  for (const Message& message : ui.session.messages.list()) {
    std::string text = in_lines(font, capitalised(message.text), most - beside);
    const float width = font.CalcTextSizeA(font.FontSize, 1e9f, 0, text.c_str()).x;
    const float height = std::max(height_of(font, text) + 2 * ui.theme.px(above_at_1), ui.theme.px(lowest_at_1));
    notes.push_back({std::move(text), {std::min(std::ceil(width) + beside, most), height}});
  }
  return notes;
}

/// Where they stand below each other, all equally wide: in the corner in which they covered least of the cloth when the
/// first of them came.
Box place_of_notes(Ui& ui, glm::vec2 size) {
  const glm::vec2 edge(ui.theme.px(edge_at_1));
  const Box area{{ui.viewport.box.lo.x + edge.x, ui.notes_from}, ui.viewport.box.hi - edge};
  const auto in = [&](ScreenCorner corner) { return ui.placing.in_corner(area, size, corner); };
  std::array<std::optional<Box>, 4> places{in(ScreenCorner::upper_left), in(ScreenCorner::upper_right), {}, {}};
  // What is said of a divergence may reach up over the lower ones.
  if (!ui.session.simulation->divergence())
    places[2] = in(ScreenCorner::lower_left), places[3] = in(ScreenCorner::lower_right);
  // It stands still while it is read.
  if (!ui.notes_place || !places[*ui.notes_place]) ui.notes_place = choose_place(places, drawn_parts(ui), {});
  return ui.notes_place ? *places[*ui.notes_place] : Box{area.lo, area.lo + size};
}

/// Returns whether it was clicked away.
bool draw_note(Ui& ui, const Message& message, const Note& note, ImVec2 lo, ImVec2 hi) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.text;
  const bool told = message.severity == Message::Severity::note;
  const ImU32 color = told ? c.accent : message.severity == Message::Severity::warning ? c.warning : c.danger;
  const float padding = ui.theme.px(padding_at_1), line = lo.y + ui.theme.px(above_at_1);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(lo, hi, c.panel, ui.theme.px(6));
  draw.AddRectFilled(lo, {lo.x + ui.theme.px(3), hi.y}, color, ui.theme.px(6), ImDrawFlags_RoundCornersLeft);
  draw_text(draw, font, {lo.x + padding, line + ui.theme.px(1)}, color,
            icon_or(ui.fonts, told ? icon::info : icon::warning, told ? "i" : "!"));
  draw_text(draw, font, {lo.x + padding + ui.theme.px(icon_at_1), line}, c.text, note.text);
  ImGui::SetCursorScreenPos(lo);
  const bool clicked = gui::press_area("dismiss", {hi.x - lo.x, hi.y - lo.y});
  report_control(ui, "dismiss");
  tooltip(ui, gui::item_id(), "Click to dismiss");
  draw_text(draw, font, {hi.x - ui.theme.px(close_at_1), line + ui.theme.px(1)},
            ImGui::IsItemHovered() ? c.text : c.quiet, icon_or(ui.fonts, icon::close, "x"));
  cover_viewport(ui, lo, hi);
  return clicked;
}

}  // namespace

void message_list(Ui& ui) {
  ui.session.messages.age(ui.now, ui.dialog.kind == Dialog::Kind::start);  // which shows warnings itself
  const std::vector<Note> notes = notes_in_lines(ui);
  if (notes.empty()) return ui.notes_place.reset();
  const float between = ui.theme.px(between_at_1);
  glm::vec2 size{0, -between};
  for (const Note& note : notes) size = {std::max(size.x, note.size.x), size.y + note.size.y + between};
  const Box box = place_of_notes(ui, size);
  float y = box.lo.y;
  std::size_t dismissed = notes.size();
  for (std::size_t k = 0; k < notes.size(); ++k) {
    ImGui::PushID(int(k));
    const ImVec2 lo{box.lo.x, y}, hi{box.hi.x, y + notes[k].size.y};
    if (draw_note(ui, ui.session.messages.list()[k], notes[k], lo, hi)) dismissed = k;
    ImGui::PopID();
    y = hi.y + between;
  }
  if (dismissed < notes.size()) ui.session.messages.dismiss(dismissed);
}

}  // namespace tyglab
