// Shapes at rest: the least energy, found by the table of forces.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/cloth/state.h"
#include "core/forces/force.h"
#include "core/model/preset.h"

namespace tyglab::verify {

using Positions = std::vector<glm::dvec3>;  ///< at i·columns + j

/// The energy of a cloth by the potentials of the table of forces, with its gradient and Hessian over the particles
/// behind the first `fixed` ones. Dense: for small cloths alone.
class RestEnergy {
 public:
  /// `threads_push`: stretch springs hold their length in both directions, as an elastica's thread does; the report's
  /// only pull. `load`: a force on the last particle, N.
  RestEnergy(const Preset& preset, std::size_t fixed, bool threads_push, glm::dvec3 load = {})
      : preset_(preset), fixed_(fixed), threads_push_(threads_push), load_(load), whole_(lattice_of(preset)) {}

  /// J; with `derivatives` gradient and Hessian too.
  double evaluate(const Positions& x, bool derivatives);
  const std::vector<double>& gradient() const { return gradient_; }
  /// Row by row.
  const std::vector<double>& hessian() const { return hessian_; }
  std::size_t fixed() const { return fixed_; }
  /// The weight of that many particles and the load, N.
  double scale(std::size_t particles) const;

 private:
  double add(const Force& force, const Stencil& stencil, int i, int j, const Positions& x, bool derivatives);

  Preset preset_;
  std::size_t fixed_;
  bool threads_push_;
  glm::dvec3 load_;
  Tears whole_;
  std::vector<double> gradient_, hessian_;
};

/// Moves x to rest by Newton's method with a search along the line, to a gradient of 1e-8 of the weight and the load.
/// Throws std::runtime_error where it does not come to rest, and what `look` throws, which is called now and then.
void find_rest(
    RestEnergy& energy, Positions& x, const std::function<void()>& look = [] {});

/// Whether all pivots of a symmetric matrix, row by row, are above 0: whether it is positive definite.
bool positive_definite(std::vector<double> matrix, std::size_t size);

}  // namespace tyglab::verify
