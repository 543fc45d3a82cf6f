// A cloth that parts (core/forces/parted.h): what a split keeps, what hangs together afterward, and engines against
// each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/contact/crossings.h"
#include "core/engines/plain/plain_cloth.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/output/obj.h"
#include "core/output/state_csv.h"
#include "core/simulation.h"
#include "core/step_trace.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::parted_test {

using test::Random;
using Vectors = std::vector<glm::dvec3>;

/// A sheet with every force that a cloth which parts can have.
Preset sheet(int rows, int columns) {
  Preset p = test::cloth(rows, columns);
  p.tearing = "split";
  p.k_s = 60, p.k_b = 4, p.k_d = 0.003, p.B = 1e-6, p.W = {0.02, 0.01, -0.03};
  p.air_density = 1.2, p.C_T = 0.3, p.u = {1, 0, -2};
  p.dt = 2e-4;
  return p;
}

Vectors vectors(const VectorField<double>& field) {
  Vectors all;
  for (std::size_t n = 0; n < field.x.size(); ++n) all.emplace_back(field.x[n], field.y[n], field.z[n]);
  return all;
}

/// A mesh with random openings, and where its particles are if no copy has moved yet.
struct Parted {
  Tears tears;
  Vectors x, v;
};
Parted randomly_parted(const Preset& p, int openings, std::uint64_t seed, const Vectors& x, const Vectors& v) {
  Random random(seed);
  auto mesh = std::make_shared<Mesh>(lattice_of(p));
  for (int n = 0; n < openings; ++n) {
    const int particle = random.below(mesh->particles());
    const unsigned all = mesh->cells_of(particle), some = all & unsigned(random.below(16));
    if (some != 0 && some != all) mesh->part(particle, some);
  }
  Lattice lattice = lattice_of(p);
  while (lattice.size() < mesh->particles()) ++lattice.rows, ++lattice.copy_rows;
  Parted parted{Tears(lattice, mesh), Vectors(std::size_t(lattice.size())), Vectors(std::size_t(lattice.size()))};
  for (int n = 0; n < mesh->particles(); ++n)
    parted.x[std::size_t(n)] = x[std::size_t(mesh->site(n))], parted.v[std::size_t(n)] = v[std::size_t(mesh->site(n))];
  return parted;
}

TEST_CASE("to part particles divides their cells and their mass, and loses neither") {
  const Lattice sites{5, 6};
  Mesh mesh(sites);
  Random random(4);
  for (int n = 0; n < 4000; ++n) {
    const int particle = random.below(mesh.particles());
    const unsigned all = mesh.cells_of(particle), some = all & unsigned(random.below(16));
    if (some == 0 || some == all) continue;
    const double share = mesh.share(particle);
    const int copy = mesh.part(particle, some);
    CHECK(mesh.cells_of(copy) == some);
    CHECK(mesh.cells_of(particle) == (all & ~some));
    CHECK(mesh.site(copy) == mesh.site(particle));
    CHECK(std::abs(mesh.share(copy) + mesh.share(particle) - share) < 1e-15);
  }
  // Each corner of each cell hangs on a particle of its site, and each particle has a cell.
  std::set<int> held;
  for (int i = 0; i + 1 < sites.rows; ++i)
    for (int j = 0; j + 1 < sites.columns; ++j)
      for (const Corner at : {Corner{0, 0}, Corner{0, 1}, Corner{1, 0}, Corner{1, 1}}) {
        const int particle = mesh.corner(i, j, at);
        CHECK(mesh.site(particle) == (i + at.di) * sites.columns + j + at.dj);
        held.insert(particle);
      }
  CHECK(int(held.size()) == mesh.particles());
  // All that can part has: a cell at each corner.
  CHECK(mesh.particles() == 4 * (sites.rows - 1) * (sites.columns - 1));
}

