// Coloring the cloth: the maps, the scale that does not flicker, the legend's words, what the renderer draws and what
// it costs where it is off.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "app/base/files.h"
#include "app/platform/platform.h"
#include "app/render/cloth_renderer.h"
#include "app/render/field_colors.h"
#include "app/ui/cards/cards.h"
#include "app/ui/kit/color_legend.h"
#include "core/io/preset_io.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::color_test {

constexpr int width = 160, height = 120;

std::array<int, 3> bytes(ImU32 color) {
  return {int(color & 255), int(color >> 8 & 255), int(color >> 16 & 255)};
}

/// Lightness of Oklab.
double lightness(ImU32 color) {
  std::array<double, 3> c{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double v = bytes(color)[k] / 255.0;
    c[k] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return 0.2104542553 * std::cbrt(0.4122214708 * c[0] + 0.5363325363 * c[1] + 0.0514459929 * c[2]) +
         0.7936177850 * std::cbrt(0.2119034982 * c[0] + 0.6806995451 * c[1] + 0.1073969566 * c[2]) -
         0.0040720468 * std::cbrt(0.0883024619 * c[0] + 0.2817188376 * c[1] + 0.6299787005 * c[2]);
}

TEST_CASE("magnitudes get evenly lighter; signs get evenly darker on both sides of a pale middle") {
  for (const bool on_light : {false, true}) {
    CAPTURE(on_light);
    const ColorMap magnitude{false, on_light}, sign{true, on_light};
    const double step = (lightness(map_color(magnitude, 1)) - lightness(map_color(magnitude, 0))) / 8;
    CHECK(step > 0.05);
    for (int k = 1; k <= 8; ++k)
      CHECK(lightness(map_color(magnitude, k / 8.0)) - lightness(map_color(magnitude, (k - 1) / 8.0)) ==
            doctest::Approx(step).epsilon(0.05));
    for (int k = 0; k <= 4; ++k)
      CHECK(lightness(map_color(sign, k / 8.0)) ==
            doctest::Approx(lightness(map_color(sign, 1 - k / 8.0))).epsilon(0.01));
    const auto middle = bytes(map_color(sign, 0.5));
    CHECK(std::abs(middle[0] - middle[2]) < 8);  // neutral
    // Blue against red, which every kind of color blindness tells apart.
    CHECK(bytes(map_color(sign, 0))[2] > bytes(map_color(sign, 0))[0] + 80);
    CHECK(bytes(map_color(sign, 1))[0] > bytes(map_color(sign, 1))[2] + 80);
  }
  CHECK(map_colors({}, 256).size() == 256);
}

TEST_CASE("the scale grows at once to a round number and shrinks only after a while") {
  SteadyTop top;
  CHECK(top.look(0) == 0);
  CHECK(top.look(0.0123) == doctest::Approx(0.02));
  CHECK(top.look(0.024) == doctest::Approx(0.03));
  for (int n = 1; n < SteadyTop::patience; ++n) CHECK(top.look(0.004) == doctest::Approx(0.03));
  CHECK(top.look(0.004) == doctest::Approx(0.005));
  top.look(0.015);
  for (int n = 0; n < 2 * SteadyTop::patience; ++n) top.look(n % 10 == 0 ? 0.015 : 0.004);  // it is needed now and then
  CHECK(top.now() == doctest::Approx(0.02));
  CHECK(top.look(NAN) == doctest::Approx(0.02));
  CHECK(top.look(7e5) == doctest::Approx(1e6));
}

TEST_CASE("a fixed scale stays, and a signed one is symmetric") {
  FieldColors colors{ParticleField::strain};
  colors.look(FieldSpan{-0.07f, 0.01f, 0.07f, 0.02f}, {});
  CHECK_FALSE(colors.beyond());
  CHECK(colors.range() == ValueRange{-0.1f, 0.1f});
  colors.fixed = 0.25;
  colors.look(FieldSpan{-2, 2, 2, 1}, {});
  CHECK(colors.beyond());
  CHECK(colors.range() == ValueRange{-0.25f, 0.25f});
  CHECK(FieldColors{ParticleField::speed}.range() == ValueRange{0, 1});
}

TEST_CASE("the legend names quantity, symbol and unit, with few round numbers") {
  CHECK(legend_words(info(ParticleField::tension)) == "Tension F_s, N");
  CHECK(legend_words(info(ParticleField::strain)) == "Strain");
  const auto legend = [](ParticleField field, double top) {
    return ColorLegend{.field = info(field), .map = {}, .top = top, .root = root_scale(field)};
  };
  const auto labels = [&](ParticleField field, double top) {
    std::string all;
    for (const PlotTick& tick : legend_ticks(legend(field, top))) all += tick.label + " ";
    return all;
  };
  CHECK(labels(ParticleField::tension, 0.2) == "0 0.02 0.1 0.2 ");
  CHECK(labels(ParticleField::tension, 3) == "0 0.3 1 3 ");
  CHECK(labels(ParticleField::tension, 5) == "0 0.5 2 5 ");
  CHECK(labels(ParticleField::tension, 0.123456) == "0 0.0123 0.0617 0.123 ");  // while its end is dragged
  CHECK(labels(ParticleField::speed, 3) == "0 1 2 3 ");
  CHECK(labels(ParticleField::strain, 0.05) == "-0.05 0 0.05 ");
  CHECK(legend(ParticleField::tension, 2).at(0.5) == 0.5);  // a quarter of the end: half of the colors
  CHECK(legend(ParticleField::speed, 2).at(0.5) == 0.25);
  CHECK(legend(ParticleField::strain, 2).at(0) == 0.5);
}

TEST_CASE("an automatic scale has a floor under which values are noise; a typed end has none") {
  Preset preset = test::cloth(12, 12);
  for (const FieldInfo& field : particle_fields()) {
    CAPTURE(field.name);
    FieldColors colors{field.field};
    colors.look(FieldSpan{-1e-9f, 1e-9f, 1e-9f, 5e-10f}, preset);
    const double least = least_top(field.field, preset);
    CHECK(colors.top() >= least * (1 - 1e-9));
    CHECK(colors.top() <= 2 * least);
    colors.look(FieldSpan{0, 1000, 900, 500}, preset);
    CHECK(colors.top() == 1000);
    colors.fixed = 1e-9;
    CHECK(colors.top() == 1e-9);
  }
  CHECK(least_top(ParticleField::strain, preset) == 1e-3);
  CHECK(least_top(ParticleField::tension, preset) == doctest::Approx(preset.m * preset.g));
  const double speed = least_top(ParticleField::speed, preset);
  CHECK(least_top(ParticleField::kinetic, preset) == doctest::Approx(preset.m * speed * speed / 2));
  preset.g = 0;
  CHECK(least_top(ParticleField::tension, preset) > 0);
  CHECK(least_top(ParticleField::speed, preset) > 0);
}

TEST_CASE("a cloth at rest shows no rounding noise, in any field") {
  Preset preset = load_preset(find_preset("hanging").file);
  test::Desk desk(preset);
  for (const FieldInfo& field : particle_fields()) {
    if (field.field == ParticleField::distance) continue;
    CAPTURE(field.name);
    desk.scene.colors.choose(field.field);
    desk.scene.colors.update(desk.scene, 0, 1);
    const FieldColors& colors = *desk.scene.colors.chosen;
    const ColorLegend legend{.field = field, .map = {}, .top = colors.top(), .root = root_scale(field.field)};
    double least = 1, most = 0;
    for (int i = 0; i < preset.rows; ++i)
      for (int j = 0; j < preset.columns; ++j) {
        const double at = legend.at(*desk.scene.colors.value(0, {i, j}));
        least = std::min(least, at), most = std::max(most, at);
      }
    CHECK(most - least < 0.1);  // of the colors
  }
}

TEST_CASE("of the tension of a hanging cloth more than two corners is seen") {
  Preset preset = load_preset(find_preset("hanging").file);
  test::Desk desk(preset);
  desk.session.simulation->advance(4000);
  desk.scene.colors.choose(ParticleField::tension);
  desk.scene.colors.update(desk.scene, 0, 1);
  const FieldColors& colors = *desk.scene.colors.chosen;
  const ValueRange range = colors.range();
  int seen = 0;
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) {
      const double part = *desk.scene.colors.value(0, {i, j}) / range.hi;
      seen += (range.root ? std::sqrt(part) : part) > 0.25;
    }
  CHECK(seen > preset.rows * preset.columns / 4);
}

