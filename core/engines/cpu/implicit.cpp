#include "core/engines/cpu/implicit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/force.h"

namespace tyglab::cpu {

using namespace implicit;

namespace {

static_assert(springs_of_a_particle == int(directions.size()));

constexpr int rows_between_asking = 64;  // whether to stop

/// Where layers rest on each other a stage begins near its solution, and what is left of its residual is not worth the
/// iterations that take all of it: the part of the weight of a particle that may stay.
template <class R>
constexpr double enough_beside() {
  return 0.1 * balance_tolerance<R>;
}

}  // namespace

template <class R>
bool ImplicitSolver<R>::stops_before(int row) {
  return row % rows_between_asking == 0 && stops();
}

/// Calls what(begin, end) for parts of that many elements of a field, and asks before each. Returns false where it was
/// stopped.
template <class R>
template <class What>
bool ImplicitSolver<R>::in_parts(std::size_t count, const What& what) {
  const std::size_t part = std::size_t(rows_between_asking) * 3 * std::size_t(cloth().stride);
  for (std::size_t begin = 0; begin < count; begin += part) {
    if (stops()) return false;
    what(begin, std::min(begin + part, count));
  }
  return !stops();
}

/// Zeros, whose memory the system hands out page by page: of a large cloth that takes seconds.
template <class R>
bool ImplicitSolver<R>::take_zeros(Array<R>& array, std::size_t count) {
  array.clear();
  array.reserve(count);
  return in_parts(count, [&](std::size_t, std::size_t end) { array.resize(end, R(0)); });
}

template <class R>
bool ImplicitSolver<R>::copy(const Field& from, Field& to) {
  assert(from.all().size() == to.all().size());
  return in_parts(from.all().size(), [&](std::size_t begin, std::size_t end) {
    std::copy_n(from.all().begin() + begin, end - begin, to.all().begin() + begin);
  });
}

template <class R>
bool ImplicitSolver<R>::resize() {
  if (rows_ == cloth().lattice.rows && stride_ == cloth().stride) return true;
  const int rows = cloth().lattice.rows, stride = cloth().stride;
  for (Field* field : {&start_x_, &start_v_, &acceleration_, &residual_}) {
    if (stops()) return false;
    field->resize(rows + 3, stride);
  }
  rows_ = rows, stride_ = stride;  // now that all of the memory is there
  return true;
}

/// What only Newton's method needs. Returns false where it was stopped on the way.
template <class R>
bool ImplicitSolver<R>::resize_newton() {
  const std::size_t blocks = std::size_t(rows_ + 2) * 6 * stride_;
  if (blocks_.size() == blocks) return true;
  for (Field* field : {&before_, &step_, &direction_, &product_, &preconditioned_}) {
    if (stops()) return false;
    field->resize(rows_ + 3, stride_);
  }
  return take_zeros(coefficients_, std::size_t(rows_) * coefficient_pitch(stride_)) &&
         take_zeros(blocks_, blocks);  // the last, whose size says that all of the memory is there
}

template <class R>
std::size_t ImplicitSolver<R>::bytes() const {
  std::size_t total = (blocks_.size() + coefficients_.size()) * sizeof(R);
  for (const Field* field :
       {&start_x_, &start_v_, &acceleration_, &before_, &residual_, &step_, &direction_, &product_, &preconditioned_})
    total += field->bytes();
  total += couplings_.capacity() * sizeof(Coupling);
  return total + kept_.bytes() + direct_.bytes() + stiff_.bytes() + global_.bytes();
}

template <class R>
double ImplicitSolver<R>::inner(const Field& a, const Field& b) {
  assert(a.pitch() == b.pitch());
  double sum = 0;  // row by row in double: one sum of a large cloth in float would lose digits
  for (int i = 0; i < rows_ && !stops_before(i); ++i) sum += dot_row(a.row(i), b.row(i), int(a.pitch()));
  return sum;
}

template <class R>
bool ImplicitSolver<R>::solve(Cloth<R>& cloth, int position, int velocity, double dt, const Tears& tears,
                              const Accelerations& accelerations, const Watch& watch, Way way) {
  assert(dt > 0 && position != velocity);
  if (!begin_stage(cloth, position, velocity, &watch)) return false;
  task_.dt = dt, task_.tears = &tears, task_.accelerations = &accelerations, air_ = way.air, beside_ = way.beside;
  // A mass on a spring is linear: Newton's method solves it in one step.
  const bool alternates = way.solver == Solver::alternation && cloth.preset.kind == Kind::cloth;
  if (alternates)
    alternate(way.changed);
  else if (beside_ != nullptr)
    solve_beside();
  else
    solve_either_way(*this, cloth.preset, dt, too_slow_);
  if (!left_to_passes_ && !stopped_) note_balance(judged_);
  return !stopped_;
}

template <class R>
void ImplicitSolver<R>::note_balance(const Balance& balance) {
  assert(!(balance.residual < 0));
  solved_ = both(solved_, balance);
  if (late_ && !balance.found()) counts_.ended_early += !std::exchange(counted_, true);
}

template <class R>
bool ImplicitSolver<R>::begin_stage(Cloth<R>& cloth, int position, int velocity, const Watch* watch) {
  task_ = {&cloth, position, velocity, 0, nullptr, nullptr, watch}, beside_ = nullptr;
  stopped_ = left_to_passes_ = false;
  return resize() && copy(this->position(), start_x_) && copy(this->velocity(), start_v_);
}

template <class R>
void ImplicitSolver<R>::measure_stage(double dt, const Tears& tears, const Accelerations& accelerations,
                                      const Watch& watch, int passes) {
  assert(task_.cloth != nullptr && dt > 0 && passes >= 0);
  task_.dt = dt, task_.tears = &tears, task_.accelerations = &accelerations, task_.watch = &watch;
  evaluate();
  counts_.newton += passes, counts_.force_evaluations += 2 * passes + 1;  // before and after each particle's step
  note_balance(balance());
}

template <class R>
Balance ImplicitSolver<R>::solve_by_newton() {
  if (!resize_newton()) return {};
  return tyglab::solve(*this,
                       {cloth().preset.iterations, newton_tolerance<R>, std::numeric_limits<R>::epsilon(), task_.dt,
                        beside_ == nullptr || !beside_->renew
                            ? 0
                            : enough_beside<R>() * weight_scale(cloth().preset.g, task_.dt) / task_.dt},
                       counts_);
}

/// Newton's method, and again with what has come near on its way until forces balance.
template <class R>
Balance ImplicitSolver<R>::solve_beside() {
  constexpr int most_passes = 5;
  Balance found = solve_by_newton();
  for (int n = 1; n < most_passes && beside_->renew && cloth().preset.iterations > 1; ++n) {
    if (stops() || out_of_time()) break;
    beside_->renew();
    evaluate(), found = balance(), ++counts_.force_evaluations;
    if (found.found()) break;
    found = solve_by_newton();
  }
  return found;
}

/// Projective dynamics: with each spring's nearest vector of an allowed length, the energy is quadratic, and the next
/// positions make it least. In terms of the residual r that is A s = r, where A depends on no position (global_step.h).
template <class R>
Balance ImplicitSolver<R>::alternate(bool changed) {
  const int most = cloth().preset.iterations;
  if (!global_.prepare(cloth(), *task_.tears, task_.dt, changed, [this] { return stops(); })) return {};
  evaluate();
  ++counts_.force_evaluations;
  for (int n = 0; n < most; ++n) {
    note_progress(double(n) / most);
    if (stops()) return {};
    if (n > 0 && out_of_time()) break;
    counts_.linear += global_.solve(residual_, [this] { return stops(); });
    if (stopped_) return {};
    const std::span<R> v = velocity().all();
    for (std::size_t k = 0; k < v.size(); ++k) v[k] += residual_.all()[k];
    evaluate();
    ++counts_.newton, ++counts_.force_evaluations;
  }
  return balance();
}

template <class R>
Balance ImplicitSolver<R>::solve_quickly() {
  position() = start_x_, velocity() = start_v_;
  left_to_passes_ = true;
  return {true, 0};  // until it is measured
}

template <class R>
Balance ImplicitSolver<R>::solve_stiff() {
  const implicit::StiffTask<R> stage{.preset = cloth().preset,
                                     .lattice = cloth().lattice,
                                     .tears = *task_.tears,
                                     .fixed = cloth().fixed,
                                     .h = task_.dt,
                                     .c_x = start_x_.row(0),
                                     .c_v = start_v_.row(0),
                                     .air = air_ == nullptr ? nullptr : air_->row(0),
                                     .x = cloth().vector(vector_x).row(0),
                                     .v = velocity().row(0),
                                     .stride = stride_,
                                     .stops = [this] { return stops(); },
                                     .out_of_time = [this](double best) { return is_over(stiff_share(best)); },
                                     .progress = [this](double part) { note_progress(part); },
                                     .crew = task_.watch->crew};
  const Balance balance = stiff_.solve(stage, counts_);
  // What was found in double may be less well balanced in the precision in which it is kept.
  if (!stopped_) evaluate(), this->balance();
  return balance;
}

template <class R>
Balance ImplicitSolver<R>::balance() {
  if (stops()) return {};
  return judged_ =
             balance_of(StageView<R>{cloth().preset, cloth().lattice, *task_.tears, cloth().fixed, task_.dt,
                                     position().row(0), velocity().row(0), start_v_.row(0), residual_.row(0), stride_});
}

template <class R>
double ImplicitSolver<R>::start_size() {
  return std::sqrt(inner(start_x_, start_x_));
}

template <class R>
double ImplicitSolver<R>::evaluate() {
  const std::span<R> x = position().all(), v = velocity().all();
  assert(x.size() == start_x_.all().size() && v.size() == start_v_.all().size());
  const R h = R(task_.dt);
  const bool moved = in_parts(x.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) x[n] = start_x_.all()[n] + h * v[n];
  });
  if (!moved) return 0;
  (*task_.accelerations)(acceleration_);
  const std::span<R> r = residual_.all();
  assert(r.size() == v.size() && acceleration_.all().size() == v.size());
  in_parts(r.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) r[n] = h * acceleration_.all()[n] - (v[n] - start_v_.all()[n]);
  });
  // As a force, of which a lighter particle needs less.
  if (beside_ != nullptr)
    for (const Lighter& one : beside_->lighter)
      for (int c = 0; c < 3; ++c) residual_.row(0)[one.at + c * stride_] *= R(one.share);
  return std::sqrt(inner(residual_, residual_));
}

