// The forces of docs/model.md as plain loops in double over lists of springs and triangles. They share no formula with
// the engines, so a motion computed from them is independent; the references of the accuracy benchmark use them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// A whole cloth without bodies and hand. Vectors hold three components a particle, particle i·columns + j after
/// another.
class PlainForces {
 public:
  explicit PlainForces(const Preset& preset);

  std::size_t particles() const { return free_.size(); }
  /// F/m of every particle at positions x and velocities v into a; 0 for pinned ones.
  void accelerations(const double* x, const double* v, double* a) const;

 private:
  struct Spring {
    std::size_t from, to;
    double rest;
    bool bending;
  };
  void add_springs(int i, int j);
  void add_triangles(int i, int j);
  void pull(const Spring& spring, const double* x, const double* v, double* F) const;
  void blow(const std::array<std::size_t, 3>& corners, const double* x, double* F) const;

  Preset preset_;
  std::vector<Spring> springs_;
  std::vector<std::array<std::size_t, 3>> triangles_;
  std::vector<std::uint8_t> free_;
};

}  // namespace tyglab
