// Numbers as text in files: fast, independent of the locale, and always finite.
#pragma once

#include <array>
#include <cassert>
#include <cstdio>
#include <string>

namespace tyglab {

/// Appends `value` with that many significant digits. Text with 17 gives back the same double, with 9 the same float.
/// Appends nothing where it is not finite: of a table that is an empty cell.
void append_number(std::string& text, double value, int digits = 17);

/// A coordinate as a float, for a file that has no empty places. Throws OutputError if no float holds it.
float float_coordinate(double value);

/// What printf makes of it, for people; at most 511 characters.
template <class... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 512> text;
  [[maybe_unused]] const int length = std::snprintf(text.data(), text.size(), format, values...);
  assert(0 <= length && length < int(text.size()));
  return text.data();
}

}  // namespace tyglab
