#include "core/contact/near_pairs.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tyglab {
namespace {

constexpr double skin_per_L = 0.25;    // of a new list with pairs
constexpr double certain_per_L = 0.1;  // what a list without pairs must last for
constexpr double search_per_L = 1;     // how far beyond the reach blocks are that get a list
constexpr double worn = 0.25;          // a list is made anew where that share of its use is left, if one is due

constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Box>
Box both(const Box& a, const Box& b) {
  return {glm::min(a.least, b.least), glm::max(a.most, b.most)};
}

/// Corners of a site's parts, as 2·di + dj, by the parity of the site: particle, triangles, edges, then those that
/// other sites have where nothing has parted.
struct PartCorners {
  int count;
  std::array<int, 3> at;
};
constexpr int right_particle = 6, below_particle = 7, last_particle = 8, below_edge = 9, right_edge = 10;
constexpr std::array<std::array<PartCorners, 11>, 2> parts_by_parity = [] {
  std::array<std::array<PartCorners, 11>, 2> all{};
  for (std::size_t odd = 0; odd < 2; ++odd) {
    all[odd][0] = {1, {0, 0, 0}};
    for (std::size_t which = 0; which < 2; ++which) {
      all[odd][1 + which].count = 3;
      for (std::size_t n = 0; n < 3; ++n)
        all[odd][1 + which].at[n] = 2 * quad_triangles[odd][which][n].di + quad_triangles[odd][which][n].dj;
    }
    all[odd][3] = {2, {0, 1, 0}}, all[odd][4] = {2, {0, 2, 0}};
    all[odd][5] = odd == 0 ? PartCorners{2, {0, 3, 0}} : PartCorners{2, {1, 2, 0}};
    all[odd][right_particle] = {1, {1, 0, 0}}, all[odd][below_particle] = {1, {2, 0, 0}};
    all[odd][last_particle] = {1, {3, 0, 0}};
    all[odd][below_edge] = {2, {2, 3, 0}}, all[odd][right_edge] = {2, {1, 3, 0}};
  }
  return all;
}();

}  // namespace

NearPairs::NearPairs(const Lattice& lattice)
    : lattice_(lattice.sites()),
      block_rows_((lattice_.rows + side - 1) / side),
      block_columns_((lattice_.columns + side - 1) / side) {
  for (int site = 0; site < sites; ++site)
    for (int n = 0; n < corners_of_cell; ++n)
      offsets_[std::size_t(corners_of_cell * site + n)] =
          (site / side + n / 2) * lattice_.columns + site % side + n % 2;
}

void NearPairs::set_distances(double L, double reach) {
  if (L != L_ || reach != reach_) forget();
  L_ = L, reach_ = reach;
}

const std::array<NearPairs::Part, std::size_t(NearPairs::sites* NearPairs::parts_of_site)>& NearPairs::parts() {
  static const auto all = [] {
    std::array<Part, std::size_t(sites * parts_of_site)> parts;
    for (int site = 0; site < sites; ++site)
      for (int n = 0; n < parts_of_site; ++n) {
        const PartCorners& of = parts_by_parity[std::size_t((site / side + site) % 2)][std::size_t(n)];
        Part& part = parts[std::size_t(site * parts_of_site + n)];
        part.count = of.count;
        for (std::size_t k = 0; k < 3; ++k) part.at[k] = std::uint8_t(corners_of_cell * site + of.at[k]);
      }
    return parts;
  }();
  return all;
}

/// Triangles whose springs are whole, their edges and corners.
void NearPairs::find_parts(const Tears& tears) {
  const int columns = lattice_.columns;
  used_parts_.assign(std::size_t(lattice_.size()), 0);
  places_of_.clear(), places_.clear(), sites_of_copies_.clear();
  if (tears.mesh() != nullptr) return find_parts(*tears.mesh());
  const auto use = [&](int site, int part) { used_parts_[std::size_t(site)] |= std::uint16_t(1 << part); };
  for (int i = 0; i + 1 < lattice_.rows; ++i)
    for (int j = 0; j + 1 < columns; ++j)
      for (const int which : {0, 1}) {
        if (!tears.triangle_whole(i, j, which)) continue;
        const auto& corners = quad_triangles[std::size_t((i + j) % 2)][std::size_t(which)];
        const int quad = i * columns + j;
        use(quad, 1 + which), use(quad, 5);  // it has the diagonal
        for (const Corner& corner : corners) use(quad + corner.di * columns + corner.dj, 0);
        // Of the other two edges one lies along a row, and one along a column.
        for (std::size_t n = 0; n < 3; ++n) {
          const Corner &from = corners[n], &to = corners[(n + 1) % 3];
          if (from.di == to.di) use(quad + from.di * columns, 3);
          if (from.dj == to.dj) use(quad + from.dj, 4);
        }
      }
}

