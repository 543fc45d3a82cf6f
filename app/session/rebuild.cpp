#include "app/session/rebuild.h"

#include <cassert>
#include <utility>

#include "app/session/document.h"
#include "app/session/session.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

constexpr double many_particles = 1e5;  // built in about a frame's time

/// Whose programs an OpenCL device must build before the cloth and its copies have the preset's constants: presets, the
/// cloth's own first.
std::vector<Preset> without_programs(const Session& session, const Preset& preset) {
  std::vector<Preset> found;
  if (session.scripted) return found;
  const bool prepares = bool(session.rebuild.prepare_programs);
  const bool same_device = !changes(session.preset(), preset).touches({Effect::engine, Effect::device});
  const bool ready = same_device && (!prepares || session.simulation->engine().ready_for(preset));
  if (preset.engine == EngineKind::opencl && !ready) found.push_back(preset);
  const Lockstep& copies = session.copies.lockstep;
  for (std::size_t n = 0; prepares && n < copies.size(); ++n) {
    Preset copied = preset;
    for (const Difference& difference : copies[n].differences) difference.apply(copied);
    const bool built = copies[n].simulation->engine().ready_for(copied);
    if (copied.engine == EngineKind::opencl && !built) found.push_back(std::move(copied));
  }
  return found;
}

}  // namespace

double particles(const Preset& preset) {
  return double(lattice_of(preset).size());
}

bool needs_programs(const Session& session, const Preset& preset) {
  return !without_programs(session, preset).empty();
}

bool takes_long(const Session& session, const Preset& preset) {
  return !session.scripted && (particles(preset) >= many_particles || needs_programs(session, preset));
}

void swap_in(Session& session, std::shared_ptr<Simulation> simulation) {
  assert(simulation != nullptr);
  std::shared_ptr<Simulation> last = std::exchange(session.simulation, std::move(simulation));
  copies_resume(session);
  session.rebuild.dispose(std::move(last));
  session.sleep = Sleep{};
  ++session.counts.cloths;  // its count of changes may be that of the last one
}

void BackgroundRebuild::order(const Session& session, BuildOrder order, History before) {
  assert(!order.programs || (order.fresh && !order.restarts && !order.document));
  next_ = std::move(order);
  if (busy()) return;  // a cloth cannot be left half built: the next one follows it
  before_ = std::move(before);
  start(session);
}

void BackgroundRebuild::start(const Session& session) {
  assert(next_ && !busy());
  making_ = std::move(*next_);
  next_.reset();
  dropped_ = false;
  std::vector<Preset> unbuilt;
  if (prepare_programs) unbuilt = without_programs(session, making_->target);
  const bool ledger = session.simulation->ledger().has_value();
  // It owns the present cloth as long as it reads it, whatever the session shows by then.
  std::shared_ptr<const Simulation> present = making_->fresh ? nullptr : session.simulation;
  work_.start(
      Priority::normal,
      [prepare = prepare_programs, unbuilt = std::move(unbuilt), ledger, order = *making_, present = std::move(present),
       before = before_reading, threads = session.threads](const JobControl&) -> BuiltCloth {
        for (const Preset& preset : unbuilt) prepare(preset, ledger);
        BuiltCloth built;
        if (order.programs) return built;
        if (order.document) {
          built.simulation = make_simulation(order.target, threads, built.fallback);
        } else if (order.fresh) {
          built.simulation = std::make_unique<Simulation>(order.target, threads);
        } else {
          if (before) before();
          built.simulation = present->rebuilt(edit::Change{order.target});
        }
        return built;
      });
}

void BackgroundRebuild::rename(const std::string& name, const std::string& description) {
  for (auto* order : {&making_, &next_})
    if (*order) (*order)->target.name = name, (*order)->target.description = description;
}

