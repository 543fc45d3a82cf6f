// The read-out forces of table B.1 against the oracle's, and Newton III.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/oracle/oracle.h"
#include "tests/support/scenes.h"

namespace tyglab::forces_test {

Preset windy(int rows, int columns, const std::string& integrator, Precision precision = Precision::double_) {
  Preset preset = test::cloth(rows, columns, integrator);
  preset.W = {0.02, -0.01, 0.03};
  preset.air_density = 1.2, preset.C_N = 1.1, preset.C_T = 0.2, preset.u = {2, 0.3, -4};
  preset.k_weft = 70, preset.k_shear = 9;
  preset.k_d = 0.01;
  preset.precision = precision;
  return preset;
}

void check_forces(const ParticleReadout& got, const oracle::Forces& wanted, double tolerance) {
  CHECK(glm::length(got["F_s"] - wanted.F_s) <= tolerance);
  CHECK(glm::length(got["F_b"] - wanted.F_b) <= tolerance);
  CHECK(glm::length(got["F_d"] - wanted.F_d) <= tolerance);
  CHECK(glm::length(got["F_g"] - wanted.F_g) <= tolerance);
  CHECK(glm::length(got["F_wind"] - wanted.F_wind) <= tolerance);
  CHECK(glm::length(got["F_air"] - wanted.F_air) <= tolerance);
  CHECK(glm::length(got["F_int"] - (wanted.F_s + wanted.F_b + wanted.F_d)) <= tolerance);
  CHECK(glm::length(got["F_ext"] - (wanted.F_g + wanted.F_wind + wanted.F_air)) <= tolerance);
  CHECK(glm::length(got["F"] - wanted.F()) <= tolerance);
}

TEST_CASE("every force on every particle is the oracle's") {
  for (const char* integrator : {"euler", "verlet"}) {
    for (const auto& [rows, columns] : {std::pair{2, 1}, {3, 1}, {2, 2}, {6, 7}}) {
      const Preset preset = windy(rows, columns, integrator);
      const State state = test::crumpled(preset, 11);
      Simulation simulation(preset);
      oracle::Cloth cloth(preset);
      test::load(simulation, state);
      test::load(cloth, state);
      // Read-outs belong to the velocity at x[n]; the oracle's forces use the velocity that the method holds.
      std::vector<oracle::Vec> v;
      for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) v.push_back(cloth.velocity(i, j));
      }
      for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) cloth.at(i, j).v = v[std::size_t(i) * columns + j];
      }
      for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
          CAPTURE(i);
          CAPTURE(j);
          const ParticleReadout got = simulation.particle(i, j);
          check_forces(got, cloth.forces(i, j), 1e-13);
          CHECK(glm::length(got.v - cloth.at(i, j).v) < 1e-12);
          CHECK(glm::length(got.x - cloth.at(i, j).x) == 0);
          CHECK(got.pinned == cloth.at(i, j).pinned);
          if (!got.pinned) CHECK(glm::length(got.a - got["F"] / preset.m) <= 1e-9 * (1 + glm::length(got.a)));
          if (got.pinned) CHECK(got.a == glm::dvec3(0));
        }
      }
    }
  }
}

TEST_CASE("Newton III: the internal forces sum to zero up to rounding") {
  for (const Precision precision : {Precision::double_, Precision::float_}) {
    const Preset preset = windy(11, 13, "euler", precision);
    Simulation simulation(preset);
    test::load(simulation, test::crumpled(preset, 5));
    glm::dvec3 sum(0), sum_s(0), sum_b(0), sum_d(0);
    double size = 0;
    for (int i = 0; i < preset.rows; ++i) {
      for (int j = 0; j < preset.columns; ++j) {
        const ParticleReadout p = simulation.particle(i, j);
        sum += p["F_int"];
        sum_s += p["F_s"];
        sum_b += p["F_b"];
        sum_d += p["F_d"];
        size += glm::length(p["F_s"]) + glm::length(p["F_b"]) + glm::length(p["F_d"]);
      }
    }
    const double rounding = precision == Precision::double_ ? 1e-14 : 1e-6;
    CHECK(size > 10);
    for (const glm::dvec3& s : {sum, sum_s, sum_b, sum_d}) CHECK(glm::length(s) < rounding * size);
  }
}

TEST_CASE("Newton III in motion: without outer forces the momentum stays") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      CAPTURE(std::string(integrator));
      Preset preset = test::cloth(9, 10, integrator);
      preset.g = 0;
      preset.pins.mode = Pins::Mode::none;
      preset.precision = precision;
      preset.k_s = 5;
      Simulation simulation(preset);
      const State state = test::crumpled(preset, 8, 0.4, 1.0);
      test::load(simulation, state);
      const auto momentum = [&](const State& s) {
        glm::dvec3 sum(0);
        for (std::size_t p = 0; p < s.v.x.size(); ++p) sum += test::velocity(s, p);
        return sum;
      };
      const glm::dvec3 before = momentum(state);
      simulation.advance(100);
      const double tolerance = precision == Precision::double_ ? 1e-9 : 2e-2;
      CHECK(glm::length(momentum(simulation.read_raw()) - before) < tolerance);
    }
  }
}

TEST_CASE("sum and maximum over the cloth are those of its particles") {
  const Preset preset = windy(5, 6, "euler");
  Simulation simulation(preset);
  test::load(simulation, test::crumpled(preset, 2));
  double sum_s = 0, sum_d = 0, sum = 0, largest_b = 0, largest_wind = 0, largest = 0;
  for (int i = 0; i < preset.rows; ++i) {
    for (int j = 0; j < preset.columns; ++j) {
      const ParticleReadout p = simulation.particle(i, j);
      sum_s += glm::length(p["F_s"]);
      sum_d += glm::length(p["F_d"]);
      sum += glm::length(p["F"]);
      largest_b = std::max(largest_b, glm::length(p["F_b"]));
      largest_wind = std::max(largest_wind, glm::length(p["F_wind"]));
      largest = std::max(largest, glm::length(p["F"]));
    }
  }
  const ForceSummary sums = simulation.forces(Reduction::sum), maxima = simulation.forces(Reduction::maximum);
  CHECK(sums["F_s"] == doctest::Approx(sum_s).epsilon(1e-12));
  CHECK(sums["F_d"] == doctest::Approx(sum_d).epsilon(1e-12));
  CHECK(sums["F"] == doctest::Approx(sum).epsilon(1e-12));
  CHECK(maxima["F_b"] == doctest::Approx(largest_b).epsilon(1e-12));
  CHECK(maxima["F_wind"] == doctest::Approx(largest_wind).epsilon(1e-12));
  CHECK(maxima["F"] == doctest::Approx(largest).epsilon(1e-12));
}

}  // namespace tyglab::forces_test
