// The kernels of drawing.cl, which write the vertices of a cloth into any two buffers of a device.
#pragma once

#include <memory>
#include <span>

#include "core/engines/gl_vertices.h"
#include "core/engines/opencl/device.h"

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
