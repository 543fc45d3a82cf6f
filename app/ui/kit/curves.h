// Colors and line styles of curves: one for each force, method and copy, in all plots.
#pragma once

#include <optional>
#include <string_view>

#include "app/ui/kit/theme.h"
#include "core/lockstep.h"

namespace tyglab {

/// Of a variable of table B.1, by its key: in plots, lists and as an arrow.
CurveStyle curve_style(const Tokens& colors, std::string_view key);
/// Of a method's curve in every chart, legend and list: figure 3.2's blue Verlet, green improved Euler and magenta
/// Euler; "exact" is the closed form's. No two methods have the same color. Gray for a method without a row.
CurveStyle integrator_style(const Tokens& colors, std::string_view name);
/// Of a cloth among copies, in plots, labels and as an overlay: its method's or, with a seat, one that no method has.
CurveStyle copy_style(const Tokens& colors, std::string_view method, std::optional<std::size_t> seat);

}  // namespace tyglab
