// `tyglab bench accuracy` measures error against run time for the integrators of this project and of Boost.Odeint.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/reference.h"
#include "core/model/preset.h"

namespace tyglab {

enum class AccuracyStatus { ok, below_floor, diverged };
std::string_view name_of(AccuracyStatus);

struct AccuracyRow {
  std::string scene, integrator;
  Precision precision = Precision::double_;
  EngineKind engine = EngineKind::cpu;
  double dt = 0;  ///< s; the mean step where the method chooses its own
  std::int64_t steps = 0, force_evaluations = 0;
  double seconds = 0;  ///< thread_seconds() of the steps, on OpenCL wall_seconds(); the least of a few runs if short
  double error_rms_m = 0;
  AccuracyStatus status = AccuracyStatus::ok;
  std::optional<double> tolerance = {};  ///< m and m/s, for those methods
  std::int64_t unconverged = 0;          ///< implicit solves that did not reach their tolerance
};

/// The time that a method may take in a scene.
struct AccuracyEffort {
  double longest_s = 0.4;  ///< of one run
  bool fine = true;        ///< two dt for each halving; otherwise one
  int repeats = 6;         ///< of a run that is short, beside the first
  double repeated_below_s = 0.04;
};

/// The least dt that presets allow, s.
inline constexpr double least_dt = 1e-7;

/// Whether the reference resolves an error of that size.
bool can_tell(const Reference& reference, double error_rms_m);
/// The status of a finished run: an error under ten times what the references differ by is not resolved.
AccuracyStatus judged(const Reference& reference, double error_rms_m);
/// Numbers of steps from one sample to the next, largest dt first, down to the least dt of presets.
std::vector<int> accuracy_ladder(const AccuracyScene& scene, double largest_dt, const AccuracyEffort& effort);
/// Tolerances for methods that choose their own steps, m, coarsest first.
std::vector<double> tolerance_ladder(Precision precision, const AccuracyEffort& effort);
/// Whether a finer row of the same method is worth measuring after these: not under the floor, beyond the time allowed,
/// or where rounding makes the error grow.
bool worth_going_on(const std::vector<AccuracyRow>& rows, const AccuracyEffort& effort);

/// All rows of one integrator of this project, largest dt first; the last are missing if `stop` says so. On the engine
/// of the scene's preset; throws EngineError where that is not there.
std::vector<AccuracyRow> measure_integrator(const AccuracyScene& scene, const Reference& reference,
                                            const std::string& integrator, Precision precision,
                                            const AccuracyEffort& effort, const Stop& stop);

/// The names of Boost.Odeint's rows: "odeint_runge_kutta4", …
std::vector<std::string> odeint_methods();
/// Whether they can compute a scene at all: they do not support bodies.
bool odeint_can(const AccuracyScene& scene);
/// All rows of one of them, driven by EngineForces.
std::vector<AccuracyRow> measure_odeint(const AccuracyScene& scene, const Reference& reference,
                                        const std::string& method, Precision precision, const AccuracyEffort& effort,
                                        const Stop& stop);

/// The fastest method for an error.
struct AccuracyWinner {
  std::string scene;
  double error_rms_m = 0;  ///< a power of ten
  std::string integrator;  ///< the best of this project
  Precision precision = Precision::double_;
  double seconds = 0;          ///< between two rows, interpolated
  bool at_largest_dt = false;  ///< it reaches this error with its largest stable dt
  std::string odeint;          ///< the best of Boost.Odeint's; empty: none reaches it
  Precision odeint_precision = Precision::double_;
  double odeint_seconds = 0;
};

/// The run time at which a method reaches an error.
struct Reached {
  double seconds;
  bool at_largest_dt;
};
/// From the rows of one method, coarsest first; between two rows on a straight line in logarithms.
std::optional<Reached> reached(std::span<const AccuracyRow> rows, double error_rms_m);

/// A line for each decade of error from 1e-2 to 1e-6 m that this project reaches on the CPU engine and the reference
/// can tell, from all rows of one scene, those of a method one after the other.
std::vector<AccuracyWinner> accuracy_winners(std::span<const AccuracyRow> rows, const Reference& reference);
/// Groups rows by method, precision and engine.
std::vector<std::span<const AccuracyRow>> by_method(std::span<const AccuracyRow> rows);

}  // namespace tyglab
