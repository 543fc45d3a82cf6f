// Brings an OpenCL engine's positions to OpenGL: in memory that both use, or in buffers that both open.
#include "core/engines/opencl/device.h"

#include <cassert>
#include "core/engines/opencl/card_vertices.h"
#include "core/engines/opencl/opencl_engine.h"

namespace tyglab::opencl {

template <class R>
std::size_t OpenClEngine<R>::wanted_slot_bytes() const {
  return memory_settled_ || !device_->facts().processor ? 0 : state_.slot_bytes();
}

template <class R>
bool OpenClEngine<R>::use_memory(std::shared_ptr<PositionMemory> memory) {
  memory_settled_ = true;
  return state_.use_memory(std::move(memory));
}

template <class R>
PositionView OpenClEngine<R>::drawn_positions() {
  if constexpr (std::is_same_v<R, float>) return positions();
  if (const cl_mem to = state_.stale_floats(); to != nullptr) {
    constexpr std::size_t each = 8;  // numbers per work-item
    const std::size_t items = state_.numbers() / each;
    const cl_mem from = state_.vector(vector_x);
    set_arguments(kernels_.to_float, 0, from, to);
    check(clEnqueueNDRangeKernel(device_->queue(), kernels_.to_float.get(), 1, nullptr, &items, nullptr, 0, nullptr,
                                 nullptr),
          "starting a kernel");
  }
  const float* x = state_.floats();
  if (x == nullptr) return positions();
  PositionView view{lattice_.rows, lattice_.columns, 3 * state_.stride()};
  for (int c = 0; c < 3; ++c) view.f[c] = StateView<float>::row(x, state_.stride(), 0, c);
  return view;
}

template <class R>
GlSharing OpenClEngine<R>::gl_sharing() const {
  // The mass on a spring is drawn from no vertices of particles.
  return preset_.kind == Kind::cloth ? device_->gl_sharing() : GlSharing::none;
}

template <class R>
std::unique_ptr<GlVertices> OpenClEngine<R>::share(const GlBuffers& buffers) const {
  assert(gl_sharing() != GlSharing::none);
  return std::make_unique<CardVertices>(device_, buffers, sizeof(R) == sizeof(double));
}

template <class R>
std::optional<VertexBox> OpenClEngine<R>::write(GlVertices& vertices, const VertexRequest& request) {
  auto* const mine = dynamic_cast<CardVertices*>(&vertices);
  if (mine == nullptr || !mine->fits(device_, sizeof(R) == sizeof(double))) return std::nullopt;
  return mine->write(state_.vector(vector_x), state_.stride(), request);
}

template <class R>
std::string OpenClEngine<R>::copy_reason() const {
  if (device_->facts().processor)
    return memory_settled_ && !state_.has_lent_memory() ? "the device cannot use OpenGL's memory" : "";
  if (!device_->gl_problem().empty()) return device_->gl_problem();
  return device_->gl_sharing() == GlSharing::none ? "the device was opened for another OpenGL context" : "";
}

template class OpenClEngine<float>;
template class OpenClEngine<double>;

}  // namespace tyglab::opencl
