// Sums over the springs of one direction that a row of particles owns, in SIMD: the energy's inner loop.
#pragma once

#include <cstddef>

namespace tyglab {

/// A row's springs: particle j's other end stands at j + other of the same arrays; begin <= j < end own one.
struct SpringRow {
  const double* x[3];
  const double* v[3];
  std::ptrdiff_t other;
  int begin, end;
  double rest;  ///< m
};

struct SpringSums {
  double longer = 0;   ///< Σ (|x_ij| - rest)² of springs longer than rest, m²
  double shorter = 0;  ///< the same of shorter ones
  double speed = 0;    ///< Σ |v_j - v_i|², m²/s²
};

SpringSums spring_sums(const SpringRow& row);

}  // namespace tyglab
