#include "core/engines/opencl/opencl_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/cloth/state.h"
#include "core/engines/opencl/device.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/program_text.h"
#include "core/forces/contact.h"
#include "core/forces/force.h"
#include "core/forces/linear_springs.h"
#include "core/model/effect.h"

namespace tyglab::opencl {
namespace {

void check_problem(const Preset& preset) {
  if (const std::string problem = opencl_problem(preset); !problem.empty()) throw EngineError(problem);
}

constexpr int idle_slot = StepGuard::steps_between_backups;  // that no step reports in

template <class R>
constexpr const char* real = sizeof(R) == 4 ? "float" : "double";

}  // namespace

template <class R>
OpenClEngine<R>::OpenClEngine(const Preset& preset, const Lattice& lattice, std::shared_ptr<Device> device, int width)
    : device_(std::move(device)),
      preset_(preset),
      lattice_(lattice),
      scheme_(&scheme(preset.integrator)),
      state_(device_, lattice, scheme_->vectors),
      passes_(passes(*scheme_)),
      width_(width > 0 ? width : device_->width(sizeof(R))),
      kernels_(make_kernels(preset, false)),
      options_(options(preset, false)) {
  reports_ = device_->zeros((StepGuard::steps_between_backups + 1) * sizeof(DeviceStepMeasures));
  hand_ = device_->zeros((StepGuard::steps_between_backups + 1) * 4 * sizeof(R));
  guards_ = state_.mask_field();
  if (is_implicit(*scheme_)) solver_ = std::make_unique<DeviceSolver<R>>(device_, lattice_, state_, width_);
  plan_bands();
  resolve();
}

template <class R>
std::string OpenClEngine<R>::options(const Preset& p, bool contacts) const {
  std::string text = std::string("-cl-std=CL1.2 -D REAL=") + real<R> + " -D WIDTH=" + std::to_string(width_);
  if (width_ == 1) text += " -D GROUP=" + std::to_string(DeviceSolver<R>::group_items);
  if constexpr (sizeof(R) == 8) text += " -D REAL_IS_DOUBLE";
  text += device_->facts().fp64 ? " -D BODY_REAL=double -D BODY_REAL_IS_DOUBLE" : " -D BODY_REAL=float";
  return text + program_features(p, contacts);
}

template <class R>
std::string OpenClEngine<R>::program_name(const Preset& preset, const std::string& options) const {
  // Large systems are solved by other kernels than small ones.
  const bool in_launches = solver_ && lattice_.size() > DeviceSolver<R>::most_at_once(width_);
  return preset.integrator + options + (in_launches ? ", in launches" : "");
}

template <class R>
typename OpenClEngine<R>::Kernels OpenClEngine<R>::make_kernels(const Preset& preset, bool contacts) const {
  try_program(preset, contacts);
  const auto program = device_->program(program_text(*scheme_), options(preset, contacts));
  Kernels kernels;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    kernels.passes.push_back(
        passes_[n].work == Work::solution ? Kernel() : program->kernel(("pass_" + std::to_string(n)).c_str()));
  if (is_implicit(*scheme_))
    kernels.residual = program->kernel("residual"), kernels.solver = DeviceSolver<R>::make_kernels(*program);
  if (!scheme_->start.empty()) kernels.start = program->kernel("start");
  kernels.accelerations = program->kernel("accelerations");
  kernels.set_fixed = program->kernel("set_fixed");
  kernels.drive_pins = program->kernel("drive_pins");
  kernels.combine = program->kernel("combine");
  kernels.tear = program->kernel("tear");
  kernels.derive_masks = program->kernel("derive_masks");
  if (LinearSprings<R>::exist(preset)) kernels.derive_linear = program->kernel("derive_linear");
  kernels.look = program->kernel("look");
  if constexpr (std::is_same_v<R, double>) kernels.to_float = program->kernel("to_float");
  return kernels;
}

template <class R>
DeviceConstants<R> OpenClEngine<R>::constants(const Preset& p, const Sweep& sweep) const {
  const double scale = scheme_->keeps_displacement ? p.dt : 1;
  Constants k;
  const auto [weft, warp, shear, bend] = spring_constants(p);
  k.weft = R(weft), k.weft_half = R(-weft * directions[0].rest * p.L / 2);
  k.warp = R(warp), k.warp_half = R(-warp * directions[1].rest * p.L / 2);
  k.shear = R(shear), k.shear_half = R(-shear * directions[2].rest * p.L / 2);
  k.bend = R(bend), k.bending = R(-bend * directions[4].rest * p.L / 2);
  constexpr double shortest = 1e-9;  // as in spring-inl.h
  k.shortest2 = R(std::pow(shortest * directions[4].rest * p.L, 2));
  k.k_d = R(p.k_d * power(p.dt, sweep.velocity_dt_power));
  k.weight = R(p.m * p.g);
  for (int c = 0; c < 3; ++c) k.wind[c] = R(p.W[c] / 3);
  // As Band::take_air.
  const double per = power(p.dt, sweep.velocity_dt_power), corner = per * per * p.air_density / 12;
  for (int c = 0; c < 3; ++c) k.air[c] = R(p.u[c] / per);
  k.air_across = R(corner * p.C_N), k.air_along = R(corner * p.C_T);
  k.air_most = R(per * most_air_damping(p, p.dt));
  k.smallest = std::numeric_limits<R>::min();
  k.dt = R(p.dt), k.to_way = R(p.dt / scale), k.to_velocity = R(1 / scale);
  k.k = R(p.k), k.middle = R(p.x_0.y);
  int next = 0;
  for (const Coefficient& c : coefficients(sweep.assignments)) {
    assert(next < int(std::size(k.c)));
    k.c[next++] = R(c.factor * power(p.dt, c.dt_power) / (c.of_force ? p.m : 1));
  }
  return k;
}

template <class R>
void OpenClEngine<R>::resolve() {
  resolved_.clear();
  for (const Pass& pass : passes_) {
    Preset over = preset_;  // a stage's residual is over β dt
    if (pass.work == Work::solution) over.dt *= pass.sweep.solves;
    const Sweep& summed = pass.work == Work::solution ? residual() : pass.sweep;
    resolved_.push_back({&pass.sweep, constants(over, summed), pass.work});
  }
  bodies_move_ = any_moves(preset_.bodies);
  upload_bodies(1);
  upload_shares();
  guard_.set_rules({.tearing = tears_watched(), .F_release = preset_.F_release, .costly_steps = is_implicit(*scheme_)});
  guard_.set_scene(preset_, lattice_, held_);
  guard_.invalidate();
}

template <class R>
void OpenClEngine<R>::upload_bodies(int steps) {
  if (!meets_bodies(preset_)) return;
  device_->facts().fp64 ? upload_bodies_as<double>(steps) : upload_bodies_as<float>(steps);
}

template <class R>
template <class B>
void OpenClEngine<R>::upload_bodies_as(int steps) {
  constexpr double epsilon = std::numeric_limits<R>::epsilon();
  const Contacts rule = contacts_of(preset_, preset_.dt, epsilon);
  const DeviceContactRule<B> head{
      B(rule.dt),  B(rule.epsilon), B(rule.g),   B(rule.shape.position), B(rule.shape.last_kick),
      B(rule.lag), rule.at_ends,    rule.upright};
  std::vector<BodyAt<B>> list;
  for (int n = 0; n < steps; ++n)
    for (const PlacedBody& body : placed_bodies(preset_.bodies, time_after(n, preset_.dt), preset_.dt, epsilon)) {
      list.push_back(body_as<B>(body));
      // Rounding of the quick test is left to the exact one, as in Band::touches.
      list.back().reach = B(std::nextafter(R(body.reach * (1 + 5 * epsilon)), std::numeric_limits<R>::max()));
    }
  std::vector<std::byte> bytes(sizeof head + list.size() * sizeof list[0]);
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, list.data(), bytes.size() - sizeof head);
  cl_int code = CL_SUCCESS;
  bodies_ = Memory(
      clCreateBuffer(device_->context(), CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes.size(), bytes.data(), &code));
  check(code, "allocating a buffer");
}

