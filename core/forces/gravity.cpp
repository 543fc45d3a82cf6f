// F_g: weight (2.2).
#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Gravity {
  static constexpr std::array<Stencil, 1> alone{{{1, {{{0, 0, 1}}}}}};
};

}  // namespace

const Force force::gravity{
    .symbol = "F_g",
    .name = "gravity",
    .title = "gravitational potential",
    .help = "m g y of every particle, from y = 0. Another origin would add a constant, so this row has no bar.",
    .group = Force::Group::external,
    .conserves = true,
    .in_report = true,
    .on = [](const Preset&) { return true; },
    .stencils = [](const Preset&) -> std::span<const Stencil> { return Gravity::alone; },
    .act =
        [](const Preset& p, const Stencil&, const Points& points, ForceAction& action) {
          action.energy = p.m * p.g * points.x[0].y;
          action.F[0] = {0, -p.m * p.g, 0};
        },
};

}  // namespace tyglab
