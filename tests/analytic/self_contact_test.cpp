// Contact of the cloth with itself (core/contact/self_contact.h): pairs and forces against a search without boxes, the
// force against its energy, engines against each other, the guard's promise, and the orders of methods.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/crossings.h"
#include "core/contact/self_contact.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::self_contact_test {

using test::Random;
using Vectors = std::vector<glm::dvec3>;

Preset sheet(int rows, int columns, const char* self, std::string_view integrator = "verlet") {
  Preset p = test::quiet_cloth(rows, columns, std::string(integrator));
  p.L = 0.02, p.m = 2e-4, p.k_s = 60, p.dt = 2e-4, p.self = self;
  return p;
}

glm::dvec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A strip that is folded in the middle, with its halves `apart` from each other, and flat, its springs `longer` than
/// at rest.
State folded(const Preset& p, double apart, double longer = 1) {
  State state = start_state(p);
  const double L = longer * p.L, radius = apart / 2, half = (p.rows - 1) * L / 2, bend = std::numbers::pi * radius;
  for (int i = 0; i < p.rows; ++i)
    for (int j = 0; j < p.columns; ++j) {
      const double s = i * L - half;
      double z = 0, y = 0;
      if (std::abs(s) < bend / 2)
        z = radius * std::cos(s / radius), y = radius * std::sin(s / radius);
      else
        z = bend / 2 - std::abs(s), y = std::copysign(radius, s);
      const std::size_t at = std::size_t(i) * std::size_t(p.columns) + std::size_t(j);
      // The upper half is sheared, so that no edges of the two are parallel.
      const double shear = y > 0 ? std::abs(s) / half : 0;
      state.x.x[at] = j * L + 0.3 * L * shear, state.x.y[at] = y, state.x.z[at] = z + 0.17 * L * j * shear;
    }
  return state;
}

Vectors positions(const State& state) {
  Vectors x;
  for (std::size_t n = 0; n < state.x.x.size(); ++n) x.emplace_back(state.x.x[n], state.x.y[n], state.x.z[n]);
  return x;
}

/// Calls visit(particles, particles of the other, distance) for all pairs that share no site, without boxes.
template <class Visit>
void for_all_pairs(const Tears& tears, const Vectors& x, Visit visit) {
  using Part = std::vector<int>;
  std::set<Part> of_particles, of_edges, of_triangles;
  const auto add = [](std::set<Part>& parts, Part at) {
    std::sort(at.begin(), at.end());
    parts.insert(std::move(at));
  };
  for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
    add(of_triangles, {a, b, c});
    for (const Part& corner : {Part{a}, Part{b}, Part{c}}) add(of_particles, corner);
    for (const Part& edge : {Part{a, b}, Part{b, c}, Part{c, a}}) add(of_edges, edge);
  });
  const auto site = [&](int particle) { return tears.mesh() != nullptr ? tears.mesh()->site(particle) : particle; };
  const std::vector<Part> particles(of_particles.begin(), of_particles.end()), edges(of_edges.begin(), of_edges.end()),
      triangles(of_triangles.begin(), of_triangles.end());
  const auto meet = [&](const Part& a, const Part& b) {
    for (const int one : a)
      if (std::any_of(b.begin(), b.end(), [&](int other) { return site(one) == site(other); })) return;
    const auto place = [&](const Part& part, std::size_t n) { return x[std::size_t(part[n])]; };
    const Gap gap = a.size() == 1 ? gap_to_triangle(place(a, 0), {place(b, 0), place(b, 1), place(b, 2)})
                                  : gap_of_edges({place(a, 0), place(a, 1)}, {place(b, 0), place(b, 1)});
    visit(a, b, glm::length(gap.between));
  };
  for (const Part& particle : particles)
    for (const Part& triangle : triangles) meet(particle, triangle);
  for (std::size_t n = 0; n < edges.size(); ++n)
    for (std::size_t m = n + 1; m < edges.size(); ++m) meet(edges[n], edges[m]);
}

/// Their energy.
double energy_of_all_pairs(const Preset& p, const Tears& tears, const Vectors& x) {
  const double d = 2 * contact_thickness(p), k = spring_constants(p).largest();
  double energy = 0;
  for_all_pairs(tears, x, [&](const auto&, const auto&, double distance) {
    if (const double s = d - distance; s > 0) energy += k * std::pow(s, 4) / (d * d);
  });
  return energy;
}