/// Bands for all compute units, and some more so that none waits long for the last; steps of a launch as many as a
/// cache holds the rows of.
template <class R>
void OpenClEngine<R>::plan_bands() {
  if (width_ == 1) return;
  constexpr int least_rows = 16, most_levels = 8;
  constexpr std::size_t cache = 256 << 10;
  const int units = int(device_->facts().compute_units);
  bands_ = std::clamp(lattice_.rows / least_rows, 1, units);
  const std::size_t pitch = 3 * std::size_t(state_.stride());
  const auto numbers = [&](int levels) { return (4 * (levels - 1) * scheme_->vectors + 3 * levels) * pitch + 64; };
  levels_ = 1;
  while (passes_.size() == 1 && levels_ < most_levels && numbers(levels_ + 1) * sizeof(R) <= cache) ++levels_;
  band_numbers_ = numbers(levels_);
  scratch_ = device_->zeros(std::size_t(bands_) * band_numbers_ * sizeof(R));
}

template <class R>
void OpenClEngine<R>::launch_rows(const Kernel& kernel, int columns) const {
  constexpr std::size_t group_columns = 32, group_rows = 4;
  const std::size_t local[2] = {columns == 1 ? 1 : group_columns, group_rows};
  const auto whole = [](std::size_t n, std::size_t groups_of) { return (n + groups_of - 1) / groups_of * groups_of; };
  const std::size_t global[2] = {whole(std::size_t(columns), local[0]), whole(std::size_t(lattice_.rows), local[1])};
  check(clEnqueueNDRangeKernel(device_->queue(), kernel.get(), 2, nullptr, global, local, 0, nullptr, nullptr),
        "starting a kernel");
}

