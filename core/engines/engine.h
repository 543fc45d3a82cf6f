// Where a simulation runs. An engine owns the particles' arrays and steps them; everything else (time, edits, tears'
// bookkeeping, files) is Simulation's.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/engines/gl_vertices.h"
#include "core/engines/position_memory.h"
#include "core/integrators/step_control.h"
#include "core/model/preset.h"

namespace tyglab {

/// A particle moved by the hand: a = 0, v = the hand's velocity.
struct Held {
  int particle = -1;  ///< i·columns + j; -1: nothing is held
  glm::dvec3 velocity{0, 0, 0};
};

/// Why a run ended.
struct Divergence {
  double t = 0;           ///< s, end of the step that diverged
  std::int64_t step = 0;  ///< number of that step, the first is 1
  int i = 0, j = 0;       ///< particle (upper or left end of the spring)
  int di = 0, dj = 0;     ///< to the spring's other end; 0, 0: no spring
  std::string quantity;   ///< "position", "velocity", "spring length"
  double value = 0;       ///< its value; may be non-finite
  std::string cause;      ///< a sentence
  std::string advice;     ///< a sentence
  /// "particle (3, 4)" or "spring (3, 4)–(4, 5)".
  std::string where() const;
};

/// What one call of Engine::advance did.
struct Advance {
  int steps = 0;          ///< steps completed
  bool diverged = false;  ///< the next step diverged; the state is the one before it
  int i = 0, j = 0;       ///< where, if diverged
  int di = 0, dj = 0;     ///< to the other end, if it was a spring
  std::string quantity;
  double value = 0;
  int torn = 0;                    ///< stretch springs broken
  int left_inside = 0;             ///< free particles still inside a body after the last step (overlapping bodies)
  bool released = false;           ///< the hand's force exceeded F_release
  glm::dvec3 hand_force{0, 0, 0};  ///< force on the held particle at the last step, N, before it was set to 0
};

/// A particle that a body stopped: by how much the step would have taken it further, m, and how much faster it would
/// be, m/s.
struct Contact {
  int particle;  ///< i·columns + j
  glm::dvec3 x, v;
};

/// Read-only view of the engine's own positions: particle (i, j) at index i·stride + j of each component's pointer. One
/// of f or d is set. Rows lie one after the other, each as its x, its y and its z of stride/3 values (RowField).
struct PositionView {
  int rows = 0, columns = 0, stride = 0;
  const float* f[3] = {nullptr, nullptr, nullptr};
  const double* d[3] = {nullptr, nullptr, nullptr};
  glm::dvec3 at(int i, int j) const {
    const std::size_t p = std::size_t(i) * stride + j;
    return f[0] ? glm::dvec3(f[0][p], f[1][p], f[2][p]) : glm::dvec3(d[0][p], d[1][p], d[2][p]);
  }
};

/// What implicit methods have done since the engine was made.
struct SolveCounts {
  std::int64_t newton = 0;  ///< steps of Newton's method
  std::int64_t linear = 0;  ///< steps of conjugate gradients in them
  std::int64_t force_evaluations = 0;
  std::int64_t unconverged = 0;  ///< solves, linear or not, that did not reach their tolerance
};

/// A particle as its method holds it, m and m/s.
struct StoredParticle {
  glm::dvec3 x{0}, v{0};
  glm::dvec3 v_seen{0};  ///< what damping sees where a step begins
  double lag = 0;        ///< s; v + lag · a belongs to x
};

/// Something that a step does only for scenes that need it.
struct StepFeature {
  std::string_view name;
  bool on;
};

class Engine {
 public:
  virtual ~Engine() = default;

