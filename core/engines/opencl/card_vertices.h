// Vertex buffers of OpenGL that a device writes (cl_khr_gl_sharing). So far tested only with a simulated device of this
// kind, since no graphics card was available.
#pragma once

#include <memory>
#include <span>

#include "core/engines/gl_vertices.h"
#include "core/engines/opencl/device.h"

// The kernels of drawing.cl, which write the vertices of a cloth into any two buffers of a device.

namespace tyglab::opencl {

class VertexKernels {
 public:
  /// For positions in double or in float. Throws EngineError, as all members do.
  VertexKernels(std::shared_ptr<Device> device, bool in_double);

  /// As GlVertices::set_tears().
  void set_tears(std::span<const TornSite> torn);
  /// Queues the writing of positions, from a vector as in cloth.cl.
  void write_positions(cl_mem x, int stride, const DrawnSites& sites, cl_mem to);
  /// Queues the writing of normals, from such positions.
  void write_normals(cl_mem positions, const DrawnSites& sites, cl_mem to);
  /// Waits for what was queued; returns the bounds of the positions.
  VertexBox box() const;

 private:
  void launch(const Kernel& kernel, int columns, int rows) const;

  std::shared_ptr<Device> device_;
  Kernel write_positions_, write_normals_, write_torn_normals_;
  Memory box_, torn_;
  int torn_count_ = 0;
};

}  // namespace tyglab::opencl

namespace tyglab::opencl {

class CardVertices final : public GlVertices {
 public:
  /// For positions in double or in float. Throws EngineError.
  CardVertices(std::shared_ptr<Device> device, const GlBuffers& buffers, bool in_double);

  bool fits(const std::shared_ptr<Device>& device, bool in_double) const {
    return device == device_ && in_double == in_double_;
  }
  void set_tears(std::span<const TornSite> torn) override { kernels_.set_tears(torn); }
  /// Writes what is requested from a vector as in cloth.cl, and waits for it. Throws EngineError; even then the buffers
  /// are OpenGL's again.
  VertexBox write(cl_mem x, int stride, const VertexRequest& order);

 private:
  std::shared_ptr<Device> device_;
  bool in_double_;
  VertexKernels kernels_;
  Memory positions_, normals_;
};

}  // namespace tyglab::opencl
