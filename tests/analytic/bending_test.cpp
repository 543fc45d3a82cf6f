// The bending rigidity B against the elastica and the plate.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/engines/plain/plain_cloth.h"
#include "core/forces/force.h"
#include "tests/support/scenes.h"

namespace tyglab::bending_test {

/// Solves H s = r in place by Cholesky's method; H is dense, row by row.
void solve(std::vector<double>& H, std::vector<double>& r) {
  const std::size_t n = r.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = H[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= H[i * n + k] * H[j * n + k];
      H[i * n + j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / H[j * n + j];
    }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) r[i] -= H[i * n + k] * r[k];
    r[i] /= H[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) r[i] -= H[k * n + i] * r[k];
    r[i] /= H[i * n + i];
  }
}

/// A cloth's energy with its gradient and Hessian by the potentials of the table, over the particles behind the first
/// `fixed` ones: dense, for small cloths alone.
struct Energy {
  const Preset& preset;
  std::size_t fixed;
  bool threads_push;  ///< stretch springs hold their length in both directions
  const Tears whole{lattice_of(preset)};
  std::vector<double> gradient{}, hessian{};

  double evaluate(const plain::Vector& x, bool derivatives) {
    const std::size_t n = 3 * (x.size() - fixed);
    double energy = 0;
    if (derivatives) gradient.assign(n, 0), hessian.assign(n * n, 0);
    for (std::size_t p = fixed; p < x.size(); ++p) {
      energy += preset.m * preset.g * x[p].y;
      if (derivatives) gradient[3 * (p - fixed) + 1] += preset.m * preset.g;
    }
    for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
      if (force.potential == nullptr) return;
      for (int i = 0; i < preset.rows; ++i)
        for (int j = 0; j < preset.columns; ++j)
          if (stencil.acts(whole, i, j)) energy += add(force, stencil, i, j, x, derivatives);
    });
    return energy;
  }
  double add(const Force& force, const Stencil& stencil, int i, int j, const plain::Vector& x, bool derivatives) {
    std::size_t at[Stencil::most_points];
    glm::dvec3 d{0};
    for (std::size_t k = 0; k < std::size_t(stencil.points); ++k) {
      at[k] = std::size_t((i + stencil.at[k].di) * preset.columns + j + stencil.at[k].dj);
      d += stencil.at[k].weight * x[at[k]];
    }
    const double squared = glm::dot(d, d);
    Potential phi = force.potential(preset, stencil, squared);
    if (const double length = std::sqrt(squared), longer = length - stencil.rest * preset.L;
        threads_push && &force == &force::stretch && longer < 0) {
      phi = {preset.k_s / 2 * longer * longer, preset.k_s * longer / length, 0};
      phi.along = (preset.k_s - phi.factor) / squared;
    }
    const std::size_t n = gradient.size();
    for (std::size_t k = 0; derivatives && k < std::size_t(stencil.points); ++k) {
      if (at[k] < fixed) continue;
      const std::size_t row = 3 * (at[k] - fixed);
      for (int c = 0; c < 3; ++c) gradient[row + std::size_t(c)] += stencil.at[k].weight * phi.factor * d[c];
      for (std::size_t l = 0; l < std::size_t(stencil.points); ++l)
        for (int c = 0; at[l] >= fixed && c < 3; ++c)
          for (int e = 0; e < 3; ++e)
            hessian[(row + std::size_t(c)) * n + 3 * (at[l] - fixed) + std::size_t(e)] +=
                stencil.at[k].weight * stencil.at[l].weight * ((c == e ? phi.factor : 0) + phi.along * d[c] * d[e]);
    }
    return phi.energy;
  }
};

