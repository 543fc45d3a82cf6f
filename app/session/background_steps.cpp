#include "app/session/background_steps.h"

#include <cassert>
#include <new>
#include <utility>

#include "app/session/session.h"
#include "core/integrators/scheme.h"
#include "core/model/preset.h"

namespace tyglab {
namespace {

bool may_take_long(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  return is_implicit(method) || chooses_steps(method) || projects(method);
}

/// What was only seen of the stand-in and has been changed there.
void take_appearance(Simulation& cloth, const Simulation& stand_in) {
  if (!(cloth.preset() == stand_in.preset())) cloth.apply(edit::Change{stand_in.preset()});
}

}  // namespace

bool BackgroundSteps::wanted(const Session& session) {
  if (session.scripted || session.pacing.patient) return false;
  const Lockstep& copies = session.copies.lockstep;
  bool any = !session.simulation->divergence() && may_take_long(session.preset());
  for (std::size_t n = 0; n < copies.size(); ++n)
    any = any || (!copies[n].simulation->divergence() && may_take_long(copies[n].simulation->preset()));
  return any;
}

void BackgroundSteps::start(Session& session, int steps) {
  assert(steps >= 0 && !busy());
  assert(!session.rebuild.holds_present());  // who reads the cloth needs it to stand still
  Lockstep still = session.copies.lockstep.stand_in();
  std::shared_ptr<Simulation> shown = session.simulation->stand_in();
  cloth_ = std::exchange(session.simulation, std::move(shown));
  copies_ = std::exchange(session.copies.lockstep, std::move(still));
  begun_ = session.now;
  const double alone_until = session.copies.t + steps * session.preset().dt;
  const auto work = [cloth = cloth_, &copies = copies_, steps, alone_until](const JobControl& control) {
    const Stop stop = [&control] { return control.cancelled(); };
    const EngineKind engine = cloth->preset().engine;
    const double begun = computing_seconds(engine), begun_on_wall = wall_seconds();
    const bool diverged = cloth->divergence().has_value();
    cloth->stop_when(stop), copies.stop_when(stop);
    BackgroundResult made;
    made.advance = cloth->advance(steps);
    made.computing_s = computing_seconds(engine) - begun;
    made.steps = diverged ? steps : made.advance.steps;
    assert(made.steps >= 0 && made.steps <= steps);
    made.t = diverged ? alone_until : cloth->time();
    copies.follow(made.t);
    cloth->stop_when({}), copies.stop_when({});
    made.seconds = wall_seconds() - begun_on_wall;
    return made;
  };
  try {
    work_.start(Priority::normal, work);
  } catch (const std::bad_alloc&) {
    session.simulation = std::exchange(cloth_, nullptr);
    session.copies.lockstep = std::exchange(copies_, {});
    throw;
  }
}

BackgroundResult BackgroundSteps::take(Session& session) {
  assert(busy() && copies_.size() == session.copies.lockstep.size());
  auto outcome = work_.take();
  cloth_->stop_when({}), copies_.stop_when({});  // work that has failed has not come to that
  take_appearance(*cloth_, *session.simulation);
  for (std::size_t n = 0; n < copies_.size(); ++n)
    take_appearance(*copies_[n].simulation, *session.copies.lockstep[n].simulation);
  session.simulation = std::exchange(cloth_, nullptr);
  session.copies.lockstep = std::exchange(copies_, {});
  if (const auto* error = std::get_if<JobError>(&outcome)) {
    if (error->out_of_memory) throw std::bad_alloc();
    throw EngineError(error->what);
  }
  return std::get<BackgroundResult>(outcome);
}

void settle(Session& session) {
  if (!session.background_steps.busy()) return;
  session.background_steps.cancel();
  try {
    session.take_steps();
  } catch (const EngineError& error) {
    fall_back(session, error.what());
  } catch (const std::bad_alloc&) {
    // The cloth is that of the last whole step; whoever asked for the next one asks again.
  }
  assert(!session.background_steps.busy());
}

}  // namespace tyglab
