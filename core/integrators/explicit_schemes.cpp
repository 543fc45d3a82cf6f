// The explicit methods of fixed dt, one row each.
#include "core/integrators/scheme_rows.h"

namespace tyglab {

std::vector<Scheme> explicit_schemes() {
  using namespace rows;
  return {
      {.name = "euler",
       .title = "Euler",
       .equation = "2.10",
       .source = "L. Euler, Institutiones calculi integralis, 1768; the report's (2.10)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note = "First order. Adds energy to every oscillation; stable only with enough damping.",
       .stability = "grows at every dt without damping; with it stable up to hω = 2ζ",
       .cost = "one evaluation of the force",
       .formula =
           R"($x' = x + dt\,v$, $\;v' = v + dt\,a(x, v)$. Both lines use only the state at the beginning of the )"
           R"(step, so every oscillation grows by a factor of $\sqrt{1 + (\omega\,dt)^2}$ per step. This is the )"
           R"(report's example of a method to avoid, and it is worth watching.)",
       .sweeps = {{x, v, 0, {{x, {{x, 1, 0}, {v, 1, 1}}}, {v, {{v, 1, 0}, {a, 1, 1}}}}}},
       .start = {},
       .lag = 0},
      {.name = "improved_euler",
       .title = "Improved Euler",
       .equation = "2.11",
       .source = "the report's (2.11)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note =
           "A Taylor expansion of the position; its velocity is first order, and so is the method. It is not Heun's "
           "method, which other texts call improved Euler.",
       .stability = "grows at every dt without damping, more slowly than Euler",
       .cost = "one evaluation of the force",
       .formula =
           R"($x' = x + dt\,v + \tfrac12 dt^2 a(x, v)$, $\;v' = v + dt\,a(x, v)$. The position is expanded to second )"
           R"(order but the velocity only to first order, and the less accurate of the two determines the order of )"
           R"(the method. An oscillation grows by a factor of $\sqrt{1 + (\omega\,dt)^2/2}$ per step.)",
       .sweeps = {{x, v, 0, {{x, {{x, 1, 0}, {v, 1, 1}, {a, 0.5, 2}}}, {v, {{v, 1, 0}, {a, 1, 1}}}}}},
       .start = {},
       .lag = 0},
      // Stores d[n] = x[n] - x[n-1]: x[n+1] = 2x[n] - x[n-1] + dt² a would lose a float's last digits in every step.
      {.name = "verlet",
       .title = "Verlet",
       .equation = "2.15",
       .source = "L. Verlet, Phys. Rev. 159, 98 (1967); the report's (2.15)",
       .order_undamped = 2,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = true,
       .note = "Second order without damping; first order with it, since damping uses the velocity of half a step ago.",
       .stability = "symplectic; stable up to hω = 2 without damping, 2(√(1 + ζ²) − ζ) with it",
       .cost = "one evaluation of the force",
       .formula =
           R"($d' = d + dt^2\,a(x, d/dt)$, $\;x' = x + d'$, starting with $d = dt\,v - \tfrac12 dt^2 a$. The method )"
           R"(stores $d$ and never computes $2x - x_{old}$, which in float would lose the last digits in every step. )"
           R"(Damping uses the velocity of half a step ago, which reduces the order to 1. The energy fluctuates but )"
           R"(does not drift while no spring switches.)",
       .sweeps = {{x, v, -1, {{v, {{v, 1, 0}, {a, 1, 2}}}, {x, {{x, 1, 0}, {v, 1, 0}}}}}},
       .start = {{v, {{v, 1, 1}, {a, -0.5, 2}}}},
       .lag = 0.5},
      {.name = "semi_implicit_euler",
       .title = "Semi-implicit Euler",
       .equation = "",
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. (2006), I.1.2",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note = "Verlet's recurrence with a simpler start: first order, and as stable as Verlet.",
       .stability = "symplectic; as stable as Verlet",
       .cost = "one evaluation of the force",
       .formula =
           R"($v' = v + dt\,a(x, v)$, $\;x' = x + dt\,v'$. This is Verlet's recurrence, read as an Euler step that )"
           R"(uses its new velocity at once. The velocity that it reports belongs to half a step earlier; this is )"
           R"(its first-order error.)",
       .sweeps = {{x, v, 0, {{v, {{v, 1, 0}, {a, 1, 1}}}, {x, {{x, 1, 0}, {v, 1, 1}}}}}},
       .start = {},
       .lag = 0},
      // Vector 1 is v half a step ago. Vector 2 is v + dt a of the previous step, a second-order prediction that
      // damping uses, so one evaluation per step is enough.
      {.name = "velocity_verlet",
       .title = "Velocity Verlet",
       .equation = "",
       .source =
           "W. C. Swope et al., J. Chem. Phys. 76, 637 (1982); predicted velocity as in R. D. Groot, P. B. Warren, "
           "J. Chem. Phys. 107, 4423 (1997), with λ = 1",
       .order_undamped = 2,
       .order_damped = 2,
       .vectors = 3,
       .keeps_displacement = false,
       .note = "Second order, also with damping, which uses a predicted velocity. One evaluation per step.",
       .stability = "symplectic without damping; stable up to hω = 2, less with damping",
       .cost = "one evaluation of the force",
       .formula =
           R"($h' = h + dt\,a(x, p)$, $\;x' = x + dt\,h'$, $\;p' = h' + \tfrac12 dt\,a(x, p)$: $h$ is the velocity )"
           R"(between two steps, and $p$ is a prediction of the velocity at the end of the step. Damping uses $p$, )"
           R"(whose error is only $O(dt^2)$, so it does not reduce the order.)",
       .sweeps = {{x, 2, 0, {{v, {{v, 1, 0}, {a, 1, 1}}}, {x, {{x, 1, 0}, {v, 1, 1}}}, {2, {{v, 1, 0}, {a, 0.5, 1}}}}}},
       .start = {{2, {{v, 1, 0}}}, {v, {{v, 1, 0}, {a, -0.5, 1}}}},
       .lag = 0.5},
      // Vectors 2 and 3 gather the result, 4 and 5 hold the stage.
      {.name = "rk4",
       .title = "Runge-Kutta 4",
       .equation = "",
       .source = "W. Kutta, Z. Math. Phys. 46, 435 (1901)",
       .order_undamped = 4,
       .order_damped = 4,
       .vectors = 6,
       .keeps_displacement = false,
       .note = "Fourth order while no spring switches. Four evaluations per step; loses a little energy.",
       .stability = "stable up to hω = 2√2; removes energy: (hω)⁶/144 of the amplitude per step",
       .cost = "four evaluations of the force",
       .formula =
           R"(The method combines four slopes of $y = (x, v)$, one at the beginning of the step, two in the middle )"
           R"(and one at the end: $y' = y + \tfrac{dt}{6}(k_1 + 2k_2 + 2k_3 + k_4)$.)",
       .sweeps = {{x,
                   v,
                   0,
                   {{2, {{x, 1, 0}, {v, 1.0 / 6, 1}}},
                    {3, {{v, 1, 0}, {a, 1.0 / 6, 1}}},
                    {4, {{x, 1, 0}, {v, 0.5, 1}}},
                    {5, {{v, 1, 0}, {a, 0.5, 1}}}}},
                  {4,
                   5,
                   0,
                   {{2, {{2, 1, 0}, {5, 1.0 / 3, 1}}},
                    {3, {{3, 1, 0}, {a, 1.0 / 3, 1}}},
                    {4, {{x, 1, 0}, {5, 0.5, 1}}},
                    {5, {{v, 1, 0}, {a, 0.5, 1}}}}},
                  {4,
                   5,
                   0,
                   {{2, {{2, 1, 0}, {5, 1.0 / 3, 1}}},
                    {3, {{3, 1, 0}, {a, 1.0 / 3, 1}}},
                    {4, {{x, 1, 0}, {5, 1, 1}}},
                    {5, {{v, 1, 0}, {a, 1, 1}}}}},
                  {4, 5, 0, {{x, {{2, 1, 0}, {5, 1.0 / 6, 1}}}, {v, {{3, 1, 0}, {a, 1.0 / 6, 1}}}}}},
       .start = {},
       .lag = 0},
      // Vectors 2 and 3 gather the result, 4 and 5 hold the stage.
      {.name = "rkn4",
       .title = "Nyström 4",
       .equation = "",
       .source = "E. J. Nyström, Acta Soc. Sci. Fenn. 50, no. 13 (1925); Hairer, Nørsett, Wanner, Solving Ordinary "
                 "Differential Equations I, II.14",
       .order_undamped = 4,
       .order_damped = 2,
       .vectors = 6,
       .keeps_displacement = false,
       .note = "Fourth order without damping for three evaluations per step, while no spring switches; second with it.",
       .stability = "stable up to hω = 2.59 without damping",
       .cost = "three evaluations of the force",
       .formula =
           R"(This is the idea of Runge-Kutta methods, applied to $\ddot x = a(x)$ directly: with $a_1 = a(x)$, $a_2 )"
           R"(= a(x + \tfrac12 dt\,v + \tfrac18 dt^2 a_1)$, $a_3 = a(x + dt\,v + \tfrac12 dt^2 a_2)$ a step is $x' = )"
           R"(x + dt\,v + \tfrac16 dt^2 (a_1 + 2 a_2)$, $v' = v + \tfrac16 dt\,(a_1 + 4 a_2 + a_3)$. At the stages, )"
           R"(damping uses a first-order velocity.)",
       .sweeps = {{x,
                   v,
                   0,
                   {{2, {{x, 1, 0}, {v, 1, 1}, {a, 1.0 / 6, 2}}},
                    {3, {{v, 1, 0}, {a, 1.0 / 6, 1}}},
                    {4, {{x, 1, 0}, {v, 0.5, 1}, {a, 0.125, 2}}},
                    {5, {{v, 1, 0}, {a, 0.5, 1}}}}},
                  {4,
                   5,
                   0,
                   {{2, {{2, 1, 0}, {a, 1.0 / 3, 2}}},
                    {3, {{3, 1, 0}, {a, 2.0 / 3, 1}}},
                    {4, {{x, 1, 0}, {v, 1, 1}, {a, 0.5, 2}}},
                    {5, {{v, 1, 0}, {a, 1, 1}}}}},
                  {4, 5, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}, {a, 1.0 / 6, 1}}}}}},
       .start = {},
       .lag = 0},
      // Vector 1 lacks the end of the last step's closing kick, which shares its evaluation with the next step's first
      // kick. Vectors 2 and 3 hold the middle and the shifted middle, 4 a predicted velocity of second order for
      // damping.
      {.name = "force_gradient4",
       .title = "Force gradient 4",
       .equation = "",
       .source = "S. A. Chin, Phys. Lett. A 226, 344 (1997), algorithm A; as I. P. Omelyan, I. M. Mryglod, R. Folk, "
                 "Comput. Phys. Commun. 151, 272 (2003); the gradient by a shifted force as J. Wisdom, M. Holman, "
                 "J. Touma, Fields Inst. Commun. 10, 217 (1996)",
       .order_undamped = 4,
       .order_damped = 2,
       .vectors = 5,
       .keeps_displacement = false,
       .note = "Fourth order without damping for three evaluations per step, with energy that does not drift, while no "
               "spring switches; second with it.",
       .stability = "stable up to hω = 2√3 without damping; oscillations lag by (hω)⁵/4320 per step",
       .cost = "three evaluations of the force",
       .formula =
           R"(This is Verlet's step with kicks of $\tfrac16$, $\tfrac23$ and $\tfrac16$ of $dt$, the middle one of )"
           R"(which includes the gradient of the force: $v_1 = v + \tfrac16 dt\,a(x)$, $\;x_m = x + \tfrac12 )"
           R"(dt\,v_1$, $\;v_2 = v_1 + \tfrac23 dt\,\tilde a(x_m)$, $\;x' = x_m + \tfrac12 dt\,v_2$, $\;v' = v_2 + )"
           R"(\tfrac16 dt\,a(x')$ with $\tilde a(x) = a(x + \tfrac1{24} dt^2 a(x)) = a + \tfrac1{48} dt^2\,\nabla )"
           R"(|a|^2 + O(dt^4)$. The last kick of a step and the first kick of the next share one evaluation, so a )"
           R"(step costs three. All coefficients are positive, which is impossible for a fourth-order splitting )"
           R"(without the gradient. Damping uses a second-order prediction of the velocity.)",
       .sweeps =
           {{x,
             4,
             0,
             {{v, {{v, 1, 0}, {a, 1.0 / 3, 1}}}, {2, {{x, 1, 0}, {v, 0.5, 1}}}, {4, {{v, 1, 0}, {a, 1.0 / 3, 1}}}}},
            {2, 4, 0, {{3, {{2, 1, 0}, {a, 1.0 / 24, 2}}}}},
            {3,
             4,
             0,
             {{v, {{v, 1, 0}, {a, 2.0 / 3, 1}}}, {x, {{2, 1, 0}, {v, 0.5, 1}}}, {4, {{v, 1, 0}, {a, 1.0 / 6, 1}}}}}},
       .start = {{4, {{v, 1, 0}}}, {v, {{v, 1, 0}, {a, -1.0 / 6, 1}}}},
       .lag = 1.0 / 6},
  };
}

}  // namespace tyglab
