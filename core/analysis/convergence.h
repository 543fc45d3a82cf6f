// Measures the order of a method in a scene: the errors with dt, dt/2, dt/4, …, and the slope through them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/error_study.h"

namespace tyglab {

/// dt, dt/2, …, dt/16.
inline constexpr int convergence_levels = 5;

struct ConvergencePoint {
  double dt = 0;                 ///< s
  double error_rms_m = 0;        ///< over all particles and times of comparison; infinite where the run diverged
  double difference_rms_m = -1;  ///< how far the run with dt/2 is from this one; below 0: not known
  bool resolved = true;          ///< false: the error is under ten times what the references differ by
};

/// The convergence of a scene, as far as it has been measured.
struct Convergence {
  Preset of;                 ///< the constants
  double t = 0;              ///< s, where the motion that is compared begins
  double seconds = 0;        ///< how long it is
  StudyReference reference;  ///< without its track; of no agreement where there is none
  bool referenced = false;   ///< otherwise the motion could not be followed finely, and only differences are known
  std::vector<ConvergencePoint> points;  ///< coarsest first
  int torn = 0;                          ///< springs that the finest run tore
  bool done = false;
  std::string problem;  ///< why there is nothing
};

/// A slope through points.
struct MeasuredOrder {
  double order = 0;
  double coarsest = 0, finest = 0;  ///< dt of the points that it goes through, s
  bool by_differences = false;      ///< of runs from each other, for want of a reference (Richardson)
};

/// Whether errors against the reference show: at least two of them are resolved, or nothing has diverged but all is
/// still to come. Otherwise runs are compared with each other.
bool by_reference(const Convergence& study);
/// The error of a point by either measure, m; none if it is unknown or not resolved.
std::optional<double> shown_error(const Convergence& study, const ConvergencePoint& point);
/// The order of the method for that scene's damping, as its table says of smooth motion.
int nominal_order(const Preset& preset);
/// Through the finest resolved points, four at most, by least squares of logarithms. None while there are fewer
/// than two points.
std::optional<MeasuredOrder> measured_order(const Convergence& study);
/// The result of a finished study, and what reduces the order, in sentences.
std::string convergence_words(const Convergence& study);

/// Measures all points, in double, so that rounding does not hide the order; calls `found` with the results after every
/// run. `seconds`: of motion, at most. Throws Stopped. Other errors become the study's problem.
void measure_convergence(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop,
                         const std::function<void(const Convergence&)>& found);

/// A row for each dt.
std::string convergence_csv(const Convergence& study);

}  // namespace tyglab