TEST_CASE(
    "before copies move, all forces of a parted cloth add up to those of the whole one, but for bending over cuts") {
  const Preset p = sheet(7, 8);
  const State state = test::crumpled(p, 5);
  const Vectors x = vectors(state.x), v = vectors(state.v);
  const Tears whole(lattice_of(p));
  for (const int openings : {1, 3, 12, 60, 400}) {
    const Parted parted = randomly_parted(p, openings, std::uint64_t(openings), x, v);
    for (const Force* force : force::all) {
      if (!force->on(p)) continue;
      const bool bends = force == &force::bend || force == &force::rigidity;
      Vectors expected(x.size(), glm::dvec3(0)), found = expected;
      double energy = 0, energy_parted = 0;
      for (const Stencil& stencil : force->stencils(p)) {
        const auto place = [&](int i, int j) { return std::size_t(i * p.columns + j); };
        for (int i = 0; i < p.rows; ++i)
          for (int j = 0; j < p.columns; ++j)
            for (const bool is_parted : {false, true}) {
              const Tears& tears = is_parted ? parted.tears : whole;
              if (!stencil.acts(tears, i, j)) continue;
              const Points points = points_of(
                  stencil, i, j, [&](int pi, int pj) { return x[place(pi, pj)]; },
                  [&](int pi, int pj) { return v[place(pi, pj)]; });
              ForceAction action;
              force->act(p, stencil, points, action);
              (is_parted ? energy_parted : energy) += action.energy;
              for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
                (is_parted ? found : expected)[place(i + stencil.at[n].di, j + stencil.at[n].dj)] += action.F[n];
            }
      }
      for (const LooseStencil& loose : loose_stencils(p, parted.tears)) {
        if (loose.force != force) continue;
        const ForceAction action = action_of(
            p, loose, [&](int n) { return parted.x[std::size_t(n)]; }, [&](int n) { return parted.v[std::size_t(n)]; });
        energy_parted += action.energy;
        for (std::size_t n = 0; n < std::size_t(loose.stencil->points); ++n)
          found[std::size_t(parted.tears.mesh()->site(loose.at[n]))] += action.F[n];
      }
      double largest = 0, difference = 0;
      for (std::size_t n = 0; n < x.size(); ++n) {
        largest = std::max(largest, glm::length(expected[n]));
        difference = std::max(difference, glm::distance(found[n], expected[n]));
      }
      CAPTURE(force->name);
      CAPTURE(openings);
      if (!bends) CHECK(difference < 1e-13 * largest);
      if (!bends) CHECK(std::abs(energy_parted - energy) <= 1e-13 * std::abs(energy));
      if (bends) CHECK(energy_parted <= energy * (1 + 1e-13));
      if (bends && openings == 400) CHECK(energy_parted < 0.5 * energy);
    }
  }
}

TEST_CASE("a bending spring lies over a cut with no half, beside one with one, elsewhere with both") {
  Preset p = sheet(5, 7);
  auto mesh = std::make_shared<Mesh>(lattice_of(p));
  mesh->part(2 * 7 + 3, Mesh::up_right | Mesh::down_right);  // down through the middle of row 2
  const Tears tears({6, 7, 1}, mesh);
  double over = 0, beside = 0;
  for (const LooseStencil& loose : loose_stencils(p, tears)) {
    if (loose.force != &force::bend) continue;
    const auto is = [&](int a, int b) { return mesh->site(loose.at[0]) == a && mesh->site(loose.at[1]) == b; };
    if (is(2 * 7 + 2, 2 * 7 + 4)) over += loose.weight;
    if (is(2 * 7 + 1, 2 * 7 + 3)) beside += loose.weight;
  }
  CHECK(over == 0);
  CHECK(beside == 1);
}

