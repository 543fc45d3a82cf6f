// An engine owns the arrays of the particles and steps them. Simulation handles time, edits, tears and files, and
// VertexSharing brings the arrays of a device to OpenGL.
//
// If memory runs out (std::bad_alloc), every function of the CPU engine leaves the engine unchanged, and advance()
// leaves it at the last complete step. After an EngineError, for example a lost device, an engine can only be
// destroyed.
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/cloth/state.h"
#include "core/integrators/scheme.h"
#include "core/integrators/step_control.h"
#include "core/model/preset.h"

namespace tyglab {

class VertexSharing;

/// A particle moved by the hand: a = 0, v is the velocity of the hand.
struct Held {
  int particle = -1;  ///< i·columns + j; -1: none
  glm::dvec3 velocity{0, 0, 0};
};

/// A pinned particle that moves.
struct DrivenPin {
  int particle;  ///< i·columns + j
  glm::dvec3 x;  ///< m
  glm::dvec3 v;  ///< m/s
};

/// Why a run ended.
struct Divergence {
  double t = 0;           ///< end of the step that diverged, s
  std::int64_t step = 0;  ///< number of that step, from 1
  int i = 0, j = 0;       ///< the particle, or the upper or left end of the spring
  int di = 0, dj = 0;     ///< from there to the other end; 0, 0: not a spring
  std::string quantity;   ///< "position", "velocity", "spring length"
  double value = 0;       ///< of that quantity; may be non-finite
  std::string cause;      ///< a sentence
  std::string advice;     ///< a sentence
  /// "particle (3, 4)" or "spring (3, 4)–(4, 5)".
  std::string where() const;
  /// "diverged at t = 0.01 s (step 12), particle (3, 4): …", with cause and advice.
  std::string in_words() const;
};

/// The result of Engine::advance().
struct AdvanceResult {
  int steps = 0;          ///< completed
  bool diverged = false;  ///< the next step diverged; the state is the one before it
  int i = 0, j = 0;       ///< where, if it diverged
  int di = 0, dj = 0;     ///< to the other end, if a spring diverged
  std::string quantity;
  double value = 0;
  double excess = 0;               ///< energy of the motion over all that the scene can hold; 0: not what is wrong
  int torn = 0;                    ///< stretch springs that broke
  int left_inside = 0;             ///< free particles inside a body after the last step (overlapping bodies)
  bool released = false;           ///< the hand's force exceeded F_release
  bool overloaded = false;         ///< after the last step springs part the cloth (openings_of_overload)
  bool stopped = false;            ///< Engine::stop_when() asked for it; the state is that of the last whole step
  glm::dvec3 hand_force{0, 0, 0};  ///< on the held particle in the last step, N; the method itself takes it as 0
};

/// A particle that a body stopped: how much farther the step would have moved it, m, and how much its velocity would
/// differ, m/s.
struct Contact {
  int particle;  ///< i·columns + j
  glm::dvec3 x, v;
};

/// Read-only view of an engine's own positions: particle (i, j) is at index i·stride + j of each component's pointer.
/// Either f or d is set, by precision. Each row holds its x, then its y, then its z, stride/3 values each (RowField).
struct PositionView {
  int rows = 0, columns = 0, stride = 0;
  const float* f[3] = {nullptr, nullptr, nullptr};
  const double* d[3] = {nullptr, nullptr, nullptr};
  int absent = 0;  ///< places at the end, in rows for copies (mesh.h), where there is no particle
  glm::dvec3 at(int i, int j) const {
    assert(i >= 0 && i < rows && j >= 0 && j < columns);
    assert((f[0] == nullptr) != (d[0] == nullptr));
    const std::size_t p = std::size_t(i) * stride + j;
    return f[0] ? glm::dvec3(f[0][p], f[1][p], f[2][p]) : glm::dvec3(d[0][p], d[1][p], d[2][p]);
  }
};

/// A particle as its method stores it, m and m/s.
struct StoredParticle {
  glm::dvec3 x{0}, v{0};
  glm::dvec3 v_seen{0};  ///< velocity that damping uses at the start of a step
  double lag = 0;        ///< s; v + lag · a is the velocity at the time of x; 0: v itself is (Engine::synchronize)
};

/// Part of a step that only some scenes need.
struct StepFeature {
  std::string_view name;
  bool on;
};

/// The state of a motion between two steps, as the engine stores it: exact, without rounding and without the start of a
/// method.
class HeldMotion {
 public:
  HeldMotion() = default;
  HeldMotion(const HeldMotion&) = delete;
  HeldMotion& operator=(const HeldMotion&) = delete;
  virtual ~HeldMotion() = default;
  virtual std::size_t bytes() const = 0;
};

class Engine {
 public:
  virtual ~Engine() = default;

