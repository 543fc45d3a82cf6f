// The message line: what the program says, over the status line for a few seconds.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {

void message_line(Ui& ui, const Region& foot) {
  Messages& messages = ui.session.messages;
  messages.age(ui.now, ui.dialog.kind == Dialog::Kind::start);  // which shows warnings itself
  if (ui.bare()) return;
  ui.message_box.reset();
  if (messages.list().empty()) return;
  const std::size_t shown = messages.foremost(), waiting = messages.list().size() - 1;
  messages.show(shown, ui.now);
  const Message& message = messages.list()[shown];

  // As high as its lines need: the first stands on the status line, others reach up over the picture's edge, unless
  // they would cover what is said of a divergence.
  const ImFont& font = *ui.fonts.text;
  const float pad = ui.theme.px(12), icon_width = ui.theme.px(24), above = ui.theme.px(8);
  const std::string more = waiting > 0 ? "+" + std::to_string(waiting) : "";
  const float close_width = ui.theme.px(28) + text_width(font, more);
  const std::string words = capitalised(ui.input.by_touch ? for_fingers(message.text) : message.text);
  const float room = foot.size.x - 2 * pad - icon_width - close_width;
  const std::string lines = in_lines(font, words, room);
  const bool fits = lines.find('\n') == std::string::npos;
  const bool shortened = !fits && (ui.session.simulation->divergence() || ui.copy_details);
  const std::string text = shortened ? fitted(font, words, room) : lines;
  const float height = std::max(std::ceil(height_of(font, text) + 2 * above), foot.size.y);
  const ImVec2 lo{foot.at.x, foot.at.y + foot.size.y - height}, hi{lo.x + foot.size.x, lo.y + height};
  ui.message_box = {{lo.x, lo.y}, {hi.x, hi.y}};

  ImGui::SetNextWindowPos(lo);
  ImGui::SetNextWindowSize({foot.size.x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.theme.colors.panel);
  bool dismissed = false;
  // In front of the regions, which it covers.
  if (ImGui::Begin("message", nullptr,
                   (region_flags & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoFocusOnAppearing)) {
    const Tokens& c = ui.theme.colors;
    const bool note = message.severity == Message::Severity::note;
    const ImU32 color = note ? c.accent : message.severity == Message::Severity::warning ? c.warning : c.danger;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(lo, {hi.x, lo.y + ui.theme.px(2)}, color);
    dismissed = gui::press_area("dismiss", {foot.size.x, height});
    report_control(ui, "dismiss");
    if (shortened) tooltip(ui, gui::item_id(), words);
    const ImU32 quiet = ImGui::IsItemHovered() ? c.text : c.quiet;
    const float y = std::round(lo.y + (height - height_of(font, text)) / 2);
    draw_text(draw, font, {lo.x + pad, y}, color,
              icon_or(ui.fonts, note ? icon::info : icon::warning, note ? "i" : "!"));
    draw_text(draw, font, {lo.x + pad + icon_width, y}, c.text, text);
    draw_text(draw, font, {hi.x - pad - close_width + ui.theme.px(8), y}, c.quiet, more);
    draw_text(draw, font, {hi.x - pad - ui.theme.px(14), y}, quiet, icon_or(ui.fonts, icon::close, "x"));
    cover_viewport(ui, lo, hi);
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (dismissed) messages.dismiss(shown);
}

}  // namespace tyglab
