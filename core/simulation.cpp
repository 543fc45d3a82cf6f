#include "core/simulation.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iostream>
#include <utility>

#include "core/cloth/state.h"
#include "core/contact/crossings.h"
#include "core/contact/self_contact.h"
#include "core/engines/still_engine.h"
#include "core/forces/force.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// What no start depends on: it is seen, named or met later.
constexpr EffectSet met_later = motionless | Effect::bodies | Effect::tearing | Effect::tolerance;
/// For these the state must be read and loaded again: another engine or another method's vectors.
constexpr EffectSet conversion{Effect::integrator, Effect::precision, Effect::device, Effect::engine};

Ledger::Source source_of(const Edit& edit) {
  if (std::holds_alternative<edit::Cut>(edit) || std::holds_alternative<edit::CutSprings>(edit))
    return Ledger::Source::tearing;
  const bool hand = std::holds_alternative<edit::Grab>(edit) || std::holds_alternative<edit::MoveHand>(edit) ||
                    std::holds_alternative<edit::Release>(edit);
  return hand ? Ledger::Source::hand : Ledger::Source::edits;
}

/// Of a motion that is beyond what the scene can hold.
std::string cause_of_runaway(const AdvanceResult& part, const Preset& preset) {
  if (part.quantity == "position") return "a particle is farther away than the energy of the scene can carry it";
  return excess_in_words(part.excess, preset);
}

}  // namespace

std::string Divergence::where() const {
  const auto site = [](int row, int column) { return "(" + std::to_string(row) + ", " + std::to_string(column) + ")"; };
  return di == 0 && dj == 0 ? "particle " + site(i, j) : "spring " + site(i, j) + "–" + site(i + di, j + dj);
}

std::string Divergence::in_words() const {
  std::string text = "diverged at t = ";
  append_number(text, t, 6);
  text += " s (step " + std::to_string(step) + "), " + where() + ": " + quantity + " = ";
  text += std::isfinite(value) ? printed("%.4g", value) : short_number(value);
  text += quantity == "velocity" ? " m/s" : " m";
  return text + "; " + cause + ". " + advice;
}

namespace {

/// Studies take steps finer and coarser than those that a preset may ask for, so any dt > 0 will do. What else is wrong
/// goes to standard error, where the assertion that fails for it does not say.
[[maybe_unused]] bool can_run(Preset preset) {
  const bool steps = preset.dt > 0 && std::isfinite(preset.dt);
  preset.dt = Preset().dt;
  const std::string problem = steps ? check_preset(preset) : "dt: must be a finite number above 0";
  if (!problem.empty()) std::cerr << problem << "\n";
  return problem.empty();
}

}  // namespace

/// Makes one particle of a state the same as another.
static void copy_particle(State& state, int from, int to) {
  for (VectorField<double>* field : {&state.x, &state.v})
    for (Array<double>* component : {&field->x, &field->y, &field->z})
      (*component)[std::size_t(to)] = (*component)[std::size_t(from)];
}

/// The pinned particles, and what stands in rows for copies without being one: that is held where it is.
static std::vector<int> with_absent(std::span<const int> pinned, const Tears& tears) {
  std::vector<int> all(pinned.begin(), pinned.end());
  for (int n = tears.particles(); n < tears.lattice().size(); ++n) all.push_back(n);
  return all;
}

/// A mask of the particles that a preset pins: those of pinned sites.
static std::vector<std::uint8_t> pins_of(const Preset& preset, const Tears& tears) {
  std::vector<std::uint8_t> mask = pinned_particles(preset);
  mask.resize(std::size_t(tears.lattice().size()), 0);
  for (int n = tears.lattice().sites().size(); n < tears.particles(); ++n)
    mask[std::size_t(n)] = mask[std::size_t(tears.mesh()->site(n))];
  return mask;
}

/// Rows of sites, and below them copies where their sites are; `sites` must outlive them.
static StateRows copied_rows(const StateRows& sites, const Tears& tears) {
  if (tears.mesh() == nullptr) return sites;
  const Lattice& lattice = tears.lattice();
  auto state = std::make_shared<State>();
  state->x.resize(std::size_t(lattice.size())), state->v.resize(std::size_t(lattice.size()));
  const auto row = [&](int i) {
    const std::size_t at = std::size_t(i) * lattice.columns;
    return StateRow{{&state->x.x[at], &state->x.y[at], &state->x.z[at]},
                    {&state->v.x[at], &state->v.y[at], &state->v.z[at]}};
  };
  for (int i = 0; i < lattice.sites().rows; ++i) sites(i, row(i));
  for (int n = lattice.sites().size(); n < tears.particles(); ++n) copy_particle(*state, tears.mesh()->site(n), n);
  return [state, rows = rows_of(*state, lattice.columns)](int i, const StateRow& to) { rows(i, to); };
}

