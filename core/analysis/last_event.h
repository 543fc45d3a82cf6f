// Finds the time of the last event that is new in a motion, and that a shorter trial would therefore miss.
#pragma once

#include "core/analysis/error_study.h"

namespace tyglab {

/// Time from the start, s, of the last new event within `seconds`: a contact, a tear, or springs that pull a particle
/// more than twice as hard as ever before (a slack cloth becomes taut). In a motion that touches a body, tears or
/// diverges new events can always follow, and the result is `seconds`. It makes one run with a coarse step. Throws
/// Stopped.
double time_of_last_event(const StudyStart& start, double seconds, const Stop& stop);
/// The hardest impact of a body within `seconds`: the largest sudden change of a particle's velocity, m/s; 0 without
/// contact. It makes a run of this kind too. Throws Stopped.
double hardest_blow(const StudyStart& start, double seconds, const Stop& stop);
/// Effort of such a run: particles times force evaluations.
double last_event_effort(const Preset& preset, double seconds);

}  // namespace tyglab
