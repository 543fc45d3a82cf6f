
#include "core/engines/opencl/card_vertices.h"

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>

#include "core/engines/opencl/device.h"
#include "core/engines/opencl/program_text.h"

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

namespace tyglab::opencl {
namespace {

/// ordered() of drawing.cl, back.
float number_of(std::uint32_t ordered) {
  return std::bit_cast<float>((ordered >> 31) != 0 ? ordered & 0x7fffffffu : ~ordered);
}

constexpr std::size_t box_words = 6;

}  // namespace

VertexKernels::VertexKernels(std::shared_ptr<Device> device, bool in_double) : device_(std::move(device)) {
  const char* options = in_double ? "-cl-std=CL1.2 -D REAL=double -D REAL_IS_DOUBLE" : "-cl-std=CL1.2 -D REAL=float";
  const auto program = device_->program(std::string(kernel_text("drawing.cl")), options);
  write_positions_ = program->kernel("write_positions");
  write_normals_ = program->kernel("write_normals");
  write_torn_normals_ = program->kernel("write_torn_normals");
  box_ = device_->zeros(box_words * sizeof(cl_uint));
}

void VertexKernels::set_tears(std::span<const TornSite> torn) {
  torn_count_ = int(torn.size());
  if (torn.empty()) return;
  torn_ = device_->zeros(torn.size_bytes());
  check(clEnqueueWriteBuffer(device_->queue(), torn_.get(), CL_TRUE, 0, torn.size_bytes(), torn.data(), 0, nullptr,
                             nullptr),
        "writing to the device");
}

void VertexKernels::write_positions(cl_mem x, int stride, const DrawnSites& sites, cl_mem to) {
  const auto fill = [&](cl_uint word, std::size_t first) {
    constexpr std::size_t half = box_words / 2 * sizeof(cl_uint);
    check(
        clEnqueueFillBuffer(device_->queue(), box_.get(), &word, sizeof word, first * half, half, 0, nullptr, nullptr),
        "clearing a buffer");
  };
  fill(~0u, 0), fill(0, 1);
  const cl_mem box = box_.get();
  set_arguments(write_positions_, 0, x, cl_int(stride), to, cl_int(sites.rows()), cl_int(sites.columns()),
                cl_int(sites.every), cl_int(sites.whole.rows - 1), cl_int(sites.whole.columns - 1), box);
  launch(write_positions_, 1, sites.rows());  // few work-items a row, since they all report to one box
}

void VertexKernels::write_normals(cl_mem positions, const DrawnSites& sites, cl_mem to) {
  set_arguments(write_normals_, 0, positions, to, cl_int(sites.rows()), cl_int(sites.columns()));
  launch(write_normals_, sites.columns(), sites.rows());
  if (torn_count_ == 0) return;
  const cl_mem torn = torn_.get();
  set_arguments(write_torn_normals_, 0, positions, to, cl_int(sites.columns()), torn, cl_int(torn_count_));
  const std::size_t items = std::size_t(torn_count_);
  check(clEnqueueNDRangeKernel(device_->queue(), write_torn_normals_.get(), 1, nullptr, &items, nullptr, 0, nullptr,
                               nullptr),
        "starting a kernel");
}

/// At least that many work-items a row, and some for each row.
void VertexKernels::launch(const Kernel& kernel, int columns, int rows) const {
  const std::array<std::size_t, 2> local{32, 4};
  const auto whole = [](int n, std::size_t groups_of) {
    return (std::size_t(n) + groups_of - 1) / groups_of * groups_of;
  };
  const std::array<std::size_t, 2> global{whole(columns, local[0]), whole(rows, local[1])};
  check(clEnqueueNDRangeKernel(device_->queue(), kernel.get(), 2, nullptr, global.data(), local.data(), 0, nullptr,
                               nullptr),
        "starting a kernel");
}

VertexBox VertexKernels::box() const {
  std::array<std::uint32_t, box_words> words{};
  check(clEnqueueReadBuffer(device_->queue(), box_.get(), CL_TRUE, 0, sizeof words, words.data(), 0, nullptr, nullptr),
        "reading from the device");
  VertexBox box;
  for (int c = 0; c < 3; ++c)
    if (const std::uint32_t least = words[std::size_t(c)], most = words[std::size_t(c) + 3]; least <= most)
      box.lo[c] = number_of(least), box.hi[c] = number_of(most);
  return box;
}

}  // namespace tyglab::opencl
