// Forces as data. A force acts on stencils: up to four particles in fixed places of the lattice. One file a force
// (stretch.cpp, bend.cpp, …) says what it does to a single stencil, in double; the table below lists them all.
// Read-outs, energies, the plain engine, bounds of frequencies and panels are loops over this table. The fast engines
// compute the springs and the wind by hand, and tests hold them against it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

/// The particles that a force couples, as seen from the one that owns them.
struct Stencil {
  static constexpr int most_points = 4, most_springs = 6;
  struct Point {
    int di = 0, dj = 0;
    double weight = 0;  ///< w in d = Σ w x, for a force that depends on d
  };
  /// A stretch spring, by the place of its owner.
  struct Spring {
    int direction = 0, di = 0, dj = 0;
  };
  enum class Owners { all, even, odd };  ///< by i + j
  int points = 0;
  std::array<Point, most_points> at{};
  double rest = 0;  ///< length of d at rest, in units of L
  int springs = 0;
  std::array<Spring, most_springs> spring{};  ///< it acts while these are whole
  Owners owners = Owners::all;
  bool alone = false;  ///< it acts only while `other` is not whole, or leaves the cloth
  Spring other{};

  /// Whether particle (i, j) owns one that acts.
  bool acts(const Tears& tears, int i, int j) const;
};

/// Positions (m) and velocities (m/s) of a stencil's particles.
struct Points {
  std::array<glm::dvec3, Stencil::most_points> x{}, v{};
};

/// What a force does to a stencil's particles.
struct ForceAction {
  double energy = 0;                                 ///< J; of a force that conserves it
  std::array<glm::dvec3, Stencil::most_points> F{};  ///< N
};

/// A potential φ(|d|) at one |d|: its gradient is factor·d, its Hessian factor·I + along·d dᵀ. Newton's method wants
/// neither below 0.
struct Potential {
  double energy = 0;  ///< J
  double factor = 0;  ///< N/m
  double along = 0;   ///< N/m³
};

struct Force {
  enum class Group { internal, external };
  std::string_view symbol;  ///< "F_s": its row among the variables of the notation table
  std::string_view name;    ///< "stretch": its energy, or the work that it does, in files
  std::string_view title;   ///< of that energy or work, in panels
  std::string_view help;    ///< a sentence on it
  Group group;
  bool conserves;  ///< it has an energy; others do work
  bool in_report;  ///< table B.1 lists it, so panels do too while it is off
  /// Whether the scene has it.
  bool (*on)(const Preset&);
  std::span<const Stencil> (*stencils)(const Preset&);
  void (*act)(const Preset&, const Stencil&, const Points&, ForceAction&);

  /// For a force between particles that are near in space, which has no stencils: adds it at positions x (m) and
  /// velocities v (m/s) to F (N), and returns its energy, J.
  double (*among)(const Preset&, const Tears&, std::span<const glm::dvec3> x, std::span<const glm::dvec3> v,
                  std::span<glm::dvec3> F) = nullptr;

  // Forces with a potential φ(|d|), of which those with bounds that are not of that kind have only the last three:
  Potential (*potential)(const Preset&, const Stencil&, double d_squared) = nullptr;
  /// κ, N/m, where φ = ½κ|d|² and Σ w = 0: a force that is linear in positions. All engines have it at once, as springs
  /// (linear_springs.h) or by its stencils.
  double (*linear)(const Preset&, const Stencil&) = nullptr;
  /// The largest second derivative of φ, N/m.
  double (*stiffness)(const Preset&, const Stencil&) = nullptr;
  /// The constant that it is proportional to; of several the largest.
  std::string_view (*constant)(const Preset&) = nullptr;
  /// Upper bound of the eigenvalues of its Hessian K over all positions of all particles, N/m; for a force without a
  /// potential φ(|d|) over those in which no thread is longer than most_stretch().
  double (*largest_eigenvalue)(const Preset&) = nullptr;
  /// Largest trace of K's block of one particle along a line, N/m: the sum of w²·stiffness over its stencils.
  double (*at_particle)(const Preset&) = nullptr;
  /// r in K <= r·C, where C is the matrix of damping with k_d = 1, N/m.
  double (*over_damping)(const Preset&) = nullptr;
};

namespace force {
extern const Force stretch, bend, rigidity, curl, damping, self, slip, gravity, wind, air;
/// In the order of the report, and what it does not have beside what is like it.
inline constexpr std::array all{&stretch, &bend, &rigidity, &curl, &damping, &self, &slip, &gravity, &wind, &air};
}  // namespace force

/// Where a force stands in the table.
std::size_t index_of(const Force& force);

/// One value for each force.
template <class T>
struct PerForce {
  std::array<T, force::all.size()> of{};  ///< in the order of the table
  T& operator[](const Force& force) { return of[index_of(force)]; }
  const T& operator[](const Force& force) const { return of[index_of(force)]; }
  /// The sum over the forces that `which` picks.
  template <class Which>
  T sum(const Which& which) const {
    T total{0};
    for (std::size_t n = 0; n < force::all.size(); ++n)
      if (which(*force::all[n])) total += of[n];
    return total;
  }
};

/// Calls visit(force, stencil) for the stencils of every force that the scene has.
template <class Visit>
void for_each_stencil(const Preset& preset, const Visit& visit) {
  for (const Force* force : force::all)
    if (force->on(preset))
      for (const Stencil& stencil : force->stencils(preset)) visit(*force, stencil);
}