class Stage {
 public:
  Stage() {
    options_.ground = options_.shadows = false;
    options_.samples = 1;
    camera_.yaw = camera_.pitch = 0;
    camera_.target = {0, 0.9f, 0};
    camera_.distance = 0.6f;
    renderer_.set_color_map(map_colors({}, map_size));
  }
  Image draw(Simulation& cloth, int mode, std::optional<ValueRange> range, std::span<const float> values = {}) {
    options_.mode = mode;
    options_.colored = range;
    renderer_.update(cloth, options_);
    if (range) renderer_.set_values(values, cloth.lattice().rows, cloth.lattice().columns);
    renderer_.draw(camera_, options_, width, height);
    return renderer_.pixels();
  }

 private:
  HeadlessContext context_;
  ClothRenderer renderer_;
  ViewOptions options_;
  Camera camera_;
};

/// Mean color of a box in the middle of the left (or right) half of the cloth.
std::array<double, 3> mean(const Image& image, bool right) {
  std::array<double, 3> sum{};
  constexpr int side = 20;
  const int x0 = width / 2 + (right ? 22 : -22) - side / 2, y0 = height / 2;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += double(image.rgb[std::size_t(3) * (std::size_t(y) * width + std::size_t(x)) + c]) / (side * side);
  return sum;
}

