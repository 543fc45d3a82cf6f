#include "core/engines/cpu/implicit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyglab::cpu {
namespace {

constexpr double linear_tolerance = 1e-3;  // |r| of its start; Newton's method multiplies it from step to step
template <class R>
constexpr double newton_tolerance = sizeof(R) == 8 ? 1e-10 : 1e-5;  // |r| of its start
constexpr double flat_enough = 0.2;  // slope along a step where it ends, of that at its beginning
constexpr int most_tries = 20;

}  // namespace

template <class R>
void ImplicitSolver<R>::resize(const Cloth<R>& cloth) {
  if (rows_ == cloth.lattice.rows && stride_ == cloth.stride) return;
  rows_ = cloth.lattice.rows, stride_ = cloth.stride;
  for (Field* field :
       {&start_x_, &start_v_, &acceleration_, &before_, &residual_, &step_, &direction_, &product_, &preconditioned_})
    field->resize(rows_ + 3, stride_);
  blocks_.assign(std::size_t(rows_ + 2) * 6 * stride_, R(0));
  coefficients_.assign(std::size_t(rows_) * coefficient_pitch(stride_), R(0));
}

template <class R>
std::size_t ImplicitSolver<R>::bytes() const {
  std::size_t total = (blocks_.size() + coefficients_.size()) * sizeof(R);
  for (const Field* field :
       {&start_x_, &start_v_, &acceleration_, &before_, &residual_, &step_, &direction_, &product_, &preconditioned_})
    total += field->bytes();
  return total + matrix_.bytes() + right_side_.capacity() * sizeof(double);
}

template <class R>
double ImplicitSolver<R>::inner(const Field& a, const Field& b) const {
  double sum = 0;  // row by row in double: one sum of a large cloth in float would lose digits
  for (int i = 0; i < rows_; ++i) sum += dot_row(a.row(i), b.row(i), int(a.pitch()));
  return sum;
}

/// Takes the vectors to x = c_x + dt v and the residual to what they leave; returns its norm.
template <class R>
double ImplicitSolver<R>::evaluate(Cloth<R>& cloth, int position, int velocity, double dt,
                                   const Accelerations& accelerations) {
  const std::span<R> x = cloth.vector(position).all(), v = cloth.vector(velocity).all();
  const R h = R(dt);
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = start_x_.all()[n] + h * v[n];
  accelerations(acceleration_);
  ++counts_.force_evaluations;
  const std::span<R> r = residual_.all();
  for (std::size_t n = 0; n < r.size(); ++n) r[n] = h * acceleration_.all()[n] - (v[n] - start_v_.all()[n]);
  return std::sqrt(inner(residual_, residual_));
}

template <class R>
void ImplicitSolver<R>::solve(Cloth<R>& cloth, int position, int velocity, double dt, const Tears& tears,
                              const Accelerations& accelerations) {
  resize(cloth);
  start_x_ = cloth.vector(position), start_v_ = cloth.vector(velocity);
  direct_ = false;  // every stage tries anew: a repeated step must give the same bits
  const int most = cloth.preset.iterations;
  const double first = evaluate(cloth, position, velocity, dt, accelerations);
  // A step that moves nothing by more than the last digits of a position cannot be bettered.
  const double last_digits = 4 * double(std::numeric_limits<R>::epsilon()) * std::sqrt(inner(start_x_, start_x_));
  double norm = first;
  bool solved = norm == 0;
  for (int n = 0; n < most && !solved && std::isfinite(norm); ++n) {
    linearise(cloth, cloth.vector(position), dt, tears);
    if (!solve_linear(cloth)) ++counts_.unconverged;
    ++counts_.newton;
    if (most == 1) {  // a linearly implicit step, taken as it is
      const std::span<R> x = cloth.vector(position).all(), v = cloth.vector(velocity).all();
      for (std::size_t k = 0; k < v.size(); ++k) v[k] += step_.all()[k], x[k] = start_x_.all()[k] + R(dt) * v[k];
      return;
    }
    norm = take_step(cloth, position, velocity, dt, accelerations);
    solved = norm <= newton_tolerance<R> * first || dt * std::sqrt(inner(step_, step_)) <= last_digits;
  }
  if (!solved) ++counts_.unconverged;
}

