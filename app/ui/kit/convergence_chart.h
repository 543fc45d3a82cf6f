// A chart of error over dt, in the window and as a picture.
#pragma once

#include "app/ui/kit/chart.h"
#include "core/analysis/convergence.h"

namespace tyglab {

/// The errors of a study (quiet where the reference cannot tell them), the slope through them, and the slope that the
/// method's table promises.
Chart convergence_chart(const Tokens& colors, const Convergence& study);

}  // namespace tyglab
