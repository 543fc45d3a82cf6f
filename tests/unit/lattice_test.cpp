// Lattice, triangles, start, pins.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "tests/support/scenes.h"

namespace tyglab::lattice_test {

TEST_CASE("the six directions are half of eight neighbors and four bending springs, each once") {
  std::set<std::pair<int, int>> seen;
  for (int d = 0; d < int(directions.size()); ++d) {
    const Direction& direction = directions[d];
    CHECK(direction.bending == (d >= stretch_directions));
    CHECK(direction.rest == doctest::Approx(std::hypot(direction.di, direction.dj)).epsilon(1e-16));
    CHECK(seen.insert({direction.di, direction.dj}).second);
    CHECK(seen.insert({-direction.di, -direction.dj}).second);
  }
  CHECK(seen.size() == 12);
}

TEST_CASE("an R x C lattice has the springs it should") {
  for (const Lattice lattice : {Lattice{2, 1}, Lattice{3, 1}, Lattice{2, 2}, Lattice{7, 5}, Lattice{17, 23}}) {
    int count[6] = {};
    for (int d = 0; d < 6; ++d) {
      for (int i = 0; i < lattice.rows; ++i) {
        for (int j = 0; j < lattice.columns; ++j) count[d] += lattice.has_spring(d, i, j) ? 1 : 0;
      }
    }
    const int R = lattice.rows, C = lattice.columns;
    CHECK(count[0] == R * (C - 1));
    CHECK(count[1] == (R - 1) * C);
    CHECK(count[2] == (R - 1) * (C - 1));
    CHECK(count[3] == (R - 1) * (C - 1));
    CHECK(count[4] == R * std::max(0, C - 2));
    CHECK(count[5] == std::max(0, R - 2) * C);
  }
}

TEST_CASE("triangles lie in the diamond pattern and face the front") {
  const auto at = [](Corner c) { return glm::dvec3(c.dj, -c.di, 0); };
  // Down × right, the front, is (0, -1, 0) × (1, 0, 0) = (0, 0, 1).
  for (int odd = 0; odd < 2; ++odd) {
    double area = 0;
    for (const auto& triangle : quad_triangles[odd]) {
      const glm::dvec3 N = glm::cross(at(triangle[1]) - at(triangle[0]), at(triangle[2]) - at(triangle[0]));
      CHECK(N.z > 0);
      area += N.z / 2;
      const auto has = [&](int di, int dj) {
        for (const Corner& c : triangle) {
          if (c.di == di && c.dj == dj) return true;
        }
        return false;
      };
      // Both triangles share the diagonal.
      if (odd == 0) CHECK((has(0, 0) && has(1, 1)));
      if (odd == 1) CHECK((has(0, 1) && has(1, 0)));
    }
    CHECK(area == 1);
  }
}

TEST_CASE("the start is where the model puts it") {
  Preset preset;
  preset.rows = 4;
  preset.columns = 3;
  preset.L = 0.1;
  preset.initial_stretch = 1.5;
  preset.x_0 = {1, 2, 3};
  preset.v_0 = {4, 5, 6};
  preset.tilt_deg = 30;
  preset.pins.mode = Pins::Mode::top_row;
  const State state = start_state(preset);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const glm::dvec3 wanted = glm::dvec3(1 + (j - 1) * 0.15, 2 - i * 0.15 * 0.5, 3 + i * 0.15 * std::sqrt(0.75));
      CHECK(glm::length(test::position(state, i * 3 + j) - wanted) < 1e-14);
      CHECK(test::velocity(state, i * 3 + j) == (i == 0 ? glm::dvec3(0) : preset.v_0));
    }
  }
}

TEST_CASE("sine and cosine of the tilt are exact at multiples of 90 degrees") {
  Preset preset;
  preset.rows = 3;
  preset.columns = 1;
  preset.L = 1;
  preset.x_0 = {0, 0, 0};
  const auto bottom = [&](double tilt) {
    preset.tilt_deg = tilt;
    return test::position(start_state(preset), 2);
  };
  for (const double turn : {-360.0, 0.0}) {
    CHECK(bottom(turn + 0) == glm::dvec3(0, 0, 2));
    CHECK(bottom(turn + 90) == glm::dvec3(0, -2, 0));
    CHECK(bottom(turn + 180) == glm::dvec3(0, 0, -2));
    CHECK(bottom(turn + 270) == glm::dvec3(0, 2, 0));
  }
  CHECK(bottom(360) == glm::dvec3(0, 0, 2));
}

