#include "app/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

std::string print(const char* format, int precision, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, precision, value);
  return with_power(short_exponent(text));
}

}  // namespace

std::string steady_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "NaN" : value < 0 ? "-∞" : "∞";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 0.0995 && size < 999.5)
    return print("%.*f", size < 0.9995 ? 3 : size < 9.995 ? 2 : size < 99.95 ? 1 : 0, value);
  return print("%.*e", 2, value);
}

std::string steady_vector(const glm::dvec3& value) {
  return "(" + steady_number(value.x) + ", " + steady_number(value.y) + ", " + steady_number(value.z) + ")";
}

std::string table_number(double value) {
  const double size = std::abs(value);
  if (size >= 99999.5) return power_number(value, 1);
  const bool fixed = (size > 0 && size < 0.0995) || size >= 999.5;
  if (!fixed) return steady_number(value);
  char text[16];
  std::snprintf(text, sizeof text, "%.*f", size < 1 ? 3 : 0, size < 0.0005 ? 0 : value);  // no "-0.000"
  return text;
}

std::string time_number(double t, double dt) {
  const int decimals = dt > 0 ? std::clamp(int(std::ceil(-std::log10(dt) - 1e-9)), 3, 9) : 3;
  return print("%.*f", decimals, t);
}

int digits_apart(double lo, double hi) {
  constexpr int least = 4, most = 12;
  const double larger = std::max(std::abs(lo), std::abs(hi)), span = std::abs(hi - lo);
  if (!(span > 0) || !std::isfinite(larger)) return least;
  // The last of n digits counts 10^(⌊lg larger⌋ + 1 − n), and rounding is off by half of that.
  const double digits = std::floor(std::log10(larger)) + 1 - std::log10(span / 10);
  return std::clamp(int(std::ceil(digits - 1e-9)), least, most);
}

namespace {

/// A unit as a keyboard has it: "m/s^2" and "m/s²" are "m/s2", and no spaces.
std::string plain_unit(std::string_view unit) {
  std::string plain;
  for (std::size_t n = 0; n < unit.size(); ++n) {
    if (unit.substr(n, 2) == "²")
      plain += '2', ++n;
    else if (unit.substr(n, 2) == "µ")
      plain += 'u', ++n;
    else if (unit[n] != ' ' && unit[n] != '\t' && unit[n] != '^')
      plain += unit[n];
  }
  return plain;
}

/// "1.2·10⁻⁴", as read-outs have it, as "1.2e-4".
std::string with_exponent(std::string text) {
  static constexpr std::array<std::string_view, 11> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹", "⁻"};
  constexpr std::string_view power = "·10";
  std::size_t at = text.find(power);
  if (at == std::string::npos) return text;
  text.replace(at, power.size(), "e");
  for (++at; at < text.size(); ++at)
    for (std::size_t n = 0; n < raised.size(); ++n)
      if (text.compare(at, raised[n].size(), raised[n]) == 0)
        text.replace(at, raised[n].size(), n < 10 ? std::to_string(n) : "-");
  return text;
}

/// What a number in the unit `typed` is in `unit`, as a factor.
std::optional<double> factor_of(std::string_view typed, std::string_view unit) {
  struct Prefix {
    char letter;
    double factor;
  };
  static constexpr std::array<Prefix, 6> prefixes{
      {{'n', 1e-9}, {'u', 1e-6}, {'m', 1e-3}, {'c', 1e-2}, {'k', 1e3}, {'M', 1e6}}};
  const std::string from = plain_unit(typed), to = plain_unit(unit);
  if (from.empty() || from == to) return 1;
  if (to == "kg" && from == "g") return 1e-3;
  if (to == "kg" && from == "mg") return 1e-6;
  for (const Prefix& prefix : prefixes)
    if (!to.empty() && from == prefix.letter + to) return prefix.factor;
  return std::nullopt;
}

}  // namespace

std::optional<double> typed_number(std::string_view text, std::string_view unit) {
  std::string plain = with_exponent(std::string(text));
  std::replace(plain.begin(), plain.end(), ',', '.');
  const std::size_t start = plain.find_first_not_of(" \t+");
  if (start == std::string::npos) return std::nullopt;
  double value = 0;
  const char* end = plain.data() + plain.size();
  const auto [rest, error] = read_number(plain.data() + start, end, value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  // Anything else after it ("1e", "3..2") is a slip that must not be taken for a number.
  const auto factor = factor_of({rest, std::size_t(end - rest)}, unit);
  if (!factor) return std::nullopt;
  return value * *factor;
}

}  // namespace tyglab
