// What must be redone when a constant changes.
#pragma once

#include <initializer_list>

#include "core/model/preset.h"

namespace tyglab {

/// Ordered by how much must be redone. Code that compares two presets names effects, not constants.
enum class Effect {
  name,        ///< the name and the description
  view,        ///< the view
  texture,     ///< the picture on the cloth
  unused,      ///< nothing at present: a constant of the other kind, or a device while the CPU engine runs
  start,       ///< the initial state: takes effect at the next restart
  bodies,      ///< takes effect once the cloth touches a body
  tearing,     ///< takes effect once a force is large enough
  tolerance,   ///< accuracy of a method that chooses its own steps or iterates
  force,       ///< masses, forces, rest lengths: takes effect with the next step
  pins,        ///< the pinned particles
  dt,          ///< takes effect with the next step; velocities are kept
  integrator,  ///< the method's own vectors are computed again; velocities are kept
  precision,   ///< another engine takes over the state
  device,      ///< an engine on another OpenCL device takes over the state
  engine,      ///< another engine takes over the state
  rebuild      ///< the cloth is built again
};

class EffectSet {
 public:
  constexpr EffectSet() = default;
  constexpr EffectSet(Effect effect) : bits_(1u << unsigned(effect)) {}
  constexpr EffectSet(std::initializer_list<Effect> effects) {
    for (const Effect effect : effects) *this |= effect;
  }

  constexpr bool empty() const { return bits_ == 0; }
  /// Whether it has any of these.
  constexpr bool touches(EffectSet any) const { return (bits_ & any.bits_) != 0; }
  /// Whether it has only these.
  constexpr bool within(EffectSet all) const { return (bits_ & ~all.bits_) == 0; }

  constexpr EffectSet& operator|=(EffectSet other) {
    bits_ |= other.bits_;
    return *this;
  }
  friend constexpr EffectSet operator|(EffectSet a, EffectSet b) { return a |= b; }
  constexpr bool operator==(const EffectSet&) const = default;

 private:
  unsigned bits_ = 0;
};
constexpr EffectSet operator|(Effect a, Effect b) {
  return EffectSet(a) | EffectSet(b);
}

// Derives from two presets what must be redone. Every decision about a restart, a rebuild or only a different
// appearance asks changes(); no other place lists constants.

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
