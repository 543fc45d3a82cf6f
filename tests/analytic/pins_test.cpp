// Pins that move (core/moving_pins.h): where they are, and motions that can be told from those of pins at rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "tests/support/scenes.h"

namespace tyglab::pins_test {

/// A small cloth that hangs by two corners.
Preset hanging(const std::string& method, Precision precision = Precision::double_) {
  Preset preset = test::cloth(7, 6, method);
  preset.precision = precision, preset.dt = 5e-4, preset.iterations = 20, preset.tolerance = 1e-10;
  return preset;
}

glm::dvec3 corner(Simulation& simulation, int j = 0) {
  return simulation.position(0, j);
}

TEST_CASE("a pin is where its path is, in both precisions and however slow it is, and rests at the end") {
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const EngineKind engine : {EngineKind::cpu, EngineKind::plain}) {
      if (engine == EngineKind::plain && precision == Precision::float_) continue;
      Preset preset = hanging("verlet", precision);
      preset.engine = engine, preset.k_s = 5, preset.dt = 1e-4;
      // 2 µm a step; a key within a step.
      preset.pins.motions = {{.mode = Pins::Mode::top_row,
                              .path = {{0.1, {7, 0, 0}}, {0.60003, {7.01, 0.004, 0}}, {0.8, {7.01, -0.05, 0.02}}}}};
      Simulation simulation(preset);
      const glm::dvec3 start = corner(simulation);
      const double digits = precision == Precision::float_ ? 4e-6 : 1e-12;
      for (int n = 1; n <= 90; ++n) {
        simulation.advance(100);
        const glm::dvec3 way = on_path(preset.pins.motions[0].path, simulation.time()) - glm::dvec3(7, 0, 0);
        REQUIRE(glm::distance(corner(simulation), start + way) < digits);
      }
      CHECK(test::velocity(simulation.read(), 0) == glm::dvec3(0));
      CHECK(glm::distance(corner(simulation), start) > 0.02);
    }
}

TEST_CASE("a spin turns pins about its center until it ends") {
  Preset preset = hanging("rk4");
  preset.v_0 = {0, 0, 0}, preset.pins.mode = Pins::Mode::left_column;
  preset.pins.motions = {{.mode = Pins::Mode::left_column, .spin = {0, 40, 0}, .center = {0.1, 0, 0}, .until = 0.25}};
  Simulation simulation(preset);
  const glm::dvec3 start = corner(simulation), arm = start - glm::dvec3(0.1, start.y, 0);
  for (int n = 1; n <= 80; ++n) {
    simulation.advance(10);
    const double angle = 40 * std::min(simulation.time(), 0.25);
    const glm::dvec3 turned{arm.x * std::cos(angle) + arm.z * std::sin(angle), 0,
                            arm.z * std::cos(angle) - arm.x * std::sin(angle)};
    REQUIRE(glm::distance(corner(simulation), glm::dvec3(0.1, start.y, 0) + turned) < 1e-12);
  }
  CHECK(test::velocity(simulation.read(), 0) == glm::dvec3(0));
}

TEST_CASE("pins that move at a constant velocity with the cloth change nothing but where it is, with every method") {
  const glm::dvec3 velocity{0.7, -0.2, 1.1};
  for (const Scheme& method : schemes()) {
    CAPTURE(std::string(method.name));
    Preset rests = hanging(std::string(method.name)), moves = rests;
    moves.v_0 += velocity;
    moves.pins.motions = {{.mode = Pins::Mode::top_row, .path = {{0, {0, 0, 0}}, {100, 100.0 * velocity}}}};
    Simulation at_rest(rests), moving(moves);
    at_rest.advance(150), moving.advance(150);
    const State a = at_rest.read(), b = moving.read();
    double farthest = 0;
    for (std::size_t p = 0; p < a.x.x.size(); ++p)
      farthest =
          std::max(farthest, glm::distance(test::position(a, p) + velocity * at_rest.time(), test::position(b, p)));
    MESSAGE(std::string(method.name) << ": " << farthest);
    CHECK(farthest < (iterates(method) ? 1e-6 : 1e-9));
  }
}

TEST_CASE(
    "however the steps are grouped, the motion with moving pins is the same to the last bit, and so after a return") {
  for (const char* method : {"verlet", "rk4", "implicit_euler", "dopri5"})
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(method));
      Preset preset = hanging(method, precision);
      preset.pins.motions = {
          {.mode = Pins::Mode::list, .list = {{0, 0}}, .path = {{0.0101, {0, 0, 0}}, {0.0333, {0.02, 0, 0.1}}}},
          {.mode = Pins::Mode::top_row, .spin = {0, 0, 3}, .until = 0.03}};
      Simulation whole(preset), parts(preset), watched(preset);
      watched.enable_ledger(true);
      whole.advance(300), watched.advance(300);
      parts.advance(7);
      const Snapshot then = parts.snapshot();
      parts.advance(60);
      parts.restore(then);
      for (int made = 7; made < 300; made += std::min(17, 300 - made)) parts.advance(std::min(17, 300 - made));
      CHECK(parts.steps() == 300);
      CHECK(test::identical(whole.read(), parts.read()));
      CHECK(test::identical(whole.read(), watched.read()));
    }
}

