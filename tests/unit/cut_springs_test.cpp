// A cut of a list of springs: which go, what is left of the model's laws, copies.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/lockstep.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::cut_springs_test {

const edit::CutSprings slanting{{{0, 2, 2}, {1, 3, 3}, {2, 3, 3}, {3, 4, 5}, {1, 4, 4}}};

int torn(const Simulation& simulation) {
  return simulation.tears().torn_count();
}

TEST_CASE("a cut of springs takes those, the bending springs over them, and no other") {
  Simulation simulation(test::cloth(8, 9));
  simulation.apply(slanting);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 9; ++j)
      for (int d = 0; d < stretch_directions; ++d) {
        const bool cut =
            std::find(slanting.springs.begin(), slanting.springs.end(), SpringSite{d, i, j}) != slanting.springs.end();
        CHECK(simulation.tears().whole(d, i, j) != cut);
      }
  CHECK_FALSE(simulation.tears().whole(4, 2, 2));
  CHECK_FALSE(simulation.tears().whole(4, 2, 1));
  CHECK(simulation.tears().whole(4, 2, 3));
  CHECK_FALSE(simulation.tears().whole(5, 2, 3));  // over (3, 3)-(4, 3)
  CHECK(torn(simulation) == 5);
  simulation.apply(slanting);
  CHECK(torn(simulation) == 5);  // what is cut is cut
}

TEST_CASE("springs that are none are passed over") {
  Simulation simulation(test::cloth(5, 5));
  simulation.apply(
      edit::CutSprings{{{0, 0, 4}, {1, 4, 0}, {3, 2, 0}, {4, 2, 2}, {-1, 2, 2}, {7, 1, 1}, {0, -1, 2}, {1, 9, 9}}});
  CHECK(torn(simulation) == 0);
  CHECK(simulation.tears().untorn());
}

TEST_CASE("after a cut internal forces still sum to zero") {
  for (const char* integrator : {"verlet", "rk4", "implicit_euler"}) {
    Preset preset = test::quiet_cloth(8, 9, integrator);
    preset.k_b = 5, preset.k_d = 0.002;
    Simulation simulation(preset);
    test::load(simulation, test::crumpled(preset, 7));
    simulation.apply(slanting);
    glm::dvec3 sum(0);
    double largest = 0;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 9; ++j) {
        const glm::dvec3 F = simulation.particle(i, j)["F_int"];
        sum += F, largest = std::max(largest, glm::length(F));
      }
    CHECK(glm::length(sum) < 1e-12 * largest * 72);
  }
}

TEST_CASE("copies take a cut of springs to the same bits, in mid-run") {
  Preset preset = test::cloth(9, 8);
  preset.precision = Precision::float_;
  Simulation original(preset);
  Lockstep copies;
  original.advance(40);
  copies.add(original, {});
  copies.add(original, {{&Preset::integrator, "rk4"}});
  original.advance(20), copies.follow(original.time());
  original.apply(slanting);
  CHECK(copies.apply(original, slanting).empty());
  original.advance(60), copies.follow(original.time());
  CHECK(test::identical(original.read_raw(), copies[0].simulation->read_raw()));
  CHECK(torn(*copies[1].simulation) == torn(original));
}

TEST_CASE("the OpenCL engine takes a cut of springs as the CPU engine does") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(20, 24);
  Simulation cpu(preset);
  preset.engine = EngineKind::opencl;
  Simulation device(preset);
  for (Simulation* simulation : {&cpu, &device}) {
    simulation->advance(30);
    simulation->apply(slanting);
    simulation->advance(60);
  }
  CHECK(torn(device) == torn(cpu));
  const State &a = cpu.read(), &b = device.read();
  for (std::size_t p = 0; p < a.x.x.size(); ++p) CHECK(glm::length(test::position(a, p) - test::position(b, p)) < 1e-9);
}

TEST_CASE("a copy keeps its seat when one before it goes, and a new one takes the free seat") {
  Simulation original(test::cloth(5, 5));
  Lockstep copies;
  for (const double k_s : {60, 70, 80}) copies.add(original, {{&Preset::k_s, k_s}});
  copies.remove(0);
  CHECK(copies[0].seat == 1);
  CHECK(copies[1].seat == 2);
  copies.add(original, {{&Preset::k_s, 90}});
  CHECK(copies[2].seat == 0);
}

}  // namespace tyglab::cut_springs_test
