// Time series: how a few quantities change over a run, as a CSV with a column each.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/simulation.h"

namespace tyglab {

/// One plotted quantity.
struct SeriesColumn {
  std::string name;  ///< "max_F_s"
  std::string unit;  ///< "N", empty if dimensionless
};

/// Writes a time series row by row: a comment, which names the unit of t; a header `t,NAME [UNIT],…`; rows with nine
/// significant digits. Every row is on its way as soon as it is added, so that a run cut short leaves whole rows.
class SeriesCsv {
 public:
  /// Creates the file (or takes standard output, "-") and writes the header. Throws OutputError.
  SeriesCsv(const std::filesystem::path& file, std::span<const SeriesColumn> columns, const std::string& preset_hash);
  /// Appends a row: t (s) and a value for each column. Throws OutputError.
  void add(double t, std::span<const double> values);

 private:
  void check();

  std::filesystem::path file_;
  std::ofstream own_;
  std::ostream& out_;  ///< own_ or file_output()
  std::string row_;
};

/// What `run --series` writes of a scene of that kind.
std::vector<SeriesColumn> series_columns(Kind kind);
/// The present values of those columns.
std::vector<double> series_values(Simulation& simulation);

/// What `run --ledger` writes: every row of the energy ledger, J, and its share.
std::vector<SeriesColumn> ledger_columns();
std::vector<double> ledger_values(const LedgerReading& reading);

}  // namespace tyglab
