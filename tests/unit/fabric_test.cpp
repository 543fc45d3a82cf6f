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

}  // namespace tyglab::fabric_test
