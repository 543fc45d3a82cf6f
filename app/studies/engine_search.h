// The engine menu's "Automatic": measures in the background which engine is fastest with the present scene.
#pragma once

#include <optional>
#include <variant>

#include "app/studies/job.h"
#include "core/analysis/engine_choice.h"

namespace tyglab {

class EngineSearch {
 public:
  /// Begins to measure, unless it is doing so. The cloth must stand still meanwhile: its steps would be in the way.
  void begin(const Preset& preset, int threads);
  bool busy() const { return work_.busy(); }
  /// The choice, once, when it is known; what went wrong otherwise.
  std::optional<std::variant<EngineChoice, JobError>> take();

 private:
  Job<EngineChoice> work_;
};

}  // namespace tyglab