TEST_CASE("values color the cloth from one end of the map to the other, in every view, and leave no trace when off") {
  Stage stage;
  Preset preset = test::quiet_cloth(9, 9);
  preset.pins.mode = Pins::Mode::none;
  preset.x_0 = {0, 1.02, 0};
  Simulation cloth(preset);
  std::vector<float> values;
  for (int p = 0; p < 81; ++p) values.push_back(p % 9 < 4 ? 0.f : p % 9 > 4 ? 2.f : 1.f);
  for (int mode = 1; mode <= 5; ++mode) {
    CAPTURE(mode);
    const Image plain = stage.draw(cloth, mode, std::nullopt);
    const Image colored = stage.draw(cloth, mode, ValueRange{0, 2}, values);
    CHECK(plain.rgb != colored.rgb);
    CHECK(stage.draw(cloth, mode, std::nullopt).rgb == plain.rgb);
    const auto low = mean(colored, false), high = mean(colored, true);
    CHECK(high[0] > low[0] + (mode == 1 || mode == 3 ? 100 : 10));  // pale yellow against dark blue
  }
  // Legible: in the light, a color is between two thirds of the legend's and the legend's own.
  const auto high = mean(stage.draw(cloth, 1, ValueRange{0, 2}, values), true);
  const auto wanted = bytes(map_color({}, 1));
  // On a root scale a quarter of the end has the color that half of it has on a linear one.
  const std::vector<float> half(81, 1.f), quarter(81, 0.5f);
  const auto linear = mean(stage.draw(cloth, 1, ValueRange{0, 2}, half), true),
             root = mean(stage.draw(cloth, 1, ValueRange{0, 2, true}, quarter), true);
  for (std::size_t c = 0; c < 3; ++c) CHECK(root[c] == doctest::Approx(linear[c]).epsilon(0.01));
  CHECK(high[0] <= wanted[0] + 1);
  CHECK(high[0] >= 0.66 * wanted[0]);
  CHECK(high[2] / high[0] == doctest::Approx(double(wanted[2]) / wanted[0]).epsilon(0.06));
  values.assign(81, NAN);
  const auto gray = mean(stage.draw(cloth, 1, ValueRange{0, 2}, values), true);
  CHECK(std::abs(gray[0] - gray[2]) < 3);
}

TEST_CASE("colors are skipped where nothing is colored, and distance asks for a copy") {
  test::Desk desk(test::cloth(6, 6));
  const auto activity = [&] {
    for (const FeatureRow& row : feature_rows(desk.ui))
      if (row.name == "colors") return row.activity;
    return Activity::asleep;
  };
  CHECK(activity() == Activity::skipped);
  CHECK(next_field(desk.scene) == ParticleField::tension);
  desk.scene.colors.choose(ParticleField::speed);
  CHECK(activity() == Activity::on);
  CHECK(next_field(desk.scene) == ParticleField::kinetic);
  desk.scene.colors.choose(ParticleField::distance);
  CHECK(activity() == Activity::skipped);
  CHECK(shown_colors(desk.scene) == nullptr);
  CHECK(why_not_colored(desk.scene, ParticleField::distance).find("no copy") != std::string::npos);
  desk.session.copies.lockstep.add(*desk.session.simulation, {});
  CHECK(shown_colors(desk.scene) != nullptr);
  CHECK_FALSE(next_field(desk.scene).has_value());
}

