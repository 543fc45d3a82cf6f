// Bounds of the eigenvalues that stabilized methods go by, against cloths as they stand.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "core/analysis/frequency.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::spectrum_test {

using Complex = std::complex<double>;

TEST_CASE("no eigenvalue of a cloth lies outside its bounds") {
  for (const double k_d : {0.002, 0.1})
    for (const double k_b : {0.0, 5.0}) {
      CAPTURE(k_d);
      CAPTURE(k_b);
      Preset preset = test::cloth(7, 8);
      preset.k_d = k_d, preset.k_b = k_b;
      Simulation simulation(preset);
      test::load(simulation, test::crumpled(preset, 5));
      const Spectrum bounds = any_spectrum(preset);
      for (const Mode& mode : extreme_modes(Linearisation(simulation), exact_tolerance)) {
        CHECK(mode.stiffness > 0);
        CHECK(mode.stiffness <= bounds.circle * mode.damping);
        const Complex root = std::sqrt(Complex(mode.damping * mode.damping / 4 - mode.stiffness));
        for (const Complex lambda : {-mode.damping / 2 + root, -mode.damping / 2 - root}) {
          CHECK(std::abs(lambda) <= bounds.radius * (1 + 1e-9));
          if (lambda.imag() != 0) CHECK(std::abs(lambda + bounds.circle) <= bounds.circle * (1 + 1e-9));
          if (lambda.imag() != 0) CHECK(std::abs(lambda) <= bounds.fastest);
        }
      }
    }
}

}  // namespace tyglab::spectrum_test
