// F_curl (core/forces/curl.cpp) on the rows of a pair, in SIMD: what a scene without a rest curvature never calls. The
// upper row of a tetrahedron owns it, so that a pair adds its own before its springs move its particles.
#pragma once

#include <cstddef>
#include <vector>

#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab::cpu {

/// Tetrahedra x, u₊, u₋, v in a row, with the energies w·det(v - x, u₊ - x, u₋ - x).
template <class R>
struct TetrahedraRow {
  /// Of a point's first column: a component of its positions, and of the forces to subtract from what acts on it.
  struct Point {
    const R* x;
    R* f;
  };
  Point at, ahead, behind, beside;
  std::ptrdiff_t stride;  ///< elements from one component to the next
  const R* weights;       ///< N/m² in each column; 0: none there
  int begin, end;         ///< columns
};
template <class R>
void add_tetrahedra(const TetrahedraRow<R>& row);

/// The force on a pair of rows, i and i + 1, from tetrahedra that begin there.
template <class R>
class CurlPass {
 public:
  /// Takes the memory that the scene needs.
  void allocate(const Preset& preset);
  /// Takes the scene's constants, before each pass; not `acts`: as of a scene without a rest curvature.
  void begin(const Preset& preset, bool acts);
  bool acts() const { return warp_ != 0 || weft_ != 0; }
  /// x: rows i to i + 3, as far as there are; f: the forces to subtract from those on them.
  void add(const Tears& tears, int i, const R* x, std::ptrdiff_t stride, R* const (&f)[4]);
  std::size_t bytes() const { return weights_.capacity() * sizeof(R); }

 private:
  /// Along a thread, and to the neighbor across it, on the side of the larger or the smaller index.
  struct Half {
    int di, dj, side;
  };
  void add_half(const Tears& tears, const Half& half, int i, int center, const R* x, std::ptrdiff_t stride,
                R* const (&f)[4]);
  void weigh(const Tears& tears, const Half& half, int center);

  double warp_ = 0, weft_ = 0;  ///< Bκ₀/(2L²)
  std::vector<R> weights_;
};

}  // namespace tyglab::cpu