/// Newton's method with a search along the line, to a gradient of 1e-8 of the weight.
void find_rest(const Preset& preset, std::size_t fixed, bool threads_push, plain::Vector& x) {
  Energy energy{preset, fixed, threads_push};
  const double weight = preset.m * preset.g * double(x.size());
  for (int n = 0; n < 2000; ++n) {
    const double now = energy.evaluate(x, true);
    std::vector<double> step = energy.gradient;
    const double left = std::sqrt(std::inner_product(step.begin(), step.end(), step.begin(), 0.0));
    if (left < 1e-8 * weight) return;
    for (std::size_t d = 0; d < step.size(); ++d)
      energy.hessian[d * step.size() + d] = std::max(energy.hessian[d * step.size() + d], 0.0) * (1 + 1e-9) + 1e-9;
    solve(energy.hessian, step);
    const double slope = std::inner_product(step.begin(), step.end(), energy.gradient.begin(), 0.0);
    double part = 1;
    plain::Vector to = x;
    for (; part > 1e-12; part /= 2) {
      for (std::size_t p = fixed; p < x.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) to[p][int(c)] = x[p][int(c)] - part * step[3 * (p - fixed) + c];
      if (energy.evaluate(to, false) <= now - 1e-4 * part * slope + 1e-13 * std::abs(now)) break;
    }
    x = to;
  }
  FAIL("does not come to rest");
}

/// How far the end of a clamped strip of 1 m drops under its own weight, where q·(1 m)³/B is G, m. Two pinned rows
/// clamp it: it begins in the middle of their edge and ends half a cell beyond the last particle, which stands for one.
double drop(int edges, double G, bool threads_push) {
  Preset preset = test::quiet_cloth(edges + 1, 1);
  preset.L = 1.0 / edges, preset.m = 0.01 / edges, preset.g = 9.82;
  const double q = preset.m * preset.g / preset.L, width = preset.L;
  preset.B = q / G / width, preset.k_s = 1e6;
  plain::Vector x;
  for (int i = 0; i <= edges; ++i) x.push_back({0, -1e-3 * i * i * preset.L * preset.L, i * preset.L});
  find_rest(preset, 2, threads_push, x);
  const std::size_t last = std::size_t(edges);
  return -(x[last].y + preset.L / 2 * glm::normalize(x[last] - x[last - 1]).y);
}

// Of θ'' = -G (1 - s) cos θ, θ(0) = 0, θ'(1) = 0, by Runge-Kutta's method with 4,000 steps.
struct Elastica {
  double G, drop, within;
};
constexpr Elastica elastica[]{{1, 0.123471, 5e-4}, {10, 0.700200, 5e-4}, {100, 0.937523, 5e-4}, {1000, 0.981141, 3e-3}};

TEST_CASE("a clamped strip whose threads keep their length drops as the elastica, of order 2" *
          doctest::test_suite("slow")) {
  for (const auto& [G, exact, within] : elastica) {
    CAPTURE(G);
    const double coarse = drop(32, G, true) - exact, fine = drop(128, G, true) - exact;
    CHECK(std::abs(coarse) < within);
    CHECK(std::abs(fine) < std::abs(coarse) / std::pow(4, 1.9));
  }
}

// The report's springs do not push: where the moment contracts a thread more than the weight stretches it, the cloth is
// shorter than the elastica, on every lattice.
TEST_CASE("a clamped strip of springs that only pull is shorter where the moment outweighs the tension") {
  for (const int edges : {32, 128})
    CHECK(drop(edges, 10, false) - elastica[1].drop == doctest::Approx(5.8e-3).epsilon(0.1));
}

