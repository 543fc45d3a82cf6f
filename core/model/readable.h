// Formats numbers and sentences for people: panels, messages, reports.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace tyglab {

/// Up to that many significant digits, "310", "0.002", "1.2e-4": without an exponent from 0.001 to 100,000, where every
/// digit before the point is written.
std::string short_number(double value, int digits = 4);
/// "1.20e-04", as printf writes it, as "1.20e-4".
std::string short_exponent(std::string text);
/// Rounded to that many significant digits.
double rounded(double value, int digits);
/// With a capital at its beginning and a full stop at its end, unless it has one: "it fell" as "It fell.".
std::string sentence(std::string text);
/// The texts of a range's elements, one after the other: "cpu, opencl".
template <class Range, class Text = std::identity>
std::string joined(Range&& elements, std::string_view between = ", ", const Text& text_of = {}) {
  std::string all;
  bool first = true;
  for (const auto& element : elements) {
    if (!first) all += between;
    all += std::invoke(text_of, element);
    first = false;
  }
  return all;
}

}  // namespace tyglab
