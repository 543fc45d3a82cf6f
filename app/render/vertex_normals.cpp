#include "app/render/cloth_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace tyglab {
namespace {

constexpr int triangles_round = 8;  ///< two in each of the quads that meet in a particle

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

/// In a cloth that has parted: of the triangles in the cells that are attached to the particle.
glm::vec3 normal_from_cells(const FloatRows& p, const Mesh& mesh, int particle) {
  const int columns = mesh.sites().columns, site = mesh.site(particle);
  glm::vec3 sum(0);
  for (int cell = 0; cell < Mesh::cells_round; ++cell) {
    if ((mesh.cells_of(particle) >> cell & 1) == 0) continue;
    const Corner offset = offset_of_cell(cell);
    const int qi = site / columns + offset.di, qj = site % columns + offset.dj;
    for (const auto& corners : quad_triangles[std::size_t((qi + qj) & 1)]) {
      glm::vec3 x[3];
      bool mine = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const int corner = mesh.corner(qi, qj, corners[k]);
        mine |= corner == particle;
        x[k] = position(row(p, corner / columns), corner % columns);
      }
      if (mine) sum += glm::cross(x[1] - x[0], x[2] - x[0]);
    }
  }
  return glm::dot(sum, sum) > 0 ? sum : glm::vec3(0, 0, 1);
}

glm::vec3 normal_from_triangles(const FloatRows& p, const Tears& tears, int i, int j) {
  if (tears.mesh() != nullptr) return normal_from_cells(p, *tears.mesh(), i * p.columns + j);
  const std::uint32_t whole = whole_triangles({p.rows, p.columns}, tears, i, j);
  glm::vec3 sum(0);
  for (int t = 0; t < triangles_round; ++t) {
    if ((whole >> t & 1) == 0) continue;
    const int qi = i - 1 + (t >> 2), qj = j - 1 + (t >> 1 & 1);
    const auto& corners = quad_triangles[(qi + qj) & 1][t & 1];
    glm::vec3 x[3];
    for (int k = 0; k < 3; ++k) x[k] = position(row(p, qi + corners[k].di), qj + corners[k].dj);
    sum += glm::cross(x[1] - x[0], x[2] - x[0]);
  }
  return glm::dot(sum, sum) > 0 ? sum : glm::vec3(0, 0, 1);
}

}  // namespace

std::uint32_t whole_triangles(const Lattice& lattice, const Tears& tears, int i, int j) {
  std::uint32_t whole = 0;
  for (int t = 0; t < triangles_round; ++t) {
    const int qi = i - 1 + (t >> 2), qj = j - 1 + (t >> 1 & 1);
    if (qi < 0 || qj < 0 || qi > lattice.rows - 2 || qj > lattice.columns - 2) continue;
    const auto& corners = quad_triangles[(qi + qj) & 1][t & 1];
    const bool mine =
        std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return qi + c.di == i && qj + c.dj == j; });
    if (mine && tears.triangle_whole(qi, qj, t & 1)) whole |= 1u << t;
  }
  return whole;
}

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

// Rows are looked at in eight lanes, so that the compiler can use SIMD.
Bounds finite_bounds(const FloatRows& p) {
  constexpr int lanes = 8;
  constexpr float most = std::numeric_limits<float>::max();
  Bounds box;
  for (int c = 0; c < 3; ++c) {
    float lo[lanes], hi[lanes];
    std::fill_n(lo, lanes, box.lo[c]), std::fill_n(hi, lanes, box.hi[c]);
    const auto take = [&](float value, int lane) {
      const bool finite = std::abs(value) <= most;  // false for NaN too
      lo[lane] = finite && value < lo[lane] ? value : lo[lane];
      hi[lane] = finite && value > hi[lane] ? value : hi[lane];
    };
    for (int i = 0; i < p.rows; ++i) {
      const float* row = p.row(i, c);
      const int columns = std::min(p.columns, p.rows * p.columns - p.absent - i * p.columns);
      int j = 0;
      for (; j + lanes <= columns; j += lanes)
        for (int lane = 0; lane < lanes; ++lane) take(row[j + lane], lane);
      for (; j < columns; ++j) take(row[j], 0);
    }
    box.lo[c] = *std::min_element(lo, lo + lanes), box.hi[c] = *std::max_element(hi, hi + lanes);
  }
  return box;
}

}  // namespace tyglab
