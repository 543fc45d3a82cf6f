// The second-order Runge-Kutta-Chebyshev method, with a table for each number of stages. A stage is stored as its
// distance from the beginning of the step, D in position and W in velocity, so no digit of a position is lost in sums
// of large float numbers.
#include <array>
#include <cmath>

#include "core/integrators/scheme_rows.h"
#include "core/integrators/stabilized.h"

namespace tyglab {

namespace chebyshev {  // apart from the names of the other methods: files are compiled together
namespace {

constexpr int stage_x = 2, stage_v = 3, distance_x = 4, distance_v = 6, first_a = 8, last_a = 9;  // vectors
/// About a fifth apart: the stages that a step has too many cost less than a table for each number.
constexpr std::array stage_numbers{2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 17, 20, 24, 29, 35, 42, 50, 60, 72, 86, 100};

/// Chebyshev's polynomials and their first two derivatives at w_0, and what follows from them.
struct Chebyshev {
  explicit Chebyshev(int count) : w_0(1 + 2.0 / 13 / (double(count) * count)) {
    std::vector<double> first{0, 1}, second{0, 0};
    T = {1, w_0};
    for (int j = 2; j <= count; ++j) {
      const std::size_t n = std::size_t(j);
      T.push_back(2 * w_0 * T[n - 1] - T[n - 2]);
      first.push_back(2 * T[n - 1] + 2 * w_0 * first[n - 1] - first[n - 2]);
      second.push_back(4 * first[n - 1] + 2 * w_0 * second[n - 1] - second[n - 2]);
    }
    w_1 = first.back() / second.back();
    for (std::size_t n = 0; n < T.size(); ++n) b.push_back(n < 2 ? 0 : second[n] / (first[n] * first[n]));
    b[0] = b[1] = b[2];
  }
  double w_0, w_1 = 0;
  std::vector<double> T, b;
};

/// Where D and W of a stage are: two places each, by turns, so that those of the last stage are always the first.
int place(int of, int stage, int count) {
  return of + (count - stage) % 2;
}

/// The stage's x and v themselves.
void complete(Sweep& sweep, int stage, int count) {
  using namespace rows;
  sweep.assignments.push_back({stage_x, {{place(distance_x, stage, count), 1, 0}, {x, 1, 0}}});
  sweep.assignments.push_back({stage_v, {{place(distance_v, stage, count), 1, 0}, {v, 1, 0}}});
}

Sweep first_sweep(const Chebyshev& c, int count) {
  using namespace rows;
  const double part = c.b[1] * c.w_1;
  Sweep sweep{x, v, 0, {{first_a, {{a, 1, 0}}}}};
  sweep.assignments.push_back({place(distance_x, 1, count), {{v, part, 1}}});
  sweep.assignments.push_back({place(distance_v, 1, count), {{first_a, part, 1}}});
  complete(sweep, 1, count);
  return sweep;
}

/// Evaluates at the stage before and makes this one, 2 or more.
Sweep sweep_of(const Chebyshev& c, int stage, int count) {
  using namespace rows;
  const std::size_t j = std::size_t(stage);
  const double mu = 2 * c.b[j] * c.w_0 / c.b[j - 1], nu = -c.b[j] / c.b[j - 2];
  const double part = 2 * c.b[j] * c.w_1 / c.b[j - 1], of_first = -(1 - c.b[j - 1] * c.T[j - 1]) * part;
  Sweep sweep{stage_x, stage_v, 0, {}};
  const auto add = [&](int distance, int slope, int first_slope) {
    Assignment made{place(distance, stage, count), {{slope, part, 1}, {first_slope, of_first, 1}}};
    if (stage > 2) made.terms.push_back({place(distance, stage - 2, count), nu, 0});
    made.terms.push_back({place(distance, stage - 1, count), mu, 0});
    sweep.assignments.push_back(made);
  };
  add(distance_x, stage_v, v), add(distance_v, a, first_a);
  complete(sweep, stage, count);
  return sweep;
}

StageTable table(int count) {
  using namespace rows;
  const Chebyshev c(count);
  // The largest disc that touches the imaginary axis grows from 1 to 2.58.
  const double disc = count == 2 ? 1 : 2.57 - 9.0 / (double(count) * count);
  StageTable made{count, (1 + c.w_0) / c.w_1, disc, {first_sweep(c, count)}};
  for (int stage = 2; stage <= count; ++stage) made.sweeps.push_back(sweep_of(c, stage, count));
  made.sweeps.push_back({stage_x, stage_v, 0, {{last_a, {{a, 1, 0}}}, {x, {{stage_x, 1, 0}}}, {v, {{stage_v, 1, 0}}}}});
  return made;
}

/// (12 (y - y') + 6 h (f + f'))/15, which is the h³ term of the error (Sommeijer, Shampine, Verwer, (2.6)).
Estimate estimate() {
  using namespace rows;
  constexpr double by_distance = -12.0 / 15, by_slope = 6.0 / 15;
  return {.order = 3,
          .x = {{distance_x, by_distance, 0}, {v, by_slope, 1}, {stage_v, by_slope, 1}},
          .v = {{distance_v, by_distance, 0}, {first_a, by_slope, 1}, {last_a, by_slope, 1}},
          .stage_x = {},
          .stage_v = {},
          .stage_a = {},
          .growth = {}};
}

}  // namespace
}  // namespace chebyshev

std::complex<double> rkc2_growth(int count, std::complex<double> z) {
  const chebyshev::Chebyshev c(count);
  const std::complex<double> w = c.w_0 + c.w_1 * z;
  std::complex<double> before = 1, now = w;
  for (int j = 2; j <= count; ++j) {
    const std::complex<double> next = 2.0 * w * now - before;
    before = now, now = next;
  }
  const double b = c.b.back();
  return 1 - b * c.T.back() + b * now;
}

Scheme rkc2() {
  using namespace chebyshev;
  std::vector<StageTable> tables;
  tables.reserve(std::size(stage_numbers));
  for (const int count : stage_numbers) tables.push_back(table(count));
  return {
      .name = "rkc2",
      .title = "Runge-Kutta-Chebyshev 2",
      .equation = "",
      .source =
          "B. P. Sommeijer, L. F. Shampine, J. G. Verwer, RKC: an explicit solver for parabolic PDEs, J. Comput. "
          "Appl. Math. 88, 315 (1998); P. J. van der Houwen, B. P. Sommeijer, Z. Angew. Math. Mech. 60, 479 (1980)",
      .order_undamped = 2,
      .order_damped = 2,
      .vectors = last_a + 1,
      .keeps_displacement = false,
      .note =
          "Second order, for strong damping: its many stages serve stability. Chooses its inner steps and their "
          "number of stages.",
      .stability =
          "chooses steps and stages that are stable, hλ down to −0.65 s² with s stages; oscillations need "
          "h < 2.5 k_d/k_s, or grow slowly without damping",
      .cost = "2 to 100 evaluations of the force per inner step, as many as the damping requires",
      .formula =
          R"(The stages of this explicit method follow Chebyshev's recurrence, so that s stages are stable for real )"
          R"($h\lambda$ down to $-\tfrac23(s^2 - 1)(1 - \tfrac2{15}\varepsilon)$ with $\varepsilon = \tfrac2{13}$: )"
          R"(twice as many stages tolerate four times as much damping. With $y = (x, v)$ and $w_0 = 1 + )"
          R"(\varepsilon/s^2$, $\;w_1 = T_s'(w_0)/T_s''(w_0)$, $\;b_j = T_j''(w_0)/T_j'(w_0)^2$ ($b_0 = b_1 = )"
          R"(b_2$), the stages are $y_1 = y + b_1 w_1\,h f(y)$ and, up to $y' = y_s$, $y_j = y + \mu (y_{j-1} - y) )"
          R"(+ \nu (y_{j-2} - y) + \tilde\mu\,h f(y_{j-1}) + \tilde\gamma\,h f(y)$ with $\mu = 2 b_j w_0/b_{j-1}$, )"
          R"($\nu = -b_j/b_{j-2}$, $\tilde\mu = 2 b_j w_1/b_{j-1}$, $\tilde\gamma = -(1 - b_{j-1} )"
          R"(T_{j-1}(w_0))\,\tilde\mu$. The tolerance, the step control and the meaning of $dt$ are as for )"
          R"([`dopri5`](#dopri5), with the error $\tfrac1{15}(12(y - y') + 6h(f(y) + f(y')))$ and $h' = )"
          R"(0.9\,h\,\varepsilon^{-0.30}\,\varepsilon_{old}^{0.04}$. The error is proportional to the tolerance to )"
          R"(the power of two thirds.

The number of stages of a step follows from its length and the bounds of linear theory, which hold in every )"
          R"(shape of the cloth: a mode with the stiffness $\omega^2$ and the damping $c$ has the eigenvalues )"
          R"($\lambda^2 + c\lambda + \omega^2 = 0$. Real eigenvalues reach down to $-12 k_d/m$. Since every mode )"
          R"(has $\omega^2 \le r c$ with $r = (k_s + 4 k_b)/k_d$, complex eigenvalues have $|\lambda|^2 = \omega^2$ )"
          R"(and $\mathrm{Re}\,\lambda = -c/2$, so they lie in the disc $|\lambda + r| \le r$. The method is stable )"
          R"(in such a disc up to $h r = 1$ with 2 stages, 2.0 with 4 and 2.57 with the largest number. This limits )"
          R"(the steps: $h \le 2.57/r$. Verlet with damping $\zeta$ of the fastest mode needs $dt \approx )"
          R"(1/(\zeta\omega)$; a step of `rkc2` is about $5\zeta^2$ times as long and costs about $4\zeta$ )"
          R"(evaluations, so the method pays from $\zeta \approx 1$ on, and its advantage grows in proportion to )"
          R"($\zeta$. It is not suitable for weak damping: its steps are limited to $h\omega \le 0.5$, and even )"
          R"(then an undamped oscillation grows by up to 0.8 % per step, until the step control reacts. Steps )"
          R"(limited by either bound count as limited by *stability*.)",
      .sweeps = tables.front().sweeps,
      .start = {},
      .lag = 0,
      .estimate = chebyshev::estimate(),
      .tables = tables};
}

}  // namespace tyglab
