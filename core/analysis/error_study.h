// How large an error is made of the motion at hand, by the present settings and by others: short runs from one state,
// held against finer ones, all on the CPU engine. What `--tolerance` chooses from, and what the sandbox's accuracy card
// shows.
#pragma once

#include <optional>
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
  double error_rms_m = 0;  ///< over all particles, at the times of comparison; infinite where the run diverged
  double cost = 0;         ///< processor seconds on one thread for a simulated second
  bool resolved = true;    ///< false: the error is under ten times what two references differ by
};

/// Over which time a motion can be checked, and what it is checked by.
struct StudyReference {
  double seconds = 0;          ///< of motion that is compared
  Track track;                 ///< positions at accuracy_samples equal times in it
  double agreement_rms_m = 0;  ///< how far two references differ, of which one has half the other's dt
  std::string method;          ///< theirs
  double dt = 0;               ///< s, the smaller
};

/// Effort of a study.
struct StudyEffort {
  double reference = 3e8;  ///< particles times force evaluations, about 4 ns each, of a reference
  double point = 1e8;      ///< and of one setting
  double cost = 1e9;       ///< processor seconds for a simulated second that a setting available may take
};

/// The reference from that start over at most `seconds`: less where a cloth is so large, or so stiff, that it would
/// take more than the effort. Throws Stopped, and std::runtime_error where the motion cannot be followed.
StudyReference study_reference(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop);

/// One setting: those of the preset, with that integrator, precision, dt and tolerance.
ErrorPoint measure_point(const StudyStart& start, const StudyReference& reference, const Stop& stop);

/// Settings of one method from the coarsest that is stable on, each half of the one before it (a tenth, where the
/// method takes a tolerance), until the error is below `enough` (m), is not resolved, stops falling, or the next would
/// cost more than the effort.
std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, double enough,
                                     const StudyEffort& effort, const Stop& stop);

}  // namespace tyglab
