// Stabilized Runge-Kutta-Chebyshev methods: the number of stages that a step needs, and its maximum length.
#pragma once

#include <complex>
#include <cstddef>
#include <string>

#include "core/integrators/scheme.h"

namespace tyglab {

/// Where the eigenvalues λ of a linearized cloth lie, 1/s: real ones in [-radius, 0], complex ones in the disc
/// |λ + circle| <= circle, none with |λ| > radius. Of a mode with stiffness ω² and damping c, λ² + cλ + ω² = 0; where
/// ω² <= circle · c for all modes, complex pairs have |λ|² = ω² and Re λ = -c/2, thus |λ|² <= -2 circle Re λ.
struct Spectrum {
  double radius = 0;
  double circle = 0;   ///< infinity without damping
  double fastest = 0;  ///< ω of the fastest mode, which no complex eigenvalue exceeds in size
};

/// The longest stable step per stage, s, with such eigenvalues: the stages cover the real eigenvalues, and the complex
/// ones lie within the disc of stability or, if damping is weak, are so small that they hardly grow (|λ| h <= 0.5, by
/// 0.8 % a step at most). Infinity where there are none.
double longest_step(const Scheme& scheme, const Spectrum& spectrum);

/// Index of the table with the fewest stages that are stable for a step of h seconds. If no number of stages is stable
/// for the complex eigenvalues: index of the fewest stages that cover all sizes, or of the most.
std::size_t table_for(const Scheme& scheme, const Spectrum& spectrum, double h);

/// R(z) of the method of Runge, Kutta and Chebyshev of second order: a step takes y of y' = λy to R(λh) y.
std::complex<double> rkc2_growth(int stages, std::complex<double> z);

// Exponential decay with identical bits on every system.

/// The fractions that an exponential decay keeps and loses.
struct Decay {
  double kept = 1;  ///< e^-x
  double lost = 0;  ///< 1 - e^-x, with all its digits where x is small
};

/// The decay over x >= 0, the time divided by the time constant. Both shares are rounded correctly, but for ties within
/// 2^-80 of their values, by additions and multiplications alone: std::exp and std::expm1 differ in their last bit
/// between the C libraries of Linux, Windows and browsers.
Decay decay_over(double x);

// Generates docs/integrators.md from the table of methods.

/// The page, in Markdown.
std::string integrators_markdown();

}  // namespace tyglab
