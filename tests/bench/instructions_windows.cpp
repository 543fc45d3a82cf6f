#include "tests/bench/instructions.h"

namespace tyglab {

// There is no valgrind for Windows.
InstructionCounter::InstructionCounter(std::filesystem::path tyglab) : tyglab_(std::move(tyglab)) {}

std::string InstructionCounter::instruction_set() const {
  return {};
}

std::optional<double> InstructionCounter::per_particle_step(const CountedCase&) const {
  return {};
}

}  // namespace tyglab
