// The energy ledger: what it reads, adds up, and leaves unexplained.
#include "core/energy/ledger.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/forces/readout.h"
#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::ledger_test {

/// A sheet that is taut all the time, so that forces are smooth: damped, in wind, swinging.
Preset taut(const std::string& integrator, double k_d) {
  Preset preset = test::cloth(6, 6, integrator);
  preset.initial_stretch = 1.1, preset.pins.mode = Pins::Mode::boundary;
  preset.k_d = k_d, preset.W = {0.001, 0, 0.002}, preset.v_0 = {0.2, -0.1, 0.3};
  return preset;
}

/// Share of the energy that nothing explains after `seconds`.
double left_over(Preset preset, double dt, double seconds) {
  preset.dt = dt;
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  simulation.advance(int(std::lround(seconds / dt)));
  REQUIRE(!simulation.divergence());
  return simulation.ledger()->share();
}

/// The order with which it falls when dt is halved.
double order_of(const Preset& preset, double dt) {
  const double coarse = left_over(preset, dt, 0.096), fine = left_over(preset, dt / 2, 0.096);
  return std::log2(std::abs(coarse / fine));
}

TEST_CASE("a running integral is exact for polynomials of degree 4 and stops at breaks") {
  const auto f = [](double t) { return 1 + t * (2 + t * (-3 + t * (0.5 + t))); };
  const auto F = [](double t) { return t * (1 + t * (1 + t * (-1 + t * (0.125 + t * 0.2)))); };
  const double h = 0.25;
  RunningIntegral integral;
  integral.restart(f(0));
  CHECK(integral.total() == 0);
  for (int n = 1; n <= 12; ++n) {
    integral.add(f(n * h), h);
    CAPTURE(n);
    // One and two steps see a line and a parabola only.
    CHECK(integral.total() == doctest::Approx(F(n * h)).epsilon(n < 2 ? 0.03 : n < 4 ? 2e-3 : 1e-12));
  }
  const double so_far = integral.total();
  integral.restart(-5);
  CHECK(integral.total() == so_far);
  integral.add(-5, 2);
  CHECK(integral.total() == doctest::Approx(so_far - 10));
  // A shorter step, as where an impact splits one: from the value before it on.
  integral.add(-7, 0.5);
  CHECK(integral.total() == doctest::Approx(so_far - 10 - 3));
}

TEST_CASE("a cloth's energy is that of its parts") {
  Preset preset = test::quiet_cloth(2, 3);
  preset.initial_stretch = 2, preset.m = 0.5, preset.k_s = 10, preset.k_b = 7, preset.g = 2;
  preset.v_0 = {0, 0, 3};
  Simulation simulation(preset);
  const Energy e = simulation.energy().energy;
  CHECK(e.kinetic == doctest::Approx(6 * 0.5 / 2 * 9));
  // Along rows 4, along columns 3, diagonals 4, every one twice its length.
  const double L = preset.L;
  CHECK(e.of[force::stretch] == doctest::Approx(10 / 2.0 * (7 * L * L + 4 * 2 * L * L)));
  CHECK(e.of[force::bend] == 0);
  CHECK(e.of[force::gravity] == doctest::Approx(0.5 * 2 * (3 * 1 + 3 * (1 - 2 * L))));
}