TEST_CASE("the CPU engine moves a parted cloth as the plain one does, the same with any threads") {
  for (const char* method : {"verlet", "rk4", "velocity_verlet", "euler", "dopri5"})
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      Preset p = sheet(40, 48);
      p.integrator = method, p.precision = precision, p.F_max = 0.35, p.v_0 = {0, 0, 2};
      p.dt = std::string(method) == "euler" ? 2e-5 : 2e-4;
      Preset other = p;
      other.engine = std::string(method) == "dopri5" ? EngineKind::cpu : EngineKind::plain;
      Simulation fast(p, 1), threads(p, 2), plain(other, 1);
      for (Simulation* one : {&fast, &threads, &plain})
        one->apply(edit::CutSprings{{{0, 20, 10}, {0, 21, 10}, {1, 30, 30}}});
      for (Simulation* one : {&fast, &threads, &plain}) one->advance(precision == Precision::double_ ? 250 : 100);
      CAPTURE(std::string(method));
      CHECK(fast.tears().particles() > 40 * 48);
      CHECK(fast.tears() == threads.tears());
      CHECK(test::identical(fast.read(), threads.read()));
      if (precision == Precision::float_) continue;
      CHECK(fast.tears() == plain.tears());
      double apart = 0;
      const Vectors a = vectors(fast.read().x), b = vectors(plain.read().x);
      REQUIRE(a.size() == b.size());
      for (std::size_t n = 0; n < a.size(); ++n) apart = std::max(apart, glm::distance(a[n], b[n]));
      CHECK(apart < 1e-9);
    }
}

TEST_CASE("implicit methods find the motion of a parted cloth, each with its order, in both precisions") {
  Preset p = sheet(9, 11);
  p.k_b = 0, p.air_density = 0;  // a bending spring that begins to push would end the order
  p.initial_stretch = 1.1, p.B = 1e-5;
  const double seconds = 0.02;
  const auto moved = [&](const char* method, int steps, Precision precision = Precision::double_) {
    Preset scene = p;
    scene.integrator = method, scene.dt = seconds / steps, scene.precision = precision;
    Simulation simulation(scene, 1);
    simulation.apply(edit::Cut{{{3, 2}, {3, 3}, {3, 4}, {3, 5}, {4, 5}, {5, 5}}});
    CHECK(simulation.tears().particles() > 9 * 11 + 4);
    simulation.advance(steps);
    CHECK(simulation.engine().solves().unconverged == 0);
    return vectors(simulation.read().x);
  };
  const Vectors exact = moved("rk4", 2000);
  const auto error = [&](const Vectors& x) {
    double sum = 0;
    for (std::size_t n = 0; n < x.size(); ++n) sum += glm::dot(x[n] - exact[n], x[n] - exact[n]);
    return std::sqrt(sum / double(x.size()));
  };
  for (const auto& [method, order] :
       {std::pair("implicit_euler", 1.0), std::pair("implicit_midpoint", 2.0), std::pair("tr_bdf2", 2.0)}) {
    CAPTURE(std::string(method));
    const double coarse = error(moved(method, 80)), fine = error(moved(method, 160));
    CHECK(coarse < 5e-3);
    CHECK(std::log2(coarse / fine) > order - 0.2);
    CHECK(std::log2(coarse / fine) < order + 0.4);
    CHECK(error(moved(method, 160, Precision::float_)) < 2 * fine + 1e-5);
  }
}

TEST_CASE("implicit methods keep the momentum of a sheet that tears in flight, and let a piece fall as a piece") {
  for (const char* method : {"implicit_euler", "implicit_midpoint", "tr_bdf2"}) {
    Preset p = test::quiet_cloth(12, 12);
    p.tearing = "split", p.k_s = 50, p.dt = 1e-3, p.F_max = 0.3, p.integrator = method, p.k_d = 0.002;
    Simulation simulation(p, 1);
    simulation.load(test::crumpled(p, 8, 0.1, 6));
    const auto momentum = [&] {
      glm::dvec3 sum{0};
      for (int n = 0; n < simulation.tears().particles(); ++n)
        sum += p.m * simulation.tears().share(n) * test::velocity(simulation.read(), std::size_t(n));
      return sum;
    };
    const glm::dvec3 before = momentum();
    simulation.advance(100);
    CAPTURE(std::string(method));
    CHECK(simulation.tears().particles() > 12 * 12 + 20);
    // Up to the tolerance of the solves.
    CHECK(glm::distance(momentum(), before) < 1e-7 * glm::length(before) + 1e-9);
  }
}

