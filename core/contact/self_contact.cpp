#include "core/contact/self_contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tyglab {
namespace {

constexpr double reach_per_L = 0.4;
// How much nearer than when they were found pairs may be, and what that allows: half of it to each particle; of
// neighbors, whose parts are at most three rows and three columns apart, a sixth to each step on the way.
constexpr double skin_per_L = 0.3, neighbor_skin_per_L = 0.12;
constexpr double most_moved_per_L = skin_per_L / 2, most_changed_per_L = neighbor_skin_per_L / 6;
constexpr double default_thickness_per_L = 0.15, largest_thickness_per_L = 0.19;  // d stays below the reach
constexpr double share_of_gap = 0.9, least_gap_per_L = 1e-4;                      // γ and δ/L
constexpr double slow = 0.01;  // m/s: friction grows up to about this speed

/// Where a line from a to b comes nearest to p, from 0 to 1.
double nearest_on_line(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  return squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0;
}

/// Shares of a triangle's corners in its point nearest to p: of its inside, or of its nearest edge.
std::array<double, 3> nearest_in_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, normal = glm::cross(ab, ac);
  const double area = glm::dot(normal, normal);
  if (area > 0) {
    const double of_c = glm::dot(glm::cross(ab, ap), normal) / area, of_b = glm::dot(glm::cross(ap, ac), normal) / area;
    if (of_b >= 0 && of_c >= 0 && of_b + of_c <= 1) return {1 - of_b - of_c, of_b, of_c};
  }
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 3; ++n) {
    const glm::dvec3 &from = corners[n], &to = corners[(n + 1) % 3];
    const double t = nearest_on_line(p, from, to);
    const glm::dvec3 off = p - (from + t * (to - from));
    if (!(glm::dot(off, off) < least)) continue;
    least = glm::dot(off, off), best = {};
    best[n] = 1 - t, best[(n + 1) % 3] = t;
  }
  return best;
}

template <class Box>
Box both(const Box& a, const Box& b) {
  return {glm::min(a.least, b.least), glm::max(a.most, b.most)};
}

}  // namespace

Gap gap_to_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle) {
  const auto share = nearest_in_triangle(p, triangle);
  return {{1, -share[0], -share[1], -share[2]},
          p - (share[0] * triangle[0] + share[1] * triangle[1] + share[2] * triangle[2])};
}

Gap gap_of_edges(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b) {
  const glm::dvec3 u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  // The nearest points of the two lines, then the nearest ones within the edges.
  const double square = uu * vv - uv * uv;
  double s = square > 0 ? std::clamp((uv * vw - vv * uw) / square, 0.0, 1.0) : 0;
  double t = vv > 0 ? (uv * s + vw) / vv : 0;
  if (!(t >= 0 && t <= 1)) {
    t = t > 1 ? 1 : 0;
    s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0;
  }
  return {{1 - s, s, t - 1, -t}, w + s * u - t * v};
}

double contact_thickness(const Preset& preset) {
  return preset.thickness > 0 ? preset.thickness : default_thickness_per_L * preset.L;
}

double largest_thickness(double L) {
  return largest_thickness_per_L * L;
}

void SelfContact::set_preset(const Preset& preset, double k) {
  if (L_ != preset.L) known_torn_ = -1;
  L_ = preset.L, d_ = 2 * contact_thickness(preset);
  k_ = k, friction_ = preset.self_friction;
  assert(L_ > 0 && d_ > 0 && d_ < reach_per_L * L_);
}

bool SelfContact::stale(const Tears& tears, double way) const {
  return known_torn_ != tears.torn_count() || !(moved_ + way <= most_moved_per_L * L_) ||
         !(changed_ + 2 * way <= most_changed_per_L * L_);
}

/// The largest way of a particle since the list of others was made, beside that of the whole cloth, which brings
/// nothing nearer, m.
double SelfContact::farthest_way(Vectors x) const {
  const std::vector<glm::dvec3>& then = lists_[others].then;
  glm::dvec3 common{0};
  for (std::size_t p = 0; p < x.size(); ++p) common += x[p] - then[p];
  common /= double(x.size());
  double largest = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const glm::dvec3 way = x[p] - then[p] - common;
    largest = std::max(largest, glm::dot(way, way));
  }
  return std::sqrt(largest);
}

