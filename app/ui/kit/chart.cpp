#include "app/ui/kit/chart.h"

#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

struct Range {
  PlotScale scale;
  std::vector<PlotTick> ticks;
};

Range range_of(const ChartAxis& axis, const std::vector<ChartSeries>& all, std::vector<double> ChartSeries::*values,
               bool upright) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const ChartSeries& series : all)
    for (const double v : series.*values)
      if (PlotScale{0, 1, axis.log}.drawable(v)) least = std::min(least, v), most = std::max(most, v);
  if (!axis.ticks.empty()) {
    const double first = axis.ticks.front().at, last = axis.ticks.back().at;
    const double steps = std::max(1.0, double(axis.ticks.size()) - 1);
    if (axis.log) {
      const double half = axis.ticks.size() > 1 ? std::pow(last / first, 0.5 / steps) : 2;
      return {{first / half, last * half, true}, axis.ticks};
    }
    const double half = axis.ticks.size() > 1 ? 0.5 * (last - first) / steps : 0.5;
    return {{first - half, last + half, false}, axis.ticks};
  }
  if (least > most) least = 0.1, most = 1;
  if (axis.span) std::tie(least, most) = *axis.span;
  PlotRange range = axis.log ? log_range(least, most, 16) : linear_range(least, most, axis.from_zero);
  if (upright) add_headroom(range, least, most, axis.log);
  std::vector<double> ticks = range.ticks;
  if (axis.log) std::reverse(ticks.begin(), ticks.end());
  if (!axis.span) return {{range.lo, range.hi, axis.log}, labeled(ticks)};
  std::erase_if(ticks, [&](double at) { return at < least || at > most; });
  return {{least, most, axis.log}, labeled(ticks)};
}

void draw_cell(const PlotPaint& paint, const PlotAxes& axes, const ChartCell& cell) {
  const ImVec2 lo{axes.px(cell.x_lo), axes.py(cell.y_hi)}, hi{axes.px(cell.x_hi), axes.py(cell.y_lo)};
  paint.draw.AddRectFilled(lo, hi, cell.color);
  if (!cell.hatched) return;
  paint.draw.PushClipRect(lo, hi, true);
  const float tall = hi.y - lo.y, apart = paint.theme.px(6);
  // From one origin, so that the lines of neighboring cells meet.
  const float first = std::floor((lo.x + lo.y) / apart) * apart;
  for (float sum = first; sum < hi.x + hi.y; sum += apart)
    paint.draw.AddLine({sum - lo.y, lo.y}, {sum - lo.y - tall, hi.y}, faded(paint.theme.colors.ground, 0.55f),
                       paint.theme.px(1.2f));
  paint.draw.PopClipRect();
}

/// Lays the names out in lines; draws them if `paint_it`. Returns the height that they take.
float legend(const PlotPaint& paint, ImVec2 at, float width, const Chart& chart, bool paint_it) {
  const Theme& theme = paint.theme;
  const float line = theme.px(20), sample = theme.px(24), gap = theme.px(8), between = theme.px(20);
  float x = 0, y = 0;
  for (const ChartSeries& series : chart.series) {
    if (series.name.empty()) continue;
    const float needs = sample + gap + text_width(*paint.fonts.text, series.name);
    if (x > 0 && x + needs > width) x = 0, y += line;
    if (paint_it) {
      const ImVec2 from{at.x + x, at.y + y + line / 2}, to{from.x + sample, from.y};
      const std::array<ImVec2, 2> ends{from, to};
      if (series.line) draw_styled_line(paint.draw, ends.data(), 2, series.style, theme.scale);
      if (series.marks > 0)
        draw_mark(paint, {(from.x + to.x) / 2, from.y}, series.marks, series.style.color, series.hollow);
      draw_on_baseline(paint.draw, *paint.fonts.text, {to.x + gap, baseline_at(paint.fonts, from.y)}, theme.colors.text,
                       series.name);
    }
    x += needs + between;
  }
  return chart.series.empty() ? 0 : y + line;
}

}  // namespace

CurveStyle series_style(const Tokens& c, int k) {
  const std::array<ImU32, 8> colors{c.blue, c.vermilion, c.green, c.magenta, c.yellow, c.sky, c.orange, c.text};
  constexpr std::array lines{LineStyle::solid, LineStyle::dashed, LineStyle::dash_dot, LineStyle::dotted};
  return {colors[std::size_t(k) % colors.size()], lines[std::size_t(k) / colors.size() % lines.size()], 1.8f};
}

PlotAxes draw_chart(const PlotPaint& paint, ImVec2 at, ImVec2 size, const Chart& chart) {
  const Theme& theme = paint.theme;
  const Fonts& fonts = paint.fonts;
  const Tokens& c = theme.colors;
  const float pad = theme.px(chart.padding);
  paint.draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.panel);
  const ImVec2 lo{at.x + pad, at.y + pad}, hi{at.x + size.x - pad, at.y + size.y - pad};
  draw_text(paint.draw, *fonts.title, lo, c.text, chart.title);
  float top = lo.y + (chart.title.empty() ? 0 : fonts.title->FontSize + theme.px(2));
  draw_text(paint.draw, *fonts.small, {lo.x, top}, c.quiet, chart.note);
  top += (chart.note.empty() ? 0 : fonts.small->FontSize) + theme.px(chart.title.empty() ? 0 : 10);
  draw_text(paint.draw, *fonts.axis, {lo.x, top}, c.text, chart.y.title);
  top += (chart.y.title.empty() ? 0 : fonts.axis->FontSize) + theme.px(8);

  const Range x = range_of(chart.x, chart.series, &ChartSeries::x, false),
              y = range_of(chart.y, chart.series, &ChartSeries::y, true);
  float labels = 0;
  for (const PlotTick& tick : y.ticks) labels = std::max(labels, text_width(*fonts.axis, tick.label) + theme.px(7));
  const float legend_height = legend(paint, lo, hi.x - lo.x, chart, false);
  const float below = 2 * fonts.axis->FontSize + theme.px(14) + legend_height;
  const PlotAxes axes{{lo.x + labels, top}, {hi.x, hi.y - below}, x.scale, y.scale};
  draw_ground(paint, axes, y.ticks);
  draw_x_ticks(paint, axes, x.ticks);
  const float title_width = text_width(*fonts.axis, chart.x.title);
  draw_text(paint.draw, *fonts.axis,
            {std::round((axes.lo.x + axes.hi.x - title_width) / 2), axes.hi.y + fonts.axis->FontSize + theme.px(6)},
            c.text, chart.x.title);
  paint.draw.PushClipRect({axes.lo.x - theme.px(4), axes.lo.y - theme.px(4)},
                          {axes.hi.x + theme.px(4), axes.hi.y + theme.px(4)}, true);
  for (const ChartCell& cell : chart.cells) draw_cell(paint, axes, cell);
  for (const ChartSeries& series : chart.series)
    draw_curve(paint, axes, {series.name, series.style, series.x, series.y, series.line, series.marks, series.hollow},
               0, series.x.size());
  paint.draw.PopClipRect();
  legend(paint, {lo.x, hi.y - legend_height}, hi.x - lo.x, chart, true);
  return axes;
}

}  // namespace tyglab
