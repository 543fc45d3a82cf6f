// Controls the length of inner steps for methods that choose their own: a PI controller on the estimated error, and
// counts of what limited the steps.
#pragma once

#include <cstdint>
#include <limits>

namespace tyglab {

struct Estimate;  // scheme.h

/// Counts of inner steps since the engine was created.
struct InnerSteps {
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;      ///< rejected: their error exceeded the tolerance
  std::int64_t by_stability = 0;  ///< of the accepted: it, or one of the five before, was longer than is stable, or
                                  ///< longer ones would be unstable
  std::int64_t by_accuracy = 0;   ///< longer steps would have exceeded the tolerance
  std::int64_t by_dt = 0;         ///< one of them covered dt
  std::int64_t too_short = 0;     ///< as short as allowed, but with an error above the tolerance
  std::int64_t below_digits = 0;  ///< the tolerance was less than the last digit of a coordinate
  std::int64_t force_evaluations = 0;
};

/// The measures by which a tried step is checked.
struct TriedStep {
  double error = 0;       ///< m; not finite where the step left all bounds
  double tolerance = 0;   ///< m
  double last_digit = 0;  ///< m, of the largest coordinate
  bool unstable = false;  ///< beyond_stability()
};

/// E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, II.4, with its stabilizing exponent
/// β = 0.04. In plain numbers, so that an engine can keep a copy.
class StepControl {
 public:
  static constexpr double shortest_part = 1e-4;  ///< of dt: a step is not made shorter

  /// Forgets earlier steps, but not the counts: the scene has changed.
  void restart() { begun_ = false; }
  /// For a method with that order of the estimated error, whose steps are to be no longer than `longest`, s.
  void set_method(int order, double longest) { order_ = order, longest_ = longest; }
  bool begun() const { return begun_; }
  /// With a first step of that length, s.
  void begin(double first);
  /// Length of the next step where `left` of dt has still to be covered, s; all of `left` if it is not longer.
  double next(double left, double dt);
  /// Whether the step of next() is accepted; the lengths of later ones follow from it.
  bool judge(const TriedStep& tried);
  void count_evaluations(int more) { counts_.force_evaluations += more; }
  const InnerSteps& counts() const { return counts_; }
  void continue_counts(const InnerSteps& counts) { counts_ = counts; }

 private:
  void count_accepted(const TriedStep& tried, bool met);

  bool begun_ = false, rejected_ = false;
  bool held_back_ = false;  ///< the error would have let the present step be longer than the longest
  int order_ = 5;
  double longest_ = std::numeric_limits<double>::infinity();  ///< s
  double wish_ = 0;                                           ///< length that the error advises, s
  double step_ = 0;                                           ///< length of the step that is being tried, s
  double shortest_ = 0;                                       ///< s
  double dt_ = 0;
  double old_error_ = 0;  ///< of the accepted step before, in tolerances
  int near_limit_ = 0;    ///< steps that still count as limited by stability
  InnerSteps counts_;
};

/// First length to try, s (Hairer's rule, II.4): v and a are the largest components of velocity and acceleration at the
/// start, `change` the largest of how much the latter differs after `probe` seconds of Euler's method; m, s.
double first_step(double tolerance, double v, double a, double change, double probe, int order);
/// The `probe` time, s: the time in which particles move by a hundredth of L.
double first_probe(double L, double v, double a);

/// Sums over all particles of products of how much two stages at one time differ: in x, v and a.
struct StageProducts {
  double xx = 0, xv = 0, vv = 0, xa = 0, va = 0;
};
/// Whether the fastest motion between the stages, fitted as a = -ω² x - 2ζω v, lies outside the method's region of
/// stability for a step of h seconds.
bool beyond_stability(const Estimate& estimate, const StageProducts& products, double h);

}  // namespace tyglab