template <class R>
ImplicitStage::Step ImplicitSolver<R>::step() {
  copy(velocity(), before_);
  return {inner(residual_, step_), std::sqrt(inner(step_, step_))};
}

template <class R>
ImplicitStage::Trial ImplicitSolver<R>::try_part(double part) {
  const std::span<R> v = velocity().all();
  assert(!(part < 0) && !(part > 1));
  assert(before_.all().size() == v.size() && step_.all().size() == v.size());
  in_parts(v.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) v[n] = before_.all()[n] + R(part) * step_.all()[n];
  });
  const double norm = evaluate();
  return {norm, inner(residual_, step_)};
}

template <class R>
void ImplicitSolver<R>::linearize() {
  in_parts(blocks_.size(),
           [&](std::size_t begin, std::size_t end) { std::fill_n(blocks_.begin() + begin, end - begin, R(0)); });
  const bool weight = cloth().preset.kind == Kind::one_weight;
  mass_ = own_stiffness(cloth().preset, task_.dt);
  for (int i = 0; i < rows_ && !stops_before(i); ++i)
    for (int c = 0; c < 3; ++c) std::fill_n(block(i) + c * stride_, cloth().lattice.columns, R(mass_));
  if (!weight)
    for (int i = 0; i < rows_ && !stops(); ++i)
      for (int d = 0; d < springs_of_a_particle; ++d) linearize_row(d, i);
  if (beside_ != nullptr) add_couplings();
  invert_blocks();
}

