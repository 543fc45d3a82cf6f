#include "core/engines/opencl/device_state.h"

#include <algorithm>
#include <cassert>

#include "core/integrators/scheme.h"
#include "core/simd/row_field.h"

namespace tyglab::opencl {
namespace {

constexpr int mask_margin = 16;

}  // namespace

template <class R>
DeviceState<R>::DeviceState(std::shared_ptr<Device> device, const Lattice& lattice, int vectors)
    : device_(std::move(device)),
      lattice_(lattice),
      stride_(simd::row_stride<R>(lattice.columns)),
      mask_pitch_((lattice.columns + 15) / 16 * 16 + 2 * mask_margin),
      numbers_((std::size_t(lattice.rows) + 5) * 3 * std::size_t(stride_) + 32),
      mask_bytes_((std::size_t(lattice.rows) + 5) * std::size_t(mask_pitch_)),
      vectors_(std::size_t(vectors)) {
  for (Vector& vector : vectors_) vector.now.memory = field(), vector.backup = field();
  masks_ = mask_field(), springs_ = mask_field();
}

template <class R>
DeviceState<R>::~DeviceState() {
  clFinish(device_->queue());
  end_views();
}

template <class R>
cl_mem DeviceState<R>::other(int n) {
  assert(n >= 0 && std::size_t(n) < vectors_.size());
  Vector& vector = vectors_[std::size_t(n)];
  if (!vector.other.memory) vector.other.memory = field();
  if (vector.other.slot >= 0 && vector.other.slot == lent_->shown) std::swap(vector.other, spare_);
  return vector.other.memory.get();
}

template <class R>
void DeviceState<R>::swap(int n) {
  assert(n >= 0 && std::size_t(n) < vectors_.size() && vectors_[std::size_t(n)].other.memory);
  std::swap(vectors_[std::size_t(n)].now, vectors_[std::size_t(n)].other);
}

template <class R>
cl_mem DeviceState<R>::overwritten(int n) {
  if (lent(n)) other(n), swap(n);
  return vector(n);
}

template <class R>
R* DeviceState<R>::map(cl_mem field, cl_map_flags how) const {
  assert(field != nullptr);
  cl_int code = CL_SUCCESS;
  void* at =
      clEnqueueMapBuffer(device_->queue(), field, CL_TRUE, how, 0, numbers_ * sizeof(R), 0, nullptr, nullptr, &code);
  check(code, "reading from the device");
  if (!device_->facts().shared_memory) bytes_read_ += numbers_ * sizeof(R);
  return static_cast<R*>(at) + lead();
}

template <class R>
void DeviceState<R>::unmap(cl_mem field, R* at) const {
  clEnqueueUnmapMemObject(device_->queue(), field, at - lead(), 0, nullptr, nullptr);
}

template <class R>
const R* DeviceState<R>::host(int n) const {
  const std::lock_guard lock(mutex_);
  Vector& vector = vectors_[std::size_t(n)];
  if (vector.host != nullptr) return vector.host;
  return vector.host = map(vector.now.memory.get(), CL_MAP_READ);
}

template <class R>
glm::dvec3 DeviceState<R>::at(int n, int i, int j) const {
  assert(lattice_.contains(i, j));
  if (device_->facts().shared_memory) host(n);
  const std::lock_guard lock(mutex_);
  Vector& vector = vectors_[std::size_t(n)];
  const auto point = [](const R* x, std::ptrdiff_t component) {
    return glm::dvec3(double(x[0]), double(x[component]), double(x[2 * component]));
  };
  if (vector.host != nullptr) return point(vector.host + (3 * std::ptrdiff_t(i) * stride_ + j), stride_);
  if (!vector.patch.holds(i, j)) read_patch(vector, i, j);
  const Patch& patch = vector.patch;
  return point(patch.numbers.data() + (3 * std::ptrdiff_t(i - patch.i) * patch.columns + j - patch.j), patch.columns);
}

/// With as much round it as a particle's neighbors, and theirs, need.
template <class R>
void DeviceState<R>::read_patch(Vector& vector, int i, int j) const {
  constexpr int reach = 6;
  Patch& patch = vector.patch;
  patch.i = std::max(i - reach, 0), patch.j = std::max(j - reach, 0);
  patch.rows = std::min(i + reach + 1, lattice_.rows) - patch.i;
  patch.columns = std::min(j + reach + 1, lattice_.columns) - patch.j;
  assert(patch.holds(i, j));
  patch.numbers.resize(3 * std::size_t(patch.rows) * std::size_t(patch.columns));
  // A component is a line of the rectangle, a row of the cloth a plane of it.
  const std::size_t line = std::size_t(stride_) * sizeof(R), short_line = std::size_t(patch.columns) * sizeof(R);
  const std::array<std::size_t, 3> from{(16 + std::size_t(patch.j)) * sizeof(R), 0, 2 + std::size_t(patch.i)},
      to{0, 0, 0}, region{short_line, 3, std::size_t(patch.rows)};
  check(
      clEnqueueReadBufferRect(device_->queue(), vector.now.memory.get(), CL_TRUE, from.data(), to.data(), region.data(),
                              line, 3 * line, short_line, 3 * short_line, patch.numbers.data(), 0, nullptr, nullptr),
      "reading from the device");
  bytes_read_ += patch.numbers.size() * sizeof(R);
}

template <class R>
void DeviceState<R>::end_views() {
  const std::lock_guard lock(mutex_);
  for (Vector& vector : vectors_) {
    if (vector.host != nullptr) unmap(vector.now.memory.get(), const_cast<R*>(vector.host));
    vector.host = nullptr;
    vector.patch.rows = 0;
  }
  if (floats_host_ != nullptr)
    clEnqueueUnmapMemObject(device_->queue(), floats_[std::size_t(floats_slot_)].get(), floats_host_, 0, nullptr,
                            nullptr);
  floats_host_ = nullptr;
}

template <class R>
bool DeviceState<R>::use_memory(std::shared_ptr<PositionMemory> memory) {
  static_assert(std::tuple_size_v<decltype(floats_)> == PositionMemory::count);
  assert(memory->bytes >= slot_bytes());
  std::array<Memory, PositionMemory::count> slots;
  for (std::size_t n = 0; n < slots.size(); ++n)
    if (!(slots[n] = device_->in_place(memory->slots[n], slot_bytes()))) return false;
  end_views();
  if constexpr (std::is_same_v<R, float>) {
    Vector& x = vectors_[vector_x];
    copy(x.now.memory.get(), slots[0].get());
    check(clFinish(device_->queue()), "copying the state");
    x.now = {std::move(slots[0]), 0}, x.other = {std::move(slots[1]), 1}, spare_ = {std::move(slots[2]), 2};
  } else {
    floats_ = std::move(slots);
  }
  lent_ = std::move(memory);
  return true;
}

template <class R>
cl_mem DeviceState<R>::stale_floats() {
  if (!floats_[0] || floats_host_ != nullptr) return nullptr;
  floats_slot_ = lent_->shown == 0 ? 1 : 0;
  return floats_[std::size_t(floats_slot_)].get();
}

template <class R>
const float* DeviceState<R>::floats() {
  if (!floats_[0]) return nullptr;
  const std::lock_guard lock(mutex_);
  if (floats_host_ == nullptr) {
    cl_int code = CL_SUCCESS;
    floats_host_ =
        static_cast<float*>(clEnqueueMapBuffer(device_->queue(), floats_[std::size_t(floats_slot_)].get(), CL_TRUE,
                                               CL_MAP_READ, 0, slot_bytes(), 0, nullptr, nullptr, &code));
    check(code, "reading from the device");
  }
  return floats_host_ + lead();
}

template <class R>
void DeviceState<R>::upload(std::span<const std::uint8_t> bytes, cl_mem to) const {
  assert(bytes.size() == std::size_t(lattice_.size()));
  const std::size_t columns = std::size_t(lattice_.columns);
  std::vector<std::uint8_t> all(mask_bytes_);
  for (std::size_t i = 0; i < std::size_t(lattice_.rows); ++i)
    std::copy_n(bytes.data() + i * columns, columns, all.data() + (i + 2) * std::size_t(mask_pitch_) + mask_margin);
  check(clEnqueueWriteBuffer(device_->queue(), to, CL_TRUE, 0, all.size(), all.data(), 0, nullptr, nullptr),
        "writing to the device");
}

template <class R>
void DeviceState<R>::download(Tears& tears) const {
  assert(tears.lattice() == lattice_);
  std::vector<std::uint8_t> all(mask_bytes_);
  check(clEnqueueReadBuffer(device_->queue(), springs_.get(), CL_TRUE, 0, all.size(), all.data(), 0, nullptr, nullptr),
        "reading from the device");
  for (int i = 0; i < lattice_.rows; ++i) {
    const std::uint8_t* row = all.data() + (std::size_t(i) + 2) * std::size_t(mask_pitch_) + mask_margin;
    for (int j = 0; j < lattice_.columns; ++j) {
      constexpr unsigned stretch = bit_E | bit_S | bit_SE | bit_SW;
      if ((row[j] & stretch) == stretch) continue;
      for (int d = 0; d < stretch_directions; ++d)
        if ((row[j] >> d & 1) == 0) tears.tear(d, i, j);  // which ignores springs that do not exist
    }
  }
}

template <class R>
void DeviceState<R>::copy(cl_mem from, cl_mem to) const {
  check(clEnqueueCopyBuffer(device_->queue(), from, to, 0, 0, numbers_ * sizeof(R), 0, nullptr, nullptr),
        "copying the state");
}

template <class R>
void DeviceState<R>::keep_backup() {
  for (Vector& vector : vectors_) copy(vector.now.memory.get(), vector.backup.get());
}

template <class R>
void DeviceState<R>::restore() {
  end_views();
  for (int n = 0; n < int(vectors_.size()); ++n) copy(vectors_[std::size_t(n)].backup.get(), overwritten(n));
}

template <class R>
std::size_t DeviceState<R>::bytes() const {
  std::size_t fields = 0;
  for (const Vector& vector : vectors_)  // lent memory is its owner's
    for (const Memory* memory : {&vector.now.memory, &vector.other.memory, &vector.backup})
      fields += *memory && (memory == &vector.backup || vector.now.slot < 0) ? 1 : 0;
  return fields * numbers_ * sizeof(R) + 2 * mask_bytes_;
}

template class DeviceState<float>;
template class DeviceState<double>;

}  // namespace tyglab::opencl
