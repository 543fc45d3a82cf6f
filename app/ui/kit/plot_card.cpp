#include "app/ui/kit/chart.h"

#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float plot_card_padding_at_1 = 12, plot_card_title_at_1 = 24,
                plot_card_button_at_1 = 26;  // pixels at scale 1

}  // namespace

PlotCard::PlotCard(UiContext& ui, const char* id, std::string_view title, std::string_view note, float height,
                   int buttons) {
  const Tokens& c = ui.theme.colors;
  const float padding = ui.theme.px(plot_card_padding_at_1),
              heads = float(buttons) * ui.theme.px(plot_card_button_at_1);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  gui::begin_child(id, {width, height}, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(lo, {lo.x + width, lo.y + height}, c.panel, ui.theme.px(8));
  const float top = lo.y + padding;
  const std::string shown = fitted(*ui.fonts.title, std::string(title), plot_card_title_width(ui, width, buttons));
  draw_text(draw, *ui.fonts.title, {lo.x + padding, top}, c.text, shown);
  const ImFont& small = *ui.fonts.small;
  const float note_x = lo.x + width - padding - heads - text_width(small, note);
  if (note_x > lo.x + 2 * padding + text_width(*ui.fonts.title, shown))
    draw_text(draw, small, {note_x, top + ui.fonts.title->Ascent - small.Ascent}, c.quiet, note);
  const float title_height = ui.theme.px(plot_card_title_at_1);
  inner_ = {{lo.x + padding, top + title_height}, {width - 2 * padding, height - 2 * padding - title_height}};
  ImGui::SetCursorScreenPos(inner_.at);
}

PlotCard::~PlotCard() {
  ImGui::EndChild();
}

bool PlotCard::head_button(UiContext& ui, int n, const char* id, const char* glyph, const char* word,
                           const char* tip) const {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(
      {inner_.at.x + inner_.size.x - float(n + 1) * ui.theme.px(plot_card_button_at_1) + ui.theme.px(4),
       inner_.at.y - ui.theme.px(28)});
  const bool clicked = quiet_button(ui, id, glyph, word, tip);
  report_control(ui, id);
  ImGui::SetCursorScreenPos(at);
  return clicked;
}

float plot_card_height(const UiContext& ui, float content) {
  return 2 * ui.theme.px(plot_card_padding_at_1) + ui.theme.px(plot_card_title_at_1) + content;
}

float plot_card_title_width(const UiContext& ui, float width, int buttons) {
  return plot_card_inner_width(ui, width) - float(buttons) * ui.theme.px(plot_card_button_at_1);
}

float plot_card_inner_width(const UiContext& ui, float width) {
  return width - 2 * ui.theme.px(plot_card_padding_at_1);
}

}  // namespace tyglab
