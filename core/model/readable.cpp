#include "core/model/notation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace tyglab {
namespace {

std::string print(const char* format, int precision, double value) {
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), format, precision, value);
  return short_exponent(text.data());
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

std::string short_exponent(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::size_t digit = e + 2;
  while (digit + 1 < text.size() && text[digit] == '0') text.erase(digit, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

std::string short_number(double value, int digits) {
  constexpr int whole = 5;  // digits before the point, at most
  if (!std::isfinite(value)) return std::isnan(value) ? "NaN" : value < 0 ? "-∞" : "∞";
  const double shown = rounded(value, digits), size = std::abs(shown);
  if (size == 0) return "0";
  if (size >= 1e4 && size < 1e5) return print("%.*g", whole, value);
  if (size >= 1e-3 && size < 1e5) return print("%.*g", std::max(whole, digits), shown);
  return without_idle_zeros(print("%.*e", digits - 1, value));
}

double rounded(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
  double out = value;
  read_number(text.data(), text.data() + std::string_view(text.data()).size(), out);
  return out;
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() = char(text.front() - 'a' + 'A');
  if (!text.empty() && std::string_view(".?!").find(text.back()) == std::string_view::npos) text += '.';
  return text;
}

}  // namespace tyglab