Simulation::Simulation(const Preset& preset, int threads) : threads_(threads), past_(preset) {
  assert(threads >= 1 && can_run(preset));
  build(preset);
}
Simulation::~Simulation() = default;

Simulation::Simulation(const Simulation& from)
    : preset_(from.preset_),
      effective_preset_(from.effective_preset_),
      pushed_until_(from.pushed_until_),
      threads_(from.threads_),
      stop_(from.stop_),
      step_limit_(from.step_limit_),
      lattice_(from.lattice_),
      tears_(from.tears_),
      pinned_mask_(from.pinned_mask_),
      pinned_(from.pinned_),
      moving_pins_(from.moving_pins_),
      driven_(from.driven_),
      held_(from.held_),
      hand_steps_left_(from.hand_steps_left_),
      hand_force_(from.hand_force_),
      left_inside_(from.left_inside_),
      steps_(from.steps_),
      steps_at_dt_(from.steps_at_dt_),
      time_at_dt_(from.time_at_dt_),
      untouched_(from.untouched_),
      divergence_(from.divergence_),
      diverged_preset_(from.diverged_preset_),
      revision_(from.revision_),
      tear_revision_(from.tear_revision_),
      watch_(from.watch_),
      past_(from.past_),
      keeps_hashes_(from.keeps_hashes_) {}

void Simulation::build(const Preset& next) {
  driven_.clear();
  lattice_ = lattice_of(next);
  tears_ = Tears(lattice_);
  pinned_mask_ = pinned_particles(next);
  pinned_ = particles_in(pinned_mask_);
  engine_ = made_engine(in_gusts(next, 0), {pinned_, {}}, start_rows(next), tears_, 0);
  preset_ = next, effective_preset_ = in_gusts(next, 0);
  moving_pins_ = moving_pins(preset_, pinned_);
  untouched_ = true;
  ++revision_, ++tear_revision_;
}

/// Becomes the other one, which has been made beside it.
void Simulation::take(Simulation& other) noexcept {
  const std::uint64_t revision = revision_, tear_revision = tear_revision_;
  *this = std::move(other);
  revision_ = revision + 2, tear_revision_ = tear_revision + 1, state_revision_ = ~0ull;
}

/// An engine for these constants without a state. Throws EngineError.
std::unique_ptr<Engine> Simulation::bare_engine(const Preset& acts, const Lattice& lattice) const {
  auto engine = make_engine(acts, lattice, threads_);
  engine->stop_when(stop_), engine->limit_steps(step_limit_);
  engine->note_contacts(watch_.has_value());
  return engine;
}

/// An engine for these constants, with the wind as it blows then, with that state, at time t, s. Throws EngineError;
/// the present engine goes on then.
std::unique_ptr<Engine> Simulation::made_engine(const Preset& acts, const Fixed& fixed, const StateRows& rows,
                                                const Tears& tears, double t) const {
  auto engine = bare_engine(acts, tears.lattice());
  engine->set_fixed(with_absent(fixed.pinned, tears), fixed.held);
  engine->drive_pins(driven_, false);
  engine->next_step({t, 0});
  engine->load(rows, tears);
  return engine;
}

double Simulation::time() const {
  return time_at_dt_ + double(steps_ - steps_at_dt_) * preset_.dt;
}

std::optional<Pins::Site> Simulation::held() const {
  if (held_.particle < 0) return std::nullopt;
  return Pins::Site{held_.particle / lattice_.columns, held_.particle % lattice_.columns};
}

void Simulation::rebase_time() {
  time_at_dt_ = time();
  steps_at_dt_ = steps_;
}

/// Another particle in the hand, or another velocity of it.
void Simulation::hold(const Held& held) {
  fix(pinned_, held);
  held_ = held;
}

/// Tells the engine which particles are fixed from now on, unless they are fixed in the same way already. `others`:
/// they move in another way.
void Simulation::fix(std::span<const int> pinned, const Held& held, bool others) {
  others = others || held.particle != held_.particle ||
           !std::equal(pinned.begin(), pinned.end(), pinned_.begin(), pinned_.end());
  if (!others && held.velocity == held_.velocity) return;
  const std::vector<int> all = with_absent(pinned, tears_);
  engine_->prepare(all.size());
  // Only damping and air depend on the velocity of the hand.
  if (others || force::damping.on(preset_) || force::air.on(preset_)) engine_->synchronize(tears_);
  engine_->set_fixed(all, held);
  driven_.clear();
}

