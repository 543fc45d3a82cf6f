// One constant with a value of its own: applied without text, and printable.
#include <doctest/doctest.h>

#include "core/io/preset_io.h"
#include "core/lockstep.h"
#include "core/model/difference.h"
#include "tests/support/scenes.h"

namespace tyglab::difference_test {

TEST_CASE("a difference of a row does what --set does, and nothing else") {
  const Preset preset = test::cloth(8, 8);
  for (const PresetRow& row : notation()) {
    if (std::holds_alternative<glm::dvec3 Preset::*>(row.field)) continue;
    if (std::holds_alternative<std::string Preset::*>(row.field)) continue;
    CAPTURE(std::string(row.key));
    const Difference difference(row, row.key == "twist" ? row.min : row.max);  // not its default
    CHECK(difference.key() == row.key);
    Preset changed = preset;
    CHECK(difference.apply(changed));
    CHECK(changed != preset);
    CHECK(changed == with_settings(preset, {difference.text()}));
    CHECK(difference.in(changed) == difference);
    REQUIRE(difference.in(preset).has_value());
    CHECK(difference.in(preset)->apply(changed));
    CHECK(changed == preset);
  }
}

TEST_CASE("a difference of a body is that body's alone, and needs it") {
  Preset preset = test::cloth(8, 8);
  preset.bodies.resize(2);
  for (const BodyRow& row : body_notation()) {
    if (std::holds_alternative<glm::dvec3 Body::*>(row.field)) continue;
    CAPTURE(std::string(row.key));
    preset.bodies[1].shape = row.key == "y" ? Body::Shape::plane : Body::Shape::cylinder;
    const Difference difference(1, row, row.max);
    Preset changed = preset;
    CHECK(difference.apply(changed));
    CHECK(changed == with_settings(preset, {difference.text()}));
    CHECK(changed.bodies[0] == preset.bodies[0]);
    changed.bodies.resize(1);
    CHECK_FALSE(difference.apply(changed));
    CHECK_FALSE(difference.in(changed).has_value());
  }
}

TEST_CASE("differences are read as people write them") {
  CHECK(Difference(&Preset::integrator, "rk4").text() == "integrator=rk4");
  CHECK(Difference(&Preset::engine, EngineKind::opencl).text() == "engine=opencl");
  CHECK(Difference(&Preset::precision, Precision::float_).text() == "precision=float");
  CHECK(Difference(&Preset::W, {0, 0.5, -1}).text() == "W=[0, 0.5, -1]");
  CHECK(Difference(&Preset::iterations, 20).text() == "iterations=20");
  CHECK(Difference(&Preset::dt, 0.1).text() == "dt=0.1");
  CHECK(Difference(0, &Body::c, {1, 2, 3}).text() == "bodies[0].c=[1, 2, 3]");
  CHECK(Difference(*find_row("iterations"), 19.6).text() == "iterations=20");
  CHECK(Difference(&Preset::dt, 1.0 / 3).value_text(2) == "0.33");
}

TEST_CASE("a difference knows which constant it is") {
  const Difference difference(&Preset::k_s, 30);
  REQUIRE(difference.value_of(&Preset::k_s) != nullptr);
  CHECK(*difference.value_of(&Preset::k_s) == 30);
  CHECK(difference.value_of(&Preset::k_b) == nullptr);
  CHECK(difference.value_of(&Preset::integrator) == nullptr);
}

TEST_CASE("the constants of a copy are checked whole, and the device goes along") {
  Preset original = test::cloth(8, 8);
  original.device = 1;
  const auto copied = [&](const Difference& difference) { return copied_preset(original, {&difference, 1}); };
  CHECK(copied({&Preset::k_s, 30}).device == 1);
  CHECK_THROWS_AS(copied({&Preset::integrator, "magic"}), PresetError);
  CHECK_THROWS_WITH_AS(copied({0, &Body::r, 0.1}), "bodies[0].r: there is no such body", PresetError);
}

}  // namespace tyglab::difference_test