/// Goes along the step, or less far where that overshoots; leaves the residual there and returns its norm.
template <class R>
double ImplicitSolver<R>::take_step(Cloth<R>& cloth, int position, int velocity, double dt,
                                    const Accelerations& accelerations) {
  const std::span<R> v = cloth.vector(velocity).all();
  before_ = cloth.vector(velocity);
  // The residual is minus the slope of the potential that a solution makes least; the system is positive, so this is >
  // 0.
  const double slope = inner(residual_, step_);
  // Along the step the potential is convex, its slope thus rises: where the step overshoots, the least value lies
  // between 0 and its end. False position, in the form that halves the slope of an end that stays (Illinois).
  double part = 1, now = 0, lower = 0, lower_slope = slope, upper = 0, upper_slope = 0;
  for (int tries = 0; tries <= most_tries; ++tries) {
    for (std::size_t n = 0; n < v.size(); ++n) v[n] = before_.all()[n] + R(part) * step_.all()[n];
    now = evaluate(cloth, position, velocity, dt, accelerations);
    const double there = inner(residual_, step_);
    if (std::abs(there) <= flat_enough * slope || (there > 0 && part == 1)) break;
    if (!(there > 0)) {  // beyond it, or not finite
      if (upper != 0) lower_slope /= 2;
      upper = part, upper_slope = std::isfinite(there) ? there : -std::numeric_limits<double>::max();
    } else {
      if (lower != 0) upper_slope /= 2;
      lower = part, lower_slope = there;
    }
    const double secant = lower + (upper - lower) * lower_slope / (lower_slope - upper_slope);
    part = std::clamp(secant, lower + 0.01 * (upper - lower), lower + 0.9 * (upper - lower));
  }
  return now;
}

template <class R>
void ImplicitSolver<R>::linearise(const Cloth<R>& cloth, const Field& x, double dt, const Tears& tears) {
  std::fill(blocks_.begin(), blocks_.end(), R(0));
  const double per_mass = 1 / cloth.preset.m;
  const bool weight = cloth.preset.kind == Kind::one_weight;
  const double own = weight ? 1 + per_mass * (dt * cloth.preset.k_d + dt * dt * cloth.preset.k) : 1;
  mass_ = own;
  for (int i = 0; i < rows_; ++i)
    for (int c = 0; c < 3; ++c) std::fill_n(block(i) + c * stride_, cloth.lattice.columns, R(own));
  if (!weight)
    for (int i = 0; i < rows_; ++i)
      for (int d = 0; d < springs_of_a_particle; ++d) linearise_row(cloth, x, dt, tears, d, i);
  invert_blocks(cloth);
}

/// The springs of a row in one direction: their coefficients, and what they add to the blocks of both ends.
template <class R>
void ImplicitSolver<R>::linearise_row(const Cloth<R>& cloth, const Field& x, double dt, const Tears& tears, int d,
                                      int i) {
  const Direction& to = directions[d];
  R* part = coefficients_.data() + i * coefficient_pitch(stride_) + d * spring_parts * stride_;
  std::fill_n(part, spring_parts * stride_, R(0));
  if (i + to.di >= rows_) return;
  const Preset& p = cloth.preset;
  const R rest = R(to.rest * p.L), k = R(dt * dt * (to.bending ? p.k_b : p.k_s) / p.m);
  const R damped = to.bending ? R(0) : R(dt * p.k_d / p.m), least = R(1e-9) * rest;
  // Stored at the lower end of a spring to the lower left, at the owner otherwise.
  const int shift = to.dj == -1 ? 1 : 0, columns = cloth.lattice.columns - std::abs(to.dj);
  const R *upper = x.row(i) + shift, *lower = x.row(i + to.di) + (shift ? 0 : to.dj);
  R *one = block(i) + shift, *other = block(i + to.di) + (shift ? 0 : to.dj);
  for (int j = 0; j < columns; ++j) {
    if (!tears.whole(d, i, j + shift)) continue;
    const R dx = lower[j] - upper[j], dy = lower[j + stride_] - upper[j + stride_],
            dz = lower[j + 2 * stride_] - upper[j + 2 * stride_];
    const R length = std::sqrt(dx * dx + dy * dy + dz * dz);
    R t = damped, along = 0;  // along: of a = along · unit vector
    if (to.bending ? length < rest && length > least : length > rest) {
      // Along the spring k, across it k (1 - rest/length), where that is positive.
      const R across = to.bending ? R(0) : k * (1 - rest / length);
      t += across;
      along = std::sqrt(k - across) / length;
    }
    const R ax = along * dx, ay = along * dy, az = along * dz;
    part[j] = ax, part[j + stride_] = ay, part[j + 2 * stride_] = az, part[j + 3 * stride_] = t;
    const R add[6] = {t + ax * ax, t + ay * ay, t + az * az, ay * az, az * ax, ax * ay};
    for (int c = 0; c < 6; ++c) one[j + c * stride_] += add[c], other[j + c * stride_] += add[c];
  }
}

