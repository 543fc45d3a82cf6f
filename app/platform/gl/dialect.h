// The differences between desktop OpenGL and that of browsers (WebGL 2); all other calls are identical.
#pragma once

#include <cstdint>
#include <vector>

namespace tyglab {

/// The first line of every shader.
const char* shader_version();
/// The lines between that line and the shader's own text, if any.
const char* shader_preamble();
/// Enables the features that are always on in browsers: multisampling, and points sized by shaders.
void enable_smooth_edges_and_point_sizes();
/// Whether GL_TIME_ELAPSED can be asked for.
bool drawing_can_be_timed();
/// The lower left part of the framebuffer bound for reading: red, green and blue of each pixel, the top row first.
std::vector<std::uint8_t> read_pixels(int width, int height);

}  // namespace tyglab