TEST_CASE("each kind of pins pins what its name says") {
  Preset preset;
  preset.rows = 4;
  preset.columns = 5;
  const auto pinned = [&](Pins::Mode mode) {
    preset.pins.mode = mode;
    std::string picture;
    for (const auto one : pinned_particles(preset)) picture += one != 0 ? '#' : '.';
    return picture;
  };
  CHECK(pinned(Pins::Mode::none) == "....................");
  CHECK(pinned(Pins::Mode::top_row) == "#####...............");
  CHECK(pinned(Pins::Mode::top_corners) == "#...#...............");
  CHECK(pinned(Pins::Mode::four_corners) == "#...#..........#...#");
  CHECK(pinned(Pins::Mode::left_column) == "#....#....#....#....");
  CHECK(pinned(Pins::Mode::boundary) == "######...##...######");
  preset.pins.list = {{1, 2}, {3, 4}, {1, 2}};
  CHECK(pinned(Pins::Mode::list) == ".......#...........#");
}

TEST_CASE("a pinned particle never moves") {
  Preset preset = test::cloth(6, 6);
  preset.W = {0, 0, 0.01};
  preset.pins.mode = Pins::Mode::list;
  preset.pins.list = {{2, 3}, {5, 5}};
  preset.v_0 = {1, 1, 1};
  Simulation simulation(preset);
  const State start = start_state(preset);
  simulation.advance(300);
  for (const std::size_t p : {std::size_t(15), std::size_t(35)}) {
    CHECK(test::position(simulation.read(), p) == test::position(start, p));
    CHECK(test::velocity(simulation.read(), p) == glm::dvec3(0));
    CHECK(test::velocity(simulation.read_raw(), p) == glm::dvec3(0));
  }
}

TEST_CASE("a torn stretch spring takes the bending springs over it along, and its triangles") {
  Tears tears(Lattice{5, 5});
  CHECK(tears.untorn());
  CHECK(tears.row(0) == nullptr);
  CHECK(tears.tear(0, 2, 2));  // (2,2)-(2,3)
  CHECK_FALSE(tears.tear(0, 2, 2));
  CHECK(tears.torn_count() == 1);
  CHECK_FALSE(tears.whole(0, 2, 2));
  for (int j = 0; j < 3; ++j) CHECK(tears.whole(4, 2, j) == (j == 0));  // (2,1)-(2,3) and (2,2)-(2,4) die
  for (int i = 0; i < 3; ++i) CHECK(tears.whole(5, i, 2));
  CHECK(tears.tear(1, 1, 4));  // (1,4)-(2,4)
  for (int i = 0; i < 3; ++i) CHECK(tears.whole(5, i, 4) == (i == 2));
  CHECK(tears.tear(2, 3, 3));  // a diagonal has no bending springs over it
  for (int i = 0; i < 5; ++i) CHECK(tears.whole(4, i, 0));
  CHECK(tears.torn_count() == 3);
}

TEST_CASE("a triangle is whole while its three edge springs are") {
  for (int qi = 0; qi < 2; ++qi) {
    for (int which = 0; which < 2; ++which) {
      for (int direction = 0; direction < stretch_directions; ++direction) {
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 2; ++j) {
            const Lattice lattice{3, 2};
            if (!lattice.has_spring(direction, i, j)) continue;
            Tears tears(lattice);
            tears.tear(direction, i, j);
            // Whether both ends of the torn spring are corners of the triangle.
            int corners = 0;
            for (const Corner& c : quad_triangles[qi % 2][which]) {
              const int ci = qi + c.di, cj = c.dj;
              corners +=
                  (ci == i && cj == j) || (ci == i + directions[direction].di && cj == j + directions[direction].dj)
                      ? 1
                      : 0;
            }
            CHECK(tears.triangle_whole(qi, 0, which) == (corners < 2));
          }
        }
      }
    }
  }
}

}  // namespace tyglab::lattice_test
