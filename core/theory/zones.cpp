#include "core/theory/zones.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/model/notation.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-7;  // of the spectral radius, by repeated squaring
constexpr double precise = 1.001;  // borders, as a factor

/// Stretch springs at a particle inside the cloth: no other has more of them. In a whole cloth damping acts on each.
int springs_inside(const Preset& p) {
  return std::min(p.rows, 3) * std::min(p.columns, 3) - 1;
}

/// ω·dt up to which no undamped mode grows. Kept, since every slider's zones ask for it. Two threads that ask at once
/// find the same.
double undamped_limit(const Scheme& method) {
  if (!has_step_limit(method)) return no_limit;
  static std::vector<std::atomic<double>> known(schemes().size());  // 0: not yet, or soon found again
  std::atomic<double>& limit = known[std::size_t(&method - schemes().data())];
  if (limit == 0) limit = stability_limit(method, 0);
  return limit;
}

/// Says which modes a method lets grow.
class Judge {
 public:
  /// One of schemes().
  explicit Judge(const Scheme& method) : method_(method), undamped_(undamped_limit(method)) {}

  Zone zone(const Preset& p) const {
    if (!has_step_limit(method_)) return Zone::stable;
    const std::vector<Mode> worst = worst_modes(p);
    if (std::none_of(worst.begin(), worst.end(), [&](const Mode& mode) { return grows(mode, p.dt); }))
      return Zone::stable;
    return p.kind == Kind::one_weight || always_grows(p) ? Zone::unstable : Zone::depends;
  }

 private:
  bool grows(const Mode& mode, double dt) const {
    if (mode.damping == 0) return mode.omega() * dt > undamped_;
    return growth_per_step(method_, {&mode, 1}, dt) > rounding;
  }

  /// Whether all modes do that may take a spring's part: `least` and `most` bound their stiffness, damping is any of
  /// `springs` times k_d/m.
  bool all_grow(const Preset& p, double least, double most, std::initializer_list<double> springs) const {
    constexpr int samples = 8;
    for (int n = 0; n <= samples; ++n)
      for (const double count : springs)
        if (!grows({least + (most - least) * n * n / (samples * samples), count * p.k_d / p.m}, p.dt)) return false;
    return true;
  }

  bool always_grows(const Preset& p) const {
    const double most = any_configuration(p).stiffness, one = spring_constants(p).least() / p.m;
    // The end of a spring that pulls, moved along it: the fastest mode is at least as stiff.
    if (p.k_d == 0) return one > 0 && grows({one, 0}, p.dt);
    if (one > 0 && all_grow(p, one, most, {1, 2, 4, 8, 12})) return true;
    // A particle inside a whole cloth, moved anywhere: the most damped mode is at least as damped in every shape.
    const double inside = springs_inside(p);
    return all_grow(p, 0, most, {inside, (inside + 12) / 2, 12});
  }

  const Scheme& method_;
  double undamped_;
};

/// The value within a thousandth of which the zone becomes another.
double border(const Judge& judge, Preset preset, double Preset::*field, double from, double to, Zone zone) {
  while (to > from * precise) {
    const double middle = std::sqrt(from * to);
    preset.*field = middle;
    (judge.zone(preset) == zone ? from : to) = middle;
  }
  return std::sqrt(from * to);
}

}  // namespace

std::string_view zone_name(Zone zone, Kind kind) {
  const bool cloth = kind == Kind::cloth;
  if (zone == Zone::depends) return "depends on the shape";
  if (zone == Zone::stable) return cloth ? "stable in any shape" : "stable";
  return cloth ? "unstable in every shape" : "unstable";
}

std::vector<ZonedConstant> zoned_constants(const Preset& p) {
  std::vector<std::string_view> keys;
  const auto add = [&](std::string_view key) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  };
  add("dt");
  for (const Force* force : force::all)
    if (force->constant != nullptr) add(force->constant(p));
  for (const PresetRow& row : notation())
    if (!row.otherwise.empty()) add(is_absent(row, p) ? row.otherwise : row.key);
  for (const std::string_view key : {"k_d", "m", "L"}) add(key);
  std::vector<ZonedConstant> all;
  for (const std::string_view key : keys)
    if (const PresetRow& row = *find_row(key); !row.only_one_kind || row.only == p.kind)
      all.push_back({row.key, std::get<double Preset::*>(row.field)});
  return all;
}

Zone zone_of(const Preset& preset) {
  return Judge(scheme(preset.integrator)).zone(preset);
}

double every_shape_limit(const Preset& preset) {
  constexpr double farthest = 1e6;  // of the first dt that is not stable
  const Scheme& method = scheme(preset.integrator);
  const double least = dt_crit(method, worst_modes(preset));
  if (std::isinf(least)) return no_limit;
  const Judge judge(method);
  Preset probe = preset;
  const auto unstable_at = [&](double dt) {
    probe.dt = dt;
    return judge.zone(probe) == Zone::unstable;
  };
  double low = least > 0 ? least : 1e-9;
  if (unstable_at(low * precise)) return least;
  double high = low * precise;
  while (!unstable_at(high)) {
    if (high > farthest * low) return no_limit;
    high *= 2;
  }
  for (low = high / 2; high > low * precise;) {
    const double middle = std::sqrt(low * high);
    (unstable_at(middle) ? high : low) = middle;
  }
  return high;
}

std::vector<ZoneSpan> stability_zones(const Preset& preset, double Preset::*field, double least, double most,
                                      const Stop& stop) {
  assert(least > 0 && least < most);
  constexpr int most_borders = 8;  // of a method that rounding lets flicker
  const int samples = std::max(1, int(std::lround(4 * std::log10(most / least))));
  const Judge judge(scheme(preset.integrator));
  Preset probe = preset;
  const auto at = [&](double value) {
    probe.*field = value;
    return judge.zone(probe);
  };
  std::vector<ZoneSpan> zones{{least, least, at(least)}};
  double before = least;
  for (int n = 1; n <= samples && !(stop && stop()); ++n) {
    const double value = n == samples ? most : least * std::pow(most / least, double(n) / samples);
    const Zone zone = at(value);
    // Between two samples may lie more than one border: where damping decides, little depends on the shape.
    for (int borders = 1; zone != zones.back().zone && !(stop && stop()); ++borders) {
      const double edge = border(judge, preset, field, before, value, zones.back().zone);
      zones.back().to = edge;
      before = borders < most_borders ? std::min(edge * precise, value) : value;
      zones.push_back({edge, edge, at(before)});
    }
    zones.back().to = before = value;
  }
  const bool may_be_0 = field != &Preset::m && field != &Preset::dt && field != &Preset::L;
  if (may_be_0 && at(0) == zones.front().zone) zones.front().from = 0;
  return zones;
}

}  // namespace tyglab
