// Counts in the background, about once per second, the triangles of the cloth that cross each other, while that is
// requested.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/contact/crossings.h"

namespace tyglab {

struct FoundCrossings {
  std::int64_t pairs = 0;
  bool complete = true;  ///< otherwise there are at least so many
  /// Numbers (triangle_at) of triangles that cross others, rising: all of them, or a few thousand from all over the
  /// cloth.
  std::vector<int> triangles;
};
template <class Visit>
void visit_parts(Visit&& visit, FoundCrossings& found) {
  auto& [pairs, complete, triangles] = found;
  visit(pairs, complete, triangles);
}

class CrossingWatch {
 public:
  /// Called in every frame in which the count is wanted: takes what is ready and begins what is due.
  void poll(StudyMoment& moment);
  /// Forgets the count.
  void drop();
  /// The newest count; none before the first is ready.
  const std::optional<FoundCrossings>& found() const { return found_; }
  /// The count of that moment; null while it is not ready.
  const FoundCrossings* of(const MotionMark& moment) const {
    return found_ && found_at_ == moment ? &*found_ : nullptr;
  }
  /// Of the cloth that was looked at.
  const Lattice& lattice() const { return lattice_; }

 private:
  void begin(const Simulation& simulation);

  Job<FoundCrossings> work_;
  std::optional<FoundCrossings> found_;
  Lattice lattice_;
  double begun_ = 0;                     ///< s on the session's clock; when the last look began
  std::optional<MotionMark> looked_at_;  ///< the moment of it
  std::optional<MotionMark> found_at_;   ///< the moment of the newest count
};

}  // namespace tyglab
