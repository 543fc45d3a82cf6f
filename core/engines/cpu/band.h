// A band of rows, the work of one thread, pair after pair. Bands sweep in place at the same time; what a band needs of
// its neighbours' rows it copies before anyone writes, and the forces that come from the pair above it it computes
// again, in the same order, so the result does not depend on the number of bands.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/engines/cpu/parts.h"
#include "core/engines/engine.h"
#include "core/integrators/scheme.h"
#include "core/model/preset.h"
#include "core/simd/row_field.h"
#include "core/simd/row_update.h"

namespace tyglab::cpu {

/// Sums of state vectors that a step is judged by (scheme.h), all over the same vectors.
struct ResolvedEstimate {
  struct Share {
    int vector;
    double error_x = 0, error_v = 0, stage_x = 0, stage_v = 0, stage_a = 0;
  };
  std::vector<Share> shares;
};

/// A sweep with its coefficients worked out for one dt and m: acceleration terms multiply forces, so they hold 1/m.
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
  double k_d = 0;  ///< divided by dt where the velocity vector holds displacements
  std::vector<ResolvedAssignment> assignments;
  bool external = false, projects = false;  ///< as in Sweep
  double solve_dt = 0;                      ///< not 0: an implicit stage over that time is solved first
  std::vector<ResolvedAssignment> before;   ///< made before it
  Update update = Update::force;  ///< what the pair sweep does by itself; force: the assignments are made row by row
  double v_to_x = 0, force_to_x = 0, force_to_v = 0;  ///< for the other two
  const ResolvedEstimate* estimate = nullptr;         ///< each row is measured by it
};

/// What all bands share: the arrays and what is known of the scene.
template <class R>
struct Cloth {
  using Field = RowField<R>;

  Preset preset;
  double dt = 0;  ///< of the step that is being made, s: the preset's, or that of an inner step
  Lattice lattice;
  int stride = 0;
  PairSweeps<R> sweeps;
  unsigned features = 0;
  bool keeps_displacement = false;
  bool notes_contacts = false;   ///< whether bands note what bodies stop
  int seen_velocity = vector_v;  ///< vector that damping sees where a step begins
  std::vector<Field> vectors;
  std::vector<int> fixed_columns;   ///< columns of pinned and held particles, row after row
  std::vector<int> fixed_begin;     ///< where each row's begin
  std::vector<std::uint8_t> fixed;  ///< mask over i·columns + j, empty if none
  Held held;

  Field& vector(int number) { return vectors[std::size_t(number)]; }
  const Field& vector(int number) const { return vectors[std::size_t(number)]; }
  R* row(int vector, int i, int component) { return vectors[std::size_t(vector)].row(i, component); }
  const R* row(int vector, int i, int component) const { return vectors[std::size_t(vector)].row(i, component); }
  std::vector<RowMeasures> measures;  ///< of each row, by the last sweep with an estimate
  double velocity_scale() const { return keeps_displacement ? preset.dt : 1; }
  bool has_fixed(int i) const { return fixed_begin[std::size_t(i)] < fixed_begin[std::size_t(i) + 1]; }
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
  /// Other rows from now on: on no side where the first ones ended at the cloth's edge may these end within the cloth.
  void cover(int begin, int end) { begin_ = begin, end_ = end; }
  /// For the positions before a pair is overwritten, where bodies or the watch over a method with more vectors need
  /// them. Before the first sweep.
  void make_room(bool old_rows);

  /// Before a sweep, while nobody writes: copies the neighbours' rows that this band reads.
  void copy_halo(const ResolvedSweep& sweep);
  /// One pass over the band's rows. `last`: the last sweep of a step, in which bodies act and motion is watched.
  void sweep(const ResolvedSweep& sweep, const Tears& tears, bool last);
  /// The same pair by pair: i and i + 1 of the band's rows, from its first row on. The arguments must outlive the pass.
  void begin_sweep(const ResolvedSweep& sweep, const Tears& tears, bool last);
  void sweep_pair(int i);
  /// Makes assignments, none of which names a. `last` as above.
  void assign(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments, bool last);
  /// F/m of the present state into `out`. `of_step`: it belongs to the step, so the hand feels it; otherwise nothing
  /// else changes.
  void accelerations(const ResolvedSweep& sweep, const Tears& tears, Field& out, bool of_step = false);

  void begin_watch();
  /// Largest way of a particle in one component since begin_watch, m; ∞ if something is not finite.
  double max_displacement() const;
  int left_inside() const { return left_inside_; }
  /// Whether a body has moved a particle since begin_watch.
  bool collided() const { return collided_; }
  /// The force on the hand's particle as the last sweep found it; only the band that has its row sets it.
  bool has_hand() const { return has_hand_; }
  glm::dvec3 hand_force() const { return hand_force_; }
  /// What bodies stopped since begin_watch, where the cloth notes it.
  std::span<const Contact> contacts() const { return contacts_; }
  std::size_t bytes() const;

 private:
  static constexpr bool has(unsigned which) { return (Present & which) != 0; }
  /// Copies of four rows of one position and one velocity vector.
  struct Halo {
    Field x, v;
  };
  PairTask<R> task(const ResolvedSweep& sweep);
  void point(PairTask<R>& task, const Tears& tears, int i, int x_row, Field& x, Field& v);
  void point_at_pair(PairTask<R>& task, const ResolvedSweep& sweep, const Tears& tears, int i);
  bool in_tail(int i) const { return end_ < cloth_.lattice.rows && i >= end_ - 2; }
  void copy_rows(const ResolvedSweep& sweep, int first, int count, Halo& halo, int at);
  void begin_forces(PairTask<R>& task, const Tears& tears);
  void forces_on_pair(PairTask<R>& task, Update update);
  void read_hand(int i);
  void fix_row(int i);
  void assign_row(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments, int i);
  void keep_pair(int i);
  void give_back_pair(const PairTask<R>& task, const ResolvedSweep& sweep, int i);
  bool touches(int i) const;
  void collide_row(int i);
  void watch_row(int i);
  void measure(const ResolvedEstimate& estimate, const ResolvedSweep& sweep, int i);
  R* old_row(int i, int c) { return old_rows_.row(i % 2, c); }
  R* force_row(int i, int c) { return ring_.row(i % 4, c); }

  /// The sweep being made.
  struct Pass {
    const ResolvedSweep* sweep = nullptr;
    const Tears* tears = nullptr;
    PairTask<R> task{};
    bool last = false, bodies = false, assigns = false;
  };

  Cloth<R>& cloth_;
  int begin_, end_;
  Pass pass_;
  unsigned features_ = 0;  ///< of the sweep
  Field ring_;             ///< force rows i … i+3
  Field old_rows_;         ///< positions of a pair before it is overwritten
  Halo head_, tail_;       ///< rows begin-2 … begin+1 and end-2 … end+1
  glm::dvec3 hand_force_{0};
  bool has_hand_ = false;
  alignas(widest_vector) std::array<R, widest_vector / sizeof(R)> largest_way_{};  ///< by lane
  int left_inside_ = 0;
  std::vector<Contact> contacts_;
  bool collided_ = false;
};

}  // namespace tyglab::cpu
