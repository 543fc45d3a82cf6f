// Samples over simulated time, for plots and their CSV files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab {

class Series {
 public:
  explicit Series(std::size_t columns = 0) : columns_(columns) {}
  bool empty() const { return t_.empty(); }
  std::size_t size() const { return t_.size(); }
  std::span<const double> t() const { return t_; }
  std::span<const double> column(std::size_t k) const { return columns_[k]; }
  /// One value a column. Samples that do not come after the last one start a new series.
  void add(double t, std::span<const double> values);
  /// Steps pass of which there are no samples: a curve has a gap before the next one.
  void interrupt() { interrupted_ = !t_.empty(); }
  /// Samples before which there is a gap, ascending.
  std::span<const std::size_t> gaps() const { return gaps_; }
  void clear();
  std::size_t bytes() const { return t_.capacity() * sizeof(double) * (1 + columns_.size()); }
  /// Text of a CSV file like those of `tyglab run --series`: a comment, a header with t and these names ("F_s [N]"),
  /// rows with nine significant digits, t with 17.
  std::string csv(std::span<const std::string> names, std::string_view comment) const;

 private:
  static constexpr std::size_t most = 40000;
  std::vector<double> t_;
  std::vector<std::vector<double>> columns_;
  std::vector<std::size_t> gaps_;
  bool interrupted_ = false;
};

}  // namespace tyglab
