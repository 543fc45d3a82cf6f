#include "core/analysis/reference.h"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/analysis/one_weight.h"
#include "core/engines/plain/plain_cloth.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

namespace odeint = boost::numeric::odeint;

double sample_time(const AccuracyScene& scene, int n) {
  return scene.seconds * n / accuracy_samples;
}

Preset in_double(const AccuracyScene& scene, const std::string& integrator, int steps) {
  Preset preset = scene.preset;
  preset.integrator = integrator, preset.precision = Precision::double_;
  preset.dt = sample_time(scene, 1) / steps;
  return preset;
}

/// Advances in pieces, so that Ctrl-C is soon heard.
void advance_in_pieces(Simulation& simulation, int steps, const Stop& stop) {
  for (int left = steps; left > 0;) {
    if (stop()) throw Stopped();
    const int now = std::min(left, 20000);
    simulation.advance(now);
    left -= now;
  }
  if (simulation.divergence()) throw std::runtime_error("a reference diverged: " + simulation.divergence()->cause);
}

/// Steps from a sample to the next whose dt is at most that.
int steps_for(const AccuracyScene& scene, double dt) {
  return std::max(1, int(std::ceil(sample_time(scene, 1) / dt - 1e-9)));
}

std::string best_integrator(const Preset& preset) {
  return preset.k_d > 0 ? "rk4" : "rkn4";
}

/// A perturbed copy of the simulation's state, and how far both are apart as time goes on.
void measure_predictability(const AccuracyScene& scene, double dt, const Stop& stop, Reference& reference) {
  constexpr double perturbation = 1e-12, bound = 1e-9;
  constexpr int looks = 40;
  const double horizon = 3 * scene.seconds;
  Preset preset = in_double(scene, best_integrator(scene.preset), 1);
  const int steps = std::max(1, int(std::ceil(horizon / looks / dt)));
  preset.dt = horizon / looks / steps;
  Simulation plain(preset), moved(preset);
  State state = plain.read();
  std::mt19937 random(1);
  const auto pinned = pinned_particles(preset);
  for (std::size_t p = 0; p < pinned.size(); ++p)
    for (auto* x : {&state.x.x, &state.x.y, &state.x.z}) {
      const double way = perturbation * (2 * (double(random()) / 4294967295.0) - 1);
      if (pinned[p] == 0) (*x)[p] += way;
    }
  moved.load(state);
  for (int n = 1; n <= looks; ++n) {
    advance_in_pieces(plain, steps, stop), advance_in_pieces(moved, steps, stop);
    if (!(rms_distance({positions_of(plain)}, {positions_of(moved)}) < bound)) return;
    reference.predictable_s = horizon * n / looks;
  }
  reference.predictable_longer = true;
}

Reference closed_form(const AccuracyScene& scene) {
  Reference reference;
  for (int n = 1; n <= accuracy_samples; ++n) {
    const double y = exact_weight(scene.preset, sample_time(scene, n)).y;
    reference.track.push_back({{scene.preset.x_0.x, y, scene.preset.x_0.z}});
  }
  reference.made_by = {"the closed form of the oscillator"};
  reference.predictable_s = scene.seconds, reference.predictable_longer = true;
  return reference;
}

/// Contact is no smooth force: the same method refined, since no other library has it.
Reference refined(const AccuracyScene& scene, double dt, const Stop& stop) {
  const std::string method = "velocity_verlet";
  const int steps = steps_for(scene, dt);
  Reference reference;
  reference.track = own_track(scene, method, 2 * steps, stop);
  const Track coarser = own_track(scene, method, steps, stop);
  reference.agreement_rms_m = rms_distance(reference.track, coarser);
  const double used = sample_time(scene, 1) / steps;
  reference.made_by = {"this project's " + method + " in double with dt = " + short_number(used / 2, 3) + " s",
                       "the same " + method + " with dt = " + short_number(used, 3) +
                           " s: not independent, since no other library has these bodies"};
  return reference;
}

}  // namespace

