// F_air: drag and lift of the air on each triangle, by its area and by the velocity u of the air relative to it,
//
//   F = ½ρA (C_N |u·N| (u·N) N + C_T |u| u_t),
//
// a third on each corner; u_t is the part of u in the triangle's plane, and a triangle moves as the mean of its
// corners. It depends on velocities, as damping does, and every method sees it at the velocities at which it sees the
// damping; implicit ones at those of the stage's beginning.
//
// A step that is long for the drag would overshoot: the relative velocity would turn round, and grow. So F is at most
// κu along and across N with a κ for which no step of dt does that. A particle belongs to eight triangles at most, so a
// motion of all particles is braked at no rate above Σ κ/3m <= 8κ/3m, 1/s.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/force.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr double triangles_of_a_particle = 8, corners = 3;

struct Air {
  static void act(const Preset& p, const Stencil&, const Points& points, ForceAction& action) {
    const glm::dvec3 twice_area = glm::cross(points.x[1] - points.x[0], points.x[2] - points.x[0]);
    const double length = glm::length(twice_area);
    if (length * length < std::numeric_limits<double>::min()) return;  // a triangle of no area
    const glm::dvec3 N = twice_area / length;
    const glm::dvec3 u = p.u - (points.v[0] + points.v[1] + points.v[2]) / corners;
    const glm::dvec3 across = glm::dot(u, N) * N;
    const double half_rho_A = p.air_density * length / 4, most = corners * most_air_damping(p, p.dt);
    const glm::dvec3 F = std::min(half_rho_A * p.C_N * glm::length(across), most) * across +
                         std::min(half_rho_A * p.C_T * glm::length(u), most) * (u - across);
    for (std::size_t k = 0; k < 3; ++k) action.F[k] = F / corners;
  }
};

}  // namespace

double most_air_damping(const Preset& p, double dt) {
  // Implicit methods and those that project take the air by itself before all else, for which a part of 1 would do.
  // Explicit ones take it beside the springs, which leave little room where dt is near its limit.
  constexpr double beside_springs = 0.125;
  const Scheme& method = scheme(p.integrator);
  const double part = is_implicit(method) || projects(method) ? 1 : beside_springs;
  return part * p.m / (triangles_of_a_particle * dt);
}

const Force force::air{
    .symbol = "F_air",
    .name = "air",
    .title = "air",
    .help = "Work of F_air: never above 0 in still air.",
    .group = Force::Group::external,
    .conserves = false,
    .in_report = false,
    .on = [](const Preset& p) { return p.kind == Kind::cloth && p.air_density > 0 && (p.C_N > 0 || p.C_T > 0); },
    .stencils = [](const Preset&) { return triangle_stencils(); },
    .act = Air::act,
};

}  // namespace tyglab
