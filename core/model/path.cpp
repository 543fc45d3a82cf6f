#include <algorithm>
#include <cassert>

#include "core/model/preset.h"

namespace tyglab {

glm::dvec3 on_path(const std::vector<PathKey>& path, double t) {
  assert(!path.empty());
  const auto next = std::find_if(path.begin(), path.end(), [&](const PathKey& key) { return key.t > t; });
  if (next == path.begin()) return next->x;
  const PathKey& last = *(next - 1);
  if (next == path.end()) return last.x;
  return last.x + ((t - last.t) / (next->t - last.t)) * (next->x - last.x);
}

}  // namespace tyglab
