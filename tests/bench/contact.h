// `tyglab bench contact` measures what contact of the cloth with itself costs, with nothing near and in a crumpled
// sheet, and what a plain hash grid would cost there.
#pragma once

#include <cstdint>
#include <vector>

#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

struct ContactRow {
  int side = 0;
  int rounds = 0;
  double ns_off = 0;        ///< of a particle and step of a cloth that begins to swing, without contact: median
  double ns_apart = 0;      ///< with the guard and nothing near: ns_off times the median ratio
  double ns_pile = 0;       ///< in the crumpled sheet: median
  double ns_hash_grid = 0;  ///< of a search there without memory of the step before, for a particle: median
  double pairs = 0;         ///< nearer than the force reaches, for each particle of the crumpled sheet
  double bytes_apart = 0;   ///< of contact alone, for each particle
  double bytes_pile = 0;
};

/// A sheet without gravity that its own momentum crumples.
Preset crumpling_sheet(int side);
/// Where it starts.
State crumpling_start(const Preset& preset);

/// How many pairs of a particle and a triangle, or of two edges, that share no particle are nearer than `below`, m: all
/// are put into a hash grid by their middles. Of a cloth without tears.
std::int64_t pairs_by_hash_grid(const std::vector<glm::dvec3>& x, const Lattice& lattice, double below);

/// Measures a cloth of that many particles a side. `rounds`: runs of some steps each.
ContactRow measure_contact(int side, int rounds);

}  // namespace tyglab
