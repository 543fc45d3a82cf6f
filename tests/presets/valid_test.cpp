// Presets that are right: defaults, round trip, the smallest and the largest.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "tests/support/scenes.h"

namespace tyglab::valid_test {

/// The preset of the contract, whose values are the defaults but for `bodies`.
constexpr const char* contract = R"({
  "tyglab_preset": 1, "kind": "cloth",
  "name": "Hanging cloth", "description": "…",
  "cloth": {"rows": 32, "columns": 32, "L": 0.03, "m": 0.0003, "x_0": [0, 1, 0], "v_0": [0, 0, 0], "tilt_deg": 85, "initial_stretch": 1, "pins": "top_corners"},
  "forces": {"k_s": 50, "k_b": 5, "k_d": 0.002, "k": 50, "g": 9.82, "W": [0, 0, 0]},
  "tearing": {"F_max": 0, "F_release": 0},
  "bodies": [{"shape": "sphere", "c": [0, 0.5, 0], "r": 0.2, "friction": 0.3, "restitution": 0}, {"shape": "plane", "y": 0}],
  "solver": {"integrator": "verlet", "dt": 0.001, "engine": "cpu", "precision": "float", "tolerance": 1e-5, "iterations": 10},
  "view": {"mode": 1, "texture": "denim.png"}
})";

/// A preset in which every value differs from its default.
Preset unusual() {
  Preset p;
  p.kind = Kind::one_weight;
  p.name = "Å \"quoted\" \\ name\n\t\x01";
  p.description = "täcke 布 🧵";
  p.rows = 7, p.columns = 9;
  p.L = 0.1 + 0.2;
  p.m = 1.0 / 3;
  p.x_0 = {1e-3, -2.5, 1e3};
  p.v_0 = {-1, 2, -1e-300};
  p.tilt_deg = -359.999;
  p.initial_stretch = 1.1;
  p.pins.mode = Pins::Mode::list;
  p.pins.list = {{0, 0}, {6, 8}, {3, 4}};
  p.offset = -0.25;
  p.k_s = 1e9, p.k_b = 0, p.k_d = 123456.789, p.k = 7, p.g = -100;
  p.W = {0.1, 0.2, 0.3};
  p.F_max = 5e-324;
  p.F_release = 1e9;
  Body sphere, plane;
  sphere.c = {1, 2, 3};
  sphere.r = 0.125;
  sphere.friction = 10;
  sphere.restitution = 1;
  plane.shape = Body::Shape::plane;
  plane.y = -0.75;
  Body box, rod, drum;
  box.shape = Body::Shape::box, box.size = {0.1, 0.25, 3}, box.turn = {10, -20, 360};
  rod.shape = Body::Shape::capsule, rod.length = 1.5, rod.velocity = {0, -2, 0.5}, rod.spin = {1, 2, 3};
  drum.shape = Body::Shape::cylinder, drum.path = {{-1, {0, 1, 2}}, {0.5, {3, 4, 5}}, {0.75, {-6, 0, 1e-3}}};
  plane.turn = {0, 0, 15};
  p.bodies = {sphere, plane, sphere, box, rod, drum};
  p.integrator = "euler";
  p.dt = 1e-7;
  p.engine = EngineKind::opencl;
  p.precision = Precision::double_;
  p.tolerance = 1e-12;
  p.iterations = 1000;
  p.mode = 5;
  p.texture = "my own.png";
  return p;
}

TEST_CASE("the defaults are the contract's") {
  const Preset parsed = parse_preset(contract, "contract.json");
  Preset wanted;
  wanted.name = "Hanging cloth";
  wanted.description = "…";
  Body sphere;
  sphere.c = {0, 0.5, 0};
  sphere.r = 0.2;
  sphere.friction = 0.3;
  Body plane;
  plane.shape = Body::Shape::plane;
  wanted.bodies = {sphere, plane};
  CHECK(parsed == wanted);
  CHECK(parse_preset("{}", "empty.json") == Preset{});
  CHECK(parse_preset("{\"cloth\": {}, \"bodies\": [], \"solver\": {}}", "empty.json") == Preset{});
  CHECK(check_preset(Preset{}) == "");
}

TEST_CASE("what is written is read back, every bit of it") {
  for (const Preset& preset : {Preset{}, unusual(), parse_preset(contract, "")}) {
    REQUIRE(check_preset(preset) == "");
    const std::string text = preset_to_json(preset);
    const Preset again = parse_preset(text, "again.json");
    CHECK(again == preset);
    CHECK(preset_to_json(again) == text);
    CHECK(preset_hash(again) == preset_hash(preset));
  }
}

