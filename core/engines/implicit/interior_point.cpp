#include "core/engines/implicit/interior_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "core/engines/implicit/stiffness.h"
#include "core/model/preset.h"

namespace tyglab::implicit {
namespace {

constexpr int most_iterations = 100;
constexpr int most_gradients = 200;
constexpr double to_border = 0.995;  // of the way to where a tension or slack becomes 0
constexpr double predictor_tolerance = 0.05;
/// Springs that go slack or taut leave about half of the residual of a large cloth, however exactly a step is solved
/// for: there an iteration more is cheaper.
double corrector_tolerance(const Lattice& lattice) {
  return lattice.size() < 64 * 64 ? 0.02 : 0.1;
}
constexpr double least_centering = 0.01;

double sum(const std::vector<double>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

constexpr int rows_between_asking = 64;  // whether to stop
constexpr int rows_of_product = 2;  // above, which leave parts of a row's product in it, and below, of which it is made

}  // namespace

template <class R>
bool InteriorPoint<R>::resize(const Lattice& lattice, const std::function<bool()>& stops) {
  if (lattice_ == lattice) return true;
  lattice_ = {0, 0};  // until all of the memory is there
  const int rows = lattice.rows, fast = simd::row_stride<R>(lattice.columns);
  stride_ = simd::row_stride<double>(lattice.columns);
  // A page of new memory takes longer than the numbers on it.
  for (Field* field : {&c_, &y_, &x_, &best_, &forces_, &right_, &moved_}) {
    if (stops()) return false;
    field->resize(rows + 3, stride_);
  }
  const std::size_t stretch = std::size_t(rows) * stretch_directions * stride_ + simd::widest_vector;
  for (Array<double>* springs : {&tension_, &slack_, &d_tension_, &d_slack_}) {
    if (stops()) return false;
    springs->assign(stretch, springs == &tension_ || springs == &slack_ ? 1.0 : 0.0);
  }
  free_.assign(std::size_t(rows) * stride_, 0.0);
  for (RowField<R>* field : {&step_, &r_, &p_}) {
    if (stops()) return false;
    field->resize(rows + 3, fast);
  }
  for (std::vector<double>* sums : {&right_squares_, &left_squares_, &along_, &fall_})
    sums->assign(std::size_t(rows), 0);
  products_.clear();
  coefficients_.assign(std::size_t(rows) * coefficient_pitch(fast) + simd::widest_vector, R(0));
  if (stops() || !multigrid_.resize(lattice, fast, stops)) return false;
  lattice_ = lattice;
  return true;
}

/// Calls work(i) for every row, until it is to stop.
template <class R>
template <class Work>
void InteriorPoint<R>::for_rows(const Work& work) {
  for (int i = 0; i < lattice_.rows; ++i) {
    if (i % rows_between_asking == 0 && task_->stops()) return;
    work(i);
  }
}

template <class R>
std::size_t InteriorPoint<R>::bytes() const {
  std::size_t total = (coefficients_.size() + curving_.size()) * sizeof(R) + multigrid_.bytes();
  for (const Field* field : {&c_, &y_, &x_, &best_, &forces_, &right_, &moved_}) total += field->bytes();
  for (const Array<double>* springs : {&tension_, &slack_, &d_tension_, &d_slack_, &whole_, &free_})
    total += springs->size() * sizeof(double);
  for (const RowField<R>* field : {&step_, &r_, &p_}) total += field->bytes();
  for (const Products& products : products_) total += products.q.bytes();
  return total;
}

/// A row for each row of a torn cloth. The rows of an untorn one are alike but for the last two: there are three.
template <class R>
void InteriorPoint<R>::find_whole_springs() {
  const Tears& tears = *task_->tears;
  torn_ = !tears.untorn();
  const std::ptrdiff_t pitch = std::ptrdiff_t(directions.size()) * stride_;
  const int rows = torn_ ? lattice_.rows : std::min(lattice_.rows, 3);
  whole_.assign(std::size_t(rows * pitch), 0.0);
  springs_ = 0;
  for (int n = 0; n < rows; ++n) {
    const int i = torn_ ? n : lattice_.rows - rows + n;
    const double alike = torn_ || n > 0 ? 1 : lattice_.rows - rows + 1;
    for (int d = 0; d < int(directions.size()); ++d)
      for (int j = 0; j < lattice_.columns; ++j)
        if (lattice_.has_spring(d, i, j) && tears.whole(d, i, j)) {
          whole_[std::size_t(n * pitch + d * stride_ + j + std::min(0, directions[std::size_t(d)].dj))] = 1;
          if (d < stretch_directions) springs_ += alike;
        }
  }
}

/// The springs that are nowhere softer than what is linear in positions: those of its constants that pull together.
template <class R>
void InteriorPoint<R>::find_curving() {
  curving_.assign(task_->linear.empty() ? 0 : coefficients_.size(), R(0));
  const std::ptrdiff_t fast = fast_stride();
  for (int i = 0; i < lattice_.rows && !curving_.empty(); ++i)
    for (int d = 0; d < int(directions.size()); ++d) {
      const double* constants = task_->linear.row(i) + d * std::ptrdiff_t(stride_);
      R* across = curving_.data() + i * coefficient_pitch(fast) + (d * spring_parts + 3) * fast;
      for (int j = 0; j < lattice_.columns; ++j) across[j] = R(std::max(constants[j], 0.0));
    }
}

template <class R>
BarrierRow InteriorPoint<R>::row(int i) {
  const int rows = std::min(lattice_.rows, 3);
  const int pattern = torn_ ? i : std::max(0, i - (lattice_.rows - rows));
  assert(i >= 0 && i < lattice_.rows);
  assert((pattern + 1) * std::ptrdiff_t(directions.size()) * stride_ <= std::ptrdiff_t(whole_.size()));
  const std::ptrdiff_t at = std::ptrdiff_t(i) * stretch_directions * stride_;
  return {task_->constants,
          whole_.data() + std::ptrdiff_t(pattern) * std::ptrdiff_t(directions.size()) * stride_,
          task_->linear.row(i),
          x_.row(i),
          c_.row(i),
          tension_.data() + at,
          slack_.data() + at,
          d_tension_.data() + at,
          d_slack_.data() + at,
          stride_,
          lattice_.columns};
}

template <class R>
void InteriorPoint<R>::begin() {
  assert(task_->fixed.empty() || task_->fixed.size() >= std::size_t(lattice_.size()));
  find_whole_springs(), find_curving();
  size_ = 0;
  for_rows([&](int i) {
    for (int j = 0; j < lattice_.columns; ++j) {
      const std::size_t p = std::size_t(i) * lattice_.columns + j;
      free_[std::size_t(i) * stride_ + j] = task_->fixed.empty() || !task_->fixed[p];
      for (int c = 0; c < 3; ++c) size_ = std::max(size_, std::abs(x_.row(i, c)[j]));
    }
  });
  // About a hundredth of a spring's length under a third of the tension of a row of all particles.
  const double weight = std::max(task_->gravity, 1e-6 * task_->constants.L) * std::sqrt(double(lattice_.size()));
  const double mu = 0.3 * weight * 0.01 * task_->constants.L;
  assert(mu > 0);
  for_rows([&](int i) { begin_tensions(row(i), mu); });
}

template <class R>
double InteriorPoint<R>::linearize() {
  for (Field* field : {&forces_, &right_}) std::fill(field->all().begin(), field->all().end(), 0.0);
  if (task_->others) {
    task_->others(x_, forces_);
    right_ = forces_;
  }
  double products = 0;
  residual_ = 0, force_ = task_->weight;
  const std::ptrdiff_t fast = fast_stride();
  for_rows([&](int i) {
    const BarrierSums sums = linearize_row<R>(row(i), forces_.row(i), right_.row(i),
                                              coefficients_.data() + i * coefficient_pitch(fast), fast);
    products += sums.products, force_ = std::max(force_, sums.force);
    const double left = finish_row(x_.row(i), y_.row(i), free_.data() + std::ptrdiff_t(i) * stride_, forces_.row(i),
                                   right_.row(i), stride_, lattice_.columns);
    residual_ = left <= residual_ ? residual_ : left;  // which a number that is none becomes
  });
  ++counts_->force_evaluations;
  return products;
}

/// The residual that counts as none: the tolerance, or what the last digits of positions in double make of the forces.
template <class R>
double InteriorPoint<R>::allowed() const {
  const auto& stretch = task_->constants.stretch;
  const double stiffness =
      std::max(*std::max_element(stretch.begin(), stretch.end()), task_->constants.bend) + task_->linear_stiffness;
  const double digits = 4 * std::numeric_limits<double>::epsilon() * size_ * (1 + stiffness);
  return std::max(task_->tolerance * force_, digits);
}

/// Calls work(number) on as many threads as pay now, each of which has its rows, unless it is to stop. Returns how long
/// that took, s.
template <class R>
template <class Work>
double InteriorPoint<R>::together(const Work& work) {
  const int size = task_->crew.size();
  assert(size >= 1);
  multigrid_.share(task_->crew, size, task_->stops);
  if (task_->stops()) return 0;
  const int threads = multigrid_.threads();
  if (int(products_.size()) != threads) {
    std::vector<Products> all(std::size_t(threads), Products{});
    for (int n = 0; n < threads; ++n) {
      Products& products = all[std::size_t(n)];
      const RowRange own = multigrid_.rows_of(n);
      products.first = std::max(own.begin - rows_of_product, 0);
      products.q.resize(own.end - products.first + 3, int(fast_stride()));
    }
    products_ = std::move(all);
  }
  const double begun = wall_seconds();
  if (threads > 1)
    task_->crew.run(work);
  else
    work(0);
  return wall_seconds() - begun;
}

/// Of a thread's rows: r_ = right_ - A step_, or right_ where step_ is not `warm`.
template <class R>
void InteriorPoint<R>::subtract_product(int number, bool warm) {
  Products& products = products_[std::size_t(number)];
  const RowRange own = multigrid_.rows_of(number);
  if (!warm) std::fill(step_.row(own.begin), step_.row(own.end), R(0));
  for (int i = products.first; i < own.end; ++i) {
    const RowField<R>& q = products.q;
    const int at = i - products.first;
    if (warm) multiply(products, step_, i);
    if (i < own.begin) continue;
    const double* free = free_.data() + std::ptrdiff_t(i) * stride_;
    double whole = 0, left = 0;
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < lattice_.columns; ++j) {
        const double b = free[j] * right_.row(i, c)[j], r = b - (warm ? free[j] * double(q.row(at, c)[j]) : 0);
        r_.row(i, c)[j] = R(r), whole += b * b, left += r * r;
      }
    right_squares_[std::size_t(i)] = whole, left_squares_[std::size_t(i)] = left;
  }
}

/// Row i of a thread's A p.
template <class R>
void InteriorPoint<R>::multiply(Products& products, const RowField<R>& p, int i) {
  multiply_row(ProductTask<R>{coefficients_.data() + i * coefficient_pitch(fast_stride()), p.row(i),
                              products.q.row(i - products.first), fast_stride(), lattice_.columns, i == products.first,
                              1});
}

/// Of a thread's rows: p_ = z + keep p_, and then q = A p_. The product follows the sums through the rows, but for the
/// first and last of a thread, which its neighbors need too.
template <class R>
void InteriorPoint<R>::make_product(int number, const RowField<R>& z, double keep) {
  Products& products = products_[std::size_t(number)];
  const RowRange own = multigrid_.rows_of(number);
  const int count = int(p_.pitch());
  const auto add = [&](int i) { add_scaled_row(z.row(i), keep, p_.row(i), count); };
  RowRange later = own;
  if (multigrid_.threads() > 1) {
    assert(own.end - own.begin >= 2 * rows_of_product);  // or rows would be added twice
    for (int n = 0; n < rows_of_product; ++n) add(own.begin + n), add(own.end - 1 - n);
    later = {own.begin + rows_of_product, own.end - rows_of_product};
    task_->crew.barrier();
  }
  for (int i = products.first - rows_of_product; i < own.end; ++i) {
    if (const int below = i + rows_of_product; below >= later.begin && below < later.end) add(below);
    if (i < products.first) continue;
    multiply(products, p_, i);
    if (i >= own.begin)
      along_[std::size_t(i)] = dot_row(p_.row(i), std::as_const(products.q).row(i - products.first), count);
  }
}

/// A step of conjugate gradients, of one thread. All use the same sums, each over all rows in their order.
template <class R>
void InteriorPoint<R>::descend(int number, bool first) {
  const auto meet = [&] {
    if (multigrid_.threads() > 1) task_->crew.barrier();
  };
  const RowRange own = multigrid_.rows_of(number);
  const RowField<R>& z = multigrid_.precondition(r_, number);
  for (int i = own.begin; i < own.end; ++i) fall_[std::size_t(i)] = dot_row(r_.row(i), z.row(i), int(r_.pitch()));
  meet();
  const double fall = sum(fall_);
  make_product(number, z, first ? 0 : fall / last_fall_);
  meet();
  const double along = sum(along_);
  if (number == 0) next_fall_ = fall, falls_ = along > 0;
  if (!(along > 0)) return;
  Products& products = products_[std::size_t(number)];
  for (int i = own.begin; i < own.end; ++i)
    left_squares_[std::size_t(i)] =
        multigrid_.descend(fall / along, p_.row(i), products.q.row(i - products.first), step_.row(i), r_.row(i), i);
}

/// Solves A step_ = right_ by conjugate gradients, from the present step_ on if it is `warm`.
template <class R>
bool InteriorPoint<R>::solve_linear(double tolerance, bool warm) {
  together([&](int number) { subtract_product(number, warm); });
  const double enough = tolerance * tolerance * sum(right_squares_);
  double left = sum(left_squares_);
  for (int n = 0; left > enough; ++n) {
    if (n == most_gradients || !std::isfinite(left) || task_->stops() ||
        (n > 0 && task_->out_of_time(best_balance_.residual)))
      return false;
    const double seconds = together([&](int number) { descend(number, n == 0); });
    if (lattice_.rows >= Multigrid<R>::shared_rows(2)) task_->crew.worked(seconds);
    if (!falls_) return false;
    last_fall_ = next_fall_;
    left = sum(left_squares_);
    ++counts_->linear;
  }
  return true;
}

template <class R>
BarrierStep InteriorPoint<R>::find_step(bool corrects, double mu) {
  const int columns = lattice_.columns;
  for_rows([&](int i) {
    for (int c = 0; c < 3; ++c) std::copy_n(step_.row(i, c), columns, moved_.row(i, c));
  });
  BarrierStep all{};
  for_rows([&](int i) {
    const BarrierStep one = step_row(row(i), moved_.row(i), corrects, mu);
    all.tension = std::max(all.tension, one.tension), all.slack = std::max(all.slack, one.slack);
    all.with_slack += one.with_slack, all.with_tension += one.with_tension, all.both += one.both;
  });
  return all;
}

template <class R>
void InteriorPoint<R>::advance(double primal, double dual) {
  assert(!(primal < 0) && !(primal > 1) && !(dual < 0) && !(dual > 1));
  const auto add = [](std::span<double> to, std::span<const double> step, double part) {
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += part * step[n];
  };
  add(x_.all(), moved_.all(), primal);
  add(tension_, d_tension_, dual);
  add(slack_, d_slack_, primal);
}

template <class R>
Balance InteriorPoint<R>::solve(const Task& task, SolveCounts& counts) {
  task_ = &task, counts_ = &counts;
  assert(task.tears != nullptr && task.tolerance > 0);
  assert(task.constants.L > 0 && *std::min_element(task.constants.stretch.begin(), task.constants.stretch.end()) > 0 &&
         task.constants.bend >= 0);
  begin();
  best_balance_ = {false, std::numeric_limits<double>::infinity()};
  const auto part_of = [](double most) { return std::min(1.0, to_border / most); };
  double least = std::numeric_limits<double>::infinity(), first = 0;
  const double corrector = corrector_tolerance(lattice_);
  for (int n = 0;; ++n) {
    const double products = linearize(), mu = products / std::max(springs_, 1.0);
    if (task.stops()) return {};
    assert(!(mu < 0));  // tensions and slacks stay positive
    if (residual_ < least) least = residual_, best_balance_ = {false, residual_ / force_}, best_ = x_;
    if (n == 0) first = residual_;
    if (residual_ <= allowed()) return {true, residual_ / force_};
    if (n == most_iterations || !std::isfinite(residual_) || (n > 0 && task.out_of_time(best_balance_.residual))) break;
    task.progress(std::clamp(std::log(first / least) / std::log(first / allowed()), double(n) / most_iterations, 1.0));
    multigrid_.prepare({coefficients_.data(), 1, task.fixed, task.linear.empty() ? 2 : Stencil::most_points,
                        curving_.empty() ? nullptr : curving_.data()},
                       task.stops);
    ++counts.newton;
    solve_linear(predictor_tolerance, false);
    const BarrierStep predicted = find_step(false, 0);
    if (task.stops()) return {};
    const double p = std::min(1.0, 1 / predicted.slack), d = std::min(1.0, 1 / predicted.tension);
    const double left = products + p * predicted.with_slack + d * predicted.with_tension + p * d * predicted.both;
    const double ratio = std::clamp(left / products, 0.0, 1.0);
    const double goal = std::max(ratio * ratio, least_centering) * mu;
    for_rows([&](int i) { correct_row(row(i), goal, right_.row(i)); });
    solve_linear(corrector, true);
    const BarrierStep step = find_step(true, goal);
    if (task.stops()) return {};
    advance(part_of(step.slack), part_of(step.tension));
  }
  x_ = best_;
  return best_balance_;
}

template class InteriorPoint<float>;
template class InteriorPoint<double>;

}  // namespace tyglab::implicit
