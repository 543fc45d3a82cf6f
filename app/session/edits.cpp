#include "app/session/session.h"

#include <cassert>
#include <new>
#include <optional>
#include <utility>

#include "app/session/document.h"
#include "app/session/requests.h"
#include "core/cloth/state.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/preset.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

/// A particle that was pinned and freed again leaves a list of pins; where it says what the document says by a name, or
/// by a list in another order, it is put as the document puts it.
void spell_pins_as_saved(Session& session) {
  const Preset& saved = session.document.saved;
  try {
    if (session.preset().pins == saved.pins || !same_pins(session.preset(), saved)) return;
    Preset next = session.preset();
    next.pins = saved.pins;
    apply_to_all(session, edit::Change{next});
  } catch (const std::bad_alloc&) {
    // The same pins by another name: the list says it too.
  }
}

/// What an edit asks for, worked out once before it is made.
struct Plan {
  const Edit& edit;
  const edit::Change* change = nullptr;  ///< null: an edit of the cloth itself
  EffectSet document{};                  ///< what it changes in the constants that are shown
  EffectSet cloth{};  ///< and in those of the cloth that moves, which differ while another one is being built
  bool restarts = false, rebuilds = false;
  bool grabs = false, cuts = false;  ///< a hand or a knife in the cloth
  bool constants = false;            ///< it changes constants, at once
};

Plan plan_of(const Session& session, const Edit& edit) {
  Plan plan{.edit = edit, .change = std::get_if<edit::Change>(&edit)};
  if (plan.change != nullptr) {
    plan.document = changes(session.requested_preset(), plan.change->preset);
    plan.cloth =
        session.rebuild.requested_preset() == nullptr ? plan.document : changes(session.preset(), plan.change->preset);
  }
  plan.restarts = std::holds_alternative<edit::Restart>(edit);
  plan.rebuilds = session.simulation->rebuilds(edit);
  plan.grabs = std::holds_alternative<edit::Grab>(edit);
  plan.cuts = std::holds_alternative<edit::Cut>(edit) || std::holds_alternative<edit::CutSprings>(edit);
  plan.constants =
      plan.change != nullptr || std::holds_alternative<edit::Pin>(edit) || std::holds_alternative<edit::MoveBody>(edit);
  return plan;
}

/// A new texture for the cloth, if the edit brings one. False if it is unusable.
bool take_texture(Session& session, const Plan& plan) {
  if (!plan.document.touches(Effect::texture) || !session.show_texture) return true;
  const auto problem = session.show_texture(plan.change->preset.texture);
  if (problem) session.messages.error(*problem);
  return !problem;
}

/// How an edit is called where the constants do not say it.
std::string name_of(const Session& session, const Edit& edit) {
  const auto at = [](int i, int j) { return " at (" + std::to_string(i) + ", " + std::to_string(j) + ")"; };
  if (std::holds_alternative<edit::Restart>(edit)) return "restart";
  if (std::holds_alternative<edit::Cut>(edit) || std::holds_alternative<edit::CutSprings>(edit)) return "cut";
  if (const auto* grab = std::get_if<edit::Grab>(&edit)) return "pull" + at(grab->i, grab->j);
  if (const auto* pin = std::get_if<edit::Pin>(&edit)) return (pin->pinned ? "pin" : "unpinning") + at(pin->i, pin->j);
  if (const auto* body = std::get_if<edit::MoveBody>(&edit)) {
    assert(body->index >= 0 && std::size_t(body->index) < session.preset().bodies.size());
    return "move of a " + std::string(name_of(session.preset().bodies[std::size_t(body->index)].shape));
  }
  return "";
}

/// Whether an edit may change the motion itself, so that undoing it brings the cloth of that moment back.
bool changes_motion(const Session& session, const Plan& plan) {
  if (session.simulation->divergence()) return false;  // nobody wants that back
  return plan.restarts ? session.simulation->steps() > 0 : plan.grabs || plan.cuts;
}

/// What stands before an edit that changes the motion; none of others, and where the gesture has its entry already.
std::optional<HistoryEntry> before_motion(Session& session, const Plan& plan, unsigned gesture) {
  if (!changes_motion(session, plan) || !session.history.begins(gesture) || session.rebuild.holds_present())
    return std::nullopt;
  return motion_entry(session, name_of(session, plan.edit));
}

/// What changes while another cloth is being built is felt at once where that is quick.
void change_present(Session& session, const Preset& before, const Preset& next) {
  const edit::Change change{merge(before, next, session.preset())};
  if (session.rebuild.holds_present() || change.preset == session.preset()) return;
  if (session.simulation->rebuilds(change) || needs_programs(session, change.preset)) return;
  change_and_follow(session, change);
}

/// What becomes of an edit of the cloth itself while its state is being read for another one: whether it is taken.
bool defer(Session& session, const Edit& edit) {
  // Who would grab must see it at once.
  if (std::holds_alternative<edit::Grab>(edit) || std::holds_alternative<edit::MoveHand>(edit)) return false;
  session.rebuild.defer(edit);
  return true;
}

