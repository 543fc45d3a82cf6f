// The table of forces (core/forces/force.h): each row agrees with itself, and the plain engine with the fast ones.
#include "core/forces/force.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>

#include "core/engines/plain/plain_cloth.h"
#include "core/forces/linear_springs.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/scenes.h"

namespace tyglab::force_test {

/// Every force on.
Preset everything(int rows, int columns) {
  Preset preset = test::cloth(rows, columns);
  preset.W = {0.003, 0.001, -0.002};
  preset.B = 2 * preset.L * preset.L, preset.twist = 0.7;
  preset.kappa_warp = 8, preset.kappa_weft = -5;
  preset.k_warp = 60, preset.k_shear = 40;
  preset.air_density = 1.2, preset.C_N = 1.3, preset.C_T = 0.2, preset.u = {1, -0.5, 2};
  return preset;
}

class Random {
 public:
  glm::dvec3 vector(double size) { return {size * one(), size * one(), size * one()}; }
  double one() { return 2 * (double(generator_()) / 4294967295.0) - 1; }

 private:
  std::mt19937 generator_{1};
};

Points random_points(Random& random, const Preset& preset, const Stencil& stencil) {
  Points points;
  for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) {
    points.x[n] = preset.L * glm::dvec3(stencil.at[n].dj, -stencil.at[n].di, 0) + random.vector(0.4 * preset.L);
    points.v[n] = random.vector(1);
  }
  return points;
}

ForceAction act(const Preset& preset, const Force& force, const Stencil& stencil, const Points& points) {
  ForceAction action;
  force.act(preset, stencil, points, action);
  return action;
}

TEST_CASE("a force with an energy is minus its gradient; others between particles take energy") {
  Random random;
  const Preset preset = everything(6, 6);
  for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
    CAPTURE(force.symbol);
    for (int trial = 0; trial < 50; ++trial) {
      const Points points = random_points(random, preset, stencil);
      const ForceAction action = act(preset, force, stencil, points);
      glm::dvec3 sum{0};
      double power = 0, size = 1e-9;
      for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) {
        sum += action.F[n], power += glm::dot(action.F[n], points.v[n]), size += glm::length(action.F[n]);
      }
      if (force.group == Force::Group::internal) {
        CHECK(glm::length(sum) <= 1e-12 * size);
        if (!force.conserves) CHECK(power <= 0);
      }
      if (!force.conserves) continue;
      Points before = points, after = points;
      const double h = 1e-7;
      for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
        before.x[n] -= h * points.v[n], after.x[n] += h * points.v[n];
      const double rise =
          (act(preset, force, stencil, after).energy - act(preset, force, stencil, before).energy) / (2 * h);
      CHECK(rise == doctest::Approx(-power).epsilon(1e-4).scale(1e-3));
    }
  });
}

TEST_CASE("a potential's gradient and Hessian are those of its energy, within its stiffness") {
  Random random;
  const Preset preset = everything(6, 6);
  for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
    if (force.potential == nullptr) return;
    CAPTURE(force.symbol);
    const auto energy = [&](double d) { return force.potential(preset, stencil, d * d).energy; };
    for (int trial = 1; trial < 60; ++trial) {
      const double d = 0.07 * trial * preset.L, h = 1e-5 * preset.L;
      if (std::abs(d - stencil.rest * preset.L) < 4 * h) continue;  // where a spring begins to act
      const Potential at = force.potential(preset, stencil, d * d);
      const double slope = (energy(d + h) - energy(d - h)) / (2 * h);
      const double curve = (energy(d + h) - 2 * energy(d) + energy(d - h)) / (h * h);
      const double k = force.stiffness(preset, stencil);
      CHECK(at.factor * d == doctest::Approx(slope).epsilon(1e-6).scale(k * preset.L));
      CHECK(at.factor + at.along * d * d == doctest::Approx(curve).epsilon(1e-3).scale(k));
      CHECK(curve <= k * (1 + 1e-3));
    }
  });
}

