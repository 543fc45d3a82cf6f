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
          "apart from wind, no pass increases the energy that implicit Euler's step minimizes; removes energy from all "
          "oscillations where the passes nearly converge, and may add some where they do not",
      .cost = "`iterations` passes over the particles, each about two evaluations of the force",
      .formula =
          R"(Implicit Euler's step minimizes an energy ([model.md](model.md#integrators)). Each particle in turn )"
          R"(minimizes it in its own three coordinates while all others stay fixed, by one 3 × 3 Newton step. This )"
          R"(step uses the gradient of the energy and a Hessian with $m/h^2$, $k_d/h$ for each spring, $k_s$ along )"
          R"(a pulling spring and $k_s(1 - \ell/|x_{ij}|)$ across it, and $k_b$ along a pushing bending spring. )"
          R"(Each particle uses the new positions of the particles before it (Gauss-Seidel). A step consists of )"
          R"(`iterations` passes over all particles. The first starts from $x + h\,v$, where inertia alone leads, )"
          R"(plus a fall. Wind is computed from the positions at the beginning of a pass. The authors' Chebyshev )"
          R"(acceleration is left out.

*The fall:* a particle between fixed neighbors hardly falls, so passes alone would slow down even a free fall. )"
          R"(Before the first pass, therefore, the free particles of each piece of the cloth fall together by $s\,g )"
          R"(h^2$, where bisection of the slope of the energy finds $0 \le s \le 1$ to a thousandth. Only springs )"
          R"(to fixed particles count, since the piece moves as a whole: $s = 1$ if nothing holds the piece, and $s )"
          R"(= 0$ if it hangs at rest. (In the paper each particle starts with the share of gravity that its )"
          R"(acceleration had in the last step; here this acceleration is not part of the state.)

The paper always uses Newton's step. Here springs start and stop acting along it, so it may increase the energy. )"
          R"(In that case the particle moves to the minimum of a quadratic function that is nowhere below the )"
          R"(energy, with $k$ of all of its springs in every direction. So no pass increases the energy, however )"
          R"(stiff the springs are.

*Colors:* particle $(i, j)$ has the color $(i + 2j) \bmod 5$. No stretch or bending spring connects two )"
          R"(particles of one color, so the particles of a color move simultaneously: as vectors, and on all )"
          R"(threads, with identical bits.

In one pass the effect of a force spreads over only a few springs, and a particle hardly moves between springs )"
          R"(whose other ends are fixed. With few passes a cloth therefore moves as if its particles were heavier: )"
          R"(it swings and unfolds too slowly, the more so the larger $dt$ is. After the last pass, the step is )"
          R"(compared with implicit Euler's equations; if the residual exceeds the tolerance, the step is reported )"
          R"(as unconverged.

The passes only guarantee that the energy does not rise above its value where they began. If springs are far too )"
          R"(long there, a few passes may leave more energy than the cloth had before the step, and such steps can )"
          R"(add up: with `iterations` = 1 a stiff, undamped cloth may diverge.)",
      .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
      .start = {},
      .lag = 0,
      .solver = Solver::blocks};
}

}  // namespace tyglab
