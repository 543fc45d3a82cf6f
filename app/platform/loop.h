// The frame loop: a desktop program runs it, and a browser calls it.
#pragma once

#include <memory>

namespace tyglab {

/// What is done again and again until the program is to end.
class Turns {
 public:
  Turns() = default;
  virtual ~Turns() = default;
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;
  /// One turn; false once there is to be no other.
  virtual bool turn() = 0;
  /// After the last turn; returns the program's exit code.
  virtual int finish() = 0;
};

/// Makes all turns and returns what finish() does. A browser makes them after this has returned, with 0.
int make_turns(std::unique_ptr<Turns> turns);

}  // namespace tyglab
