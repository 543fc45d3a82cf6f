// Dormand and Prince's method for y = (x, v), written in terms of its accelerations alone: the velocity of a stage is v
// plus a sum of them, so its position is x + c dt v plus a sum of them too, and nothing else must be stored.
#include <array>

#include "core/integrators/scheme_rows.h"

namespace tyglab {

namespace {

constexpr int stages = 7;
constexpr int stage_x = 2, stage_v = 3, first_a = 4;  // vectors: of a stage; first_a + i holds a of stage i

using Row = std::array<double, stages>;
/// Butcher's table; the last row is the fifth-order result, so the last stage is the next step's first.
constexpr std::array<Row, stages> weights{{
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
}};
/// Of the difference between the fifth-order result and the fourth-order one beside it.
constexpr Row error_weights{71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/// What a sum of stage velocities holds of each acceleration: v = v_0 + dt Σ weights a.
Row through_velocities(const Row& of) {
  Row sum{};
  for (int i = 0; i < stages; ++i)
    for (int k = 0; k < i; ++k) sum[k] += of[i] * weights[i][k];
  return sum;
}

std::vector<Term> accelerations(const Row& of, int dt_power) {
  std::vector<Term> terms;
  for (int i = 0; i < stages; ++i)
    if (of[i] != 0) terms.push_back({first_a + i, of[i], dt_power});
  return terms;
}

/// What is small comes first: x is rounded once.
Assignment position_of(int stage) {
  using namespace rows;
  double c = 0;
  for (const double weight : weights[stage]) c += weight;
  Assignment made{stage_x, accelerations(through_velocities(weights[stage]), 2)};
  made.terms.push_back({v, c, 1}), made.terms.push_back({x, 1, 0});
  return made;
}
Assignment velocity_of(int stage) {
  using namespace rows;
  Assignment made{stage_v, accelerations(weights[stage], 1)};
  made.terms.push_back({v, 1, 0});
  return made;
}

Row difference(const Row& one, const Row& other) {
  Row sum{};
  for (int i = 0; i < stages; ++i) sum[i] = one[i] - other[i];
  return sum;
}

/// R(z) = 1 + Σ z^(k+1) bᵀ Aᵏ 1.
std::vector<double> growth() {
  std::vector<double> coefficients{1};
  Row power;
  power.fill(1);
  for (int k = 0; k < stages - 1; ++k) {
    double sum = 0;
    for (int i = 0; i < stages; ++i) sum += weights[stages - 1][i] * power[i];
    coefficients.push_back(sum);
    Row next{};
    for (int i = 0; i < stages; ++i)
      for (int j = 0; j < i; ++j) next[i] += weights[i][j] * power[j];
    power = next;
  }
  return coefficients;
}

Estimate estimate() {
  const Row &last = weights[stages - 1], &before = weights[stages - 2];
  Row stage_a{};
  stage_a[stages - 1] = 1, stage_a[stages - 2] = -1;
  return {.order = 5,
          .x = accelerations(through_velocities(error_weights), 2),
          .v = accelerations(error_weights, 1),
          .stage_x = accelerations(difference(through_velocities(last), through_velocities(before)), 2),
          .stage_v = accelerations(difference(last, before), 1),
          .stage_a = accelerations(stage_a, 0),
          .growth = growth()};
}

std::vector<Sweep> sweeps() {
  using namespace rows;
  std::vector<Sweep> list;
  for (int i = 0; i < stages; ++i) {
    Sweep sweep{i == 0 ? x : stage_x, i == 0 ? v : stage_v, 0, {{first_a + i, {{a, 1, 0}}}}};
    if (i < stages - 1)
      sweep.assignments.push_back(position_of(i + 1)), sweep.assignments.push_back(velocity_of(i + 1));
    else
      sweep.assignments.push_back({x, {{stage_x, 1, 0}}}), sweep.assignments.push_back({v, {{stage_v, 1, 0}}});
    list.push_back(sweep);
  }
  return list;
}

}  // namespace

Scheme dopri5() {
  return {
      .name = "dopri5",
      .title = "Dormand-Prince 5(4)",
      .equation = "",
      .source =
          "J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6, 19 (1980); step control as in E. Hairer, "
          "S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), II.4, II.5, "
          "and K. Gustafsson, ACM Trans. Math. Softw. 17, 533 (1991)",
      .order_undamped = 5,
      .order_damped = 5,
      .vectors = first_a + stages,
      .keeps_displacement = false,
      .note = "Fifth order. Chooses inner steps within dt such that no step's error exceeds the tolerance.",
      .stability = "shortens its steps where they would be unstable, hλ about 1 to 3.3 in size, and counts them",
      .cost = "six evaluations of the force per inner step; also for rejected steps",
      .formula =
          R"(The method computes seven slopes of $y = (x, v)$, the last of which is the first of the next step. Two )"
          R"(combinations of them, of fifth and fourth order, differ by about the error of the step. )"
          R"(**`tolerance`** (m) limits this error for every coordinate of every particle; the error of a velocity )"
          R"(counts as the distance that it covers in one more step: $\max(|e_x|, h\,|e_v|) \le$ tolerance. A step )"
          R"(with a larger error is rejected and repeated. The last two errors determine the length of the next )"
          R"(step (a PI controller, $h' = 0.9\,h\,\varepsilon^{-0.17}\,\varepsilon_{old}^{0.04}$ with $\varepsilon$ )"
          R"(= error/tolerance, at most ten times longer and five times shorter), and the inner steps fill each )"
          R"($dt$ exactly. The method keeps the fifth-order result, so the error at a later time is roughly )"
          R"(proportional to the tolerance. $dt$ is only the interval of output. After each inner step, bodies and )"
          R"(tearing act and the force on the hand is measured; the hand releases at the end of a $dt$. Contact is )"
          R"(not a smooth force, and the error estimate does not include it. It is found within the inner step, with )"
          R"(an error of second order in its length, whatever the tolerance, so with bodies $dt$ must be short too.

The program counts what limits the steps: *stability* if the fastest motion between the last two stages, which )"
          R"(both belong to the end of the step, fitted as $\ddot x = -\omega^2 x - 2\zeta\omega\dot x$, lies )"
          R"(outside $|R(h\lambda)| \le 1$ (Hairer's test, $h|\lambda| > 3.25$, is the case of a motion that only )"
          R"(decays); *dt* if one step covers it; *accuracy* otherwise. If stability limits the steps, a smaller )"
          R"(tolerance costs little, and an implicit method may be faster. An inner step is never shorter than )"
          R"($dt/10^4$, and errors below the last digit of the largest coordinate are ignored: such a step is )"
          R"(accepted, counted and reported.)",
      .sweeps = sweeps(),
      .start = {},
      .lag = 0,
      .estimate = estimate()};
}

}  // namespace tyglab
