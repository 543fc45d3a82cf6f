// The plain cloth as an engine: what engine.h promises, around the loops of plain_cloth.h.
#include "core/engines/plain/plain_cloth.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/engines/step_guard.h"
#include "core/model/effect.h"
#include "core/simd/row_field.h"

namespace tyglab {
namespace {

using plain::Vector;

struct PlainMotion final : HeldMotion {
  std::string_view method;
  bool synchronized = true;
  std::vector<Vector> vectors;
  StepGuard::Given given;
  std::size_t bytes() const override { return vectors.size() * vectors.front().size() * sizeof(glm::dvec3); }
};

class PlainEngine final : public Engine, private GuardedSteps {
 public:
  PlainEngine(const Preset& preset, const Lattice& lattice)
      : lattice_(lattice), stride_(simd::row_stride<double>(lattice.columns)) {
    const std::size_t particles = std::size_t(lattice.size());
    cloth_.scheme = &scheme(preset.integrator);
    cloth_.fixed.assign(particles, 0);
    cloth_.vectors.assign(std::size_t(std::max(cloth_.scheme->vectors, 2)), Vector(particles, glm::dvec3(0)));
    for (auto* rows : {&x_, &v_}) rows->resize(lattice.rows, stride_);
    take_preset(preset);
  }

  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override;
  void synchronize(const Tears& tears) override;
  void set_preset(const Preset& preset, const Tears& tears) override;
  void set_fixed(std::span<const int> pinned, Held held) override;
  void drive_pins(std::span<const DrivenPin> pins, bool place) override;
  AdvanceResult advance(int steps, Tears& tears) override {
    if (guard_.springs_cut(tears)) guard_.accept_cuts(tears);
    return guard_.advance(*this, steps, tears, stop());
  }
  void note_contacts(bool) override {}
  std::vector<Contact> contacts() const override { return cloth_.contacts; }
  void read(State& state, const Tears& tears) override { read(state, tears, lag()); }
  void read_raw(State& state, const Tears& tears) override;
  std::shared_ptr<const HeldMotion> held_motion() const override;
  void go_on_from(const HeldMotion& then) override;
  PositionView positions() const override {
    return {lattice_.rows, lattice_.columns, 3 * stride_, {}, {x_.row(0, 0), x_.row(0, 1), x_.row(0, 2)}};
  }
  StoredParticle stored(int i, int j) const override {
    const std::size_t p = std::size_t(i) * std::size_t(lattice_.columns) + std::size_t(j);
    const double scale = cloth_.velocity_scale();
    return {cloth_.vectors[vector_x][p], cloth_.vectors[vector_v][p] / scale, cloth_.seen()[p] / scale, lag()};
  }
  std::size_t bytes() const override {
    return (cloth_.vectors.size() + backup_.vectors.size() + 2) * cloth_.fixed.size() * sizeof(glm::dvec3);
  }
  int threads() const override { return 1; }
  SolveCounts solves() const override { return guard_.with_steps({}); }
  double given_squared() const override { return guard_.given_squared(); }
  InnerSteps inner_steps() const override { return {}; }
  std::int64_t held_back() const override { return cloth_.held_back; }
  std::vector<StepFeature> features() const override;
  std::string name() const override { return "plain, double, 1 thread"; }

 private:
  double lag() const { return cloth_.synchronized ? 0 : cloth_.scheme->lag * cloth_.preset.dt; }
  /// F/m at the present positions, with the velocities that damping sees.
  Vector present_accelerations(const Tears& tears) {
    const int velocity = int(&cloth_.seen() - cloth_.vectors.data());
    return cloth_.accelerations(vector_x, velocity, 1 / cloth_.velocity_scale(), tears);
  }
  void read(State& state, const Tears& tears, double lag);
  void write_fixed_velocities();
  void take_preset(const Preset& preset);
  /// The rows that the guard and the drawing look at.
  void write_rows();
  StateView<double> view() const { return {x_.row(0), v_.row(0), stride_}; }