TEST_CASE("the gap between parts is the shortest line between any of their points") {
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const bool flat = n % 3 == 0;
    std::array<glm::dvec3, 4> p;
    for (glm::dvec3& one : p) one = random_point(random, 1) * glm::dvec3(1, 1, flat ? 0 : 1);
    const Gap of_triangle = gap_to_triangle(p[0], {p[1], p[2], p[3]});
    const Gap of_edges = gap_of_edges({p[0], p[1]}, {p[2], p[3]});
    for (const Gap& gap : {of_triangle, of_edges}) {
      glm::dvec3 sum{0};
      double weights = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += gap.weights[k] * p[k], weights += gap.weights[k];
      CHECK(glm::distance(sum, gap.between) < 1e-12);
      CHECK(std::abs(weights) < 1e-12);
    }
    for (int k = 0; k < 40; ++k) {
      double s = random.uniform(0, 1), t = random.uniform(0, 1);
      CHECK(glm::distance(p[0] + s * (p[1] - p[0]), p[2] + t * (p[3] - p[2])) >= glm::length(of_edges.between) - 1e-12);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      CHECK(glm::distance(p[0], p[1] + s * (p[2] - p[1]) + t * (p[3] - p[1])) >=
            glm::length(of_triangle.between) - 1e-12);
    }
  }
}

TEST_CASE("boxes lose no pair that a look at every pair finds: crumpled, folded, torn cloths") {
  double most = 0;
  for (int n = 0; n < 30; ++n) {
    CAPTURE(n);
    Preset p = sheet(3 + n % 9, 2 + n % 7, "repel");
    Tears tears(lattice_of(p));
    if (n % 3 == 1)
      for (int i = 0; i + 1 < p.rows; ++i) tears.tear(1, i, n % p.columns);
    const State state =
        n % 2 == 0 ? test::crumpled(p, std::uint64_t(n), 0.1 + 0.05 * n) : folded(p, (0.1 + 0.01 * n) * p.L);
    const Vectors x = positions(state);
    SelfContact contact(lattice_of(p));
    contact.set_preset(p, layer_constant(p));
    contact.follow(tears, x);
    Vectors F(x.size(), glm::dvec3(0));
    contact.look(x);
    const double energy = contact.add_forces(F), wanted = energy_of_all_pairs(p, tears, x);
    CHECK(energy == doctest::Approx(wanted).epsilon(1e-12));
    most = std::max(most, wanted);
  }
  CHECK(most > 0);
}

/// A mesh with random openings.
Tears randomly_parted(const Preset& p, int openings, Random& random) {
  auto mesh = std::make_shared<Mesh>(lattice_of(p));
  for (int n = 0; n < openings; ++n) {
    const int particle = random.below(mesh->particles());
    const unsigned all = mesh->cells_of(particle), some = all & unsigned(random.below(16));
    if (some != 0 && some != all) mesh->part(particle, some);
  }
  Lattice lattice = lattice_of(p);
  while (lattice.size() < mesh->particles()) ++lattice.rows, ++lattice.copy_rows;
  return {lattice, mesh};
}

TEST_CASE("boxes lose no pair of a parted cloth, however it moves") {
  for (int n = 0; n < 24; ++n) {
    CAPTURE(n);
    const Preset p = sheet(5 + n % 9, 4 + n % 11, "repel");
    Random random(std::uint64_t(n + 1));
    const Tears tears = randomly_parted(p, 1 + 3 * n, random);
    const Vectors whole =
        positions(n % 2 == 0 ? test::crumpled(p, std::uint64_t(n), 0.1 + 0.02 * n) : folded(p, 0.3 * p.L));
    Vectors x;
    // In every third cloth copies have gone far from where they were.
    const auto is_far = [&](int particle) { return n % 3 == 0 && particle >= p.rows * p.columns; };
    for (int particle = 0; particle < tears.particles(); ++particle)
      x.push_back(whole[std::size_t(tears.mesh()->site(particle))] +
                  random_point(random, (is_far(particle) ? 5 : 0.3) * p.L));
    SelfContact contact(tears.lattice());
    contact.set_preset(p, layer_constant(p));
    for (int move = 0; move < 12; ++move) {
      contact.follow(tears, x);
      contact.look(x);
      Vectors F(x.size(), glm::dvec3(0));
      const double found = contact.add_forces(F), wanted = energy_of_all_pairs(p, tears, x);
      REQUIRE(wanted > 0);
      REQUIRE(found == doctest::Approx(wanted).epsilon(1e-12));
      for (int particle = 0; particle < tears.particles(); ++particle)
        x[std::size_t(particle)] +=
            random_point(random, (move % 3 == 2 ? 0.1 : 0.01) * (is_far(particle) ? 20 : 1) * p.L);
    }
  }
}

