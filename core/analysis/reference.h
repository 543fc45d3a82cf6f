// The reference motion for the errors of integrators, and its own accuracy.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/model/preset.h"
#include "core/simulation.h"

// The scenes of `tyglab bench accuracy`, small and short enough to be predictable.

namespace tyglab {

struct AccuracyScene {
  std::string name;     ///< "hanging"
  std::string title;    ///< a few words for people
  Preset preset;        ///< integrator, dt and precision are the rows' own
  double seconds;       ///< until then positions are compared
  bool damped = false;  ///< so heavily that explicit methods need a dt far below what oscillations ask for
};

/// Times at which positions are compared: the end, and as many equal parts before it.
inline constexpr int accuracy_samples = 4;

/// A mass on a spring, then the cloths, the heavily damped ones last.
std::vector<AccuracyScene> accuracy_scenes();

/// Positions of all particles at the times of comparison, m.
using Track = std::vector<std::vector<glm::dvec3>>;

/// The same at one time, from a simulation.
std::vector<glm::dvec3> positions_of(const Simulation& simulation);
/// Root of the mean over times and particles of the squared distance, m; infinite where a value is not finite.
double rms_distance(const Track& a, const Track& b);

/// An error counts as measured from this many times the distance between two independent references on.
constexpr double reference_margin = 10;

struct Reference {
  Track track;
  std::vector<std::string> made_by;  ///< one sentence for each of two independent ones; the first is `track`
  double agreement_rms_m = 0;        ///< how far they differ; 0 for a closed form
  double predictable_s = 0;          ///< until then a perturbation of 1e-12 m stays below 1e-9 m (rms)
  bool predictable_longer = false;   ///< it did so as long as was tried
};

/// The work was asked to stop.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

/// Makes both references of a scene and measures how long it can be predicted. `quick`: a hundredfold less exact, in
/// seconds. Throws Stopped soon after `stop` says so.
Reference make_reference(const AccuracyScene& scene, bool quick, const Stop& stop);

/// The scene's motion by Boost.Odeint's Runge-Kutta-Fehlberg 7(8) with that tolerance (m and m/s), on the plain
/// cloth's forces: a cloth without bodies.
Track odeint_track(const AccuracyScene& scene, double tolerance, const Stop& stop);
/// The scene's motion by an integrator of this project in double, with `steps` steps between samples. Throws
/// std::runtime_error if it diverges.
Track own_track(const AccuracyScene& scene, const std::string& integrator, int steps, const Stop& stop);

}  // namespace tyglab
