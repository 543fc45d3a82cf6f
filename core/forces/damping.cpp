// F_d: resistance to the relative velocity of two particles that a stretch spring joins (2.6); for a mass on a spring,
// to its velocity.
#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Damping {
  static constexpr std::array<Stencil, 1> alone{{{1, {{{0, 0, 1}}}}}};

  static void act(const Preset& p, const Stencil&, const Points& points, ForceAction& action) {
    if (p.kind == Kind::one_weight)
      action.F[0] = {0, -p.k_d * points.v[0].y, 0};
    else
      action.F[0] = -p.k_d * (points.v[0] - points.v[1]), action.F[1] = -action.F[0];
  }
};

}  // namespace

const Force force::damping{
    .symbol = "F_d",
    .name = "damping",
    .title = "damping",
    .help = "Work of F_d since the ledger began: never above 0.",
    .group = Force::Group::internal,
    .conserves = false,
    .in_report = true,
    .on = [](const Preset& p) { return p.k_d > 0; },
    .stencils = [](const Preset& p) -> std::span<const Stencil> {
      return p.kind == Kind::one_weight ? Damping::alone : stretch_stencils();
    },
    .act = Damping::act,
};

}  // namespace tyglab
