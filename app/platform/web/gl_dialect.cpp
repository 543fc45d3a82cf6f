#include "app/platform/gl/dialect.h"

#include <glad/gl.h>

namespace tyglab {

const char* shader_version() {
  return "#version 300 es";
}

const char* shader_preamble() {
  return "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
         "precision highp sampler2DShadow;\nprecision highp usampler2D;\n";
}

void enable_smooth_edges_and_point_sizes() {}

bool drawing_can_be_timed() {
  return false;
}

std::vector<std::uint8_t> read_pixels(int width, int height) {
  std::vector<std::uint8_t> rgba(std::size_t(4) * width * height), rgb(std::size_t(3) * width * height);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb[3 * (std::size_t(height - 1 - y) * width + x) + c] = rgba[4 * (std::size_t(y) * width + x) + c];
  return rgb;
}

}  // namespace tyglab
