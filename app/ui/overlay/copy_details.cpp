// Why a copy has diverged, over its picture, until it is closed.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/base/text_lines.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/divergence_details.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr float details_at_1 = 460, details_padding_at_1 = 16, details_gap_at_1 = 6,
                details_close_at_1 = 34;  // pixels at scale 1

/// The same sentences as of the original; worked out once, since linear theory takes milliseconds.
void fill_in(CopyDetails& details, const Simulation& cloth) {
  const Divergence& divergence = *cloth.divergence();
  if (details.step == divergence.step) return;
  const Preset& then = cloth.diverged_preset();
  details.step = divergence.step;
  details.happened = what_happened(divergence, then, stable_dt(then, then.integrator));
  details.why = sentence(divergence.cause) + " " + sentence(divergence.advice);
}

/// A piece of it in lines, in a font and a color.
struct Piece {
  const ImFont& font;
  ImU32 color;
  std::string lines;

  float height() const { return font.CalcTextSizeA(font.FontSize, 1e9f, 0, lines.c_str()).y; }
};

/// In the middle of the copy's picture, or of all where the cloths are overlaid, but whole.
Box place_of(const Ui& ui, const Box& region, std::size_t copy, glm::vec2 size) {
  const bool tiles = !ui.session.copies.overlaid;
  const glm::vec2 lo = tiles ? ui.viewport.origin(int(copy) + 1) : ui.viewport.box.lo,
                  middle = lo + (tiles ? ui.viewport.size() : ui.viewport.box.hi - lo) / 2.f,
                  most = glm::max(region.hi - size, region.lo);
  const glm::vec2 at = glm::round(glm::clamp(middle - size / 2.f, region.lo, most));
  return {at, at + size};
}

}  // namespace

void copy_details(Ui& ui, const Box& region) {
  if (!ui.copy_details) return;
  CopyDetails& details = *ui.copy_details;
  const Copies& copies = ui.session.copies;
  const bool there = details.copy < copies.lockstep.size();
  if (!there || !cloth_of(ui.session, int(details.copy)).divergence()) return ui.copy_details.reset();
  fill_in(details, cloth_of(ui.session, int(details.copy)));
  const Tokens& c = ui.theme.colors;
  const float padding = ui.theme.px(details_padding_at_1), gap = ui.theme.px(details_gap_at_1),
              close = ui.theme.px(details_close_at_1);
  const float width = std::min(ui.theme.px(details_at_1), region.hi.x - region.lo.x - 2 * padding);
  const float inner = width - 2 * padding;
  const ImFont &title = *ui.fonts.title, &text = *ui.fonts.text;
  const std::string name = capitalised(name_of_cloth(ui.session, int(details.copy))) + " diverged";
  const Piece pieces[] = {{title, c.text, in_lines(title, with_whole_terms(name), inner - close)},
                          {text, c.text, in_lines(text, with_whole_terms(details.happened), inner)},
                          {text, c.quiet, in_lines(text, with_whole_terms(details.why), inner)},
                          {text, c.quiet, in_lines(text, "The others go on; R restarts all of them.", inner)}};
  float height = 2 * padding - gap;
  for (const Piece& piece : pieces) height += piece.height() + gap;
  const Box box = place_of(ui, region, details.copy, {width, std::min(height, region.hi.y - region.lo.y)});
  danger_ground(ui, box, "copy details");
  // What is higher than the cloth's place scrolls.
  const float inset = ui.theme.px(2);
  ImGui::SetCursorScreenPos({box.lo.x, box.lo.y + inset});
  gui::begin_child("copy_details", {width, box.hi.y - box.lo.y - 2 * inset});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImVec2 at = ImGui::GetCursorScreenPos();
  at = {at.x + padding, at.y - inset + padding};
  for (const Piece& piece : pieces) {
    draw_text(draw, piece.font, at, piece.color, piece.lines);
    at.y += piece.height() + gap;
  }
  ImGui::SetCursorScreenPos({at.x, at.y + padding - gap - 2 * inset});
  ImGui::Dummy({1, 1});
  ImGui::SetCursorScreenPos({box.hi.x - ui.theme.px(38), box.lo.y + ui.theme.px(8)});
  if (quiet_button(ui, "close_details", icon::close, "x", "Close (Esc)")) ui.copy_details.reset();
  ImGui::EndChild();
}

}  // namespace tyglab
