#include "app/session/series.h"

#include <cassert>
#include <utility>

#include "core/io/text.h"

namespace tyglab {

void Series::add(double t, std::span<const double> values) {
  assert(values.size() == columns_.size());
  if (!t_.empty() && t <= t_.back()) {
    if (t == t_.back()) return;
    clear();
  }
  if (t_.size() >= most) {
    // Half at a time, so that the cost of moving is spread over many samples.
    const auto half = std::ptrdiff_t(most / 2);
    t_.erase(t_.begin(), t_.begin() + half);
    for (auto& column : columns_) column.erase(column.begin(), column.begin() + half);
    std::erase_if(gaps_, [](std::size_t gap) { return gap <= most / 2; });
    for (std::size_t& gap : gaps_) gap -= most / 2;
  }
  if (std::exchange(interrupted_, false)) gaps_.push_back(t_.size());
  t_.push_back(t);
  for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].push_back(values[k]);
}

void Series::clear() {
  t_.clear(), gaps_.clear();
  interrupted_ = false;
  for (auto& column : columns_) column.clear();
}

std::string Series::csv(std::span<const std::string> names, std::string_view comment) const {
  assert(names.size() == columns_.size());
  std::string text = "# " + std::string(comment) + "\nt";
  for (const std::string& name : names) text += "," + name;
  text += '\n';
  for (std::size_t n = 0; n < t_.size(); ++n) {
    append_number(text, t_[n], 17);
    for (const auto& column : columns_) {
      text += ',';
      append_number(text, column[n], 9);
    }
    text += '\n';
  }
  return text;
}

}  // namespace tyglab
