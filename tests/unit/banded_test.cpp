// The direct way through an implicit step's linear systems.
#include "core/engines/banded.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/simulation.h"
#include "tests/support/scenes.h"

namespace tyglab::banded_test {

TEST_CASE("a banded system is solved to rounding, at the ends of the matrix too") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const auto& [size, band] : {std::pair{1, 4}, {3, 2}, {40, 7}, {97, 31}, {30, 64}}) {
    CAPTURE(size);
    CAPTURE(band);
    std::vector<double> full(std::size_t(size) * size, 0), x(size), b(size, 0);
    const auto at = [&](int r, int c) -> double& { return full[std::size_t(r) * size + c]; };
    BandedCholesky matrix;
    matrix.begin(size, band);
    for (int r = 0; r < size; ++r)
      for (int c = std::max(0, r - band); c <= r; ++c) {
        at(r, c) = at(c, r) = matrix.at(r, c) = r == c ? 2.0 * (band + 1) : any(random);
      }
    for (double& value : x) value = any(random);
    for (int r = 0; r < size; ++r)
      for (int c = 0; c < size; ++c) b[r] += at(r, c) * x[c];
    std::vector<std::array<double, 4>> four;
    for (const double value : b) four.push_back({value, 0, -2 * value, 3 * value});
    REQUIRE(matrix.factor());
    matrix.solve(b), matrix.solve(four);
    double error = 0;
    for (int r = 0; r < size; ++r) {
      const std::array<double, 4> wanted{x[r], 0, -2 * x[r], 3 * x[r]};
      error = std::max(error, std::abs(b[r] - x[r]));
      for (std::size_t n = 0; n < 4; ++n) error = std::max(error, std::abs(four[std::size_t(r)][n] - wanted[n]));
    }
    CHECK(error < 1e-12);
  }
}

TEST_CASE("a matrix that is not positive definite is refused") {
  BandedCholesky matrix;
  matrix.begin(2, 1);
  matrix.at(0, 0) = 1, matrix.at(1, 0) = 2, matrix.at(1, 1) = 1;
  CHECK_FALSE(matrix.factor());
}

TEST_CASE("linear systems that conjugate gradients do not solve are solved directly") {
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const auto& [rows, columns] : {std::pair{24, 9}, {9, 24}}) {
      CAPTURE(rows);
      Preset preset = test::cloth(rows, columns, "implicit_euler");
      preset.k_s = 1e8, preset.k_b = 1e5, preset.dt = 1.0 / 60, preset.precision = precision;
      preset.iterations = 1;  // each step is one linear system
      preset.pins.mode = Pins::Mode::top_row;
      Simulation simulation(preset);
      simulation.advance(1);
      CHECK(simulation.engine().solves().linear > 0);  // they were tried
      // As far as one linear system leads, whose springs then switch: 2 to 4 times the largest force.
      CHECK(simulation.engine().solves().worst_residual < 10);
    }
}

TEST_CASE("what is solved directly is what conjugate gradients solve, where both can") {
  // Just stiff enough for the gradients to fail once; the same step in a cloth too wide for a factorisation to pay
  // would be theirs, so the answer is held against the equations themselves: Newton's method ends.
  Preset preset = test::cloth(12, 12, "implicit_euler");
  preset.k_s = 1e6, preset.dt = 1.0 / 60, preset.precision = Precision::double_;
  preset.initial_stretch = 1.05, preset.pins.mode = Pins::Mode::boundary, preset.iterations = 50;
  Simulation simulation(preset);
  simulation.advance(10);
  CHECK(simulation.engine().solves().unconverged == 0);
}

}  // namespace tyglab::banded_test
