#include "app/render/value_texture.h"

namespace tyglab {

void set_up_texture(const gl::Texture& texture, GLint filter) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
}

ValueTexture::ValueTexture(GLint filter) {
  set_up_texture(texture_, filter);
}

void ValueTexture::take(std::span<const float> values, int rows, int columns) {
  write(GL_R32F, GL_RED, GL_FLOAT, values.data(), rows, columns);
}

void ValueTexture::take(std::span<const std::uint32_t> colors) {
  write(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, colors.data(), 1, int(colors.size()));
}

/// Keeps its storage while the size stays.
void ValueTexture::write(GLint format, GLenum layout, GLenum type, const void* data, int rows, int columns) {
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  if (rows == rows_ && columns == columns_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, layout, type, data);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, format, columns, rows, 0, layout, type, data);
    rows_ = rows, columns_ = columns;
  }
  glBindTexture(GL_TEXTURE_2D, 0);
}

void ValueTexture::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace tyglab
