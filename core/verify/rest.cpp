#include "core/verify/rest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <stdexcept>

namespace tyglab::verify {
namespace {

/// Solves H s = r in place by Cholesky's method; H is dense, row by row.
void solve(std::vector<double>& H, std::vector<double>& r) {
  const std::size_t n = r.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double sum = H[i * n + j] - std::inner_product(&H[i * n], &H[i * n] + j, &H[j * n], 0.0);
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

}  // namespace

double RestEnergy::scale(std::size_t particles) const {
  return preset_.m * preset_.g * double(particles) + glm::length(load_);
}

double RestEnergy::evaluate(const Positions& x, bool derivatives) {
  const std::size_t n = 3 * (x.size() - fixed_);
  double energy = -glm::dot(load_, x.back());
  if (derivatives) {
    gradient_.assign(n, 0), hessian_.assign(n * n, 0);
    for (int c = 0; c < 3; ++c) gradient_[n - 3 + std::size_t(c)] -= load_[c];
  }
  for (std::size_t p = fixed_; p < x.size(); ++p) {
    energy += preset_.m * preset_.g * x[p].y;
    if (derivatives) gradient_[3 * (p - fixed_) + 1] += preset_.m * preset_.g;
  }
  for_each_stencil(preset_, [&](const Force& force, const Stencil& stencil) {
    if (force.potential == nullptr) return;
    for (int i = 0; i < preset_.rows; ++i)
      for (int j = 0; j < preset_.columns; ++j)
        if (stencil.acts(whole_, i, j)) energy += add(force, stencil, i, j, x, derivatives);
  });
  return energy;
}

double RestEnergy::add(const Force& force, const Stencil& stencil, int i, int j, const Positions& x, bool derivatives) {
  std::size_t at[Stencil::most_points];
  glm::dvec3 d{0};
  for (std::size_t k = 0; k < std::size_t(stencil.points); ++k) {
    at[k] = std::size_t((i + stencil.at[k].di) * preset_.columns + j + stencil.at[k].dj);
    d += stencil.at[k].weight * x[at[k]];
  }
  const double squared = glm::dot(d, d);
  Potential phi = force.potential(preset_, stencil, squared);
  if (const double length = std::sqrt(squared), longer = length - stencil.rest * preset_.L;
      threads_push_ && &force == &force::stretch && longer < 0) {
    phi = {preset_.k_s / 2 * longer * longer, preset_.k_s * longer / length, 0};
    phi.along = (preset_.k_s - phi.factor) / squared;
  }
  const std::size_t n = gradient_.size();
  for (std::size_t k = 0; derivatives && k < std::size_t(stencil.points); ++k) {
    if (at[k] < fixed_) continue;
    const std::size_t row = 3 * (at[k] - fixed_);
    for (int c = 0; c < 3; ++c) gradient_[row + std::size_t(c)] += stencil.at[k].weight * phi.factor * d[c];
    for (std::size_t l = 0; l < std::size_t(stencil.points); ++l)
      for (int c = 0; at[l] >= fixed_ && c < 3; ++c)
        for (int e = 0; e < 3; ++e)
          hessian_[(row + std::size_t(c)) * n + 3 * (at[l] - fixed_) + std::size_t(e)] +=
              stencil.at[k].weight * stencil.at[l].weight * ((c == e ? phi.factor : 0) + phi.along * d[c] * d[e]);
  }
  return phi.energy;
}

void find_rest(RestEnergy& energy, Positions& x, const std::function<void()>& look) {
  const std::size_t fixed = energy.fixed();
  for (int n = 0; n < 2000; ++n) {
    look();
    const double now = energy.evaluate(x, true);
    std::vector<double> step = energy.gradient(), H = energy.hessian();
    const double left = std::sqrt(std::inner_product(step.begin(), step.end(), step.begin(), 0.0));
    if (left < 1e-8 * energy.scale(x.size())) return;
    for (std::size_t d = 0; d < step.size(); ++d)
      H[d * step.size() + d] = std::max(H[d * step.size() + d], 0.0) * (1 + 1e-9) + 1e-9;
    solve(H, step);
    const double slope = std::inner_product(step.begin(), step.end(), energy.gradient().begin(), 0.0);
    double part = 1;
    Positions to = x;
    for (; part > 1e-12; part /= 2) {
      for (std::size_t p = fixed; p < x.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) to[p][int(c)] = x[p][int(c)] - part * step[3 * (p - fixed) + c];
      if (energy.evaluate(to, false) <= now - 1e-4 * part * slope + 1e-13 * std::abs(now)) break;
    }
    x = to;
  }
  throw std::runtime_error("the cloth does not come to rest");
}

bool positive_definite(std::vector<double> H, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!(H[k * n + k] > 0)) return false;
    for (std::size_t a = k + 1; a < n; ++a) {
      const double part = H[a * n + k] / H[k * n + k];
      for (std::size_t b = k + 1; b < n; ++b) H[a * n + b] -= part * H[k * n + b];
    }
  }
  return true;
}

}  // namespace tyglab::verify
