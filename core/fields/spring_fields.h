// Adds the springs of one direction to the particles of a row, in SIMD: the inner loop of tension and strain.
#pragma once

#include <cstddef>

namespace tyglab {

/// Springs between the particles begin <= j < end of a row and those that stand at j + other of the same arrays.
template <class R>
struct FieldSprings {
  const R* x[3];
  std::ptrdiff_t other;
  int begin, end;
  double k_s, rest;  ///< N/m, m
};

/// largest[j] becomes F_s (2.5) of the spring, N, where that is more.
void raise_to_tension(const FieldSprings<float>& springs, float* largest);
void raise_to_tension(const FieldSprings<double>& springs, double* largest);
/// Adds the strain, (|x_ij| - rest) / rest, to sum[j].
void add_strain(const FieldSprings<float>& springs, float* sum);
void add_strain(const FieldSprings<double>& springs, double* sum);

}  // namespace tyglab
