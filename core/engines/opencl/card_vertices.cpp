#include "core/engines/opencl/card_vertices.h"

#include <array>

namespace tyglab::opencl {
namespace {

/// OpenGL's buffers while the device has them.
class Acquired {
 public:
  Acquired(cl_command_queue queue, std::span<const cl_mem> buffers) : queue_(queue), buffers_(buffers) {
    check(clEnqueueAcquireGLObjects(queue, cl_uint(buffers.size()), buffers.data(), 0, nullptr, nullptr),
          "acquiring OpenGL's buffers");
  }
  ~Acquired() {
    if (!buffers_.empty()) release();
  }
  Acquired(const Acquired&) = delete;
  Acquired& operator=(const Acquired&) = delete;
  void give_back() {
    const cl_int code = release();
    buffers_ = {};
    check(code, "releasing OpenGL's buffers");
  }

 private:
  cl_int release() {
    return clEnqueueReleaseGLObjects(queue_, cl_uint(buffers_.size()), buffers_.data(), 0, nullptr, nullptr);
  }
  cl_command_queue queue_;
  std::span<const cl_mem> buffers_;
};

}  // namespace

CardVertices::CardVertices(std::shared_ptr<Device> device, const GlBuffers& buffers, bool in_double)
    : device_(std::move(device)),
      in_double_(in_double),
      kernels_(device_, in_double),
      positions_(device_->shared(buffers.positions)),
      normals_(device_->shared(buffers.normals)) {}

VertexBox CardVertices::write(cl_mem x, int stride, const VertexRequest& order) {
  const std::array<cl_mem, 2> buffers{positions_.get(), normals_.get()};
  {
    Acquired acquired(device_->queue(), std::span(buffers).first(order.normals ? 2 : 1));
    kernels_.write_positions(x, stride, order.sites, positions_.get());
    if (order.normals) kernels_.write_normals(positions_.get(), order.sites, normals_.get());
    acquired.give_back();
  }
  // Without cl_khr_gl_event OpenGL may draw only once the device has finished.
  if (!device_->facts().gl_event) check(clFinish(device_->queue()), "writing vertices");
  return kernels_.box();
}

}  // namespace tyglab::opencl
