#include "core/forces/parted.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

namespace tyglab {
namespace {

/// The sites that a stencil needs: those of its particles, and the ends of the springs that it lies over.
std::vector<Corner> sites_of(const Stencil& stencil) {
  std::vector<Corner> sites;
  const auto add = [&](int di, int dj) {
    const auto same = [&](const Corner& site) { return site.di == di && site.dj == dj; };
    if (std::none_of(sites.begin(), sites.end(), same)) sites.push_back({di, dj});
  };
  for (std::size_t n = 0; n < std::size_t(stencil.points); ++n) add(stencil.at[n].di, stencil.at[n].dj);
  for (std::size_t n = 0; n < std::size_t(stencil.springs); ++n) {
    const Stencil::Spring& spring = stencil.spring[n];
    const Direction& to = directions[std::size_t(spring.direction)];
    add(spring.di, spring.dj), add(spring.di + to.di, spring.dj + to.dj);
  }
  return sites;
}

/// Cells, by their upper left corners.
using Side = std::vector<Corner>;

/// The sides of a stencil, from its owner, and how far it reaches.
struct Shape {
  std::vector<Corner> sites;
  std::vector<Side> sides;
};
Shape shape_of(const Stencil& stencil) {
  Shape shape{sites_of(stencil), {}};
  Corner least = shape.sites.front(), most = least;
  for (const Corner& site : shape.sites) {
    least = {std::min(least.di, site.di), std::min(least.dj, site.dj)};
    most = {std::max(most.di, site.di), std::max(most.dj, site.dj)};
  }
  const int rows = most.di - least.di, columns = most.dj - least.dj;
  assert(rows == 0 || columns == 0 || (rows == 1 && columns == 1));
  if (rows > 0 && columns > 0) shape.sides = {{least}};
  if (rows == 0 && columns > 0)
    for (const int above : {-1, 0}) {
      Side& side = shape.sides.emplace_back();
      for (int j = least.dj; j < most.dj; ++j) side.push_back({least.di + above, j});
    }
  if (columns == 0 && rows > 0)
    for (const int left : {-1, 0}) {
      Side& side = shape.sides.emplace_back();
      for (int i = least.di; i < most.di; ++i) side.push_back({i, least.dj + left});
    }
  return shape;
}

/// The particle of a site to which the cells of a side are attached that touch it; -1: two of them have different ones.
int particle_at(const Mesh& mesh, const Side& side, Corner owner, Corner site) {
  int particle = -1;
  for (const Corner& cell : side) {
    const Corner at{site.di - cell.di, site.dj - cell.dj};
    if (at.di < 0 || at.di > 1 || at.dj < 0 || at.dj > 1) continue;
    const int held = mesh.corner(owner.di + cell.di, owner.dj + cell.dj, at);
    if (particle >= 0 && held != particle) return -1;
    particle = held;
  }
  return particle;
}

/// Adds what a stencil of one owner does, side by side.
void add_sides(const Mesh& mesh, const Force& force, const Stencil& stencil, const Shape& shape, Corner owner,
               std::vector<LooseStencil>& all) {
  const Lattice& sites = mesh.sites();
  const auto exists = [&](const Side& side) {
    return std::all_of(side.begin(), side.end(), [&](const Corner& cell) {
      const int i = owner.di + cell.di, j = owner.dj + cell.dj;
      return sites.contains(i, j) && sites.contains(i + 1, j + 1);
    });
  };
  const auto count = std::count_if(shape.sides.begin(), shape.sides.end(), exists);
  for (const Side& side : shape.sides) {
    if (!exists(side)) continue;
    LooseStencil loose{&force, &stencil, {}, 1.0 / double(count), {stencil.spring[0].direction, owner.di, owner.dj}};
    const bool holds = std::all_of(shape.sites.begin(), shape.sites.end(),
                                   [&](const Corner& site) { return particle_at(mesh, side, owner, site) >= 0; });
    if (!holds) continue;
    for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
      loose.at[n] = particle_at(mesh, side, owner, {stencil.at[n].di, stencil.at[n].dj});
    all.push_back(loose);
  }
}

/// Those of one stencil of the table.
void add_loose(const Mesh& mesh, const std::vector<int>& parted, const Force& force, const Stencil& stencil,
               std::vector<LooseStencil>& all) {
  const Lattice& sites = mesh.sites();
  assert(!stencil.alone);
  if (stencil.points == 1) {  // what acts on a mass
    for (const int site : parted) all.push_back({&force, &stencil, {site}, mesh.share(site), {}});
    for (int copy = sites.size(); copy < mesh.particles(); ++copy)
      all.push_back({&force, &stencil, {copy}, mesh.share(copy), {}});
    return;
  }
  const Shape shape = shape_of(stencil);
  std::vector<int> owners;
  for (const int site : parted)
    for (const Corner& at : shape.sites) {
      const int i = site / sites.columns - at.di, j = site % sites.columns - at.dj;
      if (sites.contains(i, j)) owners.push_back(i * sites.columns + j);
    }
  std::sort(owners.begin(), owners.end());
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  for (const int owner : owners) {
    const Corner at{owner / sites.columns, owner % sites.columns};
    const bool even = (at.di + at.dj) % 2 == 0;
    if (stencil.owners != Stencil::Owners::all && even != (stencil.owners == Stencil::Owners::even)) continue;
    const bool inside = std::all_of(shape.sites.begin(), shape.sites.end(), [&](const Corner& site) {
      return sites.contains(at.di + site.di, at.dj + site.dj);
    });
    if (inside) add_sides(mesh, force, stencil, shape, at, all);
  }
}

}  // namespace

std::vector<LooseStencil> loose_stencils(const Preset& preset, const Tears& tears) {
  std::vector<LooseStencil> all;
  if (tears.mesh() == nullptr) return all;
  const std::vector<int> parted = tears.mesh()->parted_sites();
  for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
    add_loose(*tears.mesh(), parted, force, stencil, all);
  });
  return all;
}

