
#include "app/render/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace tyglab {
namespace {

constexpr float turn = 2 * std::numbers::pi_v<float>;

/// Two triangles for each cell of a grid of (rows + 1) x (columns + 1) vertices, outside where the columns run to the
/// right and the rows down.
void add_grid(std::vector<std::uint32_t>& indices, int rows, int columns) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto at = std::uint32_t(r * (columns + 1) + c), below = at + std::uint32_t(columns + 1);
      indices.insert(indices.end(), {at, below, below + 1, at, below + 1, at + 1});
    }
  }
}

/// Middle line of the coil: `s` from 0 at the top to 1 at the bottom. The radius grows in and out at the ends.
glm::vec3 on_coil(glm::vec3 top, glm::vec3 bottom, int turns, float radius, float s) {
  constexpr float straight = 0.08f;
  const float inside = std::clamp((s - straight) / (1 - 2 * straight), 0.0f, 1.0f);
  const float grown = std::clamp(std::min(inside, 1 - inside) * float(turns) * 2, 0.0f, 1.0f);
  const float r = radius * grown * grown * (3 - 2 * grown), angle = turn * float(turns) * inside;
  return top + s * (bottom - top) + glm::vec3(r * std::cos(angle), 0, r * std::sin(angle));
}

}  // namespace

SolidGeometry sphere_geometry(int meridians, int parallels) {
  SolidGeometry g;
  for (int r = 0; r <= parallels; ++r) {
    const float polar = turn / 2 * float(r) / float(parallels);
    for (int c = 0; c <= meridians; ++c) {
      const float angle = turn * float(c) / float(meridians);
      const glm::vec3 n(std::sin(polar) * std::sin(angle), std::cos(polar), std::sin(polar) * std::cos(angle));
      g.vertices.push_back({n, n});
    }
  }
  add_grid(g.indices, parallels, meridians);
  return g;
}

SolidGeometry cylinder_geometry(int meridians) {
  SolidGeometry g;
  for (const float y : {1.0f, -1.0f})
    for (int c = 0; c <= meridians; ++c) {
      const float angle = turn * float(c) / float(meridians);
      const glm::vec3 n(std::sin(angle), 0, std::cos(angle));
      g.vertices.push_back({n + glm::vec3(0, y, 0), n});
    }
  add_grid(g.indices, 1, meridians);
  for (const float y : {1.0f, -1.0f}) {
    const glm::vec3 n(0, y, 0);
    const auto middle = std::uint32_t(g.vertices.size());
    g.vertices.push_back({n, n});
    for (int c = 0; c <= meridians; ++c) {
      const float angle = turn * float(c) / float(meridians);
      g.vertices.push_back({{std::sin(angle), y, std::cos(angle)}, n});
    }
    for (std::uint32_t c = 1; c <= std::uint32_t(meridians); ++c) {
      const std::uint32_t first = y > 0 ? middle + c : middle + c + 1, second = y > 0 ? middle + c + 1 : middle + c;
      g.indices.insert(g.indices.end(), {middle, first, second});
    }
  }
  return g;
}

