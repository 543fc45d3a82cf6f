// PAUSED, with the keys that go on.
#include <array>
#include <cmath>

#include "app/ui/frame/panels.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr const char* paused_word = "PAUSED";

/// How to go on from a pause: the keys that reach the transport now.
const char* ways_on(const App& app) {
  if (app.ui.slider.typing != 0 || ImGui::GetIO().WantTextInput) return "Enter takes what is typed · Esc leaves it";
  if (app.ui.slider.focused != 0) return "Space runs · O makes one step · → is the slider's until Esc";
  return "Space runs · → makes one step";
}

/// Where it can stand, the best first: beside the view buttons, where the viewport has room for one more picture, or in
/// a corner; with its keys, or, where that is too wide, without.
std::array<std::optional<Box>, 12> pause_places(const App& app, const Box& row, glm::vec2 full, glm::vec2 brief) {
  const OverlayLayout& placing = app.ui.placing;
  const float margin = app.theme.px(16);
  const Box below{{row.lo.x, app.ui.notes_from}, app.viewport.box.hi - margin};
  const auto free = app.viewport.free_place(app.copies.tiles());
  const auto in = [&](const Box& area, glm::vec2 size, ScreenCorner corner) {
    return placing.in_corner(area, size, corner);
  };
  return {in(row, full, ScreenCorner::upper_right),
          in(row, brief, ScreenCorner::upper_right),
          in(row, brief, ScreenCorner::upper_left),
          free ? in({*free + margin, below.hi}, full, ScreenCorner::upper_right) : std::nullopt,
          free ? in({*free + margin, below.hi}, brief, ScreenCorner::upper_right) : std::nullopt,
          in(below, full, ScreenCorner::upper_right),
          in(below, brief, ScreenCorner::upper_right),
          in(below, brief, ScreenCorner::upper_left),
          in(below, full, ScreenCorner::lower_right),
          in(below, brief, ScreenCorner::lower_right),
          in(below, full, ScreenCorner::lower_left),
          in(below, brief, ScreenCorner::lower_left)};
}

}  // namespace

void pause_mark(App& app, ImDrawList& draw, const Box& row) {
  if (app.pacing.playing || app.simulation->divergence()) return app.ui.pause_place.reset();
  const Tokens& c = app.theme.colors;
  const ImFont &bold = *app.fonts.brand, &text = *app.fonts.text;
  const char* how = ways_on(app);
  const float pad = app.theme.px(12), height = app.theme.px(26), word_width = text_width(bold, paused_word);
  const glm::vec2 brief{std::ceil(word_width + 2 * pad), height},
      full{std::ceil(word_width + text_width(text, how) + 3 * pad), height};
  const auto list = pause_places(app, row, full, brief);
  app.ui.pause_place = choose_place(list, drawn_parts(app), app.ui.pause_place);
  if (!app.ui.pause_place) return;
  const Box& box = *list[*app.ui.pause_place];
  app.ui.placing.take("paused", box);
  const float baseline = baseline_at(app.fonts, box.lo.y + height / 2);
  draw.AddRectFilled(vec(box.lo), vec(box.hi), faded(c.ground, 0.85f), app.theme.px(6));
  draw_on_baseline(draw, bold, {box.lo.x + pad, baseline}, c.text, paused_word);
  if (box.hi.x - box.lo.x > brief.x)
    draw_on_baseline(draw, text, {box.lo.x + word_width + 2 * pad, baseline}, c.quiet, how);
}

}  // namespace tyglab
