#include "app/studies/engine_search.h"

#include <chrono>
#include <exception>

#include "app/ui/app.h"

namespace tyglab {

void EngineSearch::begin(const App& app) {
  if (busy()) return;
  work_ = std::async(std::launch::async, [preset = app.requested_preset(), threads = app.threads] {
    return choose_engine(preset, threads);
  });
}

void EngineSearch::poll(App& app) {
  if (!busy() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    const EngineChoice choice = work_.get();
    Preset next = app.requested_preset();
    next.engine = choice.engine;
    if (next.engine == EngineKind::opencl) next.device = choice.device;
    if (next != app.requested_preset()) app.propose(std::move(next));
    app.messages.note("Automatic: " + choice.why + ".");
  } catch (const std::exception& error) {
    app.messages.error(error.what());
  }
  app.pacing.restart_measure();
}

}  // namespace tyglab
