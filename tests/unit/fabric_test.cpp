// Fabrics as constants of a cloth (core/model/fabric.h).
#include "core/model/fabric.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/forces/force.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"
#include "core/simulation.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace tyglab::fabric_test {

TEST_CASE("a cloth of a fabric is a valid preset of its mass and stiffness, and stays that fabric in a finer cloth") {
  for (const Fabric& fabric : fabrics()) {
    CAPTURE(fabric.key);
    Preset preset = test::cloth(28, 20);
    preset.L = 0.01;
    CHECK_FALSE(is_fabric(preset, fabric));
    const Preset cloth = with_fabric(preset, fabric);
    CHECK(check_preset(cloth).empty());
    CHECK(is_fabric(cloth, fabric));
    CHECK(is_fabric(with_resolution(cloth, 2), fabric));
    for (const Fabric& other : fabrics()) CHECK(is_fabric(cloth, other) == (&other == &fabric));
    CHECK(cloth.m / (cloth.L * cloth.L) / fabric.mass == doctest::Approx(1));
    // Stretched along the rows by 1 % at constant width: half of C times strain² an area, but for the edges.
    const Lattice lattice = lattice_of(cloth);
    const Tears whole(lattice);
    double energy = 0;
    for (const Stencil& stencil : force::stretch.stencils(cloth)) {
      ForceAction action;
      Points points;
      for (std::size_t n = 0; n < 2; ++n)
        points.x[n] = cloth.L * glm::dvec3(1.01 * stencil.at[n].dj, -stencil.at[n].di, 0);
      force::stretch.act(cloth, stencil, points, action);
      energy += action.energy;  // of one particle's springs, an area of L²
    }
    const double C = 2 * energy / (0.01 * 0.01 * cloth.L * cloth.L);
    CHECK(C / fabric.weft == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE(
    "the shipped scene of each fabric is a cloth of it, says what it is, and differs from the others in that alone") {
  const auto scene = [](const Fabric& fabric) {
    return load_preset(std::string(test::source_dir) + "/app/presets/fabric_" + std::string(fabric.key) + ".json");
  };
  const Preset first = scene(fabrics().front());
  for (const Fabric& fabric : fabrics()) {
    CAPTURE(fabric.key);
    const Preset preset = scene(fabric);
    CHECK(is_fabric(preset, fabric));
    CHECK(preset.m / with_fabric(preset, fabric).m == doctest::Approx(1).epsilon(1e-12));
    CHECK(preset.name == fabric.name);
    const double drape = drape_length(preset.B, fabric.mass, preset.g);
    CHECK(preset.description.find("drapes over lengths of " + quantity(1e3 * drape, "mm", 2)) != std::string::npos);
    CHECK(preset.description.starts_with(fabric.measured ? "Measured" : "Estimated"));
    Preset alike = with_fabric(first, fabric);
    alike.name = preset.name, alike.description = preset.description, alike.texture = preset.texture;
    alike.m = preset.m, alike.k_d = preset.k_d;
    alike.integrator = preset.integrator, alike.dt = preset.dt, alike.precision = preset.precision;
    alike.iterations = preset.iterations;
    CHECK(alike == preset);
  }
}

TEST_CASE("drape lengths are those of physics: jeans 27 mm, none without rigidity, no end without weight") {
  CHECK(drape_length(64e-6, 0.324, 9.82) == doctest::Approx(0.0272).epsilon(0.001));
  CHECK(drape_length(0, 0.3, 9.82) == 0);
  CHECK(drape_length(1e-4, 0.3, 0) == std::numeric_limits<double>::infinity());
}

TEST_CASE("each quantity of a fabric is read back as it was set, and leaves the others") {
  Preset preset = with_fabric(Preset(), fabrics()[3]);
  for (const FabricQuantity& quantity : fabric_quantities()) {
    CAPTURE(std::string(quantity.key));
    Preset other = preset;
    const double wanted = 1.25 * quantity.of(preset);
    FabricValues values(fabric_quantities().size());
    values[std::size_t(&quantity - fabric_quantities().data())] = wanted;
    CHECK_FALSE(set_fabric(other, values).has_value());
    CHECK(quantity.of(other) == doctest::Approx(wanted).epsilon(1e-12));
    for (const FabricQuantity& beside : fabric_quantities())
      if (beside.key != quantity.key) CHECK(beside.of(other) == doctest::Approx(beside.of(preset)).epsilon(1e-12));
    CHECK(check_preset(other) == "");
  }
}

TEST_CASE("a file may name a fabric's quantities, in whatever order its sections stand") {
  const Preset preset = parse_preset(
      R"({"tyglab_preset": 1, "fabric": {"weft": 1014, "mass": 324, "B": 64, "shear": 53, "warp": 205, "spacing": 12.5},
          "forces": {"k_b": 0}, "cloth": {"L": 0.5}})",
      "file");
  CHECK(preset.L == doctest::Approx(0.0125));
  CHECK(preset.m == doctest::Approx(0.324 * 0.0125 * 0.0125));
  CHECK(preset.k_warp == doctest::Approx(152));
  CHECK(preset.k_weft == doctest::Approx(961));
  CHECK(preset.k_shear == doctest::Approx(53));
  CHECK(preset.B == doctest::Approx(64e-6));
  CHECK(parse_preset(preset_to_json(preset), "again") == preset);
  for (const auto& [fabric, why] : std::vector<std::pair<std::string, std::string>>{
           {R"({"shear": 50, "warp": 20})", "fabric.warp: must be at least the shear, 50 N/m"},
           {R"({"shear": 500})", "fabric.shear: must be at most the resistance to a stretch, 100 N/m"},
           {R"({"mass": 1e5, "spacing": 1e4, "B": 1e9, "warp": 1e8, "weft": 1e8, "shear": 1e8})",
            "fabric: cloth.m: 10000 is not allowed"},
           {R"({"mass": -1})", "fabric.mass: -1 is not allowed"},
           {R"({"mas": 1})", "fabric.mas: unknown key; did you mean mass"},
           {R"({"B": "stiff"})", "fabric.B: must be a number"}}) {
    CAPTURE(fabric);
    std::string told;
    try {
      parse_preset("{\"tyglab_preset\": 1, \"fabric\": " + fabric + "}", "file");
    } catch (const PresetError& error) {
      told = error.what();
    }
    CHECK_MESSAGE(told.find(why) != std::string::npos, told);
  }
}

}  // namespace tyglab::fabric_test