SolidGeometry box_geometry(glm::vec3 center, glm::vec3 half) {
  SolidGeometry g;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 n(0), u(0), w(0);
      n[axis] = sign, u[(axis + 1) % 3] = 1;
      w = glm::cross(n, u);
      const auto first = std::uint32_t(g.vertices.size());
      for (const auto& [a, b] : {std::pair{-1.f, -1.f}, {1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}}) {
        g.vertices.push_back({center + half * (n + a * u + b * w), n});
      }
      g.indices.insert(g.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return g;
}

SolidGeometry coil_geometry(glm::vec3 top, glm::vec3 bottom, int turns, float radius, float wire_radius) {
  const int along = turns * 28, around = 8;
  SolidGeometry g;
  for (int r = 0; r <= along; ++r) {
    const float s = float(r) / float(along), h = 0.5f / float(along);
    const glm::vec3 middle = on_coil(top, bottom, turns, radius, s);
    const glm::vec3 tangent = glm::normalize(on_coil(top, bottom, turns, radius, s + h) -
                                             on_coil(top, bottom, turns, radius, s - h) + glm::vec3(0, -1e-9f, 0));
    const glm::vec3 side = glm::normalize(glm::cross(tangent, glm::vec3(0.01f, 0.02f, 1)));
    const glm::vec3 over = glm::cross(side, tangent);
    for (int c = 0; c <= around; ++c) {
      const float angle = turn * float(c) / float(around);
      const glm::vec3 n = std::cos(angle) * side + std::sin(angle) * over;
      g.vertices.push_back({middle + wire_radius * n, n});
    }
  }
  add_grid(g.indices, along, around);
  return g;
}

void SolidMesh::upload(const SolidGeometry& geometry) {
  glBindVertexArray(array_.id());
  vertices_.write(GL_ARRAY_BUFFER, geometry.vertices);
  indices_.write(GL_ELEMENT_ARRAY_BUFFER, geometry.indices);
  const auto attribute = [](GLuint index, std::size_t offset) {
    glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(SolidVertex), reinterpret_cast<const void*>(offset));
    glEnableVertexAttribArray(index);
  };
  attribute(0, offsetof(SolidVertex, point));
  attribute(1, offsetof(SolidVertex, normal));
  glBindVertexArray(0);
  count_ = GLsizei(geometry.indices.size());
}

void SolidMesh::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

namespace {

/// Where the weight is drawn: not through the hanger, and not out of all bounds.
glm::vec3 drawn_place(const Preset& p, double y, double scale) {
  if (!std::isfinite(y)) y = p.x_0.y;
  return {p.x_0.x, std::clamp(y, p.x_0.y - 1e4 * scale, p.x_0.y + 2.5 * scale), p.x_0.z};
}

void append(SolidGeometry& to, const SolidGeometry& more) {
  const auto first = std::uint32_t(to.vertices.size());
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const std::uint32_t index : more.indices) to.indices.push_back(first + index);
}

/// A level line of `dashes` pieces to both sides of `middle`, which leaves the middle itself free.
SolidGeometry level_line(glm::vec3 middle, float scale, int dashes) {
  const float from = 0.26f * scale, to = 1.0f * scale, thick = 0.006f * scale;
  const float piece = (to - from) / float(2 * dashes - 1);
  SolidGeometry line;
  for (int k = 0; k < dashes; ++k) {
    for (const float side : {-1.0f, 1.0f}) {
      const glm::vec3 offset(side * (from + (2 * float(k) + 0.5f) * piece), 0, 0);
      append(line, box_geometry(middle + offset, glm::vec3(piece / 2, thick, thick)));
    }
  }
  return line;
}

}  // namespace

WeightModel weight_model(const Preset& p, glm::dvec3 position) {
  const double sag = p.k > 0 ? p.m * p.g / p.k : 0;
  const double scale = std::clamp(std::max(std::abs(p.offset), std::abs(sag)), 0.02, 1e3);
  const float s = float(scale);
  const glm::vec3 rest(p.x_0), top = rest + glm::vec3(0, 3 * s, 0);
  WeightModel model;
  model.weight = drawn_place(p, position.y, scale);
  model.radius = 0.19f * s;
  model.hanger = box_geometry(top + glm::vec3(0, 0.03f * s, 0), glm::vec3(0.45f, 0.03f, 0.2f) * s);
  model.spring = coil_geometry(top, model.weight + glm::vec3(0, 0.95f * model.radius, 0), 12, 0.15f * s, 0.02f * s);
  model.rest = level_line(rest, s, 1);
  model.equilibrium = level_line(rest - glm::vec3(0, float(sag), 0), s, 6);
  return model;
}

}  // namespace tyglab
