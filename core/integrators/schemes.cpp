#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/integrators/names.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr int x = vector_x, v = vector_v, a = acceleration;
constexpr double gamma = 2 - std::numbers::sqrt2;  // of TR-BDF2, and the weights of its second stage
constexpr double bdf_stage = 1 / (gamma * (2 - gamma)), bdf_start = (1 - gamma) * (1 - gamma) / (gamma * (2 - gamma));

const std::vector<Scheme>& table() {
  static const std::vector<Scheme> rows{
      {.name = "euler",
       .title = "Euler",
       .equation = "2.10",
       .source = "L. Euler, Institutiones calculi integralis, 1768; the report's (2.10)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note = "First order. Feeds energy into every oscillation; stable only with enough damping.",
       .sweeps = {{x, v, 0, {{x, {{x, 1, 0}, {v, 1, 1}}}, {v, {{v, 1, 0}, {a, 1, 1}}}}}},
       .start = {},
       .lags = false},
      {.name = "improved_euler",
       .title = "Improved Euler",
       .equation = "2.11",
       .source = "the report's (2.11)",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note = "A Taylor expansion of the position; its velocity is first order, so the method is.",
       .sweeps = {{x, v, 0, {{x, {{x, 1, 0}, {v, 1, 1}, {a, 0.5, 2}}}, {v, {{v, 1, 0}, {a, 1, 1}}}}}},
       .start = {},
       .lags = false},
      // d[n] = x[n] - x[n-1] is kept: x[n+1] = 2x[n] - x[n-1] + dt² a would lose a float's last digits in every step.
      {.name = "verlet",
       .title = "Verlet",
       .equation = "2.15",
       .source = "L. Verlet, Phys. Rev. 159, 98 (1967); the report's (2.15)",
       .order_undamped = 2,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = true,
       .note =
           "Second order without damping; first order with it, since the damping sees the velocity half a step late.",
       .sweeps = {{x, v, -1, {{v, {{v, 1, 0}, {a, 1, 2}}}, {x, {{x, 1, 0}, {v, 1, 0}}}}}},
       .start = {{v, {{v, 1, 1}, {a, -0.5, 2}}}},
       .lags = true},
      {.name = "semi_implicit_euler",
       .title = "Semi-implicit Euler",
       .equation = "",
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. (2006), I.1.2",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 2,
       .keeps_displacement = false,
       .note = "Verlet's recurrence with a simpler start: first order, and just as stable.",
       .sweeps = {{x, v, 0, {{v, {{v, 1, 0}, {a, 1, 1}}}, {x, {{x, 1, 0}, {v, 1, 1}}}}}},
       .start = {},
       .lags = false},
      // Vector 1 is v half a step back; vector 2 is v + dt a of the step before, a second-order prediction that the
      // damping sees, so that one evaluation a step is enough.
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
       .note = "Second order with damping too, since the damping sees a predicted velocity. One evaluation a step.",
       .sweeps = {{x, 2, 0, {{v, {{v, 1, 0}, {a, 1, 1}}}, {x, {{x, 1, 0}, {v, 1, 1}}}, {2, {{v, 1, 0}, {a, 0.5, 1}}}}}},
       .start = {{2, {{v, 1, 0}}}, {v, {{v, 1, 0}, {a, -0.5, 1}}}},
       .lags = true},
      // Vectors 2 and 3 gather the result, 4 and 5 hold the stage.
      {.name = "rk4",
       .title = "Runge-Kutta 4",
       .equation = "",
       .source = "W. Kutta, Z. Math. Phys. 46, 435 (1901)",
       .order_undamped = 4,
       .order_damped = 4,
       .vectors = 6,
       .keeps_displacement = false,
       .note = "Fourth order while no spring switches. Four evaluations a step; loses a little energy.",
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
       .lags = false},
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
       .note = "Fourth order without damping for three evaluations a step, while no spring switches; second with it.",
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
       .lags = false},
      {.name = "implicit_euler",
       .title = "Implicit Euler",
       .equation = "",
       .source = "D. Baraff, A. Witkin, SIGGRAPH 1998; here with Newton's method to the end",
       .order_undamped = 1,
       .order_damped = 1,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Stable at every dt and k_s, since it takes energy away: the more, the larger dt.",
       .sweeps = {{2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, 1, {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
       .start = {},
       .lags = false},
      {.name = "implicit_midpoint",
       .title = "Implicit midpoint",
       .equation = "",
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. (2006), II.1",
       .order_undamped = 2,
       .order_damped = 2,
       .vectors = 4,
       .keeps_displacement = false,
       .note = "Second order, symplectic, stable at every dt while no spring switches; fast oscillations stay.",
       .sweeps = {{2,
                   3,
                   0,
                   {{x, {{2, 2, 0}, {x, -1, 0}}}, {v, {{3, 2, 0}, {v, -1, 0}}}},
                   0.5,
                   {{2, {{x, 1, 0}}}, {3, {{v, 1, 0}}}}}},
       .start = {},
       .lags = false},
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
       .note = "Second order, and takes fast oscillations away: what dt resolves stays, the rest calms. Two solves.",
       .sweeps = {{x, v, 0, {{2, {{x, 1, 0}, {v, gamma / 2, 1}}}, {3, {{v, 1, 0}, {a, gamma / 2, 1}}}}},
                  {2,
                   3,
                   0,
                   {{2, {{2, bdf_stage, 0}, {x, -bdf_start, 0}}}, {3, {{3, bdf_stage, 0}, {v, -bdf_start, 0}}}},
                   gamma / 2,
                   {}},
                  {2, 3, 0, {{x, {{2, 1, 0}}}, {v, {{3, 1, 0}}}}, gamma / 2, {}}},
       .start = {},
       .lags = false},
  };
  return rows;
}

}  // namespace

std::span<const Scheme> schemes() {
  return table();
}

const Scheme& scheme(std::string_view name) {
  const auto& rows = table();
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const Scheme& s) { return s.name == name; });
  if (it == rows.end()) throw std::invalid_argument("no integrator is called " + std::string(name));
  return *it;
}

std::span<const std::string_view> integrator_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Scheme& s : table()) list.push_back(s.name);
    return list;
  }();
  return names;
}

bool is_integrator(std::string_view name) {
  const auto names = integrator_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace tyglab
