#include "core/engines/cpu/lattice_factor.h"

#include <algorithm>
#include <cassert>

namespace tyglab::cpu {

template <class R>
bool LatticeFactor<R>::factorize(const Cloth<R>& cloth, const Tears& tears, const SpringWeights& weights,
                                 const Stop& stop) {
  lattice_ = cloth.lattice;
  const std::size_t size = std::size_t(lattice_.size());
  sides_.resize(size), left_.resize(size), free_.assign(size, 1), springs_.clear();
  factor_.begin(int(size), band(lattice_));
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j) {
      factor_.at(number(i, j), number(i, j)) = 1;
      if (!cloth.fixed.empty() && cloth.fixed[std::size_t(i) * lattice_.columns + j])
        free_[std::size_t(number(i, j))] = 0;
    }
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j)
      for (int d = 0; d < int(directions.size()); ++d) {
        const Direction& to = directions[std::size_t(d)];
        const double linear = weights.linear == 0 ? 0 : weights.linear * double(cloth.springs.at(d, i, j));
        const double weight = weights.springs.of(to) + linear;
        if (weight == 0 || !lattice_.has_spring(d, i, j) || !tears.whole(d, i, j)) continue;
        springs_.push_back({number(i, j), number(i + to.di, j + to.dj), weight});
      }
  for (const auto& [p, q, weight] : springs_) {
    if (free_[std::size_t(p)]) factor_.at(p, p) += weight;
    if (free_[std::size_t(q)]) factor_.at(q, q) += weight;
    if (free_[std::size_t(p)] && free_[std::size_t(q)]) factor_.at(std::max(p, q), std::min(p, q)) -= weight;
  }
  return factor_.factor(stop);
}

template <class R>
void LatticeFactor<R>::solve(const Field& r) {
  assert(sides_.size() == std::size_t(lattice_.size()) && r.pitch() >= 3 * lattice_.columns);
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j) {
      const std::size_t n = std::size_t(number(i, j));
      for (int c = 0; c < 3; ++c) sides_[n][std::size_t(c)] = free_[n] ? double(r.row(i, c)[j]) : 0;
    }
  factor_.solve(sides_);
}

template <class R>
double LatticeFactor<R>::residual(const Field& r) {
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j)
      for (std::size_t c = 0; c < 3; ++c)
        left_[std::size_t(number(i, j))][c] = double(r.row(i, int(c))[j]) - solution(i, j)[c];
  for (const auto& [p, q, weight] : springs_)
    for (std::size_t c = 0; c < 3; ++c) {
      const double along = weight * (sides_[std::size_t(p)][c] - sides_[std::size_t(q)][c]);
      left_[std::size_t(p)][c] -= along, left_[std::size_t(q)][c] += along;
    }
  double squares = 0;
  for (std::size_t n = 0; n < left_.size(); ++n)
    for (std::size_t c = 0; c < 3 && free_[n] != 0; ++c) squares += left_[n][c] * left_[n][c];
  return squares;
}

template class LatticeFactor<float>;
template class LatticeFactor<double>;

}  // namespace tyglab::cpu
