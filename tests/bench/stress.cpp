#include "tests/bench/stress.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/contact/crossings.h"
#include "core/contact/self_contact.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"
#include "tests/bench/stress_preset.h"

namespace tyglab {
namespace {

constexpr double longest_factor = 1000;      // docs/model.md, "Diverged"
constexpr double most_particle_steps = 4e6;  // of a case, times the sweeps of a step
constexpr double most_cg_products = 1e7;     // particles times steps of conjugate gradients, for implicit methods
constexpr double most_seconds = 20;          // of processor time: one solve that fails may take minutes
constexpr int most_steps_of_case = 4000, looks = 12;

bool finite(double a) {
  return std::isfinite(a);
}
bool finite(const glm::dvec3& a) {
  return finite(a.x) && finite(a.y) && finite(a.z);
}
bool finite(const VectorField<double>& field) {
  const auto all = [](const Array<double>& a) {
    return std::all_of(a.begin(), a.end(), [](double v) { return finite(v); });
  };
  return all(field.x) && all(field.y) && all(field.z);
}

/// One case while it runs.
class StressRun {
 public:
  StressRun(std::uint64_t seed, std::uint64_t number, const std::string& integrator)
      : random_(seed, number), keeps_integrator_(!integrator.empty()) {
    result_.preset = random_preset(random_, integrator);
    result_.threads = 1 + random_.below(2);
  }

  StressResult run() {
    const std::string wrong = check_preset(result_.preset);
    if (!wrong.empty()) return fail("the random preset is not valid: " + wrong);
    simulation_.emplace(result_.preset, result_.threads);
    const double end = thread_seconds() + most_seconds;
    simulation_->stop_when([end] { return thread_seconds() > end; });
    for (int look = 0; look < looks && left() > 0 && result_.status == StressStatus::bounded; ++look) {
      if (look > 0 && random_.chance(0.3)) edit();
      if (!advance(std::max(1, int(left() / (looks - look))))) break;
      inspect();
    }
    if (result_.status == StressStatus::bounded) check_bounds();
    if (result_.status == StressStatus::diverged) check_report();
    return result_;
  }

 private:
  StressResult& fail(const std::string& problem) {
    if (result_.status != StressStatus::failed) result_.problem = problem;
    result_.status = StressStatus::failed;
    return result_;
  }

  void edit() {
    std::string what;
    const Edit next = random_edit(*simulation_, random_, keeps_integrator_, what);
    result_.edits.push_back("step " + std::to_string(result_.steps) + ": " + what);
    try {
      simulation_->apply(next);
    } catch (const PresetError& refused) {
      // A body that has flown for a kilometer cannot be placed: its place at t = 0 would be out of range.
      result_.edits.back() += ", refused: " + std::string(refused.what());
    }
  }

  double sweeps_of_a_step() const {
    const Preset& p = simulation_->preset();
    const Scheme& method = scheme(p.integrator);
    const double contact = touches_itself(p) ? 300 : 0, parting = simulation_->tears().mesh() != nullptr ? 100 : 0;
    return double(method.sweeps.size()) + contact + parting + (projects(method) ? p.iterations : 0);
  }

  /// How many steps of the present scene the case may still make.
  double left() const {
    const double particles = simulation_->lattice().size();
    const double sweeps = sweeps_of_a_step();
    const double by_work = (most_particle_steps - work_) / (particles * sweeps);
    return std::min(double(most_steps_of_case) - double(result_.steps),
                    std::max(by_work, result_.steps == 0 ? 1.0 : 0.0));
  }

  /// Makes steps; false once it has diverged, or what it takes to end a step has taken its time.
  bool advance(int steps) {
    const double particles = simulation_->lattice().size();
    const Scheme& method = scheme(simulation_->preset().integrator);
    // A step of these may take any number of evaluations.
    const int at_once = is_implicit(method) || chooses_steps(method) || solves_damping(method) ? 1 : steps;
    for (int made = 0; made < steps; made += at_once) {
      const SolveCounts before = simulation_->engine().solves();
      const std::int64_t evaluated = simulation_->engine().inner_steps().force_evaluations;
      const AdvanceResult part = simulation_->advance(std::min(at_once, steps - made));
      const SolveCounts after = simulation_->engine().solves();
      result_.steps += part.steps;
      result_.unconverged += after.unconverged - before.unconverged;
      work_ += particles * part.steps * sweeps_of_a_step();
      products_ +=
          particles * double(after.linear - before.linear + after.force_evaluations - before.force_evaluations);
      work_ += particles * double(simulation_->engine().inner_steps().force_evaluations - evaluated);
      if (!finite(part.hand_force)) fail("the hand's force is not finite");
      if (simulation_->divergence()) {
        result_.divergence = simulation_->divergence();
        if (result_.status == StressStatus::bounded) result_.status = StressStatus::diverged;
        return false;
      }
      if (part.stopped || products_ > most_cg_products || work_ > most_particle_steps) return false;
    }
    return true;
  }

