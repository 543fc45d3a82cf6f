#include "app/studies/engine_search.h"

namespace tyglab {

void EngineSearch::begin(const Preset& preset, int threads) {
  if (busy()) return;
  work_.start(Priority::normal, [preset, threads](const JobControl&) { return choose_engine(preset, threads); });
}

std::optional<std::variant<EngineChoice, JobError>> EngineSearch::take() {
  return work_.ready() ? std::optional(work_.take()) : std::nullopt;
}

}  // namespace tyglab
