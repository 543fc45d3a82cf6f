#include "app/ui/kit/color_legend.h"

#include <algorithm>
#include <array>

#include "app/base/text.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

// Lengths at scale 1.
constexpr float width = 248, height = 74, padding = 14, bar_top = 32, bar_height = 12, ticks_middle = 59;

constexpr float line_width = 228, line_height = 28, line_name = 58, line_top = 66;  // of one on a single line
constexpr float short_line_width = 158;                                             // the colors are still seen

/// The leading digit of a round number.
int lead(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
  return int(std::lround(value / power));
}

void draw_bar(const PlotPaint& paint, ImVec2 lo, ImVec2 hi, const ColorMap& map) {
  constexpr int strips = 48;
  for (int k = 0; k < strips; ++k) {
    const auto edge = [&](int n) { return lo.x + (hi.x - lo.x) * float(n) / strips; };
    const ImU32 left = map_color(map, double(k) / strips), right = map_color(map, double(k + 1) / strips);
    paint.draw.AddRectFilledMultiColor({edge(k), lo.y}, {edge(k + 1), hi.y}, left, right, right, left);
  }
}

void draw_heading(const PlotPaint& paint, ImVec2 lo, float right, const ColorLegend& legend) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.text;
  const float baseline = baseline_at(paint.fonts, std::round(lo.y + paint.theme.px(17)));
  float x = lo.x;
  const auto say = [&](const ImFont& with, ImU32 color, std::string_view text) {
    draw_on_baseline(paint.draw, with, {x, baseline}, color, text);
    x += text_width(with, text);
  };
  const std::string value = legend.marked ? steady_number(*legend.marked) : "";
  const std::string unit =
      (legend.field.unit.empty() ? "" : ", " + std::string(legend.field.unit)) + (legend.root ? ", root scale" : "");
  const float others = symbol_width(paint.fonts, legend.field.symbol) + text_width(font, unit) +
                       text_width(*paint.fonts.mono, value) + paint.theme.px(value.empty() ? 8 : 16);
  say(font, c.text, fitted(font, std::string(legend.field.title), right - lo.x - others));
  if (!legend.field.symbol.empty()) {
    x += paint.theme.px(6);
    draw_symbol(paint.draw, paint.fonts, {x, baseline}, legend.field.symbol, c.text);
    x += symbol_width(paint.fonts, legend.field.symbol) + paint.theme.px(2);
  }
  say(font, c.quiet, unit);
  draw_on_baseline(paint.draw, *paint.fonts.mono, {right - text_width(*paint.fonts.mono, value), baseline}, c.text,
                   value);
}

/// The symbol with its unit, or the name of what has none. Returns where it ends.
float draw_name(const PlotPaint& paint, float x, float baseline, const FieldInfo& field) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.small;
  std::string after(field.title);
  if (!field.symbol.empty()) {
    draw_symbol(paint.draw, paint.fonts, {x, baseline}, field.symbol, c.text);
    x += symbol_width(paint.fonts, field.symbol) + paint.theme.px(2);
    after = field.unit.empty() ? "" : ", " + std::string(field.unit);
  }
  after = fitted(font, after, paint.theme.px(line_name));
  draw_on_baseline(paint.draw, font, {x, baseline}, field.symbol.empty() ? c.text : c.quiet, after);
  return x + text_width(font, after);
}

void draw_marker(const PlotPaint& paint, const ColorLegend& legend, ImVec2 lo, ImVec2 hi) {
  if (!legend.marked) return;
  const float x = std::round(lo.x + float(legend.at(*legend.marked)) * (hi.x - lo.x)), r = paint.theme.px(5);
  paint.draw.AddTriangleFilled({x - r, lo.y - r}, {x + r, lo.y - r}, {x, lo.y + r / 2}, paint.theme.colors.text);
}

/// What the end of the scale is dragged by.
void draw_grip(const PlotPaint& paint, const ColorLegend& legend, ImVec2 lo, ImVec2 hi) {
  if (!legend.grip) return;
  const float half = paint.theme.px(2), over = paint.theme.px(3);
  paint.draw.AddRectFilled({hi.x - half, lo.y - over}, {hi.x + half, hi.y + over}, paint.theme.colors.text, half);
}

/// Name, colors, and room for the number at their end.
LegendParts draw_line(const PlotPaint& paint, ImVec2 at, ImVec2 size, const ColorLegend& legend) {
  const Theme& theme = paint.theme;
  const float middle = std::round(at.y + size.y / 2), baseline = baseline_at(paint.fonts, middle);
  const float pad = theme.px(10), half = theme.px(bar_height) / 2;
  const float from = std::round(draw_name(paint, at.x + pad, baseline, legend.field)) + pad;
  const ImVec2 lo{from, middle - half}, hi{std::max(from, at.x + size.x - theme.px(line_top)), middle + half};
  draw_bar(paint, lo, hi, legend.map);
  draw_marker(paint, legend, lo, hi);
  draw_grip(paint, legend, lo, hi);
  return {{at.x + size.x - pad, middle}, lo, hi};
}

}  // namespace