/// Of these pinned particles those that move, from where they are now.
MovingPins Simulation::moving_pins(const Preset& preset, std::span<const int> pinned) const {
  if (preset.pins.motions.empty()) return {};
  const auto x_of = [&](int p) { return position(p / lattice_.columns, p % lattice_.columns); };
  return MovingPins(preset, tears_, pinned, x_of, time());
}

/// Gives pins that move the velocities of the coming step. Returns for how many steps they keep them.
int Simulation::drive_pins() {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  const std::int64_t step = steps_ - steps_at_dt_;
  const PinSpan span = pin_span(preset_.pins.motions, step, time_at_dt_, preset_.dt);
  const bool begins = span.begin == step, jumps = begins && span.after_jump;
  if (begins || driven_.empty()) {
    std::vector<DrivenPin> driven = moving_pins_.in(span, preset_.pins.motions, time_at_dt_, preset_.dt);
    // Where velocities jump, so do the damping and the air of particles beside them.
    if (jumps && (force::damping.on(preset_) || force::air.on(preset_))) engine_->synchronize(tears_);
    engine_->drive_pins(driven, begins);
    driven_ = std::move(driven);
    if (jumps) watch_edit(Ledger::Source::hand);
  }
  return int(std::min(span.end - step, most));
}

/// The recording once that edit has been made.
Recording Simulation::past_with(const Edit& edit) const {
  Recording past = past_;
  past.add(std::visit(
      Overloaded{[&](const edit::Change& e) -> Event { return event::Change{settings_between(preset_, e.preset)}; },
                 [](const auto& e) -> Event { return e; }},
      edit));
  return past;
}

void Simulation::continue_recording(const Simulation& replaced) {
  assert(steps_ == 0);
  Recording past = replaced.past_with(edit::Change{preset_});
  past.add(edit::Restart{});
  past_ = std::move(past), keeps_hashes_ = replaced.keeps_hashes_;
}

void Simulation::apply(const Edit& edit) {
  if (rebuilds(edit)) {
    const std::unique_ptr<Simulation> other = rebuilt(edit);
    other->stop_when(stop_);
    return take(*other);
  }
  if (watch_) energy();  // whose memory is there then once the edit has been made
  Recording past = past_with(edit);
  std::visit(Overloaded{[&](const edit::Change& e) { change(e.preset); }, [](const edit::Restart&) {},
                        [&](const edit::Grab& e) { grab(e); }, [&](const edit::MoveHand& e) { move_hand(e); },
                        [&](const edit::Release&) { release(); }, [&](const edit::Cut& e) { cut(e); },
                        [&](const edit::CutSprings& e) { cut_springs(e); }, [&](const edit::Pin& e) { pin(e); },
                        [&](const edit::MoveBody& e) { move_body(e); }},
             edit);
  ++revision_;
  past_ = std::move(past);
  watch_edit(source_of(edit));
}

/// What the present arrays take. All that needs memory comes first.
void Simulation::change(const Preset& next) {
  if (const auto problem = check_preset(next); !problem.empty()) throw PresetError(problem);
  // The guard keeps apart what is apart.
  if (guards_itself(next) && !guards_itself(preset_))
    if (const Crossings crossings = count_crossings(read().x, tears_); crossings.pairs > crossings.around_sites)
      throw PresetError("contact.self: guard: the cloth crosses itself now, in " + grouped(crossings.pairs) +
                        (crossings.pairs == 1 ? " pair" : " pairs") +
                        " of triangles, and a guard does not part them; restart the scene, or use repel");
  check_tears(next);
  const EffectSet changed = changes(preset_, next);
  const bool moves = !changed.within(motionless) || pushed_until_, pins = changed.touches(Effect::pins);
  // The wind of the coming step is set when the step begins, or by an edit of what it depends on.
  const bool blows = changed.touches(Effect::force | Effect::dt);
  Preset own = next, acts = blows ? in_gusts(next, time()) : merge(preset_, next, acting());
  std::vector<std::uint8_t> pinned_mask = pins ? pins_of(next, tears_) : std::vector<std::uint8_t>();
  std::vector<int> pinned = particles_in(pinned_mask);
  MovingPins moving = pins ? moving_pins(next, pinned) : MovingPins();
  if (pins) engine_->prepare(with_absent(pinned, tears_).size());
  if (moves) engine_->set_preset(acts, tears_);
  if (next.dt != preset_.dt) rebase_time();
  if (pins) {
    const Held held = held_.particle >= 0 && pinned_mask[held_.particle] ? Held{} : held_;
    fix(pinned, held, next.pins.motions != preset_.pins.motions);
    held_ = held, pinned_mask_ = std::move(pinned_mask), pinned_ = std::move(pinned);
    moving_pins_ = std::move(moving);
  }
  if (blows || changed.touches(Effect::bodies)) pushed_until_.reset();
  preset_ = std::move(own), effective_preset_ = std::move(acts);
}