/// A sheet that is thrown together after it has been cut in several places.
std::unique_ptr<Simulation> thrown_together(Preset p, int threads = 1) {
  p.tearing = "split", p.k_s = 60, p.k_d = 2e-4, p.L = 0.02, p.m = 2e-4, p.g = 0;
  auto thrown = std::make_unique<Simulation>(p, threads);
  Simulation& simulation = *thrown;
  for (int j : {3, 7}) simulation.apply(edit::Cut{{{2, j}, {3, j}, {4, j}, {5, j}, {6, j}, {7, j}, {8, j}}});
  State state = simulation.read();
  Random random(5);
  for (int n = 0; n < simulation.tears().particles(); ++n) {
    const auto at = std::size_t(n);
    state.v.x[at] = random.uniform(-3, 3) - 20 * (state.x.x[at] - 0.12);
    state.v.y[at] = random.uniform(-3, 3) - 20 * (state.x.y[at] - p.x_0.y);
    state.v.z[at] = random.uniform(-3, 3);
  }
  simulation.load(state);
  return thrown;
}

TEST_CASE("with the guard a cloth that has parted meets itself, and crosses nowhere but around its cuts") {
  for (const Scheme& method : schemes()) {
    if (!parts_cloth(method)) continue;
    CAPTURE(std::string(method.name));
    Preset p = test::quiet_cloth(12, 12, std::string(method.name));
    p.self = "guard", p.dt = is_implicit(method) ? 1.0 / 240 : 2e-4;
    const auto thrown = thrown_together(p);
    Simulation& simulation = *thrown;
    CHECK(simulation.tears().particles() > 12 * 12 + 8);
    for (int look = 0; look < test::fewer(20, 3); ++look) {
      simulation.advance(is_implicit(method) ? 2 : 20);
      if (simulation.divergence()) break;
      const Crossings crossings = count_crossings(simulation.read().x, simulation.tears());
      REQUIRE(crossings.pairs == crossings.around_sites);
    }
    if (method.name != "verlet" || test::sanitized) continue;  // who looks less long sees no move cut short
    CHECK_FALSE(simulation.divergence());
    CHECK(simulation.engine().held_back() > 0);
  }
}

TEST_CASE("contact of a parted cloth: the CPU engine is the plain one, with any threads, and pushes off nothing") {
  for (const char* self : {"repel", "guard"}) {
    CAPTURE(std::string(self));
    Preset p = test::quiet_cloth(12, 12);
    p.self = self, p.self_friction = 0.3, p.dt = 2e-4;
    Preset other = p;
    other.engine = EngineKind::plain;
    const std::array all{thrown_together(p), thrown_together(p, 2), thrown_together(other)};
    Simulation &fast = *all[0], &threads = *all[1], &plain = *all[2];
    const auto momentum = [](Simulation& of) {
      glm::dvec3 sum{0};
      for (int n = 0; n < of.tears().particles(); ++n)
        sum += of.preset().m * of.tears().share(n) * test::velocity(of.read(), std::size_t(n));
      return sum;
    };
    const glm::dvec3 before = momentum(fast);
    double met = 0;
    for (int n = 0; n < 10; ++n) {
      for (Simulation* one : {&fast, &threads, &plain}) one->advance(10);
      met += fast.energy().energy.of[force::self];
    }
    CHECK(met > 0);
    CHECK(test::identical(fast.read(), threads.read()));
    const Vectors a = vectors(fast.read().x), b = vectors(plain.read().x);
    double apart = 0;
    for (std::size_t n = 0; n < a.size(); ++n) apart = std::max(apart, glm::distance(a[n], b[n]));
    CHECK(apart < 1e-9);
    if (std::string(self) == "repel") CHECK(glm::distance(momentum(fast), before) < 1e-12);
  }
}

TEST_CASE("a piece of a parted cloth falls as fast as it likes, whatever guards it") {
  Preset p = test::quiet_cloth(10, 10);
  p.tearing = "split", p.self = "guard", p.g = 9.82, p.dt = 1e-3, p.v_0 = {0, -30, 4};
  Simulation simulation(p, 1);
  simulation.apply(edit::Cut{{{3, 2}, {3, 3}, {3, 4}, {3, 5}}});
  const double from = simulation.position(5, 5).y;
  simulation.advance(500);
  CHECK(simulation.engine().held_back() == 0);
  CHECK(simulation.position(5, 5).y == doctest::Approx(from - 15 - 9.82 / 8).epsilon(1e-9));
}