TEST_CASE("forces that are linear in positions are those of their springs, torn or not") {
  Random random;
  const Preset preset = everything(9, 8);
  const Lattice lattice = lattice_of(preset);
  Tears tears(lattice);
  LinearSprings<double> springs, anew;
  std::mt19937 choose(2);
  for (int round = 0; round < 30; ++round) {
    if (round > 0)
      for (int n = 0; n < 3; ++n)
        if (const int d = int(choose() % 4), i = int(choose() % 9), j = int(choose() % 8); lattice.has_spring(d, i, j))
          tears.tear(d, i, j);
    if (round == 20) tears = Tears(lattice);  // mended
    CAPTURE(round);
    const int stride = 8;
    springs.follow(preset, tears, stride), anew = {}, anew.follow(preset, tears, stride);
    plain::Vector x(std::size_t(lattice.size()));
    for (glm::dvec3& one : x) one = random.vector(1);
    Preset alone = preset;
    alone.k_s = alone.k_warp = alone.k_shear = alone.k_b = alone.k_d = alone.g = 0, alone.W = glm::dvec3(0);
    alone.air_density = 0, alone.kappa_warp = alone.kappa_weft = 0;
    plain::Vector wanted = plain::forces(alone, tears, x, x);
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j)
        for (int d = 0; d < int(directions.size()); ++d) {
          if (!lattice.has_spring(d, i, j)) continue;
          const double constant = springs.at(d, i, j);
          CHECK(constant == anew.at(d, i, j));
          if (!tears.whole(d, i, j)) CHECK(constant == 0);
          const std::size_t p = std::size_t(i * lattice.columns + j),
                            q = std::size_t((i + directions[std::size_t(d)].di) * lattice.columns + j +
                                            directions[std::size_t(d)].dj);
          wanted[p] -= constant * (x[q] - x[p]), wanted[q] += constant * (x[q] - x[p]);
        }
    for (const glm::dvec3& left : wanted) CHECK(glm::length(left) < 1e-12 * 60);
  }
}

TEST_CASE("implicit methods solve for forces that are linear in positions, and for a rest curvature") {
  // A crumpled cloth that B dominates; the equations of implicit Euler's step by the plain forces.
  for (const double stiffer : {0.0, 1.0, 300.0})
    for (const bool torn : {false, true}) {
      Preset preset = everything(12, 10);
      preset.W = glm::dvec3(0), preset.air_density = 0, preset.k_d = 0, preset.dt = 2e-3,
      preset.integrator = "implicit_euler";
      preset.k_s *= stiffer, preset.k_warp *= stiffer, preset.k_shear *= stiffer, preset.B *= 20,
          preset.iterations = 100, preset.k_b = 0;
      if (stiffer == 0) preset.kappa_warp = preset.kappa_weft = 0;  // which xpbd has as at the start of the step
      const State start = test::crumpled(preset, 3, 0.3, 0.2);
      CAPTURE(stiffer);
      CAPTURE(torn);
      const auto stepped = [&](const char* method, int iterations) {
        Preset other = preset;
        other.integrator = method, other.iterations = iterations;
        Simulation simulation(other);
        test::load(simulation, start);
        if (torn) simulation.apply(edit::Cut{{{5, 4}, {6, 4}}});
        simulation.advance(1);
        const Tears tears = simulation.tears();
        return std::pair(simulation.read(), tears);
      };
      const auto [state, tears] = stepped("implicit_euler", 100);
      plain::Vector x(state.x.x.size()), v(x.size());
      for (std::size_t p = 0; p < x.size(); ++p) x[p] = test::position(state, p), v[p] = test::velocity(state, p);
      const plain::Vector F = plain::forces(preset, tears, x, v);
      const auto pinned = pinned_particles(preset);
      double left = 0, most = 0;
      for (std::size_t p = 0; p < x.size(); ++p) {
        if (pinned[p] != 0) continue;
        const glm::dvec3 change = v[p] - test::velocity(start, p);
        left = std::max(left, glm::length(change - preset.dt / preset.m * F[p]));
        most = std::max(most, glm::length(change));
      }
      CHECK(left < 2e-3 * most);
      // projective_dynamics needs many more passes where springs are stiff, with and without B; and xpbd keeps the
      // directions that springs had when it moved their ends.
      std::vector<const char*> others{"vbd"};
      if (stiffer <= 1) others.push_back("projective_dynamics");
      if (stiffer == 0) others.push_back("xpbd");
      for (const char* method : others) {
        CAPTURE(std::string(method));
        const State other = stepped(method, 1000).first;
        double apart = 0;
        for (std::size_t p = 0; p < x.size(); ++p)
          apart = std::max(apart, glm::distance(test::position(other, p), x[p]));
        CHECK(apart < 2e-3 * most * preset.dt);
      }
    }
}

