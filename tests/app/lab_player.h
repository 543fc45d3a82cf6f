// Plays a lab without a window: what a student would do, with the updates of the session that pass meanwhile.
#pragma once

#include <string>

#include "app/session/session.h"

namespace tyglab::test {

class LabPlayer {
 public:
  explicit LabPlayer(const std::string& label);
  Session& session() { return session_; }
  const LabRun& lab() const { return *session_.labs.run; }
  bool done() const { return lab().record().done; }
  bool right() const { return lab().record().right; }

  /// Types a prediction, or chooses the sentence of that number.
  void predict(const std::string& number);
  void choose(int choice);
  /// "k_s=200", at once.
  void set(const std::string& setting);
  /// Runs until it has lasted so many simulated seconds more, the step stops it, it diverges, or the step is done.
  void run(double seconds);
  /// Updates in which nothing is done, until the limits and the study (of those that are open) are there.
  void look();
  bool accuracy_open = false;
  /// The next step, which opens its preset.
  void next();
  /// One update, in which what was asked for is done.
  void update(double seconds = 0);

 private:
  Session session_;
};

}  // namespace tyglab::test
