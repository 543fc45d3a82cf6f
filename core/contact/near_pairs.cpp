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

/// Corners of a site's parts, as 2·di + dj, by the parity of the site: particle, triangles, edges.
struct PartCorners {
  int count;
  std::array<int, 3> at;
};
constexpr std::array<std::array<PartCorners, 6>, 2> parts_by_parity = [] {
  std::array<std::array<PartCorners, 6>, 2> all{};
  for (std::size_t odd = 0; odd < 2; ++odd) {
    all[odd][0] = {1, {0, 0, 0}};
    for (std::size_t which = 0; which < 2; ++which) {
      all[odd][1 + which].count = 3;
      for (std::size_t n = 0; n < 3; ++n)
        all[odd][1 + which].at[n] = 2 * quad_triangles[odd][which][n].di + quad_triangles[odd][which][n].dj;
    }
    all[odd][3] = {2, {0, 1, 0}}, all[odd][4] = {2, {0, 2, 0}};
    all[odd][5] = odd == 0 ? PartCorners{2, {0, 3, 0}} : PartCorners{2, {1, 2, 0}};
  }
  return all;
}();

}  // namespace

NearPairs::NearPairs(const Lattice& lattice)
    : lattice_(lattice),
      block_rows_((lattice.rows + side - 1) / side),
      block_columns_((lattice.columns + side - 1) / side) {
  for (int n = 0; n < own; ++n) offsets_[std::size_t(n)] = n / span * lattice.columns + n % span;
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
        const int i = site / side, j = site % side;
        const PartCorners& corners = parts_by_parity[std::size_t((i + j) % 2)][std::size_t(n)];
        Part& part = parts[std::size_t(site * parts_of_site + n)];
        part.count = corners.count;
        for (std::size_t k = 0; k < 3; ++k)
          part.at[k] = std::uint8_t((i + corners.at[k] / 2) * span + j + corners.at[k] % 2);
      }
    return parts;
  }();
  return all;
}

/// Triangles whose springs are whole, their edges and corners.
void NearPairs::find_parts(const Tears& tears) {
  const int columns = lattice_.columns;
  used_parts_.assign(std::size_t(lattice_.size()), 0);
  const auto use = [&](int site, int part) { used_parts_[std::size_t(site)] |= std::uint8_t(1 << part); };
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
  assert(x.size() == std::size_t(lattice_.size()) && tears.lattice().rows == lattice_.rows);
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
  const Block &left = blocks_[std::size_t(list.a / block_columns_ * block_columns_ + list.b % block_columns_)],
              &right = blocks_[std::size_t(list.b / block_columns_ * block_columns_ + list.a % block_columns_)];
  return spread(both(both(a.along, b.along), both(left.along, right.along)),
                both(both(a.down, b.down), both(left.down, right.down)));
}

/// Numbers along some directions at once.
using Lanes = std::array<float, 4>;

/// The two kinds of pairs that parts of two sites make, by the parts' numbers.
constexpr std::array<std::array<int, 2>, 13> kinds_of_pairs{
    {{0, 1}, {0, 2}, {1, 0}, {2, 0}, {3, 3}, {3, 4}, {3, 5}, {4, 3}, {4, 4}, {4, 5}, {5, 3}, {5, 4}, {5, 5}}};
constexpr unsigned all_pairs = (1u << kinds_of_pairs.size()) - 1, own_pairs = 3;  // of one site: not twice

/// Which of them share no particle, as bits, by the first site's parity and how many rows and columns the second is
/// behind it, from -1 to 1.
constexpr auto apart_by_offset = [] {
  std::array<std::array<std::array<unsigned, 3>, 3>, 2> table{};
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
          if (!shared) table[std::size_t(odd)][std::size_t(di + 1)][std::size_t(dj + 1)] |= 1u << kind;
        }
  return table;
}();

/// The sites of a block, as floats.
struct NearPairs::Sites {
  std::array<glm::vec3, own> at;
  std::array<std::array<float, sites>, 3> least, most;  ///< of the particles of each site
  std::array<std::uint8_t, sites> used;                 ///< the bits of its parts
  unsigned used_sites;                                  ///< those with any, as bits
  int block = -1;
  int row, column;                        ///< of its first site in the lattice
  std::array<Box, quarters> along, down;  ///< steps in its quarters
};