/// Those of a parted cloth: of all its cells.
void NearPairs::find_parts(const Mesh& mesh) {
  const int columns = lattice_.columns;
  const auto use = [&](int i, int j, int part) {
    used_parts_[std::size_t(i * columns + j)] |= std::uint16_t(1 << part);
  };
  const auto has_cell = [&](int i, int j) { return lattice_.contains(i, j) && lattice_.contains(i + 1, j + 1); };
  // Each particle at one of its cells.
  constexpr std::array particle_at{last_particle, below_particle, right_particle, 0};  // by the cell's number
  for (int site = 0; site < lattice_.size(); ++site) {
    const int i = site / columns, j = site % columns;
    if (!mesh.parted(site)) {
      use(i, j, 0);
      continue;
    }
    const unsigned cells = mesh.cells_at(site);
    for (int cell = Mesh::cells_round - 1; cell >= 0; --cell) {
      bool known = (cells >> cell & 1) == 0;
      for (int other = cell + 1; other < Mesh::cells_round; ++other)
        known = known || ((cells >> other & 1) != 0 && mesh.holder(site, other) == mesh.holder(site, cell));
      const Corner offset = offset_of_cell(cell);
      if (!known) use(i + offset.di, j + offset.dj, particle_at[std::size_t(cell)]);
    }
  }
  // Each edge at the cell below it or to its right, and where that has other particles, or is none, also at the other.
  const auto use_edge = [&](int i, int j, int part, Corner end, int ni, int nj, int other_part, Corner from,
                            Corner to) {
    const bool whole = !mesh.parted(i * columns + j) && !mesh.parted((i + end.di) * columns + j + end.dj);
    const bool here = has_cell(i, j), there = has_cell(ni, nj);
    if (whole || here) use(i, j, part);
    if (whole || !there) return;
    const bool same = here && mesh.corner(i, j, {0, 0}) == mesh.corner(ni, nj, from) &&
                      mesh.corner(i, j, end) == mesh.corner(ni, nj, to);
    if (!same) use(ni, nj, other_part);
  };
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (has_cell(i, j)) use(i, j, 1), use(i, j, 2), use(i, j, 5);
      if (j + 1 < columns) use_edge(i, j, 3, {0, 1}, i - 1, j, below_edge, {1, 0}, {1, 1});
      if (i + 1 < lattice_.rows) use_edge(i, j, 4, {1, 0}, i, j - 1, right_edge, {0, 1}, {1, 1});
    }
  find_places(mesh);
}

/// Calls visit(block) for each block that has a site among the corners of its cells.
template <class Visit>
void NearPairs::for_each_block_of(int site, const Visit& visit) const {
  const int i = site / lattice_.columns, j = site % lattice_.columns;
  for (int block_i = std::max(i - 1, 0) / side; block_i <= i / side; ++block_i)
    for (int block_j = std::max(j - 1, 0) / side; block_j <= j / side; ++block_j)
      visit(block_i * block_columns_ + block_j);
}

/// The particles of blocks that have parted sites.
void NearPairs::find_places(const Mesh& mesh) {
  places_of_.assign(std::size_t(block_rows_) * std::size_t(block_columns_), -1);
  for (int copy = lattice_.size(); copy < mesh.particles(); ++copy) sites_of_copies_.push_back(mesh.site(copy));
  for (const int site : mesh.parted_sites())
    for_each_block_of(site, [&](int block) {
      std::int32_t& at = places_of_[std::size_t(block)];
      if (at >= 0) return;
      at = std::int32_t(places_.size());
      Places& places = places_.emplace_back();
      for (int n = 0; n < sites * corners_of_cell; ++n) {
        const int i = block / block_columns_ * side + n / corners_of_cell / side,
                  j = block % block_columns_ * side + n / corners_of_cell % side;
        const Corner corner{n % corners_of_cell / 2, n % 2};
        const bool is_cell = lattice_.contains(i, j) && lattice_.contains(i + 1, j + 1);
        const int last_row = lattice_.rows - 1, last_column = lattice_.columns - 1;
        places[std::size_t(n)] =
            is_cell ? mesh.corner(i, j, corner)
                    : std::min(i + corner.di, last_row) * lattice_.columns + std::min(j + corner.dj, last_column);
      }
    });
}

/// Copies are in boxes, too; value(component, particle).
template <class Value>
void NearPairs::include_copies(Box Block::*box, const Value& value) {
  for (std::size_t n = 0; n < sites_of_copies_.size(); ++n)
    for_each_block_of(sites_of_copies_[n], [&](int block) {
      Box& to = blocks_[std::size_t(block)].*box;
      for (int c = 0; c < 3; ++c) {
        const float one = value(std::size_t(c), std::size_t(lattice_.size()) + n);
        to.least[c] = std::min(to.least[c], one), to.most[c] = std::max(to.most[c], one);
      }
    });
}

