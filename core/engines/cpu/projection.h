// Extended position-based dynamics on the lattice: Gauss-Seidel over springs colored by the parity of their row or
// column, so no two springs of one color share a particle. The order of the colors is fixed, and no two threads work on
// a row simultaneously, so the bits are identical for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/projection_rows.h"
#include "core/engines/cpu/team.h"
#include "core/forces/force.h"
#include "core/integrators/stabilized.h"

namespace tyglab::cpu {

template <class R>
class Projector {
 public:
  using Field = RowField<R>;

  /// Prepares a step, on one thread: which springs are whole and which particles are free, unless all are. `changed`:
  /// whether either may differ from the last step.
  void prepare(const Cloth<R>& cloth, const Tears& tears, bool changed);
  /// Makes all iterations on the displacements in vector q, in rows [begin, end). Called by all threads together, each
  /// with its rows: begin is even, and so is end except for the last. `goes_on(n)`: asked by the thread of the first
  /// row before iteration n from the second on. Returns to all threads whether it went on to the end.
  bool project(Cloth<R>& cloth, int q, int begin, int end, Team& team, const std::function<bool(int n)>& goes_on);
  /// Damps the velocities by k_d, likewise.
  void damp(Cloth<R>& cloth, int begin, int end, Team& team);
  std::size_t bytes() const;

 private:
  /// One color of the springs of one direction.
  struct Color {
    int direction;
    int first;   ///< row or column
    int lambda;  ///< index into lambda_
  };
  /// `row`: of that direction's springs; where they lie is put into it.
  void project_color(Cloth<R>& cloth, int q, const Color& color, int i, ProjectionRow<R>& row);
  /// `both_free`, `one_free`: of the relative velocity of a spring's ends, by how many of them are free.
  void damp_color(Cloth<R>& cloth, const Color& color, int i, const Decay& both_free, const Decay& one_free);
  void project_weight(Cloth<R>& cloth, int q);
  template <class Row>
  bool place(const Cloth<R>& cloth, const Color& color, int i, Row& row, int& upper, int& lower) const;
  /// Does the work for each color in rows [begin, end), with barriers around those that reach into other rows.
  template <class Work>
  static void in_colors(int begin, int end, bool bending, Team& team, Work work);

  /// Of a force that is linear in positions: Σ w x of each of its stencils is projected on 0.
  struct LinearColor {
    const Stencil* stencil;
    double constant;                 ///< N/m
    std::vector<std::uint8_t> acts;  ///< at the owner's i·columns + j
    Array<R> lambda;                 ///< likewise, times dt²/m: three components, m
  };
  void find_stencils(const Cloth<R>& cloth, const Tears& tears);
  void project_stencils(Cloth<R>& cloth, int q, LinearColor& color, int i);

  static constexpr int lambdas = 8;
  int rows_ = 0, stride_ = 0;
  Array<R> lambda_;                   ///< row by row, in each color by color
  bool stopped_[2] = {false, false};  ///< in iterations of even and odd number
  bool masked_ = false;
  std::vector<LinearColor> linear_;
  std::uint64_t springs_ = 0;  ///< version of LinearSprings
  Array<R> free_;              ///< of particles
  Array<R> whole_;             ///< row by row, in each direction by direction
  // Rows in which nothing is pinned, held or torn need not look at either.
  std::vector<std::uint8_t> row_free_, row_whole_;
};

}  // namespace tyglab::cpu
