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

}  // namespace tyglab
