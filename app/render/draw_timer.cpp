#include "app/render/draw_timer.h"

#include "app/platform/gl/dialect.h"

namespace tyglab {

void DrawTimer::begin() {
  if (asked_ || !drawing_can_be_timed()) return;
  glBeginQuery(GL_TIME_ELAPSED, query_.id());
  running_ = true;
}

void DrawTimer::end() {
  if (!running_) return;
  glEndQuery(GL_TIME_ELAPSED);
  running_ = false, asked_ = true;
}

double DrawTimer::ms() {
  GLint there = 0;
  if (asked_) glGetQueryObjectiv(query_.id(), GL_QUERY_RESULT_AVAILABLE, &there);
  if (there == 0) return ms_;
  GLuint nanoseconds = 0;
  glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &nanoseconds);
  asked_ = false;
  return ms_ = 1e-6 * nanoseconds;
}

}  // namespace tyglab
