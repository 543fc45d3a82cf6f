// "Find settings": searches in the background, on request, for methods and dt that keep an error in the motion from now
// on, and for their cost; dropped when nothing shows it any more.
#pragma once

#include <optional>

#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/analysis/settings_search.h"

namespace tyglab {

class SettingsWatch {
 public:
  static constexpr double window = 1;  ///< s of motion

  /// Asks for settings with that error, m. What an earlier search measured answers it where it went as far; otherwise
  /// a new one begins with the next poll.
  void ask(double tolerance, const Preset& preset);
  /// Called in every frame in which it is wanted.
  void poll(StudyMoment& moment);
  /// Stops the search; its findings are kept.
  void stop();
  /// Whether an unfinished search is requested.
  bool searching() const;
  /// Whether the newest was stopped before its end.
  bool stopped() const { return stopped_; }
  /// Stops the search and discards everything.
  void drop();

  /// The requested error, m; none before the first request.
  std::optional<double> tolerance() const { return tolerance_; }
  /// A copy of the results; none while there are none.
  std::optional<SettingsSearch> search() const { return work_.findings(); }
  /// Whether the results belong to these constants, apart from the method, its dt and the precision.
  static bool is_about(const SettingsSearch& search, const Preset& preset);

 private:
  using Work = Study<SettingsSearch>;

  Work work_;
  std::optional<double> tolerance_;
  bool asked_ = false;    ///< and not begun yet
  bool stopped_ = false;  ///< by stop()
};

}  // namespace tyglab