/// Puts positions into here_. Returns false where they are out of what the bounds of rounding allow for.
bool NearPairs::take(Vectors x) {
  for (auto& one : here_) one.resize(x.size());
  float *to_x = here_[0].data(), *to_y = here_[1].data(), *to_z = here_[2].data();
  std::uint32_t largest = 0;  // as bits, which rise with the number, and are largest where it is not finite
  for (std::size_t p = 0; p < x.size(); ++p) {
    const glm::vec3 at(x[p] - origin_);
    to_x[p] = at.x, to_y[p] = at.y, to_z[p] = at.z;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::bit_cast<std::uint32_t>(at[c]) & 0x7fffffffu);
  }
  return rounding_ <= L_ && double(std::bit_cast<float>(largest)) <= farthest_;
}

/// Boxes of each block around value(row, column), which there are that many rows and columns of, and of which a block
/// has some beyond its sites.
template <class Value>
void NearPairs::refit(Box Block::*box, int rows, int columns, const Value& value) {
  const int beyond_i = rows == lattice_.rows ? span : side, beyond_j = columns == lattice_.columns ? span : side;
  std::vector<float> least(std::size_t(std::max(columns, 0))), most = least;
  for (int c = 0; c < 3; ++c)
    for (int block_i = 0; block_i < block_rows_; ++block_i) {
      std::fill(least.begin(), least.end(), infinity), std::fill(most.begin(), most.end(), -infinity);
      for (int i = side * block_i; i < std::min(side * block_i + beyond_i, rows); ++i) {
        const auto of_row = value(c, i);
        float *low = least.data(), *high = most.data();
        for (int j = 0; j < columns; ++j) {
          const float one = of_row(j);
          low[j] = one < low[j] ? one : low[j], high[j] = one > high[j] ? one : high[j];
        }
      }
      for (int block_j = 0; block_j < block_columns_; ++block_j) {
        float low = infinity, high = -infinity;
        for (int j = side * block_j; j < std::min(side * block_j + beyond_j, columns); ++j)
          low = std::min(low, least[std::size_t(j)]), high = std::max(high, most[std::size_t(j)]);
        Box& to = blocks_[std::size_t(block_i * block_columns_ + block_j)].*box;
        to.least[c] = low, to.most[c] = high;
      }
    }
}

/// All boxes but that of the moves.
void NearPairs::refit_all() {
  const int rows = lattice_.rows, columns = lattice_.columns;
  const auto row_of = [&](int c, int i) { return here_[std::size_t(c)].data() + std::ptrdiff_t(i) * columns; };
  refit(&Block::at, rows, columns, [&](int c, int i) {
    const float* row = row_of(c, i);
    return [=](int j) { return row[j]; };
  });
  include_copies(&Block::at, [&](std::size_t c, std::size_t particle) { return here_[c][particle]; });
  refit(&Block::along, rows, columns - 1, [&](int c, int i) {
    const float* row = row_of(c, i);
    return [=](int j) { return row[j + 1] - row[j]; };
  });
  refit(&Block::down, rows - 1, columns, [&](int c, int i) {
    const float *row = row_of(c, i), *below = row_of(c, i + 1);
    return [=](int j) { return below[j] - row[j]; };
  });
}

/// How much points of a block may have come nearer to points of another, or of itself, m, by what both have moved.
double NearPairs::approach(const Box& a, const Box& b) const {
  const glm::vec3 most = glm::max(a.most - b.least, b.most - a.least);
  return double(glm::length(most)) * (1 + 1e-6);
}

bool NearPairs::adjacent(int a, int b) const {
  return std::abs(a / block_columns_ - b / block_columns_) <= 1 &&
         std::abs(a % block_columns_ - b % block_columns_) <= 1;
}

/// The smallest origin of floats for positions, and nothing known of lists.
void NearPairs::begin_anew(Vectors x) {
  lists_.clear(), search_left_ = -1;
  blocks_.resize(std::size_t(block_rows_) * std::size_t(block_columns_));
  origin_ = x[x.size() / 2];
  double farthest = 0;
  for (const glm::dvec3& one : x)
    for (int c = 0; c < 3; ++c) farthest = std::max(farthest, std::abs(one[c] - origin_[c]));
  farthest_ = 2 * farthest + L_;
  rounding_ = 8 * double(std::numeric_limits<float>::epsilon()) * farthest_;
}