/// The largest change of a step from a particle to the next since the list of neighbors was made, m.
double SelfContact::largest_change(Vectors x) const {
  const std::vector<glm::dvec3>& then = lists_[neighbors].then;
  double largest = 0;
  const auto compare = [&](std::size_t p, std::size_t next) {
    const glm::dvec3 change = (x[next] - then[next]) - (x[p] - then[p]);
    largest = std::max(largest, glm::dot(change, change));
  };
  const std::size_t columns = std::size_t(lattice_.columns);
  for (std::size_t p = 0; p + columns < x.size(); ++p) compare(p, p + columns);
  for (std::size_t row = 0; row < x.size(); row += columns)
    for (std::size_t p = row; p + 1 < row + columns; ++p) compare(p, p + 1);
  return std::sqrt(largest);
}

void SelfContact::follow(const Tears& tears, Vectors x) {
  assert(x.size() == std::size_t(lattice_.size()) && tears.lattice().rows == lattice_.rows);
  std::array<bool, 2> anew{true, true};
  if (known_torn_ == tears.torn_count()) {
    moved_ = farthest_way(x), changed_ = largest_change(x);
    anew = {!(changed_ <= most_changed_per_L * L_ / 2), !(moved_ <= most_moved_per_L * L_ * 0.8)};
  } else {
    find_parts(tears);
  }
  if (anew[neighbors] || anew[others]) refit(x);
  for (const ListKind kind : {neighbors, others})
    if (anew[kind]) find_pairs(kind, x);
  known_torn_ = tears.torn_count();
}

/// Triangles whose springs are whole, their edges and corners.
void SelfContact::find_parts(const Tears& tears) {
  const std::size_t size = std::size_t(lattice_.size());
  whole_triangles_.assign(2 * size, 0), used_edges_.assign(edges_of_site * size, 0), used_particles_.assign(size, 0);
  odd_.resize(size);
  for (std::size_t p = 0; p < size; ++p)
    odd_[p] = std::uint8_t((p / std::size_t(lattice_.columns) + p % std::size_t(lattice_.columns)) % 2);
  for (int i = 0; i + 1 < lattice_.rows; ++i)
    for (int j = 0; j + 1 < lattice_.columns; ++j)
      for (const int which : {0, 1}) {
        if (!tears.triangle_whole(i, j, which)) continue;
        const int quad = i * lattice_.columns + j, number = 2 * quad + which;
        whole_triangles_[std::size_t(number)] = 1;
        for (const int corner : triangle(number)) used_particles_[std::size_t(corner)] = 1;
        // Its edges, by their owners: of a diagonal that is the quad.
        const auto [a, b, c] = triangle(number);
        for (const auto& [from, to] :
             {std::array{std::min(a, b), std::max(a, b)}, std::array{std::min(b, c), std::max(b, c)},
              std::array{std::min(a, c), std::max(a, c)}}) {
          const int step = to - from, kind = step == 1 ? 0 : step == lattice_.columns ? 1 : 2;
          used_edges_[std::size_t(edges_of_site * (kind < 2 ? from : quad) + kind)] = 1;
        }
      }
}

std::array<int, 3> SelfContact::triangle(int number) const {
  const int at = number / 2;
  const auto& corners = quad_triangles[odd_[std::size_t(at)]][std::size_t(number % 2)];
  const auto particle = [&](const Corner& corner) { return at + corner.di * lattice_.columns + corner.dj; };
  return {particle(corners[0]), particle(corners[1]), particle(corners[2])};
}

std::array<int, 2> SelfContact::edge(int number) const {
  const int at = number / edges_of_site, columns = lattice_.columns;
  switch (number % edges_of_site) {
    case 0:
      return {at, at + 1};
    case 1:
      return {at, at + columns};
    default:
      return odd_[std::size_t(at)] == 0 ? std::array{at, at + columns + 1} : std::array{at + 1, at + columns};
  }
}

std::array<int, 4> SelfContact::particles(const Pair& pair) const {
  if (pair.edges) {
    const auto a = edge(pair.first), b = edge(pair.second);
    return {a[0], a[1], b[0], b[1]};
  }
  const auto corners = triangle(pair.second);
  return {pair.first, corners[0], corners[1], corners[2]};
}

Gap SelfContact::gap(const Pair& pair, Vectors x) const {
  const auto at = particles(pair);
  const auto place = [&](std::size_t n) { return x[std::size_t(at[n])]; };
  return pair.edges ? gap_of_edges({place(0), place(1)}, {place(2), place(3)})
                    : gap_to_triangle(place(0), {place(1), place(2), place(3)});
}

