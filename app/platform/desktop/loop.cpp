#include "app/platform/loop.h"

namespace tyglab {

int run_frame_loop(std::unique_ptr<FrameLoop> loop) {
  while (loop->run_frame()) {
  }
  return loop->finish();
}

}  // namespace tyglab
