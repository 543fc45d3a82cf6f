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
      .note = "Implicit Euler's step particle by particle. Few iterations slow stiff cloths down, and may add energy.",
      .stability =
          "no pass raises the energy that implicit Euler's step minimizes, wind aside; removes energy from all "
          "oscillations where the passes nearly converge, and may add some where they do not",
      .cost = "`iterations` passes over the particles, each about two evaluations of the force",
      .formula =
          R"(Implicit Euler's step minimizes an energy ([model.md](model.md#integrators)). Each particle in turn )"
          R"(does so in its own three coordinates while all others rest: one step of Newton's method, )"
          R"(3 × 3, with the energy's gradient and a Hessian of $m/h^2 + k_d/h$ for each spring, $k_s$ along a pulling )"
          R"(spring and $k_s(1 - \ell/|x_{ij}|)$ across it, $k_b$ along a pushing bending spring. What one particle )"
          R"(finds, the next uses (Gauss and Seidel). `iterations` passes over all particles are made, the first from )"
          R"($x + h\,v$, where inertia alone leads, and a fall from there. Wind is that on the positions at the beginning )"
          R"(of a pass. The authors' acceleration by Chebyshev's method is left out.

*The fall:* a particle between others that rest hardly falls, so passes alone would hold back even what falls )"
          R"(freely. Before the first pass, therefore, each piece of the cloth, its free particles together, falls by )"
          R"($s\,g h^2$, where $0 \le s \le 1$ is found to a thousandth by bisection of the energy's slope. Only springs )"
          R"(to fixed particles count there, since the piece moves as a whole: $s = 1$ where nothing holds it, and )"
          R"($s = 0$ where it hangs at rest. (In the paper each particle begins with as much of gravity as its )"
          R"(acceleration in the last step had; that acceleration is no part of the state here.)

The paper takes Newton's step as it is; here springs begin and cease to act on its way, and it may raise the energy. )"
          R"(Then the particle steps to the minimum of a quadratic function that is nowhere below the energy, with $k$ )"
          R"(of all of its springs in every direction. So no pass raises the energy, however stiff the springs.

*Colors:* particle $(i, j)$ has the color $(i + 2j) \bmod 5$. No spring, bending ones included, joins two particles )"
          R"(of one color, so a color's particles move at once: as vectors, and on all threads with the same bits.

In one pass, news of a force travels only a few springs, and a particle hardly moves between springs whose other )"
          R"(ends rest. With few passes a cloth is therefore held back, as if its particles were heavier: it swings )"
          R"(and unfolds too slowly, the more so the larger $dt$ is. A step is compared with implicit Euler's equations: )"
          R"(if `iterations` passes leave more than the tolerance allows, the step is reported as unconverged.

What no pass raises is its value where the passes began. Where springs are far too long there, few passes may leave )"
          R"(more energy than the cloth had before the step, and such steps can add up: with `iterations` = 1 a stiff, )"
          R"(undamped cloth may diverge.)",
      .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
      .start = {},
      .lag = 0,
      .solver = Solver::blocks};
}

}  // namespace tyglab
