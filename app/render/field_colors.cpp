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

void FieldColors::look(const std::optional<FieldSpan>& span, bool wreck) {
  seen = span;
  if (!span) return;
  if (wreck) {
    automatic.forget();
    automatic.look(span->middle > 0 ? double(span->middle) : double(span->usual));
    return;
  }
  const double most = std::max(std::abs(double(span->least)), std::abs(double(span->most)));
  // Where hardly anything is not 0, that is what is to be seen.
  automatic.look(span->usual > 1e-3 * most ? double(span->usual) : most);
}

bool FieldColors::beyond() const {
  return seen && (seen->most > top() * (1 + 1e-6) || (info(field).is_signed && seen->least < -top() * (1 + 1e-6)));
}

}  // namespace tyglab
