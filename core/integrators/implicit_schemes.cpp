// The implicit methods, one row each.
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
           "D. Baraff, A. Witkin, SIGGRAPH 1998; here with Newton's method until it converges, "
           "J. Nocedal, S. J. Wright, "
           "Numerical Optimization, 2nd ed. (2006), 7.1; stiff steps by an interior-point method, S. Mehrotra, SIAM "
           "J. Optim. 2, 575 (1992), with multigrid, U. Trottenberg, C. W. Oosterlee, A. Schüller, Multigrid (2001); "
           "compare T. Liu, S. Bouaziz, L. Kavan, ACM Trans. Graph. 36, 23 (2017)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Stable at every dt and k_s. It removes energy, the more the larger dt is.",
       .stability = "stable at every dt (L-stable); removes energy from all oscillations",
       .cost = "one solve: a few steps of Newton's method, each with a few dozen products with the stiffness "
               "matrix; in stiff cloths 10 to 30 steps of an interior-point method",
       .formula =
           R"($x' = x + dt\,v'$, $\;v' = v + dt\,a(x', v')$. The step uses the forces at its end. An oscillation )"
           R"(shrinks by a factor of $1/\sqrt{1 + (\omega\,dt)^2}$ per step. If $k_s dt^2/m \ge 10$, springs switch )"
           R"(so often that Newton's method would stall; this holds for all implicit methods. Then each stretch )"
           R"(spring has a tension $\lambda > 0$ and a slack $s > 0$ with $|x_{ij}| - L - \lambda/k_s + s = 0$ and )"
           R"($\lambda s = \mu$. Mehrotra's predictor-corrector, a form of Newton's method without switches, reduces )"
           R"($\mu$ to 0. Its matrix has the stiffness $k_s\lambda/(\lambda + k_s s)$ along a spring and )"
           R"($\lambda/|x_{ij}|$ across it. Conjugate gradients solve the linear systems, preconditioned by a )"
           R"(V-cycle of multigrid with Galerkin coarse operators. Where that pays, the threads of the CPU engine )"
           R"(divide the rows of these systems. Each thread also computes the values of neighboring rows that it )"
           R"(needs, and sums run over all rows in order, so the bits are identical for any number of threads.)",
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
       .note = "Second order, symplectic, stable at every dt while no spring switches; fast oscillations remain.",
       .stability = "symplectic, stable at every dt while no spring switches (A-stable)",
       .cost = "one solve",
       .formula =
           R"($x_m = x + \tfrac12 dt\,v_m$, $\;v_m = v + \tfrac12 dt\,a(x_m, v_m)$; $\;x' = 2x_m - x$, $\;v' = 2v_m )"
           R"(- v$. No oscillation grows or shrinks. Oscillations that are too fast for $dt$ have the wrong )"
           R"(frequency but keep their amplitude.)",
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
       .stability = "stable at every dt (L-stable); removes energy from oscillations that are too fast for dt",
       .cost = "two solves and one evaluation of the force",
       .formula =
           R"(The trapezoidal rule advances to $t + \gamma\,dt$; then the backward difference over the beginning, )"
           R"(this point and the end completes the step. With $\gamma = 2 - \sqrt2$ both solves have $\beta = )"
           R"(\gamma/2$.)",
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
