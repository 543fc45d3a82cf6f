#include "app/base/viewport.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace tyglab {

int Viewport::tile_at(glm::vec2 p) const {
  const glm::vec2 inside = (p - box.lo) / glm::max(size(), glm::vec2(1));
  return std::clamp(int(inside.y), 0, rows - 1) * columns + std::clamp(int(inside.x), 0, columns - 1);
}

void Viewport::divide(int pictures) {
  // The division whose pictures are nearest to square.
  const glm::vec2 whole = box.hi - box.lo;
  float best = std::numeric_limits<float>::infinity();
  for (int across = 1; across <= pictures; ++across) {
    const int down = (pictures + across - 1) / across;
    if (across * down - pictures >= across) continue;  // an empty row
    const float shape = std::abs(std::log(whole.x / float(across) / std::max(whole.y / float(down), 1.f)));
    if (shape < best) best = shape, columns = across, rows = down;
  }
}

}  // namespace tyglab
