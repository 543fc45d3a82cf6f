#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/integrators/names.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr int x = vector_x, v = vector_v, a = acceleration;

const Assignment keep_v{v, {{v, 1, 0}}};

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
       .start = keep_v,
       .full_velocity = keep_v,
       .full_velocity_needs_a = false},
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
       .start = keep_v,
       .full_velocity = keep_v,
       .full_velocity_needs_a = false},
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
       .start = {v, {{v, 1, 1}, {a, -0.5, 2}}},
       .full_velocity = {v, {{v, 1, -1}, {a, 0.5, 1}}},
       .full_velocity_needs_a = true},
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
