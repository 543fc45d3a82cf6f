// Steps that are stopped from outside, wherever that happens: what remains is the last whole step, and who goes on from
// there comes to the same bits as who was never stopped.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/model/preset.h"
#include "core/simulation.h"
#include "tests/engines/engine_pair.h"
#include "tests/support/devices.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::stop_test {
namespace {

bool same_bits(const State& a, const State& b) {
  return std::equal(a.x.x.begin(), a.x.x.end(), b.x.x.begin()) &&
         std::equal(a.x.y.begin(), a.x.y.end(), b.x.y.begin()) &&
         std::equal(a.x.z.begin(), a.x.z.end(), b.x.z.begin()) &&
         std::equal(a.v.x.begin(), a.v.x.end(), b.v.x.begin()) &&
         std::equal(a.v.y.begin(), a.v.y.end(), b.v.y.begin()) && std::equal(a.v.z.begin(), a.v.z.end(), b.v.z.begin());
}

/// A scene in which everything can happen within a step, and steps take many iterations.
Preset busy(const std::string& method) {
  Preset preset = test::everything(Precision::double_);
  preset.integrator = method;
  preset.F_max = 40;
  return preset;
}

/// Says yes at the n-th time that it is asked, and from then on.
struct Alarm {
  std::shared_ptr<int> asked = std::make_shared<int>(0);
  int at;
  explicit Alarm(int n) : at(n) {}
  bool operator()() const { return ++*asked >= at; }
};

/// How often a method asks during that many steps.
int questions(const Preset& preset, int steps, int threads) {
  Simulation simulation(preset, threads);
  const Alarm never(1 << 30);
  simulation.stop_when(never);
  simulation.advance(steps);
  return *never.asked;
}

void check_stops(const Preset& preset, int threads) {
  constexpr int steps = 4;
  CAPTURE(preset.integrator);
  CAPTURE(threads);
  std::vector<State> whole;
  std::vector<int> torn;
  Simulation undisturbed(preset, threads);
  for (int n = 0; n <= steps; ++n) {
    whole.push_back(undisturbed.read_raw()), torn.push_back(undisturbed.tears().torn_count());
    undisturbed.advance(1);
  }
  const int most = questions(preset, steps, threads);
  REQUIRE(most > 0);
  for (int part = 1; part <= 5; ++part) {
    CAPTURE(part);
    Simulation simulation(preset, threads);
    simulation.stop_when(Alarm(1 + most * part / 6));
    const AdvanceResult stopped = simulation.advance(steps);
    CHECK(stopped.stopped == (stopped.steps < steps));
    CHECK(simulation.steps() == stopped.steps);
    CHECK(simulation.tears().torn_count() == torn[std::size_t(stopped.steps)]);
    CHECK(same_bits(simulation.read_raw(), whole[std::size_t(stopped.steps)]));
    if (stopped.stopped) CHECK(simulation.advance(1).steps == 0);
    simulation.stop_when({});
    CHECK(simulation.advance(steps - stopped.steps).steps == steps - stopped.steps);
    CHECK(same_bits(simulation.read_raw(), whole[steps]));
  }
}

}  // namespace

TEST_CASE("stopped anywhere in a step, every method stands at its last whole step and goes on from there") {
  for (const Scheme& method : schemes())
    for (const int threads : {1, 2}) check_stops(busy(std::string(method.name)), threads);
}

TEST_CASE("the same where a step of projections takes long") {
  Preset preset = busy("xpbd");
  preset.rows = 40, preset.columns = 45, preset.iterations = 150;
  for (const int threads : {1, 2})
    if (threads == 2 || !test::sanitized) check_stops(preset, threads);
}

TEST_CASE("the same on an OpenCL device") {
  if (test::skipped_without_device()) return;
  for (const Scheme& method : schemes()) {
    if (!runs_on_opencl(method)) continue;
    Preset preset = busy(std::string(method.name));
    preset.engine = EngineKind::opencl;
    check_stops(preset, 1);
  }
}

TEST_CASE("a step that takes many iterations asks in each of them, and tells how far it is") {
  for (const char* method : {"implicit_euler", "projective_dynamics", "vbd", "xpbd", "dopri5"}) {
    CAPTURE(std::string(method));
    Preset preset = busy(method);
    preset.iterations = 40, preset.tolerance = 1e-9, preset.k_s = 1e5, preset.dt = 0.01;
    if (method == std::string("xpbd")) preset.rows = 40, preset.columns = 45, preset.iterations = 150;
    Simulation simulation(preset, 2);
    double least = 1, most = 0;
    int asked = 0;
    std::set<double> told;
    simulation.stop_when([&] {
      ++asked;
      const double part = simulation.engine().step_progress();
      told.insert(part);
      least = std::min(least, part), most = std::max(most, part);
      return false;
    });
    simulation.advance(1);
    CHECK(asked > 20);
    CHECK(least < 0.2);
    CHECK(most > 0.3);
    CHECK(most <= 1);
    if (method == std::string("implicit_euler"))
      CHECK(told.size() > 10);  // about one for each interior-point iteration
  }
}

