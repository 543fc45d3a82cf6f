// Builds cloths that take longer than a frame in a background thread, while the present cloth continues; also the
// programs of OpenCL devices.
//
// From 100,000 particles on, every request for new arrays (Simulation::rebuilds: another lattice, precision, engine or
// method, a restart, opening a preset) is built in the background. Panels show and change the requested preset. Of
// changes during the build, the present cloth receives those that are quick, and the new cloth receives all. Another
// request is built next, and useless results are discarded, since a thread cannot be stopped halfway. A new cloth that
// needs the state of the old one (another precision during motion) is read from the old one, which stands still until
// then; cuts, pins and releases are stored and made afterward. With --frames everything is built at once, so every
// machine shows identical frames. A child process builds the programs of OpenCL devices (app/process/program_run.h),
// also for small cloths: a feature takes effect once its program is ready, and a preset on a device opens once it can
// run. If the device fails, the CPU engine opens the preset.
#pragma once

#include <cassert>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/history.h"
#include "app/studies/job.h"
#include "core/simulation.h"

namespace tyglab {

struct Experiment;
struct Session;

/// The preset that was opened or saved last: what "unsaved" and every reset compare with.
struct Document {
  Preset saved;
  std::string label;
  std::filesystem::path file;                         ///< the user's file, empty for a shipped preset
  std::shared_ptr<const Experiment> experiment = {};  ///< to be repeated; null: a preset was opened
};

/// The cloth to be built.
struct BuildOrder {
  Preset target;
  bool fresh = true;  ///< at its start; otherwise with the state of the present cloth, which must not change meanwhile
  bool restarts = false;                  ///< a restart asked for it
  std::optional<Document> document = {};  ///< of a preset that is opened
  bool programs = false;  ///< the present cloth is to have these constants, once programs have been built for them
};

struct BuiltCloth {
  std::unique_ptr<Simulation> simulation;  ///< null where programs alone were built
  std::string fallback;                    ///< why it runs on another engine than it asks for; empty: it does not
};

class BackgroundRebuild {
 public:
  /// Builds the programs that the preset's device needs, beside the frames. None: they are built when they are needed.
  /// `ledger`: those of steps that note what bodies stop.
  std::function<void(const Preset&, bool ledger)> prepare_programs;
  /// Called by the worker before it reads the present cloth: tests hold it there.
  std::function<void()> before_reading;

  bool busy() const { return making_.has_value(); }
  /// Whether the present cloth is being read, so that it may neither step nor change.
  bool holds_present() const { return making_ && !making_->fresh; }
  /// Frames that were drawn while something was being built.
  std::int64_t frames_beside() const { return frames_beside_; }
  /// The requested constants while their cloth is being built; null otherwise, and when a preset is opened.
  const Preset* requested_preset() const { return wish() != nullptr && !opens() ? &wish()->target : nullptr; }
  /// The lattice of the next cloth; none if it is the present one.
  std::optional<Lattice> lattice() const {
    return wish() != nullptr ? std::optional(lattice_of(wish()->target)) : std::nullopt;
  }
  /// Whether only programs are built for it.
  bool programs() const { return wish() != nullptr && wish()->programs; }
  /// Whether the request is a restart, or a preset to be opened.
  bool restarts() const { return wish() != nullptr && wish()->restarts; }
  bool opens() const { return wish() != nullptr && wish()->document.has_value(); }

  /// Builds that cloth and discards a running build. `before`: the history to restore if the build fails.
  void order(const Session& session, BuildOrder order, History before);
  /// Discards the request.
  void drop() { next_.reset(), dropped_ = busy(); }
  /// Keeps an edit for the cloth being built.
  void defer(Edit edit) {
    assert(holds_present());
    deferred_.push_back(std::move(edit));
  }
  /// Renames the cloth being built.
  void rename(const std::string& name, const std::string& description);
  /// Called in every frame: takes the cloth that is ready, if one is.
  void poll(Session& session);
  /// Whether the ledger can be kept from now on without waiting for a compiler. Otherwise its program is being built.
  bool ledger_ready(const Session& session);
  /// Frees a large cloth beside the frame, since that takes a while too.
  void dispose(std::shared_ptr<Simulation> simulation);

 private:
  const BuildOrder* wish() const { return next_ ? &*next_ : making_ && !dropped_ ? &*making_ : nullptr; }
  bool available(const BuildOrder& made) const;
  void start(const Session& session);
  void finish(Session& session, BuiltCloth made);
  void take(Session& session, BuiltCloth made, BuildOrder order);
  void continue_with_next(Session& session);
  void give_up(Session& session, const JobError& why);

  std::optional<BuildOrder> making_, next_;
  bool dropped_ = false;  ///< what is being made is not wanted
  std::vector<Edit> deferred_;
  History before_;
  std::int64_t frames_beside_ = 0;
  Job<BuiltCloth> work_;
  Job<std::monostate> disposal_, ledger_programs_;
};

/// Of the preset's cloth.
double particles(const Preset& preset);
/// Whether an OpenCL device must build programs before the present cloth can have these constants.
bool needs_programs(const Session& session, const Preset& preset);
/// Whether the cloth of a preset is built in the background because it takes long.
bool takes_long(const Session& session, const Preset& preset);
/// Takes a simulation in place of the present one.
void swap_in(Session& session, std::shared_ptr<Simulation> simulation);

}  // namespace tyglab