/// Whether a change is a fresh start: while nothing has moved the cloth, where what differs has a part in it. Who asks
/// for the same again asks for one.
bool Simulation::restarts(EffectSet changed) const {
  return untouched_ && (changed.empty() || !changed.within(met_later));
}

/// A cloth that has torn by one rule goes on by it.
void Simulation::check_tears(const Preset& next) const {
  if (parts(next) != parts(preset_) && !tears_.untorn())
    throw PresetError("tearing.mode: the cloth has torn by the rule " + preset_.tearing + "; restart the scene first");
}

void Simulation::take_engine(const Preset& next, const State& state) {
  engine_ = made_engine(in_gusts(next, time()), {pinned_, held_}, rows_of(state, lattice_.columns), tears_, time());
  if (next.dt != preset_.dt) rebase_time();
  preset_ = next, effective_preset_ = in_gusts(next, time()), pushed_until_.reset();
}

/// The wind of the steps that come, where it blows in gusts. Returns for how many of them it stays as it is.
int Simulation::update_gust() {
  const GustSpan span = gust_span(preset_, time());
  const glm::dvec3 W = span.factor * preset_.W, u = span.factor * preset_.u;
  if (W != effective_preset_.W || u != effective_preset_.u) {
    if (watch_) energy();
    const glm::dvec3 before = std::exchange(effective_preset_.W, W);
    const glm::dvec3 u_before = std::exchange(effective_preset_.u, u);
    try {
      engine_->set_preset(effective_preset_, tears_);
    } catch (...) {
      effective_preset_.W = before, effective_preset_.u = u_before;
      throw;
    }
    watch_edit(Ledger::Source::edits);
  }
  return span.steps;
}

void Simulation::take_pins() {
  pinned_mask_ = pins_of(preset_, tears_);
  pinned_ = particles_in(pinned_mask_);
  hold(held_.particle >= 0 && pinned_mask_[held_.particle] ? Held{} : held_);
  moving_pins_ = moving_pins(preset_, pinned_);
}

bool Simulation::rebuilds(const Edit& edit) const {
  if (std::holds_alternative<edit::Restart>(edit)) return true;
  const auto* change = std::get_if<edit::Change>(&edit);
  if (change == nullptr) return false;
  const EffectSet changed = changes(preset_, change->preset);
  return changed.touches(Effect::rebuild) || restarts(changed) || changed.touches(conversion);
}

std::unique_ptr<Simulation> Simulation::rebuilt(const Edit& edit) const {
  const auto* change = std::get_if<edit::Change>(&edit);
  const Preset& next = change != nullptr ? change->preset : preset_;
  if (const auto problem = check_preset(next); !problem.empty()) throw PresetError(problem);
  const EffectSet changed = changes(preset_, next);
  Recording past = past_with(edit);
  if (change == nullptr || changed.touches(Effect::rebuild)) {
    auto fresh = std::make_unique<Simulation>(next, threads_);
    fresh->enable_ledger(watch_.has_value()), fresh->limit_steps(step_limit_);
    fresh->past_ = std::move(past), fresh->keeps_hashes_ = keeps_hashes_;
    return fresh;
  }
  check_tears(next);
  std::unique_ptr<Simulation> other(new Simulation(*this));
  if (untouched_) {
    other->restart_untouched(next);
  } else {
    State state;
    {
      const std::lock_guard lock(*reading_);
      engine_->read(state, tears_);
    }
    other->take_engine(next, state);
    if (changed.touches(Effect::pins)) other->take_pins();
  }
  ++other->revision_;
  other->past_ = std::move(past);
  other->watch_edit(Ledger::Source::edits);
  return other;
}

std::unique_ptr<Simulation> Simulation::stand_in() const {
  std::unique_ptr<Simulation> other(new Simulation(*this));
  other->engine_ = std::make_unique<StillEngine>(*engine_, acting(), lattice_, tears_);
  return other;
}

/// Takes a preset of the same lattice before the first step: what counts at the start alone counts at once; cuts and
/// the hand stay.
void Simulation::restart_untouched(const Preset& next) {
  std::vector<std::uint8_t> pinned_mask = pins_of(next, tears_);
  const Held held = held_.particle >= 0 && pinned_mask[held_.particle] ? Held{} : held_;
  const Fixed fixed{particles_in(pinned_mask), held};
  driven_.clear();
  engine_ = made_engine(in_gusts(next, time()), fixed, copied_rows(start_rows(next), tears_), tears_, time());
  preset_ = next, effective_preset_ = in_gusts(next, time()), pushed_until_.reset();
  divergence_.reset();
  pinned_mask_ = std::move(pinned_mask);
  pinned_ = fixed.pinned;
  held_ = held;
  moving_pins_ = moving_pins(preset_, pinned_);
}

