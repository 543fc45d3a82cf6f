#include "app/panels/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace tyglab {
namespace {

/// "1.20e-04" as "1.20e-4".
std::string short_exponent(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digit = e + 2;
  while (digit + 1 < text.size() && text[digit] == '0') text.erase(digit, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

std::string print(const char* format, int precision, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, precision, value);
  return short_exponent(text);
}

/// "1.200e-4" as "1.2e-4".
std::string without_idle_zeros(std::string text) {
  const std::size_t e = std::min(text.find('e'), text.size());
  if (text.find('.') == std::string::npos) return text;
  std::size_t end = e;
  while (text[end - 1] == '0') --end;
  if (text[end - 1] == '.') --end;
  return text.erase(end, e - end);
}

}  // namespace

std::string short_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "NaN" : value < 0 ? "-∞" : "∞";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 1e-3 && size < 1e5) return print("%.*g", size >= 1e4 ? 5 : 4, value);
  return without_idle_zeros(print("%.*e", 3, value));
}

std::string steady_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "NaN" : value < 0 ? "-∞" : "∞";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 0.0995 && size < 999.5)
    return print("%.*f", size < 0.9995 ? 3 : size < 9.995 ? 2 : size < 99.95 ? 1 : 0, value);
  return print("%.*e", 2, value);
}

std::string time_number(double t, double dt) {
  const int decimals = dt > 0 ? std::clamp(int(std::ceil(-std::log10(dt) - 1e-9)), 3, 9) : 3;
  return print("%.*f", decimals, t);
}

std::optional<double> typed_number(std::string_view text) {
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), ',', '.');
  const std::size_t start = plain.find_first_not_of(" \t+");
  if (start == std::string::npos) return std::nullopt;
  double value = 0;
  const char* end = plain.data() + plain.size();
  const auto [rest, error] = std::from_chars(plain.data() + start, end, value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  // A unit may follow after a space; anything else ("1e", "3..2") is a slip that must not be taken for a number.
  if (rest != end && *rest != ' ' && *rest != '\t') return std::nullopt;
  return value;
}

double rounded(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  char text[48];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  double out = value;
  std::from_chars(text, text + std::char_traits<char>::length(text), out);
  return out;
}

}  // namespace tyglab
