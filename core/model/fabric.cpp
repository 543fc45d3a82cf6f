#include "core/model/fabric.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/model/words.h"

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

double shear_of(const Preset& p) {
  return p.k_shear == left_out ? p.k_s : p.k_shear;
}
double warp_of(const Preset& p) {
  return (p.k_warp == left_out ? p.k_s : p.k_warp) + shear_of(p);
}
double weft_of(const Preset& p) {
  return (p.k_weft == left_out ? p.k_s : p.k_weft) + shear_of(p);
}
double area_of(const Preset& p) {
  return p.L * p.L;
}

constexpr double milli = 1e-3, micro = 1e-6;

/// In the order in which they are set: masses depend on the spacing, and threads share the shear.
constexpr std::array<FabricQuantity, 6> quantities{{
    {"spacing", "L", "Distance of particles", "Partikelavstånd", "mm", "The mass per area stays.", 0.1, 1e4,
     [](const Preset& p) { return p.L / milli; },
     [](Preset& p, double value) {
       const double mass = p.m / area_of(p);
       p.L = value * milli, p.m = mass * area_of(p);
     }},
    {"mass", "ρ_A", "Mass per area", "Ytvikt", "g/m²", "m = ρ_A L².", 0.1, 1e5,
     [](const Preset& p) { return p.m / area_of(p) / milli; },
     [](Preset& p, double value) { p.m = value * milli * area_of(p); }},
    {"B", "B", "Bending rigidity", "Böjstyvhet", "µN·m", "Moment per width and curvature.", 0, 1e9,
     [](const Preset& p) { return p.B / micro; }, [](Preset& p, double value) { p.B = value * micro; }},
    {"shear", "G", "Resistance to shear", "Skjuvstyvhet", "N/m",
     "k_shear = G, at most the resistance of either thread, which stays.", 0, 1e8, shear_of,
     [](Preset& p, double value) {
       const double warp = warp_of(p), weft = weft_of(p);
       p.k_shear = value;
       p.k_warp = std::max(warp - value, 0.0), p.k_weft = std::max(weft - value, 0.0);
     }},
    {"warp", "C_warp", "Resistance to a stretch of the warp", "Dragstyvhet varp", "N/m",
     "At constant width: k_warp = C_warp - k_shear, so at least the shear.", 0, 1e8, warp_of,
     [](Preset& p, double value) { p.k_warp = std::max(value - shear_of(p), 0.0); }},
    {"weft", "C_weft", "Resistance to a stretch of the weft", "Dragstyvhet inslag", "N/m",
     "At constant width: k_weft = C_weft - k_shear, so at least the shear.", 0, 1e8, weft_of,
     [](Preset& p, double value) { p.k_weft = std::max(value - shear_of(p), 0.0); }},
}};
constexpr const FabricQuantity& shear = quantities[3];
static_assert(shear.key == "shear");

}  // namespace

std::span<const FabricQuantity> fabric_quantities() {
  return quantities;
}

std::optional<FabricProblem> set_fabric(Preset& preset, const FabricValues& values) {
  assert(values.size() == quantities.size());
  Preset next = preset;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const FabricQuantity& quantity = quantities[n];
    if (!values[n]) continue;
    if (!(*values[n] >= quantity.min && *values[n] <= quantity.max))
      return FabricProblem{&quantity, shortest_number(*values[n]) +
                                          " is not allowed; allowed: " + shortest_number(quantity.min) + " to " +
                                          shortest_number(quantity.max) + " " + std::string(quantity.unit)};
    quantity.set(next, *values[n]);
  }
  // Threads resist a stretch at least as much as shear, since the diagonals do: then one was not set, or did not stay.
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double wanted = values[n].value_or(quantities[n].of(preset));
    if (std::abs(quantities[n].of(next) - wanted) <= 1e-9 * std::abs(wanted)) continue;
    if (values[n])
      return FabricProblem{&quantities[n], "must be at least the shear, " + quantity(shear_of(next), "N/m") +
                                               ", since diagonals resist a stretch too"};
    return FabricProblem{
        &shear, "must be at most the resistance to a stretch, " + quantity(wanted, "N/m") + ", to which diagonals add"};
  }
  preset = std::move(next);
  return std::nullopt;
}

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
