// Multigrid for the linear systems of an implicit stage: a V-cycle as the preconditioner of conjugate gradients.
// Each coarser lattice has every other row and column, down to three by three. Positions are interpolated
// bilinearly between lattices, which also gives the coarser operator (Galerkin's Pᵀ A P). Two Chebyshev iterations
// with the diagonal blocks smooth before, and two after. The coarser operators derive from a nine-point operator,
// in which each bending spring is spread over its two halves; the finest lattice uses the exact operator. What resists
// curvature (linear_springs.h) vanishes in that operator: the coarser lattices have springs along rows and columns in
// its place, a quarter as stiff on each as on the one before, as a stiffness ~ θ⁴ asks for at the lattice's own θ. U.
// Trottenberg, C. W. Oosterlee, A. Schüller, Multigrid (2001), 2 and 4; M. Adams et al., J. Comput. Phys. 188, 593
// (2003).
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/implicit/crew.h"
#include "core/engines/implicit/multigrid_rows.h"
#include "core/simd/row_field.h"

namespace tyglab::implicit {

using simd::RowField;

/// A x = b with A of stiffness.h, in which fixed particles do not move.
template <class R>
struct SpringMatrix {
  const R* coefficients;                ///< rows of stiffness.h
  double m;                             ///< diagonal of A without the springs
  std::span<const std::uint8_t> fixed;  ///< 1 at i·columns + j if fixed; empty if none is
  int points = 2;                       ///< the most that one potential joins: 2 by a spring
  const R* curving = nullptr;           ///< likewise rows: the springs in place of what resists curvature; or null
};

template <class R>
class Multigrid {
 public:
  using Field = RowField<R>;
  /// Takes the memory for a lattice whose rows have that stride. Returns false where it was stopped on the way.
  bool resize(const Lattice& lattice, int stride, const std::function<bool()>& stops);
  /// Who computes from now on: `size` threads, where there are rows enough for them, all of the crew or one. `stops` is
  /// asked on the way, by the first of them; where it says yes results may be anything, and nothing may be computed
  /// before the next share(). Both must stay where they are.
  void share(Crew& crew, int size, const std::function<bool()>& stops);
  /// The fewest rows that `size` threads share.
  static constexpr int shared_rows(int size) { return size * least_rows; }
  /// All of the crew, or one, and the rows of each.
  int threads() const { return int(levels_[0].parts.size()); }
  RowRange rows_of(int number) const {
    assert(number >= 0 && number < threads());
    return levels_[0].parts[std::size_t(number)].own;
  }
  /// Takes a matrix, which must stay where it is, unless it stops.
  void prepare(const SpringMatrix<R>& matrix, const std::function<bool()>& stops);
  /// Computes B r, where B is symmetric and near A⁻¹; to be called by all threads. Of what it returns each may read its
  /// own rows.
  const Field& precondition(const Field& r, int number);
  /// Row i of a step of conjugate gradients: x += part·p, r -= part·q but for fixed particles. Returns the row's Σ r·r.
  double descend(double part, const R* p, const R* q, R* x, R* r, int i) const;
  std::size_t bytes() const;

 private:
  /// What a thread has of a level: its own rows, and of directions, products and residuals also the rows beside them on
  /// which its own depend within a few passes. These it computes like their owner does, so that nobody waits.
  struct Part {
    RowRange own;
    int first = 0;  ///< row of the lattice that is row 0 of these
    Field d, q, r;
    Array<R> unused;  ///< a row, for what only its owner keeps
    R* of(Field& field, int i) { return field.row(i - first); }
  };
  struct Level {
    int rows = 0, columns = 0, stride = 0;
    Array<R> blocks;   ///< rows of multigrid_rows.h; none of the finest lattice
    Array<R> curving;  ///< likewise, of the springs in place of what resists curvature; empty if nothing does
    Array<R> inverse;  ///< of the blocks on the diagonal
    Field given;       ///< the residual from which it begins; of the finest lattice, that is the caller's
    Field r;           ///< what is left of it on the way to the coarser level, where several threads share this one
    Field x;
    std::vector<Part> parts;
    const Field& residual() const { return parts.size() == 1 ? parts[0].r : r; }
    const R* block_row(int i) const { return blocks.data() + lead + std::ptrdiff_t(i) * pitch; }
    R* row(Array<R> Level::*of, int i) { return (this->*of).data() + lead + std::ptrdiff_t(i) * pitch; }
    const R* inverse_row(int i) const { return inverse.data() + std::ptrdiff_t(i) * 6 * stride; }
    R* inverse_row(int i) { return inverse.data() + std::ptrdiff_t(i) * 6 * stride; }
    std::ptrdiff_t pitch = 0;
    static constexpr int lead = simd::widest_vector / int(sizeof(R));
  };
  /// Of a step of Chebyshev's iteration.
  struct Weights {
    double keep = 0, scale = 0;
  };
  static constexpr int halo = 4;               ///< rows beside a thread's own, two for each product in a phase
  static constexpr int least_rows = 8 * halo;  ///< of a thread, on a level that several share
  void prepare_finest(const std::function<bool()>& stops);
  void coarsen(std::size_t from, Array<R> Level::*of, const std::function<bool()>& stops);
  const R* next_coarse_columns(std::size_t level, Array<R> Level::*of, int i);
  void build_nine_point_row(const R* coefficients, double m, int i);
  void add_curving(std::size_t level);
  void invert_coarsest();
  void share_level(Level& level, int size) const;
  void cycle(std::size_t level, const Field& given, int number);
  void multiply(std::size_t level, Part& part, int i, bool first) const;
  SmoothTask<R> task_of(Level& at, Part& part, int i, const Weights& weights) const;
  void restrict_residual(std::size_t level, int number);
  void prolong_correction(std::size_t level, int number, int i);
  template <class... Passes>
  void follow_each_other(int number, RowRange rows, const Passes&... passes);
  void meet(const Level& level) {
    if (level.parts.size() > 1) crew_->barrier();
  }
  bool stops(int number) {
    if (number == 0 && (*stops_)()) stopped_ = true;
    return stopped_;
  }
  void solve_coarsest();
  R* scratch(int n) { return scratch_[n].data() + Level::lead; }

  SpringMatrix<R> matrix_{};
  std::vector<Level> levels_;
  Array<R> zeros_;
  Array<R> scratch_[5];  ///< rows of an operator
  Array<R> free_;        ///< of the finest lattice, row by row: 1 at free particles
  int free_stride_ = 0, work_stride_ = 0;
  std::vector<double> coarsest_;  ///< inverse of its matrix
  Crew* crew_ = nullptr;
  std::vector<Array<R>> rows_;  ///< two of fields for each thread
  const std::function<bool()>* stops_ = nullptr;
  std::atomic<bool> stopped_ = false;
};

}  // namespace tyglab::implicit
