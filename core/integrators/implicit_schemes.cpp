// The implicit methods, a row each.
#include <numbers>

#include "core/integrators/scheme_rows.h"

namespace tyglab {

namespace {

constexpr double gamma = 2 - std::numbers::sqrt2;  // of TR-BDF2, and the weights of its second stage
constexpr double bdf_stage = 1 / (gamma * (2 - gamma)), bdf_start = (1 - gamma) * (1 - gamma) / (gamma * (2 - gamma));

}  // namespace

std::vector<Scheme> implicit_schemes() {
  using namespace rows;
  return {
      {.name = "implicit_euler",
       .title = "Implicit Euler",
       .equation = "",
       .source =
           "D. Baraff, A. Witkin, SIGGRAPH 1998; here with Newton's method to the end, J. Nocedal, S. J. Wright, "
           "Numerical Optimization, 2nd ed. (2006), 7.1; stiff steps by an interior-point method, S. Mehrotra, SIAM "
           "J. Optim. 2, 575 (1992), with multigrid, U. Trottenberg, C. W. Oosterlee, A. Schüller, Multigrid (2001); "
           "compare T. Liu, S. Bouaziz, L. Kavan, ACM Trans. Graph. 36, 23 (2017)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Stable at every dt and k_s, since it removes energy: the larger dt, the more.",
       .stability = "stable at every dt (L-stable); removes energy from all oscillations",
       .cost =
           "one solve: a few steps of Newton's method, each a few dozen products with the stiffness; in stiff cloths "
           "10 to 30 steps of an interior-point method",
       .formula =
           R"($x' = x + dt\,v'$, $\;v' = v + dt\,a(x', v')$: the forces at the end of the step. An oscillation )"
           R"(shrinks by a factor of $1/\sqrt{1 + (\omega\,dt)^2}$ per step. Where $k_s dt^2/m \ge 10$ springs switch )"
           R"(so often that Newton's method would stall, in all implicit methods. Then each stretch spring gets a )"
           R"(tension $\lambda > 0$ and a slack $s > 0$ with $|x_{ij}| - L - \lambda/k_s + s = 0$ and $\lambda s )"
           R"(= \mu$, and $\mu$ goes to 0 by Mehrotra's predictor and corrector: Newton's method, which now meets )"
           R"(no switch. Its matrix resists with $k_s\lambda/(\lambda + k_s s)$ along a spring and )"
           R"($\lambda/|x_{ij}|$ across it; conjugate gradients solve with it, preconditioned by a V cycle of )"
           R"(multigrid with Galerkin's coarser operators. The threads of the CPU engine share the rows of these )"
           R"(systems where that pays; what a row depends on beyond a thread's own rows each thread computes too, and )"
           R"(sums are over all rows in their order, so that any number of threads computes the same bits.)",
       .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
       .start = {},
       .lag = 0},
      {.name = "implicit_midpoint",
       .title = "Implicit midpoint",
       .equation = "",
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. (2006), II.1",
       .order_undamped = 2,
       .order_damped = 2,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Second order, symplectic, stable at every dt while no spring switches; fast oscillations stay.",
       .stability = "symplectic, stable at every dt while no spring switches (A-stable)",
       .cost = "one solve",
       .formula = R"($x_m = x + \tfrac12 dt\,v_m$, $\;v_m = v + \tfrac12 dt\,a(x_m, v_m)$; $\;x' = 2x_m - x$, $\;v' )"
                  R"(= 2v_m - v$. No oscillation grows or shrinks; those too fast for $dt$ have the wrong frequency )"
                  R"(but keep their amplitude.)",
       .sweeps = {{2,
                   3,
                   0,
                   {{x, {{2, 2, 0}, {x, -1, 0}}}, {v, {{3, 2, 0}, {v, -1, 0}}}},
                   0.5,
                   {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
       .start = {},
       .lag = 0},
      // The trapezium to t + γ dt, then BDF2 over both points, γ = 2 - √2: both solve with γ/2.
      {.name = "tr_bdf2",
       .title = "TR-BDF2",
       .equation = "",
       .source = "R. E. Bank et al., IEEE Trans. Electron Devices 32, 1992 (1985); M. E. Hosea, L. F. Shampine, Appl. "
                 "Numer. Math. 20, 21 (1996)",
       .order_undamped = 2,
       .order_damped = 2,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Second order. Damps oscillations that dt does not resolve and keeps the others. Two solves.",
       .stability = "stable at every dt (L-stable); removes energy from what is too fast for dt",
       .cost = "two solves and one evaluation of the force",
       .formula =
           R"(The trapezium rule to $t + \gamma\,dt$, then the backward difference over the beginning, that point )"
           R"(and the end, with $\gamma = 2 - \sqrt2$, for which both solves have the same $\beta = \gamma/2$.)",
       .sweeps = {{x, v, 0, {{2, {{x, 1, 0}, {v, gamma / 2, 1}}}, {3, {{v, 1, 0}, {a, gamma / 2, 1}}}}},
                  {2,
                   3,
                   0,
                   {{2, {{2, bdf_stage, 0}, {x, -bdf_start, 0}}}, {3, {{3, bdf_stage, 0}, {v, -bdf_start, 0}}}},
                   gamma / 2,
                   {}},
                  {2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, gamma / 2, {}}},
       .start = {},
       .lag = 0},
  };
}

}  // namespace tyglab
