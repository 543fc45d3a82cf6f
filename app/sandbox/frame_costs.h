// What a frame costs, by part.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace tyglab {

enum class Part { simulate, upload, draw_cloth, panels, ui_draw, swap, frame };
inline constexpr std::array<std::string_view, 7> part_names{"simulate", "upload", "draw_cloth", "panels",
                                                            "ui_draw",  "swap",   "frame"};

class FrameCosts {
 public:
  using Clock = std::chrono::steady_clock;
  /// Counts the time from its making to its end towards a part.
  class Timer {
   public:
    Timer(FrameCosts& costs, Part part) : costs_(costs), part_(part), start_(Clock::now()) {}
    ~Timer() { costs_.add(part_, std::chrono::duration<double>(Clock::now() - start_).count()); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

   private:
    FrameCosts& costs_;
    Part part_;
    Clock::time_point start_;
  };

  void add(Part part, double seconds) { seconds_[std::size_t(part)] += seconds, ++counts_[std::size_t(part)]; }
  void add_steps(std::int64_t steps) { steps_ += steps; }
  double mean_ms(Part part) const {
    const std::int64_t frames = counts_[std::size_t(Part::frame)];
    return frames > 0 ? 1e3 * seconds_[std::size_t(part)] / double(frames) : 0;
  }
  /// JSON: mean milliseconds a frame by part, how often each part ran, frames, steps, size of the window.
  std::string json(int width, int height, const std::string& engine, const std::string& preset) const;

 private:
  std::array<double, part_names.size()> seconds_{};
  std::array<std::int64_t, part_names.size()> counts_{};
  std::int64_t steps_ = 0;
};

}  // namespace tyglab
