// Writes out the picked particle's next step while a card shows it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/step_trace.h"

namespace tyglab {

struct Session;

class StepInspector {
 public:
  static constexpr int largest = 256 * 256;  ///< particles of a cloth whose step is written out

  /// Called in every update in which it is wanted. The step that the cloth would make next; of a moving cloth the one
  /// of some updates ago, since nobody could read it faster.
  void update(const Session& session);
  /// The one worked out last; nullptr where there is none to show.
  const StepTrace* shown() const { return trace_ ? &*trace_ : nullptr; }
  void drop() { trace_.reset(), revision_ = ~0ull; }

 private:
  std::optional<StepTrace> trace_;
  std::uint64_t revision_ = ~0ull;
  double looked_ = -1;  ///< s on the session's clock
};

}  // namespace tyglab
