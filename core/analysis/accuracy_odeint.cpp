// The rows of Boost.Odeint in `tyglab bench accuracy`: its integrators, the usual alternative, driven by the engine's
// own forces.
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>

#include "core/analysis/accuracy.h"
#include "core/analysis/engine_forces.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

namespace odeint = boost::numeric::odeint;

template <class R>
using Vector = typename EngineForces<R>::Vector;
template <class R>
using Rk4 = odeint::runge_kutta4<Vector<R>, R, Vector<R>, R>;
template <class R>
using Dopri5 = odeint::runge_kutta_dopri5<Vector<R>, R, Vector<R>, R>;
template <class R>
using Fehlberg78 = odeint::runge_kutta_fehlberg78<Vector<R>, R, Vector<R>, R>;
template <class R>
using Adams = odeint::adams_bashforth_moulton<4, Vector<R>, R, Vector<R>, R>;
template <class R>
using Verlet = odeint::velocity_verlet<Vector<R>, Vector<R>, R, Vector<R>, R>;

/// Takes a state over one part of the time, from a sample to the next; returns the steps made.
template <class R>
using Advancer = std::function<std::int64_t(Vector<R>& state, double from, double to)>;

/// With a fixed dt.
template <class R, class Stepper>
Advancer<R> fixed_steps(EngineForces<R>& forces, Stepper stepper, int steps) {
  return [&forces, stepper, steps](Vector<R>& state, double from, double to) mutable {
    const auto derivative = [&](const Vector<R>& y, Vector<R>& dydt, R) { forces.derivative(y, dydt); };
    const R dt = R((to - from) / steps);
    for (int n = 0; n < steps; ++n) stepper.do_step(derivative, state, R(from) + R(n) * dt, dt);
    return std::int64_t(steps);
  };
}

/// Velocity Verlet keeps positions and velocities apart; its a(x, v) sees the velocity that it predicts.
template <class R>
Advancer<R> verlet_steps(EngineForces<R>& forces, int steps) {
  return [&forces, stepper = Verlet<R>(), steps](Vector<R>& state, double from, double to) mutable {
    const auto half = std::ptrdiff_t(forces.half());
    std::pair<Vector<R>, Vector<R>> y{{state.begin(), state.begin() + half}, {state.begin() + half, state.end()}};
    const auto a = [&](const Vector<R>& x, const Vector<R>& v, Vector<R>& out, R) {
      forces.accelerations(x.data(), v.data(), out.data());
    };
    const R dt = R((to - from) / steps);
    for (int n = 0; n < steps; ++n) stepper.do_step(a, y, R(from) + R(n) * dt, dt);
    std::copy(y.first.begin(), y.first.end(), state.begin());
    std::copy(y.second.begin(), y.second.end(), state.begin() + half);
    return std::int64_t(steps);
  };
}

/// With steps of its own choice.
template <class R, class Stepper>
Advancer<R> controlled_steps(EngineForces<R>& forces, Stepper, double tolerance, double first_dt) {
  return [&forces, stepper = odeint::make_controlled<Stepper>(R(tolerance), R(0)), dt = R(first_dt)](
             Vector<R>& state, double from, double to) mutable {
    const auto derivative = [&](const Vector<R>& y, Vector<R>& dydt, R) { forces.derivative(y, dydt); };
    return std::int64_t(odeint::integrate_adaptive(stepper, derivative, state, R(from), R(to), dt));
  };
}

/// A method with its dt (steps from a sample to the next) or its tolerance.
struct OdeintRung {
  std::string method;
  int steps = 0;
  double tolerance = 0;
};

bool is_controlled(const std::string& method) {
  return method.ends_with("_controlled");
}

template <class R>
Advancer<R> advancer(EngineForces<R>& forces, const OdeintRung& setting, double first_dt) {
  const std::string& method = setting.method;
  if (method == "odeint_runge_kutta4") return fixed_steps(forces, Rk4<R>(), setting.steps);
  if (method == "odeint_runge_kutta_dopri5") return fixed_steps(forces, Dopri5<R>(), setting.steps);
  if (method == "odeint_runge_kutta_fehlberg78") return fixed_steps(forces, Fehlberg78<R>(), setting.steps);
  if (method == "odeint_adams_bashforth_moulton") return fixed_steps(forces, Adams<R>(), setting.steps);
  if (method == "odeint_velocity_verlet") return verlet_steps(forces, setting.steps);
  if (method == "odeint_runge_kutta_dopri5_controlled")
    return controlled_steps(forces, Dopri5<R>(), setting.tolerance, first_dt);
  return controlled_steps(forces, Fehlberg78<R>(), setting.tolerance, first_dt);
}

