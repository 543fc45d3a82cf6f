// The state of the particles as a structure of arrays.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/cloth/array.h"
#include "core/cloth/lattice.h"
#include "core/model/preset.h"

namespace tyglab {

/// Three components of one quantity over all particles.
template <class T>
struct VectorField {
  Array<T> x, y, z;
  void resize(std::size_t n) { x.assign(n, T(0)), y.assign(n, T(0)), z.assign(n, T(0)); }
  std::size_t bytes() const { return 3 * x.size() * sizeof(T); }
};

/// Positions (m) and velocities (m/s) in double, dense (index i·columns + j): for files, readouts, changes of engine.
struct State {
  VectorField<double> x, v;
};

/// One row of a state: three components of x (m) and of v (m/s), each a value a column.
struct StateRow {
  double* x[3];
  double* v[3];
};
/// Writes row i, so a large state can be passed on without being in memory as a whole. May be called for different rows
/// simultaneously.
using StateRows = std::function<void(int i, const StateRow& row)>;
/// The rows of a state; it must outlive them.
StateRows rows_of(const State& state, int columns);

// The initial state of a preset (docs/model.md, "Space and lattice").

/// R x C of the preset's cloth, 1 x 1 for the mass on a spring.
Lattice lattice_of(const Preset& preset);
/// Positions and velocities at the start; pinned particles have v = 0.
StateRows start_rows(const Preset& preset);
State start_state(const Preset& preset);
/// Of particle (i, j), m.
glm::dvec3 starting_position(const Preset& preset, int i, int j);
/// That of every free particle, m/s; the mass on a spring moves along y alone.
glm::dvec3 starting_velocity(const Preset& preset);
/// Mask over i·columns + j of the particles that `mode` names, or, where that is a list, of `sites`.
std::vector<std::uint8_t> particles_at(const Lattice& lattice, Pins::Mode mode, std::span<const Pins::Site> sites);
/// Mask over i·columns + j of the particles that the preset pins.
std::vector<std::uint8_t> pinned_particles(const Preset& preset);
/// Whether each of the preset's motions of pins picks a pinned particle of a cloth; of a mass on a spring all count.
std::vector<bool> moves_pins(const Preset& preset);
/// Whether both pin the same particles of the same lattice, by a name or by a list.
bool same_pins(const Preset& a, const Preset& b);
/// Numbers of the particles that are set in such a mask, rising.
std::vector<int> particles_in(const std::vector<std::uint8_t>& mask);

// The set of torn springs, allocated only when something tears, so an untorn cloth has no cost.

/// One mask a particle (row i, column j at i·columns + j): bit d tells whether the spring of direction d that the
/// particle owns is whole. Bits of springs that do not exist are set, and never read.
class Tears {
 public:
  Tears() = default;
  explicit Tears(Lattice lattice) : lattice_(lattice) {}

  const Lattice& lattice() const { return lattice_; }
  bool untorn() const { return masks_.empty(); }
  bool whole(int direction, int i, int j) const {
    assert(direction >= 0 && direction < int(directions.size()));
    return masks_.empty() || (masks_[index(i, j)] >> direction & 1) != 0;
  }
  /// Mask row i, or nullptr while the cloth is untorn.
  const std::uint8_t* row(int i) const { return masks_.empty() ? nullptr : masks_.data() + index(i, 0); }
  /// Breaks a stretch spring and the bending springs over it. Returns whether it was whole.
  bool tear(int direction, int i, int j);
  /// Whether triangle `which` (0, 1) of quad (i, j) has its three edge springs.
  bool triangle_whole(int i, int j, int which) const;
  int torn_count() const { return torn_; }
  std::size_t bytes() const { return masks_.capacity(); }
  bool operator==(const Tears&) const = default;

 private:
  std::size_t index(int i, int j) const {
    assert(lattice_.contains(i, j));
    return std::size_t(i) * lattice_.columns + j;
  }
  Lattice lattice_;
  std::vector<std::uint8_t> masks_;
  int torn_ = 0;  ///< stretch springs
};

}  // namespace tyglab
