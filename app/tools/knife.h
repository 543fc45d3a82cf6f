// The knife: dragging with the left button cuts upward, as in the report (2.3.4), or along the pointer's path.
//
// An upward cut removes springs of the particles near the path (particles_near_path). A cut along the path removes the
// springs whose two ends lie on different sides of the stroke (springs_across), with a rule for points on it, so
// consecutive strokes miss nothing. Both produce masks of tears, so engines need no code for knives.
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
