#include "core/integrators/step_control.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr double beta = 0.04;
constexpr double safety = 0.9, most_shrink = 5, most_growth = 10;
constexpr double least_old_error = 1e-4;
constexpr int steps_near_limit = 6;  // this many stable ones end a phase that stability limits, as Hairer counts

}  // namespace

void StepControl::begin(double first) {
  begun_ = true, rejected_ = false;
  wish_ = first;
  old_error_ = least_old_error;
}

double StepControl::next(double left, double dt) {
  constexpr double slack = 1.01;  // as Hairer's: no tiny step is left over
  dt_ = dt, shortest_ = shortest_part * dt;
  held_back_ = wish_ > longest_ && longest_ < dt;
  wish_ = std::clamp(std::min(wish_, longest_), shortest_, dt);
  // As many equal steps as the wish asks for, so that they fill what is left.
  const double steps = std::ceil(left / (slack * wish_));
  return step_ = steps > 1 ? left / steps : left;
}

bool StepControl::judge(const TriedStep& tried) {
  const double allowed = std::max(tried.tolerance, tried.last_digit);
  const double error = std::isfinite(tried.error) ? tried.error / allowed : INFINITY;
  const bool met = error <= 1, shortest = wish_ <= shortest_;
  const double factor = std::pow(error, 1.0 / order_ - 0.75 * beta);
  if (!met && !shortest) {
    wish_ = step_ / std::min(most_shrink, factor / safety);
    rejected_ = true;
    ++counts_.rejected;
    return false;
  }
  count_accepted(tried, met);
  const double shrink = std::clamp(factor / std::pow(old_error_, beta) / safety, 1 / most_growth, most_shrink);
  const double longest = rejected_ ? step_ : dt_;  // after a rejected step none is longer than the one that succeeded
  wish_ = std::min(step_ / shrink, longest);
  old_error_ = std::clamp(error, least_old_error, 1.0);
  rejected_ = false;
  return true;
}

void StepControl::count_accepted(const TriedStep& tried, bool met) {
  ++counts_.accepted;
  if (!met) ++counts_.too_short;
  if (tried.tolerance < tried.last_digit) ++counts_.below_digits;
  if (tried.unstable) near_limit_ = steps_near_limit;
  if (near_limit_-- > 0 || held_back_) {
    ++counts_.by_stability;
    near_limit_ = std::max(near_limit_, 0);
    return;
  }
  near_limit_ = 0;
  ++(step_ == dt_ ? counts_.by_dt : counts_.by_accuracy);
}

double first_probe(double L, double v, double a) {
  const double way = 0.01 * L;
  return std::min(way / v, std::sqrt(2 * way / a));
}

double first_step(double tolerance, double v, double a, double change, double probe, int order) {
  const double slope = std::max(v, probe * a) / tolerance;
  const double curvature = std::max(a, change) / tolerance;
  const double step = std::pow(0.01 / std::max({slope, curvature, 1e-15}), 1.0 / order);
  return std::min(100 * probe, step);
}

bool beyond_stability(const Estimate& estimate, const StageProducts& s, double h) {
  // In units of the step, a = -p x - q v by least squares. Where x and v go together, of all that fit the least p, q.
  const double hh = h * h, xx = s.xx / hh, xv = s.xv / h, xa = s.xa, va = s.va * h;
  const double ridge = 1e-9 * (xx + s.vv), one = xx + ridge, other = s.vv + ridge;
  const double determinant = one * other - xv * xv;
  if (!(determinant > 0)) return false;
  const double p = (xv * va - other * xa) / determinant, q = (xv * xa - one * va) / determinant;
  using Complex = std::complex<double>;
  const Complex root = std::sqrt(Complex(q * q / 4 - p));
  for (const Complex z : {-q / 2 + root, -q / 2 - root}) {
    // What truly grows, or hardly moves within a step, is no instability of the method.
    constexpr double least = 0.9;
    if (!(std::abs(z) > least) || z.real() > 0.1 * std::abs(z)) continue;
    Complex growth = 0;
    for (auto it = estimate.growth.rbegin(); it != estimate.growth.rend(); ++it) growth = growth * z + *it;
    if (std::abs(growth) > 1) return true;
  }
  return false;
}

}  // namespace tyglab
