// The state of the sandbox as a JSON file that is rewritten about ten times per second (--session-report), for tests
// that drive the window and for teachers' scripts. It costs nothing unless requested.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "app/ui/kit/widgets.h"

namespace tyglab {

struct Ui;

class SessionReport {
 public:
  explicit SessionReport(std::filesystem::path file) : file_(std::move(file)) {}

  /// To be told of controls.
  ControlPlaces& places() { return places_; }
  /// Ends a frame; rewrites the file when that is due. What goes wrong becomes one message, and ends the report.
  void end_frame(Ui& ui);
  /// Writes the last one. Throws OutputError, also where an earlier one could not be written.
  void finish(const Ui& ui);

 private:
  using Clock = std::chrono::steady_clock;
  std::string json(const Ui& ui, bool ended) const;

  std::filesystem::path file_;
  ControlPlaces places_;
  std::int64_t frames_ = 0;
  std::int64_t events_ = 0;  ///< keys and buttons that arrived
  Clock::time_point written_{};
  bool failed_ = false;
};

}  // namespace tyglab
