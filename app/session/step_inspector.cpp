#include "app/session/step_inspector.h"

#include "app/session/session.h"

namespace tyglab {
namespace {

constexpr double moving_pause = 0.25;  // s between two looks at a moving cloth

}  // namespace

void StepInspector::update(const Session& session) {
  const Simulation& simulation = *session.simulation;
  const bool there = session.picked && session.preset().kind == Kind::cloth && !simulation.divergence() &&
                     !session.rebuild.holds_present() && simulation.lattice().size() <= largest;
  if (!there) return drop();
  const bool other = !trace_ || trace_->i != session.picked->i || trace_->j != session.picked->j;
  const bool moved = revision_ != simulation.revision();
  if (!other && (!moved || (session.pacing.playing && session.now < looked_ + moving_pause))) return;
  trace_ = trace_step(simulation, session.picked->i, session.picked->j);
  revision_ = simulation.revision();
  looked_ = session.now;
}

}  // namespace tyglab
