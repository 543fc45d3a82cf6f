// Linear systems whose matrix no motion changes, against elimination; and damped_verlet, which solves one in each step.
#include "core/engines/cpu/constant_solve.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::constant_solve_test {

using cpu::SpringWeights;

SpringWeights alike(double stretch, double bending) {
  return {{stretch, stretch, stretch, bending}};
}

/// A lattice with tears and fixed particles, and A as a dense matrix over all particles.
struct Scene {
  Scene(int rows, int columns, SpringWeights weights) : tears({rows, columns}) {
    cloth.lattice = {rows, columns};
    test::Random random(11);
    cloth.fixed.assign(std::size_t(rows) * columns, 0);
    for (int n = 0; n < 5; ++n) cloth.fixed[std::size_t(random.below(rows * columns))] = 1;
    for (int n = 0; n < 12; ++n) {
      const int d = random.below(stretch_directions), i = random.below(rows), j = random.below(columns);
      if (cloth.lattice.has_spring(d, i, j)) tears.tear(d, i, j);
    }
    const int count = rows * columns;
    matrix.assign(std::size_t(count), std::vector<double>(std::size_t(count), 0));
    for (int p = 0; p < count; ++p) matrix[std::size_t(p)][std::size_t(p)] = 1;
    for (int d = 0; d < int(directions.size()); ++d)
      for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
          const Direction& to = directions[std::size_t(d)];
          if (!cloth.lattice.has_spring(d, i, j) || !tears.whole(d, i, j)) continue;
          const auto p = std::size_t(i * columns + j), q = std::size_t((i + to.di) * columns + j + to.dj);
          const double weight = weights.springs.of(to);
          matrix[p][p] += weight, matrix[q][q] += weight, matrix[p][q] -= weight, matrix[q][p] -= weight;
        }
  }
  /// Elimination with the largest pivot, for free particles; 0 at fixed ones.
  std::vector<double> eliminate(std::vector<double> r) const {
    auto a = matrix;
    const std::size_t n = r.size();
    for (std::size_t p = 0; p < n; ++p)
      if (cloth.fixed[p] != 0) {
        for (std::size_t q = 0; q < n; ++q) a[p][q] = a[q][p] = 0;
        a[p][p] = 1, r[p] = 0;
      }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t row = k + 1; row < n; ++row) {
        const double factor = a[row][k] / a[k][k];
        for (std::size_t c = k; c < n; ++c) a[row][c] -= factor * a[k][c];
        r[row] -= factor * r[k];
      }
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t c = k + 1; c < n; ++c) r[k] -= a[k][c] * r[c];
      r[k] /= a[k][k];
    }
    return r;
  }
  cpu::Cloth<double> cloth;
  Tears tears;
  std::vector<std::vector<double>> matrix;
};

template <class R>
struct Solved {
  std::vector<double> r, s;  ///< of the y components
  int products;
  double left;
};
template <class R>
Solved<R> solved(const Scene& scene, SpringWeights weights, double tolerance,
                 typename cpu::ConstantSolver<R>::Beyond beyond = cpu::ConstantSolver<R>::Beyond::ends) {
  cpu::Cloth<R> cloth;
  cloth.lattice = scene.cloth.lattice, cloth.fixed = scene.cloth.fixed;
  cloth.stride = cpu::row_stride<R>(cloth.lattice.columns);
  cpu::RowField<R> field;
  field.resize(cloth.lattice.rows, cloth.stride);
  test::Random random(5);
  Solved<R> result;
  for (int i = 0; i < cloth.lattice.rows; ++i)
    for (int j = 0; j < cloth.lattice.columns; ++j) {
      const bool fixed = cloth.fixed[std::size_t(i) * cloth.lattice.columns + j] != 0;
      for (int c = 0; c < 3; ++c) field.row(i, c)[j] = fixed ? R(0) : R(random.uniform(-1, 1));
      result.r.push_back(double(field.row(i, 1)[j]));
    }
  cpu::ConstantSolver<R> solver;
  solver.prepare(cloth, scene.tears, weights, tolerance, true, beyond);
  solver.solve(field, 0, cloth.lattice.rows, [] {});
  for (int i = 0; i < cloth.lattice.rows; ++i)
    for (int j = 0; j < cloth.lattice.columns; ++j) result.s.push_back(double(field.row(i, 1)[j]));
  result.products = solver.products(), result.left = solver.left();
  return result;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, std::abs(a[n] - b[n]));
  return most;
}

