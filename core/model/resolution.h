// Changes the number of particles of a cloth and keeps its size, mass and stiffness (docs/model.md, Resolution).
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Multiplies R-1 and C-1 by q and keeps size, mass and stretch behavior of the cloth.
Preset with_resolution(const Preset& preset, double q);
/// Of two resolutions of one cloth: the particle in `to` nearest to where `site` lies in `from`.
Pins::Site site_in_resolution(Pins::Site site, const Preset& from, const Preset& to);

}  // namespace tyglab