template <class R>
void OpenClEngine<R>::launch_sweep(const Kernel& kernel, int at, const Constants& k, int slot, int levels) const {
  assert(slot >= 0 && slot <= idle_slot && levels >= 1 && levels <= levels_);
  const cl_mem masks = state_.masks(), reports = reports_.get(), hand = hand_.get(), bodies = bodies_.get(),
               contact_list = contact_list_.get(), scratch = scratch_.get(), linear = linear_.get();
  set_arguments(kernel, at, scratch, cl_int(bands_), cl_int(levels), cl_int(band_numbers_), masks,
                cl_int(state_.stride()), cl_int(state_.mask_pitch()), cl_int(lattice_.rows), cl_int(lattice_.columns),
                k, reports, hand, cl_int(slot), cl_int(held_.particle), bodies, cl_int(preset_.bodies.size()),
                cl_int(bodies_move_), contact_list, linear);
  if (width_ == 1) {
    launch_rows(kernel, lattice_.columns);
    return;
  }
  constexpr int items_a_band = 8;  // of which seven do nothing, see FOR_EACH_ROW
  const std::size_t items = std::size_t(bands_) * items_a_band, one = 1;
  check(clEnqueueNDRangeKernel(device_->queue(), kernel.get(), 1, nullptr, &items, &one, 0, nullptr, nullptr),
        "starting a kernel");
}

