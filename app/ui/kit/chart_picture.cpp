#include "app/platform/headless_context.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/picture_gui.h"

namespace tyglab {

Image picture_of(const std::vector<Chart>& charts, int columns, float scale, float height) {
  Theme theme;
  theme.scale = scale;
  const int across = std::min(columns, std::max(1, int(charts.size())));
  const int down = (int(charts.size()) + across - 1) / across;
  const ImVec2 one{theme.px(chart_width), theme.px(height)};
  const ImVec2 size{one.x * float(across), one.y * float(down)};
  const PictureGui gui(size, theme);
  const PlotPaint paint{gui.draw(), theme, gui.fonts()};
  paint.draw.AddRectFilled({0, 0}, size, theme.colors.panel);
  for (std::size_t k = 0; k < charts.size(); ++k)
    draw_chart(paint, {one.x * float(int(k) % across), one.y * float(int(k) / across)}, one, charts[k]);
  return gui.pixels();
}

void write_charts(const std::filesystem::path& file, const std::vector<Chart>& charts, Reach reach, int columns,
                  float scale, float height) {
  const HeadlessContext context;
  write_png(file, picture_of(charts, columns, scale, height), reach);
}

}  // namespace tyglab