  // What the guard asks for.
  BatchResult make_steps(int most, Tears& tears, Fault& fault) override;
  StepMeasures measures(int) override;
  double tear_overloaded(Tears& tears) override { return cloth_.tear_overloaded(tears); }
  bool find_fault(Tears& tears, Fault& fault, double& divergence_budget) override {
    return tyglab::find_fault(cloth_.preset, lattice_, tears, view(), fault, divergence_budget);
  }
  bool find_runaway(const MotionLimit& limit, Fault& fault) override {
    return tyglab::find_runaway(limit, lattice_, view(), 1 / cloth_.velocity_scale(), fault);
  }
  Motion motion(const Tears& tears) override {
    return motion_of(cloth_.preset, lattice_, tears, cloth_.bodies(time_after(0, cloth_.preset.dt)), view(),
                     1 / cloth_.velocity_scale());
  }
  void keep_backup() override { backup_ = cloth_, step_backup_ = step(); }
  void step_once(const Tears& tears) {
    cloth_.step(tears, time_after(0, cloth_.preset.dt));
    count_steps(1);
    write_rows();
  }
  void repeat(int steps, Tears& tears) override;

  plain::Cloth cloth_, backup_;
  StepNumber step_backup_;
  Lattice lattice_;
  int stride_;
  simd::RowField<double> x_, v_;
  std::vector<int> pinned_;
  std::vector<DrivenPin> driven_;
  Held held_;
  StepGuard guard_;
};

void PlainEngine::take_preset(const Preset& preset) {
  cloth_.preset = preset;
  guard_.set_rules({.tearing = tears_springs(preset), .parting = parts(preset), .F_release = preset.F_release});
  guard_.set_scene(preset, lattice_, held_);
  guard_.invalidate();
}

void PlainEngine::write_rows() {
  for (std::size_t p = 0; p < cloth_.fixed.size(); ++p)
    for (int c = 0; c < 3; ++c) {
      const int i = int(p) / lattice_.columns, j = int(p) % lattice_.columns;
      x_.row(i, c)[j] = cloth_.vectors[vector_x][p][c], v_.row(i, c)[j] = cloth_.vectors[vector_v][p][c];
    }
}

void PlainEngine::load(const StateRows& rows, const Tears& tears) {
  const std::size_t columns = std::size_t(lattice_.columns);
  std::vector<double> row(6 * columns);
  const auto part = [&](std::size_t n) { return row.data() + n * columns; };
  for (std::size_t i = 0; i < std::size_t(lattice_.rows); ++i) {
    rows(int(i), {{part(0), part(1), part(2)}, {part(3), part(4), part(5)}});
    for (std::size_t j = 0; j < columns; ++j) {
      cloth_.vectors[vector_x][i * columns + j] = {part(0)[j], part(1)[j], part(2)[j]};
      cloth_.vectors[vector_v][i * columns + j] = {part(3)[j], part(4)[j], part(5)[j]};
    }
  }
  cloth_.synchronized = true;
  write_rows();
  guard_.begin(motion(tears));
  write_fixed_velocities();
  guard_.invalidate();
}

void PlainEngine::synchronize(const Tears& tears) {
  if (cloth_.synchronized) return;
  const Vector a = present_accelerations(tears);
  Vector& v = cloth_.vectors[vector_v];
  for (std::size_t p = 0; p < v.size(); ++p) v[p] = v[p] / cloth_.velocity_scale() + lag() * a[p];
  cloth_.synchronized = true;
  write_fixed_velocities();
  guard_.invalidate();
}

void PlainEngine::set_preset(const Preset& preset, const Tears& tears) {
  if (changes(cloth_.preset, preset).touches(Effect::force | Effect::dt)) synchronize(tears);
  guard_.accept_changes(cloth_.preset, preset);
  take_preset(preset);
}

void PlainEngine::set_fixed(std::span<const int> pinned, Held held) {
  if (lets_go(pinned_, held_.particle, pinned, held.particle)) guard_.expect_pushes();
  pinned_.assign(pinned.begin(), pinned.end()), driven_.clear(), held_ = held;
  cloth_.held = held.particle;
  std::fill(cloth_.fixed.begin(), cloth_.fixed.end(), std::uint8_t(0));
  for (const int p : pinned_) cloth_.fixed[std::size_t(p)] = 1;
  if (held_.particle >= 0) cloth_.fixed[std::size_t(held_.particle)] = 1;
  write_fixed_velocities();
  guard_.set_scene(cloth_.preset, lattice_, held_);
  guard_.invalidate();
}

void PlainEngine::drive_pins(std::span<const DrivenPin> pins, bool place) {
  driven_.assign(pins.begin(), pins.end());
  if (place)
    for (const DrivenPin& pin : driven_) cloth_.vectors[vector_x][std::size_t(pin.particle)] = pin.x;
  write_fixed_velocities();
  guard_.invalidate();
}

/// Pinned particles rest or are driven, and the held one has the velocity of the hand.
void PlainEngine::write_fixed_velocities() {
  for (std::size_t p = 0; p < cloth_.fixed.size(); ++p) {
    if (cloth_.fixed[p] == 0) continue;
    const glm::dvec3 v = int(p) == held_.particle ? held_.velocity * cloth_.velocity_scale() : glm::dvec3(0);
    cloth_.vectors[vector_v][p] = cloth_.seen()[p] = v;
  }
  for (const DrivenPin& pin : driven_) {
    const std::size_t p = std::size_t(pin.particle);
    cloth_.vectors[vector_v][p] = cloth_.seen()[p] = pin.v * cloth_.velocity_scale();
  }
  write_rows();
}

BatchResult PlainEngine::make_steps(int most, Tears& tears, Fault& fault) {
  BatchResult made;
  while (made.count < most && made.end == BatchEnd::complete) {
    if (stops()) return {made.count, BatchEnd::stopped};
    step_once(tears);
    const BatchResult judged = guard_.judge(*this, 1, tears, fault);
    made = {made.count + judged.count, judged.end};
  }
  return made;
}

void PlainEngine::repeat(int steps, Tears& tears) {
  cloth_ = backup_;
  return_to(step_backup_);
  write_rows();
  Fault fault{};
  for (int n = 0; n < steps; ++n) {
    step_once(tears);
    guard_.judge(*this, 1, tears, fault);
  }
}

StepMeasures PlainEngine::measures(int) {
  StepMeasures all;
  all.elongation = max_elongation(cloth_.largest), all.dt = cloth_.preset.dt, all.left_inside = cloth_.left_inside;
  if (held_.particle >= 0) all.hand_force = cloth_.hand_force;
  return all;
}

/// Velocities `lag` s later than they are stored.
void PlainEngine::read(State& state, const Tears& tears, double lag) {
  const Vector a = lag != 0 ? present_accelerations(tears) : Vector(cloth_.fixed.size(), glm::dvec3(0));
  state.x.resize(a.size()), state.v.resize(a.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    const glm::dvec3 x = cloth_.vectors[vector_x][p];
    const glm::dvec3 v = cloth_.vectors[vector_v][p] / cloth_.velocity_scale() + lag * a[p];
    state.x.x[p] = x.x, state.x.y[p] = x.y, state.x.z[p] = x.z;
    state.v.x[p] = v.x, state.v.y[p] = v.y, state.v.z[p] = v.z;
  }
}

void PlainEngine::read_raw(State& state, const Tears& tears) {
  if (!cloth_.scheme->keeps_displacement) return read(state, tears);
  // As the method will start, but the state stays as it is.
  const plain::Cloth now = cloth_;
  if (cloth_.synchronized) cloth_.start(tears);
  read(state, tears, 0);
  cloth_ = now;
}

std::shared_ptr<const HeldMotion> PlainEngine::held_motion() const {
  auto held = std::make_shared<PlainMotion>();
  held->method = cloth_.scheme->name, held->synchronized = cloth_.synchronized;
  held->vectors = cloth_.vectors, held->given = guard_.given();
  return held;
}

void PlainEngine::go_on_from(const HeldMotion& then) {
  const auto* held = dynamic_cast<const PlainMotion*>(&then);
  if (held == nullptr || held->method != cloth_.scheme->name) return;
  cloth_.vectors = held->vectors, cloth_.synchronized = held->synchronized;
  write_rows();
  guard_.resume(held->given, cloth_.preset, lattice_, held_);
}

std::vector<StepFeature> PlainEngine::features() const {
  const Preset& p = cloth_.preset;
  std::vector<StepFeature> all;
  for (const Force* force : {&force::bend, &force::curl, &force::damping, &force::wind, &force::self})
    all.push_back({force->name, force->on(p)});
  all.push_back({"bodies", !p.bodies.empty()});
  all.push_back({"tearing", tears_springs(p)});
  all.push_back({"pins", !pinned_.empty()});
  all.push_back({"hand", held_.particle >= 0});
  return all;
}

}  // namespace

std::string plain_problem(const Preset& preset) {
  if (is_written_out(scheme(preset.integrator))) return {};
  return "The plain engine runs explicit methods of fixed dt, and " + preset.integrator +
         " is none; choose verlet or rk4, or the CPU engine";
}

std::unique_ptr<Engine> make_plain_engine(const Preset& preset, const Lattice& lattice) {
  if (const std::string problem = plain_problem(preset); !problem.empty()) throw EngineError(problem);
  return std::make_unique<PlainEngine>(preset, lattice);
}

}  // namespace tyglab