/// Σ m v of all particles, kg m/s.
glm::dvec3 momentum(Simulation& simulation) {
  const State& state = simulation.read();
  glm::dvec3 sum{0};
  for (int n = 0; n < simulation.tears().particles(); ++n)
    sum += simulation.preset().m * simulation.tears().share(n) * test::velocity(state, std::size_t(n));
  return sum;
}

TEST_CASE("a sheet that tears in flight keeps its momentum and loses the energy of bending over its cuts alone") {
  Preset p = test::quiet_cloth(14, 14);
  p.tearing = "split", p.k_s = 50, p.dt = 5e-5, p.F_max = 0.3;
  Simulation simulation(p, 1);
  simulation.load(test::crumpled(p, 8, 0.1, 6));
  const double before = simulation.energy().energy.total();
  const glm::dvec3 pushed = momentum(simulation);
  simulation.advance(4000);
  CHECK(simulation.tears().particles() > 14 * 14 + 20);
  CHECK(glm::distance(momentum(simulation), pushed) < 1e-12);
  CHECK(std::abs(simulation.energy().energy.total() - before) < 2e-3 * before);
}

TEST_CASE("each split of a sheet without bending changes its energy by rounding, and crosses nothing") {
  Preset p = test::quiet_cloth(12, 12);
  p.tearing = "split", p.k_s = 50, p.dt = 1e-4;
  Simulation simulation(p, 1);
  simulation.load(test::crumpled(p, 2, 0.4, 1));
  const double before = simulation.energy().energy.total();
  std::vector<SpringSite> springs;
  for (int i = 2; i < 9; ++i) springs.push_back({0, i, i / 2 + 2}), springs.push_back({1, i, 8});
  simulation.apply(edit::CutSprings{springs});
  CHECK(simulation.tears().particles() > 144 + 10);
  CHECK(std::abs(simulation.energy().energy.total() - before) < 1e-14 * before);
  // Copies that lie on each other touch, and do not cross.
  Simulation flat(p, 1);
  flat.apply(edit::CutSprings{springs});
  CHECK(count_crossings(flat.read().x, flat.tears()).pairs == 0);
}

TEST_CASE("a piece that is cut off falls as a piece, and what is left hangs on") {
  Preset p = test::cloth(13, 9);
  p.tearing = "split", p.tilt_deg = 90, p.k_d = 0.002, p.pins.mode = Pins::Mode::top_row;
  Simulation simulation(p, 1);
  simulation.advance(1500);
  std::vector<SpringSite> springs;
  for (int j = 0; j < 9; ++j) springs.push_back({1, 6, j});  // across every column
  simulation.apply(edit::CutSprings{springs});
  CHECK(simulation.tears().particles() == 13 * 9 + 9);
  const auto center = [&] {
    const State& state = simulation.read();
    glm::dvec3 x{0}, v{0};
    double mass = 0;
    for (int n = 0; n < simulation.tears().particles(); ++n) {
      const unsigned cells = simulation.tears().mesh()->cells_of(n);
      const Pins::Site site = simulation.tears().site(n);
      const bool below = site.i > 6 || (site.i == 6 && (cells & (Mesh::down_left | Mesh::down_right)) != 0);
      if (!below) continue;
      const double share = simulation.tears().share(n);
      mass += share, x += share * test::position(state, std::size_t(n)),
          v += share * test::velocity(state, std::size_t(n));
    }
    CHECK(mass == doctest::Approx(6 * 9 + 4.5));
    return std::pair(x / mass, v / mass);
  };
  const auto [x, v] = center();
  const double t = 0.2;
  simulation.advance(200);
  const auto fallen = center();
  CHECK(std::abs(fallen.first.y - (x.y + v.y * t - p.g * t * t / 2)) < 1e-9);
  CHECK(std::abs(fallen.second.y - (v.y - p.g * t)) < 1e-9);
  // The rest still hangs, its lower edge near where it was.
  CHECK(simulation.position(6, 4).y > x.y);
}

