// Every theme can be read: contrasts as the WCAG 2.1 defines them, and colors that the color-blind tell apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "app/ui/cards/cards.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/curve_plot.h"
#include "app/ui/kit/theme.h"
#include "core/integrators/scheme.h"

namespace tyglab::theme_test {

double linear_part(ImU32 byte) {
  const double c = double(byte & 255) / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(ImU32 color) {
  return 0.2126 * linear_part(color) + 0.7152 * linear_part(color >> 8) + 0.0722 * linear_part(color >> 16);
}

double contrast(ImU32 a, ImU32 b) {
  const double one = luminance(a), other = luminance(b);
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

TEST_CASE("text of every theme has 4.5 to 1 at least on all grounds, curves and signs 3 to 1") {
  for (const Look& look : looks()) {
    CAPTURE(std::string(look.name));
    const Tokens c = look.tokens();
    for (const ImU32 ground : {c.ground, c.panel, c.field}) {
      CHECK(contrast(c.text, ground) > 7);
      CHECK(contrast(c.quiet, ground) > 4.5);
    }
    CHECK(contrast(c.on_accent, c.accent) > 4.5);
    const std::array signs{c.accent,  c.danger, c.warning,   c.good,   c.blue, c.green,
                           c.magenta, c.yellow, c.vermilion, c.orange, c.sky};
    for (std::size_t n = 0; n < signs.size(); ++n) {
      CAPTURE(n);
      CHECK(contrast(signs[n], c.ground) > 3);
      CHECK(contrast(signs[n], c.panel) > 3);
    }
  }
}

TEST_CASE("in every theme the map's cells are told from the ground, and hidden curves can be read in a legend") {
  for (const Look& look : looks()) {
    CAPTURE(std::string(look.name));
    const Tokens c = look.tokens();
    const Preset preset;
    MapCell calm;
    calm.share = 1e-6;
    const Chart chart = map_chart(c, preset, MapGrid{}, {}, std::vector{calm});
    REQUIRE(chart.cells.size() == 1);
    CHECK(contrast(chart.cells[0].color, c.ground) >= 3);
    CHECK(contrast(chart.cells[0].color, c.panel) >= 3);
    for (const bool hovered : {false, true}) {
      const LegendInk ink = legend_ink(c, curve_style(c, "F_ext"), true, hovered);
      for (const ImU32 ground : {c.ground, c.panel}) {
        CHECK(contrast(ink.name, ground) >= 4.5);
        CHECK(contrast(ink.sample.color, ground) >= 4.5);
      }
      CHECK((ink.name >> 24) == 255);
      CHECK((ink.sample.color >> 24) == 255);
    }
  }
  // A colored cloth is told from a dark ground too.
  CHECK(contrast(map_color({}, 0), dark_tokens().ground) >= 3);
}

using Color = std::array<double, 3>;

/// CIE L*a*b* of linear sRGB (D65).
Color lab_of(const Color& rgb) {
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505),
               y = f(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]),
               z = f((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// What somebody sees who lacks one kind of cones (Machado, Oliveira and Fernandes 2009, severity 1).
struct Vision {
  const char* name;
  std::array<Color, 3> matrix;
};
const Vision visions[] = {
    {"usual", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"no red", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"no green", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.01182, 0.04294, 0.968881}}}},
    {"no blue", {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.3039}}}}};

double difference(ImU32 a, ImU32 b, const Vision& vision) {
  const auto seen = [&](ImU32 color) {
    const Color rgb{linear_part(color), linear_part(color >> 8), linear_part(color >> 16)};
    Color out{};
    for (std::size_t n = 0; n < 3; ++n)
      out[n] = std::clamp(vision.matrix[n][0] * rgb[0] + vision.matrix[n][1] * rgb[1] + vision.matrix[n][2] * rgb[2],
                          0.0, 1.0);
    return lab_of(out);
  };
  const Color one = seen(a), other = seen(b);
  return std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
}

