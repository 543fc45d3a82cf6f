// Plays a lab without a window: what a student would do, with the frames that pass meanwhile.
#pragma once

#include <string>

#include "app/ui/app.h"

namespace tyglab::test {

class LabPlayer {
 public:
  explicit LabPlayer(const std::string& label);
  App& app() { return app_; }
  const LabRun& lab() const { return *app_.labs.run; }
  bool done() const { return lab().record().done; }
  bool right() const { return lab().record().right; }

  /// Types a prediction, or chooses the sentence of that number.
  void predict(const std::string& number);
  void choose(int choice);
  /// "k_s=200", at once.
  void set(const std::string& setting);
  /// Runs until it has lasted so many simulated seconds more, the step stops it, it diverges, or the step is done.
  void run(double seconds);
  /// A frame in which nothing is done, once the limits and the study (of those that are open) are there.
  void look();
  bool accuracy_open = false;
  /// The next step, which opens its preset.
  void next();
  /// Opens what the lab has asked for.
  void take_requests();

 private:
  void frame(int steps);
  App app_;
};

}  // namespace tyglab::test
