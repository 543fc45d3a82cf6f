// All background studies, each of which runs while it is requested.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "app/studies/accuracy_watch.h"
#include "app/studies/crossing_watch.h"
#include "app/studies/job.h"
#include "app/studies/map_watch.h"
#include "app/studies/moment.h"
#include "app/studies/settings_watch.h"
#include "app/studies/stability_watch.h"
#include "app/studies/verify_watch.h"
#include "core/analysis/convergence.h"
#include "core/analysis/settings_search.h"
#include "core/engines/opencl/opencl_devices.h"

// Measures the order of convergence of the present motion in the background, on request.

namespace tyglab {

class ConvergenceWatch {
 public:
  static constexpr double window = 0.25;  ///< s of motion, where it does not take too long

  /// Measures from the present moment on, and drops a running measurement.
  void begin(StudyMoment& moment);
  /// Called in every frame in which it is wanted: begins where nothing is known, and again once constants have changed.
  void poll(StudyMoment& moment);
  /// Stops and discards the measurement.
  void drop();
  /// A copy of the results; none while there are none.
  std::optional<Convergence> study() const;

 private:
  Study<Convergence> work_;
  double changed_ = -1;  ///< s on the session's clock; when the constants last differed from those of the study
};

// Lists the OpenCL devices, once and in the background, because drivers are slow and some fail.

class DeviceSearch {
 public:
  /// Begins, the first time that it is called.
  void begin();
  bool busy() const { return work_.busy(); }
  /// The result; null until it is known.
  const OpenClInventory* found();

 private:
  Job<OpenClInventory> work_;
  std::optional<OpenClInventory> found_;
};

// The engine menu's "Automatic": measures in the background which engine is fastest with the present scene.

class EngineSearch {
 public:
  /// Begins to measure, unless it is doing so. The cloth must stand still meanwhile: its steps would be in the way.
  void begin(const Preset& preset, int threads);
  bool busy() const { return work_.busy(); }
  /// The choice, once, when it is known; what went wrong otherwise.
  std::optional<std::variant<EngineChoice, JobError>> take();

 private:
  Job<EngineChoice> work_;
};

/// What is wanted of a moment. Cards, panels and labs say so; nothing is inferred from what was drawn.
struct Wants {
  bool stability = false;                               ///< limits of dt, zones of constants
  bool accuracy = false;                                ///< errors of the present settings and of other methods
  bool convergence = false;                             ///< the order of convergence
  bool settings = false;                                ///< settings for an error
  bool settings_kept = false;                           ///< a search for them that was asked for goes on out of sight
  bool map = false;                                     ///< stiffness against dt
  bool crossings = false;                               ///< triangles of the cloth that cross each other
  bool verification = false;                            ///< the gallery of exact answers, while its card is open
  bool ledger = false;                                  ///< where energy comes from and goes
  bool step = false;                                    ///< the picked particle's next step, written out
  bool forces = false, height = false, copies = false;  ///< samples for their plots

  Wants& operator|=(const Wants& other);
};

struct Studies {
  StabilityWatch stability;
  AccuracyWatch accuracy;
  ConvergenceWatch convergence;
  SettingsWatch settings;
  MapWatch map;
  CrossingWatch crossings;
  VerifyWatch verification;
  EngineSearch engine;
  DeviceSearch devices;

  /// Continues the requested studies, and drops the others.
  void update(const Wants& wants, StudyMoment& moment);
};

}  // namespace tyglab
