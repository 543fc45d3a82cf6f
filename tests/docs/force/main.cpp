// The force that docs/adding-a-force.md adds, in every method: those of the plain engine agree with it to rounding, all
// others with Verlet's method as closely as they do without the force.
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string_view>

#include "core/forces/readout.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/simulation.h"

using namespace tyglab;

namespace {

/// A hanging cloth after 0.02 s.
State moved(const Scheme& method, EngineKind engine, double k_t) {
  Preset preset;
  preset.rows = 9, preset.columns = 8, preset.precision = Precision::double_, preset.engine = engine;
  preset.integrator = method.name, preset.dt = 1e-4, preset.iterations = 100, preset.tolerance = 1e-9;
  preset.k_t = k_t;
  Simulation simulation(preset);
  simulation.advance(200);
  return simulation.read();
}

double apart(const State& a, const State& b) {
  double most = 0;
  for (std::size_t p = 0; p < a.x.x.size(); ++p)
    most = std::max(most,
                    glm::distance(glm::dvec3(a.x.x[p], a.x.y[p], a.x.z[p]), glm::dvec3(b.x.x[p], b.x.y[p], b.x.z[p])));
  return most;
}

}  // namespace

int main() {
  int wrong = 0;
  const State with = moved(scheme("verlet"), EngineKind::cpu, 20),
              without = moved(scheme("verlet"), EngineKind::cpu, 0);
  const double matters = apart(with, without);
  for (const Scheme& method : schemes()) {
    const State fast = moved(method, EngineKind::cpu, 20);
    const bool written = is_written_out(method);
    const double away = written ? apart(fast, moved(method, EngineKind::plain, 20)) : apart(fast, with);
    const double before = written ? 0 : apart(moved(method, EngineKind::cpu, 0), without);
    const double most = written ? 1e-10 : 3 * before + 0.05 * matters;  // first order leaves 2 % at this dt
    std::printf("%-20s %s %.1e m, allowed %.1e m\n", std::string(method.name).c_str(),
                written ? "from the plain engine" : "from verlet", away, most);
    wrong += !(away <= most);
  }
  std::printf("the force moves particles by %.1e m\n", matters);
  Preset preset;
  preset.k_t = 3;
  const bool named = parse_preset(preset_to_json(preset), "the page's").k_t == 3;
  const auto keys = force_keys();
  const bool read = std::find(keys.begin(), keys.end(), "F_t") != keys.end();
  std::printf("%s\n", named && read ? "presets and read-outs know it" : "presets or read-outs do not know it");
  return wrong > 0 || matters < 1e-3 || !named || !read;
}