TEST_CASE("no motion of all particles stiffens a force beyond its largest eigenvalue") {
  Random random;
  const Preset preset = everything(16, 16);
  const Tears whole(lattice_of(preset));
  const std::size_t size = std::size_t(preset.rows) * std::size_t(preset.columns);
  for (const Force* force : force::all) {
    if (force->potential == nullptr) continue;
    CAPTURE(force->symbol);
    // The Hessian's largest eigenvalue with every stencil at its full stiffness along d, by power iteration.
    std::vector<glm::dvec3> u(size), next(size);
    for (glm::dvec3& one : u) one = {random.one(), 0, 0};
    double largest = 0;
    for (int round = 0; round < 400; ++round) {
      std::fill(next.begin(), next.end(), glm::dvec3(0));
      for (const Stencil& stencil : force->stencils(preset))
        for (int i = 0; i < preset.rows; ++i)
          for (int j = 0; j < preset.columns; ++j) {
            if (!stencil.acts(whole, i, j)) continue;
            const auto place = [&](std::size_t n) {
              return std::size_t(i + stencil.at[n].di) * std::size_t(preset.columns) +
                     std::size_t(j + stencil.at[n].dj);
            };
            double d = 0;
            for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) d += stencil.at[n].weight * u[place(n)].x;
            for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
              next[place(n)].x += force->stiffness(preset, stencil) * stencil.at[n].weight * d;
          }
      double norm = 0;
      for (const glm::dvec3& one : next) norm += one.x * one.x;
      largest = std::sqrt(norm);
      for (std::size_t p = 0; p < size; ++p) u[p] = next[p] / largest;
    }
    CHECK(largest <= force->largest_eigenvalue(preset));
    CHECK(largest > 0.9 * force->largest_eigenvalue(preset));
  }
}

TEST_CASE("the plain engine moves as the CPU engine in double, through edits, tears, bodies and the hand") {
  for (const Scheme& method : schemes()) {
    if (!is_written_out(method)) continue;
    CAPTURE(method.name);
    Preset preset = everything(11, 9);
    preset.integrator = method.name, preset.dt = 2e-4, preset.precision = Precision::double_, preset.F_max = 0.2;
    // Euler's motion grows until the last digits decide where it meets a body.
    if (method.name != "euler")
      preset.bodies = {{.shape = Body::Shape::sphere, .c = {0.05, 0.8, 0.01}, .r = 0.06, .friction = 0.3}};
    Simulation fast(preset);
    preset.engine = EngineKind::plain;
    Simulation plain(preset);
    const auto both = [&](const auto& what) { what(fast), what(plain); };
    both([](Simulation& s) { s.advance(60); });
    both([](Simulation& s) { s.apply(edit::Grab{8, 4}), s.apply(edit::MoveHand{{0.02, -0.03, 0.05}, 30}); });
    both([](Simulation& s) { s.advance(40); });
    both([](Simulation& s) {
      Preset next = s.preset();
      next.k_s *= 1.5, next.k_weft = 30, next.W.z += 0.002, next.u.z -= 1, next.dt *= 0.5;
      s.apply(edit::Change{next});
    });
    both([](Simulation& s) { s.advance(40); });
    both([](Simulation& s) { s.apply(edit::Cut{{{3, 3}}}), s.apply(edit::Release{}), s.advance(60); });
    CHECK(fast.tears().torn_count() > 0);
    CHECK(fast.tears().torn_count() == plain.tears().torn_count());
    const State a = fast.read(), b = plain.read();
    double apart = 0, faster = 0;
    for (std::size_t p = 0; p < a.x.x.size(); ++p) {
      apart = std::max(apart, glm::distance(test::position(a, p), test::position(b, p)));
      faster = std::max(faster, glm::distance(test::velocity(a, p), test::velocity(b, p)));
    }
    CHECK(apart < 1e-10);
    CHECK(faster < 1e-7);
    CHECK(fast.divergence().has_value() == plain.divergence().has_value());
  }
}

TEST_CASE("the plain engine goes on from a snapshot to the same bits, and refuses what it cannot run") {
  Preset preset = everything(7, 8);
  preset.engine = EngineKind::plain;
  Simulation plain(preset);
  plain.advance(20);
  const Snapshot then = plain.snapshot();
  plain.advance(20);
  const State after = plain.read();
  plain.restore(then);
  plain.advance(20);
  for (std::size_t p = 0; p < after.x.x.size(); ++p) CHECK(test::position(plain.read(), p) == test::position(after, p));
  preset.integrator = "implicit_euler";
  CHECK_THROWS_AS(Simulation{preset}, EngineError);
}

}  // namespace tyglab::force_test
