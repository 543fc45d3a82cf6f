// The state of the particles as a structure of arrays.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/cloth/array.h"
#include "core/cloth/lattice.h"
#include "core/cloth/mesh.h"
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
///
/// Of a cloth that has parted, springs and triangles at parted sites count as not whole here: they join other
/// particles, those of the mesh, and forces reach them as loose stencils (parted.h).
class Tears {
 public:
  Tears() = default;
  explicit Tears(Lattice lattice) : lattice_(lattice) {}
  /// Of a cloth that has parted, in a lattice with rows for all copies.
  Tears(const Lattice& lattice, std::shared_ptr<const Mesh> mesh);

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
  /// Broken stretch springs, or copies of a cloth that has parted.
  int torn_count() const { return torn_; }
  /// The mesh of a cloth that has parted; null otherwise.
  const Mesh* mesh() const { return mesh_.get(); }
  /// How many particles there are; what follows them in the rows for copies is none.
  int particles() const { return mesh_ ? mesh_->particles() : lattice_.size(); }
  /// Whether particle (i, j) has parted or is a copy, so that no stencil of the lattice has it.
  bool parted(int i, int j) const { return mesh_ && (!lattice_.has_site(i, j) || mesh_->parted(int(index(i, j)))); }
  /// The part of a site's mass that a particle has; 0 where there is none.
  double share(int particle) const { return !mesh_ ? 1 : particle < mesh_->particles() ? mesh_->share(particle) : 0; }
  /// The site of a particle.
  Pins::Site site(int particle) const {
    if (mesh_) particle = mesh_->site(particle);
    return {particle / lattice_.columns, particle % lattice_.columns};
  }
  std::size_t bytes() const { return masks_.capacity() + (mesh_ ? mesh_->bytes() : 0); }
  bool operator==(const Tears& other) const {
    const bool same_mesh = mesh_ == other.mesh_ || (mesh_ && other.mesh_ && *mesh_ == *other.mesh_);
    return lattice_ == other.lattice_ && masks_ == other.masks_ && torn_ == other.torn_ && same_mesh;
  }

 private:
  std::size_t index(int i, int j) const {
    assert(lattice_.contains(i, j));
    return std::size_t(i) * lattice_.columns + j;
  }
  Lattice lattice_;
  std::vector<std::uint8_t> masks_;
  int torn_ = 0;
  std::shared_ptr<const Mesh> mesh_;
};

/// Calls visit(a, b, c, i, j, which) for every whole triangle `which` of cell (i, j), with its particles,
/// counter-clockwise seen from the front.
template <class Visit>
void for_each_triangle(const Tears& tears, const Visit& visit) {
  const Lattice sites = tears.lattice().sites();
  const Mesh* mesh = tears.mesh();
  for (int i = 0; i + 1 < sites.rows; ++i)
    for (int j = 0; j + 1 < sites.columns; ++j)
      for (int which = 0; which < 2; ++which) {
        if (mesh == nullptr && !tears.triangle_whole(i, j, which)) continue;
        const auto& corners = quad_triangles[std::size_t((i + j) & 1)][std::size_t(which)];
        const auto particle = [&](const Corner& at) {
          return mesh != nullptr ? mesh->corner(i, j, at) : (i + at.di) * sites.columns + j + at.dj;
        };
        visit(particle(corners[0]), particle(corners[1]), particle(corners[2]), i, j, which);
      }
}

}  // namespace tyglab
