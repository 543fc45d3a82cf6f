// Extended position-based dynamics: gravity and wind move the particles first, then the springs draw them back.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

namespace {

constexpr int q = 2;  // q: the displacement within the step

}  // namespace

Scheme xpbd() {
  using namespace rows;
  return {.name = "xpbd",
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
              R"(Gravity and wind alone take every particle to $\tilde x = x + dt\,v + dt^2 a_{ext}$. Then each )"
              R"(spring is a constraint $C = |x_{ij}| - \ell$ with the compliance $1/k$, and its multiplier )"
              R"($\lambda$ is improved iteratively, $\Delta\lambda = -(C + \alpha\lambda)/(w_i + w_j + \alpha)$ )"
              R"(with $\alpha = 1/(k\,dt^2)$ and $w = 1/m$ (0 for a pinned or held particle), each time moving )"
              R"(both ends along the spring by $w\,\Delta\lambda$. Stretch springs only pull and bending springs )"
              R"(only push because $\lambda$ is kept on its side: $\lambda \le 0$, $\lambda \ge 0$. Finally $v' = )"
              R"((x' - x)/dt$. At the fixed point $-\lambda/dt^2 = k\,C$, the force of the spring at the step's )"
              R"(end: with many iterations it is implicit Euler's step, except that springs turn between their )"
              R"(corrections, an error of $dt^4$ per step, and of $dt^2$ in a drape at rest. With few, )"
              R"(corrections spread slowly over the lattice and the cloth seems softer; smaller steps help more )"
              R"(than more iterations.

The order of the springs is fixed, so that any number of threads computes the same bits: in every row E of even )"
              R"(columns, of odd ones, bending in the row (columns 0, 1 of four, then 2, 3); S, SE and SW of even )"
              R"(rows; the same of odd rows; bending across rows (rows 0, 1 of four, then 2, 3). No two springs )"
              R"(of such a group share a particle.

Damping between constraints would not be $k_d$ of (2.6), which acts on slack springs and across the spring too. So )"
              R"(the velocities have a pass of their own, after contacts: each whole stretch spring, in the same )"
              R"(order, removes the fraction $1 - e^{-k_d (w_i + w_j) dt}$ of the relative velocity of its ends, )"
              R"(which is exact for a single spring, conserves momentum and can never overshoot. $F_{max}$ is )"
              R"(compared with $k_s C$ of the positions, as with every method, so it means the same newtons; so )"
              R"(is the force on the hand.)",
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
