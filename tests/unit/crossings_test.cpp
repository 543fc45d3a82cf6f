// The count of crossing triangles: the search against all pairs, and cloths whose count is known.
#include "core/contact/crossings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/simulation.h"
#include "tests/support/scenes.h"

namespace tyglab::crossings_test {

using Corners = std::array<Corner, 3>;  // as rows and columns of the lattice

/// All whole triangles and every pair of them.
Crossings by_all_pairs(const VectorField<double>& x, const Tears& tears) {
  const Lattice& lattice = tears.lattice();
  struct Whole {
    int number;
    std::array<int, 3> p;
  };
  std::vector<Whole> whole;
  for (int i = 0; i + 1 < lattice.rows; ++i)
    for (int j = 0; j + 1 < lattice.columns; ++j)
      for (int which = 0; which < 2; ++which) {
        if (!tears.triangle_whole(i, j, which)) continue;
        Whole& one = whole.emplace_back(Whole{triangle_number(lattice, {i, j, which}), {}});
        const Corners& corners = quad_triangles[std::size_t((i + j) % 2)][std::size_t(which)];
        for (std::size_t n = 0; n < 3; ++n) one.p[n] = (i + corners[n].di) * lattice.columns + j + corners[n].dj;
      }
  Crossings found;
  const auto look = [&](const Whole& a, const Whole& b) {
    std::vector<int> first, second;
    for (const int p : a.p)
      if (std::count(b.p.begin(), b.p.end(), p) > 0) first.push_back(p);
    second = first;
    const int shared = int(first.size());
    for (const int p : a.p)
      if (std::count(first.begin(), first.end(), p) == 0) first.push_back(p);
    for (const int p : b.p)
      if (std::count(second.begin(), second.end(), p) == 0) second.push_back(p);
    const auto triangle = [&](const std::vector<int>& p) {
      const auto at = [&](int n) { return glm::dvec3(x.x[p[n]], x.y[p[n]], x.z[p[n]]); };
      return Triangle{at(0), at(1), at(2)};
    };
    if (!triangles_cross(triangle(first), triangle(second), shared)) return;
    ++found.pairs;
    found.listed.push_back({a.number, b.number});
  };
  for (std::size_t n = 0; n < whole.size(); ++n)
    for (std::size_t m = n + 1; m < whole.size(); ++m) look(whole[n], whole[m]);
  return found;
}

const CrossingLimits list_all{1 << 30};

void check_same(const VectorField<double>& x, const Tears& tears) {
  const Crossings fast = count_crossings(x, tears, list_all), slow = by_all_pairs(x, tears);
  CHECK(fast.complete);
  CHECK(fast.pairs == slow.pairs);
  CHECK(fast.listed == slow.listed);
}

TEST_CASE("flat, sheared and hanging cloths do not cross themselves") {
  Simulation simulation(test::cloth(17, 17));
  CHECK(count_crossings(simulation.read().x, simulation.tears()).pairs == 0);
  simulation.advance(200);
  CHECK(count_crossings(simulation.read().x, simulation.tears()).pairs == 0);
  const Lattice lattice{9, 12};
  // Inclined, so that rounding moves particles off the plane.
  const auto flat = test::shaped(lattice, [](int i, int j) {
    return glm::dvec3(0.1 * j + 0.03 * i, 0.07 * i, 0.3 * (0.1 * j) - 0.9 * (0.07 * i));
  });
  CHECK(count_crossings(flat, Tears(lattice)).pairs == 0);
  CHECK(by_all_pairs(flat, Tears(lattice)).pairs == 0);
}

TEST_CASE("large blocks of a flat or waving cloth are told at one look, and a sharp fold is not") {
  const Lattice lattice{129, 129};
  CrossingLimits none_tested;
  none_tested.tested = 0;
  const auto waving = [&](double height) {
    return test::shaped(lattice, [&](int i, int j) {
      return glm::dvec3(0.01 * j, -0.01 * i, height * std::sin(0.1 * i) * std::cos(0.07 * j));
    });
  };
  CHECK(count_crossings(waving(0), Tears(lattice), none_tested).complete);
  CHECK(count_crossings(waving(0.05), Tears(lattice), none_tested).complete);
  const auto folded = test::shaped(
      lattice, [](int i, int j) { return glm::dvec3(0.01 * std::abs(j - 64), -0.01 * i, 1e-3 * std::max(j - 64, 0)); });
  CHECK_FALSE(count_crossings(folded, Tears(lattice), none_tested).complete);
  CHECK(count_crossings(folded, Tears(lattice)).pairs == 0);
}

TEST_CASE("the search finds what a look at all pairs finds: crumpled, folded, rolled up and torn cloths") {
  const Lattice lattice{13, 18};
  test::Random random(5);
  for (const double noise : {0.03, 0.4, 0.8, 2.0}) {
    CAPTURE(noise);
    const auto crumpled = test::shaped(lattice, [&](int i, int j) {
      const auto moved = [&] { return random.uniform(-noise, noise); };
      return glm::dvec3(j + moved(), -i + moved(), moved());
    });
    Tears tears(lattice);
    check_same(crumpled, tears);
    for (int n = 0; n < 60; ++n)
      tears.tear(random.below(stretch_directions), random.below(lattice.rows), random.below(lattice.columns));
    check_same(crumpled, tears);
  }
  // Folded in a plane: layers lie exactly on each other.
  const auto folded = test::shaped(lattice, [](int i, int j) { return glm::dvec3(std::abs(j % 8 - 4), -i, 0); });
  check_same(folded, Tears(lattice));
  CHECK(count_crossings(folded, Tears(lattice)).pairs > 1000);
  const auto rolled = [&](double radius) {
    return test::shaped(lattice, [&](int i, int j) {
      const double turn = 0.8 * j;
      return glm::dvec3((1 + radius * turn) * std::cos(turn), (1 + radius * turn) * std::sin(turn), i);
    });
  };
  check_same(rolled(0), Tears(lattice));
  CHECK(count_crossings(rolled(0), Tears(lattice)).pairs > 0);
  check_same(rolled(0.3), Tears(lattice));
  CHECK(count_crossings(rolled(0.3), Tears(lattice)).pairs == 0);
  // All in one point, or on one line.
  const Lattice small{5, 6};
  check_same(test::shaped(small, [](int, int) { return glm::dvec3(1, 2, 3); }), Tears(small));
  check_same(test::shaped(small, [](int i, int) { return glm::dvec3(i, 2 * i, 3); }), Tears(small));
}

TEST_CASE("no block is taken for smooth in which a single corner is turned over") {
  test::Random random(11);
  int wrong = 0, crossing = 0;
  constexpr int cloths = 3000;
  for (int n = 0; n < cloths; ++n) {
    const Lattice lattice{3 + random.below(4), 3 + random.below(4)};
    const double noise = random.uniform(0.2, 0.7), height = n % 2 == 0 ? 0 : noise;
    const auto x = test::shaped(lattice, [&](int i, int j) {
      const double across = random.uniform(-noise, noise), down = random.uniform(-noise, noise);
      return glm::dvec3(j + across, -i + down, random.uniform(-height, height));
    });
    const std::int64_t pairs = count_crossings(x, Tears(lattice)).pairs;
    wrong += pairs != by_all_pairs(x, Tears(lattice)).pairs;
    crossing += pairs > 0;
  }
  CHECK(wrong == 0);
  CHECK(crossing > cloths / 10);
  CHECK(crossing < cloths * 9 / 10);
}

/// A ribbon of two rows along x that turns back above itself, and goes down through its second quad.
VectorField<double> through_itself(const Lattice& lattice) {
  return test::shaped(lattice, [&](int i, int j) {
    const double along[] = {0, 1, 2, 3, 3.5, 2.5, 1.3, 1.3}, up[] = {0, 0, 0, 0, 1, 1.5, 0.6, -0.4};
    return glm::dvec3(along[j], up[j], (i + 0.1) * (j >= 5 ? 0.9 : 1));
  });
}

TEST_CASE("a ribbon that passes through itself, until the triangles there are torn") {
  const Lattice lattice{2, 8};
  const VectorField<double> x = through_itself(lattice);
  Tears tears(lattice);
  check_same(x, tears);
  const Crossings found = count_crossings(x, tears, list_all);
  CHECK(found.pairs == 3);
  for (const auto& [first, second] : found.listed) {
    CHECK(triangle_at(lattice, first).j == 1);
    CHECK(triangle_at(lattice, second).j == 6);
  }
  tears.tear(1, 0, 6);  // the upper end of the quad that comes through
  tears.tear(1, 0, 7);
  CHECK(count_crossings(x, tears).pairs == 0);
  CHECK(by_all_pairs(x, tears).pairs == 0);
}

TEST_CASE("limits of the list and of the search") {
  const Lattice lattice{2, 8};
  const VectorField<double> x = through_itself(lattice);
  CrossingLimits limits;
  limits.listed = 2;
  CHECK(count_crossings(x, Tears(lattice), limits).pairs == 3);
  CHECK(count_crossings(x, Tears(lattice), limits).listed.size() == 2);
  limits.tested = 1;
  CHECK_FALSE(count_crossings(x, Tears(lattice), limits).complete);
  limits = {};
  limits.stop = [] { return true; };
  CHECK_FALSE(count_crossings(x, Tears(lattice), limits).complete);
}

TEST_CASE("threads have no triangles, and positions that are not finite no crossings") {
  const Lattice thread{9, 1}, lattice{2, 8};
  CHECK(count_crossings(test::shaped(thread, [](int, int) { return glm::dvec3(0); }), Tears(thread)).pairs == 0);
  VectorField<double> x = through_itself(lattice);
  x.y[3] = std::nan("");
  CHECK(count_crossings(x, Tears(lattice)).pairs == 0);
  x.y[3] = HUGE_VAL;
  CHECK(count_crossings(x, Tears(lattice)).pairs == 0);
  // Differences that overflow.
  x = test::shaped(lattice, [](int i, int j) { return 1.7e308 * glm::dvec3(j % 2 ? 1 : -1, i, 0); });
  CHECK(count_crossings(x, Tears(lattice)).pairs > 0);
}

TEST_CASE("numbers of triangles and their places") {
  const Lattice lattice{4, 6};
  int next = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 5; ++j)
      for (int which = 0; which < 2; ++which) {
        CHECK(triangle_number(lattice, {i, j, which}) == next);
        const TriangleSite site = triangle_at(lattice, next++);
        CHECK((site.i == i && site.j == j && site.which == which));
      }
}

}  // namespace tyglab::crossings_test
