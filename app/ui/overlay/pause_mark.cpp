// PAUSED, with the keys that continue; or REPLAY, with the replayed steps and their speed; and what is hidden.
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "app/base/text.h"
#include "app/session/lab_state.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr const char *paused_word = "PAUSED", *replay_word = "REPLAY";

/// How to go on from a pause: the keys that reach the transport now, if there are any.
const char* ways_on(const Ui& ui) {
  if (ui.input.by_touch) return "";
  if (ui.slider.typing != 0 || ImGui::GetIO().WantTextInput) return "Enter accepts · Esc cancels";
  if (awaits_prediction(ui.session)) return "Predict in the lab to run";
  if (ui.slider.focused != 0) return "Space runs · O makes one step · → moves the slider until Esc";
  return "Space runs · → makes one step";
}

/// Which steps are seen once more, and how slowly; without the latter where both are wider than `room`, px.
std::string replay_words(const Ui& ui, float room) {
  const Replay& replay = *ui.session.replay;
  const std::string steps = "steps " + std::to_string(replay.first) + " to " + std::to_string(replay.of.step);
  std::string with_speed = steps + " at 1/" + short_number(rounded(1 / replay.speed, 2)) + " of real time";
  return text_width(*ui.fonts.text, with_speed) <= room ? with_speed : steps;
}

/// Where it can stand, the best first: beside the view buttons, where the viewport has room for one more picture, or in
/// a corner; with its keys, or, where that is too wide, without.
std::array<std::optional<Box>, 12> pause_places(const Ui& ui, const Box& row, glm::vec2 full, glm::vec2 brief) {
  const OverlayLayout& placing = ui.placing;
  const float margin = ui.theme.px(16);
  const Box below{{row.lo.x, ui.marks_from}, ui.viewport.box.hi - margin};
  const auto free = ui.viewport.free_place(ui.session.copies.tiles());
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

glm::vec2 pause_mark_size(const Ui& ui) {
  return {std::ceil(text_width(*ui.fonts.brand, paused_word) + 2 * ui.theme.px(12)), ui.theme.px(26)};
}

void pause_mark(Ui& ui, ImDrawList& draw, const Box& row) {
  const bool replaying = ui.session.replay && ui.session.pacing.playing;
  if ((ui.session.pacing.playing && !replaying) || ui.session.simulation->divergence()) return ui.pause_place.reset();
  const Tokens& c = ui.theme.colors;
  const ImFont &bold = *ui.fonts.brand, &text = *ui.fonts.text;
  const char* const word = replaying ? replay_word : paused_word;
  const float pad = ui.theme.px(12), height = ui.theme.px(26), word_width = text_width(bold, word);
  const float beside = row.hi.x - row.lo.x - word_width - 3 * pad;
  const std::string how = replaying ? replay_words(ui, beside) : ways_on(ui);
  const glm::vec2 brief{std::ceil(word_width + 2 * pad), height};
  const glm::vec2 full{how.empty() ? brief.x : std::ceil(word_width + text_width(text, how) + 3 * pad), height};
  const auto list = pause_places(ui, row, full, brief);
  ui.pause_place = choose_place(list, drawn_parts(ui), ui.pause_place);
  if (!ui.pause_place) return;
  const Box& box = *list[*ui.pause_place];
  ui.placing.take(replaying ? "replay" : "paused", box);
  const float baseline = baseline_at(ui.fonts, box.lo.y + height / 2);
  draw.AddRectFilled(vec(box.lo), vec(box.hi), faded(c.ground, 0.85f), ui.theme.px(6));
  draw_on_baseline(draw, bold, {box.lo.x + pad, baseline}, c.text, word);
  if (box.hi.x - box.lo.x > brief.x)
    draw_on_baseline(draw, text, {box.lo.x + word_width + 2 * pad, baseline}, c.quiet, how);
}

namespace {

/// A button in a corner of the picture. Returns whether it was pressed.
bool corner_button(Ui& ui, ImDrawList& draw, const char* id, std::string_view words) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.small;
  const float pad = ui.theme.px(10), margin = ui.theme.px(16);
  const glm::vec2 size = glm::ceil(glm::vec2(text_width(font, words) + 2 * pad, font.FontSize + pad));
  const Box area{ui.viewport.box.lo + margin, ui.viewport.box.hi - margin};
  std::optional<Box> box;
  for (const ScreenCorner corner : {ScreenCorner::lower_left, ScreenCorner::lower_right, ScreenCorner::upper_right})
    if (!box) box = ui.placing.in_corner(area, size, corner);
  if (!box) return false;
  ui.placing.take(id, *box);
  cover_viewport(ui, vec(box->lo), vec(box->hi));
  ImGui::SetCursorScreenPos(vec(box->lo));
  const bool pressed = gui::press_area(id, vec(size));
  report_control(ui, id);
  const bool hovered = ImGui::IsItemHovered();
  draw.AddRectFilled(vec(box->lo), vec(box->hi), hovered ? c.field_hover : faded(c.panel, 0.85f), ui.theme.px(6));
  draw_on_baseline(draw, font, {box->lo.x + pad, baseline_at(ui.fonts, (box->lo.y + box->hi.y) / 2)},
                   hovered ? c.text : c.quiet, words);
  return pressed;
}

}  // namespace

void hidden_panels_mark(Ui& ui, ImDrawList& draw) {
  if (ui.panels || !ui.panels_hidden) return;
  const std::string how = ui.input.by_touch ? "Show the panels" : "Tab shows the panels";
  const auto& lab = ui.session.labs.run;
  std::string words = (lab ? "Lab: " + lab->lab.title + " · " : "") + how;
  if (text_width(*ui.fonts.small, words) + ui.theme.px(52) > ui.viewport.whole().x) words = how;
  if (corner_button(ui, draw, "show_panels", words)) ui.command("toggle_panels");
}

void film_mark(Ui& ui, ImDrawList& draw) {
  if (!ui.film) return;
  const std::string done = std::to_string(ui.film->frame) + " of " + std::to_string(ui.film->count);
  const std::string stop = ui.input.by_touch ? "Stop" : "Stop (Esc)";
  if (corner_button(ui, draw, "stop_film", "Film: image " + done + " · " + stop)) ui.command("export_film");
}

}  // namespace tyglab
