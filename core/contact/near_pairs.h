// Which parts of a cloth are near each other: lists that are kept while the cloth moves, and made anew only where it
// has moved enough.
//
// Parts are the particles, edges and triangles of whole triangles. Two kinds of pairs matter, a particle and a triangle
// or two edges, of parts that share no particle: two triangles that do not cross, come to cross through one of them.
// Where the cloth has parted (core/cloth/mesh.h) parts share no site either: copies begin where their site is, so pairs
// of parts around one site are not kept apart.
//
// The lattice is divided into blocks of 4 x 4 sites, and each two blocks that may be near have a list. Both know how
// much nearer their parts can have come since: whenever the cloth is followed, each list counts how far any point of
// one block has moved relative to any of the other, from boxes around what the particles of each block have moved. A
// list holds for so long as that is less than what its parts were beyond the reach when it was made; so does the search
// for blocks that are near. Each pair has a bound of its distance, too, and is measured only if that has been used up.
//
// Boxes and bounds are in float. What rounding may take from them is taken from the bounds when they are made.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/cloth/state.h"
#include "core/contact/gap.h"

namespace tyglab {

class NearPairs {
 public:
  using Vectors = std::span<const glm::dvec3>;  ///< one for each particle, copies behind those of the sites

  explicit NearPairs(const Lattice& lattice);

  /// Up to which distance pairs are found, m. Nothing is known after a change.
  void set_distances(double L, double reach);
  /// Something other than steps has changed the cloth or its tears: nothing is known any more.
  void forget() { known_torn_ = -1; }
  /// Whether follow() must be asked, after particles have moved by `way` at most since it was, m.
  bool stale(const Tears& tears, double way) const { return known_torn_ != tears.torn_count() || !(2 * way <= left_); }
  /// Brings the lists to these positions (m).
  void follow(const Tears& tears, Vectors x);
  /// The same between two of these calls, in which nothing has torn.
  void follow(Vectors x);
  /// Whether any pair may be within the reach.
  bool near() const { return near_; }

  /// Calls visit(particles, gap, distance) for pairs nearer than `below`, m, which is at most the reach: at the
  /// positions followed last, in an order that depends on the lattice alone.
  template <class Visit>
  void measure(double below, Vectors x, Visit visit);

  /// More than any coordinate of the positions followed last, m.
  double farthest() const {
    return farthest_ + std::max({std::abs(origin_.x), std::abs(origin_.y), std::abs(origin_.z)});
  }

  /// Pairs in all lists, and how many lists have been made.
  std::int64_t size() const;
  std::int64_t made() const { return made_; }
  std::size_t bytes() const;

 private:
  static constexpr int side = 4, sites = side * side;  ///< of a block
  static constexpr int span = side + 1;                ///< rows and columns of the particles of its parts
  static constexpr int half = side / 2, quarters = 4;  ///< of 2 x 2 sites
  static constexpr int corners_of_cell = 4;            ///< of the cell below and to the right of a site
  /// A site's particle, the two triangles of its cell and three of its edges; then, of a parted cloth, the particles of
  /// the cell's other corners and its other two edges.
  static constexpr int parts_of_site = 11, parts_of_whole = 6;

  struct Box {
    glm::vec3 least{0}, most{0};
  };
  /// Around the particles of a block's parts, the steps between them along the rows and down the columns, and what they
  /// have moved.
  struct Block {
    Box at, along, down, moved;
  };
  /// Numbers of two parts in their blocks, and a bound of their distance when the list was made, in units of
  /// L/bound_per_L.
  struct Pair {
    std::uint8_t first, second;
    std::uint16_t bound;
  };
  static constexpr int bound_per_L = 1 << 15, most_bound = (1 << 16) - 1;
  /// Of two blocks, of which the first is not behind the second.
  struct List {
    List(int of_a, int of_b) : a(of_a), b(of_b) {}
    std::int32_t a, b;
    double left = -1;  ///< how much nearer its parts may come before it lacks some within the reach, m
    double used = 0;   ///< how much nearer they may have come since it was made, m
    float least = std::numeric_limits<float>::infinity();  ///< bound of its nearest pair when it was made, m
    std::vector<Pair> pairs;
  };
  /// The particles of a part, by their places in its block: corner n of the cell of its site s is at corners_of_cell·s
  /// + n.
  struct Part {
    int count = 0;
    std::array<std::uint8_t, 3> at{};
  };
  using Places = std::array<std::int32_t, std::size_t(sites* corners_of_cell)>;
  struct Sites;
  class Maker;

