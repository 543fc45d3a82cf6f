// F_wind: the wind's normal part on each triangle, a third to each corner (2.16).
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Wind {
  static void act(const Preset& p, const Stencil&, const Points& points, ForceAction& action) {
    const glm::dvec3 normal = glm::cross(points.x[1] - points.x[0], points.x[2] - points.x[0]);
    const double squared = glm::dot(normal, normal);
    if (squared < std::numeric_limits<double>::min()) return;  // a triangle of no area
    for (std::size_t k = 0; k < 3; ++k) action.F[k] = glm::dot(normal, p.W) / (3 * squared) * normal;
  }
};

}  // namespace

const Force force::wind{
    .symbol = "F_wind",
    .name = "wind",
    .title = "wind",
    .help = "Work of F_wind.",
    .group = Force::Group::external,
    .conserves = false,
    .in_report = false,
    .on = [](const Preset& p) { return p.kind == Kind::cloth && p.W != glm::dvec3(0); },
    .stencils = [](const Preset&) { return triangle_stencils(); },
    .act = Wind::act,
};

}  // namespace tyglab