/// Moves what is around some particle a little, and turns and moves the whole cloth, which is `flatter` afterwards.
void stir(const Preset& p, Random& random, double flatter, Vectors& x) {
  const int row = random.below(p.rows), column = random.below(p.columns);
  const glm::dvec3 way = random_point(random, 0.05 * p.L), all = glm::dvec3(0.1, -0.2, 0.1) * p.L;
  const glm::dvec3 turn = random_point(random, 0.004), middle = x[x.size() / 2];
  for (int i = 0; i < p.rows; ++i)
    for (int j = 0; j < p.columns; ++j) {
      glm::dvec3& one = x[std::size_t(i) * std::size_t(p.columns) + std::size_t(j)];
      const double off = std::hypot(i - row, j - column);
      one.y = middle.y + flatter * (one.y - middle.y);
      one += all + glm::cross(turn, one - middle) + way * std::exp(-off * off / 8);
    }
}

TEST_CASE("lists that are kept, and made anew only where the cloth has moved, lose no pair") {
  for (const int scene : {0, 1, 2}) {
    CAPTURE(scene);
    // A crumpled one, and folded ones whose halves come together from afar, too.
    const Preset p = sheet(scene == 2 ? 30 : 17, scene == 1 ? 24 : 14, "guard");
    Random random(std::uint64_t(scene + 1));
    Tears tears(lattice_of(p));
    Vectors x = positions(scene == 0 ? test::crumpled(p, 4, 0.5) : folded(p, 5 * p.L));
    const double reach = 0.4 * p.L;
    NearPairs kept(lattice_of(p));
    kept.set_distances(p.L, reach);
    SelfContact contact(lattice_of(p));
    contact.set_preset(p, layer_constant(p));
    const int times = test::fewer(60, 10);
    std::int64_t lists = 0;
    for (int n = 0; n < times; ++n) {
      CAPTURE(n);
      stir(p, random, scene == 0 ? 1 : 0.95, x);
      kept.follow(tears, x);
      if (n == 0) lists = kept.made();
      std::vector<double> found, wanted;
      // Twice, since what is known of a pair is what was measured last.
      for (const double below : {n % 3 == 0 ? reach : reach / 2, reach}) {
        found.clear();
        kept.measure(below, x, [&](const auto&, const Gap&, double distance) { found.push_back(distance); });
      }
      for_all_pairs(tears, x, [&](const auto&, const auto&, double distance) {
        if (distance < reach) wanted.push_back(distance);
      });
      std::sort(found.begin(), found.end()), std::sort(wanted.begin(), wanted.end());
      REQUIRE(found.size() == wanted.size());
      for (std::size_t k = 0; k < found.size(); ++k)
        REQUIRE(found[k] == doctest::Approx(wanted[k]).epsilon(1e-9).scale(1e-6));
      // Forces have the bits of lists that are new.
      SelfContact fresh(lattice_of(p));
      fresh.set_preset(p, layer_constant(p));
      Vectors F(x.size(), glm::dvec3(0)), F_fresh = F;
      contact.follow(tears, x), fresh.follow(tears, x);
      contact.look(x), fresh.look(x);
      contact.add_forces(F), fresh.add_forces(F_fresh);
      REQUIRE(F == F_fresh);
    }
    // Most lists are kept most of the time.
    CHECK(kept.made() > lists);
    CHECK(kept.made() < lists * times / 2);
  }
}

