// The arrays of a cloth on a device: state vectors with their backup, masks; and what of them the host looks at.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/tears.h"
#include "core/engines/opencl/device.h"

namespace tyglab::opencl {

/// Rows as in row_field.h, with two more above and three below, and 16 numbers before the first.
template <class R>
class DeviceState {
 public:
  DeviceState(std::shared_ptr<Device> device, const Lattice& lattice, int vectors);
  ~DeviceState();
  DeviceState(const DeviceState&) = delete;
  DeviceState& operator=(const DeviceState&) = delete;

  int stride() const { return stride_; }
  int mask_pitch() const { return mask_pitch_; }
  /// Numbers in one vector, all rows and margins.
  std::size_t numbers() const { return numbers_; }
  cl_mem vector(int n) const { return vectors_[std::size_t(n)].now.get(); }
  /// Where a sweep that reads the vector's neighbours writes it; swap() then makes it the vector.
  cl_mem other(int n);
  void swap(int n);
  cl_mem masks() const { return masks_.get(); }
  cl_mem springs() const { return springs_.get(); }
  /// Zeros of the size of a vector, for what is used between steps.
  Memory field() const { return device_->zeros(numbers_ * sizeof(R)); }
  Memory mask_field() const { return device_->zeros(mask_bytes_); }

  /// The host's view of a vector, of its row 0: a mapping where memory is shared, a copy otherwise; good until
  /// take_back(). Several threads may ask.
  const R* host(int n) const;
  /// The same of any such field, until unmap().
  R* map(cl_mem field, cl_map_flags how) const;
  void unmap(cl_mem field, R* at) const;
  /// Ends all views: kernels may write again.
  void take_back();

  /// Masks of the host, one byte a particle, to a mask field.
  void upload(std::span<const std::uint8_t> bytes, cl_mem to) const;
  /// Stretch springs that the device has torn, into `tears`.
  void download(Tears& tears) const;

  /// Copies the vectors, and back.
  void keep_backup();
  void restore();
  std::size_t bytes() const;

 private:
  struct Vector {
    Memory now, other, backup;
    const R* host = nullptr;
  };
  std::size_t lead() const { return 2 * 3 * std::size_t(stride_) + 16; }
  void copy(cl_mem from, cl_mem to) const;

  std::shared_ptr<Device> device_;
  Lattice lattice_;
  int stride_, mask_pitch_;
  std::size_t numbers_, mask_bytes_;
  mutable std::mutex mutex_;  ///< of the views
  mutable std::vector<Vector> vectors_;
  Memory masks_, springs_;
};

}  // namespace tyglab::opencl
