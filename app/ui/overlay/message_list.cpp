// Messages over the cloth, shown for a few seconds.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr float widest_at_1 = 460, lowest_at_1 = 36, padding_at_1 = 12, above_at_1 = 9;  // pixels at scale 1
constexpr float icon_at_1 = 24, close_at_1 = 22, between_at_1 = 8, edge_at_1 = 16;

/// A message in lines.
struct Note {
  std::size_t index;  ///< among the messages
  std::string text;
  glm::vec2 size;  ///< px
};

std::vector<Note> notes_in_lines(const Ui& ui) {
  const ImFont& font = *ui.fonts.text;
  const float beside = ui.theme.px(2 * padding_at_1 + icon_at_1 + close_at_1);
  const float most = std::min(ui.theme.px(widest_at_1), ui.viewport.whole().x - ui.theme.px(2 * edge_at_1));
  std::vector<Note> notes;
  const std::vector<Message>& list = ui.session.messages.list();
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string& said = list[k].text;
    std::string text = in_lines(font, capitalised(ui.input.by_touch ? for_fingers(said) : said), most - beside);
    const float width = font.CalcTextSizeA(font.FontSize, 1e9f, 0, text.c_str()).x;
    const float height = std::max(height_of(font, text) + 2 * ui.theme.px(above_at_1), ui.theme.px(lowest_at_1));
    notes.push_back({k, std::move(text), {std::min(std::ceil(width) + beside, most), height}});
  }
  return notes;
}

/// Below each other, all equally wide, px.
glm::vec2 size_of(const Ui& ui, const std::vector<Note>& notes) {
  const float between = ui.theme.px(between_at_1);
  glm::vec2 size{0, -between};
  for (const Note& note : notes) size = {std::max(size.x, note.size.x), size.y + note.size.y + between};
  return size;
}

std::array<std::optional<Box>, 4> places_of_notes(const Ui& ui, glm::vec2 size) {
  const glm::vec2 edge(ui.theme.px(edge_at_1));
  const Box area{{ui.viewport.box.lo.x + edge.x, ui.notes_from}, ui.viewport.box.hi - edge};
  const auto in = [&](ScreenCorner corner) { return ui.placing.in_corner(area, size, corner); };
  std::array<std::optional<Box>, 4> places{in(ScreenCorner::upper_left), in(ScreenCorner::upper_right), {}, {}};
  // What is said of a divergence may reach up over the lower ones.
  if (!ui.session.simulation->divergence())
    places[2] = in(ScreenCorner::lower_left), places[3] = in(ScreenCorner::lower_right);
  return places;
}

/// Where several would cover the cloth, one at a time is shown, until all have been.
void keep_off_the_cloth(Ui& ui, std::vector<Note>& notes) {
  if (notes.size() > 1 && !ui.one_note) {
    const std::vector<Box> cloth = drawn_parts(ui);
    const auto places = places_of_notes(ui, size_of(ui, notes));
    const auto best = choose_place(places, cloth, {});
    ui.one_note = !best || covered(*places[*best], cloth) > 0;
  }
  if (ui.one_note) notes = {notes[ui.session.messages.foremost()]};
}

/// In the corner in which they covered least of the cloth when the first of them came.
Box place_of_notes(Ui& ui, glm::vec2 size) {
  const auto places = places_of_notes(ui, size);
  // It stands still while it is read.
  if (!ui.notes_place || !places[*ui.notes_place]) ui.notes_place = choose_place(places, drawn_parts(ui), {});
  if (ui.notes_place) return *places[*ui.notes_place];
  const glm::vec2 lo(ui.viewport.box.lo.x + ui.theme.px(edge_at_1), ui.notes_from);
  return {lo, lo + size};
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
  draw_text(draw, font, {hi.x - ui.theme.px(close_at_1), line + ui.theme.px(1)},
            ImGui::IsItemHovered() ? c.text : c.quiet, icon_or(ui.fonts, icon::close, "x"));
  cover_viewport(ui, lo, hi);
  return clicked;
}

}  // namespace

void message_list(Ui& ui) {
  ui.session.messages.age(ui.now, ui.dialog.kind == Dialog::Kind::start);  // which shows warnings itself
  std::vector<Note> notes = notes_in_lines(ui);
  if (notes.empty()) {
    ui.one_note = false;
    return ui.notes_place.reset();
  }
  keep_off_the_cloth(ui, notes);
  Messages& messages = ui.session.messages;
  const Box box = place_of_notes(ui, size_of(ui, notes));
  float y = box.lo.y;
  std::optional<std::size_t> dismissed;
  for (const Note& note : notes) {
    ImGui::PushID(int(note.index));
    const ImVec2 lo{box.lo.x, y}, hi{box.hi.x, y + note.size.y};
    messages.show(note.index, ui.now);
    if (draw_note(ui, messages.list()[note.index], note, lo, hi)) dismissed = note.index;
    ImGui::PopID();
    y = hi.y + ui.theme.px(between_at_1);
  }
  if (dismissed) messages.dismiss(*dismissed);
}

}  // namespace tyglab