template <class R>
void OpenClEngine<R>::enqueue_sweep(const Kernel& kernel, const Resolved& resolved, int slot, int levels) {
  const Sweep& sweep = *resolved.sweep;
  std::vector<int> swapped;
  int at = 0;
  for (int n = 0; n < scheme_->vectors; ++n) {
    const bool written = std::any_of(sweep.assignments.begin(), sweep.assignments.end(),
                                     [n](const Assignment& assignment) { return assignment.target == n; });
    // What others read while it is written stands twice: neighbors, bands that make their neighbors' rows too, and
    // who draws.
    const bool seen =
        n == sweep.position || (n == sweep.velocity && (force::damping.on(preset_) || force::air.on(preset_)));
    const bool read = levels > 1 || (resolved.work == Work::forces && seen) || state_.lent(n);
    const cl_mem in = state_.vector(n), out = written && read ? state_.other(n) : in;
    at = set_arguments(kernel, at, in, out);
    if (out != in) swapped.push_back(n);
  }
  launch_sweep(kernel, at, resolved.constants, slot, levels);
  for (const int n : swapped) state_.swap(n);
}

template <class R>
bool OpenClEngine<R>::solve(const Resolved& resolved, int slot) {
  std::vector<int> fixed = pinned_;
  if (held_.particle >= 0) fixed.push_back(held_.particle);
  const auto residual = [&](cl_mem x, cl_mem v, cl_mem c_v, cl_mem out) {
    const int at = set_arguments(kernels_.residual, 0, x, x, v, v, c_v, c_v, out, out);
    launch_sweep(kernels_.residual, at, resolved.constants, slot, 1);
  };
  const double pass = double(&resolved - resolved_.data()), passes = double(resolved_.size());
  return solver_->solve({&kernels_.solver, &preset_, &fixed, linear_.get(), resolved.sweep->position,
                         resolved.sweep->velocity, resolved.sweep->solves * preset_.dt, residual,
                         repeating_ ? Stop{} : stop(),
                         [&](double part) { set_step_progress((pass + part) / passes); }});
}

template <class R>
void OpenClEngine<R>::accelerations() const {
  if (!acceleration_) acceleration_ = state_.field();
  const cl_mem x = state_.vector(vector_x), v = state_.vector(seen()), out = acceleration_.get();
  Sweep sweep = readout();
  sweep.velocity_dt_power = scheme_->keeps_displacement && !synchronized_ ? -1 : 0;
  const int at = set_arguments(kernels_.accelerations, 0, x, x, v, v, out, out);
  launch_sweep(kernels_.accelerations, at, constants(preset_, sweep), idle_slot, 1);
}

template <class R>
void OpenClEngine<R>::load(const StateRows& rows, const Tears& tears) {
  state_.end_views();
  const int columns = lattice_.columns;
  R* const x = state_.map(state_.overwritten(vector_x), CL_MAP_READ | CL_MAP_WRITE);
  R* const v = state_.map(state_.vector(vector_v), CL_MAP_READ | CL_MAP_WRITE);
  Array<double> buffer(6 * std::size_t(columns));
  const auto part = [&](int n) { return buffer.data() + std::ptrdiff_t(n) * columns; };
  const StateRow row{{part(0), part(1), part(2)}, {part(3), part(4), part(5)}};
  for (int i = 0; i < lattice_.rows; ++i) {
    rows(i, row);
    for (int c = 0; c < 3; ++c) {
      const std::ptrdiff_t to = (3 * std::ptrdiff_t(i) + c) * state_.stride();
      std::transform(row.x[c], row.x[c] + columns, x + to, [](double a) { return R(a); });
      std::transform(row.v[c], row.v[c] + columns, v + to, [](double a) { return R(a); });
    }
  }
  const auto bodies =
      placed_bodies(preset_.bodies, time_after(0, preset_.dt), preset_.dt, std::numeric_limits<R>::epsilon());
  guard_.begin(motion_of(preset_, lattice_, tears, bodies, StateView<R>{x, v, state_.stride()}, 1));
  state_.unmap(state_.vector(vector_x), x), state_.unmap(state_.vector(vector_v), v);
  upload_masks(tears);
  guard_.accept_cuts(tears);
  synchronized_ = true;
  write_fixed_velocities();
  guard_.invalidate();
}