void Simulation::grab(const edit::Grab& e) {
  if (preset_.kind != Kind::cloth || !has(e.i, e.j) || pinned(e.i, e.j)) return;
  hold({e.i * lattice_.columns + e.j, {0, 0, 0}});
  hand_steps_left_ = 0;
  hand_force_ = {};
}

void Simulation::move_hand(const edit::MoveHand& e) {
  if (held_.particle < 0 || e.steps <= 0) return;
  const auto site = *held();
  hold({held_.particle, (e.to - position(site.i, site.j)) / (e.steps * preset_.dt)});
  hand_steps_left_ = e.steps;
}

void Simulation::release() {
  if (held_.particle < 0) return;
  hold({});
  hand_force_ = {};
}

void Simulation::cut(const edit::Cut& e) {
  if (parts(preset_)) return part(openings_of_path(tears_, e.sites));
  edit::CutSprings all;
  for (const auto [i, j] : e.sites) {
    all.springs.push_back({2, i - 1, j - 1});  // to (i-1, j-1): owned by that particle, direction SE
    all.springs.push_back({1, i - 1, j});      // S
    all.springs.push_back({3, i - 1, j + 1});  // SW
  }
  cut_springs(all);
}

void Simulation::cut_springs(const edit::CutSprings& e) {
  if (parts(preset_)) return part(openings_of_cut(tears_, e.springs));
  Tears tears = tears_;
  for (const SpringSite& spring : e.springs)
    if (spring.direction >= 0 && spring.direction < stretch_directions)
      tears.tear(spring.direction, spring.i, spring.j);
  if (tears.torn_count() != tears_.torn_count()) engine_->synchronize(tears_);
  tears_ = std::move(tears);
  ++tear_revision_;
}

/// Parts particles. All that takes memory comes first.
void Simulation::part(const std::vector<Opening>& openings) {
  if (openings.empty()) return;
  auto mesh = std::make_shared<Mesh>(tears_.mesh() != nullptr ? *tears_.mesh() : Mesh(lattice_));
  State state = read();
  const int before = mesh->particles();
  for (const Opening& opening : openings) mesh->part(opening.particle, opening.cells);
  // Rows for copies double, so that engines are seldom made anew.
  Lattice next = lattice_;
  while (mesh->particles() > next.size()) {
    const int more = std::max(lattice_.copy_rows, 1);
    next.rows += more, next.copy_rows += more;
  }
  Tears tears(next, mesh);
  for (VectorField<double>* field : {&state.x, &state.v})
    for (Array<double>* component : {&field->x, &field->y, &field->z}) component->resize(std::size_t(next.size()), 0);
  for (int n = before; n < next.size(); ++n)
    copy_particle(state, n < mesh->particles() ? openings[std::size_t(n - before)].particle : 0, n);
  std::vector<std::uint8_t> pinned_mask = pins_of(preset_, tears);
  std::vector<int> pinned = particles_in(pinned_mask);
  MovingPins moving = moving_pins_;
  for (int n = before; n < mesh->particles(); ++n) moving.copy(openings[std::size_t(n - before)].particle, n);
  if (next != lattice_) {
    auto engine = made_engine(acting(), {pinned, held_}, rows_of(state, next.columns), tears, time());
    engine->continue_counts(engine_->inner_steps());
    engine_ = std::move(engine);
  } else {
    const std::vector<int> all = with_absent(pinned, tears);
    engine_->prepare(all.size());
    engine_->set_fixed(all, held_);
    engine_->next_step({time_at_dt_, steps_ - steps_at_dt_});
    engine_->load(state, tears);
  }
  lattice_ = next, tears_ = std::move(tears);
  pinned_mask_ = std::move(pinned_mask), pinned_ = std::move(pinned);
  driven_.clear(), moving_pins_ = std::move(moving);
  ++tear_revision_, ++revision_;
}

/// After a step that left springs overloaded. Returns how many copies there are more.
int Simulation::part_overloaded() {
  const State& state = read();
  std::vector<glm::dvec3> x;
  for (std::size_t n = 0; n < state.x.x.size(); ++n) x.emplace_back(state.x.x[n], state.x.y[n], state.x.z[n]);
  std::vector<int> fixed = pinned_;
  if (held_.particle >= 0) fixed.push_back(held_.particle);
  const std::vector<Opening> openings = openings_of_overload(preset_, tears_, x, guarded_sites(tears_, fixed));
  part(openings);
  return int(openings.size());
}

