#include "app/session/rebuild.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/session/document.h"
#include "app/ui/app.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

constexpr double many_particles = 1e5;  // built in about a frame's time

using Values = nlohmann::json;

Values rebased(const Values& before, const Values& after, const Values& present) {
  if (!before.is_object() || !after.is_object() || !present.is_object()) return before == after ? present : after;
  Values out = present;
  for (const auto& [key, value] : after.items())
    out[key] = rebased(before.value(key, Values()), value, present.value(key, Values()));
  return out;
}

}  // namespace

double particles(const Preset& preset) {
  return double(lattice_of(preset).size());
}

Preset rebased(const Preset& before, const Preset& after, const Preset& present) {
  const auto tree = [](const Preset& preset) { return Values::parse(preset_to_json(preset)); };
  Preset next = parse_preset(rebased(tree(before), tree(after), tree(present)).dump(), "the constants");
  next.device = after.device;  // in no file
  return next;
}

bool needs_programs(const App& app, const Preset& preset) {
  if (preset.engine != EngineKind::opencl || app.scripted) return false;
  const bool same_device = app.preset().engine == EngineKind::opencl && app.preset().device == preset.device;
  return !same_device || (app.building.prepare_programs && !app.simulation->engine().ready_for(preset));
}

bool takes_long(const App& app, const Preset& preset) {
  return !app.scripted && (particles(preset) >= many_particles || needs_programs(app, preset));
}

bool takes_long(const App& app, const Edit& edit) {
  const auto* change = std::get_if<edit::Change>(&edit);
  const Preset& preset = change != nullptr ? change->preset : app.preset();
  return app.simulation->rebuilds(edit) ? takes_long(app, preset) : change != nullptr && needs_programs(app, preset);
}

void swap_in(App& app, std::unique_ptr<Simulation> simulation) {
  app.simulation.swap(simulation);
  copies_resume(app);
  if (simulation != nullptr) app.building.dispose(std::move(simulation));
  app.sleep = Sleep{};
  app.redraw_cloth = true;  // its count of changes may be that of the last one
}

void BackgroundRebuild::order(const App& app, BuildOrder order, History before) {
  next_ = std::move(order);
  if (busy()) return;  // a cloth cannot be left half built: the next one follows it
  before_ = std::move(before);
  start(app);
}

void BackgroundRebuild::start(const App& app) {
  making_ = std::move(*next_);
  next_.reset();
  dropped_ = false;
  const auto prepare = needs_programs(app, making_->target) ? prepare_programs : nullptr;
  const bool ledger = app.simulation->ledger().has_value();
  work_ = std::async(std::launch::async,
                     [prepare, ledger, order = *making_, present = app.simulation.get(),
                      threads = app.threads]() -> std::unique_ptr<Simulation> {
                       if (prepare) prepare(order.target, ledger);
                       if (order.programs) return nullptr;
                       if (order.fresh) return std::make_unique<Simulation>(order.target, threads);
                       return present->rebuilt(edit::Change{order.target});
                     });
}

void BackgroundRebuild::rename(const std::string& name) {
  for (auto* order : {&making_, &next_})
    if (*order) (*order)->target.name = name;
}

void BackgroundRebuild::poll(App& app) {
  if (!busy()) return;
  ++frames_beside_;
  if (work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    finish(app);
  } catch (const std::bad_alloc&) {
    give_up(app, "There is not enough memory for that. Nothing was changed; try fewer rows and columns.");
  } catch (const std::exception& error) {
    give_up(app, error.what());
  }
  if (busy()) return;
  const std::vector<Edit> deferred = std::move(deferred_);
  deferred_.clear();
  for (const Edit& edit : deferred) apply_edit(app, edit);
}

void BackgroundRebuild::give_up(App& app, const std::string& why) {
  making_.reset(), next_.reset();
  app.history = std::move(before_);
  app.messages.error(why);
}

/// Whether what has been made is what is wanted, or on the way to it.
bool BackgroundRebuild::available(const BuildOrder& made) const {
  if (dropped_) return false;
  if (!next_) return true;
  const bool alike = lattice_of(made.target) == lattice_of(next_->target) && made.target.kind == next_->target.kind;
  return alike && !made.document && !next_->document && (made.fresh || !next_->fresh);
}

void BackgroundRebuild::finish(App& app) {
  std::unique_ptr<Simulation> made = work_.get();
  const BuildOrder order = *std::exchange(making_, std::nullopt);
  const bool use = available(order);
  dropped_ = false;
  if (!use) {
    dispose(std::move(made));
    if (next_) start(app);
    return;
  }
  take(app, std::move(made), order);
  if (next_) go_on(app);
}

void BackgroundRebuild::take(App& app, std::unique_ptr<Simulation> made, const BuildOrder& order) {
  const edit::Change change{order.target};
  if (order.programs) {
    const Preset before = app.preset();
    apply_to_all(app, change);
    follow_up(app, before);
    return;
  }
  if (!(order.target == made->preset())) made->apply(change);  // it has been renamed
  take_built(app, std::move(made), order);
}

/// From what has just been taken to what has been asked for since.
void BackgroundRebuild::go_on(App& app) {
  const edit::Change change{next_->target};
  if (change.preset == app.preset()) return next_.reset();
  next_->programs = !app.simulation->rebuilds(change);
  next_->fresh = next_->programs;
  if (!next_->programs || needs_programs(app, change.preset)) return start(app);
  next_.reset();
  const Preset before = app.preset();
  apply_to_all(app, change);
  follow_up(app, before);
}

bool BackgroundRebuild::ledger_ready(const App& app) {
  if (ledger_programs_.valid()) {
    if (ledger_programs_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    ledger_programs_.get();
    return true;  // from disk, or built here where that did not work
  }
  if (app.scripted || !prepare_programs || app.simulation->engine().ready_for_contacts()) return true;
  ledger_programs_ =
      std::async(std::launch::async, [prepare = prepare_programs, preset = app.preset()] { prepare(preset, true); });
  return false;
}

void BackgroundRebuild::dispose(std::unique_ptr<Simulation> simulation) {
  if (simulation == nullptr || simulation->lattice().size() < many_particles) return;
  disposal_ = std::async(std::launch::async, [gone = std::move(simulation)]() mutable { gone.reset(); });
}

}  // namespace tyglab