std::vector<LooseSpring> loose_springs(const Tears& tears, int first, int last) {
  std::vector<LooseSpring> springs;
  if (tears.mesh() == nullptr) return springs;
  const std::vector<int> parted = tears.mesh()->parted_sites();
  Preset bends;
  bends.k_b = 1;
  for (int direction = first; direction < last; ++direction) {
    const bool bending = directions[std::size_t(direction)].bending;
    const Force& force = bending ? force::bend : force::stretch;
    const Stencil& stencil = force.stencils(bends)[std::size_t(direction - (bending ? stretch_directions : 0))];
    std::vector<LooseStencil> all;
    add_loose(*tears.mesh(), parted, force, stencil, all);
    for (const LooseStencil& one : all) {
      const bool again = !springs.empty() && springs.back().a == one.at[0] && springs.back().b == one.at[1];
      if (!again) springs.push_back({{direction, one.spring.i, one.spring.j}, one.at[0], one.at[1]});
    }
  }
  return springs;
}

namespace {

/// Ways to divide the cells round a particle in two.
constexpr std::array<unsigned, 6> divisions{Mesh::up_left | Mesh::down_left,
                                            Mesh::up_left | Mesh::up_right,
                                            Mesh::up_left,
                                            Mesh::up_right,
                                            Mesh::down_left,
                                            Mesh::down_right};

bool neighbors(int a, int b) {
  return std::popcount(unsigned(a ^ b)) == 1;
}

/// How many of the four edges between neighboring cells a division cuts.
int edges_between(unsigned some, unsigned others) {
  int edges = 0;
  for (int a = 0; a < Mesh::cells_round; ++a)
    for (int b = 0; b < Mesh::cells_round; ++b)
      edges += int((some >> a & 1) != 0 && (others >> b & 1) != 0 && neighbors(a, b));
  return edges;
}

class Puller {
 public:
  Puller(const Preset& preset, const Mesh& mesh, std::span<const glm::dvec3> x) : p_(preset), mesh_(mesh), x_(x) {}

