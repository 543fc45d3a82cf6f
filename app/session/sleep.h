// A cloth at rest goes to sleep: the sandbox makes no more steps until something touches the cloth. Only the sandbox
// does this; runs, benchmarks and --frames compute every step.
//
// The other particles are examined only after three of them have been still for τ/2. A sleeping cloth is within 1e-4 ℓ,
// a fraction of a pixel, of its final position, provided that the rest of its creep would end within a hundred such
// spans; tests/app/sleep_test.cpp measures this on a strongly damped cloth, which creeps longest. Any edit wakes the
// cloth. A cloth in wind or in the hand, and a mass on a spring, never sleep. During sleep, simulated time stands
// still, and the status bar reports it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/simulation.h"

namespace tyglab {

/// The definition of rest for a cloth of side ℓ that swings in τ = √(ℓ/|g|) (1 s without gravity).
struct RestTolerance {
  double radius;  ///< m; every particle stays that near to where it was …
  double window;  ///< s; … for that long, 2 τ, …
  double speed;   ///< m/s; … and ends slower than that
  double error;   ///< m; how far from its place the cloth may be that sleeps, as measured in the tests
};
RestTolerance rest_tolerance(const Preset& preset);
/// Of all particles, m/s.
double largest_speed(Simulation& simulation);

class Sleep {
 public:
  /// Whether it sleeps. Any edit wakes it (Simulation::revision).
  bool asleep(const Simulation& simulation) const { return asleep_ && simulation.revision() == seen_; }
  /// Before a frame's steps: an edit since the last look begins a new watch.
  void begin(const Simulation& simulation);
  /// After a frame's steps. `touched`: a tool acts on the cloth.
  void look(Simulation& simulation, bool touched);

  /// Size of the stored places.
  std::size_t bytes() const { return anchor_.capacity() * sizeof(glm::dvec3); }

 private:
  void set_out(const Simulation& simulation);
  bool scouts_stay(const Simulation& simulation) const;
  void take_anchor(const Simulation& simulation);
  bool near_anchor(const Simulation& simulation, double radius) const;

  bool asleep_ = false;
  std::uint64_t seen_ = 0;
  double since_ = 0;                                 ///< s, simulated time of the anchor, or else of the scouts' places
  std::optional<std::array<glm::dvec3, 3>> scouts_;  ///< where a few particles were; none: nothing is watched
  std::vector<glm::dvec3> anchor_;  ///< where all were; empty until the few have been still for a while
};

}  // namespace tyglab