void NearPairs::follow(const Tears& tears, Vectors x) {
  assert(x.size() >= std::size_t(tears.particles()) && tears.lattice().sites() == lattice_);
  if (known_torn_ != tears.torn_count()) {
    known_torn_ = -1;
    find_parts(tears);
    begin_anew(x);
    known_torn_ = tears.torn_count();
  }
  follow(x);
}

void NearPairs::follow(Vectors x) {
  const int torn = known_torn_;
  known_torn_ = -1;  // where something throws
  near_ = false, left_ = -1;
  if (!take(x)) {
    begin_anew(x);
    if (!take(x)) return;
  }
  if (search_left_ >= 0) {
    const int columns = lattice_.columns;
    refit(&Block::moved, lattice_.rows, columns, [&](int c, int i) {
      const float *now = here_[std::size_t(c)].data() + std::ptrdiff_t(i) * columns,
                  *then = last_[std::size_t(c)].data() + std::ptrdiff_t(i) * columns;
      return [=](int j) { return now[j] - then[j]; };
    });
    include_copies(&Block::moved,
                   [&](std::size_t c, std::size_t particle) { return here_[c][particle] - last_[c][particle]; });
    Box all = blocks_.front().moved;
    for (const Block& block : blocks_) all = both(all, block.moved);
    search_left_ -= approach(all, all);
  }
  bool due = search_left_ < 0;
  for (List& list : lists_) {
    const double nearer = approach(blocks_[std::size_t(list.a)].moved, blocks_[std::size_t(list.b)].moved);
    list.left -= nearer, list.used += nearer;
    due = due || list.left < 0;
  }
  if (due) {
    refit_all();
    if (search_left_ < 0) find_lists();
    make_lists();
  }
  left_ = search_left_;
  for (const List& list : lists_) {
    left_ = std::min({left_, list.left, double(list.least) - list.used - reach_});
    near_ = near_ || double(list.least) - list.used < reach_;
  }
  here_.swap(last_);
  known_torn_ = torn;
}

