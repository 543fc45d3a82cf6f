// Colors and line styles of curves: one for each force, method and copy, alike in every plot.
#pragma once

#include <optional>
#include <string_view>

#include "app/ui/kit/theme.h"
#include "core/lockstep.h"

namespace tyglab {

/// Of a variable of table B.1, by its key: in plots, lists and as an arrow.
CurveStyle curve_style(const Tokens& colors, std::string_view key);
/// Of a method's curve: figure 3.2's blue Verlet, green improved Euler and magenta Euler; vermilion is the exact
/// solution's.
CurveStyle integrator_style(const Tokens& colors, std::string_view name);
/// Of a copy in lockstep, by its seat, in plots, labels and as an overlay; none: the original.
CurveStyle copy_style(const Tokens& colors, std::optional<std::size_t> seat);

}  // namespace tyglab