TEST_CASE("the colors of the zones of stability are told apart in every theme, also by the color-blind") {
  for (const Look& look : looks())
    for (const Vision& vision : visions) {
      CAPTURE(std::string(look.name));
      CAPTURE(std::string(vision.name));
      const Tokens c = look.tokens();
      const ImU32 stable = zone_color(c, Zone::stable), depends = zone_color(c, Zone::depends),
                  unstable = zone_color(c, Zone::unstable);
      constexpr double plainly = 15;  // 2.3 can just be seen
      CHECK(difference(stable, depends, vision) > plainly);
      CHECK(difference(depends, unstable, vision) > plainly);
      CHECK(difference(stable, unstable, vision) > plainly);
    }
}

TEST_CASE("methods are told apart by color, by the color-blind also by the line, and can be seen on every ground") {
  std::vector<std::string_view> names(integrator_names().begin(), integrator_names().end());
  names.push_back("exact");
  constexpr double plainly = 15, by_color_alone = 20;  // 2.3 can just be seen
  for (const Look& look : looks()) {
    CAPTURE(std::string(look.name));
    const Tokens c = look.tokens();
    const auto unnamed = integrator_style(c, "no method");
    for (std::size_t n = 0; n < names.size(); ++n) {
      CAPTURE(std::string(names[n]));
      const CurveStyle one = integrator_style(c, names[n]);
      CHECK(one.color != unnamed.color);
      for (const ImU32 ground : {c.ground, c.panel, c.field}) CHECK(contrast(one.color, ground) >= 3);
      for (std::size_t k = 0; k < n; ++k) {
        CAPTURE(std::string(names[k]));
        const CurveStyle other = integrator_style(c, names[k]);
        CHECK(difference(one.color, other.color, visions[0]) > by_color_alone);
        for (const Vision& vision : std::span(visions).first(3)) {
          CAPTURE(std::string(vision.name));
          CHECK((one.line != other.line || difference(one.color, other.color, vision) > plainly));
        }
      }
    }
  }
}

TEST_CASE("copies of one method are told apart from all methods and each other, and can be seen on every ground") {
  constexpr double plainly = 15, by_color_alone = 20;  // 2.3 can just be seen
  for (const Look& look : looks()) {
    CAPTURE(std::string(look.name));
    const Tokens c = look.tokens();
    std::vector<CurveStyle> others;
    for (const std::string_view name : integrator_names()) others.push_back(integrator_style(c, name));
    others.push_back(integrator_style(c, "exact"));
    for (std::size_t seat = 0; seat < Lockstep::most; ++seat) {
      CAPTURE(seat);
      const CurveStyle one = copy_style(c, "verlet", seat);
      for (const ImU32 ground : {c.ground, c.panel, c.field}) CHECK(contrast(one.color, ground) >= 3);
      for (const CurveStyle& other : others) {
        CHECK(difference(one.color, other.color, visions[0]) > by_color_alone);
        for (const Vision& vision : std::span(visions).first(3))
          CHECK((one.line != other.line || difference(one.color, other.color, vision) > plainly));
      }
      others.push_back(one);
    }
  }
}

TEST_CASE("a method looks the same in every chart") {
  for (const std::string_view name : integrator_names()) {
    CAPTURE(std::string(name));
    const Tokens c = dark_tokens();
    const CurveStyle style = integrator_style(c, name);
    StabilityLimits limits;
    limits.of.integrator = name;
    limits.damped = {{0.1, 0.2}, {1, 1}}, limits.undamped = limits.damped;
    AccuracyStudy study;
    study.points = {{std::string(name), Precision::double_, 0.001, 0, 1e-4, 0.1, true}};
    for (const Chart& chart : {stability_chart(c, limits), accuracy_chart(c, study)}) {
      REQUIRE_FALSE(chart.series.empty());
      CHECK(chart.series.front().style.color == style.color);
      CHECK(chart.series.front().style.line == style.line);
    }
  }
}

TEST_CASE("an unknown theme is the first one") {
  CHECK(look("projector").magnified > 1.2f);
  CHECK(look("sepia").name == "dark");
}

}  // namespace tyglab::theme_test
