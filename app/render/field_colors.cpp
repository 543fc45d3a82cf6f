
#include "app/render/field_colors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyglab {
namespace {

constexpr std::array<double, 4> leads{1, 2, 3, 5};

/// The least round number that is at least the value.
double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double lead : leads)
    if (value <= lead * power * (1 + 1e-9)) return lead * power;
  return 10 * power;
}

}  // namespace

double SteadyTop::look(double greatest) {
  if (!(greatest > 0) || !std::isfinite(greatest)) return top_;
  const double wanted = round_up(greatest);
  if (wanted >= top_ * (1 - 1e-9)) {
    top_ = wanted, calm_ = 0, calm_top_ = 0;
    return top_;
  }
  calm_top_ = std::max(calm_top_, wanted);
  if (++calm_ >= patience) top_ = calm_top_, calm_ = 0, calm_top_ = 0;
  return top_;
}

double least_top(ParticleField field, const Preset& preset) {
  constexpr double standard_gravity = 9.82, part = 1e-3;
  const double g = preset.g != 0 ? std::abs(preset.g) : standard_gravity;
  const double size = preset.L * std::hypot(preset.rows - 1, preset.columns - 1);
  const double speed = part * std::sqrt(2 * g * size);  // a thousandth of that of a fall through the cloth's own size
  switch (field) {
    case ParticleField::tension:
      return preset.m * g;
    case ParticleField::strain:
      return part;
    case ParticleField::speed:
      return speed;
    case ParticleField::kinetic:
      return preset.m * speed * speed / 2;
    case ParticleField::distance:
      return part * part * size;  // methods that are compared differ by little
  }
  return 0;
}

void FieldColors::look(const std::optional<FieldSpan>& span, const Preset& preset, bool wreck) {
  seen = span;
  if (!span) return;
  const double least = least_top(field, preset);
  if (wreck) {
    automatic.forget();
    automatic.look(std::max(least, span->middle > 0 ? double(span->middle) : double(span->usual)));
    return;
  }
  const double most = std::max(std::abs(double(span->least)), std::abs(double(span->most)));
  // Where nearly all values are 0, the few others decide.
  automatic.look(std::max(least, span->usual > 1e-3 * most ? double(span->usual) : most));
}

bool FieldColors::beyond() const {
  return seen && (seen->most > top() * (1 + 1e-6) || (info(field).is_signed && seen->least < -top() * (1 + 1e-6)));
}

namespace {

/// Lightness and the two opponent axes.
struct Oklab {
  double L, a, b;
};

using Anchors = std::array<Oklab, 3>;

// Lightness keeps away from the ground's at the end that is near it: 3 to 1 at least for blue on dark grounds.
constexpr Anchors magnitude_on_dark{{{0.54, -0.02, -0.14}, {0.745, -0.12, 0.02}, {0.95, -0.03, 0.12}}};
constexpr Anchors magnitude_on_light{{{0.28, 0.01, -0.11}, {0.56, -0.09, 0.01}, {0.84, -0.02, 0.14}}};
// Blue against vermilion is what every kind of color blindness tells apart.
constexpr Anchors diverging_on_dark{{{0.52, -0.03, -0.15}, {0.90, 0.00, 0.005}, {0.52, 0.14, 0.09}}};
constexpr Anchors diverging_on_light{{{0.42, -0.02, -0.14}, {0.86, 0.00, 0.005}, {0.42, 0.12, 0.08}}};

double encoded(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

ImU32 srgb(const Oklab& lab) {
  const double l = std::pow(lab.L + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3),
               m = std::pow(lab.L - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3),
               s = std::pow(lab.L - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  const std::array<double, 3> rgb{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                  -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  const auto byte = [](double linear) { return int(std::lround(255 * encoded(linear))); };
  return IM_COL32(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), 255);
}

ImU32 between(const Anchors& anchors, double part) {
  const double at = std::clamp(part, 0.0, 1.0) * double(anchors.size() - 1);
  const auto n = std::min(std::size_t(at), anchors.size() - 2);
  const double t = at - double(n);
  const Oklab &from = anchors[n], &to = anchors[n + 1];
  return srgb({std::lerp(from.L, to.L, t), std::lerp(from.a, to.a, t), std::lerp(from.b, to.b, t)});
}

}  // namespace

ImU32 map_color(const ColorMap& map, double part) {
  if (map.diverging) return between(map.on_light ? diverging_on_light : diverging_on_dark, part);
  return between(map.on_light ? magnitude_on_light : magnitude_on_dark, part);
}

std::vector<ImU32> map_colors(const ColorMap& map, int count) {
  std::vector<ImU32> colors;
  for (int k = 0; k < count; ++k) colors.push_back(map_color(map, double(k) / (count - 1)));
  return colors;
}

void set_up_texture(const gl::Texture& texture, GLint filter) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
}

ValueTexture::ValueTexture(GLint filter) {
  set_up_texture(texture_, filter);
}

void ValueTexture::take(std::span<const float> values, int rows, int columns) {
  write(GL_R32F, GL_RED, GL_FLOAT, values.data(), rows, columns);
}

void ValueTexture::take(std::span<const std::uint32_t> colors) {
  write(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, colors.data(), 1, int(colors.size()));
}

/// Keeps its storage while the size stays.
void ValueTexture::write(GLint format, GLenum layout, GLenum type, const void* data, int rows, int columns) {
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  if (rows == rows_ && columns == columns_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, layout, type, data);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, format, columns, rows, 0, layout, type, data);
    rows_ = rows, columns_ = columns;
  }
  glBindTexture(GL_TEXTURE_2D, 0);
}

void ValueTexture::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

namespace {

struct Format {
  GLint internal;
  GLenum layout, type;
  std::size_t bytes;
};

constexpr Format format_of(TexelArray::Of what) {
  if (what == TexelArray::Of::floats) return {GL_R32F, GL_RED, GL_FLOAT, 4};
  return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8};
}

}  // namespace

TexelArray::TexelArray(Of what) : of_(what) {
  set_up_texture(texture_, GL_NEAREST);
}

void TexelArray::take(const void* data, std::size_t texels) {
  write(static_cast<const std::byte*>(data), texels);
}

void TexelArray::take(const VertexSource& source, std::size_t texels) {
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, source.buffer);
  write(reinterpret_cast<const std::byte*>(source.offset), texels);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

/// From memory, or from that offset in the buffer bound for it. Keeps the texture's storage while its size stays.
void TexelArray::write(const std::byte* from, std::size_t texels) {
  if (texels == 0) return;
  const Format format = format_of(of_);
  const std::size_t width = std::min(texels, widest), full = texels / width, rest = texels % width;
  const int height = int(full + (rest > 0));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  if (int(width) != width_ || height != height_) {
    width_ = int(width), height_ = height;
    GLint source = 0;  // storage alone is asked for here, not a copy
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &source);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, format.internal, width_, height_, 0, format.layout, format.type, nullptr);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(source));
  }
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, int(full), format.layout, format.type, from);
  if (rest > 0) {
    // An offset in a buffer is no pointer to add to.
    const auto last = std::uintptr_t(from) + full * width * format.bytes;
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, int(full), int(rest), 1, format.layout, format.type,
                    reinterpret_cast<const void*>(last));
  }
  glBindTexture(GL_TEXTURE_2D, 0);
}

void TexelArray::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

std::size_t TexelArray::bytes() const {
  return std::size_t(width_) * std::size_t(height_) * format_of(of_).bytes;
}

}  // namespace tyglab
