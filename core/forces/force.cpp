#include "core/forces/force.h"

#include <algorithm>
#include <cassert>

namespace tyglab {

bool Stencil::acts(const Tears& tears, int i, int j) const {
  if (owners != Owners::all && ((i + j) % 2 == 0) != (owners == Owners::even)) return false;
  for (int n = 0; n < points; ++n)
    if (!tears.lattice().has_site(i + at[std::size_t(n)].di, j + at[std::size_t(n)].dj)) return false;
  const auto joined = [&](const Spring& s) {
    return tears.lattice().has_spring(s.direction, i + s.di, j + s.dj) && tears.whole(s.direction, i + s.di, j + s.dj);
  };
  if (alone && joined(other)) return false;
  if (tears.untorn()) return true;
  if (springs == 0 && tears.parted(i, j)) return false;
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

namespace {

/// The stretch spring between two corners of a quad: its owner is the upper end, or the left one within a row.
Stencil::Spring edge(const Corner& a, const Corner& b) {
  const bool a_owns = a.di < b.di || (a.di == b.di && a.dj < b.dj);
  const Corner &from = a_owns ? a : b, &to = a_owns ? b : a;
  const int di = to.di - from.di, dj = to.dj - from.dj;
  return {di == 0 ? 0 : dj == 0 ? 1 : dj > 0 ? 2 : 3, from.di, from.dj};
}

}  // namespace

std::span<const Stencil> triangle_stencils() {
  static const auto triangles = [] {
    std::array<Stencil, 4> all;
    for (std::size_t n = 0; n < all.size(); ++n) {
      const auto& corners = quad_triangles[n / 2][n % 2];
      all[n].owners = n < 2 ? Stencil::Owners::even : Stencil::Owners::odd;
      all[n].points = all[n].springs = 3;
      for (std::size_t k = 0; k < 3; ++k) {
        all[n].at[k] = {corners[k].di, corners[k].dj};
        all[n].spring[k] = edge(corners[k], corners[(k + 1) % 3]);
      }
    }
    return all;
  }();
  return triangles;
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