TEST_CASE("as many tears at other places are other tears") {
  const Preset p = sheet(12, 6, "repel");
  const Vectors x = positions(folded(p, 0.2 * p.L));
  Tears above(lattice_of(p)), below(lattice_of(p));
  for (int j = 0; j + 1 < p.columns; ++j) above.tear(0, 2, j), below.tear(0, 1, j);
  REQUIRE(above.torn_count() == below.torn_count());
  REQUIRE(energy_of_all_pairs(p, above, x) != doctest::Approx(energy_of_all_pairs(p, below, x)).epsilon(1e-6));
  SelfContact contact(lattice_of(p));
  contact.set_preset(p, layer_constant(p));
  for (const Tears* tears : {&above, &below}) {
    contact.forget();
    contact.follow(*tears, x);
    contact.look(x);
    Vectors F(x.size(), glm::dvec3(0));
    CHECK(contact.add_forces(F) == doctest::Approx(energy_of_all_pairs(p, *tears, x)).epsilon(1e-12));
  }
}

TEST_CASE("the guard cuts ways to what the nearest pair leaves, and no others") {
  for (const double speed : {0.02, 0.1, 0.5}) {
    CAPTURE(speed);
    const Preset p = sheet(14, 9, "guard");
    const Tears tears(lattice_of(p));
    const Vectors before = positions(folded(p, 0.3 * p.L));
    std::vector<double> room(before.size(), 0.4 * p.L);
    for_all_pairs(tears, before, [&](const auto& a, const auto& b, double distance) {
      for (const auto* part : {&a, &b})
        for (const int at : *part) room[std::size_t(at)] = std::min(room[std::size_t(at)], distance);
    });
    SelfContact contact(lattice_of(p));
    contact.set_preset(p, layer_constant(p));
    contact.follow(tears, before);
    contact.look(before, true);
    Random random(3);
    Vectors x = before;
    for (glm::dvec3& one : x) one += random_point(random, speed * p.L);
    const Vectors freely = x;
    contact.hold_back(before, x, false);
    int cut = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double way = glm::distance(freely[n], before[n]), most = 0.45 * (room[n] - 1e-4 * p.L);
      CHECK(glm::distance(x[n], before[n]) == doctest::Approx(std::min(way, most)).epsilon(1e-9));
      cut += way > most;
    }
    CHECK((cut > 0) == (speed > 0.05));
  }
}

TEST_CASE("a flat cloth meets nothing, however it is stretched, sheared by a tenth or turned") {
  Preset p = sheet(20, 30, "repel");
  for (const double stretch : {0.9, 1.0, 3.0}) {
    p.initial_stretch = stretch;
    Vectors x = positions(start_state(p));
    for (glm::dvec3& one : x) one.x += 0.1 * one.y;
    SelfContact contact(lattice_of(p));
    contact.set_preset(p, layer_constant(p));
    contact.follow(Tears(lattice_of(p)), x);
    CHECK_FALSE(contact.near());
  }
}

TEST_CASE("the force is the slope of its energy, and gives no momentum") {
  const Preset p = sheet(7, 6, "repel");
  const Tears tears(lattice_of(p));
  Vectors x = positions(test::crumpled(p, 11, 0.7));
  SelfContact contact(lattice_of(p));
  contact.set_preset(p, layer_constant(p));
  contact.follow(tears, x);
  REQUIRE(contact.near());
  Vectors F(x.size(), glm::dvec3(0)), none = F;
  const auto energy = [&](Vectors& into) {
    contact.look(x);
    return contact.add_forces(into);
  };
  energy(F);
  glm::dvec3 sum{0}, turn{0};
  double largest = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    sum += F[n], turn += glm::cross(x[n], F[n]), largest = std::max(largest, glm::length(F[n]));
  REQUIRE(largest > 0);
  CHECK(glm::length(sum) < 1e-12 * largest);
  CHECK(glm::length(turn) < 1e-12 * largest);
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      constexpr double step = 1e-7;
      const double here = x[n][c];
      x[n][c] = here + step;
      const double ahead = energy(none);
      x[n][c] = here - step;
      const double behind = energy(none);
      x[n][c] = here;
      CHECK(std::abs(F[n][c] + (ahead - behind) / (2 * step)) < 1e-5 * largest);
    }
}

