#include "core/analysis/boundary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/theory/modes.h"

namespace tyglab {
namespace {

/// Ratios: of the first two ends that a bisection tries, and of its ends when it stops.
struct Fineness {
  double first, last;
};
constexpr Fineness linear_motion{1.01, 1 + 2e-4}, chaotic_motion{1.1, 1.01};
constexpr int steps_between_looks = 25;  // steps from one look at the perturbation to the next

/// A simulation and the perturbation in it.
class Perturbed {
 public:
  explicit Perturbed(const Preset& preset) : simulation_(preset), rest_(start_state(preset)) {
    State state = rest_;
    std::mt19937_64 random(1);
    const auto any = [&] { return perturbation * std::sqrt(3.0) * (double(random() >> 11) * 0x1p-52 - 1); };
    for (auto* x : {&state.x.x, &state.x.y, &state.x.z})
      for (std::size_t p = 0; p < x->size(); ++p)
        if (const int columns = preset.columns; !simulation_.pinned(int(p) / columns, int(p) % columns))
          (*x)[p] += any();
    load(state);
    beginning_ = size();
  }
  /// False once it has diverged.
  bool advance(int steps) { return !simulation_.advance(steps).diverged; }
  /// By what the perturbation has grown since the start.
  double growth() const { return size() / beginning_; }
  /// Makes it as small as at the start again; returns by what it had grown. Its size is √(|δx|² + |δv|²/ω²), which no
  /// oscillation of that ω changes.
  double shrink(double omega) {
    State state = simulation_.read();
    const double part =
        difference(state.v.x, rest_.v.x) + difference(state.v.y, rest_.v.y) + difference(state.v.z, rest_.v.z);
    const double grown = std::sqrt(size() * size() + part / (omega * omega)) / beginning_, factor = 1 / grown;
    const auto toward = [&](Array<double>& now, const Array<double>& rest) {
      for (std::size_t p = 0; p < now.size(); ++p) now[p] = rest[p] + factor * (now[p] - rest[p]);
    };
    toward(state.x.x, rest_.x.x), toward(state.x.y, rest_.x.y), toward(state.x.z, rest_.x.z);
    toward(state.v.x, rest_.v.x), toward(state.v.y, rest_.v.y), toward(state.v.z, rest_.v.z);
    load(state);
    return grown;
  }

 private:
  static double difference(const Array<double>& a, const Array<double>& b) {
    double sum = 0;
    for (std::size_t p = 0; p < a.size(); ++p) sum += (a[p] - b[p]) * (a[p] - b[p]);
    return sum;
  }
  void load(const State& state) { simulation_.load(state); }
  double size() const {
    const PositionView x = simulation_.positions();
    double sum = 0;
    for (int i = 0; i < x.rows; ++i)
      for (int j = 0; j < x.columns; ++j) {
        const std::size_t p = std::size_t(i) * x.columns + j;
        const glm::dvec3 d = x.at(i, j) - glm::dvec3(rest_.x.x[p], rest_.x.y[p], rest_.x.z[p]);
        sum += d.x * d.x + d.y * d.y + d.z * d.z;
      }
    return std::sqrt(sum);
  }

