// An edit in mid-run: whatever variables a method keeps, it goes on from the positions and velocities of that moment.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/engines/balance.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/lockstep.h"
#include "core/step_trace.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::edit_test {

using Make = std::function<Edit(Simulation&)>;

Edit set(Simulation& simulation, const std::string& setting) {
  return edit::Change{with_settings(simulation.preset(), {setting})};
}

struct Kind {
  std::string name;
  Make make;
  bool hand = false;  ///< a hand that moves holds a particle before
};

/// Every kind of edit that changes accelerations.
std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const char* setting :
       {"k_s=80", "k_b=0", "k_d=0.006", "m=0.0005", "g=-3", "W=[0,0.002,0.004]", "L=0.033", "dt=0.0003",
        "pins=left_column", "pins=none", "B=0.0005", "kappa_warp=9", "k_warp=25", "k_shear=8", "air_density=1.2",
        "C_N=3", "u=[1,0,4]", R"(pin_motions=[{"pins": "top_row", "path": [[0, 0, 0, 0], [10, -9, 3, 6]]}])"})
    all.push_back({setting, [setting](Simulation& s) { return set(s, setting); }});
  all.push_back({"constants and pins together", [](Simulation& s) {
                   return edit::Change{with_settings(s.preset(), {"k_s=20", "g=4", "pins=none", "dt=0.0007"})};
                 }});
  all.push_back({"grab", [](Simulation&) { return edit::Grab{5, 3}; }});
  all.push_back({"pin", [](Simulation&) { return edit::Pin{6, 2, true}; }});
  all.push_back({"unpin", [](Simulation&) { return edit::Pin{0, 0, false}; }});
  all.push_back({"cut", [](Simulation&) { return edit::Cut{{{2, 3}, {2, 4}}}; }});
  all.push_back({"cut springs", [](Simulation&) { return edit::CutSprings{{{0, 1, 1}, {3, 4, 4}}}; }});
  all.push_back({"move the hand",
                 [](Simulation& s) {
                   return edit::MoveHand{s.position(5, 3) + glm::dvec3(0.01, 0.02, -0.03), 9};
                 },
                 true});
  all.push_back({"release", [](Simulation&) { return edit::Release{}; }, true});
  all.push_back({"pin what the hand holds", [](Simulation&) { return edit::Pin{5, 3, true}; }, true});
  return all;
}

Preset scene(const Scheme& method, Precision precision, EngineKind engine) {
  Preset preset = test::cloth(9, 7, std::string(method.name));
  preset.precision = precision, preset.engine = engine, preset.dt = 5e-4;
  preset.W = {0.002, 0, 0.001}, preset.v_0 = {0.1, 0, 0.3};
  preset.iterations = 25, preset.tolerance = 1e-9;
  preset.pins.motions = {{.mode = Pins::Mode::list, .list = {{0, 0}}, .path = {{0, {0, 0, 0}}, {10, {3, 0, 5}}}}};
  if (engine == EngineKind::cpu) preset.air_density = 0.6, preset.u = {0, 0, 1}, preset.B = 2e-4, preset.kappa_weft = 5;
  return preset;
}

/// Another simulation with the constants, tears and hand of this one, in which nothing has happened but that.
std::unique_ptr<Simulation> fresh(const Simulation& like, const State& state, const Edit& hand) {
  auto made = std::make_unique<Simulation>(like.preset());
  edit::CutSprings torn;
  for (int i = 0; i < like.lattice().rows; ++i)
    for (int j = 0; j < like.lattice().columns; ++j)
      for (int d = 0; d < stretch_directions; ++d)
        if (!like.tears().whole(d, i, j)) torn.springs.push_back({d, i, j});
  made->apply(torn);
  made->load(state);
  if (const auto held = like.held()) {
    made->apply(edit::Grab{held->i, held->j});
    if (std::holds_alternative<edit::MoveHand>(hand)) made->apply(hand);
  }
  return made;
}

double farthest(const State& a, const State& b) {
  double most = 0;
  for (std::size_t p = 0; p < a.x.x.size(); ++p)
    most = std::max(most, glm::length(test::position(a, p) - test::position(b, p)));
  return most;
}

