#include "core/engines/opencl/device_state.h"

#include <algorithm>

#include "core/engines/cpu/row_field.h"

namespace tyglab::opencl {
namespace {

constexpr int mask_margin = 16;

}  // namespace

template <class R>
DeviceState<R>::DeviceState(std::shared_ptr<Device> device, const Lattice& lattice, int vectors)
    : device_(std::move(device)),
      lattice_(lattice),
      stride_(cpu::row_stride<R>(lattice.columns)),
      mask_pitch_((lattice.columns + 15) / 16 * 16 + 2 * mask_margin),
      numbers_((std::size_t(lattice.rows) + 5) * 3 * std::size_t(stride_) + 32),
      mask_bytes_((std::size_t(lattice.rows) + 5) * std::size_t(mask_pitch_)),
      vectors_(std::size_t(vectors)) {
  for (Vector& vector : vectors_) vector.now = field(), vector.backup = field();
  masks_ = mask_field(), springs_ = mask_field();
}

template <class R>
DeviceState<R>::~DeviceState() {
  clFinish(device_->queue());
  for (Vector& vector : vectors_)
    if (vector.host != nullptr) unmap(vector.now.get(), const_cast<R*>(vector.host));
}

template <class R>
cl_mem DeviceState<R>::other(int n) {
  Vector& vector = vectors_[std::size_t(n)];
  if (!vector.other) vector.other = field();
  return vector.other.get();
}

template <class R>
void DeviceState<R>::swap(int n) {
  std::swap(vectors_[std::size_t(n)].now, vectors_[std::size_t(n)].other);
}

template <class R>
R* DeviceState<R>::map(cl_mem field, cl_map_flags how) const {
  cl_int code = CL_SUCCESS;
  void* at =
      clEnqueueMapBuffer(device_->queue(), field, CL_TRUE, how, 0, numbers_ * sizeof(R), 0, nullptr, nullptr, &code);
  check(code, "reading from the device");
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
  if (vector.host == nullptr) vector.host = map(vector.now.get(), CL_MAP_READ);
  return vector.host;
}

template <class R>
void DeviceState<R>::take_back() {
  const std::lock_guard lock(mutex_);
  for (Vector& vector : vectors_) {
    if (vector.host != nullptr) unmap(vector.now.get(), const_cast<R*>(vector.host));
    vector.host = nullptr;
  }
}

template <class R>
void DeviceState<R>::upload(std::span<const std::uint8_t> bytes, cl_mem to) const {
  const std::size_t columns = std::size_t(lattice_.columns);
  std::vector<std::uint8_t> all(mask_bytes_);
  for (std::size_t i = 0; i < std::size_t(lattice_.rows); ++i)
    std::copy_n(bytes.data() + i * columns, columns, all.data() + (i + 2) * std::size_t(mask_pitch_) + mask_margin);
  check(clEnqueueWriteBuffer(device_->queue(), to, CL_TRUE, 0, all.size(), all.data(), 0, nullptr, nullptr),
        "writing to the device");
}

template <class R>
void DeviceState<R>::download(Tears& tears) const {
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
  for (Vector& vector : vectors_) copy(vector.now.get(), vector.backup.get());
}

template <class R>
void DeviceState<R>::restore() {
  take_back();
  for (Vector& vector : vectors_) copy(vector.backup.get(), vector.now.get());
}

template <class R>
std::size_t DeviceState<R>::bytes() const {
  std::size_t fields = 0;
  for (const Vector& vector : vectors_) fields += vector.other ? 3 : 2;
  return fields * numbers_ * sizeof(R) + 2 * mask_bytes_;
}

template class DeviceState<float>;
template class DeviceState<double>;

}  // namespace tyglab::opencl
