// Boxes around the quads of a cloth, and around blocks of 2 x 2, 4 x 4, … of them, for finding parts that meet.
#pragma once

#include <array>
#include <vector>

#include "core/cloth/state.h"

namespace tyglab {

/// An interval for each coordinate, m.
struct BoundingBox {
  std::array<double, 3> low, high;

  void include(const glm::dvec3& point);
  void include(const BoundingBox& other);
  /// Whether the closed boxes have a common point.
  bool meets(const BoundingBox& other) const;
};
/// The empty one.
BoundingBox no_box();

/// What the edges of a block along its rows, and those along its columns, differ from one end to the other, m.
struct EdgeBoxes {
  BoundingBox along_rows, along_columns;
};

/// A block: its level (0: quads, each level twice as large), row and column there.
struct QuadBlock {
  int level, row, column;
};

class QuadPyramid {
 public:
  /// `x`: dense and finite positions of at least 2 x 2 particles, m.
  QuadPyramid(const VectorField<double>& x, const Tears& tears);

  QuadBlock top() const { return {int(levels_.size()) - 1, 0, 0}; }
  /// Of its particles.
  const BoundingBox& box(const QuadBlock& block) const { return levels_[block.level].boxes[index(block)]; }
  /// Blocks of the next finer level, up to four; of a block above level 0.
  struct Children {
    std::array<QuadBlock, 4> blocks;
    int count = 0;
    const QuadBlock* begin() const { return blocks.data(); }
    const QuadBlock* end() const { return blocks.data() + count; }
  };
  Children children(const QuadBlock& block) const;
  /// Whether the triangles of two blocks, which are of one level above 0 and equal or neighbors (by a side or corner),
  /// certainly cross neither each other nor themselves: there are directions u and w such that u·E and w·S are larger
  /// than |w·E| and |u·S|, for all their edges E along rows and S along columns. Two points of the blocks that are
  /// (s, t) apart on the lattice are joined by a way within them on which neither s nor t turns back, and each triangle
  /// has one edge of either kind. So along it s u·Δx + t w·Δx > 0, and the points are not the same. Torn springs do
  /// not matter.
  bool is_smooth(const QuadBlock& a, const QuadBlock& b) const;

 private:
  struct Level {
    int rows, columns;
    std::vector<BoundingBox> boxes;
    std::vector<EdgeBoxes> edges;  ///< none on level 0
  };
  std::size_t index(const QuadBlock& block) const {
    return std::size_t(block.row) * levels_[block.level].columns + block.column;
  }
  void add_quads(const VectorField<double>& x, const Lattice& lattice, const Mesh* mesh);
  void add_edges(const VectorField<double>& x, const Lattice& lattice, const Mesh* mesh);
  void add_level();

  std::vector<Level> levels_;
};

}  // namespace tyglab
