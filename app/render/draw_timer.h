// Measures how long the graphics card takes to draw, without waiting for it.
#pragma once

#include "app/render/gl_objects.h"

namespace tyglab {

class DrawTimer {
 public:
  /// What is drawn between these two is measured, unless an earlier drawing still is.
  void begin();
  void end();
  /// Of the last drawing that is known, ms; 0 before the first.
  double ms();

 private:
  gl::Query query_;
  bool running_ = false, asked_ = false;
  double ms_ = 0;
};

}  // namespace tyglab
