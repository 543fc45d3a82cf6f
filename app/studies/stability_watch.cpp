#include "app/studies/stability_watch.h"

#include <algorithm>
#include <array>
#include <complex>
#include <utility>

#include "core/analysis/frequency.h"
#include "core/integrators/scheme.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr double reaches = 1e5;               // zones, to either side of a value and of the constant's default
constexpr double between_looks = 0.5;         // s, at a cloth in motion
constexpr int largest_looked_at = 128 * 128;  // particles: to linearise more of them would be felt in the frame

/// What the stability card draws: here, since it takes longer than the rest of a frame.
void add_curves(StabilityLimits& limits, const Scheme& method) {
  const double dt = limits.of.dt, now = limits.fastest.omega() * dt;
  const double most = std::clamp(1.3 * std::max({now, any_configuration(limits.of).omega() * dt, 2.5}), 1.0, 20.0);
  const double zeta_over_h = now > 0 ? limits.fastest.damping * dt / (2 * now * now) : 0;
  limits.damped = growth_curve(method, most, zeta_over_h);
  if (zeta_over_h > 0) limits.undamped = growth_curve(method, most, 0);
}

/// What may be looked at of a cloth that has diverged: as a restart will find it. The wreck's springs say nothing of
/// it.
std::optional<Linearisation> at_its_start(Preset preset) {
  preset.engine = EngineKind::cpu;
  try {
    return std::optional<Linearisation>(std::in_place, Simulation(preset, 1));
  } catch (const std::exception&) {
    return std::nullopt;  // no memory: the limits of any configuration remain
  }
}

StabilityLimits work_out(const Preset& preset, const MotionMark& at, std::optional<Linearisation> cloth, bool at_start,
                         const Stop& stop) {
  const Scheme& method = scheme(preset.integrator);
  StabilityLimits limits{.of = preset, .at = at, .now = {}, .damped = {}, .undamped = {}, .region = {}, .zones = {}};
  if (at_start) cloth = at_its_start(preset), limits.at_start = cloth.has_value();
  limits.any = dt_crit(method, worst_modes(preset)), limits.every = every_shape_limit(preset);
  limits.fastest = any_configuration(preset);
  for (const ZonedConstant& constant : zoned_constants(preset)) {
    const PresetRow& row = *find_row(constant.key);
    const double usual = usual_value(row), now = preset.*constant.field, value = now > 0 ? now : usual;
    const double least = std::min(value, usual) / reaches;
    // A slider may have grown for any value that was once typed.
    const double most = std::max(value * reaches, row.max);
    limits.zones.emplace(constant.key, stability_zones(preset, constant.field, least, most, stop));
  }
  if (stop()) return limits;  // nobody waits for it any more
  if (cloth) {
    limits.fastest = fastest_mode(*cloth, live_tolerance), limits.omega = limits.fastest.omega();
    // The most damped mode may have any part of the stiffness.
    limits.now = dt_crit(method, std::array{limits.fastest, Mode{0, limits.fastest.damping}});
  }
  if (has_step_limit(method)) add_curves(limits, method);
  if (is_stabilized(method)) limits.region = stability_region(method, preset);
  return limits;
}

}  // namespace

GrowthCurve growth_curve(const Scheme& method, double most_h, double zeta_over_h) {
  constexpr int points = 160;
  constexpr double most_growth = 1.25;
  const auto growth_at = [&](double h) { return spectral_radius(amplification(method, h, zeta_over_h * h)); };
  GrowthCurve curve;
  for (int n = 1; n <= points; ++n) {
    const double h = most_h * n / points, radius = growth_at(h);
    if (radius <= most_growth) {
      curve.h.push_back(h), curve.radius.push_back(radius);
      continue;
    }
    // However steep, the curve is seen to rise: it ends where it leaves the chart.
    double below = most_h * (n - 1) / points, above = h;
    for (int halvings = 0; halvings < 30; ++halvings) {
      const double middle = (below + above) / 2;
      (growth_at(middle) > most_growth ? above : below) = middle;
    }
    curve.h.push_back(below), curve.radius.push_back(growth_at(below));
    break;
  }
  return curve;
}

StabilityRegion stability_region(const Scheme& method, const Preset& preset) {
  constexpr int points = 240, looks = 48;
  const Spectrum spectrum = any_spectrum(preset);
  StabilityRegion region;
  region.h = std::min(preset.dt, longest_step(method, spectrum));
  const StageTable& table = method.tables[table_for(method, spectrum, region.h)];
  region.stages = table.stages;
  region.bounds = {region.h * spectrum.radius, region.h * spectrum.circle, region.h * spectrum.fastest};
  const auto stable = [&](double x, double y) { return std::abs(rkc2_growth(table.stages, {x, y})) <= 1; };
  const double highest = 2 + table.stages;  // about three times as high as the region is
  for (int n = 0; n <= points; ++n) {
    const double x = -table.reach * (points - n) / points;
    double low = 0, high = highest / looks;
    while (high < highest && stable(x, high)) low = high, high += highest / looks;
    for (int halvings = 0; halvings < 12; ++halvings) {
      const double middle = (low + high) / 2;
      (stable(x, middle) ? low : high) = middle;
    }
    region.x.push_back(x), region.y.push_back(low);
  }
  return region;
}

void StabilityWatch::poll(StudyMoment& moment) {
  constexpr double soon = 0.03;  // s: what is ready soon is to be seen
  if (work_.working()) return moment.ask_again_in(soon);
  if (work_.ready())
    if (auto outcome = work_.take(); auto* limits = std::get_if<StabilityLimits>(&outcome))
      limits_ = std::move(*limits);
  const Simulation& simulation = moment.simulation;
  const bool new_constants = !looked_for_ || !changes(*looked_for_, simulation.preset()).within(motionless),
             moved = looked_at_ != moment.mark();
  if (!new_constants && !moved) return;
  if (!new_constants && moment.now < begun_ + between_looks)
    return moment.moving ? void() : moment.ask_again_in(begun_ + between_looks - moment.now);
  begun_ = moment.now, looked_at_ = moment.mark(), looked_for_ = simulation.preset();
  std::optional<Linearisation> cloth;
  const bool small = simulation.lattice().size() <= largest_looked_at;
  const bool at_start = small && simulation.divergence().has_value();
  if (small && !at_start) cloth.emplace(simulation);
  work_.start(Priority::normal, [preset = simulation.preset(), at = *looked_at_, cloth = std::move(cloth),
                                 at_start](const JobControl& control) {
    return work_out(preset, at, cloth, at_start, [&control] { return control.cancelled(); });
  });
  moment.ask_again_in(soon);
}

}  // namespace tyglab