void Simulation::pin(const edit::Pin& e) {
  if (preset_.kind != Kind::cloth || !has(e.i, e.j)) return;
  // The preset says what is pinned, so that it can be saved: by a list from now on. It names sites, so all particles of
  // one are pinned or none is.
  const Pins::Site site = tears_.site(e.i * lattice_.columns + e.j);
  std::vector<std::uint8_t> pinned_mask = pinned_mask_;
  std::vector<Pins::Site> list;
  for (int n = 0; n < tears_.particles(); ++n) {
    if (tears_.site(n) == site) pinned_mask[std::size_t(n)] = e.pinned;
    if (pinned_mask[std::size_t(n)] != 0 && n < lattice_.sites().size()) list.push_back(tears_.site(n));
  }
  std::vector<int> pinned = particles_in(pinned_mask);
  const bool lets_go = held_.particle >= 0 && tears_.site(held_.particle) == site;
  MovingPins moving = pinned == pinned_ ? moving_pins_ : moving_pins(preset_, pinned);
  fix(pinned, lets_go ? Held{} : held_);
  if (lets_go) held_ = {}, hand_force_ = {};
  pinned_mask_ = std::move(pinned_mask), pinned_ = std::move(pinned);
  preset_.pins.mode = Pins::Mode::list, preset_.pins.list = std::move(list);
  moving_pins_ = std::move(moving);
}

void Simulation::move_body(const edit::MoveBody& e) {
  if (e.index < 0 || e.index >= int(preset_.bodies.size())) return;
  Preset next = preset_;
  Body& body = next.bodies[std::size_t(e.index)];
  const Body now = body_at(body, time());
  const bool plane = body.shape == Body::Shape::plane, moves = !(now == body);
  const glm::dvec3 by = e.c - (plane ? glm::dvec3(0, now.y, 0) : now.c);
  if (plane)
    body.y = moves ? body.y + by.y : e.c.y;
  else
    body.c = moves ? body.c + by : e.c;
  for (PathKey& key : body.path) key.x += by;
  const bool on_its_way = e.steps > 0 && !moves;
  const Body acting_now = body_at(acting().bodies[std::size_t(e.index)], time());
  if (!on_its_way) return change(next);
  // Until then it follows a path, at the velocity of the move.
  if (const auto problem = check_preset(next); !problem.empty()) throw PresetError(problem);
  Preset acts = acting();
  Body& pushed = acts.bodies[std::size_t(e.index)] = body;
  pushed.path = {{time(), plane ? glm::dvec3(0, acting_now.y, 0) : acting_now.c},
                 {time() + e.steps * preset_.dt, plane ? glm::dvec3(0, body.y, 0) : body.c}};
  engine_->set_preset(acts, tears_);
  preset_ = std::move(next), effective_preset_ = std::move(acts), pushed_until_ = steps_ + e.steps;
}

/// Bodies that were on their way have arrived.
void Simulation::end_push() {
  Preset acts = effective_preset_;
  acts.bodies = preset_.bodies;
  engine_->set_preset(acts, tears_);
  effective_preset_ = std::move(acts), pushed_until_.reset();
}

std::vector<Body> Simulation::bodies() const {
  std::vector<Body> all = acting().bodies;
  for (Body& body : all) body = body_at(body, time());
  return all;
}

Preset Simulation::posed() const {
  Preset preset = preset_;
  preset.bodies = bodies();
  return preset;
}

void Simulation::limit_steps(double seconds) {
  assert(seconds >= 0);
  step_limit_ = seconds;
  if (seconds > 0) past_.give_up_repeating();
  engine_->limit_steps(seconds);
}

void Simulation::stop_when(Stop stop) {
  stop_ = std::move(stop);
  engine_->stop_when(stop_);
}

AdvanceResult Simulation::advance(int steps) {
  AdvanceResult total;
  while (!divergence_ && !total.stopped && total.steps < steps) {
    const AdvanceResult part = advance_part(watch_ ? 1 : steps - total.steps);
    const int before = total.steps, torn = total.torn;
    const bool released = total.released;
    total = part;
    total.steps += before, total.torn += torn, total.released |= released;
  }
  return total;
}

