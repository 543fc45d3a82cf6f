// Pictures of charts, drawn without a display.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "app/base/image.h"
#include "app/platform/platform.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/scene_picture.h"

namespace tyglab::chart_test {

constexpr ImU32 red = IM_COL32(255, 0, 0, 255);

/// The picture of charts that each hold one series in red.
Image picture(const std::vector<Chart>& charts) {
  const auto file = std::filesystem::temp_directory_path() / "tyglab-chart-test.png";
  write_charts(file, charts, Reach::whole, 2, 1);
  Image image = read_image(file);
  std::filesystem::remove(file);
  return image;
}

bool is_red(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[3 * (std::size_t(y) * image.width + x)];
  return p[0] > 200 && p[1] < 60 && p[2] < 60;
}

struct Box {
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
};

/// Where the red pixels lie above the legend.
Box red_box(const Image& image) {
  Box box;
  for (int y = 0; y < std::min(330, image.height); ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_red(image, x, y))
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y)};
  return box;
}

Chart one(std::vector<double> x, std::vector<double> y, bool log) {
  return {"Title",
          "note",
          {"t (s)", log, false, {}},
          {"e (m)", log, false, {}},
          {{"red", {red, LineStyle::solid, 2}, true, 3, x, y}}};
}

TEST_CASE("a straight line goes from corner to corner, linear and logarithmic") {
  for (const bool log : {false, true}) {
    CAPTURE(log);
    const Chart chart = log ? one({1e-3, 1e-2, 1e-1}, {1e-6, 1e-4, 1e-2}, true) : one({0, 1, 2}, {0, 2, 4}, false);
    const Image image = picture({chart});
    REQUIRE(image.width == 640);
    REQUIRE(image.height == 400);
    const Box box = red_box(image);
    CHECK(box.left < 90);
    CHECK(box.right > 600);
    CHECK(box.top < 100);
    CHECK(box.bottom > 280);
    CHECK(is_red(image, (box.left + box.right) / 2, (box.top + box.bottom) / 2));
  }
}

TEST_CASE("names stand in place of numbers, and the axis holds half a step more") {
  Chart chart = one({1, 1}, {0, 1}, false);
  chart.y.ticks = {{0, "wind"}, {1, "bodies"}};
  chart.x.from_zero = true;
  const Box box = red_box(picture({chart}));
  CHECK(box.top > 100);
  CHECK(box.bottom < 310);
}

TEST_CASE("nothing to draw, and what is not finite, make a picture all the same") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Image empty = picture({one({}, {}, true), one({1, 2, 3}, {nan, -1, INFINITY}, true), one({1}, {1}, false)});
  CHECK(empty.width == 1280);
  CHECK(empty.height == 800);
}

TEST_CASE("names stand beside the ends of curves, below each other where the curves end together") {
  const HeadlessContext context;
  Theme theme;
  const PictureGui gui({300, 200}, theme);
  const PlotPaint paint{gui.draw(), theme, gui.fonts()};
  paint.draw.AddRectFilled({0, 0}, {300, 200}, IM_COL32(0, 0, 0, 255));
  const std::vector<double> x{0, 1}, together{0.5, 0.5}, low{0.1, 0};
  const std::array<ImU32, 3> inks{red, IM_COL32(0, 255, 0, 255), IM_COL32(0, 0, 255, 255)};
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < inks.size(); ++k)
    curves.push_back({k == 2 ? "Euler" : "F_s", {inks[k], LineStyle::solid, 2}, x, k == 2 ? low : together});
  const float names = end_labels_width(paint, curves);
  CHECK(names > 20);
  const PlotAxes axes{{20, 10}, {300 - names, 190}, {0, 1}, {0, 1}};
  draw_end_labels(paint, axes, curves, 0, 2, 300);
  const Image image = gui.pixels();
  std::array<int, 3> top{200, 200, 200}, bottom{-1, -1, -1};
  for (int y = 0; y < image.height; ++y)
    for (int at = int(axes.hi.x); at < image.width; ++at) {
      const std::uint8_t* p = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(at))];
      for (std::size_t k = 0; k < 3; ++k)
        if (p[k] > 200 && p[(k + 1) % 3] < 60 && p[(k + 2) % 3] < 60)
          top[k] = std::min(top[k], y), bottom[k] = std::max(bottom[k], y);
    }
  for (std::size_t k = 0; k < 3; ++k) CHECK(bottom[k] >= top[k]);  // each has a stroke of its curve's color
  CHECK(std::abs(top[0] - top[1]) > 12);
  CHECK(std::abs((top[0] + top[1]) / 2 - 100) < 14);
  CHECK(bottom[2] > 165);
  CHECK(bottom[2] < 190);
  // Where there is no room for all there are none.
  const Image before = gui.pixels();
  draw_end_labels(paint, {{20, 10}, {300 - names, 30}, {0, 1}, {0, 1}}, curves, 0, 2, 300);
  CHECK(gui.pixels().rgb == before.rgb);
}

TEST_CASE("the name of a curve that leaves the scale stands below its flags, and beside names further on") {
  const HeadlessContext context;
  Theme theme;
  const PictureGui gui({300, 200}, theme);
  const PlotPaint paint{gui.draw(), theme, gui.fonts()};
  paint.draw.AddRectFilled({0, 0}, {300, 200}, IM_COL32(0, 0, 0, 255));
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<double> x{0, 0.1, 0.2, 0.9}, leaves{0.5, 0.98, infinite, infinite}, stays{0.5, 0.5, 0.5, 0.95};
  const std::vector<PlotCurve> curves{{"F_s", {red, LineStyle::solid, 2}, x, leaves},
                                      {"F_b", {IM_COL32(0, 255, 0, 255), LineStyle::solid, 2}, x, stays}};
  draw_end_labels(paint, {{20, 10}, {200, 190}, {0, 1}, {0, 1}}, curves, 0, 4, 300);
  const Box box = red_box(gui.pixels());
  CHECK(box.top > 10 + 8);
  CHECK(box.top < 10 + 8 + 14);  // not pushed down by the other
}

}  // namespace tyglab::chart_test
