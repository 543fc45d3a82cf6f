// The cost of each part of a frame.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>

#include "app/base/vertex_path.h"

// Measures durations: in real time, and in processor time of the current thread.

namespace tyglab {

struct Duration {
  double wall_s = 0, cpu_s = 0;
};

/// Adds the time of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(Duration& sum) : sum_(sum) {}
  ~Stopwatch() {
    sum_.wall_s += std::chrono::duration<double>(Clock::now() - start_).count();
    sum_.cpu_s += thread_cpu_s() - cpu_start_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  static double thread_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }
  Duration& sum_;
  Clock::time_point start_ = Clock::now();
  double cpu_start_ = thread_cpu_s();
};

enum class Part {
  simulate,
  sample,
  colors,
  normals,
  upload,
  index_lists,
  shadow,
  draw_cloth,
  panels,
  ui_draw,
  swap,
  frame
};
inline constexpr std::array<std::string_view, 12> part_names{"simulate", "sample",      "colors", "normals",
                                                             "upload",   "index_lists", "shadow", "draw_cloth",
                                                             "panels",   "ui_draw",     "swap",   "frame"};

/// The parts of a start, from the start of the program to its first picture, in order.
enum class StartPart { program, settings, window, shaders, cloth, first_frame };
inline constexpr std::array<std::string_view, 6> start_names{"program", "settings", "window",
                                                             "shaders", "cloth",    "first_frame"};

class FrameCosts {
 public:
  /// Starts with the earlier parts: loading the program, and reading its arguments.
  FrameCosts() { started(StartPart::program); }

  /// Counts the time of its life toward a part.
  class Timer {
   public:
    Timer(FrameCosts& costs, Part part) : watch_(costs.now_[std::size_t(part)]) {}

   private:
    Stopwatch watch_;
  };

  /// Adds a time that was measured elsewhere in this frame.
  void add(Part part, const Duration& time) {
    now_[std::size_t(part)].wall_s += time.wall_s, now_[std::size_t(part)].cpu_s += time.cpu_s;
  }
  /// Ends that part of the start.
  void started(StartPart part);
  void add_steps(std::int64_t steps) { steps_ += steps; }
  /// Records the path of a moved cloth to OpenGL, the bytes copied for it and the reason, and the bytes that others
  /// have read of a device's arrays since the last call.
  void add_copied(VertexPath path, std::size_t bytes, const std::string& why, std::size_t read);
  /// Of the last such frame.
  VertexPath vertex_path() const { return vertex_path_; }
  const std::string& why_copied() const { return why_copied_; }
  std::size_t last_copied() const { return last_copied_; }
  /// Bytes per frame that others read, over about the last second.
  double recent_read() const { return recent_read_; }
  /// Ends the frame: the times of its parts enter the means.
  void end_frame();
  /// Milliseconds per frame, over about the last second; 0 once a part has not run for a while.
  double recent_ms(Part part) const { return recent_ms_[std::size_t(part)]; }
  /// JSON: mean milliseconds a frame by part (on the wall and of the main thread), how often each part ran, how
  /// positions come to be drawn, bytes copied and read in a frame in which the cloth had moved, what the start took by
  /// part, frames, steps, size of the window.
  std::string json(int width, int height, const std::string& engine, const std::string& preset) const;

 private:
  using Parts = std::array<Duration, part_names.size()>;
  Parts now_{}, sum_{};
  std::array<double, part_names.size()> recent_ms_{};
  std::array<std::int64_t, part_names.size()> counts_{};
  std::int64_t frames_ = 0, steps_ = 0;
  VertexPath vertex_path_ = VertexPath::copied;
  std::string why_copied_;
  std::optional<std::size_t> copied_now_;  ///< of this frame; none: nothing had moved
  std::size_t read_now_ = 0;
  std::size_t last_copied_ = 0, copied_ = 0, read_ = 0;
  double recent_read_ = 0;
  std::int64_t moved_ = 0;                              ///< frames in which the cloth had moved
  std::array<double, start_names.size()> started_s_{};  ///< since the program began
};

}  // namespace tyglab