TEST_CASE("undo and replay return to the last bit, whatever has parted meanwhile") {
  Preset p = sheet(20, 16);
  p.F_max = 0.4, p.v_0 = {0, 0, 3};
  Simulation simulation(p, 2);
  simulation.advance(20);
  const Snapshot whole = simulation.snapshot();
  simulation.apply(edit::CutSprings{{{0, 9, 7}, {0, 10, 7}, {0, 11, 7}}});
  simulation.advance(100);
  const Snapshot then = simulation.snapshot();
  REQUIRE(then.lattice != whole.lattice);
  simulation.advance(150);
  const State after = simulation.read();
  const Tears tears = simulation.tears();
  CHECK(tears.particles() > then.tears.particles());
  simulation.restore(then);
  CHECK(test::identical(simulation.read(), then.state));
  simulation.advance(150);
  CHECK(simulation.tears() == tears);
  CHECK(test::identical(simulation.read(), after));
  simulation.restore(whole);
  CHECK(simulation.tears().untorn());
  simulation.advance(10);
  Simulation other(p, 2);
  other.advance(30);
  CHECK(test::identical(simulation.read(), other.read()));
}

TEST_CASE("after a return, another cut with as many copies has its own springs, with every method") {
  for (const char* method : {"verlet", "rk4", "semi_implicit_euler", "dopri5", "rkc2", "implicit_euler", "tr_bdf2"}) {
    Preset p = sheet(12, 12);
    p.integrator = method, p.dt = 1e-4;
    const auto cut = [](Simulation& simulation, int j) {
      simulation.apply(edit::Cut{{{8, j}, {8, j + 1}, {8, j + 2}, {8, j + 3}}});
    };
    Simulation simulation(p, 1), other(p, 1);
    for (Simulation* one : {&simulation, &other}) one->advance(20);
    // There is room for more copies, so the engine stays.
    for (Simulation* one : {&simulation, &other}) one->apply(edit::Cut{{{3, 3}, {3, 4}, {3, 5}}}), one->advance(1);
    const Snapshot then = simulation.snapshot();
    cut(simulation, 3);
    simulation.advance(1);
    simulation.restore(then);
    cut(simulation, 6), cut(other, 6);
    simulation.advance(200), other.advance(200);
    CAPTURE(std::string(method));
    CHECK(simulation.tears() == other.tears());
    CHECK(test::identical(simulation.read(), other.read()));
  }
}

TEST_CASE("a cut from border to border parts the cloth in two") {
  for (const bool back : {false, true}) {
    Preset p = test::cloth(9, 12);
    p.tearing = "split", p.pins.mode = Pins::Mode::top_row;
    Simulation simulation(p, 1);
    simulation.advance(20);
    std::vector<Pins::Site> path{{5, 0}, {5, 11}};
    if (back) std::reverse(path.begin(), path.end());
    simulation.apply(edit::Cut{path});
    CHECK(simulation.tears().particles() == 9 * 12 + 12);
    simulation.advance(500);
    CHECK(simulation.position(8, 5).y < -0.5);
  }
}

TEST_CASE("an opening leaves the wind as it blows: a gust acts once") {
  Preset p = test::quiet_cloth(10, 10);
  p.tearing = "split", p.W = {0, 0, 0.003}, p.gust = 0.9, p.gust_period = 20, p.dt = 1e-3;
  Simulation cut(p, 1), whole(p, 1);
  for (Simulation* one : {&cut, &whole}) one->advance(3000);
  REQUIRE(std::abs(whole.wind().z / p.W.z - 1) > 0.3);
  const double before = momentum(cut).z;
  CHECK(std::abs(momentum(whole).z - before) < 1e-12);
  cut.apply(edit::Cut{{{7, 2}, {7, 3}, {7, 4}}});
  for (Simulation* one : {&cut, &whole}) one->advance(5);
  CHECK(cut.tears().particles() > 100);
  const double gained = momentum(whole).z - before;
  // Triangles beside the cut turn a little otherwise.
  CHECK(std::abs(momentum(cut).z - before - gained) < 1e-2 * gained);
}

