// The picked particle's next step, written out while a panel shows it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/step_trace.h"

namespace tyglab {

struct App;

class StepInspector {
 public:
  static constexpr int largest = 256 * 256;  ///< particles of a cloth whose step is written out

  /// Called in every frame that shows it. The step that the cloth would make next; of a moving cloth the one of some
  /// frames ago, since nobody could read it faster. nullptr where there is none to show.
  const StepTrace* look(App& app);
  /// The one looked at last; nullptr once nothing shows it.
  const StepTrace* shown() const { return trace_ ? &*trace_ : nullptr; }
  void drop() { trace_.reset(), revision_ = ~0ull; }

 private:
  std::optional<StepTrace> trace_;
  std::uint64_t revision_ = ~0ull;
  double looked_ = -1;  ///< s, as the window counts
};

}  // namespace tyglab
