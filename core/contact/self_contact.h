// Contact of the cloth with itself: which of its parts are near, the force between them, and the guard that keeps them
// apart.
//
// Parts are the particles, edges and triangles of whole triangles. Two kinds of pairs matter, a particle and a triangle
// or two edges, of parts that share no particle: two triangles that do not cross, come to cross through one of them.
//
// The force: a pair at a distance D below d = 2·thickness has the energy k s⁴/d², s = d - D. It pushes both parts apart
// along the shortest line between them, each corner by its share of the line's end. It promises nothing.
//
// The guard: in a step no particle moves by more than γ/2 (r - δ), where r is the distance of its nearest pair, at most
// the reach. Since a point of a part moves no further than one of its corners, two parts at a distance D then approach
// by less than D, and what did not cross at the start of a step does not cross at its end (the idea of Offset Geometric
// Contact: A. H. Chen, J. Hsu, Z. Liu, M. Macklin, Y. Yang, C. Yuksel, 2025). Where it cuts nothing short it changes
// nothing.
//
// Pairs are kept in two lists of all within the reach and a skin: of parts that are neighbors in the lattice, which is
// made anew once the steps from particle to particle have changed enough, and of others, once particles have moved by
// half of the skin. A pyramid of boxes over the lattice finds them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

/// The shortest line between two parts of the cloth.
struct Gap {
  std::array<double, 4> weights;  ///< of the pair's particles: Σ w x leads from the second part to the first
  glm::dvec3 between{0};          ///< that sum, m
};
/// From a point to a triangle.
Gap gap_to_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);
/// From an edge to another.
Gap gap_of_edges(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b);

/// Whether the scene has it.
inline bool touches_itself(const Preset& preset) {
  return preset.kind == Kind::cloth && preset.self != "off";
}
/// Whether it has the guard.
inline bool guards_itself(const Preset& preset) {
  return touches_itself(preset) && preset.self == "guard";
}
/// Half of the distance at which layers begin to repel each other, m.
double contact_thickness(const Preset& preset);
/// The largest that a cloth of that spacing allows, m.
double largest_thickness(double L);

class SelfContact {
 public:
  using Vectors = std::span<const glm::dvec3>;  ///< one for each particle, at i·columns + j

  explicit SelfContact(const Lattice& lattice) : lattice_(lattice) {}
  /// Takes constants as they are from now on; k, N/m: that of the force.
  void set_preset(const Preset& preset, double k);

  /// Something other than steps has changed the cloth or its tears: nothing of the lists holds any more.
  void forget() { known_torn_ = -1; }
  /// Whether follow() must be asked, after particles have moved by `way` at most since it was, m.
  bool stale(const Tears& tears, double way) const;
  /// Makes the lists of near pairs anew if these positions (m) ask for it.
  void follow(const Tears& tears, Vectors x);
  /// Whether any pair is near.
  bool near() const { return !lists_[neighbors].pairs.empty() || !lists_[others].pairs.empty(); }

  /// Measures all near pairs at positions x (m), for what follows. `room`: also how far the guard lets particles go
  /// that begin a step there.
  void look(Vectors x, bool room = false);
  /// Adds what pushes layers apart where look() saw them to F (N). Returns its energy, J.
  double add_forces(std::span<glm::dvec3> F) const;
  /// Adds the friction against their slip, with velocities v (m/s).
  void add_friction(Vectors v, std::span<glm::dvec3> F) const;
  bool has_friction() const { return friction_ > 0; }

  /// The largest way that the guard leaves every particle, m.
  double least_room() const;
  /// What hold_back() does to a particle.
  struct Held {
    int particle;
    double part;  ///< of its way that is left
  };
  /// Cuts the ways of particles short that began a step at x_before, where look() measured their room. `free`: nothing
  /// is pinned or held, so the motion of the whole cloth, which brings nothing nearer, does not count. Returns what it
  /// has changed; `x`: to where.
  std::span<const Held> hold_back(Vectors x_before, std::span<glm::dvec3> x, bool free);
  /// The motion of the whole cloth in the last hold_back(), m.
  const glm::dvec3& common_way() const { return common_; }

  std::size_t bytes() const;

 private:
  struct Box {
    glm::vec3 least{0}, most{0};
  };
  /// Some particles, and the steps between them along the rows and down the columns.
  struct Node {
    Box at, along, down;
  };
  struct Level {
    int rows = 0, columns = 0;
    std::vector<Node> nodes;
    const Node& at(int i, int j) const { return nodes[std::size_t(i) * std::size_t(columns) + std::size_t(j)]; }
  };
  /// A place in a level.
  struct Place {
    int i, j;
    bool operator==(const Place&) const = default;
  };
  /// A particle and a triangle, or two edges.
  struct Pair {
    std::int32_t first, second;
    bool edges;
  };
  static constexpr int edges_of_site = 3;
  /// Pairs of parts whose owners are at most `near_sites` rows and columns apart, and all others.
  enum ListKind { neighbors, others };
  static constexpr int near_sites = 2;
  struct List {
    std::vector<Pair> pairs;
    std::vector<glm::dvec3> then;  ///< positions that it was made for
    double within = 0;             ///< up to which distance it has all pairs, m
  };

  void find_parts(const Tears& tears);
  void refit(Vectors x);
  void find_pairs(ListKind kind, Vectors x);
  void visit(ListKind kind, std::size_t level, Place a, Place b, Vectors x);
  void visit_sites(List& list, Place a, Place b, Vectors x) const;
  bool sides_apart(Place a, Place b, double within, Vectors x) const;
  void keep_if_near(List& list, const Pair& pair, Vectors x) const;
  bool spread_out(ListKind kind, std::size_t level, Place a, Place b) const;
  double farthest_way(Vectors x) const;
  double largest_change(Vectors x) const;
  std::array<int, 3> triangle(int number) const;
  std::array<int, 2> edge(int number) const;
  std::array<int, 4> particles(const Pair& pair) const;
  Gap gap(const Pair& pair, Vectors x) const;

  /// A pair that is nearer than d, by s.
  struct Touch {
    std::array<int, 4> at;
    std::array<double, 4> weights;
    glm::dvec3 normal;
    double s;
    /// The size of the force, N, with k/d².
    double push(double k) const { return 4 * k * s * s * s; }
  };

  Lattice lattice_;
  double L_ = 0, d_ = 0, k_ = 0, friction_ = 0;
  std::vector<std::uint8_t> whole_triangles_, used_edges_, used_particles_, odd_;
  int known_torn_ = -1;
  std::vector<Level> levels_;  ///< the first has a node for each particle
  glm::dvec3 origin_{0};       ///< of the boxes
  double rounding_ = 0;        ///< of boxes, which are in float, m
  std::array<List, 2> lists_;
  double moved_ = 0, changed_ = 0;  ///< since they were made: the largest way, and change of a step of the lattice, m
  std::vector<Touch> touches_;      ///< as of the last look
  std::vector<double> room_;        ///< distance of each particle's nearest pair, at most the reach, m
  std::vector<Held> held_;
  glm::dvec3 common_{0};
};

}  // namespace tyglab
