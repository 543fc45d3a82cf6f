// Multigrid for the linear systems of an implicit stage: a V cycle as the preconditioner of conjugate gradients. Each
// coarser lattice has every other row and column, down to three by three; between two of them positions are
// interpolated bilinearly, which leads from one operator to the next (Galerkin's Pᵀ A P). Chebyshev's iteration with
// the blocks on the diagonal smooths twice before and twice after. The coarser operators see a nine-point operator, in
// which each bending spring is spread over its two halves; everything on the lattice itself uses the true one.
// U. Trottenberg, C. W. Oosterlee, A. Schüller, Multigrid (2001), 2 and 4; M. Adams et al., J. Comput. Phys. 188, 593
// (2003).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/simd/row_field.h"

namespace tyglab::implicit {

using simd::RowField;

/// A x = b with A of stiffness.h, in which fixed particles do not move.
template <class R>
struct SpringMatrix {
  const R* coefficients;                ///< rows of stiffness.h
  double m;                             ///< diagonal of A without the springs
  std::span<const std::uint8_t> fixed;  ///< 1 at i·columns + j if fixed; empty if none is
};

template <class R>
class Multigrid {
 public:
  using Field = RowField<R>;
  /// Takes the memory for a lattice whose rows have that stride.
  void resize(const Lattice& lattice, int stride);
  /// Takes a matrix, which must stay where it is.
  void prepare(const SpringMatrix<R>& matrix);
  /// Returns B r, where B is symmetric and near A⁻¹. `stops` is asked between passes; where it says yes the result may
  /// be anything.
  const Field& precondition(const Field& r, const std::function<bool()>& stops);
  /// Row i of a step of conjugate gradients: x += part·p, r -= part·q but for fixed particles. Returns the row's Σ r·r.
  double descend(double part, const Field& p, const Field& q, Field& x, Field& r, int i) const;
  std::size_t bytes() const;

 private:
  struct Level {
    int rows = 0, columns = 0, stride = 0;
    Array<R> blocks;   ///< rows of multigrid_rows.h; none of the finest lattice
    Array<R> inverse;  ///< of the blocks on the diagonal
    Field r, d, q, x;
    R* block_row(int i) { return blocks.data() + lead + std::ptrdiff_t(i) * pitch; }
    const R* inverse_row(int i) const { return inverse.data() + std::ptrdiff_t(i) * 6 * stride; }
    R* inverse_row(int i) { return inverse.data() + std::ptrdiff_t(i) * 6 * stride; }
    std::ptrdiff_t pitch = 0;
    static constexpr int lead = simd::widest_vector / int(sizeof(R));
  };
  /// A pass of Chebyshev's iteration over all rows.
  struct Pass {
    double keep = 0, scale = 0;
  };
  void prepare_finest();
  void coarsen(std::size_t from);
  const R* next_coarse_columns(std::size_t level, int i);
  void build_nine_point_row(int i);
  void invert_coarsest();
  void cycle(std::size_t level);
  void multiply(std::size_t level, int i);
  void smooth(std::size_t level, Pass pass);
  void leave_residual(std::size_t level);
  void restrict_residual(std::size_t level);
  void prolong_correction(std::size_t level);
  void solve_coarsest();
  R* scratch(int n) { return scratch_[n].data() + Level::lead; }

  SpringMatrix<R> matrix_{};
  std::vector<Level> levels_;
  Array<R> zeros_;
  Array<R> scratch_[7];  ///< rows of an operator or of a field
  Array<R> free_;        ///< of the finest lattice, row by row: 1 at free particles
  int free_stride_ = 0, work_stride_ = 0;
  std::vector<double> coarsest_;  ///< inverse of its matrix
  const std::function<bool()>* stops_ = nullptr;
};

}  // namespace tyglab::implicit
