// A long list of numbers that shaders look up by index: the equivalent of a buffer texture, which OpenGL ES lacks.
#pragma once

#include <cstddef>

#include "app/render/gl_objects.h"
#include "app/render/vertex_memory.h"

namespace tyglab {

class TexelArray {
 public:
  enum class Of { floats, index_pairs };
  explicit TexelArray(Of what);
  /// Takes that many texels from memory.
  void take(const void* data, std::size_t texels);
  /// Takes them from a vertex buffer; they stay on their side of the bus.
  void take(const VertexSource& source, std::size_t texels);
  /// Binds it to a texture unit. Texel k is at (k & 4095, k >> 12).
  void bind(int unit) const;
  std::size_t bytes() const;

 private:
  static constexpr std::size_t widest = 4096;  ///< which all graphics cards have that run OpenGL 3.3
  void write(const std::byte* from, std::size_t texels);

  Of of_;
  gl::Texture texture_;
  int width_ = 0, height_ = 0;
};

}  // namespace tyglab
