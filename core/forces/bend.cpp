// F_b: springs that push while they are shorter than at rest, to every second particle along rows and columns
// (2.7, 2.8).
#include <cmath>

#include "core/forces/force.h"

namespace tyglab {
namespace {

struct Bend {
  /// Each lies over two stretch springs, and breaks with either.
  static constexpr std::array<Stencil, 2> stencils{{
      {2, {{{0, 0, -1}, {0, 2, 1}}}, 2, 2, {{{0, 0, 0}, {0, 0, 1}}}},
      {2, {{{0, 0, -1}, {2, 0, 1}}}, 2, 2, {{{1, 0, 0}, {1, 1, 0}}}},
  }};

  static Potential potential(const Preset& p, const Stencil& stencil, double d_squared) {
    constexpr double shortest = 1e-9;  // of its rest length, under which a spring has no direction
    const double rest = stencil.rest * p.L, length = std::sqrt(d_squared), longer = length - rest;
    if (!(longer < 0) || length < shortest * rest) return {};
    const double factor = p.k_b * longer / length;
    return {p.k_b / 2 * longer * longer, factor, (p.k_b - factor) / d_squared};
  }
};

}  // namespace

const Force force::bend{
    .symbol = "F_b",
    .name = "bending",
    .title = "elastic, bending",
    .help = "½ k_b (2L − |x_ij|)² of springs that push.",
    .group = Force::Group::internal,
    .conserves = true,
    .in_report = true,
    .on = [](const Preset& p) { return p.kind == Kind::cloth && p.k_b > 0; },
    .stencils = [](const Preset&) -> std::span<const Stencil> { return Bend::stencils; },
    .act = [](const Preset& p, const Stencil& stencil, const Points& points,
              ForceAction& action) { act_along_d(Bend::potential, p, stencil, points, action); },
    .potential = Bend::potential,
    .stiffness = [](const Preset& p, const Stencil&) { return p.k_b; },
    .constant = [](const Preset&) -> std::string_view { return "k_b"; },
    // 4 sin² of two columns, and of two rows.
    .largest_eigenvalue = [](const Preset& p) { return 8 * p.k_b; },
    .at_particle = [](const Preset& p) { return 4 * p.k_b; },
    // sin² 2a <= 4 sin² a.
    .over_damping = [](const Preset& p) { return 4 * p.k_b; },
};

}  // namespace tyglab