template <class R>
void OpenClEngine<R>::start() {
  assert(synchronized_ && !scheme_->start.empty());
  // Its a sees v itself, so the sweep's velocity takes no power of dt.
  const Sweep start{vector_x, vector_v, 0, scheme_->start};
  enqueue_sweep(kernels_.start, {&start, constants(preset_, start)}, idle_slot);
  synchronized_ = false;
  write_fixed_velocities();
}

template <class R>
void OpenClEngine<R>::synchronize(const Tears& tears) {
  if (synchronized_) return;
  state_.end_views();
  accept_changes(tears);
  accelerations();
  const cl_mem v = state_.vector(vector_v), a = acceleration_.get();
  set_arguments(kernels_.combine, 0, v, a, R(1 / velocity_scale()), R(lag()));
  const std::size_t numbers = state_.numbers();
  check(clEnqueueNDRangeKernel(device_->queue(), kernels_.combine.get(), 1, nullptr, &numbers, nullptr, 0, nullptr,
                               nullptr),
        "starting a kernel");
  synchronized_ = true;
  write_fixed_velocities();
  guard_.invalidate();
}

template <class R>
void OpenClEngine<R>::set_preset(const Preset& preset, const Tears& tears) {
  assert(lattice_of(preset) == lattice_ && preset.precision == preset_.precision);
  check_problem(preset);
  const std::string wanted = options(preset, notes_contacts_);
  Kernels next;
  if (wanted != options_) next = make_kernels(preset, notes_contacts_);
  if (changes(preset_, preset).touches(Effect::force | Effect::dt)) synchronize(tears);
  state_.end_views();
  accept_changes(tears);
  if (wanted != options_) kernels_ = std::move(next), options_ = wanted, noted_run_ = false;
  guard_.accept_changes(preset_, preset);
  preset_ = preset;
  resolve();
}

template <class R>
bool OpenClEngine<R>::ready_for(const Preset& preset) const {
  if (changes(preset_, preset).touches({Effect::integrator, Effect::precision})) return false;
  const std::string wanted = options(preset, notes_contacts_);
  return wanted == options_ || device_->has_run(program_name(preset, wanted));
}

template <class R>
bool OpenClEngine<R>::ready_for_contacts() const {
  const std::string wanted = options(preset_, true);
  return wanted == options_ || device_->has_run(program_name(preset_, wanted));
}

template <class R>
void OpenClEngine<R>::note_contacts(bool on) {
  if (on && !contact_list_) {
    const std::size_t each = device_->facts().fp64 ? sizeof(DeviceContact<double>) : sizeof(DeviceContact<float>);
    contact_list_ = device_->zeros(std::size_t(lattice_.size()) * each);
  }
  if (const std::string wanted = options(preset_, on); wanted != options_)
    kernels_ = make_kernels(preset_, on), options_ = wanted, noted_run_ = false;
  notes_contacts_ = on;
  contacts_.clear();
}

template <class R>
void OpenClEngine<R>::set_fixed(std::span<const int> pinned, Held held) {
  assert(pinned.empty() || (pinned.front() >= 0 && pinned.back() < lattice_.size()));
  const bool same =
      held.particle == held_.particle && std::equal(pinned.begin(), pinned.end(), pinned_.begin(), pinned_.end());
  // Who is let go may be inside a body.
  if (lets_go(pinned_, held_.particle, pinned, held.particle)) guard_.expect_pushes();
  pinned_.assign(pinned.begin(), pinned.end()), driven_.clear();
  held_ = held;
  guard_.set_scene(preset_, lattice_, held_);
  if (!same) {
    masks_stale_ = true;
    fixed_list_ = device_->zeros(std::max<std::size_t>(pinned_.size(), 1) * sizeof(int));
    if (!pinned_.empty())
      check(clEnqueueWriteBuffer(device_->queue(), fixed_list_.get(), CL_TRUE, 0, pinned_.size() * sizeof(int),
                                 pinned_.data(), 0, nullptr, nullptr),
            "writing to the device");
  }
  guard_.invalidate();  // the backup holds the hand's old velocity
  write_fixed_velocities();
}

