#include "core/analysis/study_run.h"

#include <algorithm>
#include <cmath>

#include "core/integrators/scheme.h"

namespace tyglab {

std::unique_ptr<Simulation> begin_study(const StudyStart& start, const Preset& preset) {
  Preset on_cpu = preset;
  on_cpu.engine = EngineKind::cpu;
  auto simulation = std::make_unique<Simulation>(on_cpu);
  if (start.from) simulation->restore(*start.from);
  return simulation;
}

double step_effort(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  const double particles = preset.kind == Kind::one_weight ? 1 : double(preset.rows) * preset.columns;
  if (projects(method)) return particles * (1 + preset.iterations);
  return particles * (is_implicit(method) ? 20 : double(method.sweeps.size()));
}

void advance_study(Simulation& simulation, int steps, const Stop& stop) {
  simulation.stop_when(stop);
  const bool stopped = simulation.advance(steps).stopped;
  simulation.stop_when({});
  if (stopped) throw Stopped();
}

double whole_dt(double seconds, double dt, int& steps) {
  const double part = seconds / accuracy_samples;
  steps = std::max(1, int(std::ceil(part / dt - 1e-9)));
  return part / steps;
}

}  // namespace tyglab
