#include "core/engines/cpu/global_step.h"

#include <algorithm>
#include <cassert>

namespace tyglab::cpu {
namespace {

constexpr double tolerance = 1e-3;  // of products: the next alternation finds what they leave
constexpr double most_work = 2e9;   // multiplications in a factorization: about a second

}  // namespace

template <class R>
bool GlobalStep<R>::prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed, const Stop& stop) {
  const Preset& p = cloth.preset;
  assert(h > 0 && p.m > 0);
  const SpringWeights weights{(h * h * p.k_s + h * p.k_d) / p.m, h * h * p.k_b / p.m};
  if (ready_ && !changed && weights == weights_) return true;
  changed = changed || !ready_;
  ready_ = false;
  rows_ = cloth.lattice.rows, columns_ = cloth.lattice.columns, by_rows_ = columns_ <= rows_;
  products_.prepare(cloth, tears, weights, tolerance, changed);
  const int band = 2 * std::min(rows_, columns_);
  // A product costs a particle about as much as two elements of the factor.
  factorized_ = BandedCholesky::work(double(rows_) * columns_, band) < most_work && products_.products() > band / 2;
  weights_ = weights;
  if (factorized_ && !factorize(cloth, tears, stop)) return false;
  ready_ = true;
  return true;
}

template <class R>
bool GlobalStep<R>::factorize(const Cloth<R>& cloth, const Tears& tears, const Stop& stop) {
  const std::size_t size = std::size_t(rows_) * columns_;
  sides_.resize(size), free_.assign(size, 1);
  factor_.begin(int(size), 2 * std::min(rows_, columns_));
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) {
      factor_.at(number(i, j), number(i, j)) = 1;
      if (!cloth.fixed.empty() && cloth.fixed[std::size_t(i) * columns_ + j]) free_[std::size_t(number(i, j))] = 0;
    }
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j)
      for (int d = 0; d < int(directions.size()); ++d) {
        if (!cloth.lattice.has_spring(d, i, j) || !tears.whole(d, i, j)) continue;
        const Direction& to = directions[std::size_t(d)];
        const double weight = to.bending ? weights_.bending : weights_.stretch;
        const int p = number(i, j), q = number(i + to.di, j + to.dj);
        if (free_[std::size_t(p)]) factor_.at(p, p) += weight;
        if (free_[std::size_t(q)]) factor_.at(q, q) += weight;
        if (free_[std::size_t(p)] && free_[std::size_t(q)]) factor_.at(std::max(p, q), std::min(p, q)) -= weight;
      }
  return factor_.factor(stop);
}

template <class R>
int GlobalStep<R>::solve(Field& r, const Stop& stop) {
  assert(ready_ && r.pitch() >= 3 * columns_);
  assert(!factorized_ || sides_.size() == free_.size());
  if (!factorized_) {
    products_.solve(
        r, 0, rows_, [] {}, stop);
    return 2 * products_.products();
  }
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) {
      const std::size_t n = std::size_t(number(i, j));
      for (int c = 0; c < 3; ++c) sides_[n][std::size_t(c)] = free_[n] ? double(r.row(i, c)[j]) : 0;
    }
  factor_.solve(sides_);
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j)
      for (int c = 0; c < 3; ++c) r.row(i, c)[j] = R(sides_[std::size_t(number(i, j))][std::size_t(c)]);
  return 0;
}

template class GlobalStep<float>;
template class GlobalStep<double>;

}  // namespace tyglab::cpu
