// One cloth (or a mass on a spring) in motion. It connects presets, engines and edits, without a window or a clock.
#pragma once

#include <cassert>
#include <memory>
#include <mutex>
#include <optional>

#include "core/cloth/start.h"
#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/edit.h"
#include "core/energy/energy_watch.h"
#include "core/engines/engine.h"
#include "core/forces/gust.h"
#include "core/forces/readout.h"
#include "core/model/effect.h"
#include "core/model/preset.h"

namespace tyglab {

/// Everything table B.1 says of one particle, N, m, m/s, m/s².
struct ParticleReadout {
  glm::dvec3 F{0}, F_s{0}, F_b{0}, F_d{0}, F_g{0}, F_wind{0}, F_int{0}, F_ext{0};
  glm::dvec3 x{0}, v{0}, a{0};
  bool pinned = false, held = false;
  bool on_body = false;  ///< a body tolerates on it, which neither F nor a contains
};

/// One number for the whole cloth a frame: what the plots' "sum" and "maximum" show. Magnitudes, N.
struct ForceSummary {
  double F_s = 0, F_b = 0, F_d = 0, F_g = 0, F_wind = 0, F_int = 0, F_ext = 0, F = 0;
};
enum class Reduction { sum, maximum };

/// The cloth as it was at a moment: what it takes to go back there. With the constants and the engine of that moment
/// the same motion follows, to the last bit; with others the method starts again from positions and velocities.
struct Snapshot {
  Lattice lattice;
  Kind kind = Kind::cloth;
  State state;
  Tears tears;
  double t = 0;  ///< s
  std::int64_t steps = 0;
  std::optional<glm::dvec3> begun_with{};    ///< m/s, of every free particle, while no step has been made
  Preset of{};                               ///< with which constants it moved: with these the same motion follows
  std::shared_ptr<const HeldMotion> held{};  ///< as its engine had it; null: it goes on from `state`
  std::int64_t steps_at_dt = 0;              ///< step at which the dt of that moment was set
  double time_at_dt = 0;                     ///< and the time then, s
  std::size_t bytes() const { return state.x.bytes() + state.v.bytes() + tears.bytes() + (held ? held->bytes() : 0); }
  /// At least that much will it be.
  static std::size_t bytes(const Lattice& lattice) { return 2 * sizeof(glm::dvec3) * lattice.size(); }
};

class Simulation {
 public:
  /// Builds the cloth at its start; `threads`: at most that many, at least 1. Throws EngineError; the preset must be
  /// valid (check_preset), but for dt: any above 0 will do.
  explicit Simulation(const Preset& preset, int threads = 1);
  ~Simulation();

  const Preset& preset() const { return preset_; }
  const Lattice& lattice() const { return lattice_; }
  const Tears& tears() const { return tears_; }
  double time() const;
  /// The wind that blows now, N: W, or W in its gusts (gust.h).
  glm::dvec3 wind() const { return acting().W; }
  std::int64_t steps() const { return steps_; }
  const std::optional<Divergence>& divergence() const { return divergence_; }
  /// The constants with which it diverged; available only while divergence() holds one.
  const Preset& diverged_preset() const {
    assert(divergence_);
    return diverged_preset_;
  }
  Engine& engine() { return *engine_; }
  /// Goes on with what is made of the present engine: tests see one fail in this way.
  void wrap_engine(const std::function<std::unique_ptr<Engine>(std::unique_ptr<Engine>)>& wrap) {
    engine_ = wrap(std::move(engine_));
  }
  const Engine& engine() const { return *engine_; }
  PositionView positions() const { return engine_->positions(); }
  /// Of one particle.
  glm::dvec3 position(int i, int j) const { return engine_->position(i, j); }

  bool pinned(int i, int j) const {
    assert(lattice_.contains(i, j));
    return pinned_mask_[std::size_t(i) * lattice_.columns + j] != 0;
  }
  std::optional<Pins::Site> held() const;
  glm::dvec3 hand_force() const { return hand_force_; }
  /// Free particles that overlapping bodies left inside one of them in the last step.
  int left_inside() const { return left_inside_; }

  /// Whether an edit asks for new arrays: of a large cloth that takes longer than a frame.
  bool rebuilds(const Edit& edit) const;
  /// A simulation as that edit (a Change or a Restart) would leave this one, which stays as it is. May run beside
  /// other threads that only look at this one: positions(), read(), particle() and whatever else is const. Throws as
  /// apply().
  std::unique_ptr<Simulation> rebuilt(const Edit& edit) const;
  /// What this one shows now, with an engine that stands still: to be looked at while another thread moves this one.
  /// Changes of what is only seen may be applied to it, nothing else.
  std::unique_ptr<Simulation> stand_in() const;
  /// Applies an edit. Throws PresetError, EngineError or std::bad_alloc and leaves everything as it was if it cannot be
  /// done; but an engine whose device is lost.
  void apply(const Edit& edit);
  /// Makes up to `steps` steps; fewer when the run diverges or is stopped. Does nothing once diverged. Throws
  /// EngineError; std::bad_alloc, with the last whole step then being the present state, so that it can be called
  /// again.
  AdvanceResult advance(int steps);
  /// From now on advance() ends with the last whole step as soon as this says so (Engine::stop_when).
  void stop_when(Stop stop);
  /// From now on a step of a method that can end early does so with what it has found once it has taken so long, s; 0:
  /// no limit (Engine::limit_steps). Motions are then not the same from run to run.
  void limit_steps(double seconds);
  double step_limit() const { return step_limit_; }