/// What is beside the lattice: its couplings, and what they and lighter particles add to the blocks.
template <class R>
void ImplicitSolver<R>::add_couplings() {
  beside_->couplings(task_.dt, couplings_);
  const std::ptrdiff_t pitch = start_x_.pitch();
  const auto block_at = [&](std::ptrdiff_t at) { return block(int(at / pitch)) + at % pitch; };
  for (const Lighter& one : beside_->lighter)
    for (int c = 0; c < 3; ++c) block_at(one.at)[c * stride_] += R((one.share - 1) * mass_);
  for (const Coupling& one : couplings_) {
    const glm::dvec3& n = one.along;
    const double add[6] = {one.all + one.extra * n.x * n.x, one.all + one.extra * n.y * n.y,
                           one.all + one.extra * n.z * n.z, one.extra * n.y * n.z,
                           one.extra * n.z * n.x,           one.extra * n.x * n.y};
    for (int p = 0; p < one.points; ++p) {
      const double squared = one.weights[std::size_t(p)] * one.weights[std::size_t(p)];
      R* to = block_at(one.at[std::size_t(p)]);
      for (int c = 0; c < 6; ++c) to[c * stride_] += R(squared * add[c]);
    }
  }
}

/// The springs of a row in one direction: their coefficients, and what they add to the blocks of both ends.
template <class R>
void ImplicitSolver<R>::linearize_row(int d, int i) {
  assert(d >= 0 && d < springs_of_a_particle && i >= 0 && i < rows_);
  const Direction& to = directions[d];
  R* part = coefficients_.data() + i * coefficient_pitch(stride_) + d * spring_parts * stride_;
  std::fill_n(part, spring_parts * stride_, R(0));
  if (i + to.di >= rows_) return;
  const Preset& p = cloth().preset;
  const Field& x = position();
  const double dt = task_.dt;
  const R rest = R(to.rest * p.L), k = R(dt * dt * spring_constant(p, to) / p.m);
  const R damped = to.bending ? R(0) : R(dt * p.k_d / p.m), least = R(1e-9) * rest;
  // Stored at the lower end of a spring to the lower left, at the owner otherwise.
  const int shift = to.dj == -1 ? 1 : 0, columns = cloth().lattice.columns - std::abs(to.dj);
  const R *upper = x.row(i) + shift, *lower = x.row(i + to.di) + (shift ? 0 : to.dj);
  const R* linear = cloth().springs.row(i);
  if (linear != nullptr) linear += d * stride_;
  const R per = R(dt * dt / p.m);
  R *one = block(i) + shift, *other = block(i + to.di) + (shift ? 0 : to.dj);
  for (int j = 0; j < columns; ++j) {
    if (!task_.tears->whole(d, i, j + shift)) continue;
    const R dx = lower[j] - upper[j], dy = lower[j + stride_] - upper[j + stride_],
            dz = lower[j + 2 * stride_] - upper[j + 2 * stride_];
    const R length = std::sqrt(dx * dx + dy * dy + dz * dz);
    R t = linear == nullptr ? damped : damped + per * linear[j], along = 0;  // along: of a = along · unit vector
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
void ImplicitSolver<R>::invert_blocks() {
  for (int i = 0; i < rows_ && !stops(); ++i) {
    R* b = block(i);
    for (int j = 0; j < cloth().lattice.columns; ++j) {
      R *xx = b + j, *yy = xx + stride_, *zz = yy + stride_, *yz = zz + stride_, *zx = yz + stride_, *xy = zx + stride_;
      const R cx = *yy * *zz - *yz * *yz, cy = *zx * *yz - *xy * *zz, cz = *xy * *yz - *yy * *zx;
      const R per = 1 / (*xx * cx + *xy * cy + *zx * cz);
      const R ix = cx * per, iy = (*xx * *zz - *zx * *zx) * per, iz = (*xx * *yy - *xy * *xy) * per;
      const R iyz = (*xy * *zx - *xx * *yz) * per;
      *xx = ix, *yy = iy, *zz = iz, *yz = iyz, *zx = cz * per, *xy = cy * per;
    }
    for (int n = cloth().fixed_begin[i]; n < cloth().fixed_begin[i + 1]; ++n)
      for (int c = 0; c < 6; ++c) b[cloth().fixed_columns[n] + c * stride_] = R(0);
  }
}

/// product_ = A direction_; returns their inner product.
template <class R>
double ImplicitSolver<R>::multiply() {
  double sum = 0;
  for (int i = 0; i < rows_ && !stops_before(i); ++i)
    sum += multiply_row(ProductTask<R>{coefficients_.data() + i * coefficient_pitch(stride_), direction_.row(i),
                                       product_.row(i), stride_, cloth().lattice.columns, i == 0, mass_});
  return beside_ == nullptr ? sum : sum + multiply_beside();
}

/// Adds what is beside the lattice to that product; returns its part of the inner product.
template <class R>
double ImplicitSolver<R>::multiply_beside() {
  double sum = 0;
  const R* p = direction_.row(0);
  R* q = product_.row(0);
  for (const Lighter& one : beside_->lighter)
    for (int c = 0; c < 3; ++c) {
      const std::ptrdiff_t at = one.at + c * stride_;
      const double lacks = (one.share - 1) * mass_ * double(p[at]);
      q[at] += R(lacks), sum += lacks * double(p[at]);
    }
  for (const Coupling& one : couplings_) {
    glm::dvec3 u{0};
    for (int n = 0; n < one.points; ++n)
      for (int c = 0; c < 3; ++c) u[c] += one.weights[std::size_t(n)] * double(p[one.at[std::size_t(n)] + c * stride_]);
    const glm::dvec3 resists = one.all * u + one.extra * glm::dot(one.along, u) * one.along;
    for (int n = 0; n < one.points; ++n)
      for (int c = 0; c < 3; ++c)
        q[one.at[std::size_t(n)] + c * stride_] += R(one.weights[std::size_t(n)] * resists[c]);
    sum += glm::dot(u, resists);
  }
  return sum;
}

template <class R>
Residual ImplicitSolver<R>::update(double alpha) {
  Residual sum{0, 0};
  for (int i = 0; i < rows_ && !stops_before(i); ++i) {
    const Residual row =
        update_row(UpdateTask<R>{direction_.row(i), product_.row(i), block(i), step_.row(i), residual_.row(i),
                                 preconditioned_.row(i), stride_, cloth().lattice.columns, alpha});
    sum.squared += row.squared, sum.preconditioned += row.preconditioned;
  }
  return sum;
}

/// Solves A step_ = residual_, using residual_ up. Returns whether it got there.
template <class R>
bool ImplicitSolver<R>::conjugate_gradients() {
  for (Field* field : {&step_, &direction_, &product_})
    in_parts(field->all().size(),
             [&](std::size_t begin, std::size_t end) { std::fill_n(field->all().begin() + begin, end - begin, R(0)); });
  Residual now = update(0);
  const double enough = linear_tolerance * linear_tolerance * now.squared;
  const int most = max_gradient_steps(cloth().lattice);
  double before = std::numeric_limits<double>::infinity();
  for (int n = 0; n < most; ++n) {
    if (now.squared <= enough) return true;
    if (stops() || (n > 0 && out_of_time())) return false;
    const double keep = now.preconditioned / before;
    for (int i = 0; i < rows_ && !stops_before(i); ++i)
      add_scaled_row(preconditioned_.row(i), keep, direction_.row(i), int(direction_.pitch()));
    before = now.preconditioned;
    now = update(before / multiply());
    if (stops()) return false;
    ++counts_.linear;
    note_gradients(double(n + 1) / most);
    if (!std::isfinite(now.squared)) return false;
  }
  return now.squared <= enough;
}

template <class R>
bool ImplicitSolver<R>::gradients() {
  if (!copy(residual_, before_)) return false;
  const bool solved = conjugate_gradients();
  std::swap(residual_, before_);
  return solved;
}

template <class R>
bool ImplicitSolver<R>::solve_directly() {
  const Lattice& lattice = cloth().lattice;
  if (cloth().preset.kind == Kind::one_weight || beside_ != nullptr || !DirectSolver::is_quick(lattice)) return false;
  const auto fixed = [&](int i, int j) {
    return !cloth().fixed.empty() && cloth().fixed[std::size_t(i) * lattice.columns + j] != 0;
  };
  const auto spring = [&](int d, int i, int j) -> SpringStiffness {
    const R* part = coefficients_.data() + i * coefficient_pitch(stride_) + d * spring_parts * stride_ + j +
                    std::min(0, directions[d].dj);
    return {{part[0], part[stride_], part[2 * stride_]}, part[3 * stride_]};
  };
  const auto right_side = [&](int i, int j, int c) { return double(residual_.row(i, c)[j]); };
  return direct_.solve(
      {lattice, mass_, fixed, spring, right_side}, [&](int i, int j, int c, double s) { step_.row(i, c)[j] = R(s); },
      task_.watch->stop);
}

template class ImplicitSolver<float>;
template class ImplicitSolver<double>;

}  // namespace tyglab::cpu