std::vector<glm::dvec3> positions_of(const Simulation& simulation) {
  const PositionView view = simulation.positions();
  std::vector<glm::dvec3> all;
  // Two runs of a cloth that parts may have different copies: its sites alone are compared.
  for (int i = 0; i < simulation.lattice().sites().rows; ++i)
    for (int j = 0; j < view.columns; ++j) all.push_back(view.at(i, j));
  return all;
}

double rms_distance(const Track& a, const Track& b) {
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    assert(a[n].size() == b[n].size());
    for (std::size_t p = 0; p < a[n].size(); ++p, ++count) {
      const glm::dvec3 apart = a[n][p] - b[n][p];
      squares += glm::dot(apart, apart);
    }
  }
  const double rms = std::sqrt(squares / double(std::max<std::size_t>(count, 1)));
  return std::isfinite(rms) ? rms : std::numeric_limits<double>::infinity();
}

Track odeint_track(const AccuracyScene& scene, double tolerance, const Stop& stop) {
  // Positions, then velocities, as Odeint takes them; and as the plain cloth does.
  using Numbers = std::vector<double>;
  const Preset& preset = scene.preset;
  const Tears whole(lattice_of(preset));
  const std::vector<std::uint8_t> pinned = pinned_particles(preset);
  const std::size_t particles = pinned.size(), half = 3 * particles;
  Numbers y(2 * half);
  const State start = start_state(preset);
  for (std::size_t p = 0; p < particles; ++p) {
    y[3 * p] = start.x.x[p], y[3 * p + 1] = start.x.y[p], y[3 * p + 2] = start.x.z[p];
    y[half + 3 * p] = start.v.x[p], y[half + 3 * p + 1] = start.v.y[p], y[half + 3 * p + 2] = start.v.z[p];
  }
  plain::Vector x(particles), v(particles);
  int asked = 0;
  const auto derivative = [&](const Numbers& from, Numbers& change, double) {
    if (++asked % 4096 == 0 && stop()) throw Stopped();
    for (std::size_t n = 0; n < half; ++n) {
      x[n / 3][int(n % 3)] = from[n];
      change[n] = v[n / 3][int(n % 3)] = from[half + n];
    }
    const plain::Vector F = plain::forces(preset, whole, x, v);
    for (std::size_t n = 0; n < half; ++n) change[half + n] = pinned[n / 3] != 0 ? 0 : F[n / 3][int(n % 3)] / preset.m;
  };
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<Numbers>>(tolerance, 0.0);
  Track track;
  for (int n = 1; n <= accuracy_samples; ++n) {
    odeint::integrate_adaptive(stepper, derivative, y, sample_time(scene, n - 1), sample_time(scene, n), 1e-5);
    auto& positions = track.emplace_back();
    for (std::size_t p = 0; p < particles; ++p) positions.emplace_back(y[3 * p], y[3 * p + 1], y[3 * p + 2]);
  }
  return track;
}

Track own_track(const AccuracyScene& scene, const std::string& integrator, int steps, const Stop& stop) {
  Simulation simulation(in_double(scene, integrator, steps));
  Track track;
  for (int n = 0; n < accuracy_samples; ++n) {
    advance_in_pieces(simulation, steps, stop);
    track.push_back(positions_of(simulation));
  }
  return track;
}

Reference make_reference(const AccuracyScene& scene, bool quick, const Stop& stop) {
  if (scene.preset.kind == Kind::one_weight) return closed_form(scene);
  const double dt = quick ? 1e-5 : 1e-6, tolerance = quick ? 1e-11 : 1e-13;
  Reference reference;
  if (scene.preset.bodies.empty()) {
    const std::string method = best_integrator(scene.preset);
    const int steps = steps_for(scene, dt);
    reference.track = odeint_track(scene, tolerance, stop);
    reference.agreement_rms_m = rms_distance(reference.track, own_track(scene, method, steps, stop));
    reference.made_by = {
        "Boost.Odeint's runge_kutta_fehlberg78 with error control to " + short_number(tolerance, 1) +
            ", on forces implemented independently of the engine",
        "this project's " + method + " in double with dt = " + short_number(sample_time(scene, 1) / steps, 3) + " s"};
  } else {
    reference = refined(scene, dt / 2, stop);
  }
  measure_predictability(scene, 2e-5, stop, reference);
  return reference;
}

}  // namespace tyglab
