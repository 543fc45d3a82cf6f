
#include "core/theory/modes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/forces/force.h"

namespace tyglab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (ω, ζ) of a mode. One without stiffness decays alone; ω so small that its decay does not depend on it any more
/// stands for it.
struct Oscillator {
  double omega, zeta;
};
Oscillator oscillator_of(const Mode& mode) {
  constexpr double overdamped = 1000;
  const double omega = std::max(mode.omega(), mode.damping / (2 * overdamped));
  return {omega, omega > 0 ? mode.damping / (2 * omega) : 0};
}

}  // namespace

double Mode::omega() const {
  return stiffness > 0 ? std::sqrt(stiffness) : 0;
}

Mode any_configuration(const Preset& p) {
  const double springs = p.kind == Kind::one_weight ? 1 : 12;  // as for the stretch springs
  return {sum_of(&Force::largest_eigenvalue, p) / p.m, springs * p.k_d / p.m};
}

std::vector<Mode> worst_modes(const Preset& p) {
  const Mode fastest = any_configuration(p);
  std::vector<Mode> worst{fastest};
  if (p.kind == Kind::one_weight || p.k_d == 0) return worst;
  worst.push_back({0, fastest.damping});  // nothing pulls, but damping acts on every whole spring
  // Only stretch springs have damping of their own: K <= r/k_d C.
  const double r = sum_of(&Force::over_damping, p);
  if (r > force::stretch.over_damping(p)) worst.push_back({fastest.stiffness, fastest.stiffness * p.k_d / r});
  return worst;
}

Spectrum any_spectrum(const Preset& p) {
  const Mode fastest = any_configuration(p);
  const double stiffness = sum_of(&Force::over_damping, p);  // as in worst_modes
  return {std::max(fastest.damping, fastest.omega()),
          stiffness == 0 ? 0
          : p.k_d > 0    ? stiffness / p.k_d
                         : infinity,
          fastest.omega()};
}

double dt_crit(const Scheme& scheme, std::span<const Mode> modes) {
  double least = infinity;
  if (!has_step_limit(scheme)) return least;
  for (const Mode& mode : modes)
    if (const auto [omega, zeta] = oscillator_of(mode); omega > 0)
      least = std::min(least, stability_limit(scheme, zeta) / omega);
  return least;
}

double stiffness_margin(const Scheme& scheme, std::span<const Mode> modes, double dt) {
  if (!has_step_limit(scheme)) return infinity;
  const auto holds = [&](double factor) {
    return std::all_of(modes.begin(), modes.end(), [&](Mode mode) {
      mode.stiffness *= factor;
      const auto [omega, zeta] = oscillator_of(mode);
      return spectral_radius(amplification(scheme, omega * dt, zeta)) <= 1 + 1e-9;
    });
  };
  double low = 1e-12, high = 1e12;
  if (!holds(low)) return 0;
  if (holds(high)) return infinity;
  while (high / low > 1 + 1e-7) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

double growth_per_step(const Scheme& scheme, std::span<const Mode> modes, double dt) {
  double most = -infinity;
  if (!has_step_limit(scheme)) return most;
  for (const Mode& mode : modes)
    if (const auto [omega, zeta] = oscillator_of(mode); omega > 0)
      most = std::max(most, std::log(spectral_radius(amplification(scheme, omega * dt, zeta))));
  return most;
}

namespace {

Matrix identity(int size) {
  Matrix one{size, std::vector<double>(std::size_t(size) * size, 0)};
  for (int i = 0; i < size; ++i) one.at(i, i) = 1;
  return one;
}

/// `size` is an int or a constant of that type: a search for a limit squares tens of thousands of matrices, most of
/// them small, which is faster where the compiler knows how small.
template <class Size>
void square(Size size, const double* a, double* __restrict out) {
  std::fill_n(out, size * size, 0.0);
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < size; ++j) out[i * size + j] += a[i * size + k] * a[k * size + j];
}

/// `power`, the matrix, and `squared` are overwritten.
template <class Size>
double radius_by_squaring(Size size, double* power, double* squared) {
  constexpr int squarings = 48;
  double log_radius = 0, weight = 1;
  for (int n = 0; n < squarings; ++n) {
    double norm = 0;
    for (int e = 0; e < size * size; ++e) norm = std::max(norm, std::abs(power[e]));
    // A nilpotent matrix is gone after as many squarings as its size has bits. One with a defective eigenvalue (Verlet
    // at ω·dt = 2) comes close to such a one, and is lost to rounding long after its radius is known.
    if (norm == 0) return weight * size > 0.5 ? 0 : std::exp(log_radius);
    for (int e = 0; e < size * size; ++e) power[e] /= norm;
    log_radius += weight * std::log(norm);
    square(size, power, squared);
    std::swap(power, squared);
    weight /= 2;
  }
  return std::exp(log_radius);
}

template <int size>
double radius_of_small(const Matrix& matrix) {
  std::array<double, size * size> power, squared;
  std::copy(matrix.elements.begin(), matrix.elements.end(), power.begin());
  return radius_by_squaring(std::integral_constant<int, size>{}, power.data(), squared.data());
}

bool stable(const Scheme& scheme, double h, double zeta) {
  return spectral_radius(amplification(scheme, h, zeta)) <= 1 + 1e-12;
}

}  // namespace