/// The particles of a stencil that (i, j) owns; x_of(i, j) and v_of(i, j) say where they are.
template <class X, class V>
Points points_of(const Stencil& stencil, int i, int j, const X& x_of, const V& v_of) {
  Points points;
  for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) {
    const auto& [di, dj, weight] = stencil.at[n];
    points.x[n] = x_of(i + di, j + dj), points.v[n] = v_of(i + di, j + dj);
  }
  return points;
}

/// Calls visit(points, action) for each particle that owns such a stencil, with what the force does to it.
template <class X, class V, class Visit>
void for_each_action(const Preset& preset, const Tears& tears, const Force& force, const Stencil& stencil,
                     const X& x_of, const V& v_of, const Visit& visit) {
  for (int i = 0; i < tears.lattice().rows; ++i)
    for (int j = 0; j < tears.lattice().columns; ++j) {
      if (!stencil.acts(tears, i, j)) continue;
      const Points points = points_of(stencil, i, j, x_of, v_of);
      ForceAction action;
      force.act(preset, stencil, points, action);
      visit(points, action);
    }
}

/// What a force with a potential φ(|d|) does: -w·factor·d on each point.
inline void act_along_d(decltype(Force::potential) potential, const Preset& preset, const Stencil& stencil,
                        const Points& points, ForceAction& action) {
  glm::dvec3 d{0};
  for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) d += stencil.at[n].weight * points.x[n];
  const Potential at = potential(preset, stencil, glm::dot(d, d));
  action.energy = at.energy;
  for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) action.F[n] = -stencil.at[n].weight * at.factor * d;
}

/// A bound of all forces that have one together: the sum of theirs.
inline double sum_of(double (*Force::*bound)(const Preset&), const Preset& preset) {
  double sum = 0;
  for (const Force* force : force::all)
    if (force->*bound != nullptr && force->on(preset)) sum += (force->*bound)(preset);
  return sum;
}

/// Such a sum over the forces that are linear in positions alone.
inline double linear_sum_of(double (*Force::*bound)(const Preset&), const Preset& preset) {
  double sum = 0;
  for (const Force* force : force::all)
    if (force->linear != nullptr && force->on(preset)) sum += (force->*bound)(preset);
  return sum;
}

/// The force of the lattice's springs in that direction.
inline const Force& spring_force(const Direction& to) {
  return to.bending ? force::bend : force::stretch;
}
/// The constants of the lattice's springs, N/m or times a factor: along the rows (weft), down the columns (warp), of
/// the diagonals, and of the springs that resist bending.
struct SpringConstants {
  double weft = 0, warp = 0, shear = 0, bend = 0;
  double of(const Direction& to) const { return to.bending ? bend : to.di == 0 ? weft : to.dj == 0 ? warp : shear; }
  /// The largest and the least of stretch springs.
  double largest() const { return std::max({weft, warp, shear}); }
  double least() const { return std::min({weft, warp, shear}); }
  /// Upper bound of Σ k |x_i - x_j|² over all stretch springs, divided by Σ |x|²: 4 sin² a and 4 sin² b of the straight
  /// ones and 4 (1 - cos 2a cos 2b) of the diagonals are largest together where each cosine is 1 or -1.
  double largest_stretch_eigenvalue() const {
    return std::max(4 * std::max(weft, warp) + 8 * shear, 4 * (weft + warp));
  }
  bool stretches_alike() const { return weft == warp && warp == shear; }
  friend SpringConstants operator*(double factor, const SpringConstants& k) {
    return {factor * k.weft, factor * k.warp, factor * k.shear, factor * k.bend};
  }
  bool operator==(const SpringConstants&) const = default;
};
inline SpringConstants spring_constants(const Preset& preset) {
  const auto own = [&](double k) { return k == left_out ? preset.k_s : k; };
  return {own(preset.k_weft), own(preset.k_warp), own(preset.k_shear), preset.k_b};
}
inline double spring_constant(const Preset& preset, const Direction& to) {
  return spring_constants(preset).of(to);
}

/// The constant of the force between layers of the cloth, N/m.
inline double layer_constant(const Preset& preset) {
  return spring_constants(preset).largest();
}

/// Whether springs break in the scene once they are overloaded.
inline bool tears_springs(const Preset& preset) {
  return preset.kind == Kind::cloth && preset.F_max > 0 && spring_constants(preset).largest() > 0;
}

/// The stretch springs of the lattice, one stencil a direction, which damping shares.
std::span<const Stencil> stretch_stencils();
/// The two triangles of a quad, split one way where i + j is even and the other way where it is odd (figure 2.7).
std::span<const Stencil> triangle_stencils();

/// By what factor threads may be longer than at rest where bounds of F_curl hold: twice, or twice what they start with.
double most_stretch(const Preset& preset);
/// The largest energy of F_curl at a particle, J, beside that at rest, in threads `stretch` times as long.
double most_curl_energy(const Preset& preset, double stretch);
/// How far below 0 the energies of a site's F_B and F_curl may be together, J, where those bounds hold.
double curl_below_zero(const Preset& preset);

/// The most that air resists a corner of a triangle with in a step of dt, N s/m (air.cpp).
double most_air_damping(const Preset& preset, double dt);

}  // namespace tyglab
