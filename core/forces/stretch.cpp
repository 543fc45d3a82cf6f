// F_s: springs that pull while they are longer than at rest, to the eight nearest particles (2.4, 2.5); for a mass on a
// spring, Hooke's two-sided spring to x_0 (2.3).
#include <cmath>
#include <utility>

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

/// The key of the largest of the constants that act: k_s only where a direction has none of its own.
std::string_view largest_constant(const Preset& p) {
  if (p.kind == Kind::one_weight) return "k";
  const double most = spring_constants(p).largest();
  std::string_view largest;
  for (const auto& [key, k] :
       {std::pair("k_warp", p.k_warp), std::pair("k_weft", p.k_weft), std::pair("k_shear", p.k_shear)}) {
    if (k == left_out && p.k_s == most) return "k_s";
    if (k == most) largest = key;
  }
  return largest;
}

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
    .constant = largest_constant,
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