/// Whether the steps got anywhere: a controlled method gives up where no step is small enough.
template <class R>
bool advance_all(EngineForces<R>& forces, const AccuracyScene& scene, const Advancer<R>& advance, AccuracyRow& row,
                 Track& track, const Stop& stop) {
  Vector<R> state = forces.start();
  const int particles = lattice_of(scene.preset).size();
  for (int n = 0; n < accuracy_samples; ++n) {
    const double start = thread_seconds();
    try {
      row.steps += advance(state, scene.seconds * n / accuracy_samples, scene.seconds * (n + 1) / accuracy_samples);
    } catch (const odeint::odeint_error&) {
      return false;
    }
    row.seconds += thread_seconds() - start;
    if (stop()) throw Stopped();
    auto& positions = track.emplace_back();
    for (int p = 0; p < particles; ++p) positions.push_back(forces.position(state, p));
  }
  return true;
}

template <class R>
AccuracyRow run_once(const AccuracyScene& scene, const Reference& reference, const OdeintRung& setting,
                     const Stop& stop) {
  AccuracyRow row{scene.name, setting.method};
  row.precision = sizeof(R) == sizeof(float) ? Precision::float_ : Precision::double_;
  if (is_controlled(setting.method)) row.tolerance = setting.tolerance;
  EngineForces<R> forces(scene.preset);
  Track track;
  const double first_dt = stable_dt(scene.preset, "verlet") / 10;
  const bool done = advance_all(forces, scene, advancer(forces, setting, first_dt), row, track, stop);
  row.dt = row.tolerance ? scene.seconds / double(std::max<std::int64_t>(row.steps, 1))
                         : scene.seconds / accuracy_samples / setting.steps;
  row.force_evaluations = forces.evaluations();
  // The bound of this project's runs is a thousand rest lengths; what overflows later has passed it.
  constexpr double bound = 1000;
  row.error_rms_m = done ? rms_distance(track, reference.track) : std::numeric_limits<double>::infinity();
  if (row.error_rms_m > bound * scene.preset.L) row.error_rms_m = std::numeric_limits<double>::infinity();
  row.status = judged(reference, row.error_rms_m);
  return row;
}

template <class R>
std::vector<AccuracyRow> measure(const AccuracyScene& scene, const Reference& reference,
                                 const std::vector<OdeintRung>& ladder, const AccuracyEffort& effort,
                                 const Stop& stop) {
  std::vector<AccuracyRow> rows;
  for (const OdeintRung& setting : ladder) {
    if (!worth_going_on(rows, effort)) break;
    try {
      AccuracyRow row = run_once<R>(scene, reference, setting, stop);
      for (int n = 0;
           n < effort.repeats && row.seconds < effort.repeated_below_s && row.status != AccuracyStatus::diverged; ++n)
        row.seconds = std::min(row.seconds, run_once<R>(scene, reference, setting, stop).seconds);
      rows.push_back(row);
    } catch (const Stopped&) {
      break;
    }
  }
  return rows;
}

}  // namespace

std::vector<std::string> odeint_methods() {
  return {"odeint_runge_kutta4",
          "odeint_runge_kutta_dopri5",
          "odeint_runge_kutta_dopri5_controlled",
          "odeint_runge_kutta_fehlberg78",
          "odeint_runge_kutta_fehlberg78_controlled",
          "odeint_velocity_verlet",
          "odeint_adams_bashforth_moulton"};
}

bool odeint_can(const AccuracyScene& scene) {
  return scene.preset.bodies.empty();
}

std::vector<AccuracyRow> measure_odeint(const AccuracyScene& scene, const Reference& reference,
                                        const std::string& method, Precision precision, const AccuracyEffort& effort,
                                        const Stop& stop) {
  std::vector<OdeintRung> ladder;
  if (is_controlled(method)) {
    for (const double tolerance : tolerance_ladder(precision, effort)) ladder.push_back({method, 0, tolerance});
  } else {
    // The methods of many stages bear longer steps than Verlet.
    for (const int steps : accuracy_ladder(scene, 4 * stable_dt(scene.preset, "verlet"), effort))
      ladder.push_back({method, steps, 0});
  }
  return precision == Precision::float_ ? measure<float>(scene, reference, ladder, effort, stop)
                                        : measure<double>(scene, reference, ladder, effort, stop);
}

}  // namespace tyglab
