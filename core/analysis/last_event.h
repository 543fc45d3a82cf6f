// Finds the time of the last event that is new in a motion, and that a shorter trial would therefore miss.
#pragma once

#include "core/analysis/error_study.h"

namespace tyglab {

/// Time from the start, s, after which nothing new happens within `seconds`: no contact, no tear, and nowhere do
/// springs pull more than twice as hard at a particle as they have before (a slack cloth that is caught). In a motion
/// that touches a body, tears or diverges no end is early enough, and it is `seconds` itself. By one run with a coarse
/// step. Throws Stopped.
double last_news(const StudyStart& start, double seconds, const Stop& stop);
/// The hardest blow of a body within `seconds`: by how much it changes a particle's velocity at once, m/s; 0 where
/// nothing touches one. By the same kind of run. Throws Stopped.
double hardest_blow(const StudyStart& start, double seconds, const Stop& stop);
/// Particles times force evaluations of such a run.
double last_news_effort(const Preset& preset, double seconds);

}  // namespace tyglab
