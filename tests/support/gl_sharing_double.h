// What the double of a device that shares buffers with OpenGL has seen (gl_sharing_double.cpp).
#pragma once

#include <cstdint>

namespace tyglab::test {

struct GlDoubleCounts {
  int contexts = 0, buffers = 0;  ///< shared with OpenGL, that are there now
  std::int64_t acquired = 0;      ///< how often
  std::uint64_t read = 0;         ///< bytes that the program read of devices' memory, whatever they were
};

}  // namespace tyglab::test

extern "C" {
/// Of the layer, which the loader has in memory: to be found by its name.
tyglab::test::GlDoubleCounts tyglab_gl_double_counts();
}
