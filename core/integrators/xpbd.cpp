// Extended position-based dynamics: gravity and wind move the particles, and then the springs pull them back.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

namespace {

constexpr int q = 2;  // q: the displacement within the step

}  // namespace

Scheme xpbd() {
  using namespace rows;
  return {
      .name = "xpbd",
      .title = "XPBD",
      .equation = "",
      .source =
          "M. Macklin, M. Müller, N. Chentanez, Motion in Games 2016; small steps as in M. Macklin et al., "
          "SCA 2019",
      .order_undamped = 1,
      .order_damped = 1,
      .vectors = 3,
      .keeps_displacement = false,
      .note = "First order, stable at every dt. Few iterations make the cloth softer than its springs.",
      .stability =
          "bounded at every dt; removes energy from all oscillations, like implicit Euler, to which it converges",
      .cost = "gravity and wind, `iterations` passes over the springs, and one of damping",
      .formula =
          R"(Gravity and wind alone move every particle to $\tilde x = x + dt\,v + dt^2 a_{ext}$. Then each spring )"
          R"(is a constraint $C = |x_{ij}| - \ell$ with the compliance $1/k$, and an iteration improves its )"
          R"(multiplier $\lambda$, $\Delta\lambda = -(C + \alpha\lambda)/(w_i + w_j + \alpha)$ with $\alpha = )"
          R"(1/(k\,dt^2)$ and $w = 1/m$ (0 for a pinned or held particle), and moves both ends along the spring by )"
          R"($w\,\Delta\lambda$. Limiting $\lambda$ to one sign lets stretch springs only pull ($\lambda \le 0$) )"
          R"(and bending springs only push ($\lambda \ge 0$). Finally $v' = (x' - x)/dt$. At the fixed point )"
          R"($-\lambda/dt^2 = k\,C$, the force of the spring at the step's end: with many iterations the method )"
          R"(makes implicit Euler's step, except that springs rotate between their corrections, which adds an error )"
          R"(of $dt^4$ per step, and of $dt^2$ in a drape at rest. With few iterations, corrections spread slowly )"
          R"(over the lattice and the cloth seems softer; smaller steps help more than more iterations.

The order of the springs is fixed, so the bits are identical for any number of threads. In every row, springs to )"
          R"(the east from even columns come first, then those from odd columns, then bending springs in the row )"
          R"((columns 0, 1 of four, then 2, 3); then S, SE and SW from even rows; then S, SE and SW from odd rows; )"
          R"(then bending springs across rows (rows 0, 1 of four, then 2, 3). No two springs of such a group share )"
          R"(a particle.

Damping between constraints would not be the $k_d$ of (2.6), which also acts on slack springs and across the )"
          R"(spring. So a separate pass over the velocities follows the contacts: each intact stretch spring, in )"
          R"(this order, removes the fraction $1 - e^{-k_d (w_i + w_j) dt}$ of the relative velocity of its ends, )"
          R"(which is exact for a single spring, conserves momentum and cannot overshoot. As with every method, )"
          R"($F_{max}$ is compared with $k_s C$ computed from the positions, so its unit is the newton; the force )"
          R"(on the hand is computed in this way too.)",
      .sweeps = {{.position = x,
                  .velocity = v,
                  .velocity_dt_power = 0,
                  .assignments = {{q, {{v, 1, 1}, {a, 1, 2}}}},
                  .external = true},
                 {.position = x,
                  .velocity = q,
                  .velocity_dt_power = 0,
                  .assignments = {{v, {{q, 1, -1}}}, {x, {{x, 1, 0}, {q, 1, 0}}}},
                  .projects = true}},
      .start = {},
      .lag = 0};
}

}  // namespace tyglab
