#include "app/ui/frame/panels.h"

#include <algorithm>
#include <cmath>

#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/scene_picture.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float inset = 12, under_title = 4, over_title = 8, round_at_1 = 6;  // px at scale 1
constexpr float beside_picture = 132;                                         // its width, px at scale 1
constexpr int goal_lines = 3, most_title_lines = 3, most_goal_lines = 5;

int lines_in(const std::string& lines) {
  return 1 + int(std::count(lines.begin(), lines.end(), '\n'));
}

/// As much of the text as that many lines hold.
std::string in_some_lines(const ImFont& font, const std::string& text, float width, int most) {
  const std::string lines = in_lines(font, text, width);
  if (lines_in(lines) <= most) return lines;
  std::size_t end = 0;
  for (int line = 0; line < most; ++line) end = lines.find('\n', end) + 1;
  const std::size_t before = most > 1 ? lines.rfind('\n', end - 2) + 1 : 0;
  return lines.substr(0, before) + fitted(font, lines.substr(before, end - 1 - before) + "…", width);
}

bool has_problem(const GalleryCard& card) {
  return !card.problem.empty();
}

float text_room(const Ui& ui, const CardShape& shape) {
  return (shape.beside ? shape.width - shape.picture.x : shape.width) - 2 * ui.theme.px(inset);
}

/// "3 steps · 10 min", of a lab.
const std::string& length_of(const GalleryCard& card) {
  static const std::string none;
  return card.entry.number.empty() ? none : card.entry.keys;
}

/// On the picture, in its corner.
void draw_length(Ui& ui, const std::string& words, ImVec2 corner) {
  const Tokens& c = ui.theme.colors;
  const ImFont& small = *ui.fonts.text;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float wide = text_width(small, words) + ui.theme.px(16), high = small.FontSize + ui.theme.px(8);
  const ImVec2 at{corner.x - wide - ui.theme.px(8), corner.y + ui.theme.px(8)};
  draw.AddRectFilled(at, {at.x + wide, at.y + high}, c.panel, ui.theme.px(4));
  draw_text(draw, small, {at.x + ui.theme.px(8), at.y + ui.theme.px(4)}, c.text, words);
}

}  // namespace

std::string goal_in_lines(const ImFont& font, const std::string& text, float width) {
  std::string goal;
  for (std::size_t from = 0; from < text.size();) {
    std::size_t end = text.find_first_of(".?!", from);
    while (end != std::string::npos && end + 1 < text.size() && text[end + 1] != ' ')
      end = text.find_first_of(".?!", end + 1);
    end = end == std::string::npos ? text.size() : end + 1;
    const std::string longer = text.substr(0, end);
    if (!goal.empty() && lines_in(in_lines(font, longer, width)) > goal_lines) break;
    goal = longer, from = end + 1;
  }
  return in_some_lines(font, goal, width, most_goal_lines);
}

CardShape card_shape(const Ui& ui, float width, bool beside) {
  const float picture = beside ? std::min(ui.theme.px(beside_picture), std::round(width / 3)) : width;
  return {width, {picture, std::round(picture / SceneSketch::aspect)}, beside};
}

CardText card_text(const Ui& ui, const GalleryCard& card, const CardShape& shape) {
  const ImFont& title = *ui.fonts.title;
  const float room = text_room(ui, shape);
  const std::string number = card.entry.number.empty() ? "" : card.entry.number + "  ";
  CardText text;
  text.title = in_some_lines(title, number + card.entry.title, room, most_title_lines);
  // In a narrow card a long goal is set smaller rather than shortened.
  for (const ImFont* font : {ui.fonts.text, ui.fonts.small}) {
    text.font = font;
    text.goal = has_problem(card) ? in_some_lines(*font, card.problem, room, most_goal_lines)
                                  : goal_in_lines(*font, card.entry.purpose, room);
    if (!text.goal.ends_with("…")) break;
  }
  text.whole = text.goal == in_lines(*text.font, has_problem(card) ? card.problem : card.entry.purpose, room);
  if (shape.beside && !length_of(card).empty()) text.goal += "\n" + length_of(card);
  const float words = ui.theme.px(over_title + under_title + inset) + float(lines_in(text.title)) * title.FontSize +
                      float(lines_in(text.goal)) * text.font->FontSize;
  text.height = std::ceil(shape.beside ? std::max(words, shape.picture.y) : shape.picture.y + words);
  return text;
}

void draw_gallery_card(Ui& ui, const GalleryCard& card, ImVec2 lo, const CardShape& shape, float height, bool lit) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 hi{lo.x + shape.width, lo.y + height};
  const float round = ui.theme.px(round_at_1);
  draw.AddRectFilled(lo, hi, lit ? c.field_hover : c.field, round);
  const ImVec2 corner{lo.x + shape.picture.x, shape.beside ? hi.y : lo.y + shape.picture.y};
  draw.AddRectFilled(lo, corner, c.ground, round,
                     shape.beside ? ImDrawFlags_RoundCornersLeft : ImDrawFlags_RoundCornersTop);
  const float above = std::round((corner.y - lo.y - shape.picture.y) / 2);
  if (!has_problem(card))
    draw_scene(draw, ui.theme, ui.sketches.of(card.preset), {lo.x, lo.y + above}, {corner.x, corner.y - above});
  if (lit) draw.AddRect(lo, hi, c.accent, round, 0, ui.theme.px(2));
  const CardText text = card_text(ui, card, shape);
  const ImFont& title = *ui.fonts.title;
  const ImVec2 at{(shape.beside ? corner.x : lo.x) + ui.theme.px(inset),
                  (shape.beside ? lo.y : corner.y) + ui.theme.px(over_title)};
  draw_text(draw, title, at, c.text, text.title);
  const float under = at.y + float(lines_in(text.title)) * title.FontSize + ui.theme.px(under_title);
  draw_text(draw, *text.font, {at.x, under}, has_problem(card) ? c.warning : c.quiet, text.goal);
  if (!shape.beside && !length_of(card).empty()) draw_length(ui, length_of(card), {hi.x, lo.y});
}

}  // namespace tyglab