  /// Replaces the state by positions and (full-step) velocities, from which the method starts with the next step.
  virtual void load(const StateRows& rows, const Tears& tears) = 0;
  void load(const State& state, const Tears& tears) {
    const PositionView view = positions();
    assert(state.x.x.size() == std::size_t(view.rows) * std::size_t(view.columns));
    load(rows_of(state, view.columns), tears);
  }
  /// Where the method keeps velocities of another time, such as half a step ago, replaces them by those of the present,
  /// from which it starts again with the next step. Every edit that changes accelerations needs this first, with the
  /// tears before the edit: otherwise the edit would act on the last half step too, and kick the particles. Does
  /// nothing for a state that has just been loaded or synchronized.
  virtual void synchronize(const Tears& tears) = 0;
  /// Changes constants, dt and bodies; synchronizes where that changes accelerations. The lattice, the precision and
  /// the method must be the same as before.
  virtual void set_preset(const Preset& preset, const Tears& tears) = 0;
  /// Whether set_preset() would be quick. Otherwise it builds a program for the preset, which takes seconds unless an
  /// earlier one was kept.
  virtual bool ready_for(const Preset&) const { return true; }
  /// The same for note_contacts(true).
  virtual bool ready_for_contacts() const { return true; }
  /// Fixes these particles from now on, after synchronize() if others are to be fixed.
  virtual void set_fixed(std::span<const int> pinned, Held held) = 0;
  /// These pinned particles have these velocities from now on, until set_fixed(); others rest. With `place` they are at
  /// these positions too.
  virtual void drive_pins(std::span<const DrivenPin> pins, bool place) = 0;
  /// Allocates the memory that set_fixed() with as many particles, synchronize() and load() need, so that they cannot
  /// fail as parts of a larger change.
  virtual void prepare([[maybe_unused]] std::size_t fixed) {}
  /// Makes up to `steps` steps; stops early on divergence, when the hand releases, when stop_when() requests it, and
  /// when memory runs out after some steps (std::bad_alloc if not even one was made). Updates `tears` as springs break.
  virtual AdvanceResult advance(int steps, Tears& tears) = 0;
  /// A step by its number since a time, s: it begins at since + number · dt.
  struct StepNumber {
    double since = 0;
    std::int64_t number = 0;
  };
  /// Which step comes next: where bodies that move are depends on it. Before load() and advance().
  void next_step(const StepNumber& step) { step_ = step; }
  /// Whether steps record what bodies stop, which only the energy ledger needs.
  virtual void note_contacts(bool on) = 0;
  /// What bodies stopped in the last dt, in each inner step if the method makes several; requires note_contacts(true).
  virtual std::vector<Contact> contacts() const = 0;
  /// Positions, and velocities at the same time (v + dt/2 a for Verlet).
  virtual void read(State& state, const Tears& tears) = 0;
  /// The state as files store it: as read(), but for Verlet with the backward velocity d/dt.
  virtual void read_raw(State& state, const Tears& tears) = 0;
  /// The present motion, for go_on_from(); null: this engine can only be given positions and velocities.
  virtual std::shared_ptr<const HeldMotion> held_motion() const { return nullptr; }
  /// Continues a stored motion after load() with its state and constants: the following steps equal the original ones
  /// to the last bit. Does nothing if another kind of engine stored the motion.
  virtual void go_on_from([[maybe_unused]] const HeldMotion& then) {}
  virtual PositionView positions() const = 0;
  /// The interface that brings its positions to OpenGL without a copy; null if its arrays are not on a device.
  virtual VertexSharing* vertex_sharing() { return nullptr; }
  const VertexSharing* vertex_sharing() const { return const_cast<Engine*>(this)->vertex_sharing(); }
  /// One particle as the method stores it. Reads nothing but the particles' own arrays, so another thread may read at
  /// the same time.
  virtual StoredParticle stored(int i, int j) const = 0;
  /// Position of one particle: as positions(), but from a device only its surroundings are read.
  virtual glm::dvec3 position(int i, int j) const { return positions().at(i, j); }
  /// Size of all arrays that grow with the cloth, in bytes.
  virtual std::size_t bytes() const = 0;
  /// Maximum number of threads that it uses.
  virtual int threads() const = 0;
  /// Number of threads that it uses at present; threads that do not pay are released.
  virtual int threads_at_work() const { return threads(); }
  virtual SolveCounts solves() const = 0;
  /// Upper bound of Σ |v|² + 2 E/m over all particles and springs, from everything that has given energy to the motion
  /// (MotionLimit), m²/s²; infinity if it is unknown.
  virtual double given_squared() const { return std::numeric_limits<double>::infinity(); }
  /// Particles whose way the guard of contact with itself has cut short, summed over steps.
  virtual std::int64_t held_back() const { return 0; }
  /// Work of a method that chooses its own steps within dt; all zero for others.
  virtual InnerSteps inner_steps() const = 0;
  /// What another engine counted before it was replaced by this one.
  virtual void continue_counts([[maybe_unused]] const InnerSteps& counts) {}
  /// The parts of a step that the present scene needs, and those that are skipped.
  virtual std::vector<StepFeature> features() const = 0;
  /// For display, such as "CPU, AVX2, 2 threads".
  virtual std::string name() const = 0;

