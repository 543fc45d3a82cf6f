// Projective dynamics: implicit Euler's equations by alternating local and global steps.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

Scheme projective_dynamics() {
  using namespace rows;
  return {
      .name = "projective_dynamics",
      .title = "Projective dynamics",
      .equation = "",
      .source =
          "S. Bouaziz, S. Martin, T. Liu, L. Kavan, M. Pauly, ACM Trans. Graph. 33, 154 (2014); for springs T. Liu, "
          "A. W. Bargteil, J. F. O'Brien, L. Kavan, ACM Trans. Graph. 32, 214 (2013)",
      .order_undamped = 1,
      .order_damped = 1,
      .vectors = 4,
      .keeps_displacement = false,
      .note = "Implicit Euler's step by cheap passes. Few iterations slow stiff cloths down, and may add energy.",
      .stability =
          "apart from wind, no pass increases the energy that implicit Euler's step minimizes; removes energy from all "
          "oscillations where the passes nearly converge, and may add some where they do not",
      .cost = "`iterations` evaluations of the force, each with one linear system whose matrix is constant",
      .formula =
          R"(Implicit Euler's step minimizes an energy ([model.md](model.md#integrators)). The share of a stretch )"
          R"(spring, $\tfrac12 k_s \max(|x_{ij}| - \ell, 0)^2$, equals $\min \tfrac12 k_s |x_{ij} - p|^2$ over all )"
          R"(vectors $p$ with $|p| \le \ell$; for a bending spring, over $|p| \ge \ell$. *Local step:* with $x$ )"
          R"(fixed, each spring chooses its nearest $p$, which is $x_{ij}$ itself if the spring exerts no force and )"
          R"($\ell\,x_{ij}/|x_{ij}|$ if it does. *Global step:* with all $p$ fixed, the energy is quadratic in $x$, )"
          R"(and one linear system minimizes it, $(1 + h^2/m\,(k_s L_s + k_b L_b) + h\,k_d/m\,L_s)\,x = \dots$, )"
          R"(where $L_s$ and $L_b$ are the graph Laplacians of the springs. Damping by $k_d$ is linear in $v$, so )"
          R"(it belongs to the matrix; gravity and wind are on the right-hand side, with the wind computed from the )"
          R"(positions after the last pass. A step consists of `iterations` such passes.

One matrix serves x, y and z, and the motion does not change it. For small cloths (up to about 180 × 180 )"
          R"(particles) it is factorized, if that is faster than products with the matrix, and the factors are used )"
          R"(until a constant, $dt$, a tear, a cut, a pin or the hand changes it. Otherwise Chebyshev iteration )"
          R"(solves the system to $10^{-3}$ with a fixed number of products; its error can only make a pass )"
          R"(shorter.

In terms of the residual $r$ of implicit Euler's equations a pass is $A\,s = r$, $v \leftarrow v + s$: Newton's )"
          R"(method with a constant matrix that is at least as stiff as the true one. So no pass increases the )"
          R"(energy, and the passes converge to implicit Euler's step. But where springs are slack or rotate, the )"
          R"(true matrix is much softer than $A$, and passes are short. With few passes a stiff cloth moves as if )"
          R"(its particles were heavier: it falls and swings too slowly. After the last pass, the step is compared )"
          R"(with implicit Euler's equations; if the residual exceeds the tolerance, the step is reported as )"
          R"(unconverged. The passes only guarantee that the energy does not rise above its value where they began, )"
          R"(so with few passes it may exceed the energy that the cloth had before the step.)",
      .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
      .start = {},
      .lag = 0,
      .solver = Solver::alternation};
}

}  // namespace tyglab
