// Buffers of OpenGL that a graphics card writes itself, so that nothing of what is drawn passes through main memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "core/cloth/drawn_sites.h"

namespace tyglab {

/// How an engine's device shares buffers with the OpenGL context in use.
enum class GlSharing {
  none,
  finished,  ///< OpenGL must have finished (glFinish) before the device writes
  ordered,   ///< the device waits for OpenGL, and OpenGL for the device (cl_khr_gl_event)
};

/// Two of OpenGL's buffers by their names, each of so many bytes.
struct GlBuffers {
  unsigned positions = 0, normals = 0;
  std::size_t bytes = 0;
};

/// A particle beside a tear: where it stands among those that are drawn, i · columns + j, and which of the eight
/// triangles round it are whole, a bit each (whole_triangles, app/render/vertex_normals.h).
struct TornSite {
  std::uint32_t site, triangles;
};

/// What a picture needs of a cloth. It is written row after row, each as its x, its y and its z of so many floats as
/// there are columns.
struct VertexOrder {
  DrawnSites sites;
  bool normals = false;
};

/// The box of all positions' finite components; lo over hi where there is none.
struct VertexBox {
  glm::vec3 lo{1e30f}, hi{-1e30f};
};

/// OpenGL's buffers as one device sees them. Whoever has it keeps the buffers until it is gone.
class GlVertices {
 public:
  GlVertices() = default;
  GlVertices(const GlVertices&) = delete;
  GlVertices& operator=(const GlVertices&) = delete;
  virtual ~GlVertices() = default;
  /// From now on normals at these particles count their whole triangles alone.
  virtual void take_tears(std::span<const TornSite> torn) = 0;
};

}  // namespace tyglab
