// Derives from two presets what must be redone. Every decision about a restart, a rebuild or only a different
// appearance asks changes(); no other place lists constants.
#pragma once

#include "core/model/effect.h"
#include "core/model/preset.h"

namespace tyglab {

/// How a scene is called and looks.
inline constexpr EffectSet appearance{Effect::name, Effect::view, Effect::texture};
/// What no motion depends on.
inline constexpr EffectSet motionless = appearance | Effect::unused;

/// What a change from one preset to the other asks for; empty where they are equal.
EffectSet changes(const Preset& from, const Preset& to);

/// What was changed from `before` to `after`, changed in `present`: field by field, bodies and pins as a whole. The
/// result may be invalid (pins outside a smaller cloth): check_preset.
Preset merge(const Preset& before, const Preset& after, Preset present);

/// With everything of these effects cleared: words are empty, the rest is as by default.
Preset cleared(Preset preset, EffectSet effects);

}  // namespace tyglab
