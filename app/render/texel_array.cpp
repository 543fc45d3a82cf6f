#include "app/render/texel_array.h"

#include <algorithm>

#include "app/render/value_texture.h"

namespace tyglab {
namespace {

struct Format {
  GLint internal;
  GLenum layout, type;
  std::size_t bytes;
};

constexpr Format format_of(TexelArray::Of what) {
  if (what == TexelArray::Of::floats) return {GL_R32F, GL_RED, GL_FLOAT, 4};
  return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8};
}

}  // namespace

TexelArray::TexelArray(Of what) : of_(what) {
  set_up_texture(texture_, GL_NEAREST);
}

void TexelArray::take(const void* data, std::size_t texels) {
  write(static_cast<const std::byte*>(data), texels);
}

void TexelArray::take(const VertexSource& source, std::size_t texels) {
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, source.buffer);
  write(reinterpret_cast<const std::byte*>(source.offset), texels);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

/// From memory, or from that offset in the buffer bound for it. Keeps the texture's storage while its size stays.
void TexelArray::write(const std::byte* from, std::size_t texels) {
  if (texels == 0) return;
  const Format format = format_of(of_);
  const std::size_t width = std::min(texels, widest), full = texels / width, rest = texels % width;
  const int height = int(full + (rest > 0));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  if (int(width) != width_ || height != height_) {
    width_ = int(width), height_ = height;
    GLint source = 0;  // storage alone is asked for here, not a copy
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &source);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, format.internal, width_, height_, 0, format.layout, format.type, nullptr);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(source));
  }
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, int(full), format.layout, format.type, from);
  if (rest > 0)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, int(full), int(rest), 1, format.layout, format.type,
                    from + full * width * format.bytes);
  glBindTexture(GL_TEXTURE_2D, 0);
}

void TexelArray::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

std::size_t TexelArray::bytes() const {
  return std::size_t(width_) * std::size_t(height_) * format_of(of_).bytes;
}

}  // namespace tyglab
