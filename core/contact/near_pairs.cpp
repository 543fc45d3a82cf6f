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
    for (List& list : lists_)
      if (list.left <= worn * list.used) make(list);
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
using Lanes = std::array<float, 8>;

/// The sites of a block, as floats.
struct NearPairs::Sites {
  std::array<glm::vec3, own> at;
  std::array<std::array<float, sites>, 3> least, most;  ///< of the particles of each site
  std::array<std::uint8_t, sites> used;                 ///< the bits of its parts
  int row, column;                                      ///< of its first site in the lattice
  std::array<Box, quarters> along, down;                ///< steps in its quarters
};

/// Finds the pairs of two blocks whose distance along none of some directions is larger than `within`.
class NearPairs::Maker {
 public:
  Maker(const NearPairs& of, const List& list, double within)
      : same_(list.a == list.b), adjacent_(of.adjacent(list.a, list.b)), within_(float(within)) {
    gather(of, list.a, a_), gather(of, list.b, b_);
    per_unit_ = float(65536 / of.L_), margin_ = float(of.rounding_);
    if (!adjacent_) return;
    add_steps(a_), add_steps(b_);
    for (int n = 0; n < quarters; ++n)
      for (int m = 0; m < quarters; ++m) even_[std::size_t(n * quarters + m)] = is_even(n, m);
  }

  void find(std::vector<Pair>& into) {
    into_ = &into;
    for (int n = 0; n < sites; ++n) {
      if (a_.used[std::size_t(n)] == 0) continue;
      std::array<float, sites> off{};
      for (std::size_t c = 0; c < 3; ++c) {
        const float least = a_.least[c][std::size_t(n)], most = a_.most[c][std::size_t(n)];
        for (std::size_t m = 0; m < sites; ++m)
          off[m] = std::max(off[m], std::max(b_.least[c][m] - most, least - b_.most[c][m]));
      }
      for (int m = same_ ? n : 0; m < sites; ++m)
        if (off[std::size_t(m)] <= within_ && b_.used[std::size_t(m)] != 0 &&
            !(adjacent_ && even_[std::size_t(quarter_of(n) * quarters + quarter_of(m))]))
          visit(n, m);
    }
  }

 private:
  /// Where a part lies along each direction.
  struct Extent {
    Lanes least, most;
  };
  using Extents = std::array<Extent, std::size_t(parts_of_site)>;

  static void gather(const NearPairs& of, int block, Sites& to) {
    to.row = block / of.block_columns_ * side, to.column = block % of.block_columns_ * side;
    const int columns = of.lattice_.columns;
    for (int n = 0; n < own; ++n) {
      const int i = std::min(to.row + n / span, of.lattice_.rows - 1), j = std::min(to.column + n % span, columns - 1);
      const std::size_t p = std::size_t(i) * std::size_t(columns) + std::size_t(j);
      to.at[std::size_t(n)] = {of.here_[0][p], of.here_[1][p], of.here_[2][p]};
    }
    for (int site = 0; site < sites; ++site) {
      const int i = to.row + site / side, j = to.column + site % side;
      to.used[std::size_t(site)] = of.lattice_.contains(i, j) ? of.used_parts_[std::size_t(i * columns + j)] : 0;
      const glm::vec3 *upper = &to.at[std::size_t(site / side * span + site % side)], *lower = upper + span;
      const glm::vec3 least = glm::min(glm::min(upper[0], upper[1]), glm::min(lower[0], lower[1])),
                      most = glm::max(glm::max(upper[0], upper[1]), glm::max(lower[0], lower[1]));
      for (int c = 0; c < 3; ++c)
        to.least[std::size_t(c)][std::size_t(site)] = least[c], to.most[std::size_t(c)][std::size_t(site)] = most[c];
    }
  }

  static int quarter_of(int site) { return site / side / half * 2 + site % side / half; }

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
  static std::array<glm::vec3, 4> corners(const Sites& of, int site, const glm::vec3& from) {
    const glm::vec3 *upper = &of.at[std::size_t(site / side * span + site % side)], *lower = upper + span;
    return {upper[0] - from, upper[1] - from, lower[0] - from, lower[1] - from};
  }

  /// A direction, or none where that has no length.
  static glm::vec3 direction(const glm::vec3& along) {
    const float squared = glm::dot(along, along);
    return squared > 1e-30f ? along / std::sqrt(squared) : glm::vec3(0);
  }