/// The boxes of all levels, up to one that holds everything.
void SelfContact::refit(Vectors x) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr Box nothing{glm::vec3(infinity), glm::vec3(-infinity)};
  const auto place = [&](int i, int j) {
    return glm::vec3(x[std::size_t(i) * std::size_t(lattice_.columns) + std::size_t(j)] - origin_);
  };
  const auto add = [](Box& box, const glm::vec3& point) { box = both(box, Box{point, point}); };
  origin_ = x[x.size() / 2];
  if (levels_.empty())
    for (int rows = lattice_.rows, columns = lattice_.columns;; rows = (rows + 1) / 2, columns = (columns + 1) / 2) {
      levels_.push_back({rows, columns, std::vector<Node>(std::size_t(rows) * std::size_t(columns))});
      if (rows == 1 && columns == 1) break;
    }
  Level& sites = levels_.front();
  for (int i = 0; i < sites.rows; ++i)
    for (int j = 0; j < sites.columns; ++j) {
      Node& node = sites.nodes[std::size_t(i) * std::size_t(sites.columns) + std::size_t(j)];
      node = {nothing, nothing, nothing};
      const bool below = i + 1 < sites.rows, beside = j + 1 < sites.columns;
      const glm::vec3 here = place(i, j);
      add(node.at, here);
      if (beside) add(node.at, place(i, j + 1)), add(node.along, place(i, j + 1) - here);
      if (below) add(node.at, place(i + 1, j)), add(node.down, place(i + 1, j) - here);
      if (!below || !beside) continue;
      const glm::vec3 across = place(i + 1, j + 1);
      add(node.at, across), add(node.along, across - place(i + 1, j)), add(node.down, across - place(i, j + 1));
    }
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const Level& finer = levels_[n - 1];
    Level& level = levels_[n];
    for (int i = 0; i < level.rows; ++i)
      for (int j = 0; j < level.columns; ++j) {
        Node node = finer.at(2 * i, 2 * j);
        for (const auto [di, dj] : {Place{0, 1}, Place{1, 0}, Place{1, 1}}) {
          if (2 * i + di >= finer.rows || 2 * j + dj >= finer.columns) continue;
          const Node& other = finer.at(2 * i + di, 2 * j + dj);
          node = {both(node.at, other.at), both(node.along, other.along), both(node.down, other.down)};
        }
        level.nodes[std::size_t(i) * std::size_t(level.columns) + std::size_t(j)] = node;
      }
  }
  const Box& all = levels_.back().nodes.front().at;
  rounding_ = 4 * double(std::numeric_limits<float>::epsilon()) * double(glm::length(all.most - all.least));
}

void SelfContact::find_pairs(ListKind kind, Vectors x) {
  List& list = lists_[kind];
  list.pairs.clear(), list.then.assign(x.begin(), x.end());
  (kind == neighbors ? changed_ : moved_) = 0;
  list.within = (reach_per_L + (kind == neighbors ? neighbor_skin_per_L : skin_per_L)) * L_ + rounding_;
  if (std::isfinite(rounding_)) visit(kind, levels_.size() - 1, {0, 0}, {0, 0}, x);
}

/// Whether the cloth between two neighboring nodes is so even that parts of it which share no particle are farther
/// apart than the list asks for. On the way from one point of the triangles to another, first along the rows and then
/// down the columns, Δu and Δv sites far, each piece is the step of some spring. So the distance is |Δu e + Δv s|,
/// where e and s are means of steps and lie in their boxes. Parts that share no particle are at least √½ sites apart,
/// and those that are no neighbors at least near_sites.
bool SelfContact::spread_out(ListKind kind, std::size_t level, Place a, Place b) const {
  const Level& nodes = levels_[level];
  const Node &first = nodes.at(a.i, a.j), &second = nodes.at(b.i, b.j), &left = nodes.at(a.i, b.j),
             &right = nodes.at(b.i, a.j);
  const Box along = both(both(first.along, second.along), both(left.along, right.along));
  const Box down = both(both(first.down, second.down), both(left.down, right.down));
  const bool has_along = along.least.x <= along.most.x, has_down = down.least.x <= down.most.x;
  if (!has_along && !has_down) return true;
  const glm::vec3 e = has_along ? (along.least + along.most) / 2.0f : glm::vec3(0),
                  s = has_down ? (down.least + down.most) / 2.0f : glm::vec3(0);
  const glm::vec3 half_e = has_along ? (along.most - along.least) / 2.0f : glm::vec3(0),
                  half_s = has_down ? (down.most - down.least) / 2.0f : glm::vec3(0);
  const double ee = glm::dot(e, e), ss = glm::dot(s, s), es = glm::dot(e, s);
  const double least = !has_along ? ss : !has_down ? ee : (ee + ss) / 2 - std::hypot((ee - ss) / 2, es);
  const double radius = std::sqrt(double(glm::dot(half_e, half_e) + glm::dot(half_s, half_s)));
  const double apart = kind == neighbors ? 0.7071 : near_sites;
  return (std::sqrt(std::max(least, 0.0)) - radius) * apart > lists_[kind].within;
}

