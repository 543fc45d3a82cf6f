#pragma once

#include <stdexcept>

namespace tyglab {

/// OpenGL (or EGL) cannot do what is asked. `what()` says what and how to fix it; a shader's log is in it.
class GraphicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tyglab
