#include "core/engines/banded.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyglab {

void BandedCholesky::begin(int size, int band) {
  assert(size > 0 && band >= 0);
  size_ = size, band_ = band;
  elements_.assign(std::size_t(size) * (band + 1), 0.0);
  column_.assign(std::size_t(band) + 1, 0.0);
}

bool BandedCholesky::factor(const Stop& stop) {
  assert(size_ > 0 && elements_.size() == std::size_t(size_) * (band_ + 1));
  for (int k = 0; k < size_; ++k) {
    const double pivot = at(k, k);
    if (stop && stop()) return false;
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double root = std::sqrt(pivot);
    at(k, k) = root;
    const int below = std::min(band_, size_ - 1 - k);
    for (int n = 1; n <= below; ++n) column_[n] = at(k + n, k) /= root;
    // Each row takes its part of the outer product: both run through memory, so this is done in SIMD.
    for (int n = 1; n <= below; ++n) {
      const double factor = column_[n];
      if (factor == 0) continue;
      double* row = &at(k + n, k + 1);
      for (int c = 0; c < n; ++c) row[c] -= factor * column_[c + 1];
    }
  }
  return true;
}

void BandedCholesky::solve(std::span<double> b) const {
  assert(b.size() == std::size_t(size_));
  for (int k = 0; k < size_; ++k) {
    double sum = b[k];
    for (int c = std::max(0, k - band_); c < k; ++c) sum -= at(k, c) * b[c];
    assert(at(k, k) > 0);  // a factor has roots of pivots there
    b[k] = sum / at(k, k);
  }
  for (int k = size_ - 1; k >= 0; --k) {
    b[k] /= at(k, k);
    for (int c = std::max(0, k - band_); c < k; ++c) b[c] -= at(k, c) * b[k];
  }
}

void BandedCholesky::solve(std::span<std::array<double, 4>> b) const {
  assert(b.size() == std::size_t(size_));
  for (int k = 0; k < size_; ++k) {
    const int first = std::max(0, k - band_);
    const double* row = elements_.data() + index(k, first);
    std::array<double, 4> sum = b[k];
    for (int c = first; c < k; ++c)
      for (int n = 0; n < 4; ++n) sum[n] -= row[c - first] * b[c][n];
    assert(at(k, k) > 0);
    for (int n = 0; n < 4; ++n) b[k][n] = sum[n] / at(k, k);
  }
  for (int k = size_ - 1; k >= 0; --k) {
    const int first = std::max(0, k - band_);
    const double* row = elements_.data() + index(k, first);
    std::array<double, 4> now = b[k];
    for (double& part : now) part /= at(k, k);
    b[k] = now;
    for (int c = first; c < k; ++c)
      for (int n = 0; n < 4; ++n) b[c][n] -= row[c - first] * now[n];
  }
}

}  // namespace tyglab
