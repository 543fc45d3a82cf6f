// The visual distinction of the cloths while there are copies.
#pragma once

#include "app/session/copies.h"
#include "app/session/session.h"
#include "app/ui/kit/curves.h"

namespace tyglab {

/// Of the n-th cloth (n = Copies::original or a copy), the same in plots, labels and as an overlay.
inline CurveStyle cloth_style(const Tokens& colors, const Session& session, int n) {
  return copy_style(colors, cloth_of(session, n).preset().integrator, seat_of_style(session, n));
}

}  // namespace tyglab
