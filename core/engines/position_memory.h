// Memory for positions that whoever draws them hands to an engine, so that they are written where they are read.
#pragma once

#include <array>
#include <cstddef>

namespace tyglab {

/// Slots of one size, each for the positions of a whole cloth, in the program's own memory. An engine keeps its
/// positions in any of them, and goes from one to another as it steps; the one that is shown it only reads. So it never
/// waits for who draws, and nobody draws what is being written.
struct PositionMemory {
  static constexpr int count = 3;            ///< one is drawn, one is read and one is written
  static constexpr std::size_t page = 4096;  ///< slots begin at multiples of it, bytes
  std::array<void*, count> slots{};          ///< full of zeros
  std::size_t bytes = 0;                     ///< of each
  int shown = -1;                            ///< the slot that is being drawn; -1: none
  PositionMemory() = default;
  PositionMemory(const PositionMemory&) = delete;
  PositionMemory& operator=(const PositionMemory&) = delete;
  virtual ~PositionMemory() = default;
};

}  // namespace tyglab