Matrix amplification(const Scheme& scheme, double h, double zeta) {
  assert(zeta >= 0);
  const int n = scheme.vectors;
  Matrix now = identity(n);  // row: a vector's coefficients in terms of the vectors at the beginning of the step
  std::vector<double> force(std::size_t(n), 0), sum(std::size_t(n), 0);
  const auto assign = [&](const std::vector<Assignment>& assignments) {
    for (const Assignment& assignment : assignments) {
      std::fill(sum.begin(), sum.end(), 0.0);
      for (const Term& term : assignment.terms)  // dt = 1: no powers of it
        for (int k = 0; k < n; ++k)
          sum[std::size_t(k)] +=
              term.factor * (term.vector == acceleration ? force[std::size_t(k)] : now.at(term.vector, k));
      for (int k = 0; k < n; ++k) now.at(assignment.target, k) = sum[std::size_t(k)];
    }
  };
  for (const Sweep& sweep : scheme.sweeps) {
    assign(sweep.before);
    if (const double b = sweep.solves; b != 0)
      for (int k = 0; k < n; ++k) {
        double &x = now.at(sweep.position, k), &v = now.at(sweep.velocity, k);
        v = (v - b * h * h * x) / (1 + 2 * b * zeta * h + b * b * h * h);
        x += b * v;
      }
    if (sweep.damps != 0)
      for (int k = 0; k < n; ++k) now.at(sweep.velocity, k) /= 1 + sweep.damps * 2 * zeta * h;
    for (int k = 0; k < n; ++k)
      force[std::size_t(k)] = -h * h * now.at(sweep.position, k) - 2 * zeta * h * now.at(sweep.velocity, k);
    assign(sweep.assignments);
  }
  return now;
}

double spectral_radius(const Matrix& matrix) {
  if (matrix.size == 2) return radius_of_small<2>(matrix);
  if (matrix.size == 3) return radius_of_small<3>(matrix);
  if (matrix.size == 4) return radius_of_small<4>(matrix);
  if (matrix.size == 5) return radius_of_small<5>(matrix);
  if (matrix.size == 6) return radius_of_small<6>(matrix);
  std::vector<double> power = matrix.elements, squared(power.size());
  return radius_by_squaring(matrix.size, power.data(), squared.data());
}

double stability_limit(const Scheme& scheme, double zeta) {
  constexpr double shortest = 1e-5, first = 1e-3, longest = 20, grid = 1.01;
  double good = first;
  if (!stable(scheme, good, zeta)) {
    while (good > shortest && !stable(scheme, good, zeta)) good /= 2;
    if (good <= shortest) return 0;
  }
  double bad = good * grid;
  while (bad < longest && stable(scheme, bad, zeta)) good = bad, bad *= grid;
  if (bad >= longest) return std::numeric_limits<double>::infinity();
  while (bad - good > 1e-9 * good) {
    const double middle = (good + bad) / 2;
    (stable(scheme, middle, zeta) ? good : bad) = middle;
  }
  return good;
}

}  // namespace tyglab
