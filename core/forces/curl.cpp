// F_curl: a rest curvature κ₀ of the bending rigidity B, κ_warp down the columns and κ_weft along the rows, as of
// creases and of cloth that was rolled up. ½B(κ - κ₀)² has three terms: ½Bκ² is the rigidity's (rigidity.cpp), and the
// others are here. With the steps a and b from a particle to its two neighbors along the thread, their second
// difference Δ = a + b, and the step t from one neighbor to the other across the thread, the lattice has the normal
// n = (a - b) × t / 4L², and
//
//   E = Σ (½Bκ₀²L² - Bκ₀ n·Δ) = Σ (½Bκ₀²L² + Bκ₀/(2L²) t·(a × b))
//
// for the warp, with the other sign before n for the weft, so that κ₀ > 0 curls to the front. n is of length 1 while
// the threads keep their lengths and cross at right angles; elsewhere it is that long by which the cloth is stretched.
// So E is a cubic polynomial without roots (A. Garg, E. Grinspun, M. Wardetzky, D. Zorin, Cubic Shells, SCA 2007, whose
// hinges are edges of triangles). A taut thread has the least energy where it turns by φ at each particle, tan φ = κ₀L.
//
// t is the sum of the steps to and from the particle, each of half of a site; at a selvedge or beside a tear the one
// that is left counts twice. So each stencil is a tetrahedron, six times whose volume is det(v - x, a, b), a linear
// function of each of its points: a particle that moves alone meets no stiffness.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/forces/force.h"

namespace tyglab {
namespace {

/// Down the columns or along the rows.
struct Thread {
  Stencil::Spring ahead, behind, beside_ahead, beside_behind;  ///< of the particle: along the thread, and across it
  int di, dj;                                                  ///< along the thread
  int sign;
};
constexpr Thread warp{{1, 0, 0}, {1, -1, 0}, {0, 0, 0}, {0, 0, -1}, 1, 0, 1},
    weft{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {1, -1, 0}, 0, 1, -1};

/// The half of a site with one of the neighbors across the thread, or the other half while that neighbor is the only
/// one.
constexpr Stencil half_site(const Thread& thread, int side, bool alone) {
  const int di = thread.dj * side, dj = thread.di * side;
  const double weight = thread.sign * side;
  Stencil half{4,
               {{{0, 0, -weight}, {thread.di, thread.dj, 0}, {-thread.di, -thread.dj, 0}, {di, dj, weight}}},
               0,
               3,
               {{thread.ahead, thread.behind, side > 0 ? thread.beside_ahead : thread.beside_behind}}};
  half.alone = alone, half.other = side > 0 ? thread.beside_behind : thread.beside_ahead;
  return half;
}

struct Curl {
  /// Of the warp, then of the weft.
  static constexpr std::array<Stencil, 8> stencils{
      {half_site(warp, 1, false), half_site(warp, -1, false), half_site(warp, 1, true), half_site(warp, -1, true),
       half_site(weft, 1, false), half_site(weft, -1, false), half_site(weft, 1, true), half_site(weft, -1, true)}};
  static void act(const Preset& p, const Stencil& stencil, const Points& points, ForceAction& action) {
    const double kappa = stencil.at[1].di != 0 ? p.kappa_warp : p.kappa_weft;
    const double per_volume = stencil.at[3].weight * p.B * kappa / (2 * p.L * p.L);
    const glm::dvec3 a = points.x[1] - points.x[0], b = points.x[2] - points.x[0], t = points.x[3] - points.x[0];
    const glm::dvec3 normal = glm::cross(a, b);
    action.energy = p.B * kappa * kappa * p.L * p.L / 4 + per_volume * glm::dot(t, normal);
    action.F[1] = -per_volume * glm::cross(b, t), action.F[2] = -per_volume * glm::cross(t, a);
    action.F[3] = -per_volume * normal;
    action.F[0] = -(action.F[1] + action.F[2] + action.F[3]);
  }
  /// Σ B|κ₀|/L of both threads, N/m.
  static double per_length(const Preset& p) { return p.B * (std::abs(p.kappa_warp) + std::abs(p.kappa_weft)) / p.L; }
};

}  // namespace

double most_stretch(const Preset& p) {
  return 2 * std::max(1.0, p.initial_stretch);
}

double most_curl_energy(const Preset& p, double stretch) {
  if (!force::curl.on(p)) return 0;
  // |t| <= 2sL and |a × b| <= s²L².
  return Curl::per_length(p) * p.L * p.L * std::pow(stretch, 3);
}

double curl_below_zero(const Preset& p) {
  if (!force::curl.on(p)) return 0;
  // B/(2L²)|Δ|² + E = B/(2L²)|Δ - κ₀L²n|² + ½Bκ₀²L²(1 - |n|²), and |n| <= s².
  const double squares = p.kappa_warp * p.kappa_warp + p.kappa_weft * p.kappa_weft;
  return p.B / 2 * squares * p.L * p.L * (std::pow(most_stretch(p), 4) - 1);
}

const Force force::curl{
    .symbol = "F_curl",
    .name = "curl",
    .title = "elastic, rest curvature",
    .help = "Σ (½Bκ₀²L² − Bκ₀ n·Δ): with that of the rigidity, ½B(κ − κ₀)² per area.",
    .group = Force::Group::internal,
    .conserves = true,
    .in_report = false,
    .on = [](const Preset& p) { return force::rigidity.on(p) && (p.kappa_warp != 0 || p.kappa_weft != 0); },
    .stencils = [](const Preset& p) -> std::span<const Stencil> {
      constexpr std::size_t half = Curl::stencils.size() / 2;
      const std::span all(Curl::stencils);
      return p.kappa_weft == 0 ? all.first(half) : p.kappa_warp == 0 ? all.last(half) : all;
    },
    .act = Curl::act,
    // With c = B|κ₀|/(2L²), |a|, |b| <= sL and |t| <= 2sL the second variation of a site is at most
    //   2c sL (2|δa||δb| + |δt|(|δa| + |δb|)) <= 2c sL (2|δa|² + 2|δb|² + ½|δt|²),
    // and Σ|δa|² and Σ|δb|² are at most 4Σ|δx|², Σ|δt|² at most 16Σ|δx|² (in two columns; inside 4): 2c sL·24.
    .largest_eigenvalue = [](const Preset& p) { return 24 * most_stretch(p) * Curl::per_length(p); },
    // Its own block is 0; this bounds what its neighbors' do.
    .at_particle = [](const Preset& p) { return 24 * most_stretch(p) * Curl::per_length(p); },
    // Σ|δa|² + Σ|δb|² is at most twice the squares of the springs along the threads, Σ|δt|² at most 8 times those of
    // the springs across: 2c sL·4.
    .over_damping = [](const Preset& p) { return 4 * most_stretch(p) * Curl::per_length(p); },
};

}  // namespace tyglab