  /// From now on advance() ends as soon as this function returns true: between two steps, and also within a step if the
  /// method solves, iterates or chooses its own steps. An unfinished step is undone.
  virtual void stop_when(Stop stop) { stop_ = std::move(stop); }
  /// Limits the real time of a step, s, for methods that can end early (scheme.h); 0: no limit. At the limit a step
  /// keeps its current result. Such a step counts as SolveCounts::ended_early, depends on the machine, and is made only
  /// once, since repeating it would not give identical bits. The work before and after the solve, and the first
  /// iteration or pass, always complete: SolveCounts::longest_limited is the longest time. Only the CPU engine supports
  /// this; others always solve completely.
  void limit_steps(double seconds) {
    assert(seconds >= 0);
    step_limit_ = seconds;
  }
  double step_limit() const { return step_limit_; }
  /// Progress of the present step, 0 to 1, as the method estimates it; 0 for a method whose steps all cost the same.
  /// Any thread may call this.
  virtual double step_progress() const { return step_progress_; }

 protected:
  const Stop& stop() const { return stop_; }
  bool stops() const { return stop_ && stop_(); }
  void set_step_progress(double part) {
    assert(!(part < 0) && !(part > 1 + 1e-9));
    step_progress_ = part;
  }
  /// Begins a step with a time limit.
  void begin_limit() { step_begun_ = std::chrono::steady_clock::now(); }
  /// Real time since then, s.
  double step_seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - step_begun_).count();
  }
  /// Whether this fraction of its time has passed.
  bool out_of_time(double part) const {
    assert(part >= 0 && part <= 1 + 1e-9);
    return step_limit_ > 0 && step_seconds() >= part * step_limit_;
  }

 protected:
  const StepNumber& step() const { return step_; }
  /// When the step after `steps` further ones of dt begins, s.
  double time_after(int steps, double dt) const { return step_.since + double(step_.number + steps) * dt; }
  void count_steps(int steps) { step_.number += steps; }
  /// To a backup's.
  void return_to(const StepNumber& step) { step_ = step; }

 private:
  StepNumber step_;
  Stop stop_;
  double step_limit_ = 0;  ///< s
  std::chrono::steady_clock::time_point step_begun_;
  std::atomic<double> step_progress_ = 0;
};

/// Why the engine that the preset names does not compute it on any machine, and how to go on, a sentence without its
/// end; empty if it does.
std::string engine_problem(const Preset& preset);
/// Creates the engine that the preset names, with at most `threads` threads: fewer if the cloth is too small for them
/// to pay off, with results that are the same to the last bit. Throws EngineError if there is no such engine.
std::unique_ptr<Engine> make_engine(const Preset& preset, const Lattice& lattice, int threads);

class EngineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Memory for positions that the drawing code lends to an engine, so the engine writes them where they are drawn.

/// Slots of one size, each for the positions of a whole cloth, in the program's own memory. An engine keeps its
/// positions in any of them and moves from one to another as it steps, but never writes the slot that is being drawn.
/// So it never waits for the drawing, and nothing is drawn while it is written.
struct PositionMemory {
  static constexpr int count = 3;            ///< one is drawn, one is read, one is written
  static constexpr std::size_t page = 4096;  ///< slots begin at multiples of it, bytes
  std::array<void*, count> slots{};          ///< filled with zeros
  std::size_t bytes = 0;                     ///< of each
  std::atomic<int> shown = -1;  ///< the slot that is being drawn; -1: none. Steps may go on beside the drawing
  PositionMemory() = default;
  PositionMemory(const PositionMemory&) = delete;
  PositionMemory& operator=(const PositionMemory&) = delete;
  virtual ~PositionMemory() = default;
};

}  // namespace tyglab