/// Where a folded strip is after its halves have been pressed together.
State pressed(Preset p, double seconds, int threads = 1, double longer = 1) {
  Simulation simulation(p, threads);
  State state = folded(p, 0.5 * p.L, longer);
  // The fold itself stays as it is.
  for (std::size_t n = 0; n < state.v.y.size(); ++n)
    state.v.y[n] = state.x.z[n] > -2 * p.L ? 0 : state.x.y[n] > 0 ? -0.4 : 0.4;
  simulation.load(state);
  simulation.advance(int(std::lround(seconds / p.dt)));
  return simulation.read();
}

double rms(const State& a, const State& b) {
  const Vectors x = positions(a), y = positions(b);
  double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += glm::dot(x[n] - y[n], x[n] - y[n]);
  return std::sqrt(sum / double(x.size()));
}

TEST_CASE("the CPU engine is the plain one, for every method that both run, with friction") {
  for (const Scheme& method : schemes()) {
    if (!is_written_out(method)) continue;
    CAPTURE(std::string(method.name));
    Preset p = sheet(12, 5, "guard", method.name);
    p.k_b = 3, p.k_d = 1e-4, p.self_friction = 0.5;
    const State fast = pressed(p, 0.02);
    p.engine = EngineKind::plain;
    const State plain = pressed(p, 0.02);
    p.self = "off";
    CHECK(rms(fast, plain) < 1e-10);
    CHECK(rms(pressed(p, 0.02), plain) > 1e-4);
  }
}

TEST_CASE("the bits do not depend on the number of threads, nor on how steps are grouped") {
  for (const char* integrator : {"verlet", "rk4", "dopri5", "implicit_euler"})
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      Preset p = sheet(40, 9, "guard", integrator);
      p.precision = precision;
      const State one = pressed(p, 0.02, 1);
      CHECK(test::identical(one, pressed(p, 0.02, 2)));
    }
}

TEST_CASE("while nothing is near, the motion has the same bits as without contact") {
  for (const char* integrator : {"verlet", "rk4", "semi_implicit_euler"}) {
    Preset p = sheet(20, 15, "guard", integrator);
    p.precision = Precision::float_, p.k_b = 3, p.k_d = 1e-4, p.g = 9.82, p.pins.mode = Pins::Mode::top_row;
    Simulation guarded(p), free((p.self = "off", p));
    guarded.advance(500), free.advance(500);
    CHECK(test::identical(guarded.read(), free.read()));
    CHECK(guarded.engine().held_back() == 0);
  }
}

TEST_CASE("a method that starts anew amid contact, since a constant has changed, starts with its forces") {
  for (const char* integrator : {"verlet", "semi_implicit_euler", "rk4"}) {
    CAPTURE(std::string(integrator));
    Preset p = sheet(12, 5, "guard", integrator);
    const auto changed_amid = [&](EngineKind engine) {
      p.engine = engine;
      Simulation simulation(p);
      simulation.load(folded(p, 0.25 * p.L));
      simulation.advance(4);
      Preset next = p;
      next.dt = p.dt / 2, next.k_d = 1e-4;
      simulation.apply(edit::Change{next});
      simulation.advance(8);
      return simulation.read();
    };
    CHECK(rms(changed_amid(EngineKind::cpu), changed_amid(EngineKind::plain)) < 1e-12);
  }
}

TEST_CASE("contact may be switched off and on under way, and follows tears that others replace") {
  Preset p = sheet(40, 9, "repel");
  Simulation simulation(p, 2);
  State state = folded(p, 0.25 * p.L);
  simulation.load(state);
  simulation.advance(3);
  REQUIRE(simulation.energy().energy.of[force::self] > 0);
  Preset off = p;
  off.self = "off";
  simulation.apply(edit::Change{off});
  simulation.advance(40);
  CHECK(simulation.energy().energy.of[force::self] == 0);
  simulation.apply(edit::Change{p});
  simulation.load(state);
  // Two cuts of as many springs at other places: a return to the first has other triangles than the second.
  const Snapshot whole = simulation.snapshot();
  simulation.apply(edit::Cut{{{3, 3}, {3, 4}, {3, 5}}});
  const Snapshot first = simulation.snapshot();
  simulation.advance(5);
  const State wanted = simulation.read();
  simulation.restore(whole);
  simulation.apply(edit::Cut{{{12, 3}, {12, 4}, {12, 5}}});
  simulation.advance(5);
  simulation.restore(first);
  simulation.advance(5);
  CHECK(test::identical(simulation.read(), wanted));
}

