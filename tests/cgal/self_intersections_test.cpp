// The crossing triangles of crumpled and folded cloths against those that CGAL finds.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/crossings.h"
#include "tests/support/scenes.h"

namespace tyglab::self_intersections_test {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The cloth's whole triangles, and the number of each.
struct ClothMesh {
  Mesh mesh;
  std::vector<int> numbers;
};

ClothMesh mesh_of(const VectorField<double>& x, const Tears& tears) {
  const Lattice& lattice = tears.lattice();
  ClothMesh cloth;
  std::vector<Mesh::Vertex_index> vertices;
  for (std::size_t p = 0; p < std::size_t(lattice.size()); ++p)
    vertices.push_back(cloth.mesh.add_vertex({x.x[p], x.y[p], x.z[p]}));
  for (int number = 0; number < 2 * (lattice.rows - 1) * (lattice.columns - 1); ++number) {
    const TriangleSite site = triangle_at(lattice, number);
    if (!tears.triangle_whole(site.i, site.j, site.which)) continue;
    const auto& corners = quad_triangles[std::size_t((site.i + site.j) % 2)][std::size_t(site.which)];
    const auto vertex = [&](std::size_t n) {
      return vertices[std::size_t((site.i + corners[n].di) * lattice.columns + site.j + corners[n].dj)];
    };
    const auto face = cloth.mesh.add_face(vertex(0), vertex(1), vertex(2));
    REQUIRE(face != Mesh::null_face());
    cloth.numbers.push_back(number);
  }
  return cloth;
}

std::vector<std::array<int, 2>> pairs_by_cgal(const VectorField<double>& x, const Tears& tears) {
  const ClothMesh cloth = mesh_of(x, tears);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(cloth.mesh, std::back_inserter(found));
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [a, b] : found) {
    const int first = cloth.numbers[a.idx()], second = cloth.numbers[b.idx()];
    pairs.push_back({std::min(first, second), std::max(first, second)});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Compares a cloth by the position of each particle (m), whole and torn at random. Returns how many pairs it has.
template <class Position>
std::int64_t compared(const Lattice& lattice, Position position) {
  const VectorField<double> x = test::shaped(lattice, position);
  const CrossingLimits list_all{1 << 30};
  Tears tears(lattice);
  const Crossings whole = count_crossings(x, tears, list_all);
  CHECK(whole.listed == pairs_by_cgal(x, tears));
  test::Random random(3);
  for (int n = 0; n < lattice.size() / 8; ++n)
    tears.tear(random.below(stretch_directions), random.below(lattice.rows), random.below(lattice.columns));
  CHECK(count_crossings(x, tears, list_all).listed == pairs_by_cgal(x, tears));
  return whole.pairs;
}

TEST_CASE("crumpled cloths cross themselves in the pairs that CGAL finds") {
  test::Random random(7);
  for (const double noise : {0.2, 0.5, 0.8, 2.0, 10.0}) {
    CAPTURE(noise);
    const auto moved = [&](double to) { return to + random.uniform(-noise, noise); };
    const std::int64_t pairs =
        compared({40, 56}, [&](int i, int j) { return 0.01 * glm::dvec3(moved(j), moved(-i), moved(0)); });
    CHECK((pairs > 0) == (noise > 0.4));
  }
}

TEST_CASE("folded strips cross themselves in the pairs that CGAL finds") {
  const auto zigzag = [](int j) { return std::abs(j % 16 - 8); };
  // Layers exactly on each other, layers apart, and layers that pass through each other.
  CHECK(compared({12, 60}, [&](int i, int j) { return glm::dvec3(zigzag(j), -i, 0); }) > 1000);
  CHECK(compared({12, 60}, [&](int i, int j) { return 0.1 * glm::dvec3(zigzag(j), -i, 0.7 * zigzag(j)); }) > 1000);
  CHECK(compared({12, 60}, [&](int i, int j) { return 0.1 * glm::dvec3(zigzag(j), -i, 0.1 * j); }) == 0);
  CHECK(compared({12, 60},
                 [&](int i, int j) { return 0.1 * glm::dvec3(zigzag(j), -i, j % 16 == 8 ? 0.2 : 0.03 * j); }) >= 0);
  // Rolled up, with layers that grow into each other.
  CHECK(compared({12, 80}, [&](int i, int j) {
          const double turn = 0.3 * j, radius = 1 + 0.3 * std::sin(1.3 * turn);
          return glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), 0.1 * i);
        }) > 100);
}

}  // namespace tyglab::self_intersections_test