TEST_CASE("an opening leaves moving pins and counts as they are") {
  Preset p = sheet(10, 10);
  p.pins.mode = Pins::Mode::top_row;
  p.pins.motions = {{.mode = Pins::Mode::top_row, .path = {{0, {0, 0, 0}}, {1, {0.3, 0.1, 0.2}}}}};
  p.integrator = "dopri5", p.dt = 1e-3, p.precision = Precision::float_;
  Simulation cut(p, 1), whole(p, 1);
  for (Simulation* one : {&cut, &whole}) one->advance(100);
  cut.apply(edit::Cut{{{7, 2}, {7, 3}, {7, 4}}});
  for (Simulation* one : {&cut, &whole}) one->advance(50);
  CHECK(cut.engine().inner_steps().accepted >= 150);
  CHECK(cut.position(0, 0) == whole.position(0, 0));
  cut.apply(edit::Cut{{{0, 5}, {1, 5}, {2, 5}}});
  cut.advance(10), whole.advance(10);
  int pinned = 0;
  for (int n = 100; n < cut.tears().particles(); ++n) {
    if (!cut.pinned(n / 10, n % 10)) continue;
    ++pinned;
    CHECK(cut.position(n / 10, n % 10) == whole.position(0, 5));
  }
  CHECK(pinned == 1);
}

TEST_CASE("while nothing parts, the rule changes no bit") {
  Preset p = sheet(20, 16);
  p.F_max = 1e6;
  Preset other = p;
  other.tearing = "springs";
  Simulation split(p, 1), springs(other, 1);
  split.advance(300), springs.advance(300);
  CHECK(test::identical(split.read(), springs.read()));
}

TEST_CASE("the largest line tension decides where an overloaded spring parts the cloth") {
  Preset p = test::quiet_cloth(9, 9);
  p.tearing = "split", p.F_max = 0.2, p.k_s = 100;
  State state = start_state(p);
  // Stretched along the rows, and most of all between columns 4 and 5.
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      state.x.x[std::size_t(9 * i + j)] *= 1.02, state.x.x[std::size_t(9 * i + j)] += j > 4 ? 0.3 * p.L : 0;
  const Vectors x = vectors(state.x);
  const std::vector<Opening> openings = openings_of_overload(p, Tears(lattice_of(p)), x, {});
  REQUIRE(openings.size() >= 9);
  for (const Opening& opening : openings) {
    const int j = opening.particle % 9, i = opening.particle / 9;
    CHECK((j == 4 || j == 5));
    const unsigned inner = opening.cells;
    // Cut down through the site: what parts are the cells on one side.
    const bool left = (inner & ~unsigned(Mesh::up_left | Mesh::down_left)) == 0,
               right = (inner & ~unsigned(Mesh::up_right | Mesh::down_right)) == 0;
    CAPTURE(i);
    CHECK((left || right));
  }
  std::vector<std::uint8_t> guarded(81, 0);
  std::fill(guarded.begin(), guarded.end(), std::uint8_t(1));
  CHECK(openings_of_overload(p, Tears(lattice_of(p)), x, guarded).empty());
}

TEST_CASE("pins and the hand hold what parts: copies inherit a pin, the hand keeps its particle") {
  Preset p = test::cloth(8, 8);
  p.tearing = "split", p.pins.mode = Pins::Mode::top_row;
  Simulation simulation(p, 1);
  simulation.advance(50);
  simulation.apply(edit::CutSprings{{{0, 0, 3}, {0, 1, 3}, {0, 2, 3}}});
  const int copies = simulation.tears().particles() - 64;
  CHECK(copies == 3);
  int pinned = 0;
  for (int n = 64; n < simulation.tears().particles(); ++n) pinned += simulation.pinned(n / 8, n % 8);
  CHECK(pinned == 1);
  simulation.apply(edit::Grab{65 / 8, 65 % 8});
  const bool grabbed = simulation.held().has_value();
  CHECK(grabbed != simulation.pinned(65 / 8, 65 % 8));
  simulation.advance(100);
  CHECK(test::all_finite(simulation.read()));
  // To unpin a copy is to unpin its site.
  simulation.apply(edit::Pin{0, 3, false});
  for (int n = 64; n < simulation.tears().particles(); ++n) CHECK(!simulation.pinned(n / 8, n % 8));
  CHECK(simulation.preset().pins.list.size() == 7);
}