TEST_CASE("methods keep their orders through layers in contact") {
  for (const auto& [integrator, order] :
       {std::pair("verlet", 2.0), std::pair("velocity_verlet", 2.0), std::pair("rk4", 4.0), std::pair("rkn4", 4.0),
        std::pair("implicit_euler", 1.0), std::pair("implicit_midpoint", 2.0), std::pair("tr_bdf2", 2.0)}) {
    CAPTURE(std::string(integrator));
    Preset p = sheet(12, 4, "guard", integrator);
    // Springs that go slack would end the order of any method: these stay taut. And layers slip so little that most
    // nearest points stay inside the same edges and triangles: where they leave them the slope of the force jumps,
    // which leaves errors of order 2 of some 1e-10 m.
    p.k_s = 1, p.k_warp = p.k_shear = 1e-4;
    const double seconds = 0.012, longer = 1.01;
    p.dt = seconds / 2048;
    const State exact = pressed((p.integrator = "rk4", p), seconds, 1, longer);
    p.integrator = integrator;
    CHECK(rms(pressed((p.self = "off", p), seconds, 1, longer), exact) > 1e-4);
    p.self = "guard";
    std::vector<double> errors;
    for (const int steps : {16, 32}) {
      p.dt = seconds / steps;
      errors.push_back(rms(pressed(p, seconds, 1, longer), exact));
    }
    const double found = std::log2(errors.front() / errors.back());
    CHECK(found > order - 0.3);
    CHECK(found < order + 0.4);
  }
}

TEST_CASE("with the guard nothing that was apart crosses: a sheet that is thrown together, by every method") {
  for (const Scheme& method : schemes()) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      const bool implicit = is_implicit(method);
      if (precision == Precision::float_ && method.name != "verlet" && method.name != "dopri5" && !implicit) continue;
      CAPTURE(std::string(method.name));
      Preset p = sheet(12, 12, "guard", method.name);
      p.precision = precision, p.k_d = 2e-4, p.dt = implicit ? 1.0 / 120 : 5e-4;
      Simulation simulation(p);
      State state = start_state(p);
      Random random(5);
      for (std::size_t n = 0; n < state.v.x.size(); ++n) {
        const glm::dvec3 v = random_point(random, 3);
        state.v.x[n] = v.x - 20 * state.x.x[n], state.v.y[n] = v.y - 20 * (state.x.y[n] - 0.87), state.v.z[n] = v.z;
      }
      simulation.load(state);
      for (int look = 0; look < test::fewer(20, 3); ++look) {
        simulation.advance(10);
        if (simulation.divergence()) break;
        REQUIRE(count_crossings(simulation.read().x, simulation.tears()).pairs == 0);
      }
      if (method.name == "verlet") {
        CHECK_FALSE(simulation.divergence());
        CHECK(simulation.engine().held_back() > 0);
      }
    }
  }
}

TEST_CASE("implicit methods solve for contact: pairs that a step carries past each other push back") {
  for (const char* method : {"implicit_euler", "implicit_midpoint", "tr_bdf2"}) {
    CAPTURE(std::string(method));
    Preset p = sheet(12, 5, "repel", method);
    p.dt = 1.0 / 120, p.self_friction = 0.2;
    Simulation simulation(p);
    State state = folded(p, 0.5 * p.L);
    // In a step both layers would pass through each other by half a spacing.
    for (std::size_t n = 0; n < state.v.y.size(); ++n) state.v.y[n] = state.x.y[n] > 0 ? -0.5 : 0.5;
    simulation.load(state);
    simulation.advance(1);
    CHECK(simulation.engine().solves().unconverged == 0);
    CHECK(count_crossings(simulation.read().x, simulation.tears()).pairs == 0);
    CHECK(simulation.energy().energy.of[force::self] > 0);
  }
}

