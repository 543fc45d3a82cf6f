#include "core/engines/cpu/constant_solve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyglab::cpu {
namespace {

constexpr int ghost_rows = 2;      // above and below, to which no spring reaches
constexpr double most_work = 5e8;  // multiplications in a factorization, which nothing stops

static_assert(std::all_of(directions.begin(), directions.end(),
                          [](const Direction& to) { return to.di <= ghost_rows; }));
template <class R>
constexpr std::ptrdiff_t mask_stride(int stride) {
  return stride + widest_vector / std::ptrdiff_t(sizeof(R));  // what lies left of a row's first column is 0
}

}  // namespace

template <class R>
void ConstantSolver<R>::make_masks(const Cloth<R>& cloth, const Tears& tears, const SpringWeights& weights) {
  const Lattice& lattice = cloth.lattice;
  const std::ptrdiff_t width = mask_stride<R>(stride_), pitch = std::ptrdiff_t(directions.size()) * width;
  whole_.assign(std::size_t((rows_ + ghost_rows + 1) * pitch), R(0));
  free_.assign(std::size_t(rows_) * stride_ + widest_vector / sizeof(R), R(0));
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) {
      const bool fixed = !cloth.fixed.empty() && cloth.fixed[std::size_t(i) * columns_ + j] != 0;
      free_[std::size_t(i) * stride_ + j] = fixed ? R(0) : R(1);
      for (int d = 0; d < int(directions.size()); ++d)
        if (lattice.has_spring(d, i, j) && tears.whole(d, i, j))
          whole_[std::size_t((i + ghost_rows) * pitch + d * width + j)] =
              !weights.differ()     ? R(1)
              : weights.linear == 0 ? R(weights.springs.of(directions[std::size_t(d)]))
                                    : R(weights.springs.of(directions[std::size_t(d)]) +
                                        weights.linear * double(cloth.springs.at(d, i, j)));
    }
}

template <class R>
void ConstantSolver<R>::prepare(const Cloth<R>& cloth, const Tears& tears, SpringWeights weights, double tolerance,
                                bool changed, Beyond beyond) {
  assert(weights.springs.least() >= 0 && weights.springs.bend >= 0 && tolerance > 0 && tolerance < 1);
  assert(rows_ == 0 || (rows_ == cloth.lattice.rows && stride_ == cloth.stride));
  weight_ = cloth.preset.kind == Kind::one_weight ? 1 + weights.springs.weft : 0;
  if (weight_ != 0) return;
  if (rows_ == 0) {
    a_.resize(cloth.lattice.rows + 2 * ghost_rows, cloth.stride);
    b_.resize(cloth.lattice.rows + 2 * ghost_rows, cloth.stride);
    columns_ = cloth.lattice.columns, stride_ = cloth.stride, rows_ = cloth.lattice.rows;
    changed = true;
  }
  if (changed || weights_.differ() || weights.differ())
    make_masks(cloth, tears, weights), piece_of_.clear(), way_ = Way::untried;
  if (weights == weights_ && tolerance == tolerance_) return go_beyond(cloth, tears, beyond);
  weights_ = weights, tolerance_ = tolerance;
  // What no lattice's sums of squared differences exceed, times the squares: 12 along stretch springs, 8 along bending
  // ones. Fewer springs and fixed particles make them less.
  kappa_ = 1 + weights.springs.largest_stretch_eigenvalue() + 8 * weights.springs.bend;
  if (weights.linear != 0) kappa_ += weights.linear * linear_sum_of(&Force::largest_eigenvalue, cloth.preset);
  products_ = 0, left_ = 0;
  piece_of_.clear(), way_ = Way::untried;
  if (kappa_ == 1) return;
  // Each round of n leaves 1/T_n((κ + 1)/(κ - 1)) at most.
  const double rate = std::acosh((kappa_ + 1) / (kappa_ - 1));
  products_ = int(std::clamp(std::ceil(std::acosh(1 / std::sqrt(tolerance)) / rate), 1.0, double(most_products)));
  left_ = 1 / std::pow(std::cosh(products_ * rate), 2);
  assert(left_ >= 0 && left_ <= 1);
  go_beyond(cloth, tears, beyond);
}

