// Numbers and sentences as people read them: panels, messages, reports.
#pragma once

#include <string>

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

}  // namespace tyglab