void check(const Preset& preset, const Kind& kind) {
  CAPTURE(preset.integrator);
  CAPTURE(int(preset.precision));
  CAPTURE(int(preset.engine));
  CAPTURE(kind.name);
  const double digits = preset.precision == Precision::double_ ? 1e-12 : 2e-6;
  Simulation simulation(preset);
  if (kind.hand) {
    simulation.apply(edit::Grab{5, 3});
    simulation.apply(edit::MoveHand{simulation.position(5, 3) + glm::dvec3(0.02, 0.05, 0.1), 100});
  }
  simulation.advance(40);
  const State before = simulation.read();
  const Edit edit = kind.make(simulation);
  simulation.apply(edit);
  const State after = simulation.read();
  CHECK(farthest(before, after) == 0);
  double kick = 0;
  for (int i = 0, p = 0; i < simulation.lattice().rows; ++i)
    for (int j = 0; j < simulation.lattice().columns; ++j, ++p) {
      const auto held = simulation.held();
      if (!simulation.pinned(i, j) && !(held && held->i == i && held->j == j))
        kick = std::max(kick, glm::length(test::velocity(before, p) - test::velocity(after, p)));
    }
  CHECK(kick <= digits);
  const auto other = fresh(simulation, before, edit);
  simulation.advance(6), other->advance(6);
  REQUIRE_FALSE(simulation.divergence().has_value());
  CHECK(farthest(simulation.read(), other->read()) <= digits);
}

TEST_CASE(
    "an edit in mid-run is the start of a motion from that moment's positions and velocities, with every method") {
  for (const Scheme& method : schemes())
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const Kind& kind : kinds()) check(scene(method, precision, EngineKind::cpu), kind);
}

TEST_CASE("the same on an OpenCL device" * doctest::test_suite("slow")) {
  if (test::skipped_without_device()) return;
  for (const char* name : {"verlet", "velocity_verlet", "force_gradient4", "rk4"})
    for (const Kind& kind : kinds()) check(scene(scheme(name), Precision::double_, EngineKind::opencl), kind);
}

TEST_CASE("what changes no acceleration disturbs nothing, to the last bit") {
  for (const Scheme& method : schemes())
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      Preset preset = scene(method, precision, EngineKind::cpu);
      preset.bodies = {Body{.c = {0, -5, 0}, .r = 0.1}}, preset.gust = 0.5, preset.gust_period = 0.3;
      CAPTURE(preset.integrator);
      CAPTURE(int(precision));
      Simulation simulation(preset), undisturbed(preset);
      const auto look = [&] {
        simulation.read_raw(), simulation.energy(), simulation.particle(4, 4), simulation.forces(Reduction::sum);
        simulation.snapshot(), simulation.stand_in(), trace_step(simulation, 4, 4);
      };
      look();
      simulation.advance(40), undisturbed.advance(40);
      look();
      for (const char* setting : {"mode=2", "F_max=1000", "F_release=500", "x_0=[0,2,0]", "bodies[0].velocity=[0,-1,0]",
                                  "bodies[0].shape=box", "bodies[0].spin=[1,0,2]"})
        simulation.apply(set(simulation, setting));
      simulation.apply(edit::Pin{0, 0, true});
      simulation.apply(edit::Cut{{{0, 3}}});
      simulation.apply(edit::Release{});
      simulation.apply(edit::MoveBody{0, {0, -6, 0}});
      simulation.apply(edit::MoveBody{0, {0, -7, 0}, 5});
      look();
      simulation.advance(40), undisturbed.advance(40);
      CHECK(test::identical(simulation.read_raw(), undisturbed.read_raw()));
    }
}

TEST_CASE("gravity that is switched on in mid-run begins then, and not half a step before") {
  for (const Scheme& method : schemes()) {
    if (projects(method)) continue;  // falls by g dt² in its first step, as semi-implicit Euler
    CAPTURE(std::string(method.name));
    Preset preset = test::quiet_cloth(2, 1, std::string(method.name));
    preset.dt = 0.01, preset.v_0 = {0, -1, 0};
    Simulation switched(preset);
    switched.advance(10);
    switched.apply(set(switched, "g=9.82"));
    Preset always = preset;
    always.g = 9.82;
    Simulation fresh(always);
    const double from = switched.position(0, 0).y, start = fresh.position(0, 0).y;
    switched.advance(20), fresh.advance(20);
    // Solves end within a residual (balance_tolerance), which is not that of the other run.
    // What solves leave of the weight acts as a force over the whole time. Implicit Euler leaves up to a millionth here
    // (balance_tolerance), since its steps are stiff; the others find the free fall exactly.
    const double t = 20 * preset.dt,
                 left = switched.engine().solves().worst_residual + fresh.engine().solves().worst_residual;
    CHECK(left <= 2 * balance_tolerance<double>);
    const double same = 1e-13 + left * always.g * t * (t + preset.dt) / 2;
    CHECK(std::abs(switched.position(0, 0).y - from - (fresh.position(0, 0).y - start)) <= same);
    if (method.order_undamped < 2 || method.solver != Solver::newton) continue;
    CHECK(from - switched.position(0, 0).y == doctest::Approx(0.2 + 9.82 * 0.2 * 0.2 / 2).epsilon(1e-9));
  }
}

