#include "core/engines/direct_solve.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace tyglab {
namespace {

/// Particles within which all springs of one reach, when particles are numbered along the shorter side.
int reach(const Lattice& lattice) {
  return 2 * std::min(lattice.rows, lattice.columns);
}

/// The number of a particle's first component.
int first(const Lattice& lattice, int i, int j) {
  return 3 * (lattice.columns <= lattice.rows ? i * lattice.columns + j : j * lattice.rows + i);
}

template <class What>
void for_each(const Lattice& lattice, const What& what) {
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) what(i, j);
}

}  // namespace

bool DirectSolver::is_quick(const Lattice& lattice) {
  return BandedCholesky::work(3.0 * lattice.size(), 3.0 * reach(lattice)) < 2e9;
}

void DirectSolver::add_spring(const LinearSystem& system, int d, int i, int j) {
  const int oi = i + directions[d].di, oj = j + directions[d].dj;
  const SpringStiffness spring = system.spring(d, i, j);
  const bool owner = !system.fixed(i, j), other = !system.fixed(oi, oj);
  const int p = first(system.lattice, i, j), q = first(system.lattice, oi, oj);
  assert(std::abs(p - q) <= 3 * reach(system.lattice));  // both ends lie in the band
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const double add = spring.a[r] * spring.a[c] + (r == c ? spring.t : 0);
      if (owner && c <= r) matrix_.at(p + r, p + c) += add;
      if (other && c <= r) matrix_.at(q + r, q + c) += add;
      if (owner && other) matrix_.at(std::max(p, q) + r, std::min(p, q) + c) -= add;
    }
}

void DirectSolver::assemble(const LinearSystem& system) {
  assert(system.own > 0);
  const Lattice& lattice = system.lattice;
  matrix_.begin(3 * lattice.size(), 3 * reach(lattice) + 2);
  for (int n = 0; n < 3 * lattice.size(); ++n) matrix_.at(n, n) = system.own;
  for_each(lattice, [&](int i, int j) {
    for (int d = 0; d < int(directions.size()); ++d)
      if (lattice.has_spring(d, i, j)) add_spring(system, d, i, j);
  });
}

bool DirectSolver::solve(const LinearSystem& system, const std::function<void(int i, int j, int c, double s)>& take,
                         const Stop& stop) {
  assert(system.fixed && system.spring && system.right_side && take);
  const Lattice& lattice = system.lattice;
  assemble(system);
  if (!matrix_.factor(stop)) return false;
  right_side_.resize(3 * std::size_t(lattice.size()));
  const auto at = [&](int i, int j, int c) -> double& { return right_side_[std::size_t(first(lattice, i, j) + c)]; };
  for_each(lattice, [&](int i, int j) {
    for (int c = 0; c < 3; ++c) at(i, j, c) = system.fixed(i, j) ? 0 : system.right_side(i, j, c);
  });
  matrix_.solve(right_side_);
  for_each(lattice, [&](int i, int j) {
    for (int c = 0; c < 3; ++c) take(i, j, c, at(i, j, c));
  });
  return true;
}

}  // namespace tyglab
