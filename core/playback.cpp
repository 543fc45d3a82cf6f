#include "core/playback.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "core/io/preset_io.h"

namespace tyglab {

std::int64_t Playback::steps_to_next(const Simulation& simulation) const {
  const std::int64_t next = next_ < events_.size() ? events_[next_].step : recording_.steps();
  return std::max<std::int64_t>(next - simulation.past().steps(), 0);
}

std::optional<Edit> Playback::edit_of(const Simulation& simulation, const Event& event) {
  return std::visit(
      [&](const auto& what) -> std::optional<Edit> {
        using What = std::decay_t<decltype(what)>;
        if constexpr (std::is_same_v<What, event::Change>)
          return edit::Change{with_settings(simulation.preset(), what.settings)};
        else if constexpr (std::is_constructible_v<Edit, What>)
          return what;
        else
          return std::nullopt;
      },
      event);
}

void Playback::apply_next(Simulation& simulation) {
  assert(due(simulation) != nullptr);
  const Event& event = *due(simulation);
  const auto fail = [&](const std::string& why) {
    throw PresetError("step " + std::to_string(simulation.past().steps()) + " of the recording: " + why);
  };
  if (const auto edit = edit_of(simulation, event)) {
    simulation.apply(*edit);
  } else if (const auto* resume = std::get_if<event::Resume>(&event)) {
    Snapshot then = simulation.snapshot();
    if (!resume->held) then.held.reset();
    const Preset next = with_settings(simulation.preset(), resume->settings);
    if (next != simulation.preset()) simulation.apply(edit::Change{next});
    if (!simulation.fits(then)) fail("a cloth cannot continue with another lattice");
    simulation.restore(then);
  } else if (const auto* load = std::get_if<event::Load>(&event)) {
    if (load->state->x.x.size() != std::size_t(simulation.lattice().size()))
      fail("a state of " + std::to_string(load->state->x.x.size()) + " particles does not fit the cloth");
    simulation.load(*load->state);
  } else if (std::holds_alternative<event::Diverge>(event)) {
    simulation.advance(1);  // which diverges in turn, and otherwise is a step of a motion that differs anyway
  } else if (const auto* hash = std::get_if<event::Hash>(&event)) {
    compare(simulation, *hash);
  } else if (const auto* look = std::get_if<event::Look>(&event)) {
    compare(simulation, *look);
  }
  share(simulation);
  ++next_;
}

/// What the simulation has made is this recording, as long as its positions are the recorded ones. Then it is another,
/// with checks of its own.
void Playback::share(Simulation& simulation) const {
  const std::int64_t made = simulation.past().steps();
  const Event& event = *events_[next_].event;
  if (!comparison_.differs_at && made <= recording_.steps())
    return simulation.share_recording(recording_.until(events_[next_], made));
  Recording own = simulation.past();
  if (std::holds_alternative<event::Hash>(event)) own.add(event::Hash{simulation.hash()});
  if (std::holds_alternative<event::Look>(event)) own.add(simulation.look());
  if (std::holds_alternative<event::Mark>(event)) own.add(event);
  simulation.share_recording(std::move(own));
}

void Playback::compare(const Simulation& simulation, const event::Hash& hash) {
  ++comparison_.compared;
  if (comparison_.differs_at) return;
  const std::int64_t step = simulation.past().steps();
  if (hash.value == simulation.hash())
    comparison_.equal_until = step;
  else
    comparison_.differs_at = step;
}

void Playback::compare(const Simulation& simulation, const event::Look& look) {
  const event::Look now = simulation.look();
  if (now.x.size() != look.x.size()) return;
  comparison_.looked_at = simulation.past().steps(), comparison_.apart = 0;
  for (std::size_t n = 0; n < look.x.size(); ++n)
    comparison_.apart = std::max(comparison_.apart, glm::distance(now.x[n], look.x[n]));
}

std::int64_t Playback::advance(Simulation& simulation, std::int64_t steps) {
  const std::int64_t first = simulation.past().steps();
  const auto made = [&] { return simulation.past().steps() - first; };
  while (true) {
    while (due(simulation) != nullptr) apply_next(simulation);
    const std::int64_t here = steps - made(),
                       left = over(simulation) ? here : std::min(here, steps_to_next(simulation));
    if (left <= 0 || simulation.divergence()) return made();
    if (simulation.advance(int(std::min<std::int64_t>(left, 1 << 30))).stopped) return made();
  }
}

}  // namespace tyglab
