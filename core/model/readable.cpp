#include "core/model/notation.h"
#include "core/model/words.h"

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

std::string with_power(std::string text) {
  static constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::string shown = text.substr(0, e) + "·10";
  for (const char letter : text.substr(e + 1)) shown += letter == '-' ? "⁻" : raised[std::size_t(letter - '0')];
  return shown;
}

std::string grouped(std::int64_t count) {
  std::string text = std::to_string(count);
  const std::size_t first = count < 0 ? 1 : 0;
  for (std::size_t at = text.size(); at > first + 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string power_number(double value, int digits) {
  const std::string text = short_number(value, digits);
  const double size = std::abs(rounded(value, digits));
  if (size >= 1e4 && size < 1e5) return grouped(std::stoll(text));
  return with_power(text);
}

ScaledUnit scaled_unit(double largest, std::string_view unit) {
  static constexpr std::array<std::string_view, 4> prefixes{"", "m", "µ", "n"};
  constexpr double least = 0.0995;  // in steady_number a smaller value has an exponent
  const bool mass = unit == "kg";
  if (!(largest > 0) || !std::isfinite(largest) || unit.empty() ||
      (!mass && std::string_view("smNJ").find(unit.front()) == std::string_view::npos))
    return {1, std::string(unit)};
  double size = 1;
  std::size_t n = 0;
  while (n + 1 < prefixes.size() && largest < least * size) size /= 1000, ++n;
  if (largest < least * size) return {1, std::string(unit)};
  if (mass) return n == 0 ? ScaledUnit{1, "kg"} : ScaledUnit{size, std::string(prefixes[n - 1]) + "g"};
  return {size, std::string(prefixes[n]) + std::string(unit)};
}

std::string quantity(double value, std::string_view unit, int digits) {
  constexpr double plain = 1e-3;  // from here on short_number writes no exponent
  const double size = std::abs(rounded(value, digits));
  const ScaledUnit in = size < plain ? scaled_unit(size, unit) : ScaledUnit{1, std::string(unit)};
  return power_number(value / in.size, digits) + (in.name.empty() ? "" : " " + in.name);
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
