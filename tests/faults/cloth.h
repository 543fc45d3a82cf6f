// What a simulation is at a moment, and where it goes, as text to be compared: for tests that let it fail.
#pragma once

#include <sstream>
#include <string>

#include "core/io/preset_io.h"
#include "core/simulation.h"

namespace tyglab::test {

/// Every bit of it that can be seen from outside, read without a change to it.
inline std::string told(const Simulation& cloth) {
  std::ostringstream text;
  text.precision(17);
  text << cloth.steps() << ' ' << cloth.time() << ' ' << cloth.tears().torn_count() << ' '
       << cloth.divergence().has_value() << ' ' << cloth.engine().name() << ' ';
  if (const auto held = cloth.held()) text << "held " << held->i << ' ' << held->j << ' ';
  std::uint64_t hash = 14695981039346656037u;
  const auto take = [&](double value) { hash = (hash ^ std::hash<double>()(value)) * 1099511628211u; };
  const Lattice& lattice = cloth.lattice();
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const StoredParticle p = cloth.engine().stored(i, j);
      for (int c = 0; c < 3; ++c) take(p.x[c]), take(p.v[c]), take(p.v_seen[c]);
      take(cloth.pinned(i, j));
      for (int d = 0; d < stretch_directions; ++d) take(cloth.tears().whole(d, i, j));
    }
  text << hash << '\n' << preset_to_json(cloth.preset());
  return text.str();
}

/// The same after some more steps, by which a cloth shows what it has kept inside.
inline std::string told_later(Simulation& cloth, int steps = 12) {
  cloth.advance(steps);
  return told(cloth);
}

}  // namespace tyglab::test
