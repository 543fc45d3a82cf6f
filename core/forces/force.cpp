#include "core/forces/force.h"

#include <algorithm>
#include <cassert>

namespace tyglab {

bool Stencil::acts(const Tears& tears, int i, int j) const {
  if (owners != Owners::all && ((i + j) % 2 == 0) != (owners == Owners::even)) return false;
  for (int n = 0; n < points; ++n)
    if (!tears.lattice().contains(i + at[std::size_t(n)].di, j + at[std::size_t(n)].dj)) return false;
  if (tears.untorn()) return true;
  for (int n = 0; n < springs; ++n) {
    const Spring& s = spring[std::size_t(n)];
    if (!tears.whole(s.direction, i + s.di, j + s.dj)) return false;
  }
  return true;
}

std::size_t index_of(const Force& force) {
  const auto at = std::find(force::all.begin(), force::all.end(), &force);
  assert(at != force::all.end());
  return std::size_t(at - force::all.begin());
}

std::span<const Stencil> stretch_stencils() {
  static const auto list = [] {
    std::array<Stencil, stretch_directions> all;
    for (int d = 0; d < stretch_directions; ++d) {
      const Direction& to = directions[std::size_t(d)];
      all[std::size_t(d)] = {2, {{{0, 0, -1}, {to.di, to.dj, 1}}}, to.rest, 1, {{{d, 0, 0}}}};
    }
    return all;
  }();
  return list;
}

}  // namespace tyglab
