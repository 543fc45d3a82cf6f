// Measures the order of convergence of the present motion in the background, on request.
#pragma once

#include <memory>
#include <optional>

#include "app/studies/findings.h"
#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/analysis/convergence.h"

namespace tyglab {

class ConvergenceWatch {
 public:
  static constexpr double window = 0.25;  ///< s of motion, where it does not take too long

  /// Measures from the present moment on; what was running is dropped.
  void begin(StudyMoment& moment);
  /// Called in every frame in which it is wanted: begins where nothing is known, and again once constants have changed.
  void poll(StudyMoment& moment);
  /// What is running is stopped and forgotten.
  void drop();
  /// A copy of what is known; none while nothing is.
  std::optional<Convergence> study() const;

 private:
  Study<Convergence> work_;
  double changed_ = -1;  ///< s on the session's clock; when the constants last differed from those of the study
};

}  // namespace tyglab