/// Prepares what is needed where products do not suffice, unless it is there.
template <class R>
void ConstantSolver<R>::go_beyond(const Cloth<R>& cloth, const Tears& tears, Beyond beyond) {
  if (products_suffice()) return;
  if (piece_of_.empty()) find_pieces(cloth, tears);
  if (way_ != Way::untried) return;
  const bool factorizes = beyond == Beyond::factorizes && LatticeFactor<R>::work(cloth.lattice) < most_work &&
                          factor_.factorize(cloth, tears, weights_);
  way_ = factorizes ? Way::factor : Way::products;
}

template <class R>
void ConstantSolver<R>::find_pieces(const Cloth<R>& cloth, const Tears& tears) {
  constexpr int none = -1;
  std::vector<int> piece_of(std::size_t(rows_) * columns_, none), found;
  means_.clear();
  squares_.assign(std::size_t(rows_), {});
  for (int first = 0; first < rows_ * columns_; ++first) {
    if (piece_of[std::size_t(first)] != none) continue;
    const int piece = int(means_.size());
    Mean& mean = means_.emplace_back();
    found.assign(1, first), piece_of[std::size_t(first)] = piece;
    // found grows as its particles' neighbors are found.
    for (std::size_t n = 0; n < found.size(); ++n) {
      const int i = found[n] / columns_, j = found[n] % columns_;
      mean.held = mean.held || free_[std::size_t(i) * stride_ + j] == 0;
      const auto look = [&](int d, int owner_i, int owner_j, int to_i, int to_j) {
        if (!cloth.lattice.has_spring(d, owner_i, owner_j) || !tears.whole(d, owner_i, owner_j)) return;
        int& of = piece_of[std::size_t(to_i) * columns_ + to_j];
        if (of == none) of = piece, found.push_back(to_i * columns_ + to_j);
      };
      for (int d = 0; d < int(directions.size()); ++d) {
        const Direction& to = directions[std::size_t(d)];
        if (weights_.springs.of(to) == 0 && weights_.linear == 0) continue;
        look(d, i, j, i + to.di, j + to.dj);
        look(d, i - to.di, j - to.dj, i - to.di, j - to.dj);
      }
    }
    mean.particles = double(found.size());
  }
  piece_of_.swap(piece_of);  // now that all of the memory is there
}

/// On one thread.
template <class R>
void ConstantSolver<R>::subtract_means(Field& r) {
  for (Mean& mean : means_) std::fill_n(mean.sum, 3, 0.0);
  const auto for_each = [&](const auto& what) {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j) {
        Mean& mean = means_[std::size_t(piece_of_[std::size_t(i) * columns_ + j])];
        if (!mean.held)
          for (int c = 0; c < 3; ++c) what(r.row(i, c)[j], mean.sum[c], mean.particles);
      }
  };
  for_each([](R value, double& sum, double particles) { sum += double(value) / particles; });
  for_each([](R& value, double mean, double) { value = R(double(value) - mean); });
}

/// Row i of r from a_ and the means.
template <class R>
void ConstantSolver<R>::add_means(Field& r, int i) {
  Size& squares = squares_[std::size_t(i)];
  squares = {};
  for (int j = 0; j < columns_; ++j) {
    const Mean& mean = means_[std::size_t(piece_of_[std::size_t(i) * columns_ + j])];
    for (int c = 0; c < 3; ++c) {
      const double changing = double(a_.row(i + ghost_rows, c)[j]), whole = changing + mean.sum[c];
      r.row(i, c)[j] = R(whole);
      squares.solution += whole * whole, squares.lacking += changing * changing;
    }
  }
}

