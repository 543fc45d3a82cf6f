// Vertex buffers of a cloth that its device writes itself (cl_khr_gl_sharing), so no data passes through main memory.
// So far tested only with a simulated device, since no graphics card was available.
//
// The engine acquires the two buffers, copies the rows and columns that are drawn into the first (kernels/drawing.cl),
// computes normals into the second with the bits of compute_normals, and releases both; it returns only the 24 bytes of
// the bounding box that the shadow needs. With cl_khr_gl_event, acquiring and releasing order both sides; without it,
// glFinish comes before and clFinish after, since the extension has no other portable way. All of this runs on the
// window's thread, and the buffers belong to the viewport, which frees them before OpenGL's, so engines may end
// anywhere. If a driver only claims to share, or fails later, the program changes to copying.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/render/camera.h"
#include "app/render/gl_objects.h"
#include "app/render/vertex_memory.h"
#include "core/engines/vertex_sharing.h"

namespace tyglab {

class WrittenVertices {
 public:
  /// Whether the engine's device can write buffers of the present context. False for good once it has failed.
  bool can(const Engine& engine) const {
    const VertexSharing* sharing = engine.vertex_sharing();
    return problem_.empty() && sharing != nullptr && sharing->gl_sharing() != GlSharing::none;
  }
  /// Particles beside tears have such normals from now on.
  void set_tears(std::vector<TornSite> torn);
  /// Has the device write, and returns the bounds of the positions. The content of the very first buffer is read back
  /// and compared with them, since a driver may share in name only; `read` counts its bytes. Throws EngineError.
  Bounds write(VertexSharing& device, const VertexRequest& request, std::size_t& read);
  /// Records that writing does not work here, and the reason: can() is false from now on.
  void fail(const std::string& why) { free(), problem_ = why; }
  /// Why it failed; empty: it did not.
  const std::string& problem() const { return problem_; }
  /// The cloth comes another way now.
  void free() { vertices_.reset(), buffers_.reset(), bytes_ = 0; }
  VertexSource positions() const { return {buffers_->positions.id(), 0}; }
  VertexSource normals() const { return {buffers_->normals.id(), 0}; }
  std::size_t bytes() const { return 2 * bytes_; }

 private:
  struct Buffers {
    gl::BufferName positions, normals;
  };
  VertexBox write_new(VertexSharing& device, const VertexRequest& request, std::size_t bytes);
  void look_at(const VertexBox& box, const DrawnSites& sites) const;

  std::optional<Buffers> buffers_;
  std::unique_ptr<GlVertices> vertices_;  ///< of the buffers, so it goes first
  std::size_t bytes_ = 0;                 ///< of each
  std::vector<TornSite> torn_;
  bool looked_ = false;
  std::string problem_;
};

}  // namespace tyglab
