#include "core/engines/opencl/device_solver.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/engines/opencl/device.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"

namespace tyglab::opencl {
namespace {

constexpr int spring_parts = 4, block_parts = 6;  // as in implicit.cl
constexpr int particle_parts = spring_parts * int(directions.size());

}  // namespace

template <class R>
typename DeviceSolver<R>::Kernels DeviceSolver<R>::make_kernels(const Program& program) {
  return {program.kernel("linearise"),     program.kernel("gradients"), program.kernel("begin_gradients"),
          program.kernel("multiply"),      program.kernel("update"),    program.kernel("go"),
          program.kernel("inner_products")};
}

template <class R>
DeviceSolver<R>::DeviceSolver(std::shared_ptr<Device> device, const Lattice& lattice, DeviceState<R>& state, int width)
    : device_(std::move(device)), lattice_(lattice), state_(state), width_(width) {
  constexpr int particles_of_a_group = 2048, groups_of_a_unit = 4;
  const int units = int(device_->facts().compute_units);
  const int useful = lattice.size() / (width_ == 1 ? group_items : particles_of_a_group);
  groups_ = std::size_t(std::clamp(useful, 1, groups_of_a_unit * units));
  at_once_ = lattice.size() <= most_at_once(width_);
  const std::size_t row = std::size_t(state_.mask_pitch()), rows = std::size_t(lattice.rows) + 5, margin = 32;
  coefficient_numbers_ = rows * particle_parts * row + margin, block_numbers_ = rows * block_parts * row + margin;
  for (Memory* field : {&start_x_, &start_v_, &residual_, &step_, &left_, &preconditioned_, &product_, &directions_[0],
                        &directions_[1]})
    *field = state_.field();
  coefficients_ = device_->zeros(coefficient_numbers_ * sizeof(R)),
  blocks_ = device_->zeros(block_numbers_ * sizeof(R));
  const bool fp64 = device_->facts().fp64;
  const std::size_t progress = fp64 ? sizeof(DeviceGradients<double>) : sizeof(DeviceGradients<float>);
  for (Memory& memory : progress_) memory = device_->zeros(groups_ * progress);
  sums_ = device_->zeros(3 * groups_ * (fp64 ? sizeof(double) : sizeof(float)));
}

template <class R>
std::size_t DeviceSolver<R>::bytes() const {
  constexpr std::size_t fields = 9;
  return (fields * state_.numbers() + coefficient_numbers_ + block_numbers_) * sizeof(R) + direct_.bytes() +
         stiff_.bytes();
}

template <class R>
bool DeviceSolver<R>::solve(const Task& task) {
  assert(task.h > 0 && task.position != task.velocity && task.fixed != nullptr);
  task_ = task;
  stopped_ = false;
  const int position = task.position, velocity = task.velocity;
  state_.copy(state_.vector(position), start_x_.get()), state_.copy(state_.vector(velocity), start_v_.get());
  read_scene();
  solve_either_way(*this, *task.preset, task.h, too_slow_);
  if (!stopped_) solved_ = both(solved_, judged_);
  return !stopped_;
}

template <class R>
void DeviceSolver<R>::read_scene() {
  tears_ = Tears(lattice_);
  state_.download(tears_);
  fixed_.assign(std::size_t(lattice_.size()), 0);
  for (const int p : *task_.fixed) {
    assert(p >= 0 && p < lattice_.size());
    fixed_[std::size_t(p)] = 1;
  }
}

template <class R>
void DeviceSolver<R>::keep() {
  if (!kept_) kept_ = state_.field();
  state_.copy(state_.vector(task_.velocity), kept_.get());
}

template <class R>
void DeviceSolver<R>::restore() {
  assert(kept_);
  state_.copy(kept_.get(), state_.vector(task_.velocity));
  evaluate();
  arrive();
  balance();
}

template <class R>
Balance DeviceSolver<R>::solve_by_newton() {
  const NewtonRules rules{task_.preset->iterations, newton_tolerance<R>, std::numeric_limits<R>::epsilon(), task_.h};
  const Balance balance = tyglab::solve(*this, rules, counts_);
  arrive();
  return balance;
}

template <class R>
Balance DeviceSolver<R>::solve_stiff() {
  const cl_mem c_x = start_x_.get(), c_v = start_v_.get(), x = state_.vector(vector_x),
               v = state_.vector(task_.velocity);
  R *const c_x_rows = state_.map(c_x, CL_MAP_READ), *const c_v_rows = state_.map(c_v, CL_MAP_READ),
           *const x_rows = state_.map(x, CL_MAP_READ), *const v_rows = state_.map(v, CL_MAP_READ | CL_MAP_WRITE);
  implicit::Crew alone;
  const Balance balance = stiff_.solve(
      implicit::StiffTask<R>{*task_.preset, lattice_, tears_, fixed_, task_.h, c_x_rows, c_v_rows, nullptr, x_rows,
                             v_rows, state_.stride(), [this] { return stops(); }, [](double) { return false; },
                             [this](double part) { note_progress(part); }, alone},
      counts_);
  state_.unmap(c_x, c_x_rows), state_.unmap(c_v, c_v_rows), state_.unmap(x, x_rows), state_.unmap(v, v_rows);
  // What was found in double may be less well balanced in the precision in which it is kept.
  if (!stopped_) evaluate(), arrive(), this->balance();
  return balance;
}

template <class R>
Balance DeviceSolver<R>::balance() {
  const cl_mem x = state_.vector(task_.position), residual = residual_.get(), c_v = start_v_.get(),
               v = away_ ? state_.other(task_.velocity) : state_.vector(task_.velocity);
  R *const x_rows = state_.map(x, CL_MAP_READ), *const residual_rows = state_.map(residual, CL_MAP_READ),
           *const v_rows = state_.map(v, CL_MAP_READ), *const c_v_rows = state_.map(c_v, CL_MAP_READ);
  judged_ = balance_of(StageView<R>{*task_.preset, lattice_, tears_, fixed_, task_.h, x_rows, v_rows, c_v_rows,
                                    residual_rows, state_.stride()});
  state_.unmap(x, x_rows), state_.unmap(residual, residual_rows);
  state_.unmap(v, v_rows), state_.unmap(c_v, c_v_rows);
  return judged_;
}

template <class R>
void DeviceSolver<R>::launch(const Kernel& kernel, std::size_t groups) const {
  assert(groups >= 1 && groups <= groups_);
  const std::size_t local = width_ == 1 ? group_items : 1, global = groups * local;
  check(clEnqueueNDRangeKernel(device_->queue(), kernel.get(), 1, nullptr, &global, &local, 0, nullptr, nullptr),
        "starting a kernel");
}

template <class R>
int DeviceSolver<R>::set_system(const Kernel& kernel) const {
  const Preset& p = *task_.preset;
  const double h = task_.h, L = p.L;
  constexpr double shortest = 1e-9;  // as in spring-inl.h
  const auto [weft, warp, shear, bend] = spring_constants(p);
  const DeviceLinear<R> linear{R(h * h * weft / p.m),
                               R(h * h * warp / p.m),
                               R(h * h * shear / p.m),
                               R(h * h * bend / p.m),
                               R(h * p.k_d / p.m),
                               R(own_stiffness(p, h)),
                               R(directions[0].rest * L),
                               R(directions[2].rest * L),
                               R(directions[4].rest * L),
                               R(shortest * directions[4].rest * L),
                               R(h * h / p.m)};
  const cl_mem masks = state_.masks(), coefficients = coefficients_.get(), blocks = blocks_.get(), d = step_.get(),
               r = left_.get(), z = preconditioned_.get(), q = product_.get();
  return set_arguments(kernel, 0, masks, coefficients, blocks, d, r, z, q, cl_int(state_.stride()),
                       cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns), linear);
}

