#include "tests/fuzz/csv_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tyglab::fuzz {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

}  // namespace

CsvTable read_csv(std::string_view text, std::string& problem) {
  CsvTable table;
  if (text.empty() || text.back() != '\n') return problem = "it does not end with a line feed", table;
  std::vector<std::string> lines(1);
  for (const char c : text.substr(0, text.size() - 1))
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  for (const std::string& line : lines)
    if (std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }))
      return problem = "it holds a control character", table;
  if (lines.size() < 2 || lines[0].empty() || lines[0][0] != '#')
    return problem = "a comment and a line of names are missing", table;
  table.columns = cells_of(lines[1]);
  for (std::size_t n = 2; n < lines.size(); ++n) {
    const std::vector<std::string> cells = cells_of(lines[n]);
    const std::string where = "line " + std::to_string(n + 1) + " ";
    if (cells.size() != table.columns.size()) return problem = where + "has another number of cells", table;
    auto& row = table.rows.emplace_back();
    for (const std::string& cell : cells) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      const bool word = cell.find_first_not_of("0123456789+-.e") != std::string::npos;
      if (!cell.empty() && (word || *end != '\0' || !std::isfinite(value)))
        return problem = where + "holds '" + cell + "'", table;
      row.push_back(cell.empty() ? std::nullopt : std::optional(value));
    }
  }
  return table;
}

}  // namespace tyglab::fuzz