  static const std::array<Part, std::size_t(sites* parts_of_site)>& parts();
  void find_parts(const Tears& tears);
  void find_parts(const Mesh& mesh);
  void find_places(const Mesh& mesh);
  template <class Value>
  void include_copies(Box Block::*box, const Value& value);
  template <class Visit>
  void for_each_block_of(int site, const Visit& visit) const;
  bool parted(int block) const { return !places_of_.empty() && places_of_[std::size_t(block)] >= 0; }
  bool take(Vectors x);
  template <class Value>
  void refit(Box Block::*box, int rows, int columns, const Value& value);
  void refit_all();
  void find_lists();
  void make_lists();
  void make(List& list, Maker& maker);
  static double spread(const Box& along, const Box& down);
  double apart(const List& list) const;
  double approach(const Box& a, const Box& b) const;
  bool adjacent(int a, int b) const;
  int first_particle(int block) const {
    return side * (block / block_columns_) * lattice_.columns + side * (block % block_columns_);
  }
  /// The particles of a block: at each place `from` and the number there.
  struct Particles {
    int from;
    const Places& at;
    int operator[](std::size_t place) const { return from + at[place]; }
  };
  Particles particles_of(int block) const {
    if (!parted(block)) return {first_particle(block), offsets_};
    return {0, places_[std::size_t(places_of_[std::size_t(block)])]};
  }
  void begin_anew(Vectors x);

  Lattice lattice_;  ///< its sites
  int block_rows_, block_columns_;
  Places offsets_;                       ///< from a block's first particle to the others, where it has not parted
  std::vector<std::int32_t> places_of_;  ///< of each block: where in `places_`; -1: it has not parted. Empty: none has
  std::vector<Places> places_;
  std::vector<std::int32_t> sites_of_copies_;
  double L_ = 0, reach_ = 0;
  int known_torn_ = -1;
  std::vector<std::uint16_t> used_parts_;          ///< of each site, a bit for each of its parts
  glm::dvec3 origin_{0};                           ///< of what is in float
  double farthest_ = 0, rounding_ = 0;             ///< up to where it reaches, and what it may be wrong by, m
  std::array<std::vector<float>, 3> here_, last_;  ///< positions at this follow() and that before
  std::vector<Block> blocks_;
  std::vector<List> lists_;  ///< rising by a, then b
  double search_left_ = -1;  ///< how much nearer any parts may come before blocks without a list may be near, m
  double left_ = -1;         ///< how much nearer any parts may come before follow() must be asked, m
  bool near_ = false;
  std::int64_t made_ = 0;
};

template <class Visit>
void NearPairs::measure(double below, Vectors x, Visit visit) {
  const auto& part_of = parts();
  const double unit = L_ / bound_per_L;
  constexpr double most = most_bound;
  for (List& list : lists_) {
    if (!(double(list.least) - list.used < below)) continue;
    const Particles of_a = particles_of(list.a), of_b = particles_of(list.b);
    std::uint32_t least = std::uint32_t(most);
    const std::uint32_t asked = std::uint32_t(std::min(std::max((below + list.used) / unit, 0.0), most - 1)) + 1;
    for (Pair& pair : list.pairs) {
      if (pair.bound < asked) {
        const Part *first = &part_of[pair.first], *second = &part_of[pair.second];
        const Particles *particles_first = &of_a, *particles_second = &of_b;
        if (second->count == 1) std::swap(first, second), std::swap(particles_first, particles_second);
        const auto of_first = [&](std::size_t n) { return (*particles_first)[first->at[n]]; };
        const auto of_second = [&](std::size_t n) { return (*particles_second)[second->at[n]]; };
        const bool edges = first->count == 2;
        const std::array<int, 4> at{of_first(0), edges ? of_first(1) : of_second(0), of_second(edges ? 0 : 1),
                                    of_second(edges ? 1 : 2)};
        const auto place = [&](std::size_t n) { return x[std::size_t(at[n])]; };
        const Gap gap = edges ? gap_of_edges({place(0), place(1)}, {place(2), place(3)})
                              : gap_to_triangle(place(0), {place(1), place(2), place(3)});
        const double distance = std::sqrt(glm::dot(gap.between, gap.between));
        if (distance < below) visit(at, gap, distance);
        pair.bound = std::uint16_t(std::clamp((distance + list.used - rounding_) / unit, 0.0, most));
      }
      least = std::min(least, std::uint32_t(pair.bound));
    }
    list.least = float(least * unit * (1 - 1e-6));
  }
}

}  // namespace tyglab
