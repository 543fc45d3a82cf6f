// The summary of `tyglab bench accuracy`: the fastest method for each error.
#include <algorithm>
#include <cmath>

#include "core/analysis/accuracy.h"

namespace tyglab {

namespace {

/// Whether the limit of stability lies between two rows: a wild motion, and then a better one than any order explains.
bool stability_between(const AccuracyRow& coarse, const AccuracyRow& fine) {
  if (coarse.status == AccuracyStatus::diverged) return true;
  if (fine.tolerance) return false;
  constexpr double highest_order = 8.5;
  return coarse.error_rms_m > fine.error_rms_m * std::pow(coarse.dt / fine.dt, highest_order);
}

}  // namespace

std::optional<Reached> reached(std::span<const AccuracyRow> rows, double error) {
  const auto good = [&](const AccuracyRow& row) {
    return row.status != AccuracyStatus::diverged && row.error_rms_m <= error;
  };
  const auto first = std::find_if(rows.begin(), rows.end(), good);
  if (first == rows.end()) return std::nullopt;
  if (first == rows.begin() || stability_between(*(first - 1), *first)) return Reached{first->seconds, true};
  const AccuracyRow &coarse = *(first - 1), &fine = *first;
  const double part = std::log(coarse.error_rms_m / error) / std::log(coarse.error_rms_m / fine.error_rms_m);
  const double seconds = coarse.seconds * std::pow(fine.seconds / coarse.seconds, part);
  return Reached{std::min(seconds, fine.seconds), false};
}

std::vector<std::span<const AccuracyRow>> by_method(std::span<const AccuracyRow> rows) {
  std::vector<std::span<const AccuracyRow>> methods;
  const auto differ = [](const AccuracyRow& a, const AccuracyRow& b) {
    return a.scene != b.scene || a.integrator != b.integrator || a.precision != b.precision || a.engine != b.engine;
  };
  for (std::size_t from = 0, n = 1; n <= rows.size(); ++n)
    if (n == rows.size() || differ(rows[n - 1], rows[n])) methods.push_back(rows.subspan(from, n - from)), from = n;
  return methods;
}

std::vector<AccuracyWinner> accuracy_winners(std::span<const AccuracyRow> rows, const Reference& reference) {
  std::vector<AccuracyWinner> winners;
  for (int decade = -2; decade >= -6; --decade) {
    AccuracyWinner winner;
    winner.error_rms_m = std::pow(10, decade);
    if (!can_tell(reference, winner.error_rms_m)) break;
    for (const auto method : by_method(rows)) {
      const auto at = reached(method, winner.error_rms_m);
      if (!at) continue;
      const AccuracyRow& row = method.front();
      if (row.engine != EngineKind::cpu) continue;  // another clock
      if (row.integrator.starts_with("odeint_")) {
        if (winner.odeint.empty() || at->seconds < winner.odeint_seconds)
          winner.odeint = row.integrator, winner.odeint_precision = row.precision, winner.odeint_seconds = at->seconds;
      } else if (winner.integrator.empty() || at->seconds < winner.seconds) {
        winner.scene = row.scene, winner.integrator = row.integrator, winner.precision = row.precision;
        winner.seconds = at->seconds, winner.at_largest_dt = at->at_largest_dt;
      }
    }
    if (!winner.integrator.empty()) winners.push_back(winner);
  }
  return winners;
}

}  // namespace tyglab