  /// The pull of the stretch springs that belong to a cell on a particle that it is attached to, N.
  glm::dvec3 of_cell(int particle, int cell) const {
    const int site = mesh_.site(particle), columns = mesh_.sites().columns;
    const Corner offset = offset_of_cell(cell);
    const int i = site / columns + offset.di, j = site % columns + offset.dj;
    const Corner own{-offset.di, -offset.dj};
    glm::dvec3 sum{0};
    for (const Corner to : {Corner{own.di, 1 - own.dj}, Corner{1 - own.di, own.dj}, Corner{1 - own.di, 1 - own.dj}}) {
      const bool along = to.di == own.di, down = to.dj == own.dj;
      // The cell on the other side of the edge has the other half, if there is one.
      const int ni = i + (along ? (own.di == 0 ? -1 : 1) : 0), nj = j + (down ? (own.dj == 0 ? -1 : 1) : 0);
      const bool alone =
          !along && !down ? true : !mesh_.sites().contains(ni, nj) || !mesh_.sites().contains(ni + 1, nj + 1);
      sum += (alone ? 1 : 0.5) * pull(particle, mesh_.corner(i, j, to), along ? 0 : down ? 1 : 2);
    }
    return sum;
  }
  /// How far a spring is over F_max, N.
  double over(int a, int b, int direction) const { return glm::length(pull(a, b, direction)) - p_.F_max; }

 private:
  glm::dvec3 pull(int from, int to, int direction) const {
    const Direction& d = directions[std::size_t(direction)];
    const glm::dvec3 way = x_[std::size_t(to)] - x_[std::size_t(from)];
    const double length = glm::length(way), longer = length - d.rest * p_.L;
    return longer > 0 ? spring_constant(p_, d) * longer / length * way : glm::dvec3(0);
  }
  const Preset& p_;
  const Mesh& mesh_;
  std::span<const glm::dvec3> x_;
};

/// The division of a particle that is torn apart hardest, and its line tension, N/m; 0: it has none.
struct Division {
  Opening opening{-1, 0};
  double tension = 0;
};
Division hardest(const Preset& preset, const Mesh& mesh, const Puller& pulls, int particle) {
  const unsigned cells = mesh.cells_of(particle);
  if (std::popcount(cells) < 2) return {};
  std::array<glm::dvec3, Mesh::cells_round> pull{};
  for (int cell = 0; cell < Mesh::cells_round; ++cell)
    if ((cells >> cell & 1) != 0) pull[std::size_t(cell)] = pulls.of_cell(particle, cell);
  Division best;
  for (const unsigned division : divisions) {
    const unsigned some = division & cells, others = cells & ~division;
    if (some == 0 || others == 0) continue;
    glm::dvec3 apart{0};
    for (int cell = 0; cell < Mesh::cells_round; ++cell)
      apart += ((some >> cell & 1) != 0 ? 0.5 : -0.5) * pull[std::size_t(cell)];
    const double length = std::max(edges_between(some, others), 1) * preset.L / 2;
    if (const double tension = glm::length(apart) / length; tension > best.tension)
      best = {{particle, std::popcount(some) <= std::popcount(others) ? some : others}, tension};
  }
  return best;
}

}  // namespace

std::vector<std::uint8_t> guarded_sites(const Tears& tears, std::span<const int> particles) {
  const Lattice sites = tears.lattice().sites();
  std::vector<std::uint8_t> guarded(std::size_t(sites.size()), 0);
  for (const int particle : particles) {
    if (particle >= tears.particles()) continue;
    const Pins::Site at = tears.site(particle);
    for (int i = at.i - 1; i <= at.i + 1; ++i)
      for (int j = at.j - 1; j <= at.j + 1; ++j)
        if (sites.contains(i, j)) guarded[std::size_t(i * sites.columns + j)] = 1;
  }
  return guarded;
}

bool overload_parts(const Tears& tears, const std::vector<std::uint8_t>& guarded, int a, int b) {
  const Mesh* mesh = tears.mesh();
  const auto site = [&](int particle) { return mesh != nullptr ? mesh->site(particle) : particle; };
  if (!guarded.empty() && (guarded[std::size_t(site(a))] != 0 || guarded[std::size_t(site(b))] != 0)) return false;
  const Lattice sites = tears.lattice().sites();
  const auto divides = [&](int particle) {
    return std::popcount(mesh != nullptr ? mesh->cells_of(particle) : Mesh::cells_at(sites, particle)) > 1;
  };
  return divides(a) || divides(b);
}