/// The inverse of each particle's block; 0 for a fixed one, which takes no step.
template <class R>
void ImplicitSolver<R>::invert_blocks(const Cloth<R>& cloth) {
  for (int i = 0; i < rows_; ++i) {
    R* b = block(i);
    for (int j = 0; j < cloth.lattice.columns; ++j) {
      R *xx = b + j, *yy = xx + stride_, *zz = yy + stride_, *yz = zz + stride_, *zx = yz + stride_, *xy = zx + stride_;
      const R cx = *yy * *zz - *yz * *yz, cy = *zx * *yz - *xy * *zz, cz = *xy * *yz - *yy * *zx;
      const R per = 1 / (*xx * cx + *xy * cy + *zx * cz);
      const R ix = cx * per, iy = (*xx * *zz - *zx * *zx) * per, iz = (*xx * *yy - *xy * *xy) * per;
      const R iyz = (*xy * *zx - *xx * *yz) * per;
      *xx = ix, *yy = iy, *zz = iz, *yz = iyz, *zx = cz * per, *xy = cy * per;
    }
    for (int n = cloth.fixed_begin[i]; n < cloth.fixed_begin[i + 1]; ++n)
      for (int c = 0; c < 6; ++c) b[cloth.fixed_columns[n] + c * stride_] = R(0);
  }
}

/// product_ = A direction_; returns their inner product.
template <class R>
double ImplicitSolver<R>::multiply(const Cloth<R>& cloth) {
  double sum = 0;
  for (int i = 0; i < rows_; ++i)
    sum += multiply_row(ProductTask<R>{coefficients_.data() + i * coefficient_pitch(stride_), direction_.row(i),
                                       product_.row(i), stride_, cloth.lattice.columns, i == 0, mass_});
  return sum;
}

template <class R>
Residual ImplicitSolver<R>::update(const Cloth<R>& cloth, double alpha) {
  Residual sum{0, 0};
  for (int i = 0; i < rows_; ++i) {
    const Residual row =
        update_row(UpdateTask<R>{direction_.row(i), product_.row(i), block(i), step_.row(i), residual_.row(i),
                                 preconditioned_.row(i), stride_, cloth.lattice.columns, alpha});
    sum.squared += row.squared, sum.preconditioned += row.preconditioned;
  }
  return sum;
}

/// Solves A step_ = residual_, using residual_ up. Returns whether it got there.
template <class R>
bool ImplicitSolver<R>::conjugate_gradients(const Cloth<R>& cloth) {
  for (Field* field : {&step_, &direction_, &product_}) std::fill(field->all().begin(), field->all().end(), R(0));
  Residual now = update(cloth, 0);
  const double enough = linear_tolerance * linear_tolerance * now.squared;
  const int most = 200 + 20 * (rows_ + cloth.lattice.columns);
  double before = std::numeric_limits<double>::infinity();
  for (int n = 0; n < most; ++n) {
    if (now.squared <= enough) return true;
    const double keep = now.preconditioned / before;
    for (int i = 0; i < rows_; ++i)
      add_scaled_row(preconditioned_.row(i), keep, direction_.row(i), int(direction_.pitch()));
    before = now.preconditioned;
    now = update(cloth, before / multiply(cloth));
    ++counts_.linear;
    if (!std::isfinite(now.squared)) return false;
  }
  return now.squared <= enough;
}

