// OpenGL memory that the program, or a device, writes directly.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "app/render/gl_objects.h"

namespace tyglab::gl {

/// A vertex buffer of a few slots that stays mapped. A fence a slot says when OpenGL has drawn from it.
class MappedBuffer {
 public:
  static constexpr int most_slots = 3;
  /// Whether the present context has such buffers (ARB_buffer_storage).
  static bool available();
  /// `slots` of at least that many bytes, each beginning on a page, full of zeros. Throws GraphicsError where there
  /// is no room.
  MappedBuffer(int slots, std::size_t bytes);
  ~MappedBuffer();
  MappedBuffer(const MappedBuffer&) = delete;
  MappedBuffer& operator=(const MappedBuffer&) = delete;

  GLuint id() const { return object_.id(); }
  std::byte* slot(int n) const { return first_ + std::size_t(n) * slot_bytes_; }
  std::size_t slot_bytes() const { return slot_bytes_; }
  std::size_t bytes() const { return whole_; }
  /// Offset of that address in the buffer, bytes; none if it is outside.
  std::optional<std::size_t> offset_of(const void* address) const;
  int slot_of(const void* address) const;
  /// The slot has been drawn from: by what was called so far.
  void drawn(int slot);
  /// Waits until OpenGL has drawn from the slot all that it was to draw.
  void wait(int slot);

 private:
  BufferName object_;
  std::byte *mapped_ = nullptr, *first_ = nullptr;
  std::size_t slot_bytes_, whole_;
  std::array<GLsync, most_slots> fences_{};
};

}  // namespace tyglab::gl