/// Blocks that may be near: found along the coordinate in which the cloth is longest. Lists of blocks that had one
/// stay.
void NearPairs::find_lists() {
  const float within = float((reach_ + search_per_L * L_ + rounding_) * (1 + 1e-6));
  Box all = blocks_.front().at;
  for (const Block& block : blocks_) all = both(all, block.at);
  const glm::vec3 size = all.most - all.least;
  const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<std::pair<Box, int>> order;
  order.reserve(blocks_.size());
  for (std::size_t n = 0; n < blocks_.size(); ++n) order.emplace_back(blocks_[n].at, int(n));
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    return a.first.least[along] != b.first.least[along] ? a.first.least[along] < b.first.least[along]
                                                        : a.second < b.second;
  });
  std::vector<std::pair<int, int>> found;
  for (auto one = order.begin(); one != order.end(); ++one) {
    const Box& box = one->first;
    found.emplace_back(one->second, one->second);
    for (auto other = one + 1; other != order.end() && other->first.least[along] <= box.most[along] + within; ++other) {
      const glm::vec3 off = glm::max(other->first.least - box.most, box.least - other->first.most);
      if (off.x <= within && off.y <= within && off.z <= within)
        found.push_back(std::minmax(one->second, other->second));
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<List> lists;
  lists.reserve(found.size());
  auto old = lists_.begin();
  for (const auto& [a, b] : found) {
    while (old != lists_.end() && std::pair(old->a, old->b) < std::pair(a, b)) ++old;
    if (old != lists_.end() && old->a == a && old->b == b)
      lists.push_back(std::move(*old));
    else
      lists.emplace_back(a, b);
  }
  lists_ = std::move(lists);
  search_left_ = search_per_L * L_;
}

/// A lower bound of the distance of parts that share no particle, on triangles of which these boxes hold all steps, m.
/// On the way from one point to another, first along the rows and then down the columns, Δu and Δv sites far, each
/// piece is the step of some spring. So the distance is |Δu e + Δv s|, where e and s are means of steps and lie in
/// their boxes. Parts that share no particle are at least √½ sites apart.
double NearPairs::spread(const Box& along, const Box& down) {
  const bool has_along = along.least.x <= along.most.x, has_down = down.least.x <= down.most.x;
  if (!has_along && !has_down) return infinity;
  const glm::vec3 e = has_along ? (along.least + along.most) / 2.0f : glm::vec3(0),
                  s = has_down ? (down.least + down.most) / 2.0f : glm::vec3(0);
  const glm::vec3 half_e = has_along ? (along.most - along.least) / 2.0f : glm::vec3(0),
                  half_s = has_down ? (down.most - down.least) / 2.0f : glm::vec3(0);
  const double ee = glm::dot(e, e), ss = glm::dot(s, s), es = glm::dot(e, s), half = (ee - ss) / 2;
  const double least = !has_along ? ss : !has_down ? ee : (ee + ss) / 2 - std::sqrt(half * half + es * es);
  const double radius = std::sqrt(double(glm::dot(half_e, half_e) + glm::dot(half_s, half_s)));
  return (std::sqrt(std::max(least, 0.0)) - radius) * 0.7071;
}

/// A lower bound of the distance of parts of two blocks which share no particle, m.
double NearPairs::apart(const List& list) const {
  const Block &a = blocks_[std::size_t(list.a)], &b = blocks_[std::size_t(list.b)];
  if (!adjacent(list.a, list.b)) {
    const glm::vec3 off = glm::max(glm::max(a.at.least - b.at.most, b.at.least - a.at.most), glm::vec3(0));
    return double(glm::length(off));
  }
  const int of_left = list.a / block_columns_ * block_columns_ + list.b % block_columns_,
            of_right = list.b / block_columns_ * block_columns_ + list.a % block_columns_;
  // Where the cloth has parted there is no way from site to site.
  if (parted(list.a) || parted(list.b) || parted(of_left) || parted(of_right)) return 0;
  const Block &left = blocks_[std::size_t(of_left)], &right = blocks_[std::size_t(of_right)];
  return spread(both(both(a.along, b.along), both(left.along, right.along)),
                both(both(a.down, b.down), both(left.down, right.down)));
}

/// Numbers along some directions at once.
using Lanes = std::array<float, 4>;

/// The two kinds of pairs that parts of two sites make, by the parts' numbers: first those of parts that every cloth
/// has.
constexpr std::array<int, 4> particles_of_site{0, right_particle, below_particle, last_particle};
constexpr std::array<int, 5> edges_of_site{3, 4, 5, below_edge, right_edge};
constexpr std::size_t whole_kinds = 13, all_kinds = 41;
constexpr std::array<std::array<int, 2>, all_kinds> kinds_of_pairs = [] {
  std::array<std::array<int, 2>, all_kinds> kinds{};
  std::size_t count = 0;
  for (const bool whole : {true, false}) {
    const auto add = [&](int first, int second) {
      if ((first < right_particle && second < right_particle) == whole) kinds[count++] = {first, second};
    };
    for (const int particle : particles_of_site)
      for (const int triangle : {1, 2}) add(particle, triangle), add(triangle, particle);
    for (const int edge : edges_of_site)
      for (const int other : edges_of_site) add(edge, other);
    if (whole && count != whole_kinds) throw count;
  }
  return kinds;
}();
constexpr std::uint64_t all_pairs = (std::uint64_t(1) << all_kinds) - 1,
                        whole_pairs = (std::uint64_t(1) << whole_kinds) - 1;
/// Of one site: not twice.
constexpr std::uint64_t own_pairs = [] {
  std::uint64_t own = 0;
  for (std::size_t kind = 0; kind < all_kinds; ++kind) {
    const auto& [first, second] = kinds_of_pairs[kind];
    const bool particle = first == 0 || (first >= right_particle && first <= last_particle);
    const bool edges = first != 1 && first != 2 && !particle;
    if (particle || (edges && first < second)) own |= std::uint64_t(1) << kind;
  }
  return own;
}();

/// Which of them share no site, as bits, by the first site's parity and how many rows and columns the second is behind
/// it, from -1 to 1.
constexpr auto apart_by_offset = [] {
  std::array<std::array<std::array<std::uint64_t, 3>, 3>, 2> table{};
  for (int odd = 0; odd < 2; ++odd)
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        for (std::size_t kind = 0; kind < kinds_of_pairs.size(); ++kind) {
          const auto& one = parts_by_parity[std::size_t(odd)][std::size_t(kinds_of_pairs[kind][0])];
          const auto& other = parts_by_parity[std::size_t((odd + di + dj) & 1)][std::size_t(kinds_of_pairs[kind][1])];
          bool shared = false;
          for (int k = 0; k < one.count; ++k)
            for (int l = 0; l < other.count; ++l) {
              const int from = one.at[std::size_t(k)], to = other.at[std::size_t(l)];
              shared = shared || (from / 2 == di + to / 2 && from % 2 == dj + to % 2);
            }
          if (!shared) table[std::size_t(odd)][std::size_t(di + 1)][std::size_t(dj + 1)] |= std::uint64_t(1) << kind;
        }
  return table;
}();

/// The sites of a block, as floats.
struct NearPairs::Sites {
  std::array<glm::vec3, std::size_t(sites* corners_of_cell)> at;  ///< by their places
  std::array<std::array<float, sites>, 3> least, most;            ///< of the particles of each site
  std::array<std::uint16_t, sites> used;                          ///< the bits of its parts
  unsigned used_sites;                                            ///< those with any, as bits
  int block = -1;
  bool parted;
  int row, column;                        ///< of its first site in the lattice
  std::array<Box, quarters> along, down;  ///< steps in its quarters
};

/// Finds the pairs of two blocks whose distance along none of some directions is larger than `within`.
class NearPairs::Maker {
 public:
  explicit Maker(const NearPairs& of) : of_(of), per_unit_(float(bound_per_L / of.L_)), margin_(float(of.rounding_)) {}

  /// Until the next call.
  const std::vector<Pair>& find(const List& list, double within) {
    pairs_.clear();
    same_ = list.a == list.b, within_ = float(within);
    const bool adjacent = of_.adjacent(list.a, list.b);
    gather(list.a, a_), gather(list.b, b_);
    for (int quarter = 0; quarter < quarters; ++quarter) {
      const unsigned asked = b_.used_sites & ~(adjacent ? evenly_beside(quarter) : 0);
      if (asked == 0) continue;
      for (const int n : sites_of(quarter))
        if ((a_.used_sites >> n & 1) != 0) visit_all(n, same_ ? asked & (~0u << n) : asked);
    }
    return pairs_;
  }

 private:
  void visit_all(int n, unsigned asked) {
    std::array<float, sites> off{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float least = a_.least[c][std::size_t(n)], most = a_.most[c][std::size_t(n)];
      for (std::size_t m = 0; m < sites; ++m)
        off[m] = std::max(off[m], std::max(b_.least[c][m] - most, least - b_.most[c][m]));
    }
    for (; asked != 0; asked &= asked - 1)
      if (const int m = std::countr_zero(asked); off[std::size_t(m)] <= within_) visit(n, m);
  }

  /// Where a part lies along each direction.
  struct Extent {
    Lanes least, most;
  };
  using Corners = std::array<glm::vec3, std::size_t(corners_of_cell)>;
  using Extents = std::array<Extent, std::size_t(parts_of_site)>;

  void gather(int block, Sites& to) const {
    if (to.block == block) return;
    const NearPairs& of = of_;
    to.block = block, to.row = block / of.block_columns_ * side, to.column = block % of.block_columns_ * side;
    to.used_sites = 0, to.parted = of.parted(block);
    const int columns = of.lattice_.columns;
    const auto place = [&](std::size_t p) { return glm::vec3(of.here_[0][p], of.here_[1][p], of.here_[2][p]); };
    if (to.parted) {
      const Particles particles = of.particles_of(block);
      for (std::size_t n = 0; n < to.at.size(); ++n) to.at[n] = place(std::size_t(particles[n]));
    } else {
      std::array<glm::vec3, std::size_t(span * span)> grid;
      for (int n = 0; n < span * span; ++n) {
        const int i = std::min(to.row + n / span, of.lattice_.rows - 1),
                  j = std::min(to.column + n % span, columns - 1);
        grid[std::size_t(n)] = place(std::size_t(i) * std::size_t(columns) + std::size_t(j));
      }
      for (int site = 0; site < sites; ++site)
        for (int n = 0; n < corners_of_cell; ++n)
          to.at[std::size_t(corners_of_cell * site + n)] =
              grid[std::size_t((site / side + n / 2) * span + site % side + n % 2)];
    }
    for (int site = 0; site < sites; ++site) {
      const int i = to.row + site / side, j = to.column + site % side;
      to.used[std::size_t(site)] = of.lattice_.contains(i, j) ? of.used_parts_[std::size_t(i * columns + j)] : 0;
      if (to.used[std::size_t(site)] != 0) to.used_sites |= 1u << site;
      const glm::vec3* at = &to.at[std::size_t(corners_of_cell * site)];
      const glm::vec3 least = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3])),
                      most = glm::max(glm::max(at[0], at[1]), glm::max(at[2], at[3]));
      for (int c = 0; c < 3; ++c)
        to.least[std::size_t(c)][std::size_t(site)] = least[c], to.most[std::size_t(c)][std::size_t(site)] = most[c];
    }
    add_steps(to);
  }

  static std::array<int, 4> sites_of(int quarter) {
    const int first = quarter / 2 * half * side + quarter % 2 * half;
    return {first, first + 1, first + side, first + side + 1};
  }

  /// The sites of the other block, as bits, whose quarters are even together with one of the first.
  unsigned evenly_beside(int quarter) const {
    unsigned all = 0;
    for (int other = 0; other < quarters; ++other)
      if (is_even(quarter, other))
        for (const int site : sites_of(other)) all |= 1u << site;
    return all;
  }

  static void add_steps(Sites& to) {
    const auto add = [](Box& box, const glm::vec3& step) { box = both(box, Box{step, step}); };
    for (int n = 0; n < quarters; ++n) {
      Box &along = to.along[std::size_t(n)], &down = to.down[std::size_t(n)];
      along = down = {glm::vec3(infinity), glm::vec3(-infinity)};
      for (const int site : sites_of(n)) {
        const glm::vec3* at = &to.at[std::size_t(corners_of_cell * site)];
        add(along, at[1] - at[0]), add(along, at[3] - at[2]);
        add(down, at[2] - at[0]), add(down, at[3] - at[1]);
      }
    }
  }

  /// Whether the cloth of two quarters side by side is so even that no parts of them are near.
  bool is_even(int n, int m) const {
    if (a_.parted || b_.parted) return false;
    const int rows = (b_.row - a_.row) / half + m / 2 - n / 2, columns = (b_.column - a_.column) / half + m % 2 - n % 2;
    if (std::abs(rows) > 1 || std::abs(columns) > 1) return false;
    Box along = both(a_.along[std::size_t(n)], b_.along[std::size_t(m)]),
        down = both(a_.down[std::size_t(n)], b_.down[std::size_t(m)]);
    // The other two of a square are beside the first, in one block or the other.
    if (rows != 0 && columns != 0)
      for (const auto& [di, dj] : {std::array{rows, 0}, std::array{0, columns}}) {
        const int i = n / 2 + di, j = n % 2 + dj;
        const bool in_a = i >= 0 && i < 2 && j >= 0 && j < 2;
        const int i_b = i - (b_.row - a_.row) / half, j_b = j - (b_.column - a_.column) / half;
        if (!in_a && !(i_b >= 0 && i_b < 2 && j_b >= 0 && j_b < 2)) return false;
        const Sites& of = in_a ? a_ : b_;
        const std::size_t quarter = std::size_t(in_a ? 2 * i + j : 2 * i_b + j_b);
        along = both(along, of.along[quarter]), down = both(down, of.down[quarter]);
      }
    return spread(along, down) > double(within_);
  }

  /// As seen from there.
  static Corners corners_of(const Sites& of, int site, const glm::vec3& from) {
    const glm::vec3* at = &of.at[std::size_t(corners_of_cell * site)];
    return {at[0] - from, at[1] - from, at[2] - from, at[3] - from};
  }

  /// Some directions: the line between the middles, and the normals of both quads and a side; of quads side by side the
  /// common normal, and in their plane what is across the rows and across the columns.
  static std::array<Lanes, 3> directions_of(const Corners& a, const Corners& b, bool beside) {
    const glm::vec3 between = b[0] + b[1] + b[2] + b[3] - (a[0] + a[1] + a[2] + a[3]);
    std::array<glm::vec3, 4> raw;
    if (beside) {
      const glm::vec3 e = a[1] - a[0] + a[3] - a[2] + b[1] - b[0] + b[3] - b[2],
                      s = a[2] - a[0] + a[3] - a[1] + b[2] - b[0] + b[3] - b[1], normal = glm::cross(e, s);
      raw = {between, normal, glm::cross(s, normal), glm::cross(normal, e)};
    } else {
      const glm::vec3 of_a = glm::cross(a[3] - a[0], a[2] - a[1]), of_b = glm::cross(b[3] - b[0], b[2] - b[1]);
      raw = {between, of_a, of_b, glm::cross(of_a, between)};
    }
    std::array<Lanes, 3> along;
    for (std::size_t n = 0; n < 4; ++n) along[0][n] = raw[n].x, along[1][n] = raw[n].y, along[2][n] = raw[n].z;
    for (std::size_t n = 0; n < 4; ++n) {
      const float squared = along[0][n] * along[0][n] + along[1][n] * along[1][n] + along[2][n] * along[2][n];
      const float scale = squared > 1e-30f ? 1 / std::sqrt(squared) : 0;
      along[0][n] *= scale, along[1][n] *= scale, along[2][n] *= scale;
    }
    return along;
  }

  static std::array<Lanes, 4> seen(const Corners& corners, const std::array<Lanes, 3>& along) {
    std::array<Lanes, 4> at;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t n = 0; n < 4; ++n)
        at[k][n] = corners[k].x * along[0][n] + corners[k].y * along[1][n] + corners[k].z * along[2][n];
    return at;
  }

  static void include(Extent& extent, const Lanes& at) {
    for (std::size_t n = 0; n < 4; ++n)
      extent.least[n] = std::min(extent.least[n], at[n]), extent.most[n] = std::max(extent.most[n], at[n]);
  }

  static Extents extents(const std::array<Lanes, 4>& at, int odd, bool parted) {
    Extents extents;
    for (std::size_t part = 0; part < std::size_t(parted ? parts_of_site : parts_of_whole); ++part) {
      const PartCorners& of = parts_by_parity[std::size_t(odd)][part];
      extents[part] = {at[std::size_t(of.at[0])], at[std::size_t(of.at[0])]};
      for (int k = 1; k < of.count; ++k) include(extents[part], at[std::size_t(of.at[std::size_t(k)])]);
    }
    return extents;
  }

  static Extent extent(const std::array<Lanes, 4>& at) {
    Extent all{at[0], at[0]};
    for (std::size_t k = 1; k < 4; ++k) include(all, at[k]);
    return all;
  }

  static float gap(const Extent& a, const Extent& b) {
    Lanes gaps;
    for (std::size_t n = 0; n < 4; ++n) gaps[n] = std::max(a.least[n] - b.most[n], b.least[n] - a.most[n]);
    return std::max(std::max(gaps[0], gaps[1]), std::max(gaps[2], gaps[3]));
  }

  void visit(int n, int m) {
    const int rows = b_.row + m / side - a_.row - n / side, columns = b_.column + m % side - a_.column - n % side;
    const int odd_a = (n / side + n) % 2, odd_b = (m / side + m) % 2;
    const bool beside = std::abs(rows) <= 1 && std::abs(columns) <= 1;
    std::uint64_t kinds =
        beside ? apart_by_offset[std::size_t(odd_a)][std::size_t(rows + 1)][std::size_t(columns + 1)] : all_pairs;
    if (!a_.parted && !b_.parted) kinds &= whole_pairs;
    if (same_ && n == m) kinds &= own_pairs;
    const glm::vec3& from = a_.at[std::size_t(corners_of_cell * n)];
    const Corners a = corners_of(a_, n, from), b = corners_of(b_, m, from);
    const auto along = directions_of(a, b, beside);
    const auto at_a = seen(a, along), at_b = seen(b, along);
    if (!beside && gap(extent(at_a), extent(at_b)) > within_) return;
    const Extents of_a = extents(at_a, odd_a, a_.parted), of_b = extents(at_b, odd_b, b_.parted);
    for (; kinds != 0; kinds &= kinds - 1) {
      const auto& [first, second] = kinds_of_pairs[std::size_t(std::countr_zero(kinds))];
      if ((a_.used[std::size_t(n)] >> first & 1) == 0 || (b_.used[std::size_t(m)] >> second & 1) == 0) continue;
      const float apart = gap(of_a[std::size_t(first)], of_b[std::size_t(second)]);
      if (apart > within_) continue;
      const float bound = std::min(std::max(apart - margin_, 0.0f) * per_unit_, float(most_bound));
      pairs_.push_back(
          {std::uint8_t(n * parts_of_site + first), std::uint8_t(m * parts_of_site + second), std::uint16_t(bound)});
    }
  }

  const NearPairs& of_;
  const float per_unit_, margin_;
  Sites a_, b_;
  bool same_ = false;
  float within_ = 0;
  std::vector<Pair> pairs_;
};

