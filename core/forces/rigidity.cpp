// F_B: resistance to curvature with a rigidity B, and to twist: forces that are linear in positions. With the second
// difference Δ = x₋ - 2x + x₊ along rows and along columns, and d = x₀₀ - x₀₁ - x₁₀ + x₁₁ of each cell,
//
//   E = B/(2L²) Σ |Δ|² + twist·B/L² Σ |d|²,
//
// the energy ½B∫(κ² + …) of a plate on the lattice: on taut threads |Δ| is L times the curvature's angle, up to its
// fourth power (M. Bergou et al., A Quadratic Bending Model for Inextensible Surfaces, SGP 2006). With twist = 1 it is
// the same in all directions; with 0, rows and columns bend on their own.
#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Rigidity {
  /// Each acts while the springs that it lies over are whole. The last is that of twist.
  static constexpr std::array<Stencil, 3> stencils{{
      {3, {{{0, 0, 1}, {0, 1, -2}, {0, 2, 1}}}, 0, 2, {{{0, 0, 0}, {0, 0, 1}}}},
      {3, {{{0, 0, 1}, {1, 0, -2}, {2, 0, 1}}}, 0, 2, {{{1, 0, 0}, {1, 1, 0}}}},
      {4,
       {{{0, 0, 1}, {0, 1, -1}, {1, 0, -1}, {1, 1, 1}}},
       0,
       6,
       {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 1}, {1, 0, 1}, {0, 1, 0}}}},
  }};

  /// B/L², N/m.
  static double per_area(const Preset& p) { return p.B / (p.L * p.L); }
  static double linear(const Preset& p, const Stencil& stencil) {
    return stencil.points == 4 ? 2 * p.twist * per_area(p) : per_area(p);
  }
  static Potential potential(const Preset& p, const Stencil& stencil, double d_squared) {
    const double kappa = linear(p, stencil);
    return {kappa / 2 * d_squared, kappa, 0};
  }
};

}  // namespace

const Force force::rigidity{
    .symbol = "F_B",
    .name = "rigidity",
    .title = "elastic, rigidity",
    .help = "B/(2L²) Σ |x₋ − 2x + x₊|² along rows and columns, and twist·B/L² Σ |x₀₀ − x₀₁ − x₁₀ + x₁₁|².",
    .group = Force::Group::internal,
    .conserves = true,
    .in_report = false,
    .on = [](const Preset& p) { return p.kind == Kind::cloth && p.B > 0; },
    .stencils = [](const Preset& p) -> std::span<const Stencil> {
      return std::span(Rigidity::stencils).first(p.twist > 0 ? 3 : 2);
    },
    .act = [](const Preset& p, const Stencil& stencil, const Points& points,
              ForceAction& action) { act_along_d(Rigidity::potential, p, stencil, points, action); },
    .potential = Rigidity::potential,
    .linear = Rigidity::linear,
    .stiffness = Rigidity::linear,
    .constant = [](const Preset&) -> std::string_view { return "B"; },
    // 16 sin⁴ of two columns and of two rows, and 2·twist·16 sin² sin².
    .largest_eigenvalue = [](const Preset& p) { return 32 * (1 + p.twist) * Rigidity::per_area(p); },
    .at_particle = [](const Preset& p) { return (12 + 8 * p.twist) * Rigidity::per_area(p); },
    // |Δ|² is at most twice the sum of two springs' squares, |d|² at most the sum of its four edges'.
    .over_damping = [](const Preset& p) { return 4 * (1 + p.twist) * Rigidity::per_area(p); },
};

}  // namespace tyglab