  Simulation simulation_;
  State rest_;
  double beginning_ = 1;
};

/// The value from which on `breaks` holds, looked for round `guess` in ever wider steps; NaN where it is not within a
/// factor of 1,000.
double bisect(double guess, Fineness fineness, const std::function<bool(double)>& breaks) {
  constexpr double farthest = 1000;
  const bool broken = breaks(guess);
  double low = guess, high = guess;
  for (double apart = fineness.first; broken ? breaks(low = guess / apart) : !breaks(high = guess * apart);
       apart *= apart) {
    if (apart > farthest) return std::numeric_limits<double>::quiet_NaN();
    (broken ? high : low) = broken ? low : high;
  }
  while (high / low > fineness.last) {
    const double middle = std::sqrt(low * high);
    (breaks(middle) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

std::vector<Mode> modes_of(const Preset& preset) {
  return extreme_modes(Linearisation(Simulation(preset)), exact_tolerance);
}

/// Looks for the value of a constant from which on the sheet is unstable.
BoundaryRow bisected(const Preset& sheet, double Preset::*constant, double predicted) {
  BoundaryRow row{sheet, predicted};
  row.measured = bisect(predicted, linear_motion, [&](double value) {
    Preset p = sheet;
    p.*constant = value;
    return unstable(p);
  });
  row.preset.*constant = row.measured;
  return row;
}

}  // namespace

Preset taut_sheet(int side, double k_s, double k_d, const std::string& integrator) {
  Preset sheet;
  sheet.name = "Taut sheet";
  sheet.rows = sheet.columns = side;
  sheet.L = 0.04, sheet.m = 0.0004;
  sheet.tilt_deg = 90;
  sheet.initial_stretch = 1.1;
  sheet.pins.mode = Pins::Mode::boundary;
  sheet.k_s = k_s, sheet.k_d = k_d, sheet.k_b = 0, sheet.g = 0;
  sheet.integrator = integrator;
  sheet.precision = Precision::double_;
  return sheet;
}

double damping_for(const Preset& sheet, double zeta) {
  // The wave (π, 0): ω² = (8 k_s + 4 κ)/m with κ, tension over length; damping 12 k_d/m = 2ζω.
  const double tension = sheet.k_s * (1 - 1 / sheet.initial_stretch);
  return zeta / 6 * std::sqrt((8 * sheet.k_s + 4 * tension) * sheet.m);
}

bool unstable(const Preset& sheet) {
  assert(sheet.precision == Precision::double_);
  Perturbed cloth(sheet);
  for (int steps = 0; steps < steps_that_count; steps += steps_between_looks)
    if (!cloth.advance(steps_between_looks) || cloth.growth() >= growth_that_counts) return true;
  return false;
}

BoundaryRow measure_dt(const Preset& sheet) {
  return bisected(sheet, &Preset::dt, dt_crit(scheme(sheet.integrator), modes_of(sheet)));
}

BoundaryRow measure_k_s(const Preset& sheet) {
  return bisected(sheet, &Preset::k_s,
                  sheet.k_s * stiffness_margin(scheme(sheet.integrator), modes_of(sheet), sheet.dt));
}

BoundaryRow measure_growth(const Preset& sheet) {
  const std::vector<Mode> modes = modes_of(sheet);
  BoundaryRow row{sheet, growth_per_step(scheme(sheet.integrator), modes, sheet.dt)};
  // Shrunk again and again, so that in the end only the mode that grows most is left.
  constexpr double unmixed = 300, measured_over = 60, shrunk_after = 7;  // natural logarithms
  const int piece = std::max(1, int(shrunk_after / row.predicted));
  const int before = int(unmixed / shrunk_after), pieces = std::max(1, int(measured_over / shrunk_after));
  Perturbed cloth(sheet);
  double sum = 0;
  for (int n = 0; n < before + pieces; ++n) {
    if (!cloth.advance(piece)) return row.measured = std::numeric_limits<double>::quiet_NaN(), row;
    const double grown = cloth.shrink(modes[0].omega());
    if (n >= before) sum += std::log(grown);
  }
  row.measured = sum / (double(pieces) * piece);
  return row;
}

Preset slack_cloth(int side, double k_d, const std::string& integrator) {
  Preset cloth;
  cloth.name = "Hanging cloth";
  cloth.rows = cloth.columns = side;
  cloth.k_d = k_d;
  cloth.integrator = integrator;
  cloth.precision = Precision::double_;
  return cloth;
}

BoundaryRow measure_slack(const Preset& cloth, int steps) {
  Preset calm = cloth;
  calm.integrator = "velocity_verlet", calm.dt = 1e-4;
  Simulation hanging(calm);
  hanging.advance(int(2 / calm.dt));
  const Scheme& method = scheme(cloth.integrator);
  BoundaryRow row{cloth, dt_crit(method, extreme_modes(Linearisation(hanging), exact_tolerance))};
  row.any_configuration = dt_crit(method, worst_modes(cloth));
  row.measured = bisect(row.predicted, chaotic_motion, [&](double dt) {
    Preset p = cloth;
    p.dt = dt;
    return Simulation(p).advance(steps).diverged;
  });
  row.preset.dt = row.measured;
  return row;
}

namespace {

/// What a method that is unstable at every dt without damping is measured by.
void add_growth(BoundaryCases& cases, int side, const std::string& integrator) {
  for (const double zeta : {0.0, 0.05})
    for (const double h : {0.3, 0.6}) {
      Preset p = taut_sheet(side, 50, 0, integrator);
      p.k_d = damping_for(p, zeta);
      p.dt = h / std::sqrt(8 * p.k_s / p.m);
      cases.growth.push_back(p);
    }
}

}  // namespace

BoundaryCases boundary_cases(bool quick) {
  using List = std::vector<double>;
  const List all_k_s = quick ? List{1, 1e3, 1e6} : List{1, 10, 100, 1e3, 1e4, 1e5, 1e6};
  const std::vector<int> sides = quick ? std::vector{8, 16} : std::vector{8, 16, 32};
  BoundaryCases cases;
  cases.slack_steps = quick ? 5000 : 20000;
  for (const Scheme& method : schemes()) {
    if (is_implicit(method) || !has_step_limit(method)) continue;
    const std::string name(method.name);
    const bool always_grows = stability_limit(method, 0) == 0;
    for (const int side : sides) {
      if (always_grows) {
        add_growth(cases, side, name);
        continue;
      }
      for (const double zeta : {0.0, 0.1})
        for (const double k_s : all_k_s) {
          cases.dt.push_back(taut_sheet(side, k_s, 0, name));
          cases.dt.back().k_d = damping_for(cases.dt.back(), zeta);
        }
    }
    if (always_grows) continue;
    for (const double k_d : {0.0, 0.001})
      for (const double dt : quick ? List{1e-3} : List{1e-2, 1e-3, 1e-4, 2e-5}) {
        cases.k_s.push_back(taut_sheet(16, 1, k_d, name));
        cases.k_s.back().dt = dt;
      }
    for (const double k_d : {0.0, 0.002}) cases.slack.push_back(slack_cloth(quick ? 12 : 32, k_d, name));
  }
  return cases;
}

}  // namespace tyglab