/// Solves A step_ = residual_, which it leaves as it is: by conjugate gradients; directly where those do not get there,
/// and from then on in this stage. Returns whether it is solved.
template <class R>
bool ImplicitSolver<R>::solve_linear(const Cloth<R>& cloth) {
  if (direct_ && solve_directly(cloth)) return true;
  before_ = residual_;
  const bool solved = conjugate_gradients(cloth);
  std::swap(residual_, before_);
  if (solved) return true;
  direct_ = !direct_ && factorises(cloth) && solve_directly(cloth);
  return direct_;
}

/// Particles within which all springs of one reach, when particles are numbered along the shorter side.
template <class R>
int reach(const Cloth<R>& cloth) {
  return 2 * std::min(cloth.lattice.rows, cloth.lattice.columns);
}

/// Whether a factorisation takes no more than about a second.
template <class R>
bool ImplicitSolver<R>::factorises(const Cloth<R>& cloth) const {
  if (cloth.preset.kind == Kind::one_weight) return false;
  return BandedCholesky::work(3.0 * cloth.lattice.size(), 3.0 * reach(cloth)) < 2e9;
}

/// A as a banded matrix, from what the springs have added to it.
template <class R>
void ImplicitSolver<R>::assemble(const Cloth<R>& cloth) {
  const Lattice& lattice = cloth.lattice;
  const bool along_rows = lattice.columns <= lattice.rows;
  const auto first = [&](int i, int j) { return 3 * (along_rows ? i * lattice.columns + j : j * lattice.rows + i); };
  const auto fixed = [&](int i, int j) {
    return !cloth.fixed.empty() && cloth.fixed[std::size_t(i) * lattice.columns + j] != 0;
  };
  matrix_.begin(3 * lattice.size(), 3 * reach(cloth) + 2);
  for (int n = 0; n < 3 * lattice.size(); ++n) matrix_.at(n, n) = mass_;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j)
      for (int d = 0; d < springs_of_a_particle; ++d) {
        if (!lattice.has_spring(d, i, j)) continue;
        const R* part = coefficients_.data() + i * coefficient_pitch(stride_) + d * spring_parts * stride_ + j +
                        std::min(0, directions[d].dj);
        const double a[3] = {double(part[0]), double(part[stride_]), double(part[2 * stride_])};
        const double t = double(part[3 * stride_]);
        const int oi = i + directions[d].di, oj = j + directions[d].dj;
        const bool owner = !fixed(i, j), other = !fixed(oi, oj);
        const int p = first(i, j), q = first(oi, oj);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            const double add = a[r] * a[c] + (r == c ? t : 0);
            if (owner && c <= r) matrix_.at(p + r, p + c) += add;
            if (other && c <= r) matrix_.at(q + r, q + c) += add;
            if (owner && other) matrix_.at(std::max(p, q) + r, std::min(p, q) + c) -= add;
          }
      }
}

template <class R>
bool ImplicitSolver<R>::solve_directly(const Cloth<R>& cloth) {
  assemble(cloth);
  if (!matrix_.factor()) return false;
  const Lattice& lattice = cloth.lattice;
  const bool along_rows = lattice.columns <= lattice.rows;
  right_side_.resize(3 * std::size_t(lattice.size()));
  const auto each = [&](const auto& what) {
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j)
        for (int c = 0; c < 3; ++c)
          what(i, j, c, right_side_[3 * std::size_t(along_rows ? i * lattice.columns + j : j * lattice.rows + i) + c]);
  };
  each([&](int i, int j, int c, double& b) {
    const bool fixed = !cloth.fixed.empty() && cloth.fixed[std::size_t(i) * lattice.columns + j] != 0;
    b = fixed ? 0 : double(residual_.row(i)[j + c * stride_]);
  });
  matrix_.solve(right_side_);
  each([&](int i, int j, int c, double& b) { step_.row(i)[j + c * stride_] = R(b); });
  return true;
}

template class ImplicitSolver<float>;
template class ImplicitSolver<double>;

}  // namespace tyglab::cpu
