// Normals for smooth shading.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cloth/tears.h"

namespace tyglab {

/// Three float arrays over the particles, particle (i, j) at i·stride + j.
struct FloatPositions {
  int rows = 0, columns = 0, stride = 0;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
};

struct Normals {
  std::vector<float> x, y, z;
};

/// Normals on the front side, not of unit length: the cross product of the differences to the neighbours down and along
/// the row. Those of `beside_tears` are the sum over their whole triangles instead, so that the other side of a tear
/// does not count; without a whole triangle (0, 0, 1).
void compute_normals(const FloatPositions& positions, const Tears& tears, std::span<const std::uint32_t> beside_tears,
                     Normals& normals);

}  // namespace tyglab
