// What must be redone when a constant changes.
#pragma once

#include <initializer_list>

namespace tyglab {

/// From what touches least to what touches most. Whoever asks whether two presets differ names effects, not constants.
enum class Effect {
  name,     ///< how the scene is called and described
  view,     ///< how it is looked at
  texture,  ///< the picture on the cloth
  unused,   ///< nothing, as the preset is: a constant of the other kind, a device that the CPU engine does not ask for
  start,    ///< where and how the cloth begins: counts at the next restart
  bodies,   ///< counts once the cloth meets one
  tearing,  ///< counts once a force is that large
  tolerance,   ///< how far a method goes that chooses its own steps or iterates
  force,       ///< masses, forces, rest lengths: counts from the next step
  pins,        ///< which particles stay where they are
  dt,          ///< counts from the next step; velocities are kept
  integrator,  ///< the method's own vectors are made again; velocities are kept
  precision,   ///< another engine takes over the state
  device,      ///< the same, on another OpenCL device
  engine,      ///< the same
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
  /// Whether it has none but these.
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

}  // namespace tyglab
