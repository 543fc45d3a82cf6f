// Plays a lab without a window: what a student would do, with the updates of the session that pass meanwhile.
#pragma once

#include <string>
#include <vector>

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
  /// Updates in which nothing is done, until the limits are there and, where the step shows the Accuracy card, what it
  /// measures; or until the step is done.
  void look();
  /// The same, until the crossings of the cloth have been counted.
  void count();
  /// The next step, which opens its preset.
  void next();
  /// The same though this one is not done.
  void skip();
  void restart();
  void set_up_again();
  void cut(const std::vector<Pins::Site>& sites);
  /// Grabs that particle and holds it there for so long.
  void pull(int i, int j, const glm::dvec3& to, double seconds);
  void release();
  /// What the card says of that check of the step.
  std::string card(std::size_t check);
  /// One update, in which what was asked for is done.
  void update(double seconds = 0);

 private:
  /// Updates until what was opened is there: on a device it is built beside the frames.
  void open();

  Session session_;
};

/// The step is done, and what was predicted is right.
void finish(LabPlayer& play);

}  // namespace tyglab::test
