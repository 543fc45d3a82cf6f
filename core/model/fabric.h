// Fabrics that were measured, and a few that are estimated, as constants of a cloth.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct Fabric {
  std::string_view key, name, namn;  ///< "jeans", "Jeans, 11 oz", Swedish
  double mass;                       ///< kg/m²
  double B;                          ///< N·m
  double warp, weft;                 ///< resistance to a stretch at constant width, N/m
  double shear;                      ///< to shear, N/m
  bool measured;                     ///< or else estimated
  std::string_view source;           ///< with what it says, a sentence
};

/// In the order of their stiffness.
std::span<const Fabric> fabrics();

/// A property of a fabric in the units in which fabrics are sold and measured. A finer cloth keeps it. The section
/// `fabric` of a preset's file sets it under its key.
struct FabricQuantity {
  std::string_view key, symbol, name, namn, unit, help;
  double min, max;
  double (*of)(const Preset&);
  void (*set)(Preset&, double);  ///< for set_fabric() alone
};
std::span<const FabricQuantity> fabric_quantities();
/// A value of each, or none for those that stay.
using FabricValues = std::vector<std::optional<double>>;
/// Sets the quantities that have a value; the others stay. If that cannot be, the preset stays as it is, and which
/// quantity is to blame and why is returned.
struct FabricProblem {
  const FabricQuantity* quantity;
  std::string why;  ///< "must be at least the shear, 53 N/m"
};
std::optional<FabricProblem> set_fabric(Preset& preset, const FabricValues& values);

/// (B/ρg)^(1/3), m: a strip of a few times that length droops by its own weight. `mass` in kg/m², g in m/s²; 0 where B
/// is, infinity without weight.
double drape_length(double B, double mass, double g);

/// The preset as a cloth of that fabric: m, B, k_warp, k_weft and k_shear by its spacing L, without bending springs.
/// k_s, k_d and dt stay.
Preset with_fabric(Preset preset, const Fabric& fabric);
/// Whether with_fabric would change nothing.
bool is_fabric(const Preset& preset, const Fabric& fabric);

}  // namespace tyglab
