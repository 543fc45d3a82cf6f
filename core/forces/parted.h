// A cloth that parts (core/cloth/mesh.h): which stencils act where it has parted, and where it parts next.
//
// A stencil along a row or down a column has a side of cells on either hand; its halves, one a side, act on the
// particles that those cells are attached to, while each particle between its ends is the same for both of its cells.
// Others lie in a cell and act wholly on its particles. Halves add up to the whole, so to part a site changes no force
// of the cloth as it lies then, and no energy.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/cloth/state.h"
#include "core/forces/force.h"

namespace tyglab {

/// A stencil that acts on particles of a parted cloth.
struct LooseStencil {
  const Force* force;
  const Stencil* stencil;  ///< of the table: it lives as long as the program
  std::array<int, Stencil::most_points> at{};
  double weight;      ///< of its energy and forces
  SpringSite spring;  ///< of a spring: where it is in a cloth that has not parted
};
/// All that are not in their places of the lattice, in a fixed order; empty for a cloth that has not parted.
std::vector<LooseStencil> loose_stencils(const Preset& preset, const Tears& tears);

/// A spring of the lattice that joins other particles where the cloth has parted, or one half of it.
struct LooseSpring {
  SpringSite spring;
  int a, b;  ///< particles
};
/// Those of the directions `first` to `last` (lattice.h), `last` not included. Two halves that join the same particles
/// are one.
std::vector<LooseSpring> loose_springs(const Tears& tears, int first, int last);

/// What it does, by its weight; x_of(particle) and v_of(particle) say where its particles are.
template <class X, class V>
ForceAction action_of(const Preset& preset, const LooseStencil& loose, const X& x_of, const V& v_of) {
  Points points;
  for (std::size_t n = 0; n < std::size_t(loose.stencil->points); ++n)
    points.x[n] = x_of(loose.at[n]), points.v[n] = v_of(loose.at[n]);
  ForceAction action;
  loose.force->act(preset, *loose.stencil, points, action);
  action.energy *= loose.weight;
  for (glm::dvec3& F : action.F) F *= loose.weight;
  return action;
}

/// Whether the scene parts the cloth where another one loses springs.
inline bool parts(const Preset& preset) {
  return preset.kind == Kind::cloth && preset.tearing == "split";
}

/// A particle that parts: those of its cells that get a copy.
struct Opening {
  int particle;
  unsigned cells;
};
/// A mask of the sites round these particles, up to the next row and column: springs there do not tear.
std::vector<std::uint8_t> guarded_sites(const Tears& tears, std::span<const int> particles);
/// Where springs whose F_s exceeds F_max part the cloth at positions x (m): of the particles at their ends the one at
/// which two groups of cells pull apart hardest, by the length of the cut between them (N/m); one opening a site, in
/// the order of the sites. `guarded`: sites that do not part; empty: none.
std::vector<Opening> openings_of_overload(const Preset& preset, const Tears& tears, std::span<const glm::dvec3> x,
                                          const std::vector<std::uint8_t>& guarded);
/// Whether such a spring can part the cloth: one of its ends has cells to part, and none is guarded.
bool overload_parts(const Tears& tears, const std::vector<std::uint8_t>& guarded, int a, int b);
/// Where a cut across these stretch springs parts the cloth. It runs through the springs' owners, along the lattice.
std::vector<Opening> openings_of_cut(const Tears& tears, std::span<const SpringSite> springs);
/// Where a cut from particle to particle does, (i, j) as copies have it too. It runs along the lattice, and goes on
/// from cuts that are there.
std::vector<Opening> openings_of_path(const Tears& tears, std::span<const Pins::Site> path);

}  // namespace tyglab
