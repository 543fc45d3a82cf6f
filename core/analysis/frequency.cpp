#include "core/analysis/frequency.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "core/analysis/reference.h"
#include "core/engines/implicit/stiffness.h"
#include "core/forces/force.h"

namespace tyglab {
namespace {

using implicit::coefficient_pitch;
using implicit::spring_parts;
using implicit::springs_of_a_particle;

constexpr int most_lanczos_steps = 2000;
constexpr int between_looks = 4;  // products from one look at the residual to the next

}  // namespace

/// Lanczos' matrix: the cloth's, seen in the vectors that have been made so far.
struct Linearisation::Tridiagonal {
  std::vector<double> diagonal;
  std::vector<double> beside;  ///< the last one leads out of it

  /// How many eigenvalues are larger than `value` (Sturm's sequence).
  int above(double value) const {
    int count = 0;
    double pivot = 1;
    for (std::size_t n = 0; n < diagonal.size(); ++n) {
      pivot = diagonal[n] - value - (n > 0 ? beside[n - 1] * beside[n - 1] / pivot : 0);
      if (pivot == 0) pivot = 1e-300;
      count += pivot > 0;
    }
    return count;
  }
  double bound() const {
    double most = 0;
    for (std::size_t n = 0; n < diagonal.size(); ++n)
      most = std::max(most, std::abs(diagonal[n]) + beside[n] + (n > 0 ? beside[n - 1] : 0));
    return most;
  }
  double largest() const {
    double high = bound() * (1 + 1e-12), low = -high;
    while (high - low > 1e-14 * std::max(std::abs(low), std::abs(high))) {
      const double middle = (low + high) / 2;
      if (middle <= low || middle >= high) break;
      (above(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  /// The largest eigenvalue's vector, by inverse iteration from just above it, where every pivot is positive.
  std::vector<double> vector(double eigenvalue) const {
    const std::size_t size = diagonal.size();
    const double shift = eigenvalue + 1e-13 * bound() + 1e-300;
    std::vector<double> s(size, 1), pivot(size);
    for (int round = 0; round < 3; ++round) {
      for (std::size_t n = 0; n < size; ++n) {
        pivot[n] = shift - diagonal[n];
        if (n > 0)
          pivot[n] -= beside[n - 1] * beside[n - 1] / pivot[n - 1], s[n] += beside[n - 1] * s[n - 1] / pivot[n - 1];
        pivot[n] = std::max(pivot[n], 1e-16 * bound() + 1e-300);
      }
      for (std::size_t n = size; n-- > 0;) s[n] = (s[n] + (n + 1 < size ? beside[n] * s[n + 1] : 0)) / pivot[n];
      double norm = 0;
      for (const double part : s) norm = std::hypot(norm, part);
      for (double& part : s) part /= norm;
    }
    return s;
  }
};

Linearisation::Linearisation(const Simulation& simulation, Stop stop)
    : stop_(std::move(stop)),
      rows_(simulation.lattice().rows),
      columns_(simulation.lattice().columns),
      stride_(simd::row_stride<double>(columns_)),
      damped_(simulation.preset().k_d > 0),
      lattice_(simulation.preset().kind == Kind::cloth) {
  const Preset& p = simulation.preset();
  weight_ = {p.k / p.m, p.k_d / p.m};
  if (!lattice_) return;
  if (force::curl.on(p)) curl_ = force::curl.largest_eigenvalue(p) / p.m;
  coefficients_.assign(std::size_t(rows_) * coefficient_pitch(stride_), 0);
  damping_.assign(std::size_t(rows_) * springs_of_a_particle * stride_, 0);
  const PositionView view = simulation.positions();
  Field x;
  x.resize(rows_, stride_);
  for (int i = 0; i < rows_; ++i)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = std::size_t(i) * view.stride;
      if (view.f[c] != nullptr)
        std::copy_n(view.f[c] + row, columns_, x.row(i, c));
      else
        std::copy_n(view.d[c] + row, columns_, x.row(i, c));
    }
  LinearSprings<double> springs;
  springs.follow(p, simulation.tears(), stride_);
  for (int i = 0; i < rows_; ++i)
    for (int d = 0; d < springs_of_a_particle; ++d) linearise(p, simulation.tears(), springs, x, d, i);
  const auto held = simulation.held();
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j)
      if (simulation.pinned(i, j) || (held && held->i == i && held->j == j)) fixed_.push_back(i * columns_ + j);
}

/// The springs of a row in one direction. Along a spring k, across it k (1 - rest/length): less than 0 for one that
/// pushes, which is why it buckles.
void Linearisation::linearise(const Preset& p, const Tears& tears, const LinearSprings<double>& springs, const Field& x,
                              int d, int i) {
  const Direction& to = directions[std::size_t(d)];
  if (i + to.di >= rows_) return;
  const double rest = to.rest * p.L, k = spring_constant(p, to) / p.m, per_mass = p.k_d / p.m;
  // Stored at the lower end of a spring to the lower left, at the owner otherwise.
  const int shift = to.dj == -1 ? 1 : 0, count = columns_ - std::abs(to.dj);
  const std::ptrdiff_t stride = stride_;
  double* part = coefficients_.data() + i * coefficient_pitch(stride) + d * spring_parts * stride;
  double* damped = damping_.data() + (std::ptrdiff_t(i) * springs_of_a_particle + d) * stride;
  const double* linear = springs.row(i);
  if (linear != nullptr)
    for (int j = 0; j < count; ++j) part[j + 3 * stride] = linear[d * stride + j] / p.m;
  const double *here = x.row(i) + shift, *there = x.row(i + to.di) + (shift ? 0 : to.dj);
  for (int j = 0; j < count; ++j) {
    if (!tears.whole(d, i, j + shift)) continue;
    if (!to.bending) damped[j] = per_mass;
    const double dx = there[j] - here[j], dy = there[j + stride] - here[j + stride],
                 dz = there[j + 2 * stride] - here[j + 2 * stride];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    if (to.bending ? length >= rest || length < 1e-9 * rest : length <= rest) continue;
    const double across = k * (1 - rest / length), along = std::sqrt(k - across) / length;
    part[j] = along * dx, part[j + stride] = along * dy, part[j + 2 * stride] = along * dz;
    part[j + 3 * stride] += across;
  }
}

Array<double> Linearisation::combined(double stiffness, double damping) const {
  Array<double> a = coefficients_;
  const double root = std::sqrt(stiffness);
  for (std::ptrdiff_t spring = 0; spring < std::ptrdiff_t(rows_) * springs_of_a_particle; ++spring) {
    double* part = a.data() + spring * spring_parts * stride_;
    for (int n = 0; n < 3 * stride_; ++n) part[n] *= root;
    double* t = part + 3 * std::ptrdiff_t(stride_);
    for (int n = 0; n < stride_; ++n) t[n] = stiffness * t[n] + damping * damping_[spring * stride_ + n];
  }
  return a;
}

/// A vector that leans on every mode, the same each time (splitmix64), of length 1.
Linearisation::Field Linearisation::beginning() const {
  Field start;
  start.resize(rows_ + 3, stride_);
  std::uint64_t state = 1;
  for (int i = 0; i < rows_; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j) {
        std::uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u, z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        start.row(i, c)[j] = double((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
      }
  for (const int p : fixed_)
    for (int c = 0; c < 3; ++c) start.row(p / columns_, c)[p % columns_] = 0;
  const double norm = std::sqrt(inner(start, start));
  if (norm > 0)
    for (double& value : start.all()) value /= norm;
  return start;
}

double Linearisation::inner(const Field& a, const Field& b) const {
  double sum = 0;
  for (int i = 0; i < rows_; ++i) sum += implicit::dot_row(a.row(i), b.row(i), int(a.pitch()));
  return sum;
}

double Linearisation::multiply(const Array<double>& a, const Field& p, Field& q) const {
  double sum = 0;
  for (int i = 0; i < rows_; ++i) {
    if (stop_ && stop_()) throw Stopped();
    sum += implicit::multiply_row(implicit::ProductTask<double>{a.data() + i * coefficient_pitch(stride_), p.row(i),
                                                                q.row(i), stride_, columns_, i == 0, 0});
  }
  for (const int n : fixed_)
    for (int c = 0; c < 3; ++c) q.row(n / columns_, c)[n % columns_] = 0;
  return sum;
}

/// One more vector: `now` becomes the next, `before` the present one. Whether there is one.
bool Linearisation::next(const Array<double>& a, Field& before, Field& now, Field& product, Tridiagonal& t) const {
  const double alpha = multiply(a, now, product), beta = t.beside.empty() ? 0 : t.beside.back();
  double* w = product.row(0);
  const double *q = now.row(0), *old = before.row(0);
  const std::ptrdiff_t count = rows_ * now.pitch();
  for (std::ptrdiff_t n = 0; n < count; ++n) w[n] -= alpha * q[n] + beta * old[n];
  const double norm = std::sqrt(inner(product, product));
  t.diagonal.push_back(alpha), t.beside.push_back(norm);
  if (!(norm > 1e-14 * t.bound())) return false;
  const double per = 1 / norm;
  for (std::ptrdiff_t n = 0; n < count; ++n) w[n] *= per;
  std::swap(before, now), std::swap(now, product);
  return true;
}

/// Makes vectors until the largest eigenvalue is known well enough; returns it, and in `s` the mode's parts along them.
double Linearisation::iterate(const Array<double>& a, double tolerance, std::vector<double>& s) const {
  Field before, product, now = beginning();
  before.resize(rows_ + 3, stride_), product.resize(rows_ + 3, stride_);
  Tridiagonal t;
  for (bool more = true; more && int(t.diagonal.size()) < most_lanczos_steps;) {
    more = next(a, before, now, product, t);
    if (more && t.diagonal.size() % between_looks != 0) continue;
    s = t.vector(t.largest());
    if (t.beside.back() * std::abs(s.back()) <= tolerance * t.bound()) break;
  }
  return t.largest();
}

double Linearisation::largest_damping(double tolerance) const {
  if (!lattice_) return weight_.damping;
  std::vector<double> ignored;
  return damped_ && !all_fixed() ? iterate(combined(0, 1), tolerance, ignored) : 0;
}

double Linearisation::largest_stiffness(double tolerance) const {
  if (!lattice_) return weight_.stiffness;
  std::vector<double> ignored;
  return all_fixed() ? 0 : iterate(coefficients_, tolerance, ignored) + curl_;
}

Mode Linearisation::extreme(double stiffness, double damping, double tolerance) const {
  if (!lattice_) return weight_;
  if (all_fixed()) return {};
  const Array<double> a = combined(stiffness, damping);
  std::vector<double> s;
  iterate(a, tolerance, s);
  // The vectors once more, to sum the mode up; to keep them all would take hundreds of cloths' memory.
  Field before, product, now = beginning(), mode = now;
  before.resize(rows_ + 3, stride_), product.resize(rows_ + 3, stride_);
  for (double& part : mode.all()) part *= s[0];
  Tridiagonal t;
  for (std::size_t k = 1; k < s.size() && next(a, before, now, product, t); ++k)
    for (std::size_t n = 0; n < mode.all().size(); ++n) mode.all()[n] += s[k] * now.all()[n];
  const double length = inner(mode, mode);
  return {multiply(coefficients_, mode, product) / length + curl_, multiply(combined(0, 1), mode, product) / length};
}

std::vector<Mode> extreme_modes(const Linearisation& cloth, double tolerance) {
  if (!cloth.damped()) return {{cloth.largest_stiffness(tolerance), 0}};
  std::vector<Mode> modes{cloth.extreme(1, 0, tolerance)};
  const Mode damped = cloth.extreme(0, 1, tolerance);
  modes.push_back(damped);
  if (!(modes[0].stiffness > 0)) return modes;
  for (const double degrees : {-75.0, -60.0, -45.0, -30.0, 30.0, 60.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    modes.push_back(cloth.extreme(std::cos(angle) / modes[0].stiffness, std::sin(angle) / damped.damping, tolerance));
  }
  return modes;
}

Mode fastest_mode(const Linearisation& cloth, double tolerance) {
  return {cloth.largest_stiffness(tolerance), cloth.largest_damping(tolerance)};
}

}  // namespace tyglab