TEST_CASE("a solution is that of elimination, with tears, fixed particles and widths of all kinds") {
  for (const auto& [rows, columns] : {std::pair{7, 9}, {5, 16}, {12, 3}, {9, 1}, {2, 17}})
    for (const SpringWeights weights :
         {alike(0.01, 0), alike(3, 0), alike(50, 7), alike(0, 2), SpringWeights{{3, 40, 0.5, 2}}, {{0, 2, 9, 0}}}) {
      CAPTURE(rows);
      CAPTURE(columns);
      CAPTURE(weights.springs.weft);
      CAPTURE(weights.springs.bend);
      const Scene scene(rows, columns, weights);
      const auto fine = solved<double>(scene, weights, 1e-12);
      CHECK(distance(fine.s, scene.eliminate(fine.r)) < 2e-11);
      const auto single = solved<float>(scene, weights, 1e-6);
      CHECK(distance(single.s, scene.eliminate(single.r)) < 1e-5);
    }
}

TEST_CASE("where products do not suffice, a factor finds the solution of elimination") {
  for (const auto& [rows, columns] : {std::pair{7, 9}, {5, 16}, {12, 3}, {9, 1}, {2, 17}})
    for (const SpringWeights weights : {alike(1e5, 0), alike(1e8, 1e4), SpringWeights{{1e5, 1e8, 0, 3}}}) {
      CAPTURE(rows);
      CAPTURE(columns);
      CAPTURE(weights.springs.weft);
      const Scene scene(rows, columns, weights);
      const auto fine = solved<double>(scene, weights, 1e-12, cpu::ConstantSolver<double>::Beyond::factorizes);
      CHECK(fine.products == 0);
      CHECK(distance(fine.s, scene.eliminate(fine.r)) <
            2e-7);  // of pieces that are free but for elimination's rounding
      const auto single = solved<float>(scene, weights, 1e-6, cpu::ConstantSolver<float>::Beyond::factorizes);
      CHECK(single.products == 0);
      CHECK(distance(single.s, scene.eliminate(single.r)) < 1e-6);
    }
}

TEST_CASE("however few products: what is left lies on the side on which a step of damped_verlet stays stable") {
  // r - A s = p(A) r with p the square of a polynomial: no mode is made larger than it is.
  const SpringWeights weights = alike(1e3, 0);
  const Scene scene(7, 9, weights);
  for (const double tolerance : {0.5, 0.1, 1e-3}) {
    CAPTURE(tolerance);
    const auto coarse = solved<double>(scene, weights, tolerance);
    CHECK(coarse.left <= tolerance);
    CHECK(coarse.products > 2);
    double with_rest = 0, rest = 0, size = 0;
    for (std::size_t p = 0; p < coarse.r.size(); ++p) {
      if (scene.cloth.fixed[p] != 0) continue;
      double left = coarse.r[p];
      for (std::size_t q = 0; q < coarse.s.size(); ++q) left -= scene.matrix[p][q] * coarse.s[q];
      with_rest += coarse.r[p] * left, rest += left * left, size += coarse.r[p] * coarse.r[p];
    }
    CHECK(with_rest > 0);
    CHECK(std::sqrt(rest / size) <= coarse.left * (1 + 1e-9));
  }
  const auto stopped = solved<double>(scene, SpringWeights{{1e12, 0, 0, 0}}, 1e-12);
  CHECK(stopped.products == cpu::ConstantSolver<double>::most_products);
  CHECK(stopped.left > 0.99);
}

TEST_CASE("damping does not limit damped_verlet's dt") {
  for (const double zeta : {0.0, 0.3, 1.0, 7.0, 500.0})
    CHECK(stability_limit(scheme("damped_verlet"), zeta) == doctest::Approx(2).epsilon(1e-4));
}

/// A taut sheet whose fastest mode has about that damping ratio, at dt = `part` of the limit 2/ω of its stretch.
Preset taut(double zeta, double part, Precision precision) {
  Preset p = test::cloth(9, 10, "damped_verlet");
  p.initial_stretch = 1.3, p.pins.mode = Pins::Mode::boundary, p.k_b = 0, p.g = 0;
  p.k_d = zeta * any_configuration(p).omega() * p.m / 6;
  p.dt = part * 2 / any_configuration(p).omega();
  p.precision = precision;
  return p;
}

TEST_CASE("a heavily damped sheet comes to rest at nearly twice 1/ω, where Verlet and velocity Verlet diverge" *
          doctest::test_suite("slow")) {
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const double zeta : {0.5, 20.0, 1e6}) {
      if (test::sanitized && zeta != 20) continue;
      CAPTURE(zeta);
      Preset p = taut(zeta, 0.99, precision);
      Simulation calm(p);
      test::load(calm, test::crumpled(p, 3, 0.1, 0));
      const double start = calm.energy().energy.total();
      const int rounds = test::sanitized ? 5 : 40;
      for (int n = 0; n < rounds; ++n) {
        REQUIRE_FALSE(calm.advance(50).diverged);
        CHECK(calm.energy().energy.total() < start);
      }
      for (const char* other : {"verlet", "velocity_verlet"}) {
        p.integrator = other;
        Simulation wild(p);
        test::load(wild, test::crumpled(p, 3, 0.1, 0));
        CHECK(wild.advance(2000).diverged);
      }
    }
}