TEST_CASE("a change after restore() or load() kicks nothing") {
  for (const char* method : {"verlet", "velocity_verlet", "force_gradient4", "damped_verlet"}) {
    CAPTURE(std::string(method));
    Preset preset = test::quiet_cloth(8, 8, method);
    preset.dt = 1e-3, preset.k_d = 0.002;
    Simulation simulation(preset);
    const Snapshot start = simulation.snapshot();
    simulation.apply(set(simulation, "W=[0,0,1]"));
    simulation.advance(30);
    simulation.restore(start);
    simulation.apply(set(simulation, "W=[0,0,0]"));
    simulation.advance(200);
    CHECK_FALSE(simulation.divergence().has_value());
    CHECK(farthest(simulation.read(), start.state) < 1e-13);
    simulation.apply(set(simulation, "W=[0,0,1]"));
    simulation.load(start.state);
    simulation.apply(set(simulation, "W=[0,0,0]"));
    simulation.advance(200);
    CHECK(farthest(simulation.read(), start.state) < 1e-13);
  }
}

/// In gusts the wind depends on the time, so the other cloth begins at that time too.
TEST_CASE("a rebuild in mid-run goes on from that moment's positions and full-step velocities, in gusts too") {
  const std::vector<const char*> rebuilds{"precision=double",         "precision=float",
                                          "integrator=rk4",           "integrator=verlet",
                                          "integrator=damped_verlet", "integrator=force_gradient4"};
  for (const char* method : {"verlet", "velocity_verlet", "damped_verlet", "force_gradient4", "rk4"})
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const char* rebuild : rebuilds) {
        CAPTURE(std::string(method));
        CAPTURE(int(precision));
        CAPTURE(std::string(rebuild));
        Preset preset = scene(scheme(method), precision, EngineKind::cpu);
        preset.gust = 1, preset.gust_period = 0.02;  // some spans of wind between two looks
        const bool single = precision == Precision::float_ || std::string(rebuild) == "precision=float";
        const double digits = single ? 2e-6 : 1e-12;
        Simulation simulation(preset);
        simulation.advance(43);
        const Snapshot moment = simulation.snapshot();
        simulation.apply(set(simulation, rebuild));
        const State after = simulation.read();
        CHECK(farthest(moment.state, after) <= digits);
        double kick = 0;
        for (std::size_t p = 0; p < after.v.x.size(); ++p)
          kick = std::max(kick, glm::length(test::velocity(moment.state, p) - test::velocity(after, p)));
        CHECK(kick <= digits);
        Simulation other(simulation.preset());
        other.restore(moment);
        CHECK(other.time() == simulation.time());
        simulation.advance(30), other.advance(30);
        CHECK(farthest(simulation.read(), other.read()) <= 5 * digits);
      }
}

TEST_CASE("a state that was loaded before the first step stays") {
  Simulation simulation(test::cloth(8, 8));
  State state = simulation.read();
  for (double& z : state.x.z) z += 5;
  simulation.load(state);
  for (const char* setting : {"k_s=60", "pins=none", "x_0=[0,3,0]", "integrator=rk4", "precision=float"}) {
    CAPTURE(std::string(setting));
    const Snapshot loaded = simulation.snapshot();
    simulation.apply(set(simulation, setting));
    CHECK(farthest(simulation.read(), state) < 1e-6);
    simulation.restore(loaded);
    simulation.apply(set(simulation, setting));
    CHECK(farthest(simulation.read(), state) < 1e-6);
  }
  simulation.apply(edit::Restart{});
  CHECK(farthest(simulation.read(), state) > 4);
}

/// A taut cloth in gusts, whose springs all pull all the time, for 0.2 s, in spans of 1.25 ms.
State after_gusts(const std::string& method, double dt) {
  Preset preset = test::quiet_cloth(6, 6, method);
  preset.initial_stretch = 1.2, preset.pins.mode = Pins::Mode::boundary, preset.k_s = 5;
  preset.k_d = method == "velocity_verlet" || method == "damped_verlet" ? 2e-4 : 0;
  preset.W = {0.001, 0, 0.002}, preset.gust = 1, preset.gust_period = 0.08, preset.dt = dt;
  Simulation simulation(preset);
  simulation.advance(int(std::lround(0.2 / dt)));
  return simulation.read();
}

TEST_CASE("in gusts methods of second order keep it, though spans are no whole number of steps") {
  for (const char* method : {"verlet", "velocity_verlet", "damped_verlet", "force_gradient4", "rkn4"}) {
    CAPTURE(std::string(method));
    const State exact = after_gusts(method, 0.2 / 32000);
    double error[3];
    for (int n = 0; n < 3; ++n) error[n] = farthest(after_gusts(method, 0.2 / (500 << n)), exact);
    CHECK(error[0] < 1e-5);
    CHECK(error[0] / error[2] > 11);  // 16 if every border lay alike in its step
  }
}

}  // namespace tyglab::edit_test
