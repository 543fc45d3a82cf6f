#include "app/session/edits.h"

#include <new>
#include <optional>

#include "app/base/data_files.h"
#include "app/session/document.h"
#include "app/ui/app.h"
#include "core/cloth/start.h"
#include "core/io/preset_io.h"
#include "core/model/resolution.h"

namespace tyglab {
namespace {

/// A particle that was pinned and freed again leaves a list of pins; where it says what the document says by a name, or
/// by a list in another order, it is put as the document puts it.
void spell_pins_as_saved(App& app) {
  const Preset& saved = app.document.saved;
  if (app.preset().pins == saved.pins || !same_pins(app.preset(), saved)) return;
  Preset next = app.preset();
  next.pins = saved.pins;
  apply_to_all(app, edit::Change{next});
}

/// A new picture for the cloth, if the edit brings one. False where the picture is of no use.
bool take_texture(App& app, const Edit& edit) {
  const auto* change = std::get_if<edit::Change>(&edit);
  if (change == nullptr || change->preset.texture == app.requested_preset().texture) return true;
  if (const auto problem = app.renderer->set_texture(texture_file(change->preset.texture))) {
    app.messages.error(*problem);
    return false;
  }
  app.redraw_cloth = true;
  return true;
}

void record(App& app, const Preset& before, const Preset& now, unsigned gesture) {
  Preset same_view = before;
  same_view.mode = now.mode;
  if (!(same_view == now)) app.history.record(before, gesture);
}

/// What changes while another cloth is in work is felt at once where that is quick.
void change_present(App& app, const Preset& before, const Preset& next) {
  const edit::Change change{rebased(before, next, app.preset())};
  if (app.building.holds_present() || change.preset == app.preset()) return;
  if (app.simulation->rebuilds(change) || needs_programs(app, change.preset)) return;
  const Preset old = app.preset();
  apply_to_all(app, change);
  follow_up(app, old);
}

/// What becomes of an edit of the cloth itself while its state is being read for another one: whether it is taken.
bool defer(App& app, const Edit& edit) {
  // Who would grab must see it at once.
  if (std::holds_alternative<edit::Grab>(edit) || std::holds_alternative<edit::MoveHand>(edit)) return false;
  app.building.defer(edit);
  return true;
}

/// Whether an edit of all constants is to be made beside the frames, together with what is in work there.
bool goes_beside(const App& app, const Edit& edit) {
  const BackgroundRebuild& building = app.building;
  if (building.holds_present()) return true;
  if (building.requested_preset() == nullptr) return takes_long(app, edit);
  const auto* change = std::get_if<edit::Change>(&edit);
  return building.restarts() || app.simulation->rebuilds(edit) ||
         (change != nullptr && needs_programs(app, change->preset));
}

/// Sees to an edit that takes long, or that comes while another cloth is in work: says whether it was taken. Nothing:
/// it is to be made here and now.
std::optional<bool> build_beside(App& app, const Edit& edit, unsigned gesture) {
  BackgroundRebuild& building = app.building;
  const bool restarts = std::holds_alternative<edit::Restart>(edit);
  const auto* change = std::get_if<edit::Change>(&edit);
  if (change == nullptr && !restarts) {
    if (!building.holds_present()) return std::nullopt;
    return defer(app, edit);
  }
  if (!goes_beside(app, edit)) {
    if (building.requested_preset() != nullptr) building.drop();
    return std::nullopt;
  }
  const Preset before = app.requested_preset(), next = change != nullptr ? change->preset : before;
  const History history = app.history;
  record(app, before, next, gesture);
  if (building.requested_preset() != nullptr) change_present(app, before, next);
  BuildOrder order;
  order.target = next;
  order.restarts = restarts || building.restarts();
  order.programs = !order.restarts && !app.simulation->rebuilds(edit);
  order.fresh = order.programs || order.restarts || lattice_of(next) != app.simulation->lattice() ||
                next.kind != app.preset().kind;
  building.order(app, std::move(order), history);
  return true;
}

}  // namespace

void follow_up(App& app, const Preset& before) {
  const Preset& now = app.preset();
  const Lattice& lattice = app.simulation->lattice();
  // Another resolution has L changed with it (with_resolution); rows or columns alone are literal, and keep the index.
  if (app.picked && before.L != now.L) app.picked = site_in_resolution(*app.picked, before, now);
  if (app.picked && !lattice.contains(app.picked->i, app.picked->j)) app.picked.reset();
  if (before.rows != now.rows || before.columns != now.columns || before.kind != now.kind) {
    app.tool.site.reset(), app.tool.last_site.reset();
    if (app.tool.kind == Tool::Kind::grab) app.tool.kind = Tool::Kind::none;
    app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  }
  if (before.bodies.size() != now.bodies.size() && app.tool.kind == Tool::Kind::body) app.tool.kind = Tool::Kind::none;
  app.pacing.forget_cost();
}

void apply_to_all(App& app, const Edit& edit) {
  app.simulation->apply(edit);
  copies_apply(app, edit);
}

bool apply_edit(App& app, const Edit& edit, unsigned gesture) {
  try {
    if (const auto* change = std::get_if<edit::Change>(&edit))
      if (const std::string wrong = check_preset(change->preset); !wrong.empty()) throw PresetError(wrong);
    if (!take_texture(app, edit)) return false;
    if (const auto taken = build_beside(app, edit, gesture)) return *taken;
    const Preset before = app.preset();
    apply_to_all(app, edit);
    if (std::holds_alternative<edit::Pin>(edit)) spell_pins_as_saved(app);
    if (before == app.preset()) return true;
    record(app, before, app.preset(), gesture);
    follow_up(app, before);
    return true;
  } catch (const std::bad_alloc&) {
    app.messages.error("There is not enough memory for that. Nothing was changed; try fewer rows and columns.");
  } catch (const std::exception& error) {
    app.messages.error(error.what());
  }
  return false;
}

}  // namespace tyglab
