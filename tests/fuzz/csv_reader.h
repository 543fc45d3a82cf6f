// A reader of tables that shares nothing with what writes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab::fuzz {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::optional<double>>> rows;  ///< empty cells hold nothing
};

/// Reads a comment line that begins with #, a line of names, and rows of numbers. If the text is anything else (rows of
/// another length, a cell that is no finite number, a control character, no line feed at the end), `problem` says what.
CsvTable read_csv(std::string_view text, std::string& problem);

}  // namespace tyglab::fuzz