void SelfContact::visit(ListKind kind, std::size_t level, Place a, Place b, Vectors x) {
  const Level& nodes = levels_[level];
  const int across = std::abs(a.i - b.i), along = std::abs(a.j - b.j);
  // How many rows or columns of sites lie between them at least: (n - 1) · 2^level.
  if (kind == neighbors && ((std::max(across, along) - 1) << level) >= near_sites) return;
  const Box &first = nodes.at(a.i, a.j).at, &second = nodes.at(b.i, b.j).at;
  const glm::vec3 off = glm::max(glm::max(first.least - second.most, second.least - first.most), glm::vec3(0));
  if (double(glm::dot(off, off)) > lists_[kind].within * lists_[kind].within) return;
  if (across <= 1 && along <= 1 && spread_out(kind, level, a, b)) return;
  if (level == 0) {
    if ((std::max(across, along) <= near_sites) == (kind == neighbors)) visit_sites(lists_[kind], a, b, x);
    return;
  }
  const Level& finer = levels_[level - 1];
  const auto child = [&](Place of, int n) { return Place{2 * of.i + n / 2, 2 * of.j + n % 2}; };
  const auto exists = [&](Place at) { return at.i < finer.rows && at.j < finer.columns; };
  for (int n = 0; n < 4; ++n)
    for (int m = a == b ? n : 0; m < 4; ++m)
      if (exists(child(a, n)) && exists(child(b, m))) visit(kind, level - 1, child(a, n), child(b, m), x);
}

/// Whether the quads of two particles lie farther apart than that along the line between their middles.
bool SelfContact::sides_apart(Place a, Place b, double within, Vectors x) const {
  const auto corner = [&](Place of, int n) {
    const int i = std::min(of.i + n / 2, lattice_.rows - 1), j = std::min(of.j + n % 2, lattice_.columns - 1);
    return x[std::size_t(i) * std::size_t(lattice_.columns) + std::size_t(j)];
  };
  glm::dvec3 along{0};
  for (int n = 0; n < 4; ++n) along += corner(b, n) - corner(a, n);
  double last = -std::numeric_limits<double>::infinity(), first = -last;
  for (int n = 0; n < 4; ++n)
    last = std::max(last, glm::dot(corner(a, n), along)), first = std::min(first, glm::dot(corner(b, n), along));
  return first > last && (first - last) * (first - last) > within * within * glm::dot(along, along);
}

/// What two particles own: themselves, the edges to the right, down and across, and the triangles between.
void SelfContact::visit_sites(List& list, Place a, Place b, Vectors x) const {
  const int first = a.i * lattice_.columns + a.j, second = b.i * lattice_.columns + b.j;
  if (std::max(std::abs(a.i - b.i), std::abs(a.j - b.j)) > 1 && sides_apart(a, b, list.within, x)) return;
  const auto meet = [&](int particle, int other) {
    for (const int triangle : {2 * other, 2 * other + 1})
      if (used_particles_[std::size_t(particle)] != 0 && whole_triangles_[std::size_t(triangle)] != 0)
        keep_if_near(list, {particle, triangle, false}, x);
  };
  meet(first, second);
  if (a == b) return;  // its edges share particles
  meet(second, first);
  for (int n = edges_of_site * first; n < edges_of_site * (first + 1); ++n)
    for (int m = edges_of_site * second; m < edges_of_site * (second + 1); ++m)
      if (used_edges_[std::size_t(n)] != 0 && used_edges_[std::size_t(m)] != 0) keep_if_near(list, {n, m, true}, x);
}

void SelfContact::keep_if_near(List& list, const Pair& pair, Vectors x) const {
  const auto at = particles(pair);
  const std::size_t in_first = pair.edges ? 2 : 1;
  // Neither shares a particle, nor lies wholly on one side of the other in some coordinate.
  for (std::size_t n = 0; n < in_first; ++n)
    for (std::size_t m = in_first; m < at.size(); ++m)
      if (at[n] == at[m]) return;
  for (int c = 0; c < 3; ++c) {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    for (std::size_t n = 0; n < at.size(); ++n) {
      const double value = x[std::size_t(at[n])][c];
      double &low = least[n < in_first ? 0 : 1], &high = most[n < in_first ? 0 : 1];
      low = std::min(low, value), high = std::max(high, value);
    }
    if (least[0] - most[1] > list.within || least[1] - most[0] > list.within) return;
  }
  const glm::dvec3 between = gap(pair, x).between;
  if (glm::dot(between, between) <= list.within * list.within) list.pairs.push_back(pair);
}

