// Makes steps that may take longer than a frame in a background thread.
//
// With most methods every step costs the same, and frames make as many steps as time permits (Pacing). A method that
// solves equations, iterates or chooses its own steps may need seconds for a single one. A worker makes its steps, and
// those of the copies, and owns the true cloth meanwhile; the session shows a stand-in (Simulation::stand_in), the
// cloth before the step. Each update waits for the worker as long as steps may take anyway, so quick steps are ready in
// the same frame. Before any change of the cloth the step is stopped (settle), which undoes its work.
#pragma once

#include <cassert>
#include <memory>

#include "app/studies/job.h"
#include "core/lockstep.h"
#include "core/simulation.h"

namespace tyglab {

struct Session;

/// The result of a batch of steps in the background.
struct BackgroundResult {
  AdvanceResult advance;   ///< of the original; nothing where it had diverged
  int steps = 0;           ///< of its dt, by which time has gone on
  double t = 0;            ///< s, until which the copies were to go
  double seconds = 0;      ///< on the wall, that all of them took, those of the copies too
  double computing_s = 0;  ///< of the original's steps alone
};

class BackgroundSteps {
 public:
  /// Whether steps of the cloth or one of its copies must be made in the background.
  static bool wanted(const Session& session);

  /// Whether the session shows a stand-in.
  bool busy() const { return cloth_ != nullptr; }
  /// Begins that many steps of the cloth and its copies, or of the copies alone if the cloth has diverged.
  void start(Session& session, int steps);
  /// Waits for the steps for at most that time, s. Returns whether they are done.
  bool wait(double seconds) const { return work_.wait(seconds); }
  bool ready() const { return work_.ready(); }
  /// Waits for the steps and puts the cloth back. Throws EngineError if the steps failed.
  BackgroundResult take(Session& session);
  void cancel() { work_.cancel(); }

  /// Progress of the present step, 0 to 1, as its method estimates it.
  double progress() const { return cloth_ ? cloth_->engine().step_progress() : 0; }
  /// The session's time at which the steps began, s; busy() must hold.
  double begun() const {
    assert(busy());
    return begun_;
  }

 private:
  std::shared_ptr<Simulation> cloth_;  ///< the true one, while it is away
  Lockstep copies_;
  double begun_ = 0;
  Job<BackgroundResult> work_;
};

/// Stops background steps so that the cloth can be changed; it is then at its last complete step.
void settle(Session& session);

}  // namespace tyglab
