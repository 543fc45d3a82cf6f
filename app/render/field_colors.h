// The scale of a colored cloth: the values that its colors represent.
#pragma once

#include <imgui.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/render/cloth_renderer.h"
#include "app/render/gl_objects.h"
#include "app/render/vertex_memory.h"
#include "core/fields/particle_field.h"

// Color scales for values: perceptually uniform, and distinguishable with color blindness. All are interpolated in
// Oklab (B. Ottosson 2020).

namespace tyglab {

/// The kind of color map.
struct ColorMap {
  /// From blue over a pale middle to vermilion, both ends equally dark; otherwise from blue over green to pale yellow,
  /// lightness rising evenly.
  bool diverging = false;
  bool on_light = false;  ///< made to be seen before a light ground: the pale end is less pale, the dark one darker
  bool operator==(const ColorMap&) const = default;
};
ImU32 map_color(const ColorMap& map, double part);
/// That many of them, from the least to the greatest.
std::vector<ImU32> map_colors(const ColorMap& map, int count);

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
  std::optional<FieldSpan> seen = {};  ///< of the values of the last look

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

// Numbers for shaders: a value of every particle, and the colors of values.

/// Lets a texture be looked up with that filter, without a repetition beyond its edges.
void set_up_texture(const gl::Texture& texture, GLint filter);

class ValueTexture {
 public:
  /// `filter`: GL_NEAREST, or GL_LINEAR between neighbors.
  explicit ValueTexture(GLint filter);
  /// Rows of numbers.
  void take(std::span<const float> values, int rows, int columns);
  /// One row of colors, as bytes red, green, blue, opacity.
  void take(std::span<const std::uint32_t> colors);
  /// Binds it to a texture unit.
  void bind(int unit) const;
  std::size_t bytes() const { return 4 * std::size_t(rows_) * std::size_t(columns_); }

 private:
  void write(GLint format, GLenum layout, GLenum type, const void* data, int rows, int columns);

  gl::Texture texture_;
  int rows_ = 0, columns_ = 0;
};

// A long list of numbers that shaders look up by index: the equivalent of a buffer texture, which OpenGL ES lacks.

class TexelArray {
 public:
  enum class Of { floats, index_pairs };
  explicit TexelArray(Of what);
  /// Takes that many texels from memory.
  void take(const void* data, std::size_t texels);
  /// Takes them from a vertex buffer; they stay on their side of the bus.
  void take(const VertexSource& source, std::size_t texels);
  /// Binds it to a texture unit. Texel k is at (k & 4095, k >> 12).
  void bind(int unit) const;
  std::size_t bytes() const;

 private:
  static constexpr std::size_t widest = 4096;  ///< which all graphics cards have that run OpenGL 3.3
  void write(const std::byte* from, std::size_t texels);

  Of of_;
  gl::Texture texture_;
  int width_ = 0, height_ = 0;
};

}  // namespace tyglab
