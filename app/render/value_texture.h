// Numbers for shaders: a value of every particle, and the colors of values.
#pragma once

#include <cstdint>
#include <span>

#include "app/render/gl_objects.h"

namespace tyglab {

/// Lets a texture be looked up with that filter, without a repetition beyond its edges.
void set_up_texture(const gl::Texture& texture, GLint filter);

class ValueTexture {
 public:
  /// `filter`: GL_NEAREST, or GL_LINEAR between neighbors.
  explicit ValueTexture(GLint filter);
  /// Rows of numbers.
  void take(std::span<const float> values, int rows, int columns);
  /// One row of colors, as bytes red, green, blue, opacity.
  void take(std::span<const std::uint32_t> colors);
  /// Binds it to a texture unit.
  void bind(int unit) const;
  std::size_t bytes() const { return 4 * std::size_t(rows_) * std::size_t(columns_); }

 private:
  void write(GLint format, GLenum layout, GLenum type, const void* data, int rows, int columns);

  gl::Texture texture_;
  int rows_ = 0, columns_ = 0;
};

}  // namespace tyglab