double lowest(Simulation& simulation) {
  const State state = simulation.read();
  return state.x.y[state.x.y.size() - 1];
}

/// A heavily damped cloth that is cut in two below row 5.
edit::Cut across(const Preset& preset) {
  edit::Cut cut;
  for (int j = 0; j < preset.columns; ++j) cut.sites.push_back({6, j});
  return cut;
}

TEST_CASE("damping however strong is solved where the cloth is small enough to be factorized, pinned or not") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    Preset p = test::cloth(12, 10, "damped_verlet");
    p.k_d = 1e6, p.dt = 1e-3, p.precision = precision;
    const int steps = test::fewer(100, 20);
    const double t = steps * p.dt, fallen = p.g * t * t / 2, close = precision == Precision::double_ ? 1e-9 : 2e-5;
    Preset loose = p;
    loose.pins.mode = Pins::Mode::none;
    Simulation falls(loose), halves(p);
    const double start = lowest(falls);
    halves.apply(across(p));
    for (Simulation* each : {&falls, &halves}) {
      each->advance(steps);
      CHECK(std::abs(start - lowest(*each) - fallen) < close);
      const SolveCounts solves = each->engine().solves();
      CHECK(solves.unconverged == 0);
      CHECK(solves.worst_residual < 1e-6);
      CHECK(solves.linear == 0);  // no products
    }
    // What the pins hold creeps as the damping lets it: its springs and weight act against k_d alone.
    Simulation pinned(p);
    pinned.advance(steps);
    CHECK(pinned.engine().solves().unconverged == 0);
    CHECK(pinned.engine().solves().worst_residual < 1e-6);
  }
}

TEST_CASE("where a factor is too large, an unfinished solve slows no common motion, and is reported" *
          doctest::test_suite("slow")) {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    Preset p = test::cloth(130, 130, "damped_verlet");
    p.k_d = 1e6, p.dt = 1e-3, p.precision = precision;
    const int steps = test::fewer(10, 2);
    const double t = steps * p.dt, fallen = p.g * t * t / 2, close = precision == Precision::double_ ? 1e-9 : 1e-6;
    // Cut in two, its lower part falls as a whole; for the upper one the products do not suffice.
    Simulation halves(p);
    halves.apply(across(p));
    const double start = lowest(halves);
    halves.advance(steps);
    CHECK(std::abs(start - lowest(halves) - fallen) < close);
    const SolveCounts solves = halves.engine().solves();
    CHECK(solves.linear == std::int64_t(steps) * 2 * cpu::ConstantSolver<double>::most_products);
    CHECK(solves.unconverged == steps);
    CHECK(solves.worst_residual > 1e-3);
    CHECK(solves_missed(solves, halves.steps(), p).find("smaller k_d") != std::string::npos);
  }
}

TEST_CASE("beyond 2/ω damped_verlet grows, damped or not") {
  for (const double zeta : {0.0, 0.5}) {
    CAPTURE(zeta);
    Preset p = test::one_weight("damped_verlet");
    p.g = 0, p.m = 1, p.k = 100, p.k_d = 20 * zeta, p.offset = 1e-3, p.dt = 0.2 * 1.01;
    CHECK(Simulation(p).advance(20000).diverged);
    p.dt = 0.2 * 0.99;
    CHECK_FALSE(Simulation(p).advance(20000).diverged);
  }
}

TEST_CASE("without damping damped_verlet goes back the way it came") {
  Preset p = test::cloth(6, 7, "damped_verlet");
  p.k_d = 0, p.initial_stretch = 1.2;
  Simulation simulation(p);
  const State start = simulation.read();
  simulation.advance(300);
  CHECK(glm::length(test::position(simulation.read(), 40) - test::position(start, 40)) > 0.1 * p.L);
  State back = simulation.read();
  for (auto* v : {&back.v.x, &back.v.y, &back.v.z})
    for (double& value : *v) value = -value;
  test::load(simulation, back);
  simulation.advance(300);
  for (std::size_t n = 0; n < start.x.x.size(); ++n)
    CHECK(glm::length(test::position(simulation.read(), n) - test::position(start, n)) < 1e-9);
}

TEST_CASE("the velocity that damped_verlet begins with is the one that is read, and a change of dt keeps it") {
  Preset p = test::cloth(8, 8, "damped_verlet");
  p.k_d = 0.2;
  Simulation simulation(p);
  State state = test::crumpled(p, 9);
  const auto same = [&] {
    for (std::size_t n = 0; n < state.v.x.size(); ++n)
      if (!simulation.pinned(int(n) / 8, int(n) % 8))
        CHECK(glm::length(test::velocity(simulation.read(), n) - test::velocity(state, n)) < 1e-9);
  };
  test::load(simulation, state);
  same();
  simulation.advance(3);
  state = simulation.read();
  p.dt *= 0.3;
  simulation.apply(edit::Change{p});
  same();
}

}  // namespace tyglab::constant_solve_test