TEST_CASE("methods that lag contact, too, come to the motion of the others as dt goes to 0, with order 1") {
  Preset p = sheet(12, 4, "guard", "rk4");
  p.k_s = 1, p.k_warp = p.k_shear = 1e-4;
  const double seconds = 0.012, longer = 1.01;
  p.dt = seconds / 2048;
  const State exact = pressed(p, seconds, 1, longer);
  for (const char* method : {"projective_dynamics", "vbd", "xpbd"}) {
    CAPTURE(std::string(method));
    p.integrator = method, p.iterations = 100;
    std::vector<double> errors;
    for (const int steps : {32, 64}) {
      p.dt = seconds / steps;
      errors.push_back(rms(pressed(p, seconds, 1, longer), exact));
    }
    CHECK(std::log2(errors.front() / errors.back()) > 0.7);
    CHECK(std::log2(errors.front() / errors.back()) < 1.3);
    p.self = "off";
    CHECK(rms(pressed(p, seconds, 1, longer), exact) > 10 * errors.back());
    p.self = "guard";
  }
}

TEST_CASE("undo and replay return to the last bit, whatever is known of near pairs by then") {
  for (const char* method : {"verlet", "implicit_euler", "tr_bdf2", "projective_dynamics", "vbd", "xpbd"})
    for (const int first : {0, 6, 12, 20}) {
      CAPTURE(std::string(method));
      CAPTURE(first);
      Preset p = sheet(14, 5, "guard", method);
      p.dt = 1e-3, p.self_friction = 0.2, p.k_b = 1;
      Simulation simulation(p);
      State state = folded(p, 0.9 * p.L);
      for (std::size_t n = 0; n < state.v.y.size(); ++n) state.v.y[n] = state.x.y[n] > 0 ? -0.5 : 0.5;
      simulation.load(state);
      simulation.advance(first);
      const Snapshot then = simulation.snapshot();
      simulation.advance(25);
      const State once = simulation.read();
      simulation.advance(10);
      simulation.restore(then);
      simulation.advance(25);
      CHECK(test::identical(simulation.read(), once));
    }
}

TEST_CASE("a free cloth falls and flies as fast as it likes") {
  Preset p = sheet(10, 10, "guard");
  p.g = 9.82, p.dt = 1e-3, p.v_0 = {0, -30, 4};
  Simulation simulation(p);
  const double from = simulation.position(5, 5).y;
  simulation.advance(1000);
  CHECK(simulation.engine().held_back() == 0);
  CHECK(simulation.position(5, 5).y == doctest::Approx(from - 30 - 9.82 / 2).epsilon(1e-9));
}

TEST_CASE("contact neither makes nor loses energy, and friction only loses it") {
  for (const double friction : {0.0, 0.4}) {
    Preset p = sheet(12, 5, "repel");
    p.self_friction = friction, p.dt = 5e-5;
    Simulation simulation(p);
    State state = folded(p, 0.5 * p.L);
    for (std::size_t n = 0; n < state.v.y.size(); ++n)
      state.v.y[n] = state.x.y[n] > 0 ? -0.4 : 0.4, state.v.x[n] = state.x.y[n] > 0 ? 0.3 : 0;
    simulation.load(state);
    const double before = simulation.energy().energy.total();
    double stored = 0, last = before;
    for (int n = 0; n < 400; ++n) {
      simulation.advance(1);
      const EnergyReading now = simulation.energy();
      stored = std::max(stored, now.energy.of[force::self]);
      if (friction > 0) CHECK(now.energy.total() < last + 1e-4 * before);
      last = now.energy.total();
    }
    CHECK(stored > 0.01 * before);
    if (friction == 0) CHECK(std::abs(last - before) < 1e-4 * before);
    if (friction > 0) CHECK(last < 0.999 * before);
  }
}

TEST_CASE("what cannot be is refused, with the cure") {
  Preset p = sheet(5, 5, "guard");
  CHECK(check_preset(p).empty());
  p.thickness = 0.3 * p.L;
  CHECK(check_preset(p).find("contact.thickness: 0.006 m is too thick for a spacing of L = 0.02 m") == 0);
  p.thickness = 0, p.initial_stretch = 0.1;
  CHECK(check_preset(p).find("cloth.initial_stretch: must be at least 0.2") == 0);
  p.initial_stretch = 1, p.self = "gaurd";
  CHECK(check_preset(p).find("guard") != std::string::npos);
}

}  // namespace tyglab::self_contact_test
