// How a cloth's positions come to where OpenGL draws them.
#pragma once

#include <string_view>

namespace tyglab {

enum class VertexWay {
  shared_buffer,  ///< the device writes OpenGL's own buffer (cl_khr_gl_sharing)
  shared_memory,  ///< the device, a processor, works in OpenGL's memory (ARB_buffer_storage)
  copied,         ///< the program copies them, once a frame
};

/// "shared_buffer", as files have it.
constexpr std::string_view name_of(VertexWay way) {
  return way == VertexWay::shared_buffer   ? "shared_buffer"
         : way == VertexWay::shared_memory ? "shared_memory"
                                           : "copied";
}

}  // namespace tyglab