TEST_CASE("what is left of a cloth that has diverged has a scale that tells its parts apart; the next motion its own") {
  Preset preset = test::cloth(12, 12);
  test::Desk desk(preset);
  Simulation& cloth = *desk.session.simulation;
  desk.scene.colors.choose(ParticleField::tension);
  const auto top = [&] {
    desk.scene.colors.update(desk.scene, 0, 1);
    return desk.scene.colors.chosen->top();
  };
  cloth.advance(5);
  const double before = top();
  preset.integrator = "euler", preset.dt = 0.01, preset.k_s = 500;
  cloth.apply(edit::Change{preset});
  cloth.advance(1000);
  REQUIRE(cloth.divergence());
  const double of_wreck = top();
  CHECK(of_wreck > 10 * before);
  int graded = 0;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) graded += *desk.scene.colors.value(0, {i, j}) <= of_wreck;
  CHECK(graded >= 72);  // half of the cloth
  CHECK(graded < 140);  // nor do a few springs take all of the scale
  cloth.apply(edit::Change{test::cloth(12, 12)});
  cloth.apply(edit::Restart{});
  cloth.advance(5);
  CHECK(top() == before);
}

TEST_CASE("in a replay the scale grows with what it shows, and at its end is the one of the wreck") {
  Preset preset = test::cloth(12, 12);
  preset.k_s = 200, preset.dt = 1.15e-3;
  test::Desk desk(preset);
  Session& session = desk.session;
  session.scripted = session.pacing.patient = true;
  desk.scene.colors.choose(ParticleField::strain);
  const auto top = [&] {
    desk.scene.colors.update(desk.scene, 0, 1);
    return desk.scene.colors.chosen->top();
  };
  double last = 0;
  while (!session.simulation->divergence()) {
    session.simulation->advance(1);
    last = session.simulation->divergence() ? last : top();
  }
  const double of_wreck = top();
  CHECK(of_wreck < last / 10);  // that of the last whole step is for a few springs
  session.rewind.clear();
  session.simulation->apply(edit::Restart{});
  while (!session.simulation->divergence()) session.update(0.05, {});
  CHECK(top() == of_wreck);
  session.request(request::Replay{});
  session.update(0, {});
  REQUIRE(session.replay);
  const double first = top();
  CHECK(first < of_wreck / 10);
  double before = first;
  while (session.replay) {
    const double now = top();
    CHECK(now >= before);
    int strong = 0;  // of the cloth, how much is not pale
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) strong += std::abs(*desk.scene.colors.value(0, {i, j})) > now / 10;
    CHECK(strong >= 5);
    before = now;
    session.update(0.05, {});
  }
  CHECK(top() == of_wreck);
}

TEST_CASE("values are worked out once for a state, and again when it moves or a constant changes") {
  test::Desk desk(test::cloth(6, 6));
  desk.scene.colors.choose(ParticleField::tension);
  desk.scene.colors.update(desk.scene, 0, 1);
  const auto first = desk.scene.colors.version(0);
  desk.scene.colors.update(desk.scene, 0, 1);
  CHECK(desk.scene.colors.version(0) == first);
  desk.session.simulation->advance(5);
  desk.scene.colors.update(desk.scene, 0, 1);
  CHECK(desk.scene.colors.version(0) == first + 1);
  const float before = *desk.scene.colors.value(0, {0, 0});
  CHECK(before > 0);
  Preset stiffer = desk.session.preset();
  stiffer.k_s *= 2;
  desk.session.simulation->apply(edit::Change{stiffer});
  desk.scene.colors.update(desk.scene, 0, 1);
  CHECK(*desk.scene.colors.value(0, {0, 0}) == doctest::Approx(2 * before));
  CHECK_FALSE(desk.scene.colors.value(0, {9, 0}).has_value());
}

}  // namespace tyglab::color_test