TEST_CASE("every pins mode, engine and precision survives a round trip") {
  Preset preset;
  using enum Pins::Mode;
  for (const auto mode : {none, top_row, top_corners, four_corners, left_column, boundary, list}) {
    preset.pins.mode = mode;
    CHECK(parse_preset(preset_to_json(preset), "").pins == preset.pins);
  }
}

TEST_CASE("random presets survive a round trip") {
  test::Random random(99);
  for (int n = 0; n < 500; ++n) {
    Preset preset;
    for (const PresetRow& row : notation()) {
      const auto draw = [&] { return random.below(8) == 0 ? row.min : random.uniform(row.min, row.max); };
      if (const auto* field = std::get_if<double Preset::*>(&row.field)) preset.** field = draw();
      if (const auto* field = std::get_if<int Preset::*>(&row.field)) preset.** field = int(draw());
      if (const auto* field = std::get_if<glm::dvec3 Preset::*>(&row.field)) {
        preset.** field = {draw(), draw(), draw()};
      }
    }
    REQUIRE(check_preset(preset) == "");
    CHECK(parse_preset(preset_to_json(preset), "") == preset);
  }
}

TEST_CASE("the hash tells scenes apart, and leaves names alone") {
  const Preset preset;
  Preset renamed = preset;
  renamed.name = "Another";
  renamed.description = "…";
  CHECK(preset_hash(renamed) == preset_hash(preset));
  CHECK(preset_hash(preset).find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(preset_hash(preset).size() == 16);
  for (const char* setting : {"k_s=51", "rows=33", "dt=0.0011", "integrator=euler", "precision=double", "pins=none"}) {
    CHECK(preset_hash(with_settings(preset, {setting})) != preset_hash(preset));
  }
}

TEST_CASE("a byte order mark and Windows line ends do no harm") {
  std::string text = "\xEF\xBB\xBF{\r\n\"cloth\": {\r\n\"rows\": 5}\r\n}\r\n";
  CHECK(parse_preset(text, "windows.json").rows == 5);
}

TEST_CASE("the ends of every range are allowed, and nothing beyond") {
  for (const PresetRow& row : notation()) {
    CAPTURE(std::string(row.key));
    if (std::holds_alternative<std::string Preset::*>(row.field)) continue;
    for (const double end : {row.min, row.max}) {
      Preset preset;
      const double outward = end == row.min ? -1 : 1;
      const auto set = [&](double value) {
        if (const auto* field = std::get_if<double Preset::*>(&row.field)) preset.** field = value;
        if (const auto* field = std::get_if<int Preset::*>(&row.field)) preset.** field = int(value);
        if (const auto* field = std::get_if<glm::dvec3 Preset::*>(&row.field)) preset.** field = {0, value, 0};
      };
      set(end);
      CHECK(check_preset(preset) == "");
      const bool whole = std::holds_alternative<int Preset::*>(row.field);
      set(whole ? end + outward : std::nextafter(end, outward * std::numeric_limits<double>::infinity()));
      const std::string problem = check_preset(preset);
      CHECK(problem.find(row.key) != std::string::npos);
      if (whole) continue;
      for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        set(value);
        CHECK(check_preset(preset) != "");
      }
    }
  }
}

TEST_CASE("the ranges are the contract's") {
  struct Range {
    const char* key;
    double min, max;
  };
  for (const Range& range : {Range{"rows", 2, 4096},
                             {"columns", 1, 4096},
                             {"L", 1e-4, 10},
                             {"m", 1e-9, 1e3},
                             {"k_s", 0, 1e9},
                             {"k_b", 0, 1e9},
                             {"k", 0, 1e9},
                             {"k_d", 0, 1e6},
                             {"g", -100, 100},
                             {"dt", 1e-7, 1},
                             {"F_max", 0, 1e9},
                             {"F_release", 0, 1e9},
                             {"initial_stretch", 0.1, 10},
                             {"tilt_deg", -360, 360},
                             {"W", -1e3, 1e3},
                             {"x_0", -1e3, 1e3},
                             {"v_0", -1e3, 1e3},
                             {"offset", -1e3, 1e3},
                             {"tolerance", 1e-12, 1},
                             {"iterations", 1, 1000},
                             {"mode", 1, 5}}) {
    CAPTURE(std::string(range.key));
    const PresetRow* row = find_row(range.key);
    REQUIRE(row != nullptr);
    CHECK(row->min == range.min);
    CHECK(row->max == range.max);
  }
  for (const Range& range :
       {Range{"c", -1e3, 1e3}, {"r", 1e-3, 100}, {"y", -1e3, 1e3}, {"friction", 0, 10}, {"restitution", 0, 1}}) {
    CAPTURE(std::string(range.key));
    const BodyRow* row = find_body_row(range.key);
    REQUIRE(row != nullptr);
    CHECK(row->min == range.min);
    CHECK(row->max == range.max);
  }
}

}  // namespace tyglab::valid_test
