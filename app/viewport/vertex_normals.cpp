#include "app/viewport/vertex_normals.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tyglab {
namespace {

struct RowPointers {
  const float *x, *y, *z;
};

RowPointers row(const FloatRows& p, int i) {
  return {p.row(i, 0), p.row(i, 1), p.row(i, 2)};
}

/// Down × along at columns [1, n-1), from the rows above and below and the row itself.
void inner_row(const RowPointers& above, const RowPointers& below, const RowPointers& here, int columns, float* nx,
               float* ny, float* nz) {
  for (int j = 1; j + 1 < columns; ++j) {
    const float ux = below.x[j] - above.x[j], uy = below.y[j] - above.y[j], uz = below.z[j] - above.z[j];
    const float wx = here.x[j + 1] - here.x[j - 1], wy = here.y[j + 1] - here.y[j - 1],
                wz = here.z[j + 1] - here.z[j - 1];
    nx[j] = uy * wz - uz * wy;
    ny[j] = uz * wx - ux * wz;
    nz[j] = ux * wy - uy * wx;
  }
}

glm::vec3 position(const RowPointers& r, int j) {
  return {r.x[j], r.y[j], r.z[j]};
}

glm::vec3 normal_from_triangles(const FloatRows& p, const Tears& tears, int i, int j) {
  glm::vec3 sum(0);
  for (int qi = std::max(i - 1, 0); qi <= std::min(i, p.rows - 2); ++qi) {
    for (int qj = std::max(j - 1, 0); qj <= std::min(j, p.columns - 2); ++qj) {
      for (int which = 0; which < 2; ++which) {
        const auto& corners = quad_triangles[(qi + qj) & 1][which];
        const bool mine = std::any_of(corners.begin(), corners.end(),
                                      [&](const Corner& c) { return qi + c.di == i && qj + c.dj == j; });
        if (!mine || !tears.triangle_whole(qi, qj, which)) continue;
        glm::vec3 x[3];
        for (int k = 0; k < 3; ++k) x[k] = position(row(p, qi + corners[k].di), qj + corners[k].dj);
        sum += glm::cross(x[1] - x[0], x[2] - x[0]);
      }
    }
  }
  return glm::dot(sum, sum) > 0 ? sum : glm::vec3(0, 0, 1);
}

}  // namespace

void compute_normals(const FloatRows& p, const Tears& tears, std::span<const std::uint32_t> beside_tears,
                     float* normals) {
  const std::size_t y = std::size_t(p.component), z = 2 * y;
  const auto set = [&](std::size_t index, glm::vec3 n) {
    normals[index] = n.x, normals[index + y] = n.y, normals[index + z] = n.z;
  };
  for (int i = 0; i < p.rows; ++i) {
    const RowPointers above = row(p, std::max(i - 1, 0)), below = row(p, std::min(i + 1, p.rows - 1)), here = row(p, i);
    const std::size_t start = std::size_t(i) * p.stride();
    float* to = normals + start;
    inner_row(above, below, here, p.columns, to, to + y, to + z);
    for (const int j : {0, p.columns - 1}) {
      const glm::vec3 down = position(below, j) - position(above, j);
      const glm::vec3 along = position(here, std::min(j + 1, p.columns - 1)) - position(here, std::max(j - 1, 0));
      set(start + j, glm::cross(down, along));
    }
  }
  for (const std::uint32_t index : beside_tears) {
    set(index, normal_from_triangles(p, tears, int(index) / p.stride(), int(index) % p.stride()));
  }
}

}  // namespace tyglab
