#include "core/analysis/plain_forces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/cloth/state.h"

namespace tyglab {
namespace {

glm::dvec3 vector_at(const double* values, std::size_t p) {
  return {values[3 * p], values[3 * p + 1], values[3 * p + 2]};
}

void add(double* to, std::size_t p, const glm::dvec3& force) {
  for (int c = 0; c < 3; ++c) to[3 * p + c] += force[c];
}

}  // namespace

PlainForces::PlainForces(const Preset& preset) : preset_(preset) {
  for (const std::uint8_t pinned : pinned_particles(preset)) free_.push_back(pinned == 0);
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) {
      add_springs(i, j);
      if (i + 1 < preset.rows && j + 1 < preset.columns) add_triangles(i, j);
    }
}

/// Those from (i, j) to the right and downward, each once (2.4, 2.7).
void PlainForces::add_springs(int i, int j) {
  const auto add_one = [&](int to_i, int to_j, double rest, bool bending) {
    if (to_i >= preset_.rows || to_j < 0 || to_j >= preset_.columns) return;
    const auto number = [&](int row, int column) { return std::size_t(row) * preset_.columns + column; };
    springs_.push_back({number(i, j), number(to_i, to_j), rest, bending});
  };
  const double L = preset_.L, diagonal = std::sqrt(2.0) * L;
  add_one(i, j + 1, L, false), add_one(i + 1, j, L, false);
  add_one(i + 1, j + 1, diagonal, false), add_one(i + 1, j - 1, diagonal, false);
  if (preset_.k_b > 0) add_one(i, j + 2, 2 * L, true), add_one(i + 2, j, 2 * L, true);
}

/// The quad below and to the right of (i, j), in the diamond pattern; the side of the normal does not matter to N
/// (N·W).
void PlainForces::add_triangles(int i, int j) {
  if (preset_.W == glm::dvec3(0)) return;
  const std::size_t a = std::size_t(i) * preset_.columns + j, b = a + 1, c = a + preset_.columns, d = c + 1;
  if ((i + j) % 2 == 0)
    triangles_.push_back({a, c, d}), triangles_.push_back({a, d, b});
  else
    triangles_.push_back({a, c, b}), triangles_.push_back({c, d, b});
}

void PlainForces::pull(const Spring& s, const double* x, const double* v, double* F) const {
  const glm::dvec3 apart = vector_at(x, s.to) - vector_at(x, s.from);
  const double length = glm::length(apart), stretch = length - s.rest;
  glm::dvec3 force(0);
  if (s.bending) {
    if (stretch < 0 && length >= 1e-9 * s.rest) force = preset_.k_b * stretch / length * apart;  // (2.8)
  } else {
    if (stretch > 0) force = preset_.k_s * stretch / length * apart;     // (2.5)
    force -= preset_.k_d * (vector_at(v, s.from) - vector_at(v, s.to));  // (2.6)
  }
  add(F, s.from, force), add(F, s.to, -force);
}

void PlainForces::blow(const std::array<std::size_t, 3>& corners, const double* x, double* F) const {
  const glm::dvec3 first = vector_at(x, corners[0]);
  const glm::dvec3 area = glm::cross(vector_at(x, corners[1]) - first, vector_at(x, corners[2]) - first);
  const double size2 = glm::dot(area, area);
  if (size2 == 0) return;
  for (const std::size_t p : corners) add(F, p, glm::dot(area, preset_.W) / (3 * size2) * area);  // (2.16)
}

void PlainForces::accelerations(const double* x, const double* v, double* a) const {
  std::fill_n(a, 3 * particles(), 0.0);
  for (const Spring& spring : springs_) pull(spring, x, v, a);
  for (const auto& corners : triangles_) blow(corners, x, a);
  for (std::size_t p = 0; p < particles(); ++p)
    for (int c = 0; c < 3; ++c) {
      double& component = a[3 * p + c];
      component = free_[p] != 0 ? component / preset_.m - (c == 1 ? preset_.g : 0) : 0;
    }
}

}  // namespace tyglab