/// On one thread: r without means, and a_, the solution without them.
template <class R>
void ConstantSolver<R>::solve_directly(Field& r) {
  subtract_means(r);
  factor_.solve(r);
  residual_squares_ = factor_.residual(r);
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j)
      for (int c = 0; c < 3; ++c) a_.row(i + ghost_rows, c)[j] = R(factor_.solution(i, j)[std::size_t(c)]);
}

template <class R>
typename ConstantSolver<R>::Size ConstantSolver<R>::size() const {
  if (piece_of_.empty()) return {};
  Size all;
  for (const Size& row : squares_) all.solution += row.solution, all.lacking += row.lacking;
  const double particles = double(piece_of_.size());
  // A has no eigenvalue below 1: the solution lacks no more than the residual.
  if (way_ == Way::factor) return {std::sqrt(all.solution / particles), std::sqrt(residual_squares_ / particles)};
  // The part of the solution that changes from particle to particle is at least 1 - left_ of what it should be.
  const double found = std::max(1 - left_, 1e-12);
  return {std::sqrt(all.solution / particles), left_ / found * std::sqrt(all.lacking / particles)};
}

/// From a_ and, unless it is the first of a round, b_ before it to b_: all of the rows.
template <class R>
void ConstantSolver<R>::iterate(const Field& r, int begin, int end, double omega, bool first) {
  const double per_middle = 2 / (kappa_ + 1);
  const std::ptrdiff_t width = mask_stride<R>(stride_), pitch = std::ptrdiff_t(directions.size()) * width;
  for (int i = begin; i < end; ++i) {
    const Field& before = first ? a_ : b_;
    iterate_row(ConstantRow<R>{a_.row(i + ghost_rows), before.row(i + ghost_rows), r.row(i), b_.row(i + ghost_rows),
                               whole_.data() + (i + ghost_rows) * pitch, free_.data() + std::ptrdiff_t(i) * stride_,
                               stride_, width, columns_, weights_.differ() ? 1 : weights_.springs.weft,
                               weights_.differ() ? 1 : weights_.springs.bend, per_middle, omega});
  }
}

template <class R>
void ConstantSolver<R>::solve(Field& r, int begin, int end, const std::function<void()>& barrier, const Stop& stop) {
  if (weight_ != 0) {
    if (begin == 0) r.row(0, 1)[0] = R(double(r.row(0, 1)[0]) / weight_);
    barrier();
    return;
  }
  if (products_ == 0) return;
  assert(begin >= 0 && begin <= end && end <= rows_);
  assert(!stop || (begin == 0 && end == rows_));  // who stops is alone
  // a_ and b_ change places after each product: by one thread, between two barriers.
  const auto exchange = [&] {
    barrier();
    if (begin == 0) std::swap(a_, b_);
    barrier();
  };
  const double middle = (kappa_ + 1) / 2, half = (kappa_ - 1) / 2, ratio = half * half / (4 * middle * middle);
  if (way_ == Way::factor) {
    if (begin == 0) solve_directly(r);
    barrier();
    for (int i = begin; i < end; ++i) add_means(r, i);
    return;
  }
  if (begin == 0 && !piece_of_.empty()) subtract_means(r);
  for (int i = begin; i < end; ++i) std::fill_n(a_.row(i + ghost_rows), a_.pitch(), R(0));
  barrier();
  for (int round = 0; round < 2; ++round) {
    double omega = 2;
    for (int n = 0; n < products_; ++n) {
      if (stop && stop()) return;
      iterate(r, begin, end, n == 0 ? 1 : omega, n == 0);
      omega = 1 / (1 - omega * ratio);
      exchange();
    }
  }
  for (int i = begin; i < end; ++i)
    if (piece_of_.empty())
      for (int c = 0; c < 3; ++c) std::copy_n(a_.row(i + ghost_rows, c), columns_, r.row(i, c));
    else
      add_means(r, i);
}

template class ConstantSolver<float>;
template class ConstantSolver<double>;

}  // namespace tyglab::cpu