std::vector<Opening> openings_of_overload(const Preset& preset, const Tears& tears, std::span<const glm::dvec3> x,
                                          const std::vector<std::uint8_t>& guarded) {
  const Mesh whole(tears.lattice().sites());
  const Mesh& mesh = tears.mesh() != nullptr ? *tears.mesh() : whole;
  const Lattice& sites = mesh.sites();
  const Puller pulls(preset, mesh, x);
  std::map<int, Division> at;  // by site
  const auto look = [&](int a, int b, int direction) {
    if (!(pulls.over(a, b, direction) > 0) || !overload_parts(tears, guarded, a, b)) return;
    const Division first = hardest(preset, mesh, pulls, a), second = hardest(preset, mesh, pulls, b);
    const Division& best = second.tension > first.tension ? second : first;
    if (best.opening.particle < 0) return;
    Division& known = at[mesh.site(best.opening.particle)];
    if (best.tension > known.tension) known = best;
  };
  for (int i = 0; i < sites.rows; ++i)
    for (int j = 0; j < sites.columns; ++j)
      for (int d = 0; d < stretch_directions; ++d)
        if (sites.has_spring(d, i, j) && tears.whole(d, i, j)) {
          const Direction& to = directions[std::size_t(d)];
          look(i * sites.columns + j, (i + to.di) * sites.columns + j + to.dj, d);
        }
  for (const LooseStencil& loose : loose_stencils(preset, tears))
    if (loose.force == &force::stretch) look(loose.at[0], loose.at[1], loose.stencil->spring[0].direction);
  std::vector<Opening> all;
  all.reserve(at.size());
  for (const auto& [site, division] : at) all.push_back(division.opening);
  return all;
}

namespace {

/// Edges of the lattice that meet in a site, and along which a cut runs.
enum Leg : unsigned { up = 1, down = 2, left = 4, right = 8 };
constexpr std::array<Leg, 4> all_legs{up, down, left, right};

Corner step_along(Leg leg) {
  return {leg == up ? -1 : leg == down ? 1 : 0, leg == left ? -1 : leg == right ? 1 : 0};
}
Leg opposite(Leg leg) {
  return leg == up ? down : leg == down ? up : leg == left ? right : left;
}
/// The cells on either side of a leg, by their numbers round its site.
std::pair<int, int> beside(Leg leg) {
  return leg == up ? std::pair(0, 1) : leg == down ? std::pair(2, 3) : leg == left ? std::pair(0, 2) : std::pair(1, 3);
}

class Cutter {
 public:
  explicit Cutter(const Tears& tears)
      : whole_(tears.lattice().sites()), mesh_(tears.mesh() != nullptr ? *tears.mesh() : whole_) {}

  const Lattice& sites() const { return mesh_.sites(); }
  int site(int i, int j) const { return i * sites().columns + j; }
  std::optional<int> along(int site, Leg leg) const {
    const Corner step = step_along(leg);
    const int i = site / sites().columns + step.di, j = site % sites().columns + step.dj;
    return sites().contains(i, j) ? std::optional(this->site(i, j)) : std::nullopt;
  }
  /// Edges that are open at their other ends.
  unsigned open_legs(int site) const {
    unsigned legs = 0;
    for (const Leg leg : all_legs)
      if (const auto other = along(site, leg)) {
        const auto [a, b] = beside(opposite(leg));
        const unsigned both = 1u << a | 1u << b;
        if ((mesh_.cells_at(*other) & both) == both && mesh_.holder(*other, a) != mesh_.holder(*other, b)) legs |= leg;
      }
    return legs;
  }
  /// Parts a site along these legs: each particle of it keeps the cells on the side of its first.
  void part(int site, unsigned legs) {
    const unsigned cells = mesh_.cells_at(site);
    std::array<int, Mesh::cells_round> side{0, 1, 2, 3};
    for (const Leg leg : all_legs) {
      const auto [a, b] = beside(leg);
      if ((legs & leg) != 0 || (cells >> a & 1) == 0 || (cells >> b & 1) == 0) continue;
      const int first = side[std::size_t(a)], second = side[std::size_t(b)];
      std::replace(side.begin(), side.end(), std::max(first, second), std::min(first, second));
    }
    std::map<std::pair<int, int>, unsigned> parts;  // by particle and side
    for (int cell = 0; cell < Mesh::cells_round; ++cell)
      if ((cells >> cell & 1) != 0) parts[{mesh_.holder(site, cell), side[std::size_t(cell)]}] |= 1u << cell;
    for (auto part = parts.begin(); part != parts.end(); ++part)
      if (part != parts.begin() && std::prev(part)->first.first == part->first.first)
        openings_.push_back({part->first.first, part->second});
  }
  std::vector<Opening> openings() { return std::move(openings_); }

