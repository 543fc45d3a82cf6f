// Contact of the cloth with itself: the force between its near parts (near_pairs.h), and the guard that keeps them
// apart.
//
// The force: a pair at a distance D below d = 2·thickness has the energy k s⁴/d², s = d - D. It pushes both parts apart
// along the shortest line between them, each corner by its share of the line's end. It promises nothing.
//
// The guard: in a step no particle moves by more than γ/2 (r - δ), where r is the distance of its nearest pair, at most
// the reach. Since a point of a part moves no further than one of its corners, two parts at a distance D then approach
// by less than D, and what did not cross at the start of a step does not cross at its end (the idea of Offset Geometric
// Contact: A. H. Chen, J. Hsu, Z. Liu, M. Macklin, Y. Yang, C. Yuksel, 2025). Where it cuts nothing short it changes
// nothing. Distances of d and more matter only where something moves that fast, and are measured only then. There is no
// guard so far away that δ exceeds the reach, where positions no longer tell layers apart.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/cloth/state.h"
#include "core/contact/near_pairs.h"
#include "core/model/preset.h"

namespace tyglab {

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
  using Vectors = NearPairs::Vectors;

  explicit SelfContact(const Lattice& lattice) : pairs_(lattice) {}
  /// Takes constants as they are from now on; k, N/m: that of the force.
  void set_preset(const Preset& preset, double k);

  /// Something other than steps has changed the cloth or its tears: nothing is known any more.
  void forget() { pairs_.forget(); }
  /// Whether follow() must be asked, after particles have moved by `way` at most since it was, m.
  bool stale(const Tears& tears, double way) const { return pairs_.stale(tears, way); }
  /// Finds what is near at these positions (m).
  void follow(const Tears& tears, Vectors x);
  /// The same between two of these calls, in which nothing has torn.
  void follow(Vectors x) { pairs_.follow(x); }
  /// Whether there may be forces.
  bool near() const { return pairs_.near(); }

  /// Measures what is near at positions x (m), which are followed. `begins_step`: the guard's next step.
  void look(Vectors x, bool begins_step = false);
  // An implicit solve tries positions beyond other layers, where the force as such would push further on. So pairs
  // within the reach keep the sides that they have where the solve begins: a pair that has passed through pushes back
  // by as much. Other pairs have the same force as elsewhere.
  /// A solve begins, in a step that begins at positions x, which are followed.
  void begin_solve(Vectors x);
  /// Whether it has any pairs.
  bool solves_for_pairs() const { return !sides_.empty(); }
  /// As look(), at positions within the solve.
  void look_in_solve(Vectors x);
  /// Adds pairs that have come within the reach, at positions x, which are followed.
  void renew_solve(Vectors x);
  /// Whether any pair that look() saw has a force.
  bool touches() const { return !touches_.empty(); }
  /// Adds what pushes layers apart where look() saw them to F (N). Returns its energy, J.
  double add_forces(std::span<glm::dvec3> F) const;
  /// Adds the friction against their slip, with velocities v (m/s).
  void add_friction(Vectors v, std::span<glm::dvec3> F) const;
  bool has_friction() const { return friction_ > 0; }
  /// How a pair resists: along its normal with a stiffness, N/m, across it with a damping, N s/m.
  struct Resistance {
    std::array<int, 4> at;
    std::array<double, 4> weights;
    glm::dvec3 normal;
    double along, across;
  };
  /// Of each pair that look() saw, with velocities v (m/s) as add_friction() had them.
  std::vector<Resistance> resistances(Vectors v) const;

  /// A way up to which the guard leaves every particle, m, in a step that began where it was followed, and looked at if
  /// anything was near.
  double least_room() const;
  /// What hold_back() does to a particle.
  struct Held {
    int particle;
    double part;  ///< of its way that is left
  };
  /// Cuts the ways of particles short in such a step, which began at x_before. `free`: nothing is pinned or held, so
  /// the motion of the whole cloth, which brings nothing nearer, does not count. Returns what it has changed; `x`: to
  /// where. It may have followed x_before.
  std::span<const Held> hold_back(Vectors x_before, std::span<glm::dvec3> x, bool free);
  /// The motion of the whole cloth in the last hold_back(), m.
  const glm::dvec3& common_way() const { return common_; }

  const NearPairs& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  /// A pair that is nearer than d, by s.
  struct Touch {
    std::array<int, 4> at;
    std::array<double, 4> weights;
    glm::dvec3 normal;
    double s;
    /// The size of the force, N, with k/d².
    double push(double k) const { return 4 * k * s * s * s; }
  };
  /// A pair in a solve, and the direction from its second part to its first.
  struct Side {
    std::array<int, 4> at;
    bool edges;
    glm::dvec3 normal;
  };
  double least_gap(double farthest) const;
  glm::dvec3 slip_of(const Touch& touch, Vectors v) const;
  double friction_of(const Touch& touch, const glm::dvec3& slip) const;

  NearPairs pairs_;
  double L_ = 0, d_ = 0, k_ = 0, friction_ = 0;
  std::vector<Touch> touches_;  ///< as of the last look
  std::vector<Side> sides_;     ///< of the present solve, rising by their particles
  double nearest_ = 0;          ///< distance of the nearest pair where the step began, if that matters, m
  std::vector<double> room_;    ///< of each particle, if that matters, m
  std::vector<Held> held_;
  glm::dvec3 common_{0};
};

}  // namespace tyglab
