// The engine menu's "Automatic": measures beside the frames which engine is quickest with the present scene.
#pragma once

#include <future>

#include "core/analysis/engine_choice.h"

namespace tyglab {

struct App;

class EngineSearch {
 public:
  /// Begins to measure, unless it is doing so. The cloth stands still meanwhile, since its steps would be in the way.
  void begin(const App& app);
  bool busy() const { return work_.valid(); }
  /// Called in every frame: once it is known, asks for the engine and says why.
  void poll(App& app);

 private:
  std::future<EngineChoice> work_;
};

}  // namespace tyglab
