// Counts instructions with valgrind's callgrind: unlike times, they do not depend on the load of the machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tests/bench/skip.h"

namespace tyglab {

/// One case of `bench skip --only`.
struct CountedCase {
  std::string feature;  ///< a name of skip_features
  SkipState state = SkipState::on;
  Precision precision = Precision::float_;
};

class InstructionCounter {
 public:
  /// `tyglab`: the program that is run under valgrind.
  explicit InstructionCounter(std::filesystem::path tyglab);

  /// Whether valgrind is on PATH.
  bool available() const { return !valgrind_.empty(); }
  /// Instructions per particle and step, without the start-up. Empty if valgrind cannot run the program, or does not
  /// find its symbols. May be called from several threads.
  std::optional<double> per_particle_step(const CountedCase& which) const;

  /// The instruction set that the engine picks under valgrind, which does not know all of them. Empty if valgrind
  /// cannot run the program.
  std::string instruction_set() const;

  static constexpr int side = 64;  ///< particles a side of the cloth that is counted
  static constexpr int steps = 64;

 private:
  std::filesystem::path tyglab_, valgrind_;
};

}  // namespace tyglab