/// Finds the pairs of two blocks whose distance along none of some directions is larger than `within`.
class NearPairs::Maker {
 public:
  explicit Maker(const NearPairs& of) : of_(of), per_unit_(float(65536 / of.L_)), margin_(float(of.rounding_)) {}

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
  using Corners = std::array<glm::vec3, 4>;
  using Extents = std::array<Extent, std::size_t(parts_of_site)>;

  void gather(int block, Sites& to) const {
    if (to.block == block) return;
    const NearPairs& of = of_;
    to.block = block, to.row = block / of.block_columns_ * side, to.column = block % of.block_columns_ * side;
    to.used_sites = 0;
    const int columns = of.lattice_.columns;
    for (int n = 0; n < own; ++n) {
      const int i = std::min(to.row + n / span, of.lattice_.rows - 1), j = std::min(to.column + n % span, columns - 1);
      const std::size_t p = std::size_t(i) * std::size_t(columns) + std::size_t(j);
      to.at[std::size_t(n)] = {of.here_[0][p], of.here_[1][p], of.here_[2][p]};
    }
    for (int site = 0; site < sites; ++site) {
      const int i = to.row + site / side, j = to.column + site % side;
      to.used[std::size_t(site)] = of.lattice_.contains(i, j) ? of.used_parts_[std::size_t(i * columns + j)] : 0;
      if (to.used[std::size_t(site)] != 0) to.used_sites |= 1u << site;
      const glm::vec3 *upper = &to.at[std::size_t(site / side * span + site % side)], *lower = upper + span;
      const glm::vec3 least = glm::min(glm::min(upper[0], upper[1]), glm::min(lower[0], lower[1])),
                      most = glm::max(glm::max(upper[0], upper[1]), glm::max(lower[0], lower[1]));
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
      const glm::vec3* first = &to.at[std::size_t(n / 2 * half * span + n % 2 * half)];
      for (int i = 0; i <= half; ++i)
        for (int j = 0; j <= half; ++j) {
          const glm::vec3* here = first + i * span + j;
          if (j < half) add(along, here[1] - here[0]);
          if (i < half) add(down, here[span] - here[0]);
        }
    }
  }

  /// Whether the cloth of two quarters side by side is so even that no parts of them are near.
  bool is_even(int n, int m) const {
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
  static Corners corners(const Sites& of, int site, const glm::vec3& from) {
    const glm::vec3 *upper = &of.at[std::size_t(site / side * span + site % side)], *lower = upper + span;
    return {upper[0] - from, upper[1] - from, lower[0] - from, lower[1] - from};
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

  static Extents extents(const std::array<Lanes, 4>& at, int odd) {
    Extents extents;
    for (std::size_t part = 0; part < extents.size(); ++part) {
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
    unsigned kinds =
        beside ? apart_by_offset[std::size_t(odd_a)][std::size_t(rows + 1)][std::size_t(columns + 1)] : all_pairs;
    if (same_ && n == m) kinds &= own_pairs;
    const glm::vec3& from = a_.at[std::size_t(n / side * span + n % side)];
    const Corners a = corners(a_, n, from), b = corners(b_, m, from);
    const auto along = directions_of(a, b, beside);
    const auto at_a = seen(a, along), at_b = seen(b, along);
    if (!beside && gap(extent(at_a), extent(at_b)) > within_) return;
    const Extents of_a = extents(at_a, odd_a), of_b = extents(at_b, odd_b);
    for (; kinds != 0; kinds &= kinds - 1) {
      const auto& [first, second] = kinds_of_pairs[std::size_t(std::countr_zero(kinds))];
      if ((a_.used[std::size_t(n)] >> first & 1) == 0 || (b_.used[std::size_t(m)] >> second & 1) == 0) continue;
      const float apart = gap(of_a[std::size_t(first)], of_b[std::size_t(second)]);
      if (apart > within_) continue;
      const float bound = std::max(apart - margin_, 0.0f) * per_unit_;
      pairs_.emplace_back(n * parts_of_site + first, m * parts_of_site + second, std::uint32_t(bound));
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
  for (const Pair& pair : pairs) list.least = std::min(list.least, float(pair.bound() * (L_ / 65536) * (1 - 1e-6)));
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
  std::size_t total = used_parts_.capacity() + blocks_.capacity() * sizeof(Block) + lists_.capacity() * sizeof(List);
  for (const List& list : lists_) total += list.pairs.capacity() * sizeof(Pair);
  for (const auto* positions : {&here_, &last_})
    for (const auto& one : *positions) total += one.capacity() * sizeof(float);
  return total;
}

}  // namespace tyglab