template <class R>
void OpenClEngine<R>::drive_pins(std::span<const DrivenPin> pins, bool place) {
  driven_.assign(pins.begin(), pins.end());
  guard_.invalidate();
  write_fixed_velocities(place);
}

/// Pinned particles and the held one have the velocity that they are given; with `place`, those that are driven also
/// the position.
template <class R>
void OpenClEngine<R>::write_fixed_velocities(bool place) {
  if (pinned_.empty() && held_.particle < 0) return;
  state_.end_views();
  const cl_mem v = state_.vector(vector_v), seen = state_.vector(this->seen()), list = fixed_list_.get();
  const glm::dvec3 hand = held_.velocity * velocity_scale();
  set_arguments(kernels_.set_fixed, 0, v, seen, list, cl_int(pinned_.size()), cl_int(held_.particle), R(hand.x),
                R(hand.y), R(hand.z), cl_int(state_.stride()), cl_int(lattice_.columns));
  const std::size_t items = pinned_.size() + 1;
  check(clEnqueueNDRangeKernel(device_->queue(), kernels_.set_fixed.get(), 1, nullptr, &items, nullptr, 0, nullptr,
                               nullptr),
        "starting a kernel");
  if (driven_.empty()) return;
  // A particle, where it is, and its velocity.
  std::vector<R> values;
  std::vector<int> particles;
  for (const DrivenPin& pin : driven_) {
    particles.push_back(pin.particle);
    for (int c = 0; c < 3; ++c) values.push_back(R(pin.x[c]));
    for (int c = 0; c < 3; ++c) values.push_back(R(pin.v[c] * velocity_scale()));
  }
  const std::size_t driven = driven_.size();
  if (driven > driven_room_) {
    driven_list_ = device_->zeros(driven * sizeof(int)), driven_values_ = device_->zeros(6 * driven * sizeof(R));
    driven_room_ = driven;
  }
  const auto write = [&](const Memory& to, const void* from, std::size_t bytes) {
    check(clEnqueueWriteBuffer(device_->queue(), to.get(), CL_TRUE, 0, bytes, from, 0, nullptr, nullptr),
          "writing to the device");
  };
  write(driven_list_, particles.data(), driven * sizeof(int));
  write(driven_values_, values.data(), 6 * driven * sizeof(R));
  const cl_mem x = state_.vector(vector_x), numbers = driven_list_.get(), list_of_values = driven_values_.get();
  set_arguments(kernels_.drive_pins, 0, x, v, seen, numbers, list_of_values, cl_int(place), cl_int(state_.stride()),
                cl_int(lattice_.columns));
  check(clEnqueueNDRangeKernel(device_->queue(), kernels_.drive_pins.get(), 1, nullptr, &driven, nullptr, 0, nullptr,
                               nullptr),
        "starting a kernel");
}

template <class R>
void OpenClEngine<R>::upload_masks(const Tears& tears) {
  assert(tears.untorn() || tears.lattice() == lattice_);
  std::vector<std::uint8_t> springs(std::size_t(lattice_.size())), guards(springs.size());
  constexpr std::uint8_t bit_free = 64;  // as in cloth.cl
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j) {
      std::uint8_t& mask = springs[std::size_t(i) * lattice_.columns + j];
      mask = bit_free;
      for (int d = 0; d < stretch_directions; ++d)
        if (lattice_.has_spring(d, i, j) && tears.whole(d, i, j)) mask |= std::uint8_t(1 << d);
    }
  const auto fix = [&](int p) {
    springs[std::size_t(p)] &= std::uint8_t(~bit_free);
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        if (const int i = p / lattice_.columns + di, j = p % lattice_.columns + dj; lattice_.contains(i, j))
          guards[std::size_t(i) * lattice_.columns + j] = 1;
  };
  for (const int p : pinned_) fix(p);
  if (held_.particle >= 0) fix(held_.particle);
  state_.upload(springs, state_.springs());
  state_.upload(guards, guards_.get());
  derive(nullptr, 0);
  masks_stale_ = false;
}

