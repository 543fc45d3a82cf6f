// Extended position-based dynamics: gravity and wind move the particles first, then the springs draw them back.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

using namespace rows;

namespace {

constexpr int q = 2;  // q: the displacement within the step

}  // namespace

Scheme xpbd() {
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
      .stability = "bounded at every dt; takes energy from all that swings, as implicit Euler, to which it converges",
      .cost = "gravity and wind, `iterations` passes over the springs, and one of damping",
      .formula = R"(Gravity and wind alone take every particle to $\tilde x = x + dt\,v + dt^2 a_{ext}$. Then each )"
                 R"(spring is a constraint $C = |x_{ij}| - \ell$ with the compliance $1/k$, and its multiplier )"
                 R"($\lambda$ is made better again and again, $\Delta\lambda = -(C + \alpha\lambda)/(w_i + w_j + )"
                 R"(\alpha)$ with $\alpha = 1/(k\,dt^2)$ and $w = 1/m$ (0 for a pinned or held particle), each time )"
                 R"(moving both ends along the spring by $w\,\Delta\lambda$. That a stretch spring only pulls and a )"
                 R"(bending spring only pushes is kept by keeping $\lambda$ on its side: $\lambda \le 0$, $\lambda )"
                 R"(\ge 0$. In the end $v' = (x' - x)/dt$. At the fixed point $-\lambda/dt^2 = k\,C$, the force of )"
                 R"(the spring at the step's end: with many iterations it is implicit Euler's step, but for how far )"
                 R"(springs turn while they wait for each other, an error of $dt^4$ a step, and of $dt^2$ in a )"
                 R"(drape at rest. With few, errors spread )"
                 R"(slowly over the lattice and the cloth seems softer; smaller steps help more than more iterations.

The order of the springs is fixed, so that any number of threads computes the same bits: in every row E of even )"
                 R"(columns, of odd ones, bending in the row (columns 0, 1 of four, then 2, 3); S, SE and SW of even )"
                 R"(rows; the same of odd rows; bending across rows (rows 0, 1 of four, then 2, 3). No two springs of )"
                 R"(such a group share a particle.

Damping between constraints would not be $k_d$ of (2.6), which acts on slack springs and across the spring too. )"
                 R"(So the velocities have a pass of their own, after contacts: each whole stretch spring, in the )"
                 R"(same order, takes from the relative velocity of its ends the part $1 - e^{-k_d (w_i + w_j) dt}$, )"
                 R"(which is exact for one spring alone, keeps momentum and can never overshoot. $F_{max}$ is held )"
                 R"(against $k_s C$ of the positions, as with every method, so it means the same newtons; so is what )"
                 R"(the hand feels.)",
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
      .lags = false};
}

}  // namespace tyglab
