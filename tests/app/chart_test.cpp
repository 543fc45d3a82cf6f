// Pictures of charts, drawn without a display.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "app/render/image.h"
#include "app/ui/kit/chart.h"

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
  for (int y = 0; y < 330; ++y)
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

}  // namespace tyglab::chart_test
