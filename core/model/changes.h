// Derives from two presets what must be redone. Every decision about a restart, a rebuild or only a different
// appearance asks changes(); no other place lists constants.
#pragma once

#include "core/model/effect.h"
#include "core/model/preset.h"

namespace tyglab {

/// The name and the appearance of a scene.
inline constexpr EffectSet appearance{Effect::name, Effect::view, Effect::texture};
/// Everything that does not affect the motion.
inline constexpr EffectSet motionless = appearance | Effect::unused;

/// The effects of a change from one preset to the other; empty if they are equal.
EffectSet changes(const Preset& from, const Preset& to);

/// Applies the changes between `before` and `after` to `present`: field by field, bodies and pins as a whole. The
/// result may be invalid (pins outside a smaller cloth): check_preset.
Preset merge(const Preset& before, const Preset& after, Preset present);

/// Clears all fields with these effects: texts become empty, other fields get their defaults.
Preset cleared(Preset preset, EffectSet effects);

}  // namespace tyglab
