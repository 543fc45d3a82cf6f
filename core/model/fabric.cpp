#include "core/model/fabric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tyglab {
namespace {

constexpr std::string_view arcsim =
    "H. Wang, J. O'Brien and R. Ramamoorthi, Data-Driven Elastic Models for Cloth (SIGGRAPH 2011), as in ARCSim's "
    "materials: mass and bending within a tenth, stretching within a factor of 2.";

constexpr std::array<Fabric, 6> known_fabrics{{
    {"knit", "Knit, 60 % cotton", "Trikå, 60 % bomull", 0.187, 23e-6, 17, 34, 37, true, arcsim},
    {"rubber", "Rubber, 1 mm", "Gummi, 1 mm", 1.1, 222e-6, 2667, 2667, 667, false,
     "Natural rubber, E = 2 MPa, ν = ½: E d³/(12 (1 − ν²)), E d/(1 − ν²) and E d/3."},
    {"jacket", "Polyester jacket", "Polyesterjacka", 0.113, 14e-6, 43, 171, 14, true, arcsim},
    {"jeans", "Jeans, 11 oz", "Jeans, 11 oz", 0.324, 64e-6, 205, 1014, 53, true, arcsim},
    {"trousers", "Trousers, 65/35", "Byxor, 65/35", 0.220, 170e-6, 2017, 2035, 105, true, arcsim},
    {"paper", "Paper, 100 g/m²", "Papper, 100 g/m²", 0.100, 400e-6, 500e3, 500e3, 200e3, false,
     "ARCSim's materials, where it is an estimate."},
}};

}  // namespace

std::span<const Fabric> fabrics() {
  return known_fabrics;
}

double drape_length(double B, double mass, double g) {
  return mass * g > 0 ? std::cbrt(B / (mass * g)) : std::numeric_limits<double>::infinity();
}

// With straight springs of k_a and diagonals of k_c a stretch at constant width meets k_a + k_c and shear k_c. Springs
// cannot resist shear more than stretch: a knit, which does, gets as much shear as leaves its threads half.
Preset with_fabric(Preset preset, const Fabric& fabric) {
  preset.m = fabric.mass * preset.L * preset.L;
  preset.B = fabric.B, preset.twist = 1, preset.k_b = 0;
  preset.k_shear = std::min(fabric.shear, std::min(fabric.warp, fabric.weft) / 2);
  preset.k_warp = fabric.warp - preset.k_shear, preset.k_weft = fabric.weft - preset.k_shear;
  return preset;
}

bool is_fabric(const Preset& preset, const Fabric& fabric) {
  const Preset wanted = with_fabric(preset, fabric);
  // A finer cloth of the same fabric has masses that share what its edges have.
  return std::abs(wanted.m - preset.m) <= 0.15 * preset.m && preset.B == wanted.B && preset.twist == wanted.twist &&
         preset.k_b == wanted.k_b && preset.k_warp == wanted.k_warp && preset.k_weft == wanted.k_weft &&
         preset.k_shear == wanted.k_shear;
}

}  // namespace tyglab
