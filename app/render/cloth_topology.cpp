#include "app/render/cloth_mesh.h"

#include <algorithm>
#include <utility>

#include "core/forces/parted.h"

namespace tyglab {
namespace {

/// A spring by its owner and its direction.
struct Edge {
  int direction, i, j;
};

/// The spring between two corners of the quad (i, j).
Edge edge_between(Corner a, Corner b, int i, int j) {
  const bool swapped = b.di < a.di || (b.di == a.di && b.dj < a.dj);
  if (swapped) std::swap(a, b);
  for (int direction = 0; direction < stretch_directions; ++direction) {
    const Direction& d = directions[direction];
    if (d.di == b.di - a.di && d.dj == b.dj - a.dj) return {direction, i + a.di, j + a.dj};
  }
  return {0, i, j};  // not reached: any two corners of a quad are neighbors
}

template <class Visit>
void for_each_cell(const Lattice& lattice, Visit visit) {
  for (int i = 0; i + 1 < lattice.rows; ++i)
    for (int j = 0; j + 1 < lattice.columns; ++j)
      for (int which = 0; which < 2; ++which) visit(i, j, which);
}

/// A set of stretch springs: a bit for each direction at each owner.
class EdgeSet {
 public:
  explicit EdgeSet(const Lattice& lattice) : lattice_(lattice), bits_(lattice.size(), 0) {}
  void add(const Edge& e) { bits_[e.i * lattice_.columns + e.j] |= std::uint8_t(1 << e.direction); }
  /// Indices of the edges for which `wanted(direction, i, j)` holds.
  template <class Wanted>
  Indices indices(int stride, Wanted wanted) const {
    Indices list;
    for (int i = 0; i < lattice_.rows; ++i) {
      for (int j = 0; j < lattice_.columns; ++j) {
        for (int direction = 0; direction < stretch_directions; ++direction) {
          if ((bits_[i * lattice_.columns + j] >> direction & 1) == 0 || !wanted(direction, i, j)) continue;
          list.push_back(std::uint32_t(i * stride + j));
          list.push_back(std::uint32_t((i + directions[direction].di) * stride + j + directions[direction].dj));
        }
      }
    }
    return list;
  }

 private:
  Lattice lattice_;
  std::vector<std::uint8_t> bits_;
};

std::uint32_t vertex(int particle, const Lattice& lattice, int stride) {
  return std::uint32_t(particle / lattice.columns * stride + particle % lattice.columns);
}

const std::array<Corner, 3>& corners_of(int i, int j, int which) {
  return quad_triangles[(i + j) & 1][which];
}

}  // namespace

Indices triangle_indices(const Lattice& lattice, int stride, const Tears& tears) {
  Indices list;
  list.reserve(std::size_t(6) * (lattice.rows - 1) * (lattice.columns - 1));
  for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
    for (const int particle : {a, b, c}) list.push_back(vertex(particle, lattice, stride));
  });
  return list;
}

Indices spring_indices(const Lattice& lattice, int stride, const Tears& tears, int first, int last) {
  Indices list;
  list.reserve(std::size_t(2) * (last - first) * lattice.size());
  for (int i = 0; i < lattice.rows; ++i) {
    for (int j = 0; j < lattice.columns; ++j) {
      for (int direction = first; direction < last; ++direction) {
        if (!lattice.has_spring(direction, i, j) || !tears.whole(direction, i, j)) continue;
        const Direction& d = directions[direction];
        list.push_back(std::uint32_t(i * stride + j));
        list.push_back(std::uint32_t((i + d.di) * stride + j + d.dj));
      }
    }
  }
  for (const LooseSpring& spring : loose_springs(tears, first, last))
    for (const int particle : {spring.a, spring.b}) list.push_back(vertex(particle, lattice, stride));
  return list;
}