 private:
  const Mesh whole_;
  const Mesh& mesh_;
  std::vector<Opening> openings_;
};

/// A leg alone goes on straight.
unsigned straightened(unsigned legs) {
  if (std::popcount(legs) != 1) return legs;
  return (legs & (up | down)) != 0 ? up | down : left | right;
}

}  // namespace

std::vector<Opening> openings_of_cut(const Tears& tears, std::span<const SpringSite> springs) {
  Cutter cutter(tears);
  // A cut across a spring along a row runs up and down through its owner; across one down a column, left and right.
  std::map<int, unsigned> through;
  for (const SpringSite& spring : springs)
    if (spring.direction < 2 && cutter.sites().has_spring(spring.direction, spring.i, spring.j))
      through[cutter.site(spring.i, spring.j)] |= spring.direction == 0 ? up | down : left | right;
  for (const auto& [site, across] : through) {
    unsigned legs = cutter.open_legs(site);
    for (const Leg leg : all_legs)
      if (const auto other = cutter.along(site, leg); other && through.contains(*other)) legs |= leg;
    cutter.part(site, straightened(legs == 0 ? across : legs));
  }
  return cutter.openings();
}

std::vector<Opening> openings_of_path(const Tears& tears, std::span<const Pins::Site> path) {
  Cutter cutter(tears);
  // From site to site along the lattice.
  std::vector<int> way;
  for (const Pins::Site& next : path) {
    if (!tears.lattice().contains(next.i, next.j) || next.i * tears.lattice().columns + next.j >= tears.particles())
      continue;
    const Pins::Site to = tears.site(next.i * tears.lattice().columns + next.j);
    const int columns = cutter.sites().columns, end = cutter.site(to.i, to.j);
    if (way.empty()) way.push_back(end);
    while (way.back() != end) {
      const int down_by = to.i - way.back() / columns, along_by = to.j - way.back() % columns;
      const bool along = std::abs(along_by) > std::abs(down_by);
      way.push_back(way.back() + (along ? (along_by > 0 ? 1 : -1) : down_by > 0 ? columns : -columns));
    }
  }
  std::map<int, unsigned> legs;
  for (std::size_t n = 0; n + 1 < way.size(); ++n)
    for (const Leg leg : all_legs)
      if (cutter.along(way[n], leg) == way[n + 1]) legs[way[n]] |= leg, legs[way[n + 1]] |= opposite(leg);
  // A touch of the knife cuts the springs above. The end of a longer way stays closed: a further way begins there.
  // Unless it leads out of the cloth.
  const auto leads_out = [&](int site, unsigned cut) {
    return std::any_of(all_legs.begin(), all_legs.end(),
                       [&](Leg leg) { return (cut & leg) != 0 && !cutter.along(site, opposite(leg)); });
  };
  if (way.size() == 1) {
    const unsigned open = cutter.open_legs(way.front());
    if (open == 0 || leads_out(way.front(), open)) cutter.part(way.front(), open == 0 ? left | right : open);
  }
  for (const auto& [site, cut] : legs)
    if (site != way.back() || std::popcount(cut) > 1 || leads_out(site, cut))
      cutter.part(site, straightened(cut | cutter.open_legs(site)));
  return cutter.openings();
}

}  // namespace tyglab