  /// Nothing that is not finite may be seen from outside, and no guarded cloth that crosses itself.
  void inspect() {
    const State& state = simulation_->read();
    // Pins that move go where their paths lead, whatever is in the way.
    if (guards_itself(simulation_->preset()) && simulation_->preset().pins.motions.empty())
      if (const Crossings found = count_crossings(state.x, simulation_->tears()); found.pairs > found.around_sites)
        fail("the guarded cloth crosses itself in " + std::to_string(found.pairs) + " pairs of triangles");
    if (!finite(state.x)) fail("a position is not finite after step " + std::to_string(simulation_->steps()));
    if (!finite(state.v)) fail("a velocity is not finite after step " + std::to_string(simulation_->steps()));
    const Lattice& lattice = simulation_->lattice();
    const int any = random_.below(simulation_->tears().particles());
    const ParticleReadout p = simulation_->particle(any / lattice.columns, any % lattice.columns);
    if (!finite(p["F"]) || !finite(p.x) || !finite(p.v) || !finite(p.a)) fail("a particle's readout is not finite");
    if (!finite(simulation_->time())) fail("the time is not finite");
    const Energy energy = simulation_->energy().energy;
    if (!finite(energy.total()) || !finite(energy.kinetic)) fail("the energy is not finite");
    for (const Reduction reduction : {Reduction::sum, Reduction::maximum}) {
      const ForceSummary all = simulation_->forces(reduction);
      for (const double force : all.values)
        if (!finite(force)) fail("a force is not finite");
    }
  }

  /// The longest whole spring in rest lengths; the way of a mass on a spring in its own measure.
  double longest() const {
    const Preset& p = simulation_->preset();
    const PositionView x = simulation_->positions();
    if (p.kind == Kind::one_weight) return std::abs(x.at(0, 0).y - p.x_0.y) / std::max(p.L, std::abs(p.offset));
    double most = 0;
    for (int i = 0; i < x.rows; ++i)
      for (int j = 0; j < x.columns; ++j)
        for (int d = 0; d < int(directions.size()); ++d) {
          if (!simulation_->lattice().has_spring(d, i, j) || !simulation_->tears().whole(d, i, j)) continue;
          const Direction& to = directions[std::size_t(d)];
          const glm::dvec3 apart = x.at(i + to.di, j + to.dj) - x.at(i, j);
          most = std::max(most, glm::length(apart) / (to.rest * p.L));
        }
    return most;
  }

  void check_bounds() {
    inspect();
    if (const double most = longest(); result_.steps > 0 && !(most <= longest_factor * 1.001))
      fail("a divergence went unreported: something is " + std::to_string(most) + " times its measure");
  }

  /// A divergence must say what a person needs, and leave a simulation that can be looked at and restarted.
  void check_report() {
    const Divergence d = *result_.divergence;
    if (d.cause.empty() || d.advice.empty() || d.quantity.empty()) fail("the divergence does not say cause or advice");
    if (!finite(d.t) || d.t <= 0 || d.step != simulation_->steps() + 1) fail("the divergence does not say when");
    if (!simulation_->lattice().contains(d.i, d.j)) fail("the divergence does not say where");
    inspect();
    if (simulation_->advance(3).steps != 0) fail("it went on after diverging");
    simulation_->apply(edit::Restart{});
    if (simulation_->divergence() || simulation_->steps() != 0) fail("a restart did not clear the divergence");
    inspect();
  }

  StressRandom random_;
  bool keeps_integrator_;
  StressResult result_;
  std::optional<Simulation> simulation_;
  double work_ = 0, products_ = 0;
};

}  // namespace

std::string_view name_of(StressStatus status) {
  return status == StressStatus::bounded ? "bounded" : status == StressStatus::diverged ? "diverged" : "failed";
}

Preset stress_preset(std::uint64_t seed, std::uint64_t number, const std::string& integrator) {
  StressRandom random(seed, number);
  return random_preset(random, integrator);
}

StressResult run_stress(std::uint64_t seed, std::uint64_t number, const std::string& integrator) {
  return StressRun(seed, number, integrator).run();
}

}  // namespace tyglab
