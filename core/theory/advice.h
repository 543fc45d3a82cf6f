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
/// linearization (worst_modes); 0 where no dt is. From the method's own table (modes.h). One-sided springs switch, so
/// the limit is a guide, not a guarantee.
double stable_dt(const Preset& preset, const std::string& integrator);

/// 0.9 of that limit, s, in the two digits that messages show; 0 if no dt is stable, infinity if every dt is.
double advised_dt(const Preset& preset, const std::string& integrator);

/// A sentence about inner steps that missed the tolerance, and a remedy; empty if none did.
std::string tolerance_missed(const Preset& preset, const InnerSteps& inner);

/// "the cloth has 18,000 times the energy the scene can supply"; `excess`: Simulation::excess().
std::string excess_in_words(double excess, const Preset& preset);
/// A sentence about energy that the scene cannot have supplied, and a remedy; empty if there is none.
std::string energy_in_excess(double excess, const Preset& preset);

/// "12 of 3,400 steps stopped early", or that rounding is the reason, and the remedy; `steps`: the number of steps
/// made.
std::string unsolved(const SolveCounts& solves, std::int64_t steps, const Preset& preset);
/// A sentence about steps that did not converge, and a remedy; empty if all did.
std::string solves_missed(const SolveCounts& solves, std::int64_t steps, const Preset& preset);

/// Whether rounding positions to the preset's precision changes the force of a spring by more than F_max, so that it
/// tears by that, or by more than implicit steps can balance, and what to do: likewise. It is known before the first
/// step.
std::string precision_too_coarse(const Preset& preset);

/// The part of the method in a divergence, by linear theory at the preset's dt (zones.h): words that follow a colon.
std::string method_to_blame(const Preset& preset);

/// The changes after which the preset does not diverge again.
std::string advice(const Preset& preset);

/// Whether weight and wind stretch springs to a thousand times their rest length with any method: the pull exceeds the
/// force of all springs of a seam across the cloth, and linear theory calls dt stable.
bool springs_too_weak(const Preset& preset);
/// Advice for such a preset.
std::string advice_for_weak_springs(const Preset& preset);

/// The preset with the change of integrator and dt that advice() names first; none if it names none.
std::optional<Preset> suggested_fix(const Preset& preset);

/// The preset with the advised dt of its own method; none if it has that dt already, or no dt is stable.
std::optional<Preset> with_advised_dt(const Preset& preset);

}  // namespace tyglab
