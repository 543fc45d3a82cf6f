#include "core/model/notation.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>

namespace tyglab {
namespace {

/// The longest beginning that is a decimal number: a minus sign, digits with a point among them, an exponent.
[[maybe_unused]] const char* end_of_number(const char* at, const char* last) {
  const auto digits = [&] {
    const char* const from = at;
    while (at != last && std::isdigit(static_cast<unsigned char>(*at)) != 0) ++at;
    return at != from;
  };
  const char* const first = at;
  if (at != last && *at == '-') ++at;
  bool any = digits();
  if (at != last && *at == '.') ++at, any = digits() || any;
  if (!any) return first;
  const char* const mantissa = at;
  if (at == last || (*at != 'e' && *at != 'E')) return mantissa;
  ++at;
  if (at != last && (*at == '-' || *at == '+')) ++at;
  return digits() ? at : mantissa;
}

/// By std::strtod, whose locale this program never sets.
template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
  if constexpr (requires { std::from_chars(first, last, value); }) {
    return std::from_chars(first, last, value);
  } else {
    const std::string text(first, end_of_number(first, last));
    if (text.empty()) return {first, std::errc::invalid_argument};
    const char* const end = first + text.size();
    const Number number = std::strtod(text.c_str(), nullptr);
    const bool nothing = text.find_first_of("123456789") == std::string::npos;
    if (std::isinf(number) || (number == 0 && !nothing)) return {end, std::errc::result_out_of_range};
    value = number;
    return {end, std::errc()};
  }
}

}  // namespace

std::from_chars_result read_number(const char* first, const char* last, double& value) {
  return read(first, last, value);
}

}  // namespace tyglab
