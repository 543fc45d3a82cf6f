// Time series: a CSV with one column for each quantity that changes over a run.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/io/output_file.h"
#include "core/simulation.h"

namespace tyglab {

/// One plotted quantity.
struct SeriesColumn {
  std::string name;  ///< "max_F_s"
  std::string unit;  ///< "N", empty if dimensionless
};

/// A series' first two lines: a comment ("# tyglab series, t in s, " and `about`) and a header `t,NAME [UNIT],…`.
std::string series_head(std::span<const SeriesColumn> columns, const std::string& about);
/// A row: t with 17 significant digits, values with nine.
void append_series_row(std::string& text, double t, std::span<const double> values);

/// Writes a time series row by row. Every row is written as it is added, so that a run cut short leaves whole rows
/// (OutputFile).
class SeriesCsv {
 public:
  /// Begins the file, or standard output ("-"), with the header. Throws OutputError.
  SeriesCsv(const std::filesystem::path& file, std::span<const SeriesColumn> columns, const std::string& preset_hash);
  /// Appends a row: t (s) and a value for each column. Throws OutputError.
  void add(double t, std::span<const double> values);
  /// No more rows come. Throws OutputError.
  void end(Reach reach = Reach::whole) { out_.end(reach); }
  std::filesystem::path path() const { return out_.path(); }

 private:
  OutputFile out_;
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
