// Sums over the springs of one direction that a row of particles owns, in SIMD: the inner loop of the energy.
#pragma once

#include <cstddef>

namespace tyglab {

/// The springs of a row: particles begin <= j < end own one each, whose other end is at j + other of the same arrays.
struct SpringRow {
  const double* x[3];
  const double* v[3];
  std::ptrdiff_t other;
  int begin, end;
  double rest;  ///< m
};

struct SpringSums {
  double longer = 0;   ///< Σ (|x_ij| - rest)² over springs longer than rest, m²
  double shorter = 0;  ///< the same over shorter ones
  double speed = 0;    ///< Σ |v_j - v_i|², m²/s²
};

SpringSums spring_sums(const SpringRow& row);

}  // namespace tyglab
