#include "app/session/engine_fallback.h"

#include "app/base/numbers.h"
#include "app/session/rebuild.h"

namespace tyglab {

void fall_back(Session& session, const std::string& why) {
  Preset next = session.preset();
  if (next.engine == EngineKind::cpu) throw EngineError(why);
  next.engine = EngineKind::cpu;
  auto simulation = std::make_unique<Simulation>(next, session.threads);
  if (const Snapshot* then = session.rewind.before(*simulation, session.simulation->time(), 0))
    simulation->restore(*then);
  session.messages.error(why + " The CPU engine continues from t = " + time_number(simulation->time(), next.dt) +
                         " s.");
  ++session.counts.hands;
  swap_in(session, std::move(simulation));
}

}  // namespace tyglab
