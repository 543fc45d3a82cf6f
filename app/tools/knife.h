// The knife: a held left button cuts upward, as in the report (2.3.4), or along the pointer's path.
//
// Upward it cuts springs of the particles near the path (particles_near_path); along the path it cuts the springs
// whose two ends lie on either side of the stroke (springs_across), with a rule for points on it, so that strokes that
// follow each other miss nothing. Both end in the same masks of tears, so engines know nothing of knives.
#pragma once

#include <vector>

#include "core/cloth/lattice.h"

namespace tyglab {

struct Tools;

/// Cuts what the pointer has passed since the last call.
void use_knife(Tools& tools);
/// Whether it cuts at the pointer once a step, since the cloth moves under it between two frames. A cut along the path
/// is over with the frame whose path it is.
bool cuts_between_steps(const Tools& tools);
/// The springs that a nick at the pointer would cut, if it is free over the viewport.
std::vector<SpringSite> springs_under_pointer(Tools& tools);

}  // namespace tyglab
