// Measures the error of the present settings and of others on the present motion: short runs from one state are
// compared with finer runs, all on the CPU engine. `--tolerance` chooses from the results, and the sandbox's Accuracy
// card shows them.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/reference.h"
#include "core/simulation.h"

namespace tyglab {

/// Constants, and the state to start from; none: the constants' own start.
struct StudyStart {
  Preset preset;
  std::optional<Snapshot> from;
};

/// Error and cost of one setting.
struct ErrorPoint {
  std::string integrator;
  Precision precision = Precision::double_;
  double dt = 0;           ///< s, as it was measured: of which whole steps lie between the times of comparison; of
                           ///< methods that choose their own steps the mean of those
  double tolerance = 0;    ///< m; of those methods
  double error_rms_m = 0;  ///< over all particles, at the times of comparison; infinite where the run diverged or was
                           ///< given up
  double cost = 0;         ///< processor seconds on one thread for a simulated second
  bool resolved = true;    ///< false: the error is under ten times what two references differ by
  bool converged = true;   ///< false: an implicit method's solves missed their tolerance
  bool given_up = false;   ///< it took longer than it may
};

/// The way in which distances at several times become one error.
enum class ErrorOver {
  all_times,  ///< their root mean square
  worst_time  ///< the largest of them
};

/// The reference of a motion, and the time that it covers.
struct StudyReference {
  double seconds = 0;          ///< of motion that is compared
  Track track;                 ///< positions at accuracy_samples equal times in it
  double agreement_rms_m = 0;  ///< how far two references differ, of which one has half the other's dt
  std::string method;          ///< theirs
  double dt = 0;               ///< s, the smaller
  ErrorOver over = ErrorOver::all_times;
  double blow =
      0;  ///< m/s, of the hardest blow of a body: its step stops a particle up to blow · dt too early, for a while

  /// How far the positions are from its own, m; infinite where one is not finite.
  double error_of(const Track& other) const;
};

/// Effort of a study.
struct StudyEffort {
  double reference = 3e8;  ///< particles times force evaluations, about 4 ns each, of a reference
  double point = 1e8;      ///< and of one setting
  double cost = 1e9;       ///< processor seconds for a simulated second that a setting available may take
};

/// Called with the progress of the runs of a reference: the time that they cover, s, and the fraction of their steps
/// that is done, 0 to 1.
using ReferenceProgress = std::function<void(double seconds, double part)>;

/// The reference from that start over at most `seconds`: less where a cloth is so large, or so stiff, that it would
/// take more than the effort. Throws Stopped, and std::runtime_error where the motion cannot be followed.
StudyReference study_reference(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop,
                               const ReferenceProgress& progress = {});

/// The reference over exactly that time, with `finer` times as many steps as the coarsest stable dt of Verlet asks for.
/// Throws as study_reference does.
StudyReference reference_over(const StudyStart& start, double seconds, double finer, ErrorOver over, const Stop& stop,
                              const ReferenceProgress& progress = {});
/// The cost of such a reference: particles times force evaluations.
double reference_effort(const Preset& preset, double seconds, double finer);
/// Repeats the motion with another kind of method, and raises the reference's disagreement to how far that run is from
/// it: in contact and where springs tear, runs of one method can agree and be wrong together. Takes about as long as
/// the reference did. Throws as study_reference does.
void check_by_another_method(const StudyStart& start, StudyReference& reference, const Stop& stop,
                             const ReferenceProgress& progress = {});

/// One setting: those of the preset, with that integrator, precision, dt and tolerance. `most`: processor seconds after
/// which it is given up; what it had taken by then is its cost.
ErrorPoint measure_point(const StudyStart& start, const StudyReference& reference, const Stop& stop,
                         double most = std::numeric_limits<double>::infinity());

/// Settings of one method from the coarsest that is stable on (0.1 s where all are), each half of the one before it (a
/// tenth, where the method takes a tolerance), until `enough` says so of those that were measured, the error stops
/// falling, or the next would cost more than the effort.
std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, const StudyEffort& effort,
                                     const Stop& stop, const std::function<bool(std::span<const ErrorPoint>)>& enough);
/// The same until the error is below `enough` (m), or not resolved.
std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, double enough,
                                     const StudyEffort& effort, const Stop& stop);

}  // namespace tyglab
