// Another program that uses tyglab::core: a cloth, a second of it, and where its lowest particle is.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/simulation.h"

int main() {
  tyglab::Preset preset;
  preset.rows = preset.columns = 16;
  tyglab::Simulation simulation(preset);
  const auto lowest = [&] { return std::ranges::min(simulation.read().x.y); };
  const double before = lowest();
  simulation.advance(1000);
  std::cout << "The lowest particle went from y = " << before << " m to " << lowest() << " m in " << simulation.time()
            << " s.\n";
  const bool good = !simulation.divergence() && std::abs(simulation.time() - 1) < 1e-9 && lowest() < before;
  return good ? 0 : 1;
}
