#include "core/engines/cpu/global_step.h"

#include <cassert>

#include "core/forces/force.h"

namespace tyglab::cpu {
namespace {

constexpr double tolerance = 1e-3;  // of products: the next alternation finds what they leave
constexpr double most_work = 2e9;   // multiplications in a factorization: about a second

}  // namespace

template <class R>
bool GlobalStep<R>::prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed, const Stop& stop) {
  const Preset& p = cloth.preset;
  assert(h > 0 && p.m > 0);
  const SpringConstants springs = spring_constants(p);
  const auto stretch = [&](double k) { return (h * h * k + h * p.k_d) / p.m; };
  const SpringWeights weights{
      {stretch(springs.weft), stretch(springs.warp), stretch(springs.shear), h * h * springs.bend / p.m},
      cloth.springs.empty() ? 0 : h * h / p.m};
  changed = changed || springs_ != cloth.springs.version();
  if (ready_ && !changed && weights == weights_) return true;
  changed = changed || !ready_;
  ready_ = false;
  lattice_ = cloth.lattice;
  products_.prepare(cloth, tears, weights, tolerance, changed);
  // A product costs a particle about as much as two elements of the factor.
  factorized_ =
      LatticeFactor<R>::work(lattice_) < most_work && products_.products() > LatticeFactor<R>::band(lattice_) / 2;
  weights_ = weights, springs_ = cloth.springs.version();
  if (factorized_ && !factor_.factorize(cloth, tears, weights, stop)) return false;
  ready_ = true;
  return true;
}

template <class R>
int GlobalStep<R>::solve(Field& r, const Stop& stop) {
  assert(ready_);
  if (!factorized_) {
    products_.solve(
        r, 0, lattice_.rows, [] {}, stop);
    return 2 * products_.products();
  }
  factor_.solve(r);
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j)
      for (int c = 0; c < 3; ++c) r.row(i, c)[j] = R(factor_.solution(i, j)[std::size_t(c)]);
  return 0;
}

template class GlobalStep<float>;
template class GlobalStep<double>;

}  // namespace tyglab::cpu