Indices outline_indices(const Lattice& lattice, int stride, const Tears& tears) {
  if (tears.mesh() != nullptr) {
    std::vector<std::pair<int, int>> pairs;
    for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        pairs.emplace_back(std::min(from, to), std::max(from, to));
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Indices list;
    for (const auto& [from, to] : pairs)
      list.push_back(vertex(from, lattice, stride)), list.push_back(vertex(to, lattice, stride));
    return list;
  }
  EdgeSet edges(lattice);
  for_each_cell(lattice, [&](int i, int j, int which) {
    if (!tears.triangle_whole(i, j, which)) return;
    const auto& c = corners_of(i, j, which);
    for (int k = 0; k < 3; ++k) edges.add(edge_between(c[k], c[(k + 1) % 3], i, j));
  });
  return edges.indices(stride, [](int, int, int) { return true; });
}

Indices connection_indices(const Lattice& lattice, int stride, const Tears& tears) {
  EdgeSet edges(lattice);
  if (tears.untorn() || tears.mesh() != nullptr) return {};  // where the cloth parts, no triangle is lost
  for_each_cell(lattice, [&](int i, int j, int which) {
    if (tears.triangle_whole(i, j, which)) return;
    const auto& c = corners_of(i, j, which);
    for (int k = 0; k < 3; ++k) edges.add(edge_between(c[k], c[(k + 1) % 3], i, j));
    // The diagonal that is no triangle's edge is seen nowhere else.
    edges.add((i + j) % 2 == 0 ? edge_between({0, 1}, {1, 0}, i, j) : edge_between({0, 0}, {1, 1}, i, j));
  });
  return edges.indices(stride, [&](int direction, int i, int j) { return tears.whole(direction, i, j); });
}

/// Of a cloth that has parted: threads end along both sides of its cuts.
Indices frayed_cuts(const Lattice& lattice, int stride, const Mesh& mesh) {
  Indices list;
  const Lattice& sites = mesh.sites();
  const auto has_cell = [&](int i, int j) { return sites.contains(i, j) && sites.contains(i + 1, j + 1); };
  for_each_cell(sites, [&](int i, int j, int which) {
    const auto& of = corners_of(i, j, which);
    for (int k = 0; k < 3; ++k) {
      const Corner a = of[(k + 1) % 3], b = of[k], c = of[(k + 2) % 3];
      const bool along = a.di == b.di, down = a.dj == b.dj;
      if (!along && !down) continue;
      const int ni = i + (along ? 2 * a.di - 1 : 0), nj = j + (down ? 2 * a.dj - 1 : 0);
      if (!has_cell(ni, nj)) continue;
      const auto beyond = [&](Corner at) { return mesh.corner(ni, nj, {i + at.di - ni, j + at.dj - nj}); };
      const int from = mesh.corner(i, j, a), to = mesh.corner(i, j, b);
      if (from == beyond(a) && to == beyond(b)) continue;
      const int di = along ? 2 * a.di - c.di : c.di, dj = down ? 2 * a.dj - c.dj : c.dj;
      for (const int particle : {from, to, mesh.corner(i, j, c), (i + di) * sites.columns + j + dj})
        list.push_back(vertex(particle, lattice, stride));
    }
  });
  return list;
}

