// A band of rows that one thread sweeps, pair by pair. Bands sweep in place simultaneously: before any thread writes,
// each band copies the neighboring rows that it needs, and it recomputes the forces from the pair above in their order,
// so the result does not depend on the number of bands.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/cpu/curl_rows.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/engines/cpu/parts.h"
#include "core/engines/cpu/row_update.h"
#include "core/engines/engine.h"
#include "core/forces/contact.h"
#include "core/forces/force.h"
#include "core/forces/linear_springs.h"
#include "core/integrators/scheme.h"
#include "core/model/preset.h"
#include "core/simd/row_field.h"

namespace tyglab::cpu {

using simd::RowField, simd::row_stride, simd::widest_vector;

/// Sums of state vectors by which a step is checked (scheme.h), all over the same vectors.
struct ResolvedEstimate {
  struct Share {
    int vector;
    double error_x = 0, error_v = 0, stage_x = 0, stage_v = 0, stage_a = 0;
  };
  std::vector<Share> shares;
};

/// A sweep with its coefficients for one dt and m. Coefficients of acceleration multiply forces, so they include 1/m.
struct ResolvedSweep {
  struct ResolvedTerm {
    int vector;
    double factor;
  };
  struct ResolvedAssignment {
    int target;
    std::vector<ResolvedTerm> terms;
  };
  int position = 0, velocity = 0;
  double k_d = 0;           ///< divided by dt where the velocity vector holds displacements
  double per_velocity = 1;  ///< what that vector is multiplied by to be a velocity: 1, or 1/dt
  std::vector<ResolvedAssignment> assignments;
  bool external = false, projects = false;  ///< as in Sweep; F_curl is among what is external
  /// Whether F has that of the air, or nothing else; with it go the forces of layers in methods that lag them.
  enum class Air { blows, none, alone };
  Air air = Air::blows;
  double solve_dt = 0;                     ///< not 0: an implicit stage over that time is solved first
  double damps_dt = 0;                     ///< not 0: the damping is solved for over that time
  std::vector<ResolvedAssignment> before;  ///< made before the solve
  Update update = Update::force;           ///< by the pair sweep itself; force: assignments follow row by row
  double v_to_x = 0, force_to_x = 0, force_to_v = 0;  ///< for the other kinds
  const ResolvedEstimate* estimate = nullptr;         ///< measured for each row, unless null
};

/// The features of the pair sweep that a scene needs.
inline unsigned features_of(const Preset& preset) {
  return (force::bend.on(preset) ? bending : 0u) | (force::damping.on(preset) ? damping : 0u) |
         (force::wind.on(preset) ? wind : 0u) | (force::air.on(preset) ? air : 0u) |
         (spring_constants(preset).stretches_alike() ? 0u : threads) |
         (LinearSprings<double>::exist(preset) ? linear : 0u);
}

/// What all bands share: the arrays and the scene.
template <class R>
struct Cloth {
  using Field = RowField<R>;

  Preset preset;
  double dt = 0;  ///< of the present step, s: the preset's, or that of an inner step
  Lattice lattice;
  int stride = 0;
  PairSweeps<R> sweeps;
  LinearSprings<R> springs;  ///< of forces that are linear in positions
  unsigned features = 0;
  bool keeps_displacement = false;
  bool notes_contacts = false;                  ///< whether bands record what bodies stop
  Contacts contacts;                            ///< the rule of contacts; its dt is that of the present step
  std::vector<std::vector<PlacedBody>> bodies;  ///< in each step of a batch; where they rest, in all
  bool bodies_move = false;
  int seen_velocity = vector_v;  ///< vector that damping uses at the start of a step
  std::vector<Field> vectors;
  const Field* near_force = nullptr;        ///< what is added to the forces of the present sweep; null: nothing
  const std::uint8_t* near_rows = nullptr;  ///< not 0: a row of it that has something; null: all may have
  std::vector<int> fixed_columns;           ///< columns of pinned and held particles, row by row
  std::vector<int> fixed_begin;             ///< index of each row's first among them
  std::vector<std::uint8_t> fixed;          ///< 1 at i·columns + j if pinned or held; empty if none is
  Held held;

  Field& vector(int number) {
    assert(number >= 0 && std::size_t(number) < vectors.size());
    return vectors[std::size_t(number)];
  }
  const Field& vector(int number) const {
    assert(number >= 0 && std::size_t(number) < vectors.size());
    return vectors[std::size_t(number)];
  }
  R* row(int number, int i, int component) { return vector(number).row(i, component); }
  const R* row(int number, int i, int component) const { return vector(number).row(i, component); }
  std::vector<RowMeasures> measures;  ///< of each row, from the last sweep with an estimate
  double velocity_scale() const { return keeps_displacement ? preset.dt : 1; }
  bool has_fixed(int i) const {
    assert(i >= 0 && std::size_t(i) + 1 < fixed_begin.size());
    return fixed_begin[std::size_t(i)] < fixed_begin[std::size_t(i) + 1];
  }
};

/// `Present`: the parts of the engine that are compiled in (parts.h).
template <class R, unsigned Present = part::everything>
class Band {
 public:
  using Field = RowField<R>;

