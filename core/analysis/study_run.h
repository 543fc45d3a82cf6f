// Short runs from one state, from which studies are made.
#pragma once

#include <memory>

#include "core/analysis/error_study.h"

namespace tyglab {

/// The simulation with those settings at the start of the study, on the CPU engine: the only one that has every method,
/// and whose time is this thread's.
std::unique_ptr<Simulation> begin_study(const StudyStart& start, const Preset& preset);
/// Makes `steps` steps; fewer where the run diverges. Throws Stopped.
void advance_study(Simulation& simulation, int steps, const Stop& stop);
/// Particles times force evaluations of a step; what an implicit method needs is not known before.
double step_effort(const Preset& preset);
/// A dt of which `steps` make a part of the study (one of accuracy_samples), the largest that is at most `dt`, s.
double whole_dt(double seconds, double dt, int& steps);

}  // namespace tyglab