Indices frayed_indices(const Lattice& lattice, int stride, const Tears& tears) {
  if (tears.mesh() != nullptr) return frayed_cuts(lattice, stride, *tears.mesh());
  if (tears.untorn()) return {};
  Indices list;
  const auto whole = [&](Corner a, Corner b) {
    const Edge e = edge_between(a, b, 0, 0);
    return tears.whole(e.direction, e.i, e.j);
  };
  const auto all_whole = [&](Corner a, Corner b, Corner c) { return whole(a, b) && whole(b, c) && whole(c, a); };
  const auto add = [&](Corner a, Corner b, Corner c, Corner d) {
    for (const Corner& at : {a, b, c, d}) list.push_back(std::uint32_t(at.di * stride + at.dj));
  };
  const auto add_quad = [&](int i, int j) {
    const auto placed = [&](const std::array<Corner, 3>& of, int k) { return Corner{i + of[k].di, j + of[k].dj}; };
    const auto fourth = [&](Corner a, Corner b, Corner c) {
      return Corner{4 * i + 2 - a.di - b.di - c.di, 4 * j + 2 - a.dj - b.dj - c.dj};
    };
    const auto other_whole = [&](int which) {
      const auto& of = corners_of(i, j + 1, which);
      return all_whole(placed(of, 0), placed(of, 1), placed(of, 2));
    };
    // Where both are whole the quad has lost its diagonal alone, and the hole must be seen.
    const bool first = other_whole(0), second = other_whole(1), closed = first != second;
    for (int k = 0; closed && k < 3; ++k) {
      const auto& of = corners_of(i, j + 1, first ? 0 : 1);
      const Corner a = placed(of, k), b = placed(of, (k + 1) % 3), c = placed(of, (k + 2) % 3);
      if (a.di == b.di || a.dj == b.dj) continue;
      add(a, b, c, a);
      add(b, a, c, fourth(a, b, c));
    }
    for (int which = 0; which < 2; ++which) {
      if (tears.triangle_whole(i, j, which)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto& of = corners_of(i, j, which);
        const Corner a = placed(of, k), b = placed(of, (k + 1) % 3), d = placed(of, (k + 2) % 3), e = fourth(a, b, d);
        // The triangle beyond an edge is the mirror image of this one: in this quad beyond the diagonal.
        const bool along = a.di == b.di, down = a.dj == b.dj;
        const Corner c = along ? Corner{2 * a.di - d.di, d.dj} : down ? Corner{d.di, 2 * a.dj - d.dj} : e;
        const bool covered = (along || down) && closed && all_whole(e, a, b);
        if (!covered && lattice.contains(c.di, c.dj) && all_whole(c, a, b)) add(a, b, c, d);
      }
    }
  };
  for (int i = 0; i + 1 < lattice.rows; ++i)
    for (int j = 0; j + 1 < lattice.columns; ++j)
      if (!tears.triangle_whole(i, j, 0) || !tears.triangle_whole(i, j, 1)) add_quad(i, j);
  return list;
}

Indices particle_indices(const Lattice& lattice, int stride, const std::function<bool(int, int)>& wanted) {
  Indices list;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j)
      if (wanted(i, j)) list.push_back(std::uint32_t(i * stride + j));
  return list;
}

void remove_long(Indices& indices, int corners, const FloatRows& p, float longest) {
  const auto short_enough = [&](std::uint32_t a, std::uint32_t b) {
    const float *from = p.data + a, *to = p.data + b;
    const auto y = std::size_t(p.component), z = 2 * y;
    const float dx = to[0] - from[0], dy = to[y] - from[y], dz = to[z] - from[z];
    return dx * dx + dy * dy + dz * dz <= longest * longest;
  };
  auto kept = indices.begin();
  for (auto first = indices.begin(); first != indices.end(); first += corners) {
    bool keep = true;
    for (int k = 0; k < corners; ++k) keep = keep && short_enough(first[k], first[(k + 1) % corners]);
    if (keep) kept = std::copy(first, first + corners, kept);
  }
  indices.erase(kept, indices.end());
}

std::vector<std::uint32_t> particles_beside_tears(const Lattice& lattice, int stride, const Tears& tears) {
  if (tears.untorn()) return {};
  std::vector<bool> beside(lattice.size(), false);
  if (const Mesh* mesh = tears.mesh())
    for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
      const auto parted = [&](int particle) { return mesh->parted(mesh->site(particle)); };
      if (parted(a) || parted(b) || parted(c))
        beside[std::size_t(a)] = beside[std::size_t(b)] = beside[std::size_t(c)] = true;
    });
  else
    for_each_cell(lattice, [&](int i, int j, int which) {
      if (tears.triangle_whole(i, j, which)) return;
      for (const Corner& c : corners_of(i, j, which)) beside[(i + c.di) * lattice.columns + j + c.dj] = true;
    });
  return particle_indices(lattice, stride, [&](int i, int j) { return beside[i * lattice.columns + j]; });
}

}  // namespace tyglab
