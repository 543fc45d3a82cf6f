// Samples for the plots of the forces and of a weight's height, recorded while a plot needs them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/series.h"
#include "core/model/notation.h"
#include "core/simulation.h"

namespace tyglab {

/// What the force plot follows.
enum class Source { particle, sum, maximum };

struct Recorded {
  static constexpr int forces_count = 7;
  Source chosen = Source::particle;  ///< force_source() is what it follows
  bool paused = false;
  std::int64_t sampled = 0;                                    ///< of Session::steps_made, those with a sample
  Series forces{forces_count};                                 ///< N, by force_keys
  Series height{5};                                            ///< m, of the weight, then by ReferenceCurves::curves
  std::vector<std::pair<double, std::string>> height_methods;  ///< from which t on (s) which method moved the weight

  void clear() { forces.clear(), height.clear(); }
};

/// Keys of the plotted forces, in the order of Recorded::forces' columns.
inline constexpr std::array<std::string_view, Recorded::forces_count> force_keys{"F",   "F_s",   "F_b",  "F_d",
                                                                                 "F_g", "F_int", "F_ext"};
const Variable& variable(std::string_view key);
/// A variable of table B.1 by its key in the notation table, in its own unit.
glm::dvec3 vector_of(const ParticleReadout& readout, std::string_view key);
/// "F_s [N]", …
std::vector<std::string> force_column_names();
/// "y [m]", "y_euler [m]", … of Recorded::height.
std::vector<std::string> height_column_names();

struct Session;
/// What the force plot follows: of a weight the weight, whatever was chosen for cloths.
Source force_source(const Session& session);
/// Takes the samples that are wanted of the steps just made.
void sample(Session& session);
/// How many steps apart samples are taken within a frame, so that what is plotted does not depend on how often pictures
/// are drawn; more than there are in a frame where a sample costs much, as on a device or of a sum over the cloth.
int steps_between_samples(const Session& session);

}  // namespace tyglab
