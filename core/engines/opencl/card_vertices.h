// Vertex buffers of OpenGL that a device writes (cl_khr_gl_sharing). So far tested only with a simulated device of this
// kind, since no graphics card was available.
#pragma once

#include <memory>
#include <span>

#include "core/engines/opencl/vertex_kernels.h"

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
