// Linear stability of the explicit schemes, derived from their tables: the effect of one step on x'' = -ω² x - 2ζω x'.
#pragma once

#include <vector>

#include "core/integrators/scheme.h"

namespace tyglab {

/// A square matrix, row after row.
struct Matrix {
  int size = 0;
  std::vector<double> elements;
  double& at(int row, int column) { return elements[std::size_t(row) * size + column]; }
  double at(int row, int column) const { return elements[std::size_t(row) * size + column]; }
};

/// What one step of dt = h/ω does to the scheme's state vectors, with ω = h and dt = 1: h = ω·dt, ζ >= 0.
Matrix amplification(const Scheme& scheme, double h, double zeta);

/// The largest |eigenvalue|: growth per step in the long run. By repeated squaring (Gelfand's formula).
double spectral_radius(const Matrix& matrix);

/// The largest h = ω·dt up to which no step is unstable (spectral radius at most 1 up to rounding), within 1e-4 of
/// itself; 0 where even h = 1e-5 is, infinity where h = 20 is not.
double stability_limit(const Scheme& scheme, double zeta);

}  // namespace tyglab