/// What an implicit step has done when it asks whether to stop.
struct Moment {
  std::int64_t products, systems, forces;
  std::int64_t work() const { return products + systems + forces; }
};

/// The moments of the first `questions` questions of a stiff step, after which it is stopped; the last is the one after
/// it has ended.
std::vector<Moment> moments(Simulation& simulation, int questions) {
  std::vector<Moment> all;
  const auto now = [&] {
    const SolveCounts solves = simulation.engine().solves();
    return Moment{solves.linear, solves.newton, solves.force_evaluations};
  };
  simulation.stop_when([&] {
    all.push_back(now());
    return int(all.size()) >= questions;
  });
  CHECK(simulation.advance(1).stopped);
  all.push_back(now());
  return all;
}

TEST_CASE("between two questions a stiff step of a large cloth makes one pass over its springs at most") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    Preset preset = test::cloth(1000, 20, "implicit_euler");
    preset.precision = precision, preset.k_s = 1e5, preset.dt = 0.02;
    constexpr int questions = 1500;  // in its third iteration or so
    Simulation simulation(preset);
    const std::vector<Moment> all = moments(simulation, questions);
    REQUIRE(int(all.size()) == questions + 1);
    REQUIRE(all.back().systems >= 3);
    // What lies between two of these pieces of work goes row by row and asks every 64 rows: before forces are evaluated
    // for the first time the state is copied, springs and tensions begin (3 passes), and memory is taken; later
    // tensions and slacks take a step (3); then the systems of all levels are prepared (3); and a product comes with
    // the sweeps of a multigrid cycle (4).
    const std::size_t pass = std::size_t(preset.rows + 63) / 64;
    std::size_t asked = 1;  // since the last piece of work
    for (std::size_t n = 1; n < all.size(); ++n, ++asked) {
      const Moment &now = all[n], &before = all[n - 1];
      CAPTURE(n);
      CHECK(now.work() - before.work() <= 1);  // also after it has been told to stop
      if (now.work() == before.work()) continue;
      const std::size_t passes = now.products > before.products ? 4 : before.work() == 0 ? 6 : 3;
      if (n < all.size() - 1) CHECK(asked >= passes * pass);
      asked = 0;
    }
  }
}

TEST_CASE("Newton's method asks every 64 rows, too, while it takes its memory and in each iteration of its systems") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    Preset preset = test::cloth(1000, 20, "implicit_euler");
    preset.precision = precision, preset.k_s = 50, preset.dt = 0.002;
    constexpr int questions = 4000;  // linearizing asks in each row
    Simulation simulation(preset);
    const std::vector<Moment> all = moments(simulation, questions);
    REQUIRE(int(all.size()) == questions + 1);
    REQUIRE(all.back().products >= 5);
    const std::size_t pass = std::size_t(preset.rows) / 64;
    std::size_t asked = 1;  // since the last piece of work
    for (std::size_t n = 1; n < all.size() - 1; ++n, ++asked) {
      const Moment &now = all[n], &before = all[n - 1];
      CAPTURE(n);
      CHECK(now.work() - before.work() <= 1);
      if (now.work() == before.work()) continue;
      // First the memory of the matrix (10 passes), copies and a residual (5); in an iteration the direction, its
      // product and the update; after a step its size, the new velocities and their residual.
      const std::size_t passes = before.work() == 0 ? 15 : now.products > before.products ? 2 : 5;
      if (now.systems == before.systems) CHECK(asked >= passes * pass);
      asked = 0;
    }
  }
}

TEST_CASE("stopped while it takes its memory, an implicit method goes on as if it had not been") {
  for (const double k_s : {50.0, 1e5}) {
    Preset preset = test::cloth(12, 10, "implicit_euler");
    preset.k_s = k_s, preset.dt = 0.02;
    Simulation undisturbed(preset);
    undisturbed.advance(1);
    const State whole = undisturbed.read_raw();
    for (int at = 1; at <= 50; ++at) {
      CAPTURE(at);
      Simulation simulation(preset);
      simulation.stop_when(Alarm(at));
      simulation.advance(1);
      simulation.stop_when({});
      simulation.advance(1 - int(simulation.steps()));
      CHECK(same_bits(simulation.read_raw(), whole));
    }
  }
}

}  // namespace tyglab::stop_test
