// Finds methods and steps that keep a given error on the present motion, and their cost, by short runs compared with a
// fine reference. `--tolerance` and "Find settings" in the Accuracy card choose from the results.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/error_study.h"
#include "core/model/preset.h"

namespace tyglab {

/// The settings that are given and therefore not chosen.
struct SettingsKeeps {
  bool integrator = false, precision = false;
};

/// The goal of a search.
struct SettingsGoal {
  double tolerance = 1e-4;  ///< m
  double seconds = 1;       ///< of motion
  SettingsKeeps keeps = {};
  bool present = false;  ///< measure the present settings too
};

/// The results so far. Errors are root mean squares over the particles at the time of comparison at which they are
/// largest.
struct SettingsSearch {
  Preset of;     ///< the constants
  double t = 0;  ///< s, where the motion begins
  SettingsGoal goal;
  double seconds = 0;  ///< of motion that is compared: less than asked for only where nothing new happens afterwards
  bool rough = false;  ///< with bodies or tearing: errors do not fall evenly with dt
  double reference_part = 0;            ///< of the fine runs to compare with that is done, 0 to 1
  double agreement_rms_m = 0;           ///< how far references of it differ
  std::string references;               ///< what they are
  std::optional<ErrorPoint> present;    ///< the present settings, where they were asked for
  std::vector<ErrorPoint> points = {};  ///< a method's one after the other, coarsest first
  int methods = 0, methods_done = 0;
  bool done = false;
  std::string problem;  ///< a sentence: why nothing can be found

  /// Progress of the search, 0 to 1: fine runs and methods count as half each.
  double part_done() const;
  /// How many times the distance between references a tolerance must be: twice as many where errors do not fall evenly.
  double margin() const { return rough ? 2 * reference_margin : reference_margin; }
};

/// Measures settings until the goal is reached by each method that can; tells `found` what it knows after every step of
/// the search. Errors become the search's problem. It takes some seconds of processor time: at most about ten for the
/// references of a large cloth, and about ten for the settings. Throws Stopped.
SettingsSearch search_settings(const StudyStart& start, const SettingsGoal& goal, const Stop& stop,
                               const std::function<void(const SettingsSearch&)>& found);

/// The cheapest setting of each method whose error is at most half the tolerance (m), cheapest first: half, since
/// errors were looked at a few times only. Where errors do not fall evenly, a setting counts only if the finer ones
/// measured, and there is one, reach it too. Nothing where the tolerance is less than the search's margin times the
/// distance between references. From one search a looser tolerance never costs more than a tighter one.
std::vector<ErrorPoint> settings_for(const SettingsSearch& search, double tolerance);

/// The least error that a setting can be relied on for, m; `of` becomes that setting. Infinite and null where there is
/// none.
double least_reliable_error(const SettingsSearch& search, const ErrorPoint** of = nullptr);

double two_digits_above(double value);

/// The tightest tolerance for which there is a setting, m, in two digits; infinite where there is none.
double tightest_tolerance(const SettingsSearch& search);

/// The preset with a setting: its integrator, precision, and dt (in two digits, at most what was measured) or
/// tolerance.
Preset with_setting(const Preset& preset, const ErrorPoint& point);

// `--engine auto` chooses the engine that steps a scene fastest on this machine, from short runs.

/// The time of an engine for a scene.
struct EngineTime {
  EngineKind engine = EngineKind::cpu;
  int device = -1;    ///< number of an OpenCL device
  std::string name;   ///< for people
  double ns = 0;      ///< for a particle and step; 0: it cannot run the scene
  std::string fault;  ///< why not
};

struct EngineChoice {
  EngineKind engine = EngineKind::cpu;
  int device = -1;
  std::vector<EngineTime> times;  ///< of all that could have been chosen; empty where there was nothing to measure
  bool measured = false;          ///< just now, and not on an earlier day
  std::string why;                ///< a sentence
};

/// Measures the CPU engine with that many threads and every OpenCL device on the preset's cloth (of at most 1024 x 1024
/// particles), a few hundredths of a second each, three times in turn. Times are kept on disk, by device, driver,
/// threads, method, precision, features and size to a power of two, and read from there the next time. Where two are
/// within 5 % the CPU engine is taken, which waits for no compiler.
EngineChoice choose_engine(const Preset& preset, int threads);

/// The sentence for such times; the first is the CPU engine's.
EngineChoice choose_among(std::vector<EngineTime> times, bool measured);

}  // namespace tyglab