TEST_CASE("the ledger counts the work of pins: what it does not explain falls with dt") {
  const auto left_over = [](double dt) {
    Preset preset = hanging("rk4");
    preset.dt = dt, preset.k_d = 0.001;
    preset.pins.motions = {{.mode = Pins::Mode::top_row, .path = {{0, {0, 0, 0}}, {0.032, {0, 0.04, 0.08}}}}};
    Simulation simulation(preset);
    simulation.enable_ledger(true);
    simulation.advance(int(std::lround(0.064 / dt)));
    const LedgerReading reading = *simulation.ledger();
    CHECK(reading.works.hand > 1e-4);
    return std::abs(reading.share());
  };
  // Springs that become slack let it scatter on the way.
  const double coarse = left_over(1e-3), fine = left_over(6.25e-5);
  MESSAGE(coarse << " and " << fine);
  CHECK(coarse < 1e-3);
  CHECK(fine < coarse / 50);
}

TEST_CASE("motions of pins are read, written, refused and scaled") {
  const std::string text =
      R"([{"pins": [[0, 0], [0, 31]], "path": [[0, 0, 0, 0], [1, 0.5, 0, 0]], )"
      R"("spin": [0, 2, 0], "center": [0, 1, 0], "until": 3}, {"pins": "top_row", "spin": [1, 0, 0]}])";
  const Preset preset = with_settings(Preset(), {"pin_motions=" + text});
  REQUIRE(preset.pins.motions.size() == 2);
  CHECK(parse_preset(preset_to_json(preset), "file") == preset);
  CHECK(preset_hash(preset) != preset_hash(Preset()));
  CHECK(with_settings(preset, {"pin_motions=[]"}) == Preset());
  CHECK(with_settings(preset, {"pins=top_row"}).pins.motions == preset.pins.motions);
  CHECK(with_resolution(preset, 2).pins.motions[0].list[1] == Pins::Site{0, 62});
  for (const auto& [wrong, why] : std::vector<std::pair<std::string, std::string>>{
           {R"([{"pins": [[0, 32]]}])", "outside the cloth"},
           {R"([{"pins": "top_row", "path": [[1, 0, 0, 0], [1, 0, 0, 0]]}])", "later than the one before"},
           {R"([{"pins": "top_row", "path": [[1, 0, 0]]}])", "[0].path[0]: must be [t, x, y, z], not of 3 numbers"},
           {R"([{"pins": "top_row", "path": [[1, 0, 2e3, 0]]}])", "numbers from -1000 to 1000, not 2000"},
           {R"([{"pins": "top_row", "spin": [0, 1e6, 0]}])", "spin must hold numbers from -1000 to 1000, not 1000000"},
           {R"([{"pins": "top_row", "spin": [0, 1, 0], "until": -1}])",
            "until must be a number from 0 to 1000 s, not -1"},
           {R"([{"spin": [0, 1, 0]}])", "[0]: has no pins"},
           {R"([{"pins": "top_row"}, {"pins": "top_row", "until": 3}])", "[1].until: ends a spin"},
           {R"([{"pins": "top_row"}, {"pins": [[1, 0]], "spin": [0, 1, 0]}])", "[1] pins: none of these particles"},
           {R"([{"pins": "none", "spin": [0, 1, 0]}])", "[0] pins: none of these particles"},
           {R"([{"spn": [0, 1, 0]}])", "did you mean spin"}}) {
    CAPTURE(wrong);
    std::string told;
    try {
      with_settings(Preset(), {"pin_motions=" + wrong});
    } catch (const PresetError& error) {
      told = error.what();
    }
    CHECK_MESSAGE(told.find(why) != std::string::npos, told);
  }
}

TEST_CASE("a file's motion has pins that are pinned; once they are not any longer, none is written") {
  Preset preset = with_settings(Preset(), {R"(pin_motions=[{"pins": "top_row", "spin": [0, 2, 0]}])"});
  const std::string text = preset_to_json(preset);
  CHECK(parse_preset(text, "file") == preset);
  std::string unpinned = text;
  unpinned.replace(unpinned.find("\"top_corners\""), 13, "[[5, 5]]");
  std::string told;
  try {
    parse_preset(unpinned, "file");
  } catch (const PresetError& error) {
    told = error.what();
  }
  CHECK_MESSAGE(told.find("cloth.pin_motions: [0] pins: none of these particles is pinned") != std::string::npos, told);
  preset.pins.mode = Pins::Mode::none;
  CHECK(parse_preset(preset_to_json(preset), "file").pins.motions.empty());
  CHECK(with_settings(Preset(), settings_between(Preset(), preset)).pins.mode == Pins::Mode::none);
}

}  // namespace tyglab::pins_test