  /// Takes positions and (full-step) velocities; the method's own start is applied.
  virtual void load(const StateRows& rows, const Tears& tears) = 0;
  void load(const State& state, const Tears& tears) { load(rows_of(state, positions().columns), tears); }
  /// Takes new constants, integrator, dt, bodies. The lattice and the precision are the same. Velocities are kept.
  virtual void set_preset(const Preset& preset, const Tears& tears) = 0;
  /// Whether set_preset() would be quick. Otherwise a program must be built for what the preset has, which takes
  /// seconds, unless it has been built for another engine and is kept.
  virtual bool ready_for(const Preset&) const { return true; }
  /// The same of note_contacts(true).
  virtual bool ready_for_contacts() const { return true; }
  virtual void set_fixed(std::span<const int> pinned, Held held) = 0;
  /// Up to `steps` steps; ends early on divergence or release of the hand. `tears` is updated by tearing.
  virtual Advance advance(int steps, Tears& tears) = 0;
  /// Whether steps note what bodies stop, which only the energy ledger asks for.
  virtual void note_contacts(bool on) = 0;
  /// What bodies stopped in the last step (where a method makes several of its own within dt, in each of them), once
  /// note_contacts(true) has been called.
  virtual std::vector<Contact> contacts() const = 0;
  /// Positions and the velocities that belong to them (v + dt/2 a for Verlet).
  virtual void read(State& state, const Tears& tears) = 0;
  /// What state files show: as read(), but for Verlet the backward velocity d/dt.
  virtual void read_raw(State& state, const Tears& tears) = 0;
  virtual PositionView positions() const = 0;
  /// Whether its arrays lie in a device's own memory, so that positions() copies them.
  virtual bool remote() const { return false; }
  /// Bytes of each slot of the memory that it would keep its positions in, so that they can be drawn where they lie; 0:
  /// none, since it has such memory already or has no use for it.
  virtual std::size_t wants_memory() const { return 0; }
  /// Keeps its positions, or what shown() says of them, in that memory from now on, and asks for none any more. Returns
  /// false where the device cannot do so after all; nothing is changed then. Not while another thread reads.
  virtual bool take_memory(std::shared_ptr<PositionMemory>) { return false; }
  /// The positions for who draws them: as positions(), but in float in the memory that was taken, if any was.
  virtual PositionView shown() { return positions(); }
  /// Whether its device shares buffers with the OpenGL context in use, so that share() and write() can be called, in
  /// the thread where that context is current.
  virtual GlSharing gl_sharing() const { return GlSharing::none; }
  /// OpenGL's buffers as its device's, for write(). Throws EngineError.
  virtual std::unique_ptr<GlVertices> share(const GlBuffers&) const { return nullptr; }
  /// Writes positions in float, and normals where they are asked for, which OpenGL may draw at once. None, and nothing
  /// is written, where the buffers are shared with another device or for another precision. Throws EngineError.
  virtual std::optional<VertexBox> write(GlVertices&, const VertexOrder&) { return std::nullopt; }
  /// Why OpenGL must be given a copy of its positions, a part of a sentence; empty: for all that the engine knows, they
  /// can be drawn where it keeps or writes them.
  virtual std::string why_copied() const { return "the CPU engine makes its steps in place"; }
  /// Bytes of positions and velocities that have been copied from a device into main memory, for whoever looked.
  virtual std::uint64_t copied() const { return 0; }
  /// One particle as the method holds it. Nothing but the particles' own arrays is looked at, so it may be called
  /// while another thread reads.
  virtual StoredParticle stored(int i, int j) const = 0;
  /// Where one particle is: what positions() says, but of a device no more is read than stands near it.
  virtual glm::dvec3 position(int i, int j) const { return positions().at(i, j); }
  /// Bytes of all arrays that grow with the cloth.
  virtual std::size_t bytes() const = 0;
  /// Threads that it uses at most.
  virtual int threads() const = 0;
  /// Threads that it uses at present: it lets go of those that do not pay.
  virtual int threads_at_work() const { return threads(); }
  virtual SolveCounts solves() const = 0;
  /// What a method that chooses its own steps did within dt; nothing for others.
  virtual InnerSteps inner_steps() const = 0;
  /// What a step does for the present scene, and what it skips.
  virtual std::vector<StepFeature> features() const = 0;
  /// "CPU, AVX2, 2 threads": for people.
  virtual std::string name() const = 0;
};

/// Makes the engine that the preset asks for, with at most so many threads (fewer where the cloth is too small for them
/// to pay; the result is the same to the last bit). Throws EngineError if it is not there.
std::unique_ptr<Engine> make_engine(const Preset& preset, const Lattice& lattice, int threads);

class EngineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tyglab
