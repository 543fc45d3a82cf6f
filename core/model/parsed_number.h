// Reads numbers from text, independently of the locale.
#pragma once

#include <charconv>
#include <string_view>

namespace tyglab {

/// std::from_chars, where the library has it for doubles; otherwise the same of what C reads.
std::from_chars_result read_number(const char* first, const char* last, double& value);

}  // namespace tyglab