TEST_CASE("energies and powers are those of the forces on each particle") {
  Preset preset = test::cloth(7, 9);
  preset.W = {0.003, 0.001, 0.002}, preset.g = 3;
  const State state = test::crumpled(preset, 5);
  const Lattice lattice = lattice_of(preset);
  Tears tears(lattice);
  for (const bool torn : {false, true}) {
    CAPTURE(torn);
    if (torn) tears.tear(0, 2, 3), tears.tear(2, 4, 4), tears.tear(3, 1, 8), tears.tear(1, 5, 0);
    const auto at = [&](double t) {
      State moved = state;
      for (std::size_t n = 0; n < moved.x.x.size(); ++n)
        moved.x.x[n] += t * moved.v.x[n], moved.x.y[n] += t * moved.v.y[n], moved.x.z[n] += t * moved.v.z[n];
      return read_energy(preset, tears, moved, Held{}).energy;
    };
    const double tiny = 1e-6;
    const double rise = (at(tiny).total() - at(-tiny).total()) / (2 * tiny);
    double conservative = 0, damping = 0, wind = 0;
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j) {
        const ParticleForces f = forces_on_particle(preset, tears, state, i, j);
        const glm::dvec3 v = test::velocity(state, std::size_t(i) * lattice.columns + j);
        conservative += glm::dot(f[force::stretch] + f[force::bend] + f[force::gravity], v);
        damping += glm::dot(f[force::damping], v), wind += glm::dot(f[force::wind], v);
      }
    const Power power = read_energy(preset, tears, state, Held{}).power;
    CHECK(rise == doctest::Approx(-conservative).epsilon(1e-6));
    CHECK(power.of[force::damping] == doctest::Approx(damping).epsilon(1e-9));
    CHECK(power.of[force::wind] == doctest::Approx(wind).epsilon(1e-9));
  }
}

TEST_CASE("what nothing explains falls at the order of the method, down to rounding") {
  struct Case {
    const char* method;
    double k_d, dt;
    int order;
  };
  for (const Case& c : {Case{"euler", 0.002, 6.25e-6, 1}, Case{"verlet", 0, 4e-4, 2}, Case{"verlet", 0.002, 1e-5, 1},
                        Case{"velocity_verlet", 0.002, 4e-4, 2}, Case{"implicit_midpoint", 0.002, 4e-4, 2},
                        Case{"rk4", 0.002, 2.5e-5, 4}}) {
    if (test::sanitized && c.dt < 1e-4) continue;  // many steps, and none that the others do not make
    CAPTURE(c.method);
    CAPTURE(c.k_d);
    const double order = order_of(taut(c.method, c.k_d), c.dt);
    CHECK(order > c.order - 0.15);
    CHECK(order < c.order + 0.15);
  }
  if (!test::sanitized) CHECK(std::abs(left_over(taut("rk4", 0.002), 6.25e-6, 0.096)) < 1e-13);
}

TEST_CASE("a body's impact and friction are contact's, and leave little unexplained") {
  Preset preset = test::cloth(8, 8);
  preset.pins.mode = Pins::Mode::none;
  preset.tilt_deg = 0;
  preset.x_0 = {0, 0.05, 0}, preset.v_0 = {0.5, -1, 0};
  Body plane;
  plane.shape = Body::Shape::plane, plane.y = 0, plane.friction = 0.4, plane.restitution = 0.3;
  preset.bodies = {plane};
  preset.dt = 1e-4;
  for (const char* method : {"velocity_verlet", "rk4", "dopri5"}) {
    CAPTURE(method);
    preset.integrator = method;
    Simulation simulation(preset);
    simulation.enable_ledger(true);
    simulation.advance(test::fewer(4000, 800));
    const LedgerReading ledger = *simulation.ledger();
    CHECK(ledger.works.contact < -0.5 * ledger.start);
    CHECK(std::abs(ledger.share()) < 2e-3);
    CHECK(ledger.works.of[force::wind] == 0);
    CHECK(ledger.works.edits == 0);
  }
}

TEST_CASE("what bodies stop takes no more memory the more inner steps there are") {
  Preset preset = test::cloth(5, 5, "dopri5");
  preset.pins.mode = Pins::Mode::none;
  preset.tilt_deg = 0;
  preset.x_0 = {0, 0.001, 0}, preset.v_0 = {0, -1, 0};
  preset.bodies.emplace_back().shape = Body::Shape::plane;
  preset.initial_stretch = 1.02;  // it swings within its plane: accuracy, not rounding, asks for inner steps
  preset.dt = 0.1, preset.tolerance = 1e-9;
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  for (int dt = 0; dt < 3; ++dt) {
    simulation.advance(1);
    const std::vector<Contact> contacts = simulation.engine().contacts();
    CHECK(contacts.size() > 0);
    CHECK(contacts.size() <= std::size_t(simulation.lattice().size()));
  }
  CHECK(simulation.engine().inner_steps().accepted > 50);
}

