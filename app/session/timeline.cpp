#include "app/session/timeline.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>

#include "app/base/text.h"
#include "app/session/document.h"
#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"

namespace tyglab {

void Timeline::look(Simulation& simulation) {
  if (simulation.divergence() || simulation.preset().engine == EngineKind::opencl || simulation.held()) return;
  const std::int64_t step = simulation.past().steps();
  const double every = std::max(1.0, std::round(interval / simulation.preset().dt));  // steps
  if (!kept_.empty() && double(step - kept_.back().past.steps()) < every) return;
  if (Snapshot::bytes(simulation.lattice()) > most_bytes / 4) return;
  Snapshot now = simulation.snapshot();
  // What acts from outside is in no snapshot.
  if (!now.alone || !now.held) return;
  bytes_ += now.bytes();
  kept_.push_back(std::move(now));
  while (bytes_ > most_bytes && kept_.size() > 1) thin_out();
}

/// Forgets one of those that stand closest for their age.
void Timeline::thin_out() {
  assert(kept_.size() > 1);
  std::size_t least = 0;
  double smallest = std::numeric_limits<double>::infinity();
  const auto step = [&](std::size_t n) { return double(kept_[n].past.steps()); };
  for (std::size_t n = 0; n + 1 < kept_.size(); ++n) {
    const double gap = step(n + 1) - (n > 0 ? step(n - 1) : 0), age = step(kept_.size() - 1) - step(n);
    if (gap / age < smallest) smallest = gap / age, least = n;
  }
  bytes_ -= kept_[least].bytes();
  kept_.erase(kept_.begin() + std::ptrdiff_t(least));
}

const Snapshot* Timeline::before(const Recording& line, std::int64_t step) const {
  for (auto at = kept_.rbegin(); at != kept_.rend(); ++at)
    if (at->past.steps() <= step && line.begins_with(at->past)) return &*at;
  return nullptr;
}

void Timeline::forget_after(std::int64_t step) {
  while (!kept_.empty() && kept_.back().past.steps() > step) {
    bytes_ -= kept_.back().bytes();
    kept_.pop_back();
  }
}

void Timeline::leave(const Recording& line, std::int64_t step) {
  forget_after(step);
  marked_ = unmarked;
  // What left the line later has nothing more of the present one either.
  for (Branch& branch : branches_) branch.from = std::min(branch.from, step);
  if (line.steps() - step < shortest_branch) return;
  if (branches_.size() == most_branches) branches_.erase(branches_.begin());
  branches_.push_back({line, step});
}

void Timeline::take(std::size_t branch) {
  assert(branch < branches_.size());
  branches_.erase(branches_.begin() + std::ptrdiff_t(branch));
  marked_ = unmarked;
}

const Recording& present_line(const Session& session) {
  return session.repetition ? session.repetition->playback.recording() : session.simulation->past();
}

void leave_line(Session& session, std::int64_t step) {
  const Recording line = present_line(session);
  session.repetition.reset();
  session.timeline.leave(line, step);
}

namespace {

/// The cloth of that step of a line, from the latest snapshot before it or from its start; of an earlier step where it
/// takes longer than so many seconds.
std::unique_ptr<Simulation> cloth_at(const Session& session, const Recording& line, std::int64_t step, double seconds,
                                     Playback& playback) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  const auto too_late = [until] { return Clock::now() > until; };
  const Snapshot* from = session.timeline.before(line, step);
  Preset start = from != nullptr ? from->of : line.start();
  // The picture stays as it is.
  start.mode = session.preset().mode, start.texture = session.preset().texture;
  std::string fallback;
  std::unique_ptr<Simulation> cloth = make_simulation(start, session.threads, fallback);
  if (from != nullptr && fallback.empty()) cloth->return_to(*from);
  playback.begin(*cloth);
  cloth->stop_when(too_late);
  while (cloth->past().steps() < step && !cloth->divergence() && !too_late())
    playback.advance(*cloth, std::min<std::int64_t>(step - cloth->past().steps(), 64));
  if (cloth->past().steps() == step) playback.advance(*cloth, 0);
  cloth->stop_when({});
  return cloth;
}

void go_on_with(Session& session, std::unique_ptr<Simulation> cloth) {
  const Preset before = session.preset();
  const bool other_lattice = !(cloth->lattice() == session.simulation->lattice());
  swap_in(session, std::move(cloth));
  follow_up(session, before, changes(before, session.preset()));
  if (other_lattice) ++session.counts.lattices;
  ++session.counts.hands;
  // What was done is on the timeline; there it is undone.
  session.history.clear(), session.rewind.clear(), session.recorded.go_on_from(session.simulation->time());
  session.pacing.restart_measure();
}

bool go_along(Session& session, const Recording& line, std::int64_t step, double seconds) {
  if (session.rebuild.busy()) return session.messages.note("Wait until the cloth has been built."), false;
  try {
    settle(session);
    step = std::clamp<std::int64_t>(step, 0, line.steps());
    Playback playback(line);
    auto cloth = cloth_at(session, line, step, seconds, playback);
    // A recording of a sandbox's own has no file; one that was opened keeps it.
    const auto experiment = session.repetition ? session.repetition->experiment : nullptr;
    go_on_with(session, std::move(cloth));
    session.repetition.reset();
    if (!playback.over(*session.simulation)) session.repetition = Repetition{experiment, std::move(playback)};
    return true;
  } catch (const std::bad_alloc&) {
    session.messages.error("There is not enough memory for that moment. The present one is kept.");
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
  return false;
}

TimelineMark::Kind kind_of(const Event& event) {
  using Kind = TimelineMark::Kind;
  if (std::holds_alternative<edit::Grab>(event)) return Kind::hand;
  if (std::holds_alternative<edit::Cut>(event) || std::holds_alternative<edit::CutSprings>(event)) return Kind::cut;
  if (std::holds_alternative<edit::Pin>(event)) return Kind::pin;
  if (std::holds_alternative<edit::MoveBody>(event)) return Kind::body;
  if (std::holds_alternative<edit::Restart>(event)) return Kind::restart;
  if (std::holds_alternative<event::Diverge>(event)) return Kind::diverged;
  if (std::holds_alternative<event::Mark>(event)) return Kind::word;
  return std::holds_alternative<event::Change>(event) ? Kind::change : Kind::resume;
}

bool is_shown(const Event& event) {
  return !std::holds_alternative<edit::MoveHand>(event) && !std::holds_alternative<edit::Release>(event) &&
         !std::holds_alternative<event::Hash>(event) && !std::holds_alternative<event::Look>(event);
}

std::string words_of(const Event& event) {
  const auto at = [](int i, int j) { return " (" + std::to_string(i) + ", " + std::to_string(j) + ")"; };
  if (const auto* change = std::get_if<event::Change>(&event)) {
    const std::size_t count = change->settings.size();
    if (count == 0) return "started again";
    return count == 1 ? change->settings.front()
                      : change->settings.front() + " and " + std::to_string(count - 1) + " more";
  }
  if (const auto* grab = std::get_if<edit::Grab>(&event)) return "grabbed" + at(grab->i, grab->j);
  if (const auto* pin = std::get_if<edit::Pin>(&event)) return (pin->pinned ? "pinned" : "freed") + at(pin->i, pin->j);
  if (const auto* mark = std::get_if<event::Mark>(&event)) return mark->words;
  switch (kind_of(event)) {
    case TimelineMark::Kind::cut:
      return "cut";
    case TimelineMark::Kind::body:
      return "moved a body";
    case TimelineMark::Kind::restart:
      return "restarted";
    case TimelineMark::Kind::diverged:
      return "diverged";
    default:
      return "went back";
  }
}

}  // namespace

bool go_to_step(Session& session, std::int64_t step, double seconds) {
  constexpr double in_passing = 1;  // s; while the timeline is dragged, the next place follows at once
  const Recording line = present_line(session);
  const bool went = go_along(session, line, step, seconds);
  if (went && seconds >= in_passing && session.simulation->past().steps() < std::min(step, line.steps()))
    session.messages.note("That step takes too long to compute; this is the nearest one.");
  return went;
}

void go_by(Session& session, double seconds, int steps) {
  const double dt = session.preset().dt;
  const auto by = seconds == 0 ? std::int64_t(steps) : std::int64_t(std::llround(seconds / dt));
  const std::int64_t here = session.simulation->past().steps(), end = present_line(session).steps();
  if (here >= end && by > 0) return session.messages.note("Nothing is recorded beyond this step.");
  if (here == 0 && by < 0) return session.messages.note("The recording begins here.");
  session.pacing.playing = false;
  go_to_step(session, std::clamp<std::int64_t>(here + by, 0, end));
}

void go_to_branch(Session& session, std::size_t branch) {
  constexpr double longest = 2;  // s
  assert(branch < session.timeline.branches().size());
  const Recording line = present_line(session);
  const Timeline::Branch to = session.timeline.branches()[branch];
  if (!go_along(session, to.line, to.from, longest)) return;
  session.timeline.take(branch);
  session.timeline.leave(line, to.from);
}

const std::vector<TimelineMark>& Timeline::marks(const Recording& line, double now) {
  constexpr double between = 0.25;           // s
  constexpr std::int64_t one_gesture = 500;  // steps
  const bool other = line.size() != marked_ || branches_.size() != marked_branches_;
  if (!other || (line.size() > marked_ && branches_.size() == marked_branches_ && now < marked_at_ + between))
    return marks_;
  marked_ = line.size(), marked_branches_ = branches_.size(), marked_at_ = now;
  marks_.clear();
  std::int64_t last = 0;
  for (const Recording::Entry& entry : line.events()) {
    const std::int64_t step = entry.step;
    if (!is_shown(*entry.event)) continue;
    const TimelineMark::Kind kind = kind_of(*entry.event);
    // A stroke or a drag is one mark.
    const bool again =
        !marks_.empty() && marks_.back().kind == kind && step - last < one_gesture && kind != TimelineMark::Kind::word;
    if (!again) marks_.push_back({kind, step, words_of(*entry.event)});
    last = step;
  }
  for (const Branch& branch : branches_)
    marks_.push_back({TimelineMark::Kind::branch, branch.from, "the motion took another course here"});
  return marks_;
}

}  // namespace tyglab
