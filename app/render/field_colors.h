// The scale of a colored cloth: the values that its colors represent.
#pragma once

#include <optional>
#include <span>

#include "app/render/cloth_renderer.h"
#include "app/render/color_map.h"
#include "core/fields/particle_field.h"

namespace tyglab {

/// The top of a scale that follows a quantity and does not flicker: a round number (1, 2, 3 or 5 times a power of ten)
/// that grows at once, and shrinks once it was not needed for that many looks, to what they needed.
class SteadyTop {
 public:
  static constexpr int patience = 40;
  /// Takes the greatest value of now; what is not above 0 changes nothing.
  double look(double greatest);
  double now() const { return top_; }
  void forget() { *this = SteadyTop(); }

 private:
  double top_ = 0;  ///< 0: nothing has been seen yet
  int calm_ = 0;
  double calm_top_ = 0;  ///< what would have done since it was needed last
};

/// The least end of an automatic scale, in the unit of the field. A cloth at rest has rounding noise below it, which a
/// scale without a floor would spread over all of its colors.
double least_top(ParticleField field, const Preset& preset);
/// Whether colors follow the square root of the values. A cloth that hangs from two corners has nearly all of its
/// tension there; on a linear scale the rest of the cloth would have one color.
inline bool root_scale(ParticleField field) {
  return field == ParticleField::tension;
}

struct FieldColors {
  ParticleField field;
  std::optional<double> fixed = {};  ///< the top as somebody has set it
  SteadyTop automatic = {};
  std::optional<FieldSpan> seen = {};  ///< of the values that were looked at last

  double top() const { return fixed.value_or(automatic.now() > 0 ? automatic.now() : 1); }
  ValueRange range() const { return {info(field).is_signed ? -float(top()) : 0.f, float(top()), root_scale(field)}; }
  ColorMap map(bool on_light) const { return {info(field).is_signed, on_light}; }
  /// Whether a value is beyond the scale, and has the color of its end.
  bool beyond() const;
  /// The values of a cloth with those constants have changed to ones with that span. Those of a cloth that has diverged
  /// (`wreck`) lie decades apart: the scale ends where half of them have the colors in between.
  void look(const std::optional<FieldSpan>& span, const Preset& preset, bool wreck = false);
};

/// Of the renderer's color map.
inline constexpr int map_size = 256;

}  // namespace tyglab
