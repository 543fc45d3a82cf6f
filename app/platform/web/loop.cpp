#include "app/platform/loop.h"

#include <emscripten.h>

#include <utility>

namespace tyglab {
namespace {

std::unique_ptr<FrameLoop>& present_loop() {
  static std::unique_ptr<FrameLoop> loop;
  return loop;
}

void one_frame() {
  if (present_loop()->run_frame()) return;
  emscripten_cancel_main_loop();
  present_loop()->finish();
}

}  // namespace

int run_frame_loop(std::unique_ptr<FrameLoop> loop) {
  present_loop() = std::move(loop);
  emscripten_set_main_loop(one_frame, 0, false);
  return 0;
}

}  // namespace tyglab
