// Measures the error of the present settings: short runs of the present motion, finer runs, and runs of other methods,
// in the background with low priority, while a card or lab requests them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/analysis/error_study.h"

namespace tyglab {

/// The results so far for the motion from one moment on.
struct AccuracyStudy {
  Preset of;      ///< the constants
  MotionMark at;  ///< the moment
  StudyReference reference;
  double reference_part = 0;          ///< of the steps of the runs that all are compared with, 0 to 1
  std::optional<ErrorPoint> present;  ///< the settings as they are
  std::vector<ErrorPoint> points;     ///< those of other methods, a method's one after the other
  int methods_done = 0;               ///< of AccuracyWatch::methods
  bool done = false;
  std::string problem;  ///< why there is nothing to show
};

template <class Visit>
void visit_parts(Visit&& visit, AccuracyStudy& study) {
  auto& [of, at, reference, reference_part, present, points, methods_done, done, problem] = study;
  visit(of, at, reference, reference_part, present, points, methods_done, done, problem);
}

class AccuracyWatch {
 public:
  static constexpr int largest = 256 * 256;  ///< particles that are checked beside the window
  static constexpr double window = 0.25;     ///< s of motion, where it does not take too long
  static constexpr int methods = 6;          ///< that are measured beside the present one

  /// Called in every frame in which it is wanted: begins a study where constants have changed, where the cloth stands
  /// at another moment than that of the last, and every few seconds while it moves.
  void poll(StudyMoment& moment);
  /// Stops and discards the study once nothing requests it.
  void drop();
  /// A copy of the results; none while there are none.
  std::optional<AccuracyStudy> study() const;
  /// The study that is being measured before it has results; none if there is none.
  std::optional<AccuracyStudy> measuring() const;
  double begun() const { return begun_; }  ///< s on the session's clock, of what is being measured

 private:
  using Work = Study<AccuracyStudy>;
  void begin(StudyMoment& moment);
  static void work(Work::Shared& shared, const StudyStart& start, const JobControl& control);

  Work work_;
  std::shared_ptr<Work::Shared> shown_;  ///< the last that has something to show
  double begun_ = -1;                    ///< s on the session's clock
  double changed_ = -1;                  ///< when constants or the moment last differed from the study's
};

}  // namespace tyglab
