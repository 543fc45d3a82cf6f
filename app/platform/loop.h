// The frame loop: a desktop program runs it, and a browser calls it.
#pragma once

#include <memory>

namespace tyglab {

/// The work of each frame, and of the end of the program.
class FrameLoop {
 public:
  FrameLoop() = default;
  virtual ~FrameLoop() = default;
  FrameLoop(const FrameLoop&) = delete;
  FrameLoop& operator=(const FrameLoop&) = delete;
  /// Runs one frame; returns false after the last one.
  virtual bool run_frame() = 0;
  /// Ends the program after the last frame, and returns its exit code.
  virtual int finish() = 0;
};

/// Makes all turns and returns what finish() does. A browser makes them after this has returned, with 0.
int run_frame_loop(std::unique_ptr<FrameLoop> loop);

}  // namespace tyglab
