#include "core/lockstep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/model/preset.h"

namespace tyglab {
namespace {

constexpr double whole_step = 1e-6;  // of a step: rounding of times

std::string listed(std::span<const Difference> differences) {
  return differences.empty() ? "no difference" : joined(differences, ", ", &Difference::text);
}

/// Whole steps of a cloth that end by `t`.
int steps_until(const Simulation& cloth, double t) {
  return int(std::clamp(std::floor((t - cloth.time()) / cloth.preset().dt + whole_step), 0.0, 1e7));
}

/// A copy of the original, in its state.
std::unique_ptr<Simulation> copied(const Simulation& original, const Snapshot& now,
                                   std::span<const Difference> differences, int threads) {
  const Preset preset = copied_preset(original.preset(), differences);
  if (changes(original.preset(), preset).touches(Effect::rebuild))
    throw PresetError("A copy has the same particles as its original: " + listed(differences) + " would change them.");
  auto copy = std::make_unique<Simulation>(preset, threads);
  copy->restore(now);
  return copy;
}

/// The hand reaches its goal when the original's does, in the copy's own steps.
Edit with_own_steps(const Edit& edit, const Simulation& original, const Simulation& copy) {
  const auto own = [&](int steps) {
    return steps > 0 ? steps_until(copy, original.time() + steps * original.preset().dt) : 0;
  };
  if (const auto* move = std::get_if<edit::MoveHand>(&edit)) return edit::MoveHand{move->to, own(move->steps)};
  if (const auto* body = std::get_if<edit::MoveBody>(&edit))
    return edit::MoveBody{body->index, body->c, own(body->steps)};
  return edit;
}

}  // namespace

void Lockstep::Cost::add(double simulated_s, double computing_s) {
  if (simulated_s <= 0) return;
  const double kept = std::exp(-simulated_s / cost_settles);
  simulated_ = kept * simulated_ + simulated_s;
  computing_ = kept * computing_ + computing_s;
}

Preset copied_preset(const Preset& original, std::span<const Difference> differences) {
  Preset preset = original;
  for (const Difference& difference : differences)
    if (!difference.apply(preset)) throw PresetError(difference.key() + ": there is no such body");
  if (const auto problem = check_preset(preset); !problem.empty()) throw PresetError(problem);
  return preset;
}

void Lockstep::add(Simulation& original, std::vector<Difference> differences, int threads) {
  check_room(original);
  const Snapshot now = original.snapshot();
  auto copy = copied(original, now, differences, threads);
  original.restore(now);
  // What equals the original is to equal it after this, to the last bit.
  for (Copy& other : copies_)
    if (!other.simulation->divergence()) other.simulation->restore(other.simulation->snapshot());
  copies_.push_back({std::move(differences), std::move(copy), {}, free_seat()});
}

void Lockstep::put_back(const Simulation& original, std::size_t n, std::vector<Difference> differences,
                        std::size_t seat, Cost cost, const Snapshot& then, int threads) {
  check_room(original);
  auto copy = copied(original, then, differences, threads);
  const bool taken = std::any_of(copies_.begin(), copies_.end(), [&](const Copy& other) { return other.seat == seat; });
  copies_.insert(copies_.begin() + std::ptrdiff_t(std::min(n, copies_.size())),
                 {std::move(differences), std::move(copy), cost, taken ? free_seat() : seat});
}

void Lockstep::check_room(const Simulation& original) const {
  if (copies_.size() >= most)
    throw PresetError("There are " + std::to_string(most) + " copies already; remove one first.");
  if (original.lattice().size() > largest)
    throw PresetError("A cloth of more than " + std::to_string(largest) + " particles is too large to be copied.");
}

std::size_t Lockstep::free_seat() const {
  const auto taken = [&](std::size_t seat) {
    return std::any_of(copies_.begin(), copies_.end(), [&](const Copy& copy) { return copy.seat == seat; });
  };
  std::size_t seat = 0;
  while (taken(seat)) ++seat;
  return seat;
}

std::vector<std::string> Lockstep::apply(const Simulation& original, const Edit& edit) {
  std::vector<std::string> gone;
  std::erase_if(copies_, [&](Copy& copy) {
    try {
      if (std::holds_alternative<edit::Change>(edit)) {
        if (original.lattice().size() > largest) throw PresetError("the cloth has become too large to be copied.");
        copy.simulation->apply(edit::Change{copied_preset(original.preset(), copy.differences)});
      } else {
        copy.simulation->apply(with_own_steps(edit, original, *copy.simulation));
      }
      return false;
    } catch (const std::exception& error) {
      gone.push_back("The copy with " + listed(copy.differences) + " was removed: " + error.what());
      return true;
    }
  });
  return gone;
}

std::vector<std::string> Lockstep::resume(Simulation& original, int threads) {
  std::vector<std::string> gone;
  if (copies_.empty()) return gone;
  if (original.lattice().size() > largest) {
    clear();
    return {"The copies were removed: this cloth is too large to be copied."};
  }
  const Snapshot now = original.snapshot();
  original.restore(now);
  std::erase_if(copies_, [&](Copy& copy) {
    try {
      copy.simulation = copied(original, now, copy.differences, threads);
      copy.cost = {};
      return false;
    } catch (const std::exception& error) {
      gone.push_back("The copy with " + listed(copy.differences) + " was removed: " + error.what());
      return true;
    }
  });
  return gone;
}

void Lockstep::follow(double t) {
  for (Copy& copy : copies_) {
    Simulation& cloth = *copy.simulation;
    const int steps = steps_until(cloth, t);
    if (steps == 0 || cloth.divergence()) continue;
    const EngineKind engine = cloth.preset().engine;
    const double start = computing_seconds(engine);
    const int made = cloth.advance(steps).steps;
    copy.cost.add(made * cloth.preset().dt, computing_seconds(engine) - start);
  }
}

Lockstep Lockstep::stand_in() const {
  Lockstep still;
  for (const Copy& copy : copies_)
    still.copies_.push_back({copy.differences, copy.simulation->stand_in(), copy.cost, copy.seat});
  return still;
}

void Lockstep::stop_when(const Stop& stop) {
  for (Copy& copy : copies_) copy.simulation->stop_when(stop);
}

bool Lockstep::alive() const {
  return std::any_of(copies_.begin(), copies_.end(),
                     [](const Copy& copy) { return !copy.simulation->divergence().has_value(); });
}

std::size_t Lockstep::bytes() const {
  std::size_t sum = 0;
  for (const Copy& copy : copies_) sum += copy.simulation->bytes() + copy.simulation->engine().bytes();
  return sum;
}

double rms_distance(Simulation& cloth, Simulation& from) {
  const Lattice sites = cloth.lattice().sites();  // copies of two cloths are no pairs
  if (sites != from.lattice().sites() || cloth.divergence() || from.divergence())
    return std::numeric_limits<double>::quiet_NaN();
  return rms_distance(cloth.read(), from.read(), std::size_t(sites.size()), from.time() - cloth.time());
}

double rms_distance(const State& cloth, const State& from, std::size_t particles, double ahead) {
  double sum = 0;
  for (const auto component : {&VectorField<double>::x, &VectorField<double>::y, &VectorField<double>::z}) {
    const auto &x = cloth.x.*component, &v = cloth.v.*component, &other = from.x.*component;
    for (std::size_t p = 0; p < particles; ++p) {
      const double apart = x[p] + ahead * v[p] - other[p];
      sum += apart * apart;
    }
  }
  return std::sqrt(sum / double(particles));
}

}  // namespace tyglab