  static Extents extents(const std::array<glm::vec3, 4>& corners, const std::array<Lanes, 3>& along, int odd) {
    std::array<Lanes, 4> at;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t n = 0; n < 8; ++n)
        at[k][n] = corners[k].x * along[0][n] + corners[k].y * along[1][n] + corners[k].z * along[2][n];
    Extents extents;
    for (std::size_t part = 0; part < extents.size(); ++part) {
      const PartCorners& of = parts_by_parity[std::size_t(odd)][part];
      Extent& to = extents[part];
      to.least = to.most = at[std::size_t(of.at[0])];
      for (int k = 1; k < of.count; ++k) {
        const Lanes& next = at[std::size_t(of.at[std::size_t(k)])];
        for (std::size_t n = 0; n < 8; ++n)
          to.least[n] = std::min(to.least[n], next[n]), to.most[n] = std::max(to.most[n], next[n]);
      }
    }
    return extents;
  }

  static float largest_gap(const Extent& a, const Extent& b) {
    Lanes gaps;
    for (std::size_t n = 0; n < 8; ++n) gaps[n] = std::max(a.least[n] - b.most[n], b.least[n] - a.most[n]);
    for (std::size_t n = 0; n < 4; ++n) gaps[n] = std::max(gaps[n], gaps[n + 4]);
    return std::max(std::max(gaps[0], gaps[1]), std::max(gaps[2], gaps[3]));
  }

  /// Directions: the axes, the line between the middles, and the normals of both quads.
  void visit(int n, int m) {
    const glm::vec3& from = a_.at[std::size_t(n / side * span + n % side)];
    const auto a = corners(a_, n, from), b = corners(b_, m, from);
    const glm::vec3 between = direction(b[0] + b[1] + b[2] + b[3] - (a[0] + a[1] + a[2] + a[3])),
                    normal_a = direction(glm::cross(a[3] - a[0], a[2] - a[1])),
                    normal_b = direction(glm::cross(b[3] - b[0], b[2] - b[1]));
    std::array<Lanes, 3> along;
    for (int c = 0; c < 3; ++c)
      along[std::size_t(c)] = {float(c == 0), float(c == 1), float(c == 2), between[c], normal_a[c], normal_b[c]};
    const int odd_a = (n / side + n) % 2, odd_b = (m / side + m) % 2;
    const Extents of_a = extents(a, along, odd_a), of_b = extents(b, along, odd_b);
    const bool own_site = same_ && n == m;
    const auto meet = [&](int first, int second) {
      if ((a_.used[std::size_t(n)] >> first & 1) == 0 || (b_.used[std::size_t(m)] >> second & 1) == 0) return;
      const Extent &one = of_a[std::size_t(first)], &other = of_b[std::size_t(second)];
      const float apart = largest_gap(one, other);
      if (apart > within_ || (adjacent_ && share(n, first, m, second))) return;
      const float bound = std::max(apart - margin_, 0.0f) * per_unit_;
      into_->emplace_back(n * parts_of_site + first, m * parts_of_site + second, std::uint32_t(bound));
    };
    for (const int triangle : {1, 2}) meet(0, triangle);
    if (own_site) return;  // the edges of a site share particles
    for (const int triangle : {1, 2}) meet(triangle, 0);
    for (int first = 3; first < parts_of_site; ++first)
      for (int second = 3; second < parts_of_site; ++second) meet(first, second);
  }

  /// Whether two parts have a particle in common.
  bool share(int n, int first, int m, int second) const {
    const int rows = b_.row + m / side - a_.row - n / side, columns = b_.column + m % side - a_.column - n % side;
    if (std::abs(rows) > 1 || std::abs(columns) > 1) return false;
    const PartCorners &one = parts_by_parity[std::size_t((n / side + n) % 2)][std::size_t(first)],
                      &other = parts_by_parity[std::size_t((m / side + m) % 2)][std::size_t(second)];
    for (int k = 0; k < one.count; ++k)
      for (int l = 0; l < other.count; ++l) {
        const int from = one.at[std::size_t(k)], to = other.at[std::size_t(l)];
        if (from / 2 == rows + to / 2 && from % 2 == columns + to % 2) return true;
      }
    return false;
  }

  Sites a_, b_;
  const bool same_, adjacent_;
  const float within_;
  float per_unit_ = 0, margin_ = 0;
  std::array<bool, std::size_t(quarters* quarters)> even_{};
  std::vector<Pair>* into_ = nullptr;
};

void NearPairs::make(List& list) {
  ++made_;
  list.pairs.clear();
  list.used = 0, list.least = infinity;
  list.left = apart(list) - reach_ - rounding_;
  if (list.left >= certain_per_L * L_) return;
  list.left = skin_per_L * L_;
  Maker(*this, list, reach_ + list.left + rounding_).find(list.pairs);
  for (const Pair& pair : list.pairs)
    list.least = std::min(list.least, float(pair.bound() * (L_ / 65536) * (1 - 1e-6)));
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
