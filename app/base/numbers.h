// Formats and reads numbers in panels; short_number of readable.h formats constants.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/model/readable.h"

namespace tyglab {

/// A read-out that does not dance: always three significant digits, "3.41e-3", "12.0".
std::string steady_number(double value);
/// "(1.00, -2.50e-3, 0)": each as steady_number.
std::string steady_vector(const glm::dvec3& value);
/// A simulated time, with as many decimals as show a single step of dt (three at least): "0.4213".
std::string time_number(double t, double dt);
/// Significant digits, four at least, that show the ends of a span with an error of a twentieth of the span at most.
int digits_apart(double lo, double hi);
/// What somebody typed: a comma counts as a decimal point. After it may stand the unit, or one that differs from it by
/// an SI prefix ("2 ms" where s are meant, "9,8 cm"), which is converted. None if it is not a number or has another
/// unit.
std::optional<double> typed_number(std::string_view text, std::string_view unit = {});

}  // namespace tyglab