void SelfContact::look(Vectors x, bool room) {
  assert(x.size() == std::size_t(lattice_.size()));
  touches_.clear();
  if (room) room_.assign(x.size(), reach_per_L * L_);
  for (const List& list : lists_)
    for (const Pair& pair : list.pairs) {
      const Gap gap = this->gap(pair, x);
      const double squared = glm::dot(gap.between, gap.between);
      const auto at = particles(pair);
      if (room && squared < std::pow(reach_per_L * L_, 2)) {
        const double distance = std::sqrt(squared);
        for (const int particle : at) room_[std::size_t(particle)] = std::min(room_[std::size_t(particle)], distance);
      }
      if (!(squared < d_ * d_) || squared == 0) continue;
      const double distance = std::sqrt(squared);
      touches_.push_back({at, gap.weights, gap.between / distance, d_ - distance});
    }
}

double SelfContact::add_forces(std::span<glm::dvec3> F) const {
  const double k = k_ / (d_ * d_);
  double energy = 0;
  for (const Touch& touch : touches_) {
    energy += touch.push(k) * touch.s / 4;
    const glm::dvec3 force = touch.push(k) * touch.normal;
    for (std::size_t n = 0; n < touch.at.size(); ++n) F[std::size_t(touch.at[n])] += touch.weights[n] * force;
  }
  return energy;
}

void SelfContact::add_friction(Vectors v, std::span<glm::dvec3> F) const {
  const double k = k_ / (d_ * d_);
  for (const Touch& touch : touches_) {
    glm::dvec3 slip{0};
    for (std::size_t n = 0; n < touch.at.size(); ++n) slip += touch.weights[n] * v[std::size_t(touch.at[n])];
    slip -= glm::dot(slip, touch.normal) * touch.normal;
    const glm::dvec3 force = -friction_ * touch.push(k) / std::sqrt(glm::dot(slip, slip) + slow * slow) * slip;
    for (std::size_t n = 0; n < touch.at.size(); ++n) F[std::size_t(touch.at[n])] += touch.weights[n] * force;
  }
}

double SelfContact::least_room() const {
  return near() ? 0 : share_of_gap / 2 * (reach_per_L - least_gap_per_L) * L_;
}

std::span<const SelfContact::Held> SelfContact::hold_back(Vectors x_before, std::span<glm::dvec3> x, bool free) {
  assert(x_before.size() == x.size());
  held_.clear();
  common_ = glm::dvec3(0);
  double farthest = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    common_ += x[p] - x_before[p];
    for (int c = 0; c < 3; ++c) farthest = std::max(farthest, std::abs(x_before[p][c]));
  }
  common_ = free ? common_ / double(x.size()) : glm::dvec3(0);
  // Positions may be kept in float.
  constexpr double roundings = 8;
  const double left =
      std::max(least_gap_per_L * L_, roundings * double(std::numeric_limits<float>::epsilon()) * farthest);
  for (std::size_t p = 0; p < x.size(); ++p) {
    const glm::dvec3 way = x[p] - x_before[p] - common_;
    const double length = glm::length(way), room = near() ? room_[p] : reach_per_L * L_,
                 most = share_of_gap / 2 * std::max(room - left, 0.0);
    if (!(length > most) || !std::isfinite(length)) continue;
    const double part = most / length;
    x[p] = x_before[p] + common_ + part * way;
    held_.push_back({int(p), part});
  }
  return held_;
}

std::size_t SelfContact::bytes() const {
  std::size_t total = held_.capacity() * sizeof(Held);
  for (const List& list : lists_)
    total += list.pairs.capacity() * sizeof(Pair) + list.then.capacity() * sizeof(glm::dvec3);
  total += whole_triangles_.capacity() + used_edges_.capacity() + used_particles_.capacity() + odd_.capacity();
  total += room_.capacity() * sizeof(double) + touches_.capacity() * sizeof(Touch);
  for (const Level& level : levels_) total += level.nodes.capacity() * sizeof(Node);
  return total;
}

}  // namespace tyglab