TEST_CASE("files name copies by their sites, after all sites") {
  Preset p = test::cloth(5, 5);
  p.tearing = "split";
  Simulation simulation(p, 1);
  simulation.apply(edit::CutSprings{{{0, 1, 2}, {0, 2, 2}}});
  REQUIRE(simulation.tears().particles() == 27);
  const std::string csv = state_csv(simulation), values = values_csv(simulation, nullptr);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 2 + 27);
  CHECK(csv.find("\n4,4,") < csv.find("\n2,2,", csv.find("\n4,4,")));
  CHECK(std::count(values.begin(), values.end(), '\n') == 2 + 27);
  const std::string obj = obj_text(simulation.tears(), simulation.read().x, {});
  const auto lines = [&](const std::string& with) {
    int count = 0;
    for (std::size_t at = obj.find(with); at != std::string::npos; at = obj.find(with, at + 1)) ++count;
    return count;
  };
  CHECK(lines("\nv ") == 27);
  CHECK(lines("\nvt ") == 27);
  CHECK(lines("\nf ") == 32);
}

TEST_CASE("read-outs and the look inside a step know the springs of copies, and the pairs of near layers") {
  for (const bool near : {false, true})
    for (const char* method : {"verlet", "rk4"}) {
      Preset p = sheet(9, 9);
      p.integrator = method;
      if (near) p.tearing = "springs", p.self = "repel", p.initial_stretch = 0.3, p.pins.mode = Pins::Mode::none;
      Simulation simulation(p, 1);
      if (!near) simulation.apply(edit::CutSprings{{{0, 3, 4}, {0, 4, 4}, {0, 5, 4}}});
      simulation.advance(near ? 3 : 200);
      for (const int particle : {4 * 9 + 4, 3 * 9 + 3, near ? 40 : 82}) {
        const int i = particle / 9, j = particle % 9;
        REQUIRE(simulation.has(i, j));
        const StepTrace trace = trace_step(simulation, i, j);
        const glm::dvec3 a = simulation.particle(i, j).a, F = simulation.particle(i, j)["F"];
        CHECK(glm::distance(a * p.m * simulation.tears().share(particle), F) < 1e-12);
        glm::dvec3 sum{0};
        for (const StencilForce& one : trace.stages.front().stencils) sum += one.F;
        const glm::dvec3 layers = trace.stages.front().forces[force::self] + trace.stages.front().forces[force::slip];
        CHECK(glm::distance(sum + layers, trace.stages.front().forces.F_int()) < 1e-12);
        Simulation next(p, 1);
        next.restore(simulation.snapshot());
        next.advance(1);
        CAPTURE(std::string(method));
        CAPTURE(particle);
        CHECK(glm::distance(trace.x_after, next.position(i, j)) < 1e-13);
      }
    }
}

TEST_CASE("what cannot part is refused, with the cure") {
  Preset p = test::cloth(5, 5);
  p.tearing = "split";
  CHECK(check_preset(p).empty());
  CHECK(parse_preset(preset_to_json(p), "it").tearing == "split");
  CHECK(preset_to_json(p).find("\"mode\": \"split\"") != std::string::npos);
  CHECK(with_settings(Preset{}, {"tearing.mode=split"}).tearing == "split");
  CHECK(with_settings(Preset{}, {"mode=3"}).mode == 3);
  p.integrator = "vbd";
  CHECK(check_preset(p).find("tearing.mode: vbd does not part the cloth; methods that do: euler") == 0);
  p.integrator = "verlet", p.columns = 1;
  CHECK(check_preset(p).find("tearing.mode: a cloth that parts needs at least 2 columns") == 0);
  p.columns = 5, p.tearing = "splits";
  CHECK(check_preset(p).find("tearing.mode: \"splits\" is not known; did you mean split?") == 0);
  p.tearing = "springs", p.F_max = 0.1;
  Simulation simulation(p, 1);
  simulation.apply(edit::CutSprings{{{0, 1, 2}}});
  p.tearing = "split";
  CHECK_THROWS_WITH_AS(simulation.apply(edit::Change{p}),
                       "tearing.mode: the cloth has torn by the rule springs; restart the scene first", PresetError);
  CHECK_FALSE(Simulation(p, 1).fits(simulation.snapshot()));
}

}  // namespace tyglab::parted_test
