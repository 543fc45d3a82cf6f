#include "core/analysis/last_event.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/analysis/study_run.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr int news_looks = 100;  // at the springs, in the whole time

/// The settings of the run, of which `steps` lie between two looks.
Preset news_settings(const Preset& preset, double seconds, int& steps) {
  Preset coarse = preset;
  coarse.integrator = "velocity_verlet", coarse.precision = Precision::double_;
  const double look = seconds / news_looks;
  const double stable = advised_dt(coarse, coarse.integrator);
  steps = stable > 0 ? std::max(1, int(std::ceil(look / stable))) : news_looks;
  coarse.dt = look / steps;
  return coarse;
}

}  // namespace

double last_event_effort(const Preset& preset, double seconds) {
  int steps = 1;
  const Preset coarse = news_settings(preset, seconds, steps);
  return step_effort(coarse) * steps * news_looks;
}

double time_of_last_event(const StudyStart& start, double seconds, const Stop& stop) {
  int steps = 1;
  const auto of = begin_study(start, news_settings(start.preset, seconds, steps));
  Simulation& simulation = *of;
  const bool bodies = !start.preset.bodies.empty();
  if (bodies) simulation.engine().note_contacts(true);
  const int torn = simulation.tears().torn_count();
  // Less than the weight of a particle is no pull: springs of a cloth that falls freely carry rounding errors.
  const ForceSummary first = simulation.forces(Reduction::maximum);
  double strongest = std::max(first.F_s, first.F_g), news = 0;
  for (int look = 1; look <= news_looks; ++look) {
    for (int step = 0; step < steps; ++step) {
      advance_study(simulation, 1, stop);
      const bool touches = bodies && !simulation.engine().contacts().empty();
      if (touches || simulation.tears().torn_count() > torn || simulation.divergence()) return seconds;
    }
    const double pull = simulation.forces(Reduction::maximum).F_s;
    if (pull > 2 * strongest) strongest = pull, news = seconds * look / news_looks;
  }
  return news;
}

double hardest_blow(const StudyStart& start, double seconds, const Stop& stop) {
  if (start.preset.bodies.empty()) return 0;
  int steps = 1;
  const auto of = begin_study(start, news_settings(start.preset, seconds, steps));
  Simulation& simulation = *of;
  simulation.engine().note_contacts(true);
  double hardest = 0;
  for (int step = 0; step < steps * news_looks && !simulation.divergence(); ++step) {
    advance_study(simulation, 1, stop);
    for (const Contact& contact : simulation.engine().contacts()) hardest = std::max(hardest, glm::length(contact.v));
  }
  return hardest;
}

}  // namespace tyglab
