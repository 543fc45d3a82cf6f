// A band of rows, the work of one thread. Bands sweep in place at the same time; what a band needs of its neighbours'
// rows it copies before anyone writes, and the forces that come from the two rows above it it computes again, in the
// same order, so the result does not depend on the number of bands.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/engines/cpu/row_sweep.h"
#include "core/engines/engine.h"
#include "core/integrators/scheme.h"
#include "core/notation/preset.h"

namespace tyglab::cpu {

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
  Update update = Update::force;  ///< what the row sweep does by itself; force: the assignments are made row by row
  double v_to_x = 0, force_to_x = 0, force_to_v = 0;  ///< for the other two
};

/// What all bands share: the arrays and what is known of the scene.
template <class R>
struct Cloth {
  using Field = VectorField<R>;

  Preset preset;
  Lattice lattice;
  int stride = 0;
  RowSweeps<R> rows;
  unsigned features = 0;
  bool keeps_displacement = false;
  std::vector<Field> vectors;
  std::vector<int> fixed_columns;   ///< columns of pinned and held particles, row after row
  std::vector<int> fixed_begin;     ///< where each row's begin
  std::vector<std::uint8_t> fixed;  ///< mask over i·columns + j, empty if none
  Held held;

  static R* component(Field& field, int c) { return (c == 0 ? field.x : c == 1 ? field.y : field.z).data(); }
  R* component(int vector, int c) { return component(vectors[std::size_t(vector)], c); }
  const R* component(int vector, int c) const { return const_cast<Cloth*>(this)->component(vector, c); }
  std::ptrdiff_t row_begin(int i) const { return std::ptrdiff_t(i) * stride; }
  double velocity_scale() const { return keeps_displacement ? preset.dt : 1; }
  bool has_fixed(int i) const { return fixed_begin[std::size_t(i)] < fixed_begin[std::size_t(i) + 1]; }
};

template <class R>
class Band {
 public:
  using Field = VectorField<R>;

  /// Rows [begin, end) of the cloth; at least `least_rows` where there are several bands.
  Band(Cloth<R>& cloth, int begin, int end);
  static constexpr int least_rows = 8;

  /// Before a sweep, while nobody writes: copies the neighbours' rows that this band reads.
  void copy_halo(const ResolvedSweep& sweep);
  /// One pass over the band's rows. `last`: the last sweep of a step, in which bodies act and motion is watched.
  void sweep(const ResolvedSweep& sweep, const Tears& tears, bool last);
  /// F/m of the present state into `out`; nothing else changes.
  void accelerations(const ResolvedSweep& sweep, const Tears& tears, Field& out);

  void begin_watch();
  /// Largest way of a particle in one component since begin_watch, m; ∞ if something is not finite.
  double largest_way() const;
  int left_inside() const { return left_inside_; }
  /// The force on the hand's particle as the last sweep found it; only the band that has its row sets it.
  bool has_hand() const { return has_hand_; }
  glm::dvec3 hand_force() const { return hand_force_; }
  std::size_t bytes() const;

 private:
  /// Copies of four rows of one position and one velocity vector.
  struct Halo {
    Field x, v;
  };
  RowTask<R> task(const ResolvedSweep& sweep);
  void point(RowTask<R>& task, const Tears& tears, int i, int x_row, Field& x, Field& v);
  void point_at_row(RowTask<R>& task, const ResolvedSweep& sweep, const Tears& tears, int i);
  bool in_tail(int i) const { return end_ < cloth_.lattice.rows && i >= end_ - 2; }
  void copy_rows(const ResolvedSweep& sweep, int first, int count, Halo& halo, int at);
  void begin_forces(RowTask<R>& task, const Tears& tears);
  void forces_on_row(const RowTask<R>& task, Update update);
  void read_hand(int i);
  void fix_row(int i);
  void assign_row(const ResolvedSweep& sweep, int i);
  void keep_row(int i);
  void give_back_row(const RowTask<R>& task, const ResolvedSweep& sweep, int i);
  bool touches(int i) const;
  void collide_row(int i);
  void watch_row(int i);
  R* force_row(int i, int c) { return Cloth<R>::component(ring_[std::size_t(i) % 3], c); }

  Cloth<R>& cloth_;
  int begin_, end_;
  std::array<Field, 3> ring_;  ///< force rows i, i+1, i+2
  Field old_row_;              ///< positions of a row before it is overwritten
  Field sum_row_;              ///< a row's linear combination while it is made
  Halo head_, tail_;           ///< rows begin-2 … begin+1 and end-2 … end+1
  glm::dvec3 hand_force_{0};
  bool has_hand_ = false;
  alignas(widest_vector) std::array<R, widest_vector / sizeof(R)> largest_way_{};  ///< by lane
  bool finite_ = true;
  int left_inside_ = 0;
};

}  // namespace tyglab::cpu