  EnergyReading energy();
  /// The energy of the motion and of the springs, over the most that start, springs, weight, wind, hand and bodies can
  /// have given them (docs/model.md, "How fast and how far"). Above 1 no motion of the model goes: the method's errors
  /// have added the rest. 0 where it is not known.
  double excess();
  /// Keeps the energy ledger from now on, or no longer. Every step is then looked at, which costs some times the step
  /// itself and changes nothing about it, nor when the run diverges.
  void enable_ledger(bool on);
  /// What the ledger says; none where none is kept.
  std::optional<LedgerReading> ledger() const;

  Snapshot snapshot();
  /// Whether the cloth still has the particles that the snapshot holds.
  bool fits(const Snapshot& then) const { return then.lattice == lattice_ && then.kind == preset_.kind; }
  /// Goes back to a snapshot that fits, with the present constants and pins; the hand lets go, a divergence is
  /// forgotten.
  void restore(const Snapshot& then);

  /// Puts positions and full-step velocities in place of the present ones; time, tears and constants stay.
  void load(const State& state);

  /// Of what it keeps for every particle beside the engine: masks, and the state once it has been read.
  std::size_t bytes() const;

  /// Full-step positions and velocities, dense.
  const State& read();
  /// As the method holds them: what a state file shows.
  State read_raw();
  ParticleReadout particle(int i, int j) const;
  ForceSummary forces(Reduction reduction);
  /// Counts up whenever positions, tears or bodies changed: views compare it to know whether to upload.
  std::uint64_t revision() const { return revision_; }
  std::uint64_t tear_revision() const { return tear_revision_; }

 private:
  /// A copy of all but the engine and what is read of it.
  Simulation(const Simulation& from);
  Simulation& operator=(Simulation&& from) noexcept = default;
  void build(const Preset& next);
  void take(Simulation& other) noexcept;
  /// Particles that do not move freely.
  struct Fixed {
    std::vector<int> pinned;
    Held held;
  };
  std::unique_ptr<Engine> made_engine(const Preset& next, const Lattice& lattice, const Fixed& fixed,
                                      const StateRows& rows, const Tears& tears, double t) const;
  /// The constants that act in this moment: the preset's, with the wind as it blows.
  const Preset& acting() const { return gusts(preset_) ? effective_preset_ : preset_; }
  void take_constants(const Preset& next);
  int update_gust();
  bool restarts(EffectSet changed) const;
  void take_engine(const Preset& next, const State& state);
  void take_pins();
  bool fixed(int i, int j) const { return pinned(i, j) || held_.particle == i * lattice_.columns + j; }
  glm::dvec3 velocity_at(const Neighborhood& near, const StoredParticle& stored, int i, int j) const;
  void change(const Preset& preset);
  void restart_untouched(const Preset& preset);
  void grab(const edit::Grab& edit);
  void move_hand(const edit::MoveHand& edit);
  void release();
  void cut(const edit::Cut& edit);
  void cut_springs(const edit::CutSprings& edit);
  void pin(const edit::Pin& edit);
  void move_body(const edit::MoveBody& edit);
  void rebase_time();
  void hold(const Held& held);
  void diverge(const AdvanceResult& part);
  AdvanceResult advance_part(int steps);
  void watch_step();
  void watch_edit(Ledger::Source source);

  Preset preset_;
  Preset effective_preset_;  ///< the same with the wind of this moment, which the engine has; valid only while there
                             ///< are gusts
  int threads_;
  Stop stop_;
  double step_limit_ = 0;  ///< s
  Lattice lattice_;
  Tears tears_;
  std::unique_ptr<Engine> engine_;
  std::vector<std::uint8_t> pinned_mask_;
  std::vector<int> pinned_;
  Held held_;
  int hand_steps_left_ = 0;
  glm::dvec3 hand_force_{0};
  int left_inside_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t steps_at_dt_ = 0;  ///< step at which the present dt was set
  double time_at_dt_ = 0;         ///< and the time then
  /// The velocity of every free particle, while no step has been made since the start. What a method holds then need
  /// not give it back: Verlet's start sees damping by v_0, its read-out by the velocity of half a step ago.
  std::optional<glm::dvec3> initial_velocity_;
  std::optional<Divergence> divergence_;
  Preset diverged_preset_;
  State state_;
  /// An engine evaluates forces to be read, and has one place for them.
  std::unique_ptr<std::mutex> reading_ = std::make_unique<std::mutex>();
  std::uint64_t state_revision_ = ~0ull;
  std::uint64_t revision_ = 0, tear_revision_ = 0;
  std::optional<EnergyWatch> watch_;
};

}  // namespace tyglab
