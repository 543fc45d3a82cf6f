// Advice after a divergence: a sentence with numbers from linear theory (docs/model.md, "What the shape
// decides").
#pragma once

#include <optional>
#include <string>

#include "core/integrators/scheme.h"
#include "core/integrators/step_control.h"
#include "core/model/preset.h"

namespace tyglab {

/// The worst-case limit: largest dt at which the method is stable for any configuration of the cloth, by its
/// linearisation (worst_modes); 0 where no dt is. From the method's own table (modes.h). One-sided springs
/// switch, so it is advice and no guarantee.
double stable_dt(const Preset& preset, const std::string& integrator);

/// 0.9 of it, s, in the two digits in which it is said; 0 where no dt is stable, infinity where every one is.
double advised_dt(const Preset& preset, const std::string& integrator);

/// Whether inner steps did not keep the tolerance, and what to do: a sentence, or nothing where all did.
std::string tolerance_missed(const Preset& preset, const InnerSteps& inner);

/// "the cloth has 18,000 times the energy the scene can supply"; `excess`: Simulation::excess().
std::string excess_in_words(double excess, const Preset& preset);
/// Whether the motion has more energy than it can have been given, and what to do, likewise.
std::string energy_in_excess(double excess, const Preset& preset);

/// "12 of 3,400 steps stopped early"; `steps`: that have been made.
std::string stopped_early(const SolveCounts& solves, std::int64_t steps);
/// Whether steps of an implicit method did not converge, and what to do, likewise.
std::string solves_missed(const SolveCounts& solves, std::int64_t steps, const Preset& preset);

/// Whether rounding positions to the preset's precision changes the force of a spring by more than F_max, so that it
/// tears by that, or by more than implicit steps can balance, and what to do: likewise. It is known before the first
/// step.
std::string precision_too_coarse(const Preset& preset);

/// What linear theory says of the method at the preset's dt, as the cause of a divergence (zones.h): words that go on
/// after a colon.
std::string method_to_blame(const Preset& preset);

/// What to change so that the preset does not diverge again.
std::string advice(const Preset& preset);

/// Whether weight and wind stretch springs to a thousand times their rest length by any method: all that pulls is more
/// than all springs of a seam across the cloth can hold there, and dt is one that linear theory calls stable.
bool springs_too_weak(const Preset& preset);
/// What to change where they do.
std::string advice_for_weak_springs(const Preset& preset);

/// The preset with the change of integrator and dt that advice() names first, made; none where it names none.
std::optional<Preset> suggested_fix(const Preset& preset);

/// The preset with the dt that is advised for its own method; none where it has it already, or none is stable.
std::optional<Preset> with_advised_dt(const Preset& preset);

}  // namespace tyglab
