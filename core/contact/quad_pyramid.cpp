#include "core/contact/quad_pyramid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tyglab {
namespace {

glm::dvec3 position_in(const VectorField<double>& x, std::size_t p) {
  return {x.x[p], x.y[p], x.z[p]};
}

glm::dvec3 middle(const BoundingBox& box) {
  return {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2, (box.low[2] + box.high[2]) / 2};
}

/// Bounds of u·e for e in a box.
struct Range {
  double low = 0, high = 0;
  double rounding = 0;  ///< more than what errors of rounding change
};

Range products(const glm::dvec3& u, const BoundingBox& box) {
  Range range;
  double size = 0;
  for (int n = 0; n < 3; ++n) {
    const double a = u[n] * box.low[n], b = u[n] * box.high[n];
    range.low += std::min(a, b), range.high += std::max(a, b);
    size += std::max(std::abs(a), std::abs(b));
  }
  constexpr double least = 1e-300;  // more than what underflow takes
  range.rounding = 16 * std::numeric_limits<double>::epsilon() * size + least;
  return range;
}

double least_in(const Range& range) {
  return range.low - range.rounding;
}
double most_in(const Range& range) {
  return std::max(std::abs(range.low), std::abs(range.high)) + range.rounding;
}

void include(EdgeBoxes& all, const EdgeBoxes& part) {
  all.along_rows.include(part.along_rows), all.along_columns.include(part.along_columns);
}

}  // namespace

BoundingBox no_box() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {{inf, inf, inf}, {-inf, -inf, -inf}};
}

void BoundingBox::include(const glm::dvec3& point) {
  for (int n = 0; n < 3; ++n) low[n] = std::min(low[n], point[n]), high[n] = std::max(high[n], point[n]);
}

void BoundingBox::include(const BoundingBox& other) {
  for (int n = 0; n < 3; ++n) low[n] = std::min(low[n], other.low[n]), high[n] = std::max(high[n], other.high[n]);
}

bool BoundingBox::meets(const BoundingBox& other) const {
  for (int n = 0; n < 3; ++n)
    if (low[n] > other.high[n] || other.low[n] > high[n]) return false;
  return true;
}

QuadPyramid::QuadPyramid(const VectorField<double>& x, const Tears& tears) {
  const Lattice lattice = tears.lattice().sites();
  assert(lattice.rows >= 2 && lattice.columns >= 2);
  add_quads(x, lattice, tears.mesh());
  do {
    add_level();
    if (levels_.size() == 2) add_edges(x, lattice, tears.mesh());
  } while (levels_.back().boxes.size() > 1);
}

void QuadPyramid::add_quads(const VectorField<double>& x, const Lattice& lattice, const Mesh* mesh) {
  Level quads{lattice.rows - 1, lattice.columns - 1, {}, {}};
  quads.boxes.reserve(std::size_t(quads.rows) * quads.columns);
  for (int i = 0; i < quads.rows; ++i)
    for (int j = 0; j < quads.columns; ++j) {
      BoundingBox& box = quads.boxes.emplace_back(no_box());
      for (const Corner at : {Corner{0, 0}, Corner{0, 1}, Corner{1, 0}, Corner{1, 1}}) {
        const int corner = mesh != nullptr ? mesh->corner(i, j, at) : (i + at.di) * lattice.columns + j + at.dj;
        box.include(position_in(x, std::size_t(corner)));
      }
    }
  levels_.push_back(std::move(quads));
}

/// Of the blocks of level 1. An edge between two blocks is one of both.
void QuadPyramid::add_edges(const VectorField<double>& x, const Lattice& lattice, const Mesh* mesh) {
  Level& level = levels_[1];
  for (int row = 0; row < level.rows; ++row)
    for (int column = 0; column < level.columns; ++column) {
      EdgeBoxes& edges = level.edges[index({1, row, column})];
      const int last_i = std::min(2 * row + 2, lattice.rows - 1),
                last_j = std::min(2 * column + 2, lattice.columns - 1);
      for (int i = 2 * row; i <= last_i; ++i)
        for (int j = 2 * column; j <= last_j; ++j) {
          const std::size_t p = std::size_t(i) * lattice.columns + j;
          const glm::dvec3 from = position_in(x, p);
          // Where the cloth has parted, edges say nothing of the way from one cell to the next.
          if (constexpr double inf = std::numeric_limits<double>::infinity(); mesh != nullptr && mesh->parted(int(p)))
            edges.along_rows.include(glm::dvec3(inf)), edges.along_rows.include(glm::dvec3(-inf));
          if (j < last_j) edges.along_rows.include(position_in(x, p + 1) - from);
          if (i < last_i) edges.along_columns.include(position_in(x, p + lattice.columns) - from);
        }
    }
}

void QuadPyramid::add_level() {
  const Level& finer = levels_.back();
  Level level{(finer.rows + 1) / 2, (finer.columns + 1) / 2, {}, {}};
  const std::size_t size = std::size_t(level.rows) * level.columns;
  level.boxes.assign(size, no_box());
  level.edges.assign(size, {no_box(), no_box()});
  for (int row = 0; row < finer.rows; ++row)
    for (int column = 0; column < finer.columns; ++column) {
      const std::size_t from = std::size_t(row) * finer.columns + column;
      const std::size_t to = std::size_t(row / 2) * level.columns + column / 2;
      level.boxes[to].include(finer.boxes[from]);
      if (!finer.edges.empty()) include(level.edges[to], finer.edges[from]);
    }
  levels_.push_back(std::move(level));
}

QuadPyramid::Children QuadPyramid::children(const QuadBlock& block) const {
  assert(block.level > 0);
  const Level& finer = levels_[block.level - 1];
  Children children;
  for (int row = 2 * block.row; row < std::min(2 * block.row + 2, finer.rows); ++row)
    for (int column = 2 * block.column; column < std::min(2 * block.column + 2, finer.columns); ++column)
      children.blocks[children.count++] = {block.level - 1, row, column};
  return children;
}

bool QuadPyramid::is_smooth(const QuadBlock& a, const QuadBlock& b) const {
  assert(a.level == b.level && a.level > 0);
  EdgeBoxes edges = levels_[a.level].edges[index(a)];
  include(edges, levels_[b.level].edges[index(b)]);
  // The directions that fit the middle edges best: u·E = w·S = 1, w·E = u·S = 0.
  const glm::dvec3 E = middle(edges.along_rows), S = middle(edges.along_columns);
  const double EE = glm::dot(E, E), ES = glm::dot(E, S), SS = glm::dot(S, S), area = EE * SS - ES * ES;
  const glm::dvec3 u = (SS * E - ES * S) / area, w = (EE * S - ES * E) / area;
  if (!(area > 0) || !std::isfinite(glm::dot(u, u) + glm::dot(w, w))) return false;
  const double along = std::min(least_in(products(u, edges.along_rows)), least_in(products(w, edges.along_columns)));
  const double across = std::max(most_in(products(w, edges.along_rows)), most_in(products(u, edges.along_columns)));
  return along > across;
}

}  // namespace tyglab
