// Computes in the background, at most twice per second, the largest dt for the present cloth, while it is
// requested.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/model/preset.h"
#include "core/theory/modes.h"
#include "core/theory/zones.h"

namespace tyglab {

struct Scheme;

/// Growth of a mode per step, as a spectral radius, over ω·dt; ends where it grows by a quarter a step.
struct GrowthCurve {
  std::vector<double> h, radius;
};
/// ζ in proportion to ω, as damping weighs on modes about as their stiffness does: ζ = `zeta_over_h` ω·dt.
GrowthCurve growth_curve(const Scheme& method, double most_h, double zeta_over_h);

/// Where a stabilized method is stable with the stages that its longest inner step has: the upper half of the region in
/// the plane of hλ, from left to right, and within it the bounds of the cloth's own hλ.
struct StabilityRegion {
  int stages = 0;
  double h = 0;  ///< of the step, s
  std::vector<double> x, y;
  Spectrum bounds;  ///< of hλ
};
StabilityRegion stability_region(const Scheme& method, const Preset& preset);

/// Limits of the present method by linear theory (core/analysis/frequency.h). dt in s: 0 where none is stable, infinity
/// where none is too large.
struct StabilityLimits {
  Preset of;       ///< the constants they belong to
  MotionMark at;   ///< the moment that `now`, `omega` and `fastest` belong to
  double any = 0;  ///< worst-case limit: dt_crit in any configuration of the springs
  std::optional<double>
      now;                ///< dt_crit of the cloth as it hangs; none for cloths too large to look at while they move
  bool at_start = false;  ///< `now`, `omega` and `fastest` are the cloth's as it starts: after a divergence
  double every = 0;       ///< dt above which every shape is unstable
  double omega = 0;       ///< 1/s, of the fastest mode now, where `now` is there
  Mode fastest{};         ///< that mode; where `now` is not there, what no mode in any configuration exceeds
  GrowthCurve damped, undamped;  ///< the method's growth, for modes damped as the fastest is, and without damping
  std::optional<StabilityRegion> region;                            ///< of a stabilized method
  std::map<std::string, std::vector<ZoneSpan>, std::less<>> zones;  ///< by the constant's key
};

class StabilityWatch {
 public:
  /// Called in every frame in which the limits are wanted: takes what is ready and begins what is due.
  void poll(StudyMoment& moment);
  /// The newest limits; none before the first are ready.
  const std::optional<StabilityLimits>& limits() const { return limits_; }

 private:
  Job<StabilityLimits> work_;
  std::optional<StabilityLimits> limits_;
  double begun_ = -1;                    ///< s on the session's clock; when the last look began
  std::optional<MotionMark> looked_at_;  ///< the moment of it
  std::optional<Preset> looked_for_;
};

}  // namespace tyglab
