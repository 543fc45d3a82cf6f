// One cloth (or a mass on a spring) in motion. It connects presets, engines and edits, without a window or a clock.
#pragma once

#include <cassert>
#include <memory>
#include <mutex>
#include <optional>

#include "core/cloth/state.h"
#include "core/edit.h"
#include "core/energy/ledger.h"
#include "core/engines/engine.h"
#include "core/forces/contact.h"
#include "core/forces/parted.h"
#include "core/forces/readout.h"
#include "core/model/effect.h"
#include "core/model/preset.h"
#include "core/moving_pins.h"
#include "core/recording.h"

namespace tyglab {

/// The variables of table B.1 for one particle, in N, m, m/s, m/s².
struct ParticleReadout {
  ForcesByKey<glm::dvec3> forces;  ///< F and F_ext contain the force of the hand
  glm::dvec3 x{0}, v{0}, a{0};
  bool pinned = false, held = false;
  bool on_body = false;  ///< a body pushes it, a force that neither F nor a contains
  /// By its key in the notation table: a force, "x", "v" or "a".
  const glm::dvec3& operator[](std::string_view key) const {
    return key == "x" ? x : key == "v" ? v : key == "a" ? a : forces[key];
  }
};

/// Forces of the whole cloth for the plots' "sum" and "maximum": magnitudes.
using ForceSummary = ForcesByKey<double>;
enum class Reduction { sum, maximum };

/// A past moment of the cloth, complete enough to return to it. With the constants and the engine of that moment the
/// motion repeats to the last bit; with others the method starts again from positions and velocities.
struct Snapshot {
  Lattice lattice;
  Kind kind = Kind::cloth;
  State state;
  Tears tears;
  double t = 0;  ///< s
  std::int64_t steps = 0;
  bool untouched = false;                    ///< nothing has moved or replaced the state since the cloth was built
  Preset of{};                               ///< the constants of that moment, with which the motion repeats
  std::shared_ptr<const HeldMotion> held{};  ///< the engine's own state; null: the motion continues from `state`
  std::int64_t steps_at_dt = 0;              ///< step at which the dt of that moment was set
  double time_at_dt = 0;                     ///< and the time then, s
  glm::dvec3 W{0};                           ///< the wind of the last step, N: that of the next begins with a new gust
  glm::dvec3 u{0};                           ///< likewise, m/s
  MovingPins moving_pins{};
  Recording past;      ///< what led there
  bool alone = false;  ///< no hand held the cloth, and no body was pushed
  std::size_t bytes() const {
    return state.x.bytes() + state.v.bytes() + tears.bytes() + (held ? held->bytes() : 0) + moving_pins.bytes();
  }
  /// A lower bound of bytes() for a lattice.
  static std::size_t bytes(const Lattice& lattice) { return 2 * sizeof(glm::dvec3) * lattice.size(); }
};

class Simulation {
 public:
  /// Builds the cloth at its start, with at most `threads` threads (at least 1). Throws EngineError. The preset must be
  /// valid (check_preset), except that dt may be any number above 0.
  explicit Simulation(const Preset& preset, int threads = 1);
  ~Simulation();

  const Preset& preset() const { return preset_; }
  /// Where the cloth has parted, with rows for copies (mesh.h).
  const Lattice& lattice() const { return lattice_; }
  const Tears& tears() const { return tears_; }
  double time() const;
  /// The present wind, N: W, including gusts (contact.h).
  glm::dvec3 wind() const { return acting().W; }
  std::int64_t steps() const { return steps_; }
  const std::optional<Divergence>& divergence() const { return divergence_; }
  /// The constants at the divergence; available only while divergence() has a value.
  const Preset& diverged_preset() const {
    assert(divergence_);
    return diverged_preset_;
  }
  Engine& engine() { return *engine_; }
  /// Replaces the engine by a wrapper around it; tests use this to make engines fail.
  void wrap_engine(const std::function<std::unique_ptr<Engine>(std::unique_ptr<Engine>)>& wrap) {
    engine_ = wrap(std::move(engine_));
  }
  const Engine& engine() const { return *engine_; }
  PositionView positions() const {
    PositionView view = engine_->positions();
    view.absent = lattice_.size() - tears_.particles();
    return view;
  }
  /// Position of one particle.
  glm::dvec3 position(int i, int j) const { return engine_->position(i, j); }

