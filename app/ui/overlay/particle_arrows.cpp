// The picked particle's variables of table B.1 as arrows, each in the color and line of its curve.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr float longest_px = 90;    // of an arrow, at scale 1
constexpr double most_of_it = 1.6;  // while the scale has not followed yet

/// Variables of one unit share a scale.
struct Group {
  std::string_view unit;
  std::vector<std::string_view> keys;
  double (*least)(const Preset&);  ///< below this the longest arrow is noise, and stays short
};

const std::array<Group, 3>& groups() {
  static const std::array<Group, 3> list{
      {{"N", {force_keys().begin(), force_keys().end()}, [](const Preset& p) { return 0.01 * p.m * 9.82; }},
       {"m/s", {"v"}, [](const Preset&) { return 1e-3; }},
       {"m/s²", {"a"}, [](const Preset&) { return 0.1; }}}};
  return list;
}

/// The largest 1, 2 or 5 times a power of ten that is not above the value.
double round_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value) return digit * power;
  return power;
}

/// Places for a label of that size at an arrow's head, the best first: farther out along it, then to its sides.
std::vector<Box> label_places(const Ui& ui, int tile, glm::vec2 head, glm::vec2 along, glm::vec2 size) {
  const glm::vec2 lo = ui.viewport.origin(tile), hi = lo + ui.viewport.size();
  std::vector<Box> places;
  const auto add = [&](glm::vec2 middle) {
    const Box box{glm::round(middle - size / 2.f), glm::round(middle + size / 2.f)};
    if (box.lo.x >= lo.x && box.lo.y >= lo.y && box.hi.x <= hi.x && box.hi.y <= hi.y) places.push_back(box);
  };
  for (float away = 18; away <= 54; away += 4) add(head + along * ui.theme.px(away));
  const glm::vec2 across(-along.y, along.x);
  for (const float back : {0.f, 12.f, 24.f})
    for (const float side : {1.f, -1.f})
      add(head - along * ui.theme.px(back) + across * side * (glm::length(size * across) / 2 + ui.theme.px(12)));
  if (!ui.presenting) return places;
  // An audience cannot point at an arrow to see what it is: every one is labeled, if need be farther away.
  constexpr int directions = 16;
  for (float away = 30; away <= 180; away += 15)
    for (int k = 0; k < directions; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * float(k) / directions;
      add(head + ui.theme.px(away) * (std::cos(angle) * along + std::sin(angle) * across));
    }
  return places;
}

/// The symbol beside an arrow's head, where there is room for it.
void arrow_label(Ui& ui, ImDrawList& draw, int tile, ImVec2 from, ImVec2 to, std::string_view symbol) {
  const glm::vec2 head(to.x, to.y), way = head - glm::vec2(from.x, from.y);
  if (glm::length(way) < ui.theme.px(24) && !ui.presenting) return;
  const float pad = ui.theme.px(7), height = ui.theme.px(24);
  const glm::vec2 size(std::ceil(symbol_width(ui.fonts, symbol)) + 2 * pad, height);
  std::vector<Box> places = label_places(ui, tile, head, glm::normalize(way), size);
  if (ui.tooltip_before) std::erase_if(places, [&](const Box& place) { return overlap(place, *ui.tooltip_before); });
  const auto box = ui.placing.first_free(places);
  if (!box) return;
  ui.placing.take("label " + std::to_string(tile) + " " + std::string(symbol), *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), faded(ui.theme.colors.ground, 0.88f), ui.theme.px(6));
  draw_symbol(draw, ui.fonts, {box->lo.x + pad, box->lo.y + height / 2 + ui.theme.px(4)}, symbol, ui.theme.colors.text);
}

/// The scale, in units for the longest arrow, follows within half a second, so that growth is seen; and at once where
/// arrows would leave the picture or vanish.
void follow(Ui& ui, double& scale, double longest) {
  const double part = 1 - std::exp(-double(ImGui::GetIO().DeltaTime) / 0.5);
  const bool far = longest > 3 * scale || longest < scale / 20;
  scale = far ? longest : scale + part * (longest - scale);
  if (std::abs(longest - scale) > 0.01 * scale) ui.draw_by = ui.now;
}

/// A bar in the picture's corner, as long as an arrow of the value beside it, where there is room. Returns where the
/// next one begins.
float scale_bar(Ui& ui, ImDrawList& draw, ImVec2 at, double scale, std::string_view unit) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.axis;
  const double value = round_below(scale);
  const float length = std::round(float(value / scale) * ui.theme.px(longest_px)), tick = ui.theme.px(3),
              pad = ui.theme.px(6);
  const ScaledUnit in = scaled_unit(value, unit);
  const std::string text = power_number(value / in.size) + " " + in.name;
  const float end = at.x + length + pad + text_width(font, text);
  const Box box{{at.x - pad, at.y - font.FontSize / 2 - pad / 2}, {end + pad, at.y + font.FontSize / 2 + pad / 2}};
  if (!ui.placing.free(box) || (ui.tooltip_before && overlap(box, *ui.tooltip_before))) return at.x;
  ui.placing.take("scale " + std::string(unit), box);
  draw.AddRectFilled(vec(box.lo), vec(box.hi), faded(c.ground, 0.85f), ui.theme.px(6));
  const float width = std::max(1.f, ui.theme.px(1.5f));
  draw.AddLine(at, {at.x + length, at.y}, c.text, width);
  for (const float x : {at.x, at.x + length}) draw.AddLine({x, at.y - tick}, {x, at.y + tick + 1}, c.text, width);
  draw_text(draw, font, {at.x + length + pad, std::round(at.y - font.FontSize / 2)}, c.text, text);
  return end + 3 * pad;
}

