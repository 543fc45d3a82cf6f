// The order of every method, measured and held from both sides. A new scheme is one more row.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::order_test {

struct Row {
  std::string integrator;
  double k_d;    ///< N s/m
  double order;  ///< of the position error at a fixed time
};

/// As the methods' own table claims, with damping and without.
std::vector<Row> rows() {
  std::vector<Row> list;
  for (const Scheme& s : schemes()) {
    if (chooses_steps(s)) continue;  // inner_steps_order_test.cpp
    list.push_back({std::string(s.name), 0, double(s.order_undamped)});
    list.push_back({std::string(s.name), 0.2, double(s.order_damped)});
  }
  return list;
}

/// y(t) of m y'' = -k (y - x_0) - k_d y' - m g from its start, exactly.
double exact(const Preset& p, double t) {
  const double y_eq = p.x_0.y - p.m * p.g / p.k, decay = p.k_d / (2 * p.m);
  const double w = std::sqrt(p.k / p.m - decay * decay);
  const double A = p.x_0.y + p.offset - y_eq, B = (p.v_0.y + decay * A) / w;
  return y_eq + std::exp(-decay * t) * (A * std::cos(w * t) + B * std::sin(w * t));
}

double error_at(Preset preset, int steps, double t) {
  preset.dt = t / steps;
  Simulation simulation(preset);
  simulation.advance(steps);
  return std::abs(simulation.positions().at(0, 0).y - exact(preset, t));
}

TEST_CASE("each method has the order that is said of it") {
  for (const Row& row : rows()) {
    CAPTURE(std::string(row.integrator));
    CAPTURE(row.k_d);
    Preset preset = test::one_weight(row.integrator);
    preset.k_d = row.k_d;
    preset.v_0 = {0, 0.4, 0};
    const double t = 0.23;                          // where no method's leading error happens to vanish
    const int steps = row.order == 4 ? 150 : 4000;  // a fourth-order error is soon under rounding
    const double measured = std::log2(error_at(preset, steps, t) / error_at(preset, 2 * steps, t));
    CHECK(measured > row.order - 0.1);
    CHECK(measured < row.order + 0.1);
  }
}

}  // namespace tyglab::order_test