  /// Whether there is a particle (i, j), of a site or a copy.
  bool has(int i, int j) const { return lattice_.contains(i, j) && i * lattice_.columns + j < tears_.particles(); }
  bool pinned(int i, int j) const {
    assert(has(i, j));
    return pinned_mask_[std::size_t(i) * lattice_.columns + j] != 0;
  }
  std::optional<Pins::Site> held() const;
  glm::dvec3 hand_force() const { return hand_force_; }
  /// Free particles that overlapping bodies left inside one of them in the last step.
  int left_inside() const { return left_inside_; }

  /// Whether an edit requires new arrays, which for a large cloth takes longer than a frame.
  bool rebuilds(const Edit& edit) const;
  /// A new simulation with the result of an edit (a Change or a Restart); this one does not change. Other threads may
  /// read this simulation meanwhile: positions(), read(), particle() and all const functions. Throws the exceptions of
  /// apply().
  std::unique_ptr<Simulation> rebuilt(const Edit& edit) const;
  /// A copy of the present moment with an engine that stands still, for reading while another thread moves this one.
  /// Only edits of its appearance may be applied to it.
  std::unique_ptr<Simulation> stand_in() const;
  /// Applies an edit. If that is impossible, throws PresetError, EngineError or std::bad_alloc and changes nothing,
  /// unless the engine's device is lost.
  void apply(const Edit& edit);
  /// Makes up to `steps` steps; fewer if the run diverges or is stopped. Does nothing after a divergence. Throws
  /// EngineError; also std::bad_alloc, which leaves the state after the last complete step, so it can be called
  /// again.
  AdvanceResult advance(int steps);
  /// From now on advance() ends with the last complete step as soon as `stop` returns true (Engine::stop_when).
  void stop_when(Stop stop);
  /// Limits the real time of a step, s, for methods that can end early; 0: no limit (Engine::limit_steps). The motion
  /// then differs from run to run.
  void limit_steps(double seconds);
  double step_limit() const { return step_limit_; }

  EnergyReading energy();
  /// The kinetic and elastic energy, divided by the most that start, springs, weight, wind, hand and bodies can have
  /// supplied (docs/model.md, "How fast and how far"). No exact motion exceeds 1: errors of the method have added the
  /// rest. 0 if it is unknown.
  double excess();
  /// Turns the energy ledger on or off. With it every step is examined, which costs several times as much as the step
  /// itself, but changes neither the motion nor the time of a divergence.
  void enable_ledger(bool on);
  /// The ledger, if it is on.
  std::optional<LedgerReading> ledger() const;

  Snapshot snapshot();
  /// Whether the cloth still has the lattice of the snapshot, and tears by the rule of its tears.
  bool fits(const Snapshot& then) const {
    const bool same_rule = then.tears.untorn() || parts(then.of) == parts(preset_);
    return then.lattice.sites() == lattice_.sites() && then.kind == preset_.kind && same_rule;
  }
  /// Returns to a snapshot that fits, with the present constants and pins. The hand releases, and a divergence is
  /// cleared.
  void restore(const Snapshot& then);
  /// The same with the constants of that moment: all is again as it was then, its recording included. The snapshot has
  /// what its method held, and was `alone`.
  void return_to(const Snapshot& then);

  /// Puts positions and full-step velocities in place of the present ones; time, tears and constants stay.
  void load(const State& state);

  /// What has happened since the first preset, restarts included.
  const Recording& past() const { return past_; }
  /// What has happened equals this beginning of a recording that is being repeated, and is that from now on.
  void share_recording(Recording beginning) {
    if (step_limit_ > 0) beginning.give_up_repeating();
    past_ = std::move(beginning);
  }
  /// Adds a user's word to it.
  void mark(std::string words) { past_.add(event::Mark{std::move(words)}); }
  /// Continues the recording of the cloth that this one, built from its constants, replaces: as if they had been
  /// changed there, and the cloth restarted.
  void continue_recording(const Simulation& replaced);
  /// Whether the recording has checks of the positions, each as long as reading them all takes, so that a repetition
  /// can be compared.
  void keep_hashes(bool on) { keeps_hashes_ = on; }
  bool keeps_hashes() const { return keeps_hashes_; }
  /// Of the bits of all positions.
  std::uint64_t hash() const;
  /// Where the sites at the corners, in the middles of the edges and in the middle are.
  event::Look look() const;

