// OpenGL buffers that a graphics card writes itself, so no drawn data passes through main memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "core/cloth/lattice.h"

namespace tyglab {

/// How an engine's device shares buffers with the OpenGL context in use.
enum class GlSharing {
  none,
  finished,  ///< OpenGL must have finished (glFinish) before the device writes
  ordered,   ///< the device waits for OpenGL, and OpenGL for the device (cl_khr_gl_event)
};

/// The names of two OpenGL buffers, and the size of each.
struct GlBuffers {
  unsigned positions = 0, normals = 0;
  std::size_t bytes = 0;
};

/// A particle beside a tear: its index among those that are drawn, i · columns + j, and one bit for each of the eight
/// triangles around it that is whole (whole_triangles, app/render/cloth_mesh.h).
struct TornSite {
  std::uint32_t site, triangles;
};

/// What to write for a picture of a cloth: row after row, each as its x, its y and its z, one float per column.
struct VertexRequest {
  DrawnSites sites;
  bool normals = false;
};

/// Bounding box of all positions, over their finite components; lo > hi if there is none.
struct VertexBox {
  glm::vec3 lo{1e30f}, hi{-1e30f};
};

/// OpenGL's buffers as one device sees them. The owner keeps the buffers alive for as long as this exists.
class GlVertices {
 public:
  GlVertices() = default;
  GlVertices(const GlVertices&) = delete;
  GlVertices& operator=(const GlVertices&) = delete;
  virtual ~GlVertices() = default;
  /// From now on the normals of these particles count whole triangles only.
  virtual void set_tears(std::span<const TornSite> torn) = 0;
};

}  // namespace tyglab
