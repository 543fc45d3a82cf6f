#include "core/analysis/self_crossings.h"

#include "core/model/words.h"

namespace tyglab {

VectorField<double> dense_positions(const Simulation& simulation) {
  const PositionView from = simulation.positions();
  VectorField<double> x;
  x.resize(std::size_t(from.rows) * from.columns);
  std::size_t p = 0;
  for (int i = 0; i < from.rows; ++i)
    for (int j = 0; j < from.columns; ++j, ++p) {
      const glm::dvec3 at = from.at(i, j);
      x.x[p] = at.x, x.y[p] = at.y, x.z[p] = at.z;
    }
  return x;
}

Crossings self_crossings(const Simulation& simulation, const CrossingLimits& limits) {
  if (simulation.preset().kind != Kind::cloth || simulation.divergence()) return {};
  return count_crossings(dense_positions(simulation), simulation.tears(), limits);
}

std::string crossings_in_words(const Crossings& crossings) {
  if (crossings.pairs == 0) return "";
  const std::string pairs =
      grouped(crossings.pairs) + (crossings.pairs == 1 ? " pair of triangles crosses" : " pairs of triangles cross");
  std::string sentence =
      std::string("The cloth passes through itself: ") + (crossings.complete ? "" : "at least ") + pairs;
  if (crossings.around_sites > 0) sentence += ", ";
  if (crossings.around_sites > 0 && crossings.around_sites < crossings.pairs)
    sentence += grouped(crossings.around_sites) + " of them ";
  if (crossings.around_sites > 0) sentence += "around a site that has parted";
  return sentence + ".";
}

}  // namespace tyglab
