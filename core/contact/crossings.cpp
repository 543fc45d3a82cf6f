#include "core/contact/crossings.h"

#include <algorithm>
#include <cmath>

#include "core/contact/quad_pyramid.h"

namespace tyglab {
namespace {

bool all_finite(const VectorField<double>& x) {
  const auto finite = [](const Array<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  return finite(x.x) && finite(x.y) && finite(x.z);
}

/// The corners of two triangles, the shared ones first and in the same order.
struct MatchedPair {
  std::array<std::size_t, 3> a, b;
  int shared = 0;
};

MatchedPair matched(const std::array<std::size_t, 3>& a, const std::array<std::size_t, 3>& b) {
  MatchedPair pair{a, b};
  for (std::size_t n = 0; n < 3; ++n) {
    const auto from = pair.b.begin() + pair.shared;
    const auto same = std::find(from, pair.b.end(), pair.a[n]);
    if (same == pair.b.end()) continue;
    std::swap(pair.a[n], pair.a[pair.shared]), std::iter_swap(same, from);
    ++pair.shared;
  }
  return pair;
}

class CrossingSearch {
 public:
  CrossingSearch(const VectorField<double>& x, const Tears& tears, const CrossingLimits& limits)
      : x_(x), tears_(tears), lattice_(tears.lattice().sites()), limits_(limits), pyramid_(x, tears) {}

  Crossings all() {
    within(pyramid_.top());
    std::sort(found_.listed.begin(), found_.listed.end());
    return std::move(found_);
  }

 private:
  struct Placed {
    TriangleSite site;
    std::array<std::size_t, 3> corners;
    BoundingBox box;
  };

  /// Looks at the pairs of triangles of one block.
  void within(const QuadBlock& block) {
    if (block.level == 0) return in_quad(block);
    if (!found_.complete || pyramid_.is_smooth(block, block)) return;
    const QuadPyramid::Children children = pyramid_.children(block);
    for (const QuadBlock* child = children.begin(); child != children.end(); ++child) {
      within(*child);
      for (const QuadBlock* other = child + 1; other != children.end(); ++other) between(*child, *other);
    }
  }

  /// Looks at the pairs of triangles of two blocks of one level.
  void between(const QuadBlock& a, const QuadBlock& b) {
    if (!found_.complete || !pyramid_.box(a).meets(pyramid_.box(b))) return;
    if (a.level == 0) return between_quads(a, b);
    const bool neighbors = std::abs(a.row - b.row) <= 1 && std::abs(a.column - b.column) <= 1;
    if (neighbors && pyramid_.is_smooth(a, b)) return;
    for (const QuadBlock& of_a : pyramid_.children(a))
      for (const QuadBlock& of_b : pyramid_.children(b)) between(of_a, of_b);
  }

  void in_quad(const QuadBlock& quad) {
    if (whole(quad, 0) && whole(quad, 1)) look(placed(quad, 0), placed(quad, 1));
  }

  void between_quads(const QuadBlock& a, const QuadBlock& b) {
    for (int n = 0; n < 2; ++n) {
      if (!whole(a, n)) continue;
      const Placed first = placed(a, n);
      if (!first.box.meets(pyramid_.box(b))) continue;
      for (int m = 0; m < 2; ++m)
        if (whole(b, m)) look(first, placed(b, m));
    }
  }

  void look(const Placed& a, const Placed& b) {
    if (!a.box.meets(b.box)) return;
    constexpr std::int64_t between_questions = 1024;
    if (tested_ == limits_.tested || (tested_ % between_questions == 0 && limits_.stop && limits_.stop())) {
      found_.complete = false;
      return;
    }
    ++tested_;
    const MatchedPair pair = matched(a.corners, b.corners);
    if (!triangles_cross(triangle(pair.a), triangle(pair.b), pair.shared)) return;
    ++found_.pairs;
    found_.around_sites += around_one_site(a.corners, b.corners);
    if (found_.listed.size() == limits_.listed) return;
    const int first = triangle_number(lattice_, a.site), second = triangle_number(lattice_, b.site);
    found_.listed.push_back({std::min(first, second), std::max(first, second)});
  }

  bool whole(const QuadBlock& quad, int which) const {
    return tears_.mesh() != nullptr || tears_.triangle_whole(quad.row, quad.column, which);
  }

  Placed placed(const QuadBlock& quad, int which) const {
    Placed placed{{quad.row, quad.column, which}, {}, no_box()};
    const auto& corners = quad_triangles[std::size_t((quad.row + quad.column) & 1)][std::size_t(which)];
    for (std::size_t n = 0; n < 3; ++n) {
      placed.corners[n] = particle_at(quad, corners[n]);
      placed.box.include(position(placed.corners[n]));
    }
    return placed;
  }

  /// Copies that have not moved apart yet are one particle: cells that are attached to them touch there as before.
  std::size_t particle_at(const QuadBlock& quad, Corner at) const {
    const int site = (quad.row + at.di) * lattice_.columns + quad.column + at.dj;
    if (tears_.mesh() == nullptr || !tears_.mesh()->parted(site)) return std::size_t(site);
    std::size_t particle = std::size_t(tears_.mesh()->corner(quad.row, quad.column, at));
    for (int cell = 0; cell < Mesh::cells_round; ++cell) {
      const std::size_t other = std::size_t(tears_.mesh()->holder(site, cell));
      if (other < particle && position(other) == position(particle)) particle = other;
    }
    return particle;
  }
  bool around_one_site(const std::array<std::size_t, 3>& a, const std::array<std::size_t, 3>& b) const {
    const Mesh* mesh = tears_.mesh();
    return mesh != nullptr && std::any_of(a.begin(), a.end(), [&](std::size_t one) {
             return std::any_of(b.begin(), b.end(), [&](std::size_t other) {
               return one != other && mesh->site(int(one)) == mesh->site(int(other));
             });
           });
  }
  glm::dvec3 position(std::size_t p) const { return {x_.x[p], x_.y[p], x_.z[p]}; }
  Triangle triangle(const std::array<std::size_t, 3>& p) const {
    return {position(p[0]), position(p[1]), position(p[2])};
  }

  const VectorField<double>& x_;
  const Tears& tears_;
  const Lattice lattice_;
  const CrossingLimits limits_;
  const QuadPyramid pyramid_;
  Crossings found_;
  std::int64_t tested_ = 0;
};

}  // namespace

Crossings count_crossings(const VectorField<double>& x, const Tears& tears, const CrossingLimits& limits) {
  if (tears.lattice().sites().rows < 2 || tears.lattice().columns < 2 || !all_finite(x)) return {};
  return CrossingSearch(x, tears, limits).all();
}

}  // namespace tyglab
