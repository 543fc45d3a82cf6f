#include "app/render/mapped_buffer.h"

#include <cassert>
#include <cstdint>
#include <cstring>

#include "core/engines/engine.h"

namespace tyglab::gl {

bool MappedBuffer::available() {
  return GLAD_GL_ARB_buffer_storage != 0;
}

MappedBuffer::MappedBuffer(int slots, std::size_t bytes) {
  assert(0 < slots && slots <= most_slots);
  if (!available()) throw GraphicsError("this OpenGL has no ARB_buffer_storage");
  constexpr std::size_t page = PositionMemory::page;
  slot_bytes_ = (bytes + page - 1) / page * page;
  whole_ = std::size_t(slots) * slot_bytes_ + page;  // OpenGL may begin it anywhere in a page
  // Read too, and where the program's own memory is: the next step begins from what is drawn.
  constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  glBindBuffer(GL_ARRAY_BUFFER, id());
  glBufferStorage(GL_ARRAY_BUFFER, GLsizeiptr(whole_), nullptr, access | GL_CLIENT_STORAGE_BIT);
  mapped_ = static_cast<std::byte*>(glMapBufferRange(GL_ARRAY_BUFFER, 0, GLsizeiptr(whole_), access));
  if (mapped_ == nullptr) {
    glGetError();  // this sentence is its report
    throw GraphicsError("OpenGL could not allocate a persistently mapped buffer");
  }
  first_ = mapped_ + (page - reinterpret_cast<std::uintptr_t>(mapped_) % page) % page;
  std::memset(mapped_, 0, whole_);
}

MappedBuffer::~MappedBuffer() {
  for (const GLsync fence : fences_)
    if (fence != nullptr) glDeleteSync(fence);
}

std::optional<std::size_t> MappedBuffer::offset_of(const void* address) const {
  const auto at = reinterpret_cast<std::uintptr_t>(address), begin = reinterpret_cast<std::uintptr_t>(mapped_);
  return at >= begin && at < begin + whole_ ? std::optional(at - begin) : std::nullopt;
}

int MappedBuffer::slot_of(const void* address) const {
  assert(offset_of(address));
  return int((reinterpret_cast<std::uintptr_t>(address) - reinterpret_cast<std::uintptr_t>(first_)) / slot_bytes_);
}

void MappedBuffer::drawn(int slot) {
  GLsync& fence = fences_[std::size_t(slot)];
  if (fence != nullptr) glDeleteSync(fence);
  fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void MappedBuffer::wait(int slot) {
  GLsync& fence = fences_[std::size_t(slot)];
  if (fence == nullptr) return;
  constexpr GLuint64 long_enough = 2'000'000'000;  // ns: a driver that hangs is not waited for
  glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, long_enough);
  glDeleteSync(fence);
  fence = nullptr;
}

}  // namespace tyglab::gl