template <class R>
int DeviceSolver<R>::set_sum(const Kernel& kernel, int at, double value) const {
  return device_->facts().fp64 ? set_arguments(kernel, at, value) : set_arguments(kernel, at, float(value));
}

template <class R>
typename DeviceSolver<R>::Products DeviceSolver<R>::inner_products(cl_mem a, cl_mem b) const {
  const Kernel& kernel = task_.kernels->inner_products;
  const cl_mem out = sums_.get();
  set_arguments(kernel, 0, a, b, cl_int(state_.stride()), cl_int(lattice_.rows), cl_int(lattice_.columns), out);
  launch(kernel, groups_);
  Products sum{0, 0, 0};
  const auto read = [&](auto example) {
    std::vector<decltype(example)> parts(3 * groups_);
    check(clEnqueueReadBuffer(device_->queue(), out, CL_TRUE, 0, parts.size() * sizeof example, parts.data(), 0,
                              nullptr, nullptr),
          "solving a step");
    for (std::size_t n = 0; n < parts.size(); n += 3)
      sum.aa += parts[n], sum.ab += parts[n + 1], sum.bb += parts[n + 2];
  };
  device_->facts().fp64 ? read(double()) : read(float());
  return sum;
}

template <class R>
void DeviceSolver<R>::launch_go(double part) {
  const Kernel& kernel = task_.kernels->go;
  const cl_mem from = state_.vector(task_.velocity), to = state_.other(task_.velocity);
  const cl_mem step = step_.get(), c_x = start_x_.get(), x = state_.vector(task_.position);
  set_arguments(kernel, 0, from, step, c_x, to, x, R(part), R(task_.h), cl_int(state_.stride()), cl_int(lattice_.rows),
                cl_int(lattice_.columns));
  launch(kernel, groups_);
  away_ = true;
}

