// xpbd: the rows of springs in SIMD against plain loops, and the method against implicit Euler, whose step it comes to.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/engines/cpu/projection_rows.h"
#include "core/simd/row_field.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"
#include "tests/support/targets.h"

namespace tyglab::projection_test {

/// Rows of particles as the kernels see them, and the same in plain numbers.
template <class R>
struct Rows {
  explicit Rows(int columns_of, std::uint64_t seed) : columns(columns_of), stride(simd::row_stride<R>(columns_of)) {
    test::Random random(seed);
    for (auto* field : {&x, &q, &lambda, &free, &whole}) {
      field->resize(2, stride);
      const bool weight = field == &free || field == &whole;
      for (int i = 0; i < 2; ++i)
        for (int c = 0; c < 3; ++c)
          for (int j = 0; j < columns; ++j)
            field->row(i, c)[j] = weight ? R(random.below(4) > 0) : R(random.uniform(-1, 1));
    }
    lambda.resize(2, stride);
  }
  glm::dvec3 at(const simd::RowField<R>& field, int i, int j) const {
    return {field.row(i, 0)[j], field.row(i, 1)[j], field.row(i, 2)[j]};
  }
  int columns, stride;
  simd::RowField<R> x, q, lambda, free, whole;
};

/// One step of Gauss-Seidel on a spring, as the papers write it.
struct PlainSpring {
  double rest, compliance;
  bool pushes;
  double lambda = 0;
  glm::dvec3 step(const glm::dvec3& d, double weights) {
    const double length = glm::length(d);
    if (weights == 0) return {};
    double next = lambda - (length - rest + compliance * lambda) / (weights + compliance);
    next = pushes ? std::max(next, 0.0) : std::min(next, 0.0);
    const glm::dvec3 way = (next - lambda) / length * d;
    lambda = next;
    return way;
  }
};

template <class R>
void check_row(int columns, int reach, bool masked, bool pushes) {
  CAPTURE(columns);
  CAPTURE(reach);
  CAPTURE(masked);
  Rows<R> rows(columns, 7);
  const int other = reach == 0 ? 1 : 0;  // row of the far ends
  std::vector<glm::dvec3> q[2];
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < columns; ++j) q[i].push_back(rows.at(rows.q, i, j));
  const auto weight = [&](int i, int j) { return masked ? double(rows.free.row(i)[j]) : 1; };
  for (int j = 0; j < columns; ++j) {
    if (reach != 0 && (j % (2 * reach) >= reach || j + reach >= columns)) continue;
    if (masked && rows.whole.row(0)[j] == 0) continue;
    const int to = j + reach;
    PlainSpring spring{1.1, 0.3, pushes};
    for (int n = 0; n < 2; ++n) {
      const glm::dvec3 d = rows.at(rows.x, other, to) + q[other][to] - rows.at(rows.x, 0, j) - q[0][j];
      const glm::dvec3 way = spring.step(d, weight(0, j) + weight(other, to));
      q[0][j] -= weight(0, j) * way, q[other][to] += weight(other, to) * way;
    }
  }
  cpu::ProjectionRow<R> row;
  row.stride = rows.stride, row.count = columns, row.reach = reach;
  if (masked) row.free_a = rows.free.row(0), row.free_b = rows.free.row(other), row.whole = rows.whole.row(0);
  row.x_a = rows.x.row(0), row.x_b = rows.x.row(other), row.q_a = rows.q.row(0), row.q_b = rows.q.row(other);
  row.lambda = rows.lambda.row(0), row.rest = 1.1, row.pushes = pushes;
  row.soften(0.3);
  cpu::project_row(row), cpu::project_row(row);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < columns; ++j)
      CHECK(glm::length(rows.at(rows.q, i, j) - q[i][j]) < (sizeof(R) == 4 ? 1e-5 : 1e-13));
}

TEST_CASE_TEMPLATE("rows of springs are projected as one by one, with every instruction set", R, float, double) {
  for (const std::int64_t target : test::targets()) {
    const test::OnlyTarget only(target);
    CAPTURE(std::string(hwy::TargetName(target)));
    for (const int columns : {1, 2, 3, 5, 7, 16, 19, 31, 32, 50})
      for (const int reach : {0, 1, 2})
        for (const bool masked : {false, true})
          for (const bool pushes : {false, true}) check_row<R>(columns, reach, masked, pushes);
  }
}

