// The order of convergence of the present motion, measured beside the frames once somebody asks for it.
#pragma once

#include <memory>
#include <optional>

#include "app/studies/background.h"
#include "core/analysis/convergence.h"

namespace tyglab {

struct App;

class ConvergenceWatch {
 public:
  static constexpr double window = 0.25;  ///< s of motion, where it does not take too long

  bool shown = false;  ///< the accuracy card shows it, in place of error over cost

  /// Measures from the present moment on; what was in work is dropped.
  void begin(App& app);
  /// Called in every frame that shows it: begins where nothing is known, and anew once constants have changed.
  void poll(App& app);
  /// What is in work is stopped and forgotten.
  void drop();
  /// A copy of what is known; none while nothing is.
  std::optional<Convergence> study() const;

 private:
  Background<Convergence> work_;
  double changed_ = -1;  ///< s, as the window counts; when the constants last differed from those of the study
};

}  // namespace tyglab
