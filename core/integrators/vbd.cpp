// Vertex block descent: implicit Euler's equations, one particle at a time.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

Scheme vbd() {
  using namespace rows;
  return {
      .name = "vbd",
      .title = "Vertex block descent",
      .equation = "",
      .source = "A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, ACM Trans. Graph. 43, 116 (2024)",
      .order_undamped = 1,
      .order_damped = 1,
      .vectors = 4,
      .keeps_displacement = false,
      .note = "Implicit Euler's step particle by particle. Stable at every dt; few iterations slow stiff cloths down.",
      .stability = "no pass raises what implicit Euler makes least, wind aside; removes energy from all oscillations",
      .cost = "`iterations` passes over the particles, each about two evaluations of the force",
      .formula =
          R"(Implicit Euler's step makes an energy least ([model.md](model.md#integrators)). Each particle in turn )"
          R"(does so in its own three coordinates while all others rest: one step of Newton's method, )"
          R"(3 × 3, with the energy's gradient and a Hessian of $m/h^2 + k_d/h$ for each spring, $k_s$ along a pulling )"
          R"(spring and $k_s(1 - \ell/|x_{ij}|)$ across it, $k_b$ along a pushing bending spring. What a particle )"
          R"(finds the next one uses (Gauss and Seidel). It begins where inertia alone leads, and )"
          R"(`iterations` passes over all particles are made. Wind is that on the positions at the beginning of a )"
          R"(pass. The authors' acceleration by Chebyshev's method is left out.

The paper takes Newton's step as it is; here springs begin and cease to act on its way, and it may raise the energy. )"
          R"(Then the particle steps to the minimum of a quadratic function that is nowhere below the energy, with $k$ )"
          R"(of all of its springs in every direction. So no pass raises the energy, however stiff the springs.

*Colors:* particle $(i, j)$ has the color $(i + 2j) \bmod 5$. No spring, bending ones included, joins two particles )"
          R"(of one color, so a color's particles move at once: as vectors, and on all threads with the same bits.

In a pass news of a force travels a few springs, and a particle hardly moves between stiff springs whose other ends )"
          R"(rest. So few passes hold a large stiff cloth back, as if its particles were heavier: it falls and swings )"
          R"(too slowly. A step is compared with implicit Euler's equations: where `iterations` passes leave more than )"
          R"(it may leave, the step counts and is reported as unconverged.)",
      .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
      .start = {},
      .lag = 0,
      .solver = Solver::blocks};
}

}  // namespace tyglab
