// Verlet's method with the damping taken implicitly.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

Scheme damped_verlet() {
  using namespace rows;
  constexpr int slope = 2;  // a, and then what the damping leaves of it
  return {
      .name = "damped_verlet",
      .title = "Verlet, damping implicit",
      .equation = "",
      .source =
          "N. M. Newmark, J. Eng. Mech. Div. ASCE 85, 67 (1959), with β = 0, γ = ½; T. J. R. Hughes, The Finite "
          "Element Method (1987), 9.1; the linear system by Chebyshev's iteration, Y. Saad, Iterative "
          "Methods for Sparse Linear Systems, 2nd ed. (2003), 12.3",
      .order_undamped = 2,
      .order_damped = 2,
      .vectors = 3,
      .keeps_displacement = false,
      .note = "Second order with damping too, and stable as Verlet is without damping, however strong the damping.",
      .stability = "stable up to hω = 2, whatever the damping; symplectic without it",
      .cost =
          "one evaluation of the force and the products of one linear system with the constant matrix of the damping",
      .formula =
          R"(Verlet's step with the mean of two velocities in the damping: $h' = h + dt\,(f(x) - C\,\tfrac12(h + h'))$, )"
          R"($\;x' = x + dt\,h'$, where $h$ is the velocity between two steps, $f$ all of $a$ but the damping, and )"
          R"($-C v$ the damping, $k_d/m$ times the differences along all whole stretch springs. The unknown is )"
          R"($s = (h' - h)/dt$, with $(1 + \tfrac12 dt\,C)\,s = a(x, h)$: one evaluation of the force at what is )"
          R"(known, and one linear system whose matrix depends on neither positions nor velocities. The velocity )"
          R"(at the position is $h + \tfrac12 dt\,s$. With $dt \to -dt$ and $C \to -C$ a step is undone; without )"
          R"(damping it is Verlet's own, reversible and symplectic, and its energy does not drift. With damping )"
          R"(energy only falls, as in the motion itself: by $dt\,\bar v^T C \bar v\,m$ a step, $\bar v = )"
          R"(\tfrac12(h + h')$. Motions with $c\,dt \gg 2$ have $\xi \to -1$: a jolt leaves velocities that change their )"
          R"(sign in every step and fade slowly, where the true ones are gone at once; implicit Euler and TR-BDF2 remove them.

*Why the damping sets no limit:* a mode with the frequency $\omega$ and the damping $c$ obeys $(1 + \tfrac12 c\,dt)\,\xi^2 )"
          R"(- (2 - \omega^2 dt^2)\,\xi + (1 - \tfrac12 c\,dt) = 0$, both of whose roots have $|\xi| \le 1$ exactly )"
          R"(where $\omega\,dt \le 2$. That damping and stiffness have different modes changes nothing, since $\omega^2$ )"
          R"(and $c$ may be taken as the Rayleigh quotients of the growing motion itself.

*The linear system.* The eigenvalues of its matrix lie between 1 and $\kappa = 1 + 6\,dt\,k_d/m$, with tears and pins )"
          R"(too, so Chebyshev's iteration needs nothing but these bounds: no sums over the cloth, the same number of )"
          R"(products whatever the motion, no factors that would fill memory (one of a band of a 4096 × 4096 cloth )"
          R"(would hold $7 \cdot 10^{10}$ numbers), and the same bits for any number of threads. Two equal rounds of )"
          R"($n$ products leave the residual polynomial $(T_n(\cdot)/T_n(\cdot))^2 \ge 0$: what is solved for can )"
          R"(only be smaller than the solution in any mode, as if particles were heavier there, which never makes )"
          R"(the step less stable. $n$ is what makes the rest at most $10^{-6}$ in float and $10^{-12}$ in double )"
          R"((16 and 32 products at $\kappa = 5$), but at most 500; a step in which that leaves more is counted and reported as )"
          R"(unconverged.)",
      .sweeps = {{.position = x, .velocity = v, .velocity_dt_power = 0, .assignments = {{slope, {{a, 1, 0}}}}},
                 {.position = x,
                  .velocity = slope,
                  .velocity_dt_power = 0,
                  .assignments = {{v, {{v, 1, 0}, {slope, 1, 1}}}, {x, {{x, 1, 0}, {v, 1, 1}}}},
                  .damps = 0.5}},
      .start = {{v, {{v, 1, 0}, {a, -0.5, 1}}}},
      .lag = 0.5};
}

}  // namespace tyglab
