#include "app/studies/crossing_watch.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/analysis/self_crossings.h"

namespace tyglab {
namespace {

/// Up to `most` of the triangles, evenly.
std::vector<int> thinned(const std::vector<int>& triangles, std::size_t most) {
  const std::size_t every = triangles.size() / most + 1;
  std::vector<int> kept;
  for (std::size_t n = 0; n < triangles.size(); n += every) kept.push_back(triangles[n]);
  return kept;
}

FoundCrossings find_crossings(const VectorField<double>& x, const Tears& tears, Stop stop) {
  CrossingLimits limits;
  limits.listed = 1'000'000, limits.tested = 20'000'000, limits.stop = std::move(stop);
  const Crossings found = count_crossings(x, tears, limits);
  std::vector<int> triangles;
  for (const auto& pair : found.listed) triangles.insert(triangles.end(), pair.begin(), pair.end());
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  constexpr std::size_t most_drawn = 3000;  // outlines that a frame draws quickly
  return {found.pairs, found.complete, thinned(triangles, most_drawn)};
}

}  // namespace

void CrossingWatch::poll(StudyMoment& moment) {
  constexpr double between_looks = 1, soon = 0.03;  // s: what is ready soon is to be seen
  if (work_.working()) return moment.ask_again_in(soon);
  if (work_.ready())
    if (auto outcome = work_.take(); looked_at_ && std::holds_alternative<FoundCrossings>(outcome))
      found_ = std::move(std::get<FoundCrossings>(outcome)), found_at_ = looked_at_;
  if (moment.simulation.lattice() != lattice_) found_.reset();
  if (looked_at_ == moment.mark() || !moment.readable) return;
  const double due = begun_ + between_looks;
  if (!found_ || moment.now >= due) {
    begin(moment.simulation);
    looked_at_ = moment.mark(), begun_ = moment.now;
    moment.ask_again_in(soon);
  } else if (!moment.moving) {
    moment.ask_again_in(due - moment.now);
  }
}

void CrossingWatch::begin(const Simulation& simulation) {
  lattice_ = simulation.lattice();
  if (simulation.divergence()) {
    found_ = FoundCrossings(), found_at_.reset();
    return;
  }
  work_.start(Priority::below_frames,
              [x = dense_positions(simulation), tears = simulation.tears()](const JobControl& control) {
                return find_crossings(x, tears, [&control] { return control.cancelled(); });
              });
}

void CrossingWatch::drop() {
  work_.cancel();
  if (work_.ready()) work_.stop();
  found_.reset(), looked_at_.reset(), found_at_.reset();
}

}  // namespace tyglab