/// Of the variables that are checked; none where no one of the group is.
std::optional<double> longest_of(const Group& group, const std::set<std::string>& checked, const ParticleReadout& r) {
  std::optional<double> longest;
  for (const std::string_view key : group.keys)
    if (checked.count(std::string(key)) > 0) longest = std::max(longest.value_or(0), glm::length(r[key]));
  return longest;
}

/// Where the scales stand: in the first picture's lower left corner, above the names of copies and a message.
ImVec2 place_of_bars(const Ui& ui) {
  const glm::vec2 lo = ui.viewport.origin(0), hi = lo + ui.viewport.size();
  float foot = hi.y - ui.theme.px(12);
  for (const OverlayLayout::Mark& mark : ui.placing.marks())
    if ((mark.name.starts_with("name ") || mark.name == "message") && mark.box.lo.x < lo.x + ui.theme.px(32) &&
        mark.box.hi.y > lo.y && mark.box.lo.y < hi.y)
      foot = std::min(foot, mark.box.lo.y - ui.theme.px(8));
  return {lo.x + ui.theme.px(22),
          std::round(foot - std::max(ui.theme.px(10), ui.fonts.axis->FontSize / 2 + ui.theme.px(3)))};
}

struct DrawnArrow {
  ImVec2 to;
  std::string_view symbol;
};

/// One variable's arrow; none where it is too short to be seen.
std::optional<DrawnArrow> variable_arrow(Ui& ui, ImDrawList& draw, int tile, ImVec2 from, const ParticleReadout& r,
                                         std::string_view key, double scale) {
  const glm::dvec3 value = r[key];
  const double parts = glm::length(value) / scale, pixels = std::min(parts, most_of_it) * ui.theme.px(longest_px);
  if (pixels < 1) return std::nullopt;
  auto to = on_screen(
      ui, tile, r.x + glm::normalize(value) * pixels * ui.scene.camera.metres_per_pixel(r.x, ui.viewport.size().y));
  if (!to) return std::nullopt;
  const bool cut_short = keep_in_picture(ui, tile, from, *to) || parts > most_of_it;
  if (!draw_arrow(ui, draw, from, *to, curve_style(ui.theme.colors, key), cut_short)) return std::nullopt;
  return DrawnArrow{*to, variable(key).symbol};
}

}  // namespace

void arrow_scales(Ui& ui, ImDrawList& draw) {
  if (!ui.session.picked || !ui.arrows || ui.session.preset().kind != Kind::cloth ||
      ui.session.simulation->divergence())
    return;
  const ParticleReadout r = ui.session.simulation->particle(ui.session.picked->i, ui.session.picked->j);
  ImVec2 at = place_of_bars(ui);
  for (std::size_t k = 0; k < groups().size(); ++k) {
    const Group& group = groups()[k];
    const auto longest = longest_of(group, ui.settings.handling.arrows, r);
    if (!longest || !std::isfinite(*longest)) continue;
    // The original leads; its copies' arrows are to the same scale.
    follow(ui, ui.arrow_scales[k], std::max(*longest, group.least(ui.session.preset())));
    at.x = scale_bar(ui, draw, at, ui.arrow_scales[k], group.unit);
  }
}

void particle_arrows(Ui& ui, ImDrawList& draw, int tile, ImVec2 from) {
  const ParticleReadout r = cloth_in_tile(ui.scene, tile).particle(ui.session.picked->i, ui.session.picked->j);
  const std::set<std::string>& checked = ui.settings.handling.arrows;
  std::vector<DrawnArrow> arrows;
  for (std::size_t k = 0; k < groups().size(); ++k) {
    const Group& group = groups()[k];
    const auto longest = longest_of(group, checked, r);
    if (!longest || !std::isfinite(*longest)) continue;
    double& scale = ui.arrow_scales[k];
    if (scale <= 0) scale = std::max(*longest, group.least(ui.session.preset()));  // the original has diverged
    for (const std::string_view key : group.keys)
      if (checked.count(std::string(key)) > 0)
        if (const auto arrow = variable_arrow(ui, draw, tile, from, r, key, scale)) arrows.push_back(*arrow);
  }
  // Last, so that no arrow runs over a symbol.
  for (const DrawnArrow& arrow : arrows) arrow_label(ui, draw, tile, from, arrow.to, arrow.symbol);
}

}  // namespace tyglab
