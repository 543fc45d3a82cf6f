// Normals for smooth shading, and the bounding box, of a cloth's vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/render/camera.h"
#include "core/cloth/tears.h"

namespace tyglab {

/// A vector of every particle as the solver lays it out and the buffers hold it: row after row, each as its x, its y
/// and its z. Component c of particle (i, j) stands at i·stride() + j + c·component.
struct FloatRows {
  int rows = 0, columns = 0;
  int component = 0;  ///< from a row's x to its y and from its y to its z
  const float* data = nullptr;
  int stride() const { return 3 * component; }
  std::size_t size() const { return std::size_t(rows) * std::size_t(stride()); }
  const float* row(int i, int c) const { return data + std::size_t(i) * stride() + std::size_t(c) * component; }
};

/// Of the eight triangles in the four quads round particle (i, j) those that are whole and have it as a corner: bit
/// ((row − i + 1)·2 + column − j + 1)·2 + which, by the quad's upper left corner and its triangle (quad_triangles).
std::uint32_t whole_triangles(const Lattice& lattice, const Tears& tears, int i, int j);

/// Normals on the front side, not of unit length: the cross product of the differences to the neighbors down and along
/// the row. Those of `beside_tears` are the sum over their whole triangles instead, so that the other side of a tear
/// does not count; without a whole triangle (0, 0, 1). `normals` are laid out as the positions are, and only written.
void compute_normals(const FloatRows& positions, const Tears& tears, std::span<const std::uint32_t> beside_tears,
                     float* normals);

/// The box of all finite components.
Bounds finite_bounds(const FloatRows& positions);

}  // namespace tyglab
