// F_s: springs that pull while they are longer than at rest, to the eight nearest particles (2.4, 2.5); for a mass on a
// spring, Hooke's two-sided spring to x_0 (2.3).
#include <cmath>

#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Stretch {
  static constexpr std::array<Stencil, 1> anchored{{{1, {{{0, 0, 1}}}}}};

  static double constant(const Preset& p, const Stencil& stencil) {
    return spring_constant(p, directions[std::size_t(stencil.spring[0].direction)]);
  }
  static Potential potential(const Preset& p, const Stencil& stencil, double d_squared) {
    const double length = std::sqrt(d_squared), longer = length - stencil.rest * p.L;
    if (!(longer > 0)) return {};
    const double k = constant(p, stencil), factor = k * longer / length;
    return {k / 2 * longer * longer, factor, (k - factor) / d_squared};
  }

  static void act(const Preset& p, const Stencil& stencil, const Points& points, ForceAction& action) {
    if (p.kind == Kind::one_weight) {
      const double away = points.x[0].y - p.x_0.y;
      action.energy = p.k / 2 * away * away;
      action.F[0] = {0, -p.k * away, 0};
    } else {
      act_along_d(potential, p, stencil, points, action);
    }
  }
};

}  // namespace

const Force force::stretch{
    .symbol = "F_s",
    .name = "stretch",
    .title = "elastic, stretch",
    .help = "½ k_s (|x_ij| − L)² of springs that pull; k_warp, k_weft or k_shear in place of k_s where set.",
    .group = Force::Group::internal,
    .conserves = true,
    .in_report = true,
    .on = [](const Preset&) { return true; },
    .stencils = [](const Preset& p) -> std::span<const Stencil> {
      return p.kind == Kind::one_weight ? Stretch::anchored : stretch_stencils();
    },
    .act = Stretch::act,
    .potential = Stretch::potential,
    .stiffness = [](const Preset& p,
                    const Stencil& s) { return p.kind == Kind::one_weight ? p.k : Stretch::constant(p, s); },
    .constant = [](const Preset& p) -> std::string_view { return p.kind == Kind::one_weight ? "k" : "k_s"; },
    // Σ 4 sin² over the four directions is at most 12: 12 k_s, where all have it.
    .largest_eigenvalue =
        [](const Preset& p) {
          return p.kind == Kind::one_weight ? p.k : spring_constants(p).largest_stretch_eigenvalue();
        },
    .at_particle =
        [](const Preset& p) {
          const SpringConstants k = spring_constants(p);
          return p.kind == Kind::one_weight ? p.k : 2 * (k.weft + k.warp) + 4 * k.shear;
        },
    .over_damping = [](const Preset& p) { return p.kind == Kind::one_weight ? p.k : spring_constants(p).largest(); },
};

}  // namespace tyglab