/// As far as the engine goes by itself: what follows from the steps is done.
AdvanceResult Simulation::advance_part(int steps) {
  const std::int64_t between = Recording::between_hashes(past_.steps());
  // A device would have to hand over all positions.
  const bool hashes = keeps_hashes_ && preset_.engine != EngineKind::opencl;
  if (hashes) steps = int(std::min<std::int64_t>(steps, between - past_.steps() % between));
  if (held_.particle >= 0 && hand_steps_left_ > 0) steps = std::min(steps, hand_steps_left_);
  if (pushed_until_ && *pushed_until_ <= steps_) end_push();
  if (pushed_until_) steps = int(std::min<std::int64_t>(steps, *pushed_until_ - steps_));
  if (gusts(preset_)) steps = std::min(steps, update_gust());
  if (!moving_pins_.empty()) steps = std::min(steps, drive_pins());
  const bool splits = preset_.contact == "global" && !preset_.bodies.empty();
  if (watch_ && !splits) watch_->before_step(preset_, tears_);
  engine_->next_step({time_at_dt_, steps_ - steps_at_dt_});
  AdvanceResult part = splits ? step_to_impacts() : engine_->advance(steps, tears_);
  steps_ += part.steps, past_.add_steps(part.steps);
  if (part.steps > 0) untouched_ = false, ++revision_;
  left_inside_ = part.left_inside;
  if (part.torn > 0) ++tear_revision_;
  if (held_.particle >= 0) hand_force_ = part.hand_force;
  if (part.diverged) diverge(part);
  if (watch_ && part.steps > 0 && !splits) watch_step(acting());
  if (part.overloaded)
    if (const int more = part_overloaded(); more > 0) part.torn += more, watch_edit(Ledger::Source::tearing);
  part.diverged = divergence_.has_value();
  if (part.released) release(), watch_edit(Ledger::Source::hand);
  if (held_.particle >= 0 && hand_steps_left_ > 0 && (hand_steps_left_ -= part.steps) <= 0) {
    hold({held_.particle, {0, 0, 0}});
    watch_edit(Ledger::Source::hand);
  }
  if (part.diverged) past_.add(event::Diverge{});
  if (hashes && part.steps > 0 && past_.steps() % between == 0) past_.add(event::Hash{hash()});
  if (hashes && part.steps > 0 && past_.steps() % (Recording::hashes_a_look * between) == 0) past_.add(look());
  return part;
}

event::Look Simulation::look() const {
  const Lattice sites = lattice_.sites();
  event::Look look;
  for (const int i : {0, sites.rows / 2, sites.rows - 1})
    for (const int j : {0, sites.columns / 2, sites.columns - 1}) look.x.push_back(position(i, j));
  return look;
}

std::uint64_t Simulation::hash() const {
  constexpr std::uint64_t seed = 14695981039346656037u, factor = 0x9e3779b97f4a7c15u;
  std::uint64_t hash = seed;
  const auto add = [&](const auto* numbers, std::size_t count) {
    const auto* bytes = reinterpret_cast<const char*>(numbers);
    const std::size_t end = count * sizeof *numbers;
    for (std::size_t at = 0; at < end; at += sizeof hash) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at, std::min(sizeof word, end - at));
      hash = std::rotl(hash ^ word, 29) * factor;
    }
  };
  const PositionView view = engine_->positions();
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0, stride = std::size_t(view.stride); i < std::size_t(view.rows); ++i)
      if (view.f[c] != nullptr)
        add(view.f[c] + i * stride, std::size_t(view.columns));
      else
        add(view.d[c] + i * stride, std::size_t(view.columns));
  return hash;
}

double Simulation::excess() {
  const double given = engine_->given_squared();
  if (divergence_ || !(given > 0) || std::isinf(given)) return 0;
  const Energy now = energy().energy;
  return 2 / preset_.m * (now.kinetic + now.elastic()) / given;
}

void Simulation::diverge(const AdvanceResult& part) {
  Divergence d;
  d.step = steps_ + 1;
  d.t = time() + preset_.dt;
  d.i = part.i, d.j = part.j, d.di = part.di, d.dj = part.dj;
  d.quantity = part.quantity;
  d.value = part.value;
  const bool runaway = part.excess > 0;
  d.cause = runaway                            ? cause_of_runaway(part, preset_)
            : part.quantity == "spring length" ? "a spring is more than 1000 times its rest length"
            : part.quantity == "distance from x_0"
                ? "the mass is farther from x_0 than 1000 times L (or than its offset, if that is larger)"
                : "a " + part.quantity + " is no longer a finite number";
  if (!runaway && springs_too_weak(preset_)) {
    d.cause += preset_.kind == Kind::cloth
                   ? ": the springs are too weak for weight" +
                         std::string(preset_.W != glm::dvec3(0) || force::air.on(preset_) ? " and wind" : "") +
                         (preset_.bodies.empty() ? "; " : " and for the push of bodies; ")
                   : ": the spring is too weak for m·g; ";
    d.cause += std::string(scheme(preset_.integrator).title) + " is stable here at dt = " + quantity(preset_.dt, "s");
    d.advice = advice_for_weak_springs(preset_);
  } else {
    d.cause += ": " + method_to_blame(preset_);
    d.advice = advice(preset_);
  }
  diverged_preset_ = preset_;
  divergence_ = std::move(d);
}

