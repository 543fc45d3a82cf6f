// Protects the terminal from names, texts and messages of files and drivers, which must not control it.
//
// filter_standard_streams() puts a filter between std::cout, std::cerr and their descriptors, so all printed text
// passes through it, whoever prints it. Outputs that are files ("-") and the progress line have separate streams.
#pragma once

#include <array>
#include <cassert>
#include <cstdio>
#include <ostream>
#include <string>
#include <string_view>

namespace tyglab {

/// The text with everything that a terminal would act on spelled out: control characters except line feed and tab as
/// "\x1b", those above ASCII and marks that turn the direction of writing as "\u202e", bytes that are not UTF-8 as
/// "\x9b".
std::string visible(std::string_view text);

/// The same in one line: line feeds and tabs are spelled out too. For names within a sentence.
std::string in_one_line(std::string_view text);

/// From now on std::cout and std::cerr show text as visible() does, however it is divided. To be called once, before
/// anything is printed.
void filter_standard_streams();

/// Standard output for the content of files: as it is, but visible() where standard output is a terminal.
std::ostream& file_output();

/// Standard error without the filter, for the program's own cursor movements. All other text must pass through
/// visible().
std::ostream& cursor_output();

// Numbers as text in files: fast, independent of the locale, and always finite.

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
