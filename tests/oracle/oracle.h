// The oracle: docs/model.md once more, naive and in double, written from that page alone and sharing no formula with
// core/. One struct a particle, each particle gathers the forces of its 8 + 4 neighbors, nothing is clever. The tests
// hold every engine against it.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab::oracle {

using Vec = glm::dvec3;

struct Particle {
  Vec x{0};  ///< position, m
  Vec v{0};  ///< velocity as the method holds it, m/s; for verlet d/dt
  Vec d{0};  ///< verlet alone: x[n] - x[n-1], m
  bool pinned = false;
  std::array<bool, 8> whole{};  ///< stretch springs to the ring of neighbors; see `ring`
};

/// The forces on one particle, N (table B.1). F_hand is what the hand adds; the oracle only measures it.
struct Forces {
  Vec F_s{0}, F_b{0}, F_d{0}, F_g{0}, F_wind{0}, F_air{0};
  Vec F() const { return F_s + F_b + F_d + F_g + F_wind + F_air; }
};

struct Offset {
  int di, dj;
};
/// The eight neighbors; the opposite of number k is 7 - k.
inline constexpr std::array<Offset, 8> ring{{{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

class Cloth {
 public:
  /// The cloth at its start. The preset is a cloth with integrator euler, improved_euler or verlet.
  explicit Cloth(const Preset& preset);

  int rows() const { return p_.rows; }
  int columns() const { return p_.columns; }
  Particle& at(int i, int j) { return particles_[index(i, j)]; }
  const Particle& at(int i, int j) const { return particles_[index(i, j)]; }

  /// The method's own start from the present x and v (verlet: d[0]); call it after changing them by hand.
  void start();
  void step();
  void advance(int steps);
  /// Forces on particle (i, j) at the present positions and velocities.
  Forces forces(int i, int j) const;
  /// The velocity that belongs to x[n]: v, and v + dt/2 a for verlet, but at a start the velocity that it starts from.
  Vec velocity(int i, int j) const;
  /// Each edit keeps that velocity and starts the method again.
  void set_dt(double dt);

  void grab(int i, int j);
  /// The held particle goes to `to` evenly over the next `steps` steps, then rests.
  void move_hand(Vec to, int steps);
  void release();
  /// (i, j) loses its springs upwards.
  void cut(int i, int j);
  bool whole(int i, int j, int i2, int j2) const;

 private:
  int index(int i, int j) const { return i * p_.columns + j; }
  bool contains(int i, int j) const { return i >= 0 && i < p_.rows && j >= 0 && j < p_.columns; }
  void edit(const std::function<void()>& what);
  bool is_held(int i, int j) const { return index(i, j) == held_; }
  bool guarded(int i, int j) const;
  void break_spring(int i, int j, int k);
  void place();
  void pin();
  /// The forces on all particles by triangles.
  struct Outer {
    std::vector<Vec> wind, air;
  };
  Outer outer() const;
  void blow(Outer& force, const std::array<Offset, 3>& corners) const;
  double constant(const Offset& to) const;
  Vec acceleration(int i, int j, const Outer& blowing) const;
  void move(Particle& particle, Vec a) const;
  void collide(Vec old, Vec& x, Vec& v) const;
  void tear();
  Forces gather(int i, int j) const;

  Preset p_;
  std::vector<Particle> particles_;
  int held_ = -1;
  Vec hand_{0};  ///< velocity of the hand, m/s
  int hand_steps_ = 0;
  std::vector<Vec> full_step_;  ///< velocities that belong to x[n], from a start to the next step; else empty
};

/// The one weight on a two-sided spring (figure 3.2): height y and velocity v as the method holds it.
class Weight {
 public:
  explicit Weight(const Preset& preset);
  void step();
  double a() const;
  double y, v, d;

 private:
  Preset p_;
};

}  // namespace tyglab::oracle
