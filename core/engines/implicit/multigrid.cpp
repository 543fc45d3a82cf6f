#include "core/engines/implicit/multigrid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/engines/implicit/stiffness.h"

namespace tyglab::implicit {
namespace {

constexpr int coarsest = 3;  // rows or columns that are not made fewer

int coarser(int n) {
  assert(n >= 1);
  return n <= coarsest ? n : n / 2 + 1;
}

/// Chebyshev's iteration for eigenvalues between a tenth of the largest and the largest. On the lattice itself B A has
/// none above the number of points that one potential joins: of two points, (x_i - x_j)ᵀ K (x_i - x_j) is at most twice
/// x_iᵀ K x_i + x_jᵀ K x_j. On coarser ones interpolation leads to at most 4/3 of that along a direction in which all
/// springs pull.
constexpr double largest_eigenvalue(int points, bool finest) {
  return finest ? points : 4.0 * points / 3;
}
constexpr int rows_between_asking = 64;             // whether to stop
constexpr double middle = 0.55, half_width = 0.45;  // of that interval, in parts of its upper end

}  // namespace

template <class R>
bool Multigrid<R>::resize(const Lattice& lattice, int stride, const std::function<bool()>& stops) {
  assert(lattice.size() > 0 && stride >= lattice.columns);
  if (!levels_.empty() && levels_[0].rows == lattice.rows && levels_[0].columns == lattice.columns) return true;
  std::vector<Level> levels;
  for (int rows = lattice.rows, columns = lattice.columns;;) {
    Level& level = levels.emplace_back();
    const bool finest = levels.size() == 1;
    level.rows = rows, level.columns = columns;
    level.stride = finest ? stride : simd::row_stride<R>(columns + 2);
    level.pitch = operator_pitch(level.stride);
    if (!finest) level.blocks.assign(std::size_t(level.rows) * level.pitch + 4 * Level::lead, R(0));
    if (stops()) return false;
    level.inverse.assign(std::size_t(rows + 2) * 6 * level.stride + 2 * Level::lead, R(0));
    if (stops()) return false;
    level.x.resize(rows + 3, level.stride);
    if (!finest) level.given.resize(rows + 3, level.stride);
    if (coarser(rows) == rows && coarser(columns) == columns) break;
    rows = coarser(rows), columns = coarser(columns);
  }
  assert(levels.back().rows <= coarsest && levels.back().columns <= coarsest);
  work_stride_ = simd::row_stride<R>(lattice.columns + 2);
  for (Array<R>& row : scratch_) row.assign(std::size_t(operator_pitch(work_stride_)) + 6 * Level::lead, R(0));
  zeros_.assign(scratch_[0].size(), R(0));
  free_stride_ = work_stride_;
  free_.assign(std::size_t(lattice.rows + 1) * free_stride_ + 2 * Level::lead, R(0));
  levels_ = std::move(levels);
  return true;
}

template <class R>
void Multigrid<R>::share_level(Level& level, int size) const {
  assert(size >= 1);
  level.parts.resize(std::size_t(level.rows < shared_rows(size) ? 1 : size));
  const int parts = int(level.parts.size());
  if (parts > 1) level.r.resize(level.rows + 3, level.stride);
  for (int n = 0; n < parts; ++n) {
    Part& part = level.parts[std::size_t(n)];
    part.own = share_of(level.rows, n, parts);
    assert(part.own.begin < part.own.end && (parts == 1 || part.own.end - part.own.begin >= 2 * halo));
    part.first = std::max(part.own.begin - halo, 0);
    const int rows = std::min(part.own.end + halo, level.rows) - part.first;
    for (Field* field : {&part.d, &part.q, &part.r}) field->resize(rows + 3, level.stride);
    part.unused.assign(std::size_t(3 * level.stride), R(0));
  }
}

template <class R>
void Multigrid<R>::share(Crew& crew, int size, const std::function<bool()>& stops) {
  crew_ = &crew, stops_ = &stops, stopped_ = false;
  const std::size_t rows = 2 * std::size_t(size);
  if (rows_.size() == rows && !levels_[0].parts.empty()) return;
  rows_.clear();  // they are there again once all of the memory is
  for (Level& level : levels_) {
    if (stops()) return;
    share_level(level, size);
  }
  rows_.assign(rows, Array<R>(std::size_t(3 * work_stride_ + 8 * Level::lead), R(0)));
}

template <class R>
std::size_t Multigrid<R>::bytes() const {
  std::size_t total = (zeros_.size() + free_.size()) * sizeof(R) + coarsest_.size() * sizeof(double);
  for (const Array<R>& row : scratch_) total += row.size() * sizeof(R);
  for (const Array<R>& row : rows_) total += row.size() * sizeof(R);
  for (const Level& level : levels_) {
    total += (level.blocks.size() + level.curving.size() + level.inverse.size()) * sizeof(R);
    for (const Field* field : {&level.given, &level.r, &level.x}) total += field->bytes();
    for (const Part& part : level.parts)
      total += part.d.bytes() + part.q.bytes() + part.r.bytes() + part.unused.size() * sizeof(R);
  }
  return total;
}

template <class R>
void Multigrid<R>::prepare(const SpringMatrix<R>& matrix, const std::function<bool()>& stops) {
  assert(!levels_.empty() && matrix.coefficients != nullptr && matrix.m > 0);
  assert(matrix.fixed.empty() || matrix.fixed.size() >= std::size_t(levels_[0].rows) * levels_[0].columns);
  matrix_ = matrix;
  prepare_finest(stops);
  for (std::size_t l = 0; l + 1 < levels_.size() && !stops(); ++l) {
    coarsen(l, &Level::blocks, stops);
    if (matrix.curving != nullptr) coarsen(l, &Level::curving, stops);
  }
  for (std::size_t l = 1; l < levels_.size() && !stops(); ++l) {
    Level& at = levels_[l];
    if (matrix.curving != nullptr) add_curving(l);
    for (int i = 0; i < at.rows; ++i)
      invert_blocks_row<R>(at.row(&Level::blocks, i), at.inverse_row(i), at.stride, at.columns);
  }
  if (levels_.size() > 1 && !stops()) invert_coarsest();
}

/// What is fixed, and the blocks on the diagonal.
template <class R>
void Multigrid<R>::prepare_finest(const std::function<bool()>& stops) {
  Level& at = levels_[0];
  std::fill(at.inverse.begin(), at.inverse.end(), R(0));
  for (int i = 0; i < at.rows; ++i) {
    R* free = free_.data() + std::ptrdiff_t(i) * free_stride_;
    for (int j = 0; j < at.columns; ++j)
      free[j] = R(matrix_.fixed.empty() || !matrix_.fixed[std::size_t(i) * at.columns + j]);
    for (int c = 0; c < 3; ++c) std::fill_n(at.inverse_row(i) + c * at.stride, at.columns, R(matrix_.m));
  }
  for (int i = 0; i < at.rows; ++i) {
    if (i % rows_between_asking == 0 && stops()) return;
    R* blocks = at.inverse_row(i);
    diagonal_row(matrix_.coefficients + i * coefficient_pitch(at.stride), blocks, at.stride, at.columns);
    const R* free = free_.data() + std::ptrdiff_t(i) * free_stride_;
    for (int j = 0; j < at.columns; ++j) blocks[j] *= free[j];
    invert_blocks_row<R>(blocks, blocks, at.stride, at.columns);
  }
}

/// A level's springs in place of what resists curvature join its operator.
template <class R>
void Multigrid<R>::add_curving(std::size_t level) {
  Level& at = levels_[level];
  const R part = R(std::pow(0.25, double(level)));
  for (std::size_t n = 0; n < at.blocks.size(); ++n) at.blocks[n] += part * at.curving[n];
}

/// Row i of the finest lattice's nine-point operator, in scratch 0 or 1 by turns; of rows in rising order.
template <class R>
void Multigrid<R>::build_nine_point_row(const R* springs, double m, int i) {
  Level& at = levels_[0];
  assert(i >= 0 && i < at.rows);
  R* row = scratch(i % 2);
  if (i == 0)
    for (int c = 0; c < block_parts; ++c) std::fill_n(row + c * work_stride_, at.columns, c < 3 ? R(m) : R(0));
  const R* coefficients = springs + i * coefficient_pitch(at.stride);
  const R* free = free_.data() + std::ptrdiff_t(i) * free_stride_;
  nine_point_row<R>({coefficients, i > 0 ? coefficients - coefficient_pitch(at.stride) : nullptr, at.stride, at.columns,
                     free, free + free_stride_, row, scratch((i + 1) % 2), work_stride_, m});
}

/// Row i of a level's operator with only the columns of the next level, in one of three scratch rows by turns.
template <class R>
const R* Multigrid<R>::next_coarse_columns(std::size_t level, Array<R> Level::*of, int i) {
  const Level &at = levels_[level], &next = levels_[level + 1];
  const bool blocks = of == &Level::blocks;
  if (level == 0) build_nine_point_row(blocks ? matrix_.coefficients : matrix_.curving, blocks ? matrix_.m : 0, i);
  const R* row = level == 0 ? scratch(i % 2) : levels_[level].row(of, i);
  const std::ptrdiff_t stride = level == 0 ? work_stride_ : at.stride;
  R* to = scratch(2 + i % 3);
  if (next.columns != at.columns) {
    coarsen_columns(row, stride, to, next.stride, next.columns);
  } else {
    for (int part = 0; part < blocks_of_a_particle * block_parts; ++part)
      std::copy_n(row + part * stride, next.stride, to + part * next.stride);
  }
  return to;
}

/// Makes an operator of the next level.
template <class R>
void Multigrid<R>::coarsen(std::size_t from, Array<R> Level::*of, const std::function<bool()>& stops) {
  assert(from + 1 < levels_.size());
  const Level& at = levels_[from];
  Level& next = levels_[from + 1];
  if ((next.*of).empty()) (next.*of).assign(next.blocks.size(), R(0));
  const R* none = zeros_.data() + Level::lead;
  const R* rows[3] = {none, none, none};  // 2I - 1, 2I, 2I + 1
  for (int I = 0, i = 0; I < next.rows; ++I) {
    if (I % (rows_between_asking / 2) == 0 && stops()) return;
    const auto following = [&] { return i < at.rows ? next_coarse_columns(from, of, i++) : none; };
    if (next.rows == at.rows) {
      std::copy_n(following(), next.pitch, next.row(of, I));
    } else {
      rows[0] = rows[2], rows[1] = following(), rows[2] = following();
      coarsen_rows(rows[0], rows[1], rows[2], next.row(of, I), next.stride, next.columns);
    }
    assert(I + 1 < next.rows || i == at.rows);  // no row is left out
  }
}

template <class R>
void Multigrid<R>::invert_coarsest() {
  Level& at = levels_.back();
  const int nodes = at.rows * at.columns, n = 3 * nodes;
  std::vector<double> a(std::size_t(n) * n, 0.0);
  constexpr int part[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  const auto put = [&](int i, int j, int oi, int oj, int which, int column) {
    if (oi >= at.rows || oj < 0 || oj >= at.columns) return;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const double value = double(at.block_row(i)[(which * block_parts + part[r][c]) * at.stride + column]);
        const int p = 3 * (i * at.columns + j) + r, q = 3 * (oi * at.columns + oj) + c;
        a[std::size_t(p) * n + q] = a[std::size_t(q) * n + p] = value;
      }
  };
  for (int i = 0; i < at.rows; ++i)
    for (int j = 0; j < at.columns; ++j)
      put(i, j, i, j, 0, j), put(i, j, i, j + 1, 1, j), put(i, j, i + 1, j, 2, j), put(i, j, i + 1, j + 1, 3, j),
          put(i, j, i + 1, j - 1, 4, j - 1);
  // Gauss and Jordan, without pivots, which a positive matrix does not need; what cannot move stays out of it.
  for (int k = 0; k < n; ++k) {
    double* row = a.data() + std::size_t(k) * n;
    const bool moves = row[k] > 0;
    const double per = moves ? 1 / row[k] : 0;
    row[k] = 1;
    for (int c = 0; c < n; ++c) row[c] *= per;
    for (int r = 0; r < n; ++r) {
      double* other = a.data() + std::size_t(r) * n;
      const double factor = other[k];
      if (r == k || factor == 0) continue;
      other[k] = 0;
      for (int c = 0; c < n; ++c) other[c] -= factor * row[c];
    }
  }
  coarsest_ = std::move(a);
}

template <class R>
void Multigrid<R>::solve_coarsest() {
  Level& at = levels_.back();
  const int n = 3 * at.rows * at.columns;
  assert(n <= 3 * coarsest * coarsest && coarsest_.size() == std::size_t(n) * n);
  double r[3 * coarsest * coarsest];
  for (int p = 0; p < n / 3; ++p)
    for (int c = 0; c < 3; ++c) r[3 * p + c] = double(at.given.row(p / at.columns, c)[p % at.columns]);
  for (int p = 0; p < n; ++p) {
    double sum = 0;
    for (int q = 0; q < n; ++q) sum += coarsest_[std::size_t(p) * n + q] * r[q];
    at.x.row(p / 3 / at.columns, p % 3)[p / 3 % at.columns] = R(sum);
  }
}

/// Row i of q = A d. `first`: nothing was added to its row, or to the one below, so far.
template <class R>
void Multigrid<R>::multiply(std::size_t level, Part& part, int i, bool first) const {
  const Level& at = levels_[level];
  R *d = part.of(part.d, i), *q = part.of(part.q, i);
  if (level == 0) {
    multiply_row(ProductTask<R>{matrix_.coefficients + i * coefficient_pitch(at.stride), d, q, at.stride, at.columns,
                                first, matrix_.m});
  } else {
    multiply_blocks_row(BlockProduct<R>{at.block_row(i), d, q, at.stride, at.columns, first});
  }
}

template <class R>
SmoothTask<R> Multigrid<R>::task_of(Level& at, Part& part, int i, const Weights& weights) const {
  const bool own = i >= part.own.begin && i < part.own.end;
  return {part.of(part.q, i),
          at.inverse_row(i),
          part.of(part.r, i),
          part.of(part.d, i),
          own ? at.x.row(i) : part.unused.data(),
          at.stride,
          at.columns,
          weights.keep,
          weights.scale};
}

/// A pass over some rows.
template <class Work>
struct RowPass {
  RowRange rows;
  Work work;
  void at(int i) const {
    if (i >= rows.begin && i < rows.end) work(i);
  }
};
template <class Work>
RowPass(RowRange, Work) -> RowPass<Work>;

/// Calls each pass for its rows, in rising order. The passes go through the lattice together, so that what is read of
/// memory is read once: each is two rows behind the one before it, since a row of a product needs d of the two rows
/// below it, and leaves a part of q there.
template <class R>
template <class... Passes>
void Multigrid<R>::follow_each_other(int number, RowRange rows, const Passes&... passes) {
  constexpr int behind = 2;
  for (int i = rows.begin; i < rows.end + behind * int(sizeof...(passes) - 1); ++i) {
    if ((i - rows.begin) % rows_between_asking == 0 && stops(number)) return;
    int row = i;
    ((passes.at(row), row -= behind), ...);
  }
}

template <class R>
void Multigrid<R>::restrict_residual(std::size_t level, int number) {
  assert(level + 1 < levels_.size() && number >= 0);
  Level &at = levels_[level], &next = levels_[level + 1];
  const std::ptrdiff_t wide = level == 0 ? work_stride_ : at.stride;
  R* sum = rows_[std::size_t(2 * number)].data() + Level::lead;
  std::fill_n(sum - Level::lead, 3 * wide + 3 * Level::lead, R(0));
  const Field& r = at.residual();
  const auto row = [&](int i, int c) { return i >= 0 && i < at.rows ? r.row(i, c) : zeros_.data(); };
  const RowRange share = share_of(next.rows, number, int(at.parts.size()));
  for (int I = share.begin; I < share.end; ++I) {
    const bool fewer = next.rows != at.rows;
    for (int c = 0; c < 3; ++c) {
      R* to = sum + c * wide;
      if (fewer) {
        combine_rows(0.5, row(2 * I - 1, c), 0.5, row(2 * I + 1, c), to, at.stride);
        combine_rows<R>(1, to, 1, row(2 * I, c), to, at.stride);
      } else {
        std::copy_n(row(I, c), at.stride, to);
      }
    }
    if (next.columns != at.columns) {
      restrict_columns(sum, wide, next.given.row(I), next.stride, next.columns, 3);
    } else {
      for (int c = 0; c < 3; ++c) std::copy_n(sum + c * wide, at.columns, next.given.row(I, c));
    }
  }
}

/// Row i of d = P x of the next level, x += d.
template <class R>
void Multigrid<R>::prolong_correction(std::size_t level, int number, int i) {
  assert(level + 1 < levels_.size() && number >= 0);
  Level &at = levels_[level], &next = levels_[level + 1];
  Part& part = at.parts[std::size_t(number)];
  R *between = rows_[std::size_t(2 * number)].data(), *fine = rows_[std::size_t(2 * number + 1)].data();
  const bool fewer = next.rows != at.rows;
  const R* coarse = next.x.row(fewer ? i / 2 : i);
  if (fewer && i % 2 == 1) {
    combine_rows<R>(0.5, coarse, 0.5, next.x.row(i / 2 + 1), between, 3 * next.stride);
    coarse = between;
  }
  if (next.columns != at.columns) {
    prolong_columns(coarse, next.stride, fine, at.stride, at.columns, 3);
  } else {
    for (int c = 0; c < 3; ++c) std::copy_n(coarse + c * next.stride, at.columns, fine + c * at.stride);
  }
  const SmoothTask<R> task = task_of(at, part, i, {});
  add_correction_row<R>(fine, task.inverse, task.d, task.x, at.stride, at.columns);
}

template <class R>
void Multigrid<R>::cycle(std::size_t level, const Field& given, int number) {
  assert(level < levels_.size() && given.pitch() == 3 * levels_[level].stride);
  Level& at = levels_[level];
  if (number >= int(at.parts.size())) return;
  if (level > 0 && level + 1 == levels_.size()) return solve_coarsest();
  Part& part = at.parts[std::size_t(number)];
  const double end = largest_eigenvalue(matrix_.points, level == 0), theta = middle * end, ratio = half_width / middle;
  const double next_ratio = 1 / (2 / ratio - ratio);
  const Weights first{0, 1 / theta}, second{next_ratio * ratio, 2 * next_ratio / (half_width * end)};
  const RowRange own = part.own;
  const auto around = [&](int more) {
    return RowRange{std::max(own.begin - more, 0), std::min(own.end + more, at.rows)};
  };
  // A product of two rows more above is what these leave to the others.
  const RowRange wide = around(halo), near = around(halo / 2);
  const RowRange smoothed{wide.begin, near.end}, left{near.begin, own.end};
  const auto take = [&](const Field& from, int i) { std::copy_n(from.row(i), from.pitch(), part.of(part.r, i)); };
  const auto smooth = [&](RowRange rows, int from, const Weights& weights, int i) {
    multiply(level, part, i, i == rows.begin);
    if (i >= from) smooth_row(task_of(at, part, i, weights));
  };
  const RowPass start{wide, [&](int i) {
                        take(given, i);
                        start_smoothing_row(task_of(at, part, i, first));
                      }};
  const RowPass second_smoothing{smoothed, [&](int i) { smooth(smoothed, near.begin, second, i); }};
  if (levels_.size() == 1) return follow_each_other(number, wide, start, second_smoothing);
  const bool alone = at.parts.size() == 1;
  const RowPass rest{left, [&](int i) {
                       multiply(level, part, i, i == left.begin);
                       if (i < own.begin) return;
                       subtract_row(task_of(at, part, i, {}));
                       if (!alone) std::copy_n(part.of(part.r, i), at.r.pitch(), at.r.row(i));
                     }};
  follow_each_other(number, wide, start, second_smoothing, rest);
  meet(at);
  restrict_residual(level, number);
  meet(at);
  cycle(level + 1, levels_[level + 1].given, number);
  meet(at);
  const RowPass correction{wide, [&](int i) {
                             if (!alone) take(at.r, i);
                             prolong_correction(level, number, i);
                           }};
  follow_each_other(number, wide, correction, RowPass{smoothed, [&](int i) { smooth(smoothed, near.begin, first, i); }},
                    RowPass{left, [&](int i) { smooth(left, own.begin, second, i); }});
}

template <class R>
const RowField<R>& Multigrid<R>::precondition(const Field& r, int number) {
  assert(number >= 0 && number < threads());
  cycle(0, r, number);
  return levels_[0].x;
}

template <class R>
double Multigrid<R>::descend(double part, const R* p, const R* q, R* x, R* r, int i) const {
  const Level& at = levels_[0];
  // Of p nothing is written: the task holds it where a smoother has its own direction.
  return descend_row(SmoothTask<R>{q, at.inverse_row(i), r, const_cast<R*>(p), x, at.stride, at.columns, 0, 0}, part);
}

template class Multigrid<float>;
template class Multigrid<double>;

}  // namespace tyglab::implicit
