// The map of stiffness against dt, filled by short runs in the background while it is requested.
#pragma once

#include <optional>
#include <vector>

#include "app/studies/job.h"
#include "app/studies/moment.h"
#include "core/analysis/stability_map.h"

namespace tyglab {

/// The results of a map.
struct MapFindings {
  Preset of;  ///< the constants; its stiffness and dt are those with which it began
  MapGrid grid;
  MapBoundary boundary;
  std::vector<MapCell> cells;
  std::string problem;  ///< why there are no more
};

template <class Visit>
void visit_parts(Visit&& visit, MapFindings& map) {
  auto& [of, grid, boundary, cells, problem] = map;
  visit(of, grid, boundary, cells, problem);
}

class MapWatch {
 public:
  static constexpr int columns = 28, rows = 20;
  static constexpr int largest = 128 * 128;  ///< particles of a cloth that is mapped

  /// Called in every frame in which the map is wanted: begins one where there is none, or where constants other than
  /// stiffness and dt have changed or these have left it.
  void poll(StudyMoment& moment);
  /// Stops and discards the map once nothing requests it.
  void drop();
  /// A copy of the results; none while there are none.
  std::optional<MapFindings> findings() const;
  bool working() const { return work_.working(); }

 private:
  using Work = Study<MapFindings>;
  void begin(const StudyMoment& moment);

  Work work_;
  double changed_ = -1;  ///< s on the session's clock; when the constants last differed from the map's
};

}  // namespace tyglab
