// Stiffness between particles that no spring of the lattice joins: of loose springs where the cloth has parted, and of
// layers in contact. A linear system (stiffness.h) has it as terms beside its rows: there are few.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace tyglab::implicit {

/// Resists u = Σ weight·x of its points with all·u + extra·along (along·u), times h²/m like the rows of A; neither
/// `all` nor all + extra is below 0.
struct Coupling {
  static constexpr int most_points = 4;
  int points = 0;
  std::array<std::ptrdiff_t, most_points> at{};  ///< of the points' x in a field, as in row_field.h
  std::array<double, most_points> weights{};
  glm::dvec3 along{0};  ///< unit vector
  double all = 0, extra = 0;
};

/// A particle with a share of its site's mass.
struct Lighter {
  std::ptrdiff_t at;  ///< of its x in a field
  double share;
};

/// What a scene adds to a stage beside the lattice.
struct Beside {
  std::vector<Lighter> lighter;
  /// Writes the couplings at the positions and velocities at which forces were computed last, over a time h (s).
  std::function<void(double h, std::vector<Coupling>&)> couplings;
  /// Takes what has come near by now into account, where forces were computed last; empty: nothing can.
  std::function<void()> renew;
};

}  // namespace tyglab::implicit