TEST_CASE_TEMPLATE("damping takes its part of the relative velocity and keeps momentum", R, float, double) {
  for (const int columns : {2, 7, 33})
    for (const int reach : {0, 1}) {
      Rows<R> rows(columns, 3);
      const int other = reach == 0 ? 1 : 0;
      const auto sum = [&] {
        glm::dvec3 all(0);
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < columns; ++j) all += rows.at(rows.q, i, j);
        return all;
      };
      const glm::dvec3 before = sum(), apart = rows.at(rows.q, other, reach) - rows.at(rows.q, 0, 0);
      cpu::DampingRow<R> row;
      row.stride = rows.stride, row.count = columns, row.reach = reach;
      row.v_a = rows.q.row(0), row.v_b = rows.q.row(other), row.both = 0.3, row.one = 0.5;
      cpu::damp_row(row);
      CHECK(glm::length(sum() - before) < 1e-5);
      CHECK(glm::length(rows.at(rows.q, other, reach) - rows.at(rows.q, 0, 0) - 0.4 * apart) < 1e-6);
    }
}

double difference(Simulation& a, Simulation& b) {
  double worst = 0;
  for (std::size_t p = 0; p < a.read().x.x.size(); ++p)
    worst = std::max(worst, glm::length(test::position(a.read(), p) - test::position(b.read(), p)));
  return worst;
}

/// How far xpbd's step of dt is from implicit Euler's on a taut lattice without damping.
double step_difference(double dt, int iterations) {
  Preset preset = test::cloth(5, 6, "xpbd");
  preset.initial_stretch = 1.2, preset.pins.mode = Pins::Mode::boundary, preset.tilt_deg = 90;
  preset.k_b = preset.k_d = 0;
  preset.v_0 = {0.1, 0.2, 0.3};
  preset.dt = dt, preset.iterations = iterations;
  Preset other = preset;
  other.integrator = "implicit_euler", other.iterations = 100;
  Simulation simulation(preset), wanted(other);
  simulation.advance(1), wanted.advance(1);
  return difference(simulation, wanted);
}

TEST_CASE("with many iterations xpbd makes implicit Euler's step") {
  for (const double dt : {1e-3, 2e-4}) {
    CAPTURE(dt);
    CHECK(step_difference(dt, 20) < 0.5 * step_difference(dt, 1));
  }
  // What is left is how far springs turn while others wait for their turn: dt⁴.
  const double coarse = step_difference(2e-4, 300), fine = step_difference(1e-4, 300);
  CHECK(std::log2(coarse / fine) > 3.8);
  CHECK(std::log2(coarse / fine) < 4.2);
  CHECK(fine < 3e-8);  // of a way of 4e-5 m
}

TEST_CASE("one weight: implicit Euler's step, to rounding") {
  Preset preset = test::one_weight("xpbd");
  Preset other = preset;
  other.integrator = "implicit_euler";
  Simulation a(preset), b(other);
  a.advance(200), b.advance(200);
  CHECK(a.read().x.y[0] == doctest::Approx(b.read().x.y[0]).epsilon(1e-9));
}

TEST_CASE("xpbd stays bounded at any dt and stiffness, without damping") {
  for (const double k_s : {1e3, 1e9})
    for (const double dt : {1e-3, 1.0 / 30})
      for (const Precision precision : {Precision::float_, Precision::double_}) {
        CAPTURE(k_s);
        CAPTURE(dt);
        Preset preset = test::cloth(10, 10, "xpbd");
        preset.k_s = k_s, preset.k_d = 0, preset.dt = dt, preset.precision = precision;
        Simulation simulation(preset);
        simulation.advance(test::fewer(2000));
        CHECK_FALSE(simulation.divergence().has_value());
      }
}

TEST_CASE("xpbd: tearing and the hand mean the same newtons as with other methods") {
  // Two weights under each other: the spring holds the lower one.
  Preset preset = test::cloth(2, 1, "xpbd");
  preset.tilt_deg = 90, preset.k_b = 0, preset.k_d = 0.05;
  preset.pins.mode = Pins::Mode::list;
  Simulation simulation(preset);
  simulation.apply(edit::Grab{0, 0});
  simulation.advance(20000);
  const double weight = preset.m * preset.g;
  CHECK(simulation.hand_force().y == doctest::Approx(-2 * weight).epsilon(1e-4));
  CHECK(simulation.particle(1, 0)["F_s"].y == doctest::Approx(weight).epsilon(1e-4));
}

}  // namespace tyglab::projection_test
