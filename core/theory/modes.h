// Linear theory of a method for the modes of the cloth: its limits of dt and stiffness, and its growth, from the
// method's own table.
#pragma once

#include <span>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/integrators/stabilized.h"
#include "core/model/preset.h"

namespace tyglab {

/// The stiffness and damping of one mode u of the cloth, |u| = 1.
struct Mode {
  double stiffness = 0;  ///< ω² = uᵀM⁻¹K u, 1/s²; negative where the cloth would buckle
  double damping = 0;    ///< 2ζω = uᵀM⁻¹C u, 1/s
  double omega() const;  ///< √stiffness, 1/s; 0 where it is negative
};

/// The bound of all modes in any configuration: ω² is the sum of the forces' largest eigenvalues over m, damping 12
/// k_d/m (mass on a spring: k/m, k_d/m).
Mode any_configuration(const Preset& preset);
/// The modes that decide whether a method is stable in any configuration: the fastest, and in a damped cloth also modes
/// between stiffness and damping that are worse for some methods (docs/model.md, "What the shape decides").
std::vector<Mode> worst_modes(const Preset& preset);

/// The region of the eigenvalues of all modes in any configuration.
Spectrum any_spectrum(const Preset& preset);

/// Largest dt (s) at which no mode grows; 0 if there is none, infinity if no dt is too large or linear theory has no
/// limit (has_step_limit).
double dt_crit(const Scheme& scheme, std::span<const Mode> modes);
/// Factor by which all stiffness can grow before the method becomes unstable at dt; 0 if it is unstable at any
/// stiffness, infinity if at none. Where springs only stretch, this factor times k_s is the limit of k_s.
double stiffness_margin(const Scheme& scheme, std::span<const Mode> modes, double dt);
/// Growth per step in the long run, as a natural logarithm, of the fastest growing mode; below 0 all modes decay.
double growth_per_step(const Scheme& scheme, std::span<const Mode> modes, double dt);

// Linear stability of the explicit schemes, derived from their tables: the effect of one step on x'' = -ω² x - 2ζω x'.

/// A square matrix, row after row.
struct Matrix {
  int size = 0;
  std::vector<double> elements;
  double& at(int row, int column) { return elements[std::size_t(row) * size + column]; }
  double at(int row, int column) const { return elements[std::size_t(row) * size + column]; }
};

/// The matrix by which one step of dt = h/ω multiplies the scheme's state vectors, with ω = h and dt = 1: h = ω·dt, ζ
/// >= 0.
Matrix amplification(const Scheme& scheme, double h, double zeta);

/// The largest |eigenvalue|: growth per step in the long run. By repeated squaring (Gelfand's formula).
double spectral_radius(const Matrix& matrix);

/// The largest h = ω·dt up to which no step is unstable (spectral radius at most 1 up to rounding), within 1e-4 of
/// itself; 0 where even h = 1e-5 is, infinity where h = 20 is not.
double stability_limit(const Scheme& scheme, double zeta);

}  // namespace tyglab
