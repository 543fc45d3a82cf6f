// The arrays of a cloth on a device: state vectors with their backup, and masks; and the host's views of them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/engine.h"
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
  /// Numbers in one vector, including all margins.
  std::size_t numbers() const { return numbers_; }
  cl_mem vector(int n) const { return vectors_[std::size_t(n)].now.memory.get(); }
  /// The other buffer of a vector, for sweeps that read neighbors while they write; swap() then makes it the vector.
  cl_mem other(int n);
  void swap(int n);
  /// Whether it works in memory lent by use_memory().
  bool has_lent_memory() const { return lent_ != nullptr; }
  /// Whether the vector is in lent memory, where it must never be written in place, since it may be on display.
  bool lent(int n) const { return vectors_[std::size_t(n)].now.slot >= 0; }
  /// A buffer for the vector, to be overwritten completely.
  cl_mem overwritten(int n);
  cl_mem masks() const { return masks_.get(); }
  cl_mem springs() const { return springs_.get(); }
  /// A new buffer of the size of a vector, of zeros, for use between steps.
  Memory field() const { return device_->zeros(numbers_ * sizeof(R)); }
  Memory mask_field() const { return device_->zeros(mask_bytes_); }

  /// One field into another.
  void copy(cl_mem from, cl_mem to) const;

  /// The host's view of a vector, from its row 0: a mapping where memory is shared, a copy otherwise. Valid until
  /// end_views(). Several threads may call it.
  const R* host(int n) const;
  /// A vector at one particle: from the host's view if there is one or it costs nothing; otherwise read with its
  /// surroundings, which are kept until end_views(). Several threads may call it.
  glm::dvec3 at(int n, int i, int j) const;
  /// As host(), of any such field, until unmap().
  R* map(cl_mem field, cl_map_flags how) const;
  void unmap(cl_mem field, R* at) const;
  /// Ends all views: kernels may write again.
  void end_views();
  /// Bytes copied for views so far.
  std::uint64_t bytes_read() const { return bytes_read_; }

  std::size_t slot_bytes() const { return numbers_ * sizeof(float); }
  /// Moves the positions into that memory; in double, keeps a float copy of them there for drawing. Returns false and
  /// changes nothing if the device would not write there directly.
  bool use_memory(std::shared_ptr<PositionMemory> memory);
  /// In double, the buffer to which positions in float must be written; null if they are up to date or there is no lent
  /// memory.
  cl_mem stale_floats();
  /// In double, the positions in float from row 0, until end_views(); null without lent memory.
  const float* floats();

  /// Copies the host's masks, one byte per particle, to a mask field.
  void upload(std::span<const std::uint8_t> bytes, cl_mem to) const;
  /// Tears in `tears` what the device has torn.
  void download(Tears& tears) const;

  /// Copies the vectors, and restores the copy.
  void keep_backup();
  void restore();
  std::size_t bytes() const;

 private:
  /// A field that may be a slot of lent memory.
  struct Place {
    Memory memory;
    int slot = -1;
  };
  /// A few rows and columns of a vector that the host has read: row by row, each as its x, its y and its z.
  struct Patch {
    int i = 0, j = 0, rows = 0, columns = 0;
    std::vector<R> numbers;
    bool holds(int row, int column) const { return row >= i && row < i + rows && column >= j && column < j + columns; }
  };
  struct Vector {
    Place now, other;
    Memory backup;
    const R* host = nullptr;
    Patch patch;
  };
  void read_patch(Vector& vector, int i, int j) const;
  std::size_t lead() const { return 2 * 3 * std::size_t(stride_) + 16; }

  std::shared_ptr<Device> device_;
  Lattice lattice_;
  int stride_, mask_pitch_;
  std::size_t numbers_, mask_bytes_;
  std::shared_ptr<PositionMemory> lent_;
  Place spare_;                   ///< the one of the three lent slots that neither x nor its other buffer uses
  std::array<Memory, 3> floats_;  ///< in double: the lent slots
  int floats_slot_ = -1;          ///< the one of them with the positions
  float* floats_host_ = nullptr;
  mutable std::atomic<std::uint64_t> bytes_read_ = 0;
  mutable std::mutex mutex_;  ///< of the views
  mutable std::vector<Vector> vectors_;
  Memory masks_, springs_;
};

}  // namespace tyglab::opencl
