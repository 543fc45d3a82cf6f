// What the sandbox is doing, as a JSON file that is written anew about ten times a second (--session-report): for tests
// that drive the window, and for a teacher's scripts. Nothing of it costs anything unless it is asked for.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>

namespace tyglab {

struct App;

class SessionReport {
 public:
  explicit SessionReport(std::filesystem::path file) : file_(std::move(file)) {}

  /// The Dear ImGui item drawn last is a control of that name. Controls that cannot be seen are left out.
  void add_control(std::string_view name);
  /// Ends a frame; rewrites the file when that is due. What goes wrong becomes one message, and ends the report.
  void end_frame(App& app);
  /// Writes the last one. Throws OutputError, also where an earlier one could not be written.
  void finish(const App& app);

 private:
  using Clock = std::chrono::steady_clock;
  struct Box {
    glm::vec2 at, size;  ///< pixels in the window
  };
  std::string json(const App& app, bool ended) const;

  std::filesystem::path file_;
  std::map<std::string, Box> drawing_, shown_;  ///< controls of the frame being drawn, and of the last whole one
  std::int64_t frames_ = 0;
  std::int64_t events_ = 0;  ///< keys and buttons that arrived
  Clock::time_point written_{};
  bool failed_ = false;
};

/// Names the item drawn last for the session report, if there is one: the region or "dialog" or "menu" that it stands
/// in, a dot, and `name` with _ for all but letters and digits: "top.play", "constants.k_s.slider", "dialog.Save".
void report_control(App& app, std::string_view name);

}  // namespace tyglab
