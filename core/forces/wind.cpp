// F_wind: the wind's normal part on each triangle, a third to each corner (2.16).
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Wind {
  /// The stretch spring between two corners of a quad: its owner is the upper end, or the left one within a row.
  static constexpr Stencil::Spring edge(const Corner& a, const Corner& b) {
    const bool a_owns = a.di < b.di || (a.di == b.di && a.dj < b.dj);
    const Corner &from = a_owns ? a : b, &to = a_owns ? b : a;
    const int di = to.di - from.di, dj = to.dj - from.dj;
    return {di == 0 ? 0 : dj == 0 ? 1 : dj > 0 ? 2 : 3, from.di, from.dj};
  }

  /// Two triangles a quad, which is split one way where i + j is even and the other way where it is odd (figure 2.7).
  static std::span<const Stencil> stencils(const Preset&) {
    static const auto triangles = [] {
      std::array<Stencil, 4> all;
      for (std::size_t n = 0; n < all.size(); ++n) {
        const auto& corners = quad_triangles[n / 2][n % 2];
        all[n].owners = n < 2 ? Stencil::Owners::even : Stencil::Owners::odd;
        all[n].points = all[n].springs = 3;
        for (std::size_t k = 0; k < 3; ++k) {
          all[n].at[k] = {corners[k].di, corners[k].dj};
          all[n].spring[k] = edge(corners[k], corners[(k + 1) % 3]);
        }
      }
      return all;
    }();
    return triangles;
  }

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
    .stencils = Wind::stencils,
    .act = Wind::act,
};

}  // namespace tyglab