template <class R>
void OpenClEngine<R>::derive(cl_mem report, int slot) {
  const cl_mem springs = state_.springs(), masks = state_.masks(), linear = linear_.get(), shares = shares_.get();
  const auto launch = [&](const Kernel& kernel, auto... further) {
    set_arguments(kernel, 0, springs, further...);
    launch_rows(kernel, lattice_.columns);
  };
  const cl_int pitch = state_.mask_pitch(), rows = lattice_.rows, columns = lattice_.columns;
  launch(kernels_.derive_masks, masks, report, cl_int(slot), pitch, rows, columns);
  if (share_count_ > 0)
    launch(kernels_.derive_linear, linear, report, cl_int(slot), pitch, rows, columns, shares, cl_int(share_count_));
}

template <class R>
void OpenClEngine<R>::upload_shares() {
  const bool had = share_count_ > 0;
  std::vector<DeviceShare<R>> list;
  for (const auto& share : LinearSprings<R>::shares_of(preset_, 1)) {
    const Stencil& stencil = *share.stencil;
    assert(stencil.owners == Stencil::Owners::all && stencil.springs <= int(std::size(DeviceShare<R>{}.bit)));
    DeviceShare<R> one{.constant = R(share.constant), .direction = share.direction, .di = share.di, .dj = share.dj};
    for (int n = 0; n < stencil.points; ++n) {
      const Stencil::Point& point = stencil.at[std::size_t(n)];
      one.last_row = std::max(one.last_row, point.di);
      one.first_column = std::min(one.first_column, point.dj), one.last_column = std::max(one.last_column, point.dj);
    }
    one.springs = stencil.springs;
    for (int n = 0; n < stencil.springs; ++n) {
      const Stencil::Spring& spring = stencil.spring[std::size_t(n)];
      one.bit[n] = 1 << spring.direction, one.spring_di[n] = spring.di, one.spring_dj[n] = spring.dj;
    }
    list.push_back(one);
  }
  share_count_ = int(list.size());
  masks_stale_ |= had || share_count_ > 0;
  if (list.empty()) return;
  if (!linear_) {
    constexpr std::size_t margin = 32;
    linear_ = device_->zeros(
        ((std::size_t(lattice_.rows) + 5) * directions.size() * std::size_t(state_.mask_pitch()) + margin) * sizeof(R));
  }
  cl_int code = CL_SUCCESS;
  shares_ = Memory(clCreateBuffer(device_->context(), CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                  list.size() * sizeof list[0], list.data(), &code));
  check(code, "allocating a buffer");
}

template <class R>
void OpenClEngine<R>::accept_changes(const Tears& tears) {
  if (!masks_stale_ && !guard_.springs_cut(tears)) return;
  upload_masks(tears);
  guard_.accept_cuts(tears);
}

std::unique_ptr<Engine> make_opencl_engine(const Preset& preset, const Lattice& lattice, int width) {
  check_problem(preset);
  // Where there is no device, open_device() says so.
  if (!opencl_devices().devices.empty()) try_program(preset, false);
  std::shared_ptr<Device> device = open_device(preset.device);
  if (preset.precision == Precision::float_)
    return std::make_unique<OpenClEngine<float>>(preset, lattice, std::move(device), width);
  if (!device->facts().fp64)
    throw EngineError(
        "The OpenCL device " + device->facts().name +
        " does not support double precision; use float (--precision float) or the CPU engine (--engine cpu)");
  return std::make_unique<OpenClEngine<double>>(preset, lattice, std::move(device), width);
}

template class OpenClEngine<float>;
template class OpenClEngine<double>;

}  // namespace tyglab::opencl
