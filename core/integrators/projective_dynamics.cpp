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
          "no pass raises the energy that implicit Euler's step minimizes, wind aside; removes energy from all "
          "oscillations where the passes nearly converge, and may add some where they do not",
      .cost = "`iterations` evaluations of the force, each with one linear system whose matrix is constant",
      .formula =
          R"(Implicit Euler's step minimizes an energy ([model.md](model.md#integrators)). A stretch spring's part )"
          R"(of it, $\tfrac12 k_s \max(|x_{ij}| - \ell, 0)^2$, is $\min \tfrac12 k_s |x_{ij} - p|^2$ over all vectors )"
          R"($p$ with $|p| \le \ell$, and a bending spring's the same over $|p| \ge \ell$. *Local step:* with $x$ held, )"
          R"(each spring takes its nearest $p$, which is $x_{ij}$ itself where the spring is at rest and )"
          R"($\ell\,x_{ij}/|x_{ij}|$ where it acts. *Global step:* with all $p$ held, the energy is quadratic in $x$ )"
          R"(and is made least by one linear system, $(1 + h^2/m\,(k_s L_s + k_b L_b) + h\,k_d/m\,L_s)\,x = \dots$, )"
          R"(where $L_s$ and $L_b$ are the graph Laplacians of the springs. Damping by $k_d$ is linear in $v$, so it )"
          R"(belongs to the matrix; gravity and wind stand on the right-hand side, wind as the last pass's positions )"
          R"(give it. `iterations` such passes are made.

The matrix is the same for x, y and z, and no motion changes it. It is factorized once, for as long as no )"
          R"(constant, $dt$, tear, cut, pin or hand changes it, if the cloth is small (up to about 180 × 180 particles) )"
          R"(and that is quicker than products with the matrix; otherwise Chebyshev's iteration solves the system to $10^{-3}$ with a fixed )"
          R"(number of products, and what it leaves can only make a pass shorter.

In terms of the residual $r$ of implicit Euler's equations a pass is $A\,s = r$, $v \leftarrow v + s$: Newton's )"
          R"(method with a constant matrix that is at least as stiff as the true one. So no pass raises the energy, )"
          R"(and the passes lead to implicit Euler's step; but where springs are slack or turn, the true matrix is much )"
          R"(softer than $A$, and passes are short. With few of them a stiff cloth is held back, as if its particles )"
          R"(were heavier: it falls and swings too slowly. A step is compared with implicit Euler's equations: if )"
          R"(`iterations` passes leave more than the tolerance allows, the step is reported as unconverged. What no )"
          R"(pass raises is its value where the passes began, so few passes may leave more energy than the cloth had )"
          R"(before the step.)",
      .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
      .start = {},
      .lag = 0,
      .solver = Solver::alternation};
}

}  // namespace tyglab