void BackgroundRebuild::poll(Session& session) {
  if (!busy()) return;
  ++frames_beside_;
  if (!work_.ready()) return;
  settle(session);
  auto outcome = work_.take();
  if (const auto* failure = std::get_if<JobError>(&outcome)) {
    give_up(session, *failure);
  } else {
    try {
      finish(session, std::get<BuiltCloth>(std::move(outcome)));
    } catch (const std::bad_alloc&) {
      give_up(session, {.what = {}, .out_of_memory = true});
    } catch (const std::exception& error) {
      give_up(session, {error.what()});
    }
  }
  if (busy()) return;
  const std::vector<Edit> deferred = std::move(deferred_);
  deferred_.clear();
  for (const Edit& edit : deferred) apply_edit(session, edit);
}

void BackgroundRebuild::give_up(Session& session, const JobError& why) {
  // Nothing is being made any more where it was made and could not be taken.
  const bool stays = making_ && making_->target.engine != EngineKind::cpu && session.preset().engine == EngineKind::cpu;
  making_.reset(), next_.reset();
  session.history = std::move(before_);
  session.messages.error(
      why.out_of_memory ? "There is not enough memory for that cloth. Nothing was changed; try fewer rows and columns."
                        : sentence(why.what) + (stays ? " The CPU engine continues." : ""));
}

/// Whether what has been made is what is wanted, or on the way to it.
bool BackgroundRebuild::available(const BuildOrder& made) const {
  if (dropped_) return false;
  if (!next_) return true;
  const bool alike = !changes(made.target, next_->target).touches(Effect::rebuild);
  return alike && !made.document && !next_->document && (made.fresh || !next_->fresh);
}

void BackgroundRebuild::finish(Session& session, BuiltCloth made) {
  assert(making_);
  BuildOrder order = *std::exchange(making_, std::nullopt);
  const bool use = available(order);
  dropped_ = false;
  if (!use) {
    dispose(std::move(made.simulation));
    if (next_) start(session);
    return;
  }
  take(session, std::move(made), std::move(order));
  if (next_) continue_with_next(session);
}

void BackgroundRebuild::take(Session& session, BuiltCloth made, BuildOrder order) {
  assert(order.programs == (made.simulation == nullptr));
  assert(order.programs ||
         made.simulation->lattice().sites() == lattice_of(order.target));  // nothing that was not ordered
  edit::Change change{order.target};
  if (order.programs) {
    change_and_follow(session, change);
    return;
  }
  change.preset.engine = made.simulation->preset().engine;  // the CPU's, where the device failed
  if (!(change.preset == made.simulation->preset())) made.simulation->apply(change);  // it has been renamed
  if (!made.fallback.empty()) session.messages.warning(std::move(made.fallback));
  take_built(session, std::move(made.simulation), std::move(order));
}

/// Continues with the request that came during the build.
void BackgroundRebuild::continue_with_next(Session& session) {
  assert(next_ && !busy());
  const edit::Change change{next_->target};
  if (change.preset == session.preset()) return next_.reset();
  next_->programs = !session.simulation->rebuilds(change);
  next_->fresh = next_->programs;
  if (!next_->programs || needs_programs(session, change.preset)) return start(session);
  next_.reset();
  change_and_follow(session, change);
}

bool BackgroundRebuild::ledger_ready(const Session& session) {
  if (ledger_programs_.busy()) {
    if (!ledger_programs_.ready()) return false;
    ledger_programs_.take();
    return true;  // from disk, or built here where that did not work
  }
  if (session.scripted || !prepare_programs || session.simulation->engine().ready_for_contacts()) return true;
  ledger_programs_.start(Priority::normal, [prepare = prepare_programs, preset = session.preset()](const JobControl&) {
    prepare(preset, true);
    return std::monostate();
  });
  return false;
}

void BackgroundRebuild::dispose(std::shared_ptr<Simulation> simulation) {
  if (simulation == nullptr || simulation->lattice().size() < many_particles) return;
  disposal_.start(Priority::normal, [gone = std::move(simulation)](const JobControl&) mutable {
    gone.reset();
    return std::monostate();
  });
}

}  // namespace tyglab
