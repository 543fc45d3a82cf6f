// The reason of a copy's divergence, below the pictures, until it is closed.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/ui.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr float details_at_1 = 560, details_margin_at_1 = 8, details_padding_at_1 = 16, details_gap_at_1 = 6,
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

/// What is said, in the lines of its width, and the size that all of it takes.
struct DetailsPlan {
  std::array<Piece, 4> pieces;
  glm::vec2 size{0};   ///< px
  bool strip = false;  ///< it has one of its own below the pictures
};

/// Nothing is planned where nothing was asked for, or what was asked for is gone.
std::optional<DetailsPlan> plan_details(Ui& ui, glm::vec2 region) {
  constexpr float most_of_it = 0.5f;  // of the region's height
  if (!ui.copy_details) return std::nullopt;
  CopyDetails& details = *ui.copy_details;
  const int copy = int(details.copy);
  if (details.copy >= ui.session.copies.lockstep.size() || !cloth_of(ui.session, copy).divergence()) {
    ui.copy_details.reset();
    return std::nullopt;
  }
  fill_in(details, cloth_of(ui.session, copy));
  const Tokens& c = ui.theme.colors;
  const float padding = ui.theme.px(details_padding_at_1), gap = ui.theme.px(details_gap_at_1),
              width = std::min(ui.theme.px(details_at_1), region.x - 2 * padding), inner = width - 2 * padding;
  const ImFont &title = *ui.fonts.title, &text = *ui.fonts.text;
  const auto piece = [](const ImFont& font, ImU32 color, const std::string& words, float room) {
    return Piece{font, color, in_lines(font, with_whole_terms(words), room)};
  };
  DetailsPlan plan{.pieces = {piece(title, c.text, capitalised(name_of_cloth(ui.session, copy)) + " diverged",
                                    inner - ui.theme.px(details_close_at_1)),
                              piece(text, c.text, details.happened, inner), piece(text, c.quiet, details.why, inner),
                              piece(text, c.quiet, "The others go on; R restarts all of them.", inner)}};
  plan.size = {width, 2 * padding - gap};
  for (const Piece& part : plan.pieces) plan.size.y += part.height() + gap;
  plan.strip = plan.size.y + 2 * ui.theme.px(details_margin_at_1) <= most_of_it * region.y;
  return plan;
}

}  // namespace

float copy_details_strip(Ui& ui, glm::vec2 region) {
  const auto plan = plan_details(ui, region);
  return plan && plan->strip ? plan->size.y + 2 * ui.theme.px(details_margin_at_1) : 0;
}

void copy_details(Ui& ui, const Box& region) {
  const auto plan = plan_details(ui, region.hi - region.lo);
  if (!plan) return;
  const float padding = ui.theme.px(details_padding_at_1), gap = ui.theme.px(details_gap_at_1),
              margin = ui.theme.px(details_margin_at_1), inset = ui.theme.px(2);
  // What is higher than the region scrolls.
  const float height = std::min(plan->size.y, region.hi.y - region.lo.y - 2 * margin), width = plan->size.x;
  const glm::vec2 lo(std::round((region.lo.x + region.hi.x - width) / 2), std::round(region.hi.y - margin - height));
  const Box box{lo, lo + glm::vec2(width, height)};
  // The view buttons step aside rather than being covered in part.
  const bool over = box.lo.y < region.lo.y + ui.theme.px(under_views_at_1);
  if (std::exchange(ui.copy_details->over_views, over) != over) ui.draw_by = ui.now;
  danger_ground(ui, box, "copy details");
  ImGui::SetCursorScreenPos({box.lo.x, box.lo.y + inset});
  gui::begin_child("copy_details", {width, height - 2 * inset});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImVec2 at = ImGui::GetCursorScreenPos();
  at = {at.x + padding, at.y - inset + padding};
  for (const Piece& piece : plan->pieces) {
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
