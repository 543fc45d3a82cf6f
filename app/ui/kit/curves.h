// The forces of table B.1 as they are plotted, listed and drawn as arrows: one colour and line style each, everywhere.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/frame/ui_state.h"
#include "app/ui/kit/theme.h"
#include "core/model/notation.h"
#include "core/simulation.h"

namespace tyglab {

/// Keys of the plotted forces, in the order of Plots::forces' columns.
inline constexpr std::array<std::string_view, Plots::forces_count> force_keys{"F",   "F_s",   "F_b",  "F_d",
                                                                              "F_g", "F_int", "F_ext"};
const Variable& variable(std::string_view key);
CurveStyle curve_style(const Tokens& colors, std::string_view key);
/// Of a method's curve, alike in every plot: figure 3.2's blue Verlet, green improved Euler and magenta Euler;
/// vermilion is the exact solution's.
CurveStyle integrator_style(const Tokens& colors, std::string_view name);
/// A variable of table B.1 by its key in the notation table, in its own unit.
glm::dvec3 vector_of(const ParticleReadout& readout, std::string_view key);
/// "F_s [N]", …
std::vector<std::string> force_column_names();
/// "y [m]", "y_euler [m]", … of Plots::height.
std::vector<std::string> height_column_names();
/// Magnitudes in the order of force_keys, N.
std::array<double, Plots::forces_count> force_values(const ParticleReadout& readout);
std::array<double, Plots::forces_count> force_values(const ForceSummary& summary);

}  // namespace tyglab
