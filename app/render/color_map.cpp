#include "app/render/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyglab {
namespace {

/// Lightness and the two opponent axes.
struct Oklab {
  double L, a, b;
};

using Anchors = std::array<Oklab, 3>;

// Lightness keeps away from the ground's at the end that is near it: 3 to 1 at least for blue on dark grounds.
constexpr Anchors magnitude_on_dark{{{0.54, -0.02, -0.14}, {0.745, -0.12, 0.02}, {0.95, -0.03, 0.12}}};
constexpr Anchors magnitude_on_light{{{0.28, 0.01, -0.11}, {0.56, -0.09, 0.01}, {0.84, -0.02, 0.14}}};
// Blue against vermilion is what every kind of color blindness tells apart.
constexpr Anchors diverging_on_dark{{{0.52, -0.03, -0.15}, {0.90, 0.00, 0.005}, {0.52, 0.14, 0.09}}};
constexpr Anchors diverging_on_light{{{0.42, -0.02, -0.14}, {0.86, 0.00, 0.005}, {0.42, 0.12, 0.08}}};

double encoded(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

ImU32 srgb(const Oklab& lab) {
  const double l = std::pow(lab.L + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3),
               m = std::pow(lab.L - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3),
               s = std::pow(lab.L - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  const std::array<double, 3> rgb{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                  -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  const auto byte = [](double linear) { return int(std::lround(255 * encoded(linear))); };
  return IM_COL32(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), 255);
}

ImU32 between(const Anchors& anchors, double part) {
  const double at = std::clamp(part, 0.0, 1.0) * double(anchors.size() - 1);
  const auto n = std::min(std::size_t(at), anchors.size() - 2);
  const double t = at - double(n);
  const Oklab &from = anchors[n], &to = anchors[n + 1];
  return srgb({std::lerp(from.L, to.L, t), std::lerp(from.a, to.a, t), std::lerp(from.b, to.b, t)});
}

}  // namespace

ImU32 map_color(const ColorMap& map, double part) {
  if (map.diverging) return between(map.on_light ? diverging_on_light : diverging_on_dark, part);
  return between(map.on_light ? magnitude_on_light : magnitude_on_dark, part);
}

std::vector<ImU32> map_colors(const ColorMap& map, int count) {
  std::vector<ImU32> colors;
  for (int k = 0; k < count; ++k) colors.push_back(map_color(map, double(k) / (count - 1)));
  return colors;
}

}  // namespace tyglab
