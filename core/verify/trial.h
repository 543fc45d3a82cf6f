// What a case measures with: simulations, comparisons, orders.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/simulation.h"
#include "core/verify/gallery.h"

namespace tyglab::verify {

inline constexpr double g = 9.82;  ///< m/s²

/// A cloth in double that nothing moves: without gravity, bending, damping and pins, hanging straight down.
Preset quiet_cloth(int rows, int columns, std::string_view integrator);
/// The same with the bending springs that presets have.
Preset bending_cloth(int rows, int columns, std::string_view integrator);
/// A mass on a spring in double, without gravity and damping: 0.1 kg on 40 N/m, released 0.1 m above its place.
Preset quiet_weight(std::string_view integrator);

class Trial {
 public:
  Trial(const Conditions& conditions, Outcome& outcome) : conditions_(conditions), outcome_(outcome) {}

  /// The preset as it is simulated (Conditions::disturb).
  Preset scene(Preset preset) const;
  /// A simulation of it at its start.
  Simulation start(const Preset& preset) const { return Simulation(scene(preset)); }
  /// Makes that many steps. Throws Stopped, and std::runtime_error where the motion diverges.
  void advance(Simulation& simulation, std::int64_t steps) const;
  /// Throws Stopped if it has to; for long work of another kind.
  void look() const;
  /// The case's picture is that of this moment, unless another one follows.
  void show(const Simulation& simulation) const;
  /// The same of a cloth that is no simulation.
  void show(const Lattice& lattice, const std::function<glm::dvec3(int i, int j)>& x_of,
            const std::function<bool(int i, int j)>& pinned) const;

  /// Compares two values; the case tells the comparison with the largest error. Returns the error.
  double compare(double exact, double measured, const std::string& at = {});
  /// An order, from errors at h, h/2, …, by the last two; the case tells the one that is farthest from what is
  /// expected.
  void converges(double expected, std::vector<double> errors, const std::string& of = {});
  /// Compares what measured(h) returns at each h, which are halved from one to the next, with one value: the finest by
  /// compare(), all of them by converges().
  void refine(double expected, double exact, std::initializer_list<double> h,
              const std::function<double(double)>& measured, const std::string& of = {});

 private:
  const Conditions& conditions_;
  Outcome& outcome_;
};

/// |measured - exact| over |exact|; |measured| where exact is 0.
double error_of(double exact, double measured);
/// The value in [low, high] from which on `holds` no longer does, to one part in `parts` of it; it must hold at low.
double bisect(double low, double high, double parts, const std::function<bool(double)>& holds);

}  // namespace tyglab::verify