template <class R>
void DeviceSolver<R>::arrive() {
  if (away_) state_.swap(task_.velocity);
  away_ = false;
}

template <class R>
double DeviceSolver<R>::evaluate() {
  launch_go(0);
  task_.residual(state_.vector(task_.position), state_.other(task_.velocity), start_v_.get(), residual_.get());
  const Products products = inner_products(residual_.get(), start_x_.get());
  start_size_ = std::sqrt(products.bb);
  return std::sqrt(products.aa);
}

template <class R>
void DeviceSolver<R>::linearize() {
  arrive();
  const Kernel& kernel = task_.kernels->linearise;
  const cl_mem x = state_.vector(task_.position);
  set_arguments(kernel, set_system(kernel), x, task_.constants);
  launch(kernel, groups_);
}

template <class R>
ImplicitStage::Step DeviceSolver<R>::step() {
  const Products products = inner_products(residual_.get(), step_.get());
  return {products.ab, std::sqrt(products.bb)};
}

template <class R>
ImplicitStage::Trial DeviceSolver<R>::try_part(double part) {
  launch_go(part);
  task_.residual(state_.vector(task_.position), state_.other(task_.velocity), start_v_.get(), residual_.get());
  const Products products = inner_products(residual_.get(), step_.get());
  return {std::sqrt(products.aa), products.ab};
}

template <class R>
template <class B>
typename DeviceSolver<R>::Left DeviceSolver<R>::read_left_as(const Memory& progress, std::size_t groups) const {
  std::vector<DeviceGradients<B>> parts(groups);
  check(clEnqueueReadBuffer(device_->queue(), progress.get(), CL_TRUE, 0, groups * sizeof parts[0], parts.data(), 0,
                            nullptr, nullptr),
        "solving a step");
  B squared = 0;
  for (const auto& part : parts) squared += part.squared;
  return {double(squared), double(parts[0].enough), parts[0].count};
}

template <class R>
typename DeviceSolver<R>::Left DeviceSolver<R>::read_left(const Memory& progress, std::size_t groups) const {
  return device_->facts().fp64 ? read_left_as<double>(progress, groups) : read_left_as<float>(progress, groups);
}

template <class R>
bool DeviceSolver<R>::gradients() {
  const int most = max_gradient_steps(lattice_);
  const Left left = at_once_ ? make_gradients(most) : make_gradients_in_launches(most);
  counts_.linear += left.count;
  // Where they ended before the last step they are allowed, the device has seen that it is enough.
  return std::isfinite(left.squared) && (left.count < most || left.squared <= left.enough);
}

template <class R>
typename DeviceSolver<R>::Left DeviceSolver<R>::make_gradients(int most) const {
  const Kernel& kernel = task_.kernels->gradients;
  const cl_mem residual = residual_.get(), p = directions_[0].get(), other = directions_[1].get();
  const cl_mem out = progress_[0].get();
  const int at = set_arguments(kernel, set_system(kernel), residual, p, other, cl_int(most));
  set_arguments(kernel, set_sum(kernel, at, linear_tolerance * linear_tolerance), out);
  launch(kernel, 1);
  return read_left(progress_[0], 1);
}