TEST_CASE("what a body stops is contact's also under an engine made anew before the first step") {
  Preset preset = test::cloth(5, 5);
  preset.pins.mode = Pins::Mode::none;
  preset.tilt_deg = 0;
  preset.x_0 = {0, 0.01, 0}, preset.v_0 = {0, -1, 0};
  preset.bodies.emplace_back().shape = Body::Shape::plane;
  Preset other = preset;
  other.integrator = "velocity_verlet";
  const auto contact_of = [](Simulation& simulation) {
    simulation.advance(200);
    return simulation.ledger()->works.contact;
  };
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  const auto beside = simulation.rebuilt(edit::Change{other});
  simulation.apply(edit::Change{other});
  CHECK(contact_of(simulation) < -1e-6);
  CHECK(contact_of(*beside) == contact_of(simulation));
}

TEST_CASE("springs that break and cuts take their energy with them") {
  Preset preset = test::cloth(10, 10, "velocity_verlet");
  preset.F_max = 0.02, preset.dt = 2e-4, preset.v_0 = {0, 0, 2};
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  simulation.advance(1500);
  CHECK(simulation.tears().torn_count() > 0);
  const double broken = simulation.ledger()->works.tearing;
  CHECK(broken < 0);
  CHECK(std::abs(simulation.ledger()->share()) < 5e-3);
  simulation.apply(edit::Cut{{{4, 4}, {4, 5}}});
  CHECK(simulation.ledger()->works.tearing < broken);
  CHECK(std::abs(simulation.ledger()->share()) < 5e-3);
}

TEST_CASE("the hand's work is what it puts in; constants that change are edits") {
  Preset preset = test::cloth(10, 10, "velocity_verlet");
  preset.dt = 2e-4;
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  simulation.advance(500);
  simulation.apply(edit::Grab{9, 5});
  const glm::dvec3 from = simulation.positions().at(9, 5);
  for (int frame = 1; frame <= 10; ++frame) {
    simulation.apply(edit::MoveHand{from + glm::dvec3(0, 0.01 * frame, 0.005 * frame), 50});
    simulation.advance(50);
  }
  simulation.apply(edit::Release{});
  simulation.advance(100);
  LedgerReading ledger = *simulation.ledger();
  CHECK(ledger.works.hand > 0);
  CHECK(ledger.works.edits == 0);
  CHECK(std::abs(ledger.share()) < 2e-3);
  const double before = ledger.energy.total();
  Preset stiffer = simulation.preset();
  stiffer.k_s *= 3;
  simulation.apply(edit::Change{stiffer});
  ledger = *simulation.ledger();
  CHECK(ledger.works.edits == doctest::Approx(ledger.energy.total() - before));
  CHECK(ledger.works.edits > 0);
  CHECK(std::abs(ledger.share()) < 2e-3);
  simulation.apply(edit::Restart{});
  CHECK(simulation.ledger()->unexplained() == 0);
}

TEST_CASE("a ledger tells that the integrator makes energy, and does not change where the run diverges") {
  Preset preset = test::cloth(12, 12, "euler");
  preset.k_d = 0, preset.k_s = 5000;
  Simulation with(preset), without(preset);
  with.enable_ledger(true);
  with.advance(2000), without.advance(2000);
  REQUIRE(with.divergence());
  REQUIRE(without.divergence());
  CHECK(with.divergence()->step == without.divergence()->step);
  CHECK(with.divergence()->quantity == without.divergence()->quantity);
  CHECK(with.ledger()->share() > Ledger::warns_at);
  CHECK(test::identical(with.read(), without.read()));
}

TEST_CASE("a ledger changes no bit of the motion, and the one weight has one") {
  Preset preset = test::cloth(12, 12);
  Simulation with(preset), without(preset);
  with.enable_ledger(true);
  with.advance(300), without.advance(300);
  CHECK(test::identical(with.read(), without.read()));
  Preset weight = test::one_weight("rk4");
  weight.k_d = 0.01;
  Simulation one(weight);
  one.enable_ledger(true);
  one.advance(500);
  CHECK(one.ledger()->works.of[force::damping] < 0);
  CHECK(std::abs(one.ledger()->share()) < 1e-6);
}

}  // namespace tyglab::ledger_test
