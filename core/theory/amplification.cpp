#include "core/theory/amplification.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace tyglab {
namespace {

Matrix identity(int size) {
  Matrix one{size, std::vector<double>(std::size_t(size) * size, 0)};
  for (int i = 0; i < size; ++i) one.at(i, i) = 1;
  return one;
}

/// `out`, of the same size, is another matrix: a search for a limit squares ten thousands of them.
void square(const Matrix& a, Matrix& out) {
  std::fill(out.elements.begin(), out.elements.end(), 0.0);
  for (int i = 0; i < a.size; ++i)
    for (int k = 0; k < a.size; ++k)
      for (int j = 0; j < a.size; ++j) out.at(i, j) += a.at(i, k) * a.at(k, j);
}

bool stable(const Scheme& scheme, double h, double zeta) {
  return spectral_radius(amplification(scheme, h, zeta)) <= 1 + 1e-12;
}

}  // namespace

Matrix amplification(const Scheme& scheme, double h, double zeta) {
  assert(zeta >= 0);
  const int n = scheme.vectors;
  Matrix now = identity(n);  // row: a vector's coefficients in terms of the vectors at the beginning of the step
  std::vector<double> force(std::size_t(n), 0), sum(std::size_t(n), 0);
  const auto assign = [&](const std::vector<Assignment>& assignments) {
    for (const Assignment& assignment : assignments) {
      std::fill(sum.begin(), sum.end(), 0.0);
      for (const Term& term : assignment.terms)  // dt = 1: no powers of it
        for (int k = 0; k < n; ++k)
          sum[std::size_t(k)] +=
              term.factor * (term.vector == acceleration ? force[std::size_t(k)] : now.at(term.vector, k));
      for (int k = 0; k < n; ++k) now.at(assignment.target, k) = sum[std::size_t(k)];
    }
  };
  for (const Sweep& sweep : scheme.sweeps) {
    assign(sweep.before);
    if (const double b = sweep.solves; b != 0)
      for (int k = 0; k < n; ++k) {
        double &x = now.at(sweep.position, k), &v = now.at(sweep.velocity, k);
        v = (v - b * h * h * x) / (1 + 2 * b * zeta * h + b * b * h * h);
        x += b * v;
      }
    if (sweep.damps != 0)
      for (int k = 0; k < n; ++k) now.at(sweep.velocity, k) /= 1 + sweep.damps * 2 * zeta * h;
    for (int k = 0; k < n; ++k)
      force[std::size_t(k)] = -h * h * now.at(sweep.position, k) - 2 * zeta * h * now.at(sweep.velocity, k);
    assign(sweep.assignments);
  }
  return now;
}

double spectral_radius(const Matrix& matrix) {
  constexpr int squarings = 48;
  Matrix power = matrix, squared = matrix;
  double log_radius = 0, weight = 1;
  for (int n = 0; n < squarings; ++n) {
    double norm = 0;
    for (const double e : power.elements) norm = std::max(norm, std::abs(e));
    // A nilpotent matrix is gone after as many squarings as its size has bits. One with a defective eigenvalue (Verlet
    // at ω·dt = 2) comes close to such a one, and is lost to rounding long after its radius is known.
    if (norm == 0) return weight * matrix.size > 0.5 ? 0 : std::exp(log_radius);
    for (double& e : power.elements) e /= norm;
    log_radius += weight * std::log(norm);
    square(power, squared);
    std::swap(power, squared);
    weight /= 2;
  }
  return std::exp(log_radius);
}

double stability_limit(const Scheme& scheme, double zeta) {
  constexpr double shortest = 1e-5, first = 1e-3, longest = 20, grid = 1.01;
  double good = first;
  if (!stable(scheme, good, zeta)) {
    while (good > shortest && !stable(scheme, good, zeta)) good /= 2;
    if (good <= shortest) return 0;
  }
  double bad = good * grid;
  while (bad < longest && stable(scheme, bad, zeta)) good = bad, bad *= grid;
  if (bad >= longest) return std::numeric_limits<double>::infinity();
  while (bad - good > 1e-9 * good) {
    const double middle = (good + bad) / 2;
    (stable(scheme, middle, zeta) ? good : bad) = middle;
  }
  return good;
}

}  // namespace tyglab
