// Linear systems on the lattice with a matrix that does not depend on the motion: A = 1 + Σ over intact springs of β
// (e_i - e_j)(e_i - e_j)ᵀ, for each of x, y and z, with 0 for pinned and held particles. The Chebyshev iteration solves
// them. It needs only bounds of the eigenvalues, so the bits of a solution are identical for any number of threads.
// Where its products do not suffice, a factor of A does, if the lattice is small enough. In both cases the mean of each
// piece that nothing holds is solved for exactly: A leaves it as it is, since it stretches no spring.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/lattice_factor.h"
#include "core/model/preset.h"

namespace tyglab::cpu {

template <class R>
class ConstantSolver {
 public:
  using Field = RowField<R>;
  static constexpr int most_products = 500;  ///< in each of the two rounds
  /// What to do where these do not suffice.
  enum class Beyond {
    ends,       ///< the solution is what they have found
    factorizes  ///< A is factorized, if that takes no more than about a quarter of a second
  };

  /// Prepares solutions whose residual is at most `tolerance` of the right-hand side's norm, on one thread. `changed`:
  /// whether springs or fixed particles may differ from the last call.
  void prepare(const Cloth<R>& cloth, const Tears& tears, SpringWeights weights, double tolerance, bool changed,
               Beyond beyond = Beyond::ends);
  /// Replaces r by the solution of A s = r in rows [begin, end). Called by all threads together, each with its rows;
  /// `barrier` waits for the others. One thread that calls it alone may `stop` it; r then holds anything.
  void solve(Field& r, int begin, int end, const std::function<void()>& barrier, const Stop& stop = {});
  /// Products with A in each of the two rounds; 0 where a factor solves.
  int products() const { return way_ == Way::factor ? 0 : products_; }
  /// Bound of what products leave of the residual, as a part of it.
  double left() const { return left_; }
  /// Root mean squares over the particles of the last solution, and of what it lacks at most where products did not
  /// suffice.
  struct Size {
    double solution = 0, lacking = 0;
  };
  Size size() const;
  std::size_t bytes() const {
    return a_.bytes() + b_.bytes() + (whole_.size() + free_.size()) * sizeof(R) + piece_of_.capacity() * sizeof(int) +
           means_.capacity() * sizeof(Mean) + squares_.capacity() * sizeof(Size) + factor_.bytes();
  }

 private:
  void make_masks(const Cloth<R>& cloth, const Tears& tears, const SpringWeights& weights);
  void iterate(const Field& r, int begin, int end, double omega, bool first);
  bool products_suffice() const { return left_ <= tolerance_ * (1 + 1e-9); }
  void go_beyond(const Cloth<R>& cloth, const Tears& tears, Beyond beyond);
  void find_pieces(const Cloth<R>& cloth, const Tears& tears);
  void solve_directly(Field& r);
  void subtract_means(Field& r);
  void add_means(Field& r, int i);

  int rows_ = 0, columns_ = 0, stride_ = 0;
  double weight_ = 0;  ///< not 0: the matrix of a mass on a spring, a number
  SpringWeights weights_;
  double tolerance_ = 0, kappa_ = 1, left_ = 0;
  int products_ = 0;
  Array<R> whole_;  ///< for each row its six directions: 1 where the particle owns a whole spring, else 0; β of each
                    ///< spring where they differ
  Array<R> free_;   ///< 0 for fixed particles and beyond the columns, else 1
  Field a_, b_;     ///< of the iteration, with two rows of zeros above and below
  struct Mean {
    double sum[3] = {0, 0, 0}, particles = 0;
    bool held = false;  ///< by fixed particles
  };
  std::vector<int> piece_of_;  ///< of each particle; empty while products suffice
  std::vector<Mean> means_;    ///< of each piece
  std::vector<Size> squares_;  ///< of each row: of the solution, and of it without means
  enum class Way { untried, products, factor };
  Way way_ = Way::untried;  ///< where products do not suffice
  LatticeFactor<R> factor_;
  double residual_squares_ = 0;  ///< of the factor's last solution
};

}  // namespace tyglab::cpu

// One row of the Chebyshev iteration for A = 1 + Σ over springs (constant_solve.h), in SIMD.

namespace tyglab::cpu {

/// out = before + ω (x - before + (r - A x)/middle) for free particles, else 0. Rows of x are 3·stride apart, and the
/// two above and below are there, as are the masks of the two rows above.
template <class R>
struct ConstantRow {
  const R *x, *before, *r;
  R* out;
  const R* whole;  ///< of the row: for each direction 1 where the particle owns a spring, `mask_stride` numbers each
  const R* free;
  std::ptrdiff_t stride, mask_stride;
  int columns;
  double stretch, bending;  ///< β of springs is these times `whole`
  double per_middle, omega;
};
template <class R>
void iterate_row(const ConstantRow<R>& row);

}  // namespace tyglab::cpu
