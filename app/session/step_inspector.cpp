#include "app/session/step_inspector.h"

#include <algorithm>

#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr double moving_pause = 0.25;  // s between two looks at a moving cloth

}  // namespace

const StepTrace* StepInspector::look(App& app) {
  const Simulation& simulation = *app.simulation;
  const bool there = app.picked && app.preset().kind == Kind::cloth && !simulation.divergence() &&
                     !app.building.holds_present() && simulation.lattice().size() <= largest;
  if (!there) {
    drop();
    return nullptr;
  }
  const bool other = !trace_ || trace_->i != app.picked->i || trace_->j != app.picked->j;
  const bool moved = revision_ != simulation.revision();
  if (!other && !moved) return &*trace_;
  if (!other && app.pacing.playing && app.ui.now < looked_ + moving_pause) return &*trace_;
  trace_ = trace_step(simulation, app.picked->i, app.picked->j);
  revision_ = simulation.revision();
  looked_ = app.ui.now;
  return &*trace_;
}

}  // namespace tyglab
