// Verlet's method with implicit damping.
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
      .note = "Second order, also with damping. As stable as undamped Verlet, however strong the damping is.",
      .stability = "stable up to hω = 2, whatever the damping; symplectic without it",
      .cost = "one evaluation of the force and one linear system with the constant matrix of the damping",
      .formula =
          R"(This is Verlet's step with the mean of two velocities in the damping: $h' = h + dt\,(f(x) - )"
          R"(C\,\tfrac12(h + h'))$, $\;x' = x + dt\,h'$, where $h$ is the velocity between two steps, $f$ is $a$ )"
          R"(without the damping, and $-C v$ is the damping, $k_d/m$ times the velocity differences along all )"
          R"(intact stretch springs. The unknown is $s = (h' - h)/dt$, with $(1 + \tfrac12 dt\,C)\,s = a(x, h)$. A )"
          R"(step thus needs one evaluation of the force at known values and one linear system whose matrix depends )"
          R"(on neither positions nor velocities. The velocity at the time of the position is $h + \tfrac12 dt\,s$. )"
          R"(The step is undone by $dt \to -dt$ and $C \to -C$; without damping it is Verlet's step, reversible and )"
          R"(symplectic, with an energy that does not drift. With damping, energy only decreases, as in the exact )"
          R"(motion: by $dt\,\bar v^T C \bar v\,m$ per step, $\bar v = \tfrac12(h + h')$. Motions with $c\,dt \gg )"
          R"(2$ have $\xi \to -1$: after a jolt, velocities change sign in every step and fade slowly, whereas the )"
          R"(exact velocities vanish at once. Implicit Euler and TR-BDF2 remove them.

*Why the damping sets no limit:* a mode with the frequency $\omega$ and the damping $c$ obeys $(1 + \tfrac12 )"
          R"(c\,dt)\,\xi^2 - (2 - \omega^2 dt^2)\,\xi + (1 - \tfrac12 c\,dt) = 0$, and both of its roots have )"
          R"($|\xi| \le 1$ exactly if $\omega\,dt \le 2$. It makes no difference that damping and stiffness have )"
          R"(different modes, since $\omega^2$ and $c$ can be the Rayleigh quotients of the growing motion itself.

*The linear system.* The eigenvalues of its matrix lie between 1 and $\kappa = 1 + 6\,dt\,k_d/m$, also )"
          R"(with tears and pins, and Chebyshev iteration needs only these bounds. It computes no sums over the )"
          R"(cloth, makes a number of products that does not depend on the motion, needs no factor (that )"
          R"(of a 4096 × 4096 cloth would have $7 \cdot 10^{10}$ numbers), and gives identical bits for any number )"
          R"(of threads. Two equal rounds of $n$ products leave the residual polynomial $(T_n(\cdot)/T_n(\cdot))^2 )"
          R"(\ge 0$. In every mode the computed $s$ can therefore only be smaller than the solution, as if the )"
          R"(particles were heavier, which never makes the step less stable. $n$ is chosen so that the residual is )"
          R"(at most $10^{-6}$ in float and $10^{-12}$ in double (16 and 32 products at $\kappa = 5$), but is at )"
          R"(most 500. Where 500 do not suffice, the matrix is factorized as a band, in double, if that takes no )"
          R"(more than $5 \cdot 10^8$ multiplications (up to 125 × 125 particles); it is factorized again only after )"
          R"(a change of $k_d$, $m$, $dt$, pins, hand or tears. In larger cloths $s$ is then too small; steps that )"
          R"(lack more than $10^{-6}$ of $s$ ($10^{-4}$ in float) are reported as unconverged. The mean of $a$ over )"
          R"(each piece that nothing holds has the eigenvalue 1; where 500 products do not suffice, it is taken from )"
          R"(the right-hand side before the solution and added to its result, so no common motion is slowed.)",
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