/// Whether a strip of 1 m that stands on edge, clamped at one end, keeps its plane under its own weight: its energy has
/// no direction out of the plane in which it falls.
bool stays_upright(const Preset& preset) {
  plain::Vector x;
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) x.push_back({0, -j * preset.L, i * preset.L});
  const std::size_t fixed = 2 * std::size_t(preset.columns);
  find_rest(preset, fixed, true, x);
  Energy energy{preset, fixed, true};
  energy.evaluate(x, true);
  // Cholesky's method on the part of the Hessian that belongs to x: a pivot below 0 is such a direction.
  const std::size_t n = x.size() - fixed;
  std::vector<double> H(n * n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) H[a * n + b] = energy.hessian[3 * a * (3 * n) + 3 * b];
  for (std::size_t k = 0; k < n; ++k) {
    if (!(H[k * n + k] > 0)) return false;
    for (std::size_t a = k + 1; a < n; ++a) {
      const double part = H[a * n + k] / H[k * n + k];
      for (std::size_t b = k + 1; b < n; ++b) H[a * n + b] -= part * H[k * n + b];
    }
  }
  return true;
}

/// The load q L³ at which such a strip of two columns buckles, divided by 12.854 √(EI C): S. Timoshenko, J. Gere,
/// Theory of Elastic Stability, 2nd ed. (1961), 6.3, for a cantilever of length L. Here EI = B w, where each column
/// stands for a part of the width w, and the twist φ per length of the cells between them has the energy twist·B w φ² =
/// ½ C φ², so C = 2 twist·B w.
double buckling_load(int edges, double twist) {
  Preset preset = test::quiet_cloth(edges + 1, 2);
  preset.L = 1.0 / edges, preset.m = 0.01 / edges, preset.k_s = 2e3, preset.B = 1e-3, preset.twist = twist;
  const double bends = preset.B * 2 * preset.L, twists = 2 * twist * preset.B * preset.L;
  const double load = 12.854 * std::sqrt(bends * twists);
  double low = 0.5, high = 2;
  while (high - low > 1e-3) {
    const double middle = (low + high) / 2;
    preset.g = middle * load * preset.L / (2 * preset.m);
    (stays_upright(preset) ? low : high) = middle;
  }
  return low;
}

// The clamp holds half a cell more against twist than against bending, so the error is of first order.
TEST_CASE("a strip on edge buckles sideways under its weight where a beam of that stiffness and torsion does" *
          doctest::test_suite("slow")) {
  for (const double twist : {1.0, 0.25}) {
    const double coarse = buckling_load(32, twist), fine = buckling_load(64, twist);
    CAPTURE(twist);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(std::abs(coarse - 1) < 0.13);
    CHECK(std::abs(fine - 1) < 0.7 * std::abs(coarse - 1));
    CHECK(std::abs(2 * fine - coarse - 1) < 0.03);
  }
}

TEST_CASE("with twist = 1 a cloth bends onto a cylinder at any angle with ½B a curvature squared and area") {
  Preset preset = test::quiet_cloth(40, 40);
  preset.B = 1e-4;
  const double R = 12 * preset.L;
  const Tears whole(lattice_of(preset));
  const auto density = [&](double twist, double degrees) {
    preset.twist = twist;
    const double angle = degrees * std::numbers::pi / 180;
    const auto x_of = [&](int i, int j) {
      const double along = preset.L * (j * std::cos(angle) - i * std::sin(angle));
      const double across = preset.L * (j * std::sin(angle) + i * std::cos(angle));
      return glm::dvec3(R * std::sin(along / R), across, R * std::cos(along / R));
    };
    double energy = 0;
    for (const Stencil& stencil : force::rigidity.stencils(preset))
      for (int i = 10; i < 30; ++i)
        for (int j = 10; j < 30; ++j) {
          ForceAction action;
          force::rigidity.act(preset, stencil, points_of(stencil, i, j, x_of, x_of), action);
          energy += action.energy;
        }
    return energy / (400 * preset.L * preset.L);
  };
  const double wanted = preset.B / 2 / (R * R);
  for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
    CAPTURE(degrees);
    CHECK(density(1, degrees) == doctest::Approx(wanted).epsilon(0.01));
  }
  CHECK(density(0, 45) == doctest::Approx(wanted / 2).epsilon(0.01));
}

}  // namespace tyglab::bending_test