template <class R>
void DeviceSolver<R>::launch_step(int n, int most) const {
  assert(n >= 0 && n < most);
  const Kernel &multiply = task_.kernels->multiply, &update = task_.kernels->update;
  constexpr double tolerance2 = linear_tolerance * linear_tolerance;
  const std::size_t even = n % 2, odd = 1 - even;
  const cl_mem from = directions_[even].get(), to = directions_[odd].get();
  const cl_mem now = progress_[even].get(), next = progress_[odd].get();
  const int at_multiply = set_arguments(multiply, set_system(multiply), from, to, cl_int(most));
  set_arguments(multiply, set_sum(multiply, at_multiply, tolerance2), now);
  launch(multiply, groups_);
  const int at_update = set_arguments(update, set_system(update), to, cl_int(most));
  set_arguments(update, set_sum(update, at_update, tolerance2), now, next);
  launch(update, groups_);
}

template <class R>
typename DeviceSolver<R>::Left DeviceSolver<R>::make_gradients_in_launches(int most) {
  const Kernel& begin = task_.kernels->begin_gradients;
  const cl_mem residual = residual_.get(), p = directions_[0].get(), out = progress_[0].get();
  set_arguments(begin, set_system(begin), residual, p, out);
  launch(begin, groups_);
  constexpr int least = 4;           // launches between two looks
  constexpr double patience = 0.02;  // s between two looks where the step may be stopped
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  Left left{};
  for (int n = 0, end = task_.stop ? least : std::max(last_count_, least); n < most && !stops();
       end = n + std::max(n / 8, least)) {
    if (task_.stop && n > 0) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
      end = std::min(end, n + std::max(int(patience * n / seconds), 1));
    }
    for (end = std::min(end, most); n < end; ++n) launch_step(n, most);
    left = read_left(progress_[std::size_t(n % 2)], groups_);
    note_gradients(double(n) / most);
    if (left.count < n || left.squared <= left.enough || !std::isfinite(left.squared)) break;
  }
  last_count_ = left.count;
  return left;
}

template <class R>
bool DeviceSolver<R>::solve_directly() {
  if (task_.preset->kind == Kind::one_weight || !DirectSolver::is_quick(lattice_)) return false;
  assert(fixed_.size() == std::size_t(lattice_.size()));
  const std::size_t row = std::size_t(state_.mask_pitch()), margin = 16;
  std::vector<R> coefficients(coefficient_numbers_);
  check(clEnqueueReadBuffer(device_->queue(), coefficients_.get(), CL_TRUE, 0, coefficient_numbers_ * sizeof(R),
                            coefficients.data(), 0, nullptr, nullptr),
        "reading from the device");
  const auto spring = [&](int d, int i, int j) -> SpringStiffness {
    const R* part = coefficients.data() +
                    ((std::size_t(i) + 2) * particle_parts + std::size_t(d) * spring_parts) * row + margin +
                    std::size_t(j);
    return {{part[0], part[row], part[2 * row]}, part[3 * row]};
  };
  const R* const r = state_.map(residual_.get(), CL_MAP_READ);
  R* const s = state_.map(step_.get(), CL_MAP_WRITE);
  const auto at = [&](int i, int j, int c) { return (3 * std::ptrdiff_t(i) + c) * state_.stride() + j; };
  const bool solved = direct_.solve(
      {lattice_, own_stiffness(*task_.preset, task_.h),
       [&](int i, int j) { return fixed_[std::size_t(i) * lattice_.columns + j] != 0; }, spring,
       [&](int i, int j, int c) { return double(r[at(i, j, c)]); }},
      [&](int i, int j, int c, double value) { s[at(i, j, c)] = R(value); }, task_.stop);
  state_.unmap(residual_.get(), const_cast<R*>(r)), state_.unmap(step_.get(), s);
  return solved;
}

template class DeviceSolver<float>;
template class DeviceSolver<double>;

}  // namespace tyglab::opencl
