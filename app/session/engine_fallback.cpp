#include "app/session/engine_fallback.h"

#include "app/base/numbers.h"
#include "app/session/rebuild.h"

namespace tyglab {

void fall_back(App& app, const std::string& why) {
  Preset next = app.preset();
  if (next.engine == EngineKind::cpu) throw EngineError(why);
  next.engine = EngineKind::cpu;
  auto simulation = std::make_unique<Simulation>(next, app.threads);
  if (const Snapshot* then = app.rewind.before(*simulation, app.simulation->time(), 0)) simulation->restore(*then);
  app.messages.error(why + " The CPU engine goes on from t = " + time_number(simulation->time(), next.dt) + " s.");
  app.tool.kind = Tool::Kind::none;
  swap_in(app, std::move(simulation));
}

}  // namespace tyglab