/// Whether an edit of all constants is to be made beside the frames, together with what is running there.
bool goes_beside(const Session& session, const Plan& plan) {
  const BackgroundRebuild& rebuild = session.rebuild;
  const Preset& next = plan.change != nullptr ? plan.change->preset : session.preset();
  if (rebuild.holds_present()) return true;
  if (rebuild.requested_preset() == nullptr && plan.rebuilds) return takes_long(session, next);
  return rebuild.restarts() || plan.rebuilds || (plan.change != nullptr && needs_programs(session, next));
}

/// Handles an edit that takes long, or that comes while another cloth is being built: says whether it was. Nothing:
/// it is to be made here and now.
std::optional<bool> build_beside(Session& session, const Plan& plan, unsigned gesture) {
  BackgroundRebuild& rebuild = session.rebuild;
  if (plan.change == nullptr && !plan.restarts) {
    if (!rebuild.holds_present()) return std::nullopt;
    return defer(session, plan.edit);
  }
  if (!goes_beside(session, plan)) {
    if (rebuild.requested_preset() != nullptr) rebuild.drop();
    return std::nullopt;
  }
  const Preset before = session.requested_preset(), next = plan.change != nullptr ? plan.change->preset : before;
  const History history = session.history;
  if (!plan.document.within(Effect::view))
    session.history.record({before, session.simulation->time(), name_of(session, plan.edit)}, gesture);
  if (rebuild.requested_preset() != nullptr) change_present(session, before, next);
  BuildOrder order;
  order.target = next;
  order.restarts = plan.restarts || rebuild.restarts();
  order.programs = !order.restarts && !plan.rebuilds;
  order.fresh = order.programs || order.restarts || plan.cloth.touches(Effect::rebuild);
  rebuild.order(session, std::move(order), history);
  return true;
}

}  // namespace

HistoryEntry motion_entry(Session& session, std::string what) {
  assert(!session.background_steps.busy());  // a stand-in is the cloth of before
  HistoryEntry entry{session.requested_preset(), session.simulation->time(), std::move(what)};
  entry.too_large = Snapshot::bytes(session.simulation->lattice()) > History::most_bytes;
  if (!entry.too_large) entry.state = std::make_shared<const Snapshot>(session.simulation->snapshot());
  return entry;
}

void follow_up(Session& session, const Preset& before, EffectSet effects) {
  const Preset& now = session.preset();
  // Another resolution has L changed with it (with_resolution); rows or columns alone are literal, and keep the index.
  if (session.picked && before.L != now.L) session.picked = site_in_resolution(*session.picked, before, now);
  if (session.picked && !session.simulation->has(session.picked->i, session.picked->j)) session.picked.reset();
  if (effects.touches(Effect::rebuild)) {
    ++session.counts.lattices;
    session.recorded.clear();
  }
  session.pacing.forget_cost();
}

void apply_to_all(Session& session, const Edit& edit) {
  session.simulation->apply(edit);
  copies_apply(session, edit);
}

void change_and_follow(Session& session, const edit::Change& change) {
  assert(!session.rebuild.holds_present());
  const Preset before = session.preset();
  apply_to_all(session, change);
  follow_up(session, before, changes(before, change.preset));
}

bool apply_edit(Session& session, const Edit& edit, unsigned gesture) {
  try {
    if (const auto* change = std::get_if<edit::Change>(&edit))
      if (const std::string wrong = check_preset(change->preset); !wrong.empty()) throw PresetError(wrong);
    const Plan plan = plan_of(session, edit);
    if (!take_texture(session, plan)) return false;
    const bool only_seen = plan.change != nullptr && plan.document.within(motionless);
    if (!only_seen) settle(session);  // a stand-in of the cloth takes no others
    std::optional<HistoryEntry> motion = before_motion(session, plan, gesture);
    const auto torn = session.simulation->tears().torn_count();
    if (const auto taken = build_beside(session, plan, gesture)) {
      if (*taken && !only_seen) leave_repetition(session);
      if (*taken && motion && plan.restarts) session.history.record(*std::move(motion), gesture);
      return *taken;
    }
    const Preset before = session.preset();
    // The entry takes its memory before the edit is made.
    const bool moves = motion.has_value();
    History recorded;
    if (moves || plan.constants) {
      recorded = session.history;
      recorded.record(
          moves ? *std::move(motion) : HistoryEntry{before, session.simulation->time(), name_of(session, edit)},
          gesture);
    }
    apply_to_all(session, edit);
    if (std::holds_alternative<edit::Pin>(edit)) spell_pins_as_saved(session);
    session.counts.touches += plan.grabs || plan.cuts;
    const EffectSet effects = plan.change != nullptr ? plan.cloth : changes(before, session.preset());
    // A knife may have gone through nothing.
    const bool moved = moves && !(plan.cuts && session.simulation->tears().torn_count() == torn);
    if (!only_seen && (moved || !plan.cuts)) leave_repetition(session);
    if (moved || !effects.within(Effect::view)) session.history = std::move(recorded);
    if (moved || !effects.within(beside_model)) session.rewind.note_change();
    if (!effects.empty()) follow_up(session, before, effects);
    return true;
  } catch (const std::bad_alloc&) {
    session.messages.error(
        "There is not enough memory for that cloth. Nothing was changed; try fewer rows and columns.");
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
  return false;
}

}  // namespace tyglab