  /// Size of the arrays outside the engine: masks, and the state once it has been read.
  std::size_t bytes() const;

  /// Full-step positions and velocities, dense.
  const State& read();
  /// Positions and velocities as the method stores them, for state files.
  State read_raw();
  ParticleReadout particle(int i, int j) const;
  ForceSummary forces(Reduction reduction);
  /// The bodies as they are now, at rest.
  std::vector<Body> bodies() const;
  /// The preset with those.
  Preset posed() const;
  /// Increases whenever positions, tears or bodies change; views compare it to know whether to upload.
  std::uint64_t revision() const { return revision_; }
  std::uint64_t tear_revision() const { return tear_revision_; }

 private:
  /// Copies everything except the engine and the state read from it.
  Simulation(const Simulation& from);
  Simulation& operator=(Simulation&& from) noexcept = default;
  void build(const Preset& next);
  Recording past_with(const Edit& edit) const;
  void take(Simulation& other) noexcept;
  /// Particles that do not move freely.
  struct Fixed {
    std::vector<int> pinned;
    Held held;
  };
  std::unique_ptr<Engine> bare_engine(const Preset& acts, const Lattice& lattice) const;
  std::unique_ptr<Engine> made_engine(const Preset& acts, const Fixed& fixed, const StateRows& rows, const Tears& tears,
                                      double t) const;
  /// The present constants: those of the preset, with the present wind.
  const Preset& acting() const { return gusts(preset_) || pushed_until_ ? effective_preset_ : preset_; }
  int update_gust();
  bool restarts(EffectSet changed) const;
  void check_tears(const Preset& next) const;
  void take_engine(const Preset& next, const State& state);
  void take_pins();
  glm::dvec3 velocity_at(const Neighborhood& near, const StoredParticle& stored, int i, int j) const;
  void change(const Preset& preset);
  void restart_untouched(const Preset& preset);
  void grab(const edit::Grab& edit);
  void move_hand(const edit::MoveHand& edit);
  void release();
  void cut(const edit::Cut& edit);
  void cut_springs(const edit::CutSprings& edit);
  void part(const std::vector<Opening>& openings);
  int part_overloaded();
  void pin(const edit::Pin& edit);
  void move_body(const edit::MoveBody& edit);
  void end_push();
  void rebase_time();
  void hold(const Held& held);
  void fix(std::span<const int> pinned, const Held& held, bool others = false);
  MovingPins moving_pins(const Preset& preset, std::span<const int> pinned) const;
  int drive_pins();
  void diverge(const AdvanceResult& part);
  AdvanceResult advance_part(int steps);
  AdvanceResult step_to_impacts();
  double time_of_impact(const State& before, const Tears& tears, double t, int particle, int body, double first,
                        State& after);
  /// A step of the engine, with these constants, has been made.
  void watch_step(const Preset& made);
  void watch_edit(Ledger::Source source);

  Preset preset_;
  Preset effective_preset_;  ///< the engine's constants: the preset with the present wind, and a body on its way; valid
                             ///< only while there are gusts or one is
  std::optional<std::int64_t> pushed_until_;  ///< number of the step that ends that way
  int threads_;
  Stop stop_;
  double step_limit_ = 0;  ///< s
  Lattice lattice_;
  Tears tears_;
  std::unique_ptr<Engine> engine_;
  std::vector<std::uint8_t> pinned_mask_;
  std::vector<int> pinned_;
  MovingPins moving_pins_;
  std::vector<DrivenPin> driven_;  ///< those that the engine knows of
  Held held_;
  int hand_steps_left_ = 0;
  glm::dvec3 hand_force_{0};
  int left_inside_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t steps_at_dt_ = 0;  ///< step at which the present dt was set
  double time_at_dt_ = 0;         ///< and the time then
  bool untouched_ = true;         ///< no step has been made, and no state loaded, since the cloth was built
  std::optional<Divergence> divergence_;
  Preset diverged_preset_;
  State state_;
  /// An engine evaluates forces to be read, and has one place for them.
  std::unique_ptr<std::mutex> reading_ = std::make_unique<std::mutex>();
  std::uint64_t state_revision_ = ~0ull;
  std::uint64_t revision_ = 0, tear_revision_ = 0;
  std::optional<EnergyWatch> watch_;
  Recording past_;
  bool keeps_hashes_ = false;
};

}  // namespace tyglab