Snapshot Simulation::snapshot() {
  return {lattice_,
          preset_.kind,
          read(),
          tears_,
          time(),
          steps_,
          untouched_,
          preset_,
          engine_->held_motion(),
          steps_at_dt_,
          time_at_dt_,
          effective_preset_.W,
          effective_preset_.u,
          moving_pins_,
          past_,
          held_.particle < 0 && !pushed_until_};
}

void Simulation::restore(const Snapshot& then) {
  assert(fits(then));
  // All that takes memory comes first.
  Recording past = then.past;
  past.add(event::Resume{settings_between(then.of, preset_), then.held != nullptr});
  if (step_limit_ > 0) past.give_up_repeating();
  Tears tears = then.tears;
  std::vector<std::uint8_t> pinned_mask = pins_of(preset_, tears);
  std::vector<int> pinned = particles_in(pinned_mask);
  const bool repeats = then.held && changes(then.of, preset_).within(motionless);
  Preset gusty = in_gusts(preset_, then.t);
  // What the method held then belongs to the wind of its last step, and learns of the next one's when that begins.
  if (repeats) gusty.W = then.W, gusty.u = then.u;
  MovingPins moving;
  if (repeats)
    moving = then.moving_pins;
  else if (!preset_.pins.motions.empty())
    moving = MovingPins(
        preset_, tears, pinned,
        [&](int p) {
          const auto& x = then.state.x;
          return glm::dvec3(x.x[std::size_t(p)], x.y[std::size_t(p)], x.z[std::size_t(p)]);
        },
        then.t);
  std::vector<DrivenPin> driven;
  if (!moving.empty()) {
    const double since = repeats ? then.time_at_dt : then.t;
    const PinSpan span = pin_span(preset_.pins.motions, repeats ? then.steps - then.steps_at_dt : 0, since, preset_.dt);
    driven = moving.in(span, preset_.pins.motions, since, preset_.dt);
  }
  std::unique_ptr<Engine> other;
  if (then.lattice != lattice_) other = bare_engine(gusty, then.lattice);
  (other ? *other : *engine_).prepare(with_absent(pinned, tears).size());
  if (watch_) energy();
  if (other) {
    engine_ = std::move(other), lattice_ = then.lattice;
  } else if (gusts(preset_) || pushed_until_) {
    engine_->set_preset(gusty, tears_);
  }
  pinned_mask_ = std::move(pinned_mask), pinned_ = std::move(pinned);
  engine_->set_fixed(with_absent(pinned_, tears), {});
  engine_->drive_pins(driven, false);
  held_ = {}, driven_ = std::move(driven), moving_pins_ = std::move(moving);
  tears_ = std::move(tears), effective_preset_ = std::move(gusty), pushed_until_.reset();
  hand_steps_left_ = 0;
  hand_force_ = {};
  left_inside_ = 0;
  divergence_.reset();
  steps_ = steps_at_dt_ = then.steps;
  time_at_dt_ = then.t;
  untouched_ = then.untouched;
  engine_->next_step({time_at_dt_, 0});
  engine_->load(then.state, tears_);
  if (repeats) {
    engine_->go_on_from(*then.held);
    steps_at_dt_ = then.steps_at_dt, time_at_dt_ = then.time_at_dt;
  }
  ++revision_, ++tear_revision_;
  past_ = std::move(past);
  if (watch_) enable_ledger(true);
}

void Simulation::return_to(const Snapshot& then) {
  assert(then.held && then.alone && changes(then.of, preset_).within(motionless));
  restore(then);
  share_recording(then.past);
}

void Simulation::load(const State& state) {
  Recording past = past_;
  past.add(event::Load{std::make_shared<const State>(state)});
  engine_->next_step({time_at_dt_, steps_ - steps_at_dt_});
  engine_->load(state, tears_);
  moving_pins_ = moving_pins(preset_, pinned_);
  untouched_ = false;
  past_ = std::move(past);
  ++revision_;
}

std::size_t Simulation::bytes() const {
  return tears_.bytes() + pinned_mask_.capacity() + pinned_.capacity() * sizeof(int) + state_.x.bytes() +
         state_.v.bytes();
}

}  // namespace tyglab
