// Memory for positions that the drawing code lends to an engine, so the engine writes them where they are drawn.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace tyglab {

/// Slots of one size, each for the positions of a whole cloth, in the program's own memory. An engine keeps its
/// positions in any of them and moves from one to another as it steps, but never writes the slot that is being drawn.
/// So it never waits for the drawing, and nothing is drawn while it is written.
struct PositionMemory {
  static constexpr int count = 3;            ///< one is drawn, one is read, one is written
  static constexpr std::size_t page = 4096;  ///< slots begin at multiples of it, bytes
  std::array<void*, count> slots{};          ///< filled with zeros
  std::size_t bytes = 0;                     ///< of each
  std::atomic<int> shown = -1;  ///< the slot that is being drawn; -1: none. Steps may go on beside the drawing
  PositionMemory() = default;
  PositionMemory(const PositionMemory&) = delete;
  PositionMemory& operator=(const PositionMemory&) = delete;
  virtual ~PositionMemory() = default;
};

}  // namespace tyglab