double ColorLegend::at(double value) const {
  const double from = field.is_signed ? -top : 0, part = std::clamp((value - from) / (top - from), 0.0, 1.0);
  return root ? std::sqrt(part) : part;
}

std::vector<PlotTick> legend_ticks(const ColorLegend& legend) {
  const double top = legend.top;
  std::vector<double> ticks;
  if (legend.field.is_signed) {
    ticks = {-top, 0, top};
  } else if (legend.root) {
    const double middle = lead(top) == 3 ? 3 : lead(top) == 5 ? 2.5 : 2;  // of the top, so that it is a round number
    ticks = {0, top / 10, top / middle, top};
  } else {
    const int parts = lead(top) == 3 ? 3 : 2;
    for (int k = 0; k <= parts; ++k) ticks.push_back(top * k / parts);
  }
  for (double& tick : ticks) tick = rounded(tick, 3);  // while the end is dragged it has many digits
  return labeled(ticks);
}

std::string legend_words(const FieldInfo& field) {
  std::string words(field.title);
  if (!field.symbol.empty()) words += " " + std::string(field.symbol);
  if (!field.unit.empty()) words += ", " + std::string(field.unit);
  return words;
}

ImVec2 legend_size(const Theme& theme, float room) {
  return {std::min(theme.px(width), room), theme.px(height)};
}

ImVec2 legend_line_size(const Theme& theme, float room) {
  return {std::min(theme.px(line_width), room), theme.px(line_height)};
}

ImVec2 legend_short_line_size(const Theme& theme, float room) {
  return {std::min(theme.px(short_line_width), room), theme.px(line_height)};
}

LegendParts draw_color_legend(const PlotPaint& paint, ImVec2 at, ImVec2 size, const ColorLegend& legend) {
  const Theme& theme = paint.theme;
  const Tokens& c = theme.colors;
  paint.draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, faded(c.ground, 0.85f), theme.px(6));
  if (size.y < theme.px(height)) return draw_line(paint, at, size, legend);
  const float pad = theme.px(padding);
  const ImVec2 lo{at.x + pad, at.y + theme.px(bar_top)}, hi{at.x + size.x - pad, lo.y + theme.px(bar_height)};
  draw_heading(paint, {lo.x, at.y}, hi.x, legend);
  draw_bar(paint, lo, hi, legend.map);
  if (legend.beyond) {  // the ends are arrows
    const float middle = (lo.y + hi.y) / 2, tip = theme.px(6);
    paint.draw.AddTriangleFilled({hi.x, lo.y}, {hi.x + tip, middle}, {hi.x, hi.y}, map_color(legend.map, 1));
    if (legend.field.is_signed)
      paint.draw.AddTriangleFilled({lo.x, hi.y}, {lo.x - tip, middle}, {lo.x, lo.y}, map_color(legend.map, 0));
  }
  const ImFont& mono = *paint.fonts.mono;
  const float baseline = baseline_at(paint.fonts, std::round(at.y + theme.px(ticks_middle)));
  const std::vector<PlotTick> ticks = legend_ticks(legend);
  const float end = hi.x + pad / 2, of_top = text_width(mono, ticks.back().label), gap = theme.px(8);
  float free_from = lo.x - pad / 2;
  for (const PlotTick& tick : ticks) {
    const bool last = &tick == &ticks.back();
    const float x = std::round(lo.x + float(legend.at(tick.at)) * (hi.x - lo.x)), of_it = text_width(mono, tick.label);
    paint.draw.AddLine({x, hi.y}, {x, hi.y + theme.px(3)}, c.quiet);
    if (last && legend.grip) continue;
    // The number at the end stays; one that would touch it or the one before it goes without.
    const float left = last ? std::max(end - of_it, lo.x - pad / 2) : std::max(x - of_it / 2, lo.x - pad / 2);
    if (!last && (left < free_from || left + of_it + gap > end - of_top)) continue;
    draw_on_baseline(paint.draw, mono, {left, baseline}, c.text, tick.label);
    free_from = left + of_it + gap;
  }
  draw_marker(paint, legend, lo, hi);
  draw_grip(paint, legend, lo, hi);
  return {{end, at.y + theme.px(ticks_middle)}, lo, hi};
}

}  // namespace tyglab
