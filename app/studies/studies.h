// All background studies, each of which runs while it is requested.
#pragma once

#include "app/studies/accuracy_watch.h"
#include "app/studies/convergence_watch.h"
#include "app/studies/device_search.h"
#include "app/studies/engine_search.h"
#include "app/studies/map_watch.h"
#include "app/studies/settings_watch.h"
#include "app/studies/stability_watch.h"

namespace tyglab {

/// What is wanted of a moment. Cards, panels and labs say so; nothing is inferred from what was drawn.
struct Wants {
  bool stability = false;                               ///< limits of dt, zones of constants
  bool accuracy = false;                                ///< errors of the present settings and of other methods
  bool convergence = false;                             ///< the order of convergence
  bool settings = false;                                ///< settings for an error
  bool settings_kept = false;                           ///< a search for them that was asked for goes on out of sight
  bool map = false;                                     ///< stiffness against dt
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
  EngineSearch engine;
  DeviceSearch devices;

  /// Goes on with what is wanted, and drops the rest.
  void update(const Wants& wants, StudyMoment& moment);
};

}  // namespace tyglab