  /// Rows [begin, end) of the cloth: `begin` even, and `end` too where there is a band below; at least `least_rows`
  /// where there are several bands.
  Band(Cloth<R>& cloth, int begin, int end);
  static constexpr int least_rows = 8;
  /// Covers other rows from now on: on no side where the first ones ended at the cloth's edge may these end within it.
  void cover(int begin, int end);
  /// Allocates buffers, before the first sweep. `old_rows`: also for the positions before a pair is overwritten, for
  /// bodies and for watching the motion in methods with more vectors; `old_velocities`: for contacts within the step.
  void allocate(bool old_rows, bool old_velocities);

  /// Copies the neighbors' rows that this band reads: before a sweep, while no thread writes.
  void copy_halo(const ResolvedSweep& sweep);
  /// One pass over the band's rows. `last`: the last sweep of a step, in which bodies act and the motion is watched.
  void sweep(const ResolvedSweep& sweep, const Tears& tears, bool last);
  /// The same pair by pair: rows i and i + 1, from the band's first row on. The arguments must outlive the pass.
  /// `step`: of those that are made together.
  void begin_sweep(const ResolvedSweep& sweep, const Tears& tears, bool last, int step = 0);
  void sweep_pair(int i) { sweep_rows(i, rows_of(i, 2)); }
  /// Makes assignments that do not use a. `last` as above.
  void assign(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments, bool last);
  /// Writes F/m of the present state. `of_step`: it belongs to the step, so the force on the hand is updated; otherwise
  /// nothing else changes.
  void accelerations(const ResolvedSweep& sweep, const Tears& tears, Field& out, bool of_step = false);

  void reset_watch();
  /// Largest displacement of a particle in one component since reset_watch(), m; ∞ if something is not finite.
  double max_displacement() const;
  int left_inside() const { return left_inside_; }
  /// Whether a body has moved a particle since reset_watch().
  bool collided() const { return collided_; }
  /// The force on the held particle in the last sweep, N; only the band with its row has it.
  bool has_hand() const { return has_hand_; }
  glm::dvec3 hand_force() const { return hand_force_; }
  /// What bodies stopped since reset_watch(), if the cloth records it.
  std::span<const Contact> contacts() const { return contacts_; }
  std::size_t bytes() const;

 private:
  static constexpr bool has(unsigned which) { return (Present & which) != 0; }
  /// Copies of four rows of one position and one velocity vector.
  struct Halo {
    Field x, v;
  };
  PairTask<R> task(const ResolvedSweep& sweep);
  void take_air(PairTask<R>& task, double per_velocity);
  void point(PairTask<R>& task, const Tears& tears, int i, int x_row, Field& x, Field& v);
  void point_at_pair(PairTask<R>& task, const ResolvedSweep& sweep, const Tears& tears, int i);
  /// How many of the next `most` rows there are.
  int rows_of(int i, int most) const { return std::min(most, end_ - i); }
  bool in_tail(int i) const { return end_ < cloth_.lattice.rows && i >= end_ - 2; }
  void copy_rows(const ResolvedSweep& sweep, int first, int count, Halo& halo, int at);
  void begin_forces(PairTask<R>& task, const Tears& tears);
  void forces_on_pair(PairTask<R>& task, const Tears& tears, int i, Update update);
  void add_near_force(const PairTask<R>& task, int i);
  void curl_pair(const PairTask<R>& task, const Tears& tears, int i);
  void pass_on_curl(const PairTask<R>& task);
  void read_hand(int i);
  void fix_row(int i);
  void begin_sums(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments);
  void sum_rows(int i, int count);
  void save_rows(int i, int count, bool bodies);
  void sweep_rows(int i, int count);
  void restore_pair(const PairTask<R>& task, const ResolvedSweep& sweep, int i);
  const std::vector<PlacedBody>* bodies_in(int step) const;
  R lowest(const PlacedBody& plane, const R* x) const;
  bool touches(int i);
  void collide_row(int i);
  void watch_rows(int i, int count);
  void measure(const ResolvedEstimate& estimate, const ResolvedSweep& sweep, int i);
  R* old_row(int i, int c) { return old_rows_.row((i - begin_) & (block_ - 1), c); }
  R* old_velocity(int i, int c) { return old_velocities_.row((i - begin_) & (block_ - 1), c); }
  R* force_row(int i, int c) { return ring_.row((i - begin_) & (2 * block_ - 1), c); }

  /// The sweep being made.
  struct Pass {
    const ResolvedSweep* sweep = nullptr;
    const Tears* tears = nullptr;
    PairTask<R> task{};
    bool last = false;
    const std::vector<PlacedBody>* bodies = nullptr;  ///< that act at its end
    bool assigns = false;
  };

  Cloth<R>& cloth_;
  int begin_ = 0, end_ = 0;
  Pass pass_;
  RowSums<R> sums_;        ///< that follow the sweep being made
  unsigned features_ = 0;  ///< of the sweep
  int block_;              ///< rows, a power of 2: forces on this many come before sums, bodies and the watch
  Field ring_;             ///< force rows of the present block and of the next, which its last pair begins
  Field old_rows_;         ///< positions of a block before it is overwritten
  Field old_velocities_;   ///< and velocities, for contacts within the step
  CurlPass<R> curl_;
  Field curled_;      ///< what that does to the two rows below a pair
  Halo head_, tail_;  ///< rows begin-2 … begin+1 and end-2 … end+1
  glm::dvec3 hand_force_{0};
  bool has_hand_ = false;
  alignas(widest_vector) std::array<R, widest_vector / sizeof(R)> max_displacement_{};  ///< by lane
  int left_inside_ = 0;
  std::vector<Contact> contacts_;
  bool collided_ = false;
};

}  // namespace tyglab::cpu
