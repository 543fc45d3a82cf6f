#include "core/engines/cpu/cpu_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <utility>

#include "core/cloth/state.h"
#include "core/model/effect.h"

namespace tyglab::cpu {
namespace {

/// x, v and F as a scheme's assignments leave them, in terms of what they were: finds whether the pair sweep can make
/// the update by itself.
struct Combination {
  double x, v, force;
};

void classify(ResolvedSweep& sweep, const Scheme& scheme) {
  sweep.update = Update::force;
  if (scheme.sweeps.size() != 1 || scheme.vectors != 2 || sweep.position != vector_x || sweep.velocity != vector_v)
    return;
  Combination now[2] = {{1, 0, 0}, {0, 1, 0}};
  for (const auto& assignment : sweep.assignments) {
    assert(assignment.target == vector_x || assignment.target == vector_v);
    Combination sum{0, 0, 0};
    for (const auto [vector, factor] : assignment.terms) {
      const Combination part = vector == acceleration ? Combination{0, 0, 1} : now[vector];
      sum = {sum.x + factor * part.x, sum.v + factor * part.v, sum.force + factor * part.force};
    }
    now[assignment.target] = sum;
  }
  const auto [x, v] = now;
  if (x.x != 1 || v.x != 0 || v.v != 1) return;
  sweep.v_to_x = x.v, sweep.force_to_x = x.force, sweep.force_to_v = v.force;
  sweep.update = x.v == 1 && x.force == v.force ? Update::displacement : Update::general;
}

/// Rows and threads that pay: a barrier costs about as much as a thousand particles.
int useful_threads(const Lattice& lattice, int asked) {
  assert(asked >= 1);
  constexpr int least_particles = 1500;
  return std::clamp(std::min(lattice.size() / least_particles, lattice.rows / Band<float>::least_rows), 1, asked);
}

constexpr int lines_apart = 23;  // between vectors' places in their pages, of 64 cache lines

}  // namespace

template <class R, unsigned Present>
CpuEngine<R, Present>::CpuEngine(const Preset& preset, const Lattice& lattice, int threads)
    : team_(std::make_unique<Team>(useful_threads(lattice, threads))),
      crew_(std::make_unique<TeamCrew>(*team_)),
      governor_(team_->capacity(), team_->capacity()) {
  cloth_.preset = preset;
  cloth_.lattice = lattice;
  cloth_.stride = row_stride<R>(lattice.columns);
  cloth_.sweeps = pair_sweeps<R>();
  cloth_.fixed_begin.assign(std::size_t(lattice.rows) + 1, 0);
  for (int n = 0; n < team_->size(); ++n)
    bands_.push_back(std::make_unique<Band<R, Present>>(cloth_, band_begin(n), band_begin(n + 1)));
  progress_ = std::vector<Progress>(std::size_t(team_->size()));
  resolve();
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::band_begin(int number) const {
  assert(number >= 0 && number <= team_->size());
  const int rows = cloth_.lattice.rows, bands = team_->size();
  return number == bands ? rows : int(std::int64_t(rows) * number / bands) / 2 * 2;
}

template <class R, unsigned Present>
ResolvedSweep CpuEngine<R, Present>::resolve(const Sweep& sweep) const {
  ResolvedSweep out;
  out.position = sweep.position, out.velocity = sweep.velocity;
  out.per_velocity = power(cloth_.dt, sweep.velocity_dt_power);
  out.k_d = cloth_.preset.k_d * out.per_velocity;
  out.solve_dt = sweep.solves * cloth_.dt;
  out.damps_dt = sweep.damps * cloth_.dt;
  out.external = sweep.external, out.projects = sweep.projects;
  for (const Assignment& assignment : sweep.assignments) out.assignments.push_back(resolve(assignment));
  for (const Assignment& assignment : sweep.before) out.before.push_back(resolve(assignment));
  return out;
}

template <class R, unsigned Present>
ResolvedSweep::ResolvedAssignment CpuEngine<R, Present>::resolve(const Assignment& assignment) const {
  ResolvedSweep::ResolvedAssignment out{assignment.target, {}};
  for (const Term& term : assignment.terms) out.terms.push_back({term.vector, 0});
  scale(assignment, out);
  return out;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::scale(const Assignment& assignment, ResolvedSweep::ResolvedAssignment& out) const {
  assert(out.terms.size() == assignment.terms.size() && cloth_.dt > 0 && cloth_.preset.m > 0);
  for (std::size_t n = 0; n < out.terms.size(); ++n) {
    const Term& term = assignment.terms[n];
    const double factor = term.factor * power(cloth_.dt, term.dt_power);
    out.terms[n].factor = term.vector == acceleration ? factor / cloth_.preset.m : factor;
  }
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::resolve() {
  scheme_ = &scheme(cloth_.preset.integrator);
  set_synchronized(synchronized_);
  set_dt(cloth_.preset.dt);
  cloth_.vectors.resize(std::size_t(scheme_->vectors));
  // What a method that chooses its own steps keeps beside x and v follows from them.
  backup_.resize(chooses_steps(*scheme_) ? 2 : cloth_.vectors.size());
  assert(!sweeps_.empty() && backup_.size() <= cloth_.vectors.size());
  for (auto* fields : {&cloth_.vectors, &backup_}) {
    int lead = 0;
    for (auto& field : *fields) {
      if (field.empty()) field.resize(array_rows(), cloth_.stride, lead);
      lead += lines_apart;
    }
  }
  start_ = scheme_->start.empty() ? ResolvedSweep() : resolve(Sweep{vector_x, vector_v, 0, scheme_->start});
  std::vector<std::vector<PlacedBody>> bodies = bodies_in(1);
  if (self_ == nullptr && touches_itself(cloth_.preset)) self_ = std::make_unique<Self>(cloth_.lattice);
  make_waves();  // the last that takes memory
  cloth_.features = features_of(cloth_.preset);
  if (!touches_itself(cloth_.preset)) self_.reset(), cloth_.near_force = nullptr;
  if (self_ != nullptr) self_->contact.set_preset(cloth_.preset, layer_constant(cloth_.preset)), lose_self();
  cloth_.contacts = contacts_of(cloth_.preset, cloth_.dt, std::numeric_limits<R>::epsilon());
  cloth_.bodies_move = any_moves(cloth_.preset.bodies);
  cloth_.bodies.swap(bodies);
  const Preset& p = cloth_.preset;
  loose_.known_torn = -1;
  guard_.set_rules({.tearing = has(part::tearing) && tears_springs(p),
                    .parting = parts(p),
                    .F_release = p.F_release,
                    .costly_steps = stops_within_steps()});
  guard_.set_scene(p, cloth_.lattice, cloth_.held);
  guard_.invalidate();
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::stops_within_steps() const {
  constexpr double most = 1 << 18;  // particles times iterations: some milliseconds
  if (!projects(*scheme_)) return is_implicit(*scheme_) || chooses_steps(*scheme_);
  return double(cloth_.lattice.size()) * cloth_.preset.iterations >= most;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::swap(Resolved& other) {
  std::swap(cloth_.dt, other.dt), sweeps_.swap(other.sweeps), std::swap(start_, other.start);
  std::swap(estimate_, other.estimate);
  tables_.swap(other.tables), std::swap(table_, other.table), std::swap(spectrum_, other.spectrum);
  next_stage_.swap(other.next_stage), accepting_.swap(other.accepting);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::exchange(const Preset& preset) {
  Preset other = preset;
  Resolved before;
  swap(before), std::swap(cloth_.preset, other);
  try {
    resolve();
  } catch (const std::bad_alloc&) {
    // What else it has changed says of both constants the same, or has only become larger.
    swap(before), std::swap(cloth_.preset, other);
    throw;
  }
}

/// In the next step or inner step, without taking memory.
template <class R, unsigned Present>
void CpuEngine<R, Present>::place_next_bodies() {
  const double dt = cloth_.preset.dt, made = chooses_steps(*scheme_) && left_of_dt_ > 0 ? dt - left_of_dt_ : 0;
  assert(!cloth_.bodies.empty());
  place_bodies(cloth_.preset.bodies, time_after(0, dt) + made, cloth_.dt, std::numeric_limits<R>::epsilon(),
               cloth_.bodies.front());
}

/// In steps that are made together.
template <class R, unsigned Present>
std::vector<std::vector<PlacedBody>> CpuEngine<R, Present>::bodies_in(int steps) const {
  const double dt = cloth_.preset.dt;
  std::vector<std::vector<PlacedBody>> all;
  for (int n = 0; n < std::max(steps, 1); ++n)
    all.push_back(placed_bodies(cloth_.preset.bodies, time_after(n, dt), cloth_.dt, std::numeric_limits<R>::epsilon()));
  return all;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::set_dt(double dt) {
  assert(dt > 0);
  cloth_.dt = dt;
  sweeps_.clear();
  table_ = 0;
  for (const Sweep& sweep : scheme_->sweeps) classify(sweeps_.emplace_back(resolve(sweep)), *scheme_);
  if (chooses_steps(*scheme_)) resolve_estimate();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::resize_team(int size) {
  if (size == team_->size()) return;
  assert(size >= 1 && std::size_t(size) <= bands_.size());
  team_->resize(size);
  for (int n = 0; n < size; ++n) bands_[std::size_t(n)]->cover(band_begin(n), band_begin(n + 1));
  wave_steps_ = steps_of_wave(size);
}

/// Several steps follow each other through the rows where the state does not stay in a core's own cache, and where
/// threads would otherwise have to wait for each other in every step.
template <class R, unsigned Present>
int CpuEngine<R, Present>::steps_of_wave(int threads) const {
  assert(threads >= 1 && threads <= team_->capacity() && !sweeps_.empty());
  constexpr int most = 8;             // sweeps a thread: their rows must lie in its cache
  constexpr int rows_per_sweep = 16;  // the more sweeps, the longer the last thread waits for the first row
  constexpr std::size_t own_cache = 1 << 20;
  const int rows = cloth_.lattice.rows;
  const int sweeps = std::min(rows / rows_per_sweep, most * threads);
  const std::size_t state = cloth_.vectors.size() * rows * cloth_.vector(vector_x).pitch() * sizeof(R);
  if (is_implicit(*scheme_) || chooses_steps(*scheme_) || projects(*scheme_) || solves_damping(*scheme_) ||
      cloth_.preset.kind == Kind::one_weight || touches_itself(cloth_.preset) || sweeps < threads ||
      (threads == 1 && state <= own_cache))
    return 0;
  const int steps = sweeps / int(sweeps_.size());
  return steps < 2 ? 0 : steps;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::make_waves() {
  wave_steps_ = steps_of_wave(team_->size());
  int most = 0;
  for (int threads = 1; threads <= team_->capacity(); ++threads) most = std::max(most, steps_of_wave(threads));
  const std::size_t wanted = std::size_t(most) * sweeps_.size();
  waves_.reserve(wanted);
  while (waves_.size() < wanted) waves_.push_back(std::make_unique<Band<R, Present>>(cloth_, 0, cloth_.lattice.rows));
  for (auto* list : {&bands_, &waves_})
    for (auto& band : *list) band->allocate(keeps_old_rows(), meets_within_steps(cloth_.preset));
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::keeps_old_rows() const {
  return !cloth_.preset.bodies.empty() || std::any_of(sweeps_.begin(), sweeps_.end(), [](const ResolvedSweep& s) {
    return s.update == Update::force;
  }) || cloth_.preset.kind == Kind::one_weight;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::load(const StateRows& rows, const Tears& tears) {
  const int columns = cloth_.lattice.columns;
  place_next_bodies();
  rows_.resize(6 * std::size_t(team_->capacity()) * columns);
  team_->run([&](int number) {
    const auto part = [&](int n) { return rows_.data() + (6 * std::ptrdiff_t(number) + n) * columns; };
    const StateRow row{{part(0), part(1), part(2)}, {part(3), part(4), part(5)}};
    for (int i = band_begin(number); i < band_begin(number + 1); ++i) {
      rows(i, row);
      for (int c = 0; c < 3; ++c) {
        std::transform(row.x[c], row.x[c] + columns, cloth_.row(vector_x, i, c), [](double x) { return R(x); });
        std::transform(row.v[c], row.v[c] + columns, cloth_.row(vector_v, i, c), [](double v) { return R(v); });
      }
    }
  });
  guard_.begin(motion_of(cloth_.preset, cloth_.lattice, tears, cloth_.bodies.front(), view(), 1));
  rows_ = Array<double>();
  forget_self();
  loose_.known_torn = -1;  // it may have parted elsewhere
  set_synchronized(true);
  write_fixed_velocities();
  springs_changed_ = true;
  restart_control();
  guard_.invalidate();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::set_synchronized(bool yes) {
  synchronized_ = yes;
  cloth_.keeps_displacement = !yes && scheme_->keeps_displacement;
  cloth_.seen_velocity = yes ? vector_v : seen_velocity(*scheme_);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::start(const Tears& tears) {
  follow_springs(tears);
  assert(synchronized_ && !scheme_->start.empty());
  begin_self(tears), find_given_force(start_);
  // Its a sees v itself, so the sweep's velocity takes no power of dt.
  team_->run([&](int number) {
    bands_[std::size_t(number)]->copy_halo(start_);
    team_->barrier();
    bands_[std::size_t(number)]->sweep(start_, tears, false);
  });
  set_synchronized(false);
  write_fixed_velocities();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::find_lagging_a(const Tears& tears) {
  accelerations(vector_x, cloth_.seen_velocity, tears, acceleration_);
  if (!solves_damping(*scheme_)) return;
  prepare_damping(tears);
  constant_.solve(acceleration_, 0, cloth_.lattice.rows, [] {});
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::synchronize(const Tears& tears) {
  if (synchronized_) return;
  find_lagging_a(tears);
  add_lag(scheme_->lag * cloth_.preset.dt, cloth_.velocity_scale());
}

/// Turns the stored velocities, which are `scale` times velocities, into those of `lag` seconds later.
template <class R, unsigned Present>
void CpuEngine<R, Present>::add_lag(double lag, double scale) {
  const std::span<R> v = cloth_.vector(vector_v).all(), a = acceleration_.all();
  assert(scale > 0 && a.size() == v.size());
  for (std::size_t n = 0; n < v.size(); ++n) v[n] = R(double(v[n]) / scale + lag * double(a[n]));  // as read() has them
  set_synchronized(true);
  write_fixed_velocities();
  guard_.invalidate();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::set_preset(const Preset& preset, const Tears& tears) {
  assert(lattice_of(preset) == cloth_.lattice.sites() && preset.precision == cloth_.preset.precision &&
         preset.integrator == cloth_.preset.integrator);
  const EffectSet changed = changes(cloth_.preset, preset);
  // All that takes memory comes first.
  const bool restarts = !synchronized_ && changed.touches(Effect::force | Effect::dt);
  const double lag = this->lag(), scale = cloth_.velocity_scale();
  if (restarts) find_lagging_a(tears);
  guard_.accept_changes(cloth_.preset, preset);
  exchange(preset);
  if (changed.touches({Effect::force, Effect::dt, Effect::tolerance})) restart_control();
  if (restarts) add_lag(lag, scale);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::prepare(std::size_t fixed) {
  pinned_.reserve(fixed), driven_.reserve(fixed), all_fixed_.reserve(fixed + 1),
      cloth_.fixed_columns.reserve(fixed + 1);
  cloth_.fixed.reserve(std::size_t(cloth_.lattice.size()) + widest_vector);
  guards_.reserve(std::size_t(cloth_.lattice.size()));
  rows_.resize(6 * std::size_t(team_->capacity()) * cloth_.lattice.columns);
  if (!scheme_->start.empty() && acceleration_.empty()) acceleration_.resize(array_rows(), cloth_.stride);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::set_fixed(std::span<const int> pinned, Held held) {
  std::vector<int>& all = all_fixed_;
  const bool any = !pinned.empty() || held.particle >= 0;
  const std::size_t particles = std::size_t(cloth_.lattice.size());
  assert(pinned.empty() || (pinned.front() >= 0 && std::size_t(pinned.back()) < particles));
  assert(held.particle < cloth_.lattice.size());
  // All the memory first, so that nothing has changed where it fails.
  pinned_.reserve(pinned.size()), all.reserve(pinned.size() + 1), cloth_.fixed_columns.reserve(pinned.size() + 1);
  if (any) cloth_.fixed.reserve(particles + widest_vector), guards_.reserve(particles);
  // Who is let go may be inside a body.
  if (lets_go(pinned_, cloth_.held.particle, pinned, held.particle)) guard_.expect_pushes();
  pinned_.assign(pinned.begin(), pinned.end()), driven_.clear();
  cloth_.held = held;
  guard_.set_scene(cloth_.preset, cloth_.lattice, held);
  springs_changed_ = true;
  restart_control();
  all.assign(pinned_.begin(), pinned_.end());
  if (held.particle >= 0) all.insert(std::upper_bound(all.begin(), all.end(), held.particle), held.particle);
  cloth_.fixed_columns.clear();
  std::fill(cloth_.fixed_begin.begin(), cloth_.fixed_begin.end(), 0);
  for (const int p : all) {
    cloth_.fixed_columns.push_back(p % cloth_.lattice.columns);
    ++cloth_.fixed_begin[std::size_t(p / cloth_.lattice.columns) + 1];
  }
  write_fixed_velocities();
  for (std::size_t i = 1; i < cloth_.fixed_begin.size(); ++i) cloth_.fixed_begin[i] += cloth_.fixed_begin[i - 1];
  assert(std::size_t(cloth_.fixed_begin.back()) == cloth_.fixed_columns.size());
  cloth_.fixed.assign(all.empty() ? 0 : particles + widest_vector, 0);
  for (const int p : all) cloth_.fixed[p] = 1;
  guards_.assign(all.empty() ? 0 : particles, 0);
  for (const int p : all)
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        if (const int i = p / cloth_.lattice.columns, j = p % cloth_.lattice.columns;
            cloth_.lattice.has_site(i, j) && cloth_.lattice.has_site(i + di, j + dj))
          guards_[std::size_t(i + di) * cloth_.lattice.columns + j + dj] = 1;
  guard_.invalidate();
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::drive_pins(std::span<const DrivenPin> pins, bool place) {
  driven_.assign(pins.begin(), pins.end());
  const int columns = cloth_.lattice.columns;
  if (place)
    for (const DrivenPin& pin : driven_)
      for (int c = 0; c < 3; ++c) cloth_.row(vector_x, pin.particle / columns, c)[pin.particle % columns] = R(pin.x[c]);
  write_fixed_velocities();
  knows_first_a_ = false;
  lose_self();
  guard_.invalidate();
}

/// Pinned particles rest or are driven, and the held one has the velocity of the hand.
template <class R, unsigned Present>
void CpuEngine<R, Present>::write_fixed_velocities() {
  const auto write = [&](int p, const glm::dvec3& v) {
    const int i = p / cloth_.lattice.columns, j = p % cloth_.lattice.columns;
    for (const int vector : {vector_v, cloth_.seen_velocity})
      for (int c = 0; c < 3; ++c) cloth_.row(vector, i, c)[j] = R(v[c] * cloth_.velocity_scale());
  };
  for (const int p : all_fixed_) write(p, p == cloth_.held.particle ? cloth_.held.velocity : glm::dvec3(0));
  for (const DrivenPin& pin : driven_) write(pin.particle, pin.v);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::accelerations(int position, int velocity, const Tears& tears, Field& out) {
  ResolvedSweep look;
  look.position = position, look.velocity = velocity;
  look.k_d = cloth_.preset.k_d / cloth_.velocity_scale(), look.per_velocity = 1 / cloth_.velocity_scale();
  follow_springs(tears), begin_self(tears);
  accelerations_of(look, tears, out, false);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::accelerations_of(const ResolvedSweep& look, const Tears& tears, Field& out, bool of_step) {
  if (out.empty()) out.resize(array_rows(), cloth_.stride);
  find_given_force(look);
  for (const auto& band : bands()) band->copy_halo(look);
  for (const auto& band : bands()) band->accelerations(look, tears, out, of_step);
}

template <class R, unsigned Present>
std::vector<Contact> CpuEngine<R, Present>::contacts() const {
  assert(cloth_.notes_contacts);
  if (scheme_->estimate) return inner_contacts_;
  std::vector<Contact> all;
  for (const auto& band : bands()) all.insert(all.end(), band->contacts().begin(), band->contacts().end());
  return all;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::read(State& state, const Tears& tears) {
  read_stored(state);
  const double lag = this->lag();  // in double: what a float would lose is shown in plots
  if (lag == 0) return;
  find_lagging_a(tears);
  for (int i = 0; i < cloth_.lattice.rows; ++i)
    for (int j = 0; j < cloth_.lattice.columns; ++j) {
      const std::size_t to = std::size_t(i) * cloth_.lattice.columns + j;
      const glm::dvec3 a(acceleration_.row(i, 0)[j], acceleration_.row(i, 1)[j], acceleration_.row(i, 2)[j]);
      // Forces that overflow end the next step; until then velocities are those of half a step ago.
      if (!std::isfinite(a.x + a.y + a.z)) continue;
      state.v.x[to] += lag * a.x, state.v.y[to] += lag * a.y, state.v.z[to] += lag * a.z;
    }
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::read_raw(State& state, const Tears& tears) {
  if (!scheme_->keeps_displacement) return read(state, tears);
  if (!synchronized_) return read_stored(state);
  // As the method will start, but the state stays synchronized.
  const Field v = cloth_.vector(vector_v);
  start(tears);
  read_stored(state);
  cloth_.vector(vector_v) = v;
  set_synchronized(true);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::read_stored(State& state) const {
  const std::size_t n = std::size_t(cloth_.lattice.size());
  // The last array that gets its memory: where an earlier call ran out of it, others may have theirs.
  if (state.v.z.size() != n) state.x.resize(n), state.v.resize(n);
  assert(state.x.x.size() == n && state.v.x.size() == n && state.x.z.size() == n);
  const auto copy = [&](int vector, VectorField<double>& to, double divisor) {
    Array<double>* components[] = {&to.x, &to.y, &to.z};
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < cloth_.lattice.rows; ++i)
        for (int j = 0; j < cloth_.lattice.columns; ++j)
          (*components[c])[std::size_t(i) * cloth_.lattice.columns + j] = double(cloth_.row(vector, i, c)[j]) / divisor;
  };
  copy(vector_x, state.x, 1), copy(vector_v, state.v, cloth_.velocity_scale());
}

template <class R, unsigned Present>
std::shared_ptr<const HeldMotion> CpuEngine<R, Present>::held_motion() const {
  assert(backup_.size() <= cloth_.vectors.size());
  auto held = std::make_shared<CpuMotion<R>>();
  held->method = scheme_->name, held->synchronized = synchronized_;
  held->vectors.assign(cloth_.vectors.begin(), cloth_.vectors.begin() + std::ptrdiff_t(backup_.size()));
  held->control = control_, held->given = guard_.given();
  return held;
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::go_on_from(const HeldMotion& then) {
  const auto* held = dynamic_cast<const CpuMotion<R>*>(&then);
  if (held == nullptr || held->method != scheme_->name) return;
  assert(held->vectors.size() == backup_.size() &&
         held->vectors.front().all().size() == cloth_.vector(vector_x).all().size());
  for (std::size_t n = 0; n < held->vectors.size(); ++n) cloth_.vectors[n] = held->vectors[n];
  set_synchronized(held->synchronized);
  control_ = held->control, knows_first_a_ = false;
  forget_self();
  guard_.resume(held->given, cloth_.preset, cloth_.lattice, cloth_.held);
}

template <class R, unsigned Present>
PositionView CpuEngine<R, Present>::positions() const {
  PositionView view{cloth_.lattice.rows, cloth_.lattice.columns, 3 * cloth_.stride};
  for (int c = 0; c < 3; ++c) {
    if constexpr (std::is_same_v<R, float>)
      view.f[c] = cloth_.row(vector_x, 0, c);
    else
      view.d[c] = cloth_.row(vector_x, 0, c);
  }
  return view;
}

template <class R, unsigned Present>
StoredParticle CpuEngine<R, Present>::stored(int i, int j) const {
  assert(cloth_.lattice.contains(i, j));
  const auto at = [&](int vector) {
    return glm::dvec3(cloth_.row(vector, i, 0)[j], cloth_.row(vector, i, 1)[j], cloth_.row(vector, i, 2)[j]);
  };
  const double scale = cloth_.velocity_scale();
  return {at(vector_x), at(vector_v) / scale, at(cloth_.seen_velocity) / scale, lag()};
}

template <class R, unsigned Present>
std::size_t CpuEngine<R, Present>::bytes() const {
  std::size_t total = acceleration_.bytes() + lagged_.bytes() + solver_.bytes() + projector_.bytes() +
                      constant_.bytes() + descent_.bytes() + cloth_.springs.bytes() + cloth_.fixed.size() +
                      guards_.size() + (cloth_.fixed_columns.size() + cloth_.fixed_begin.size()) * sizeof(int);
  for (const auto* list : {&bands_, &waves_})
    for (const auto& band : *list) total += band->bytes();
  for (const auto* fields : {&cloth_.vectors, &backup_})
    for (const Field& field : *fields) total += field.bytes();
  total += loose_.springs.capacity() * sizeof(typename Loose::Spring) +
           loose_.others.capacity() * sizeof(LooseStencil) + loose_.force.bytes();
  if (self_ == nullptr) return total;
  for (const auto* list : {&self_->x, &self_->v, &self_->F}) total += list->capacity() * sizeof(glm::dvec3);
  return total + self_->contact.bytes() + self_->rows_before.bytes() + self_->force.bytes();
}

template <class R, unsigned Present>
SolveCounts CpuEngine<R, Present>::solves() const {
  SolveCounts counts = solver_.counts();
  counts.linear += damping_products_;
  return guard_.with_steps(counts);
}

template <class R, unsigned Present>
std::vector<StepFeature> CpuEngine<R, Present>::features() const {
  const Preset& p = cloth_.preset;
  const bool cloth = p.kind == Kind::cloth;
  const auto swept = [&](unsigned feature) { return (cloth_.features & feature) != 0; };
  return {{"bending", cloth && swept(bending)},
          {"rigidity", cloth && swept(linear)},
          {"curl", force::curl.on(p)},
          {"self", self_ != nullptr && self_->contact.near()},
          {"damping", swept(damping)},
          {"wind", cloth && swept(wind)},
          {"air", cloth && swept(air)},
          {"bodies", has(part::bodies) && !p.bodies.empty()},
          {"tearing", has(part::tearing) && tears_springs(p)},
          {"pins", has(part::pins) && !pinned_.empty()},
          {"hand", has(part::hand) && cloth_.held.particle >= 0}};
}

template <class R, unsigned Present>
std::string CpuEngine<R, Present>::name() const {
  const int threads = team_->capacity();
  return std::string("CPU, ") + cloth_.sweeps.target + ", " + std::to_string(threads) +
         (threads == 1 ? " thread" : " threads");
}

std::unique_ptr<Engine> make_cpu_engine(const Preset& preset, const Lattice& lattice, int threads) {
  if (preset.precision == Precision::double_) return std::make_unique<CpuEngine<double>>(preset, lattice, threads);
  return std::make_unique<CpuEngine<float>>(preset, lattice, threads);
}

#define TYGLAB_MAKE(R, present) template class CpuEngine<R, (present)>;
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

std::unique_ptr<Engine> make_engine_without([[maybe_unused]] unsigned absent, [[maybe_unused]] const Preset& preset,
                                            [[maybe_unused]] const Lattice& lattice) {
#ifdef TYGLAB_WHOLE_ENGINES
  throw EngineError("this build, with sanitizers, has no engine without some parts; use the release build");
#else
#define TYGLAB_MAKE(R, present) \
  if (absent == (part::everything & ~(present))) return std::make_unique<CpuEngine<R, (present)>>(preset, lattice, 1);
  TYGLAB_FOR_EACH_PART(TYGLAB_MAKE)
#undef TYGLAB_MAKE
  return nullptr;
#endif
}

}  // namespace tyglab::cpu