void NearPairs::make(List& list, Maker& maker) {
  ++made_;
  list.used = 0, list.least = infinity;
  list.left = apart(list) - reach_ - rounding_;
  const bool certain = list.left >= certain_per_L * L_;
  if (!certain) list.left = skin_per_L * L_;
  const std::span<const Pair> pairs =
      certain ? std::span<const Pair>() : maker.find(list, reach_ + list.left + rounding_);
  if (list.pairs.capacity() > 2 * pairs.size()) list.pairs = {};
  list.pairs.assign(pairs.begin(), pairs.end());
  for (const Pair& pair : pairs) list.least = std::min(list.least, float(pair.bound * (L_ / bound_per_L) * (1 - 1e-6)));
}

/// All whose use is over, and of those that cost little to make all whose use is nearly over.
void NearPairs::make_lists() {
  Maker maker(*this);
  for (List& list : lists_)
    if (list.left < (list.pairs.empty() ? worn * list.used : 0)) make(list, maker);
}

std::int64_t NearPairs::size() const {
  std::int64_t total = 0;
  for (const List& list : lists_) total += std::int64_t(list.pairs.size());
  return total;
}

std::size_t NearPairs::bytes() const {
  std::size_t total = used_parts_.capacity() * sizeof(used_parts_[0]) + places_of_.capacity() * sizeof(places_of_[0]) +
                      places_.capacity() * sizeof(Places) + sites_of_copies_.capacity() * sizeof(sites_of_copies_[0]) +
                      blocks_.capacity() * sizeof(Block) + lists_.capacity() * sizeof(List);
  for (const List& list : lists_) total += list.pairs.capacity() * sizeof(Pair);
  for (const auto* positions : {&here_, &last_})
    for (const auto& one : *positions) total += one.capacity() * sizeof(float);
  return total;
}

}  // namespace tyglab
