// Methods that solve equations, on OpenCL: the same solutions as the CPU engine's, the same counts, the same bits in
// every run.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/engines/newton.h"
#include "core/engines/opencl/opencl_engine.h"
#include "tests/engines/engine_pair.h"
#include "tests/support/devices.h"

namespace tyglab::opencl_implicit_test {

using test::everything;
using test::Pair;

constexpr const char* implicit_methods[] = {"implicit_euler", "implicit_midpoint", "tr_bdf2"};

/// An engine of that width with the preset's cloth as it starts.
std::unique_ptr<Engine> engine_of(const Preset& preset, int width, Tears& tears) {
  auto engine = opencl::make_opencl_engine(preset, lattice_of(preset), width);
  engine->set_fixed(particles_in(pinned_particles(preset)), {});
  engine->load(start_rows(preset), tears);
  return engine;
}

TEST_CASE("solves: wind, pins, bodies, the hand, cuts, as on the CPU engine") {
  if (test::skipped_without_device()) return;
  for (const char* method : implicit_methods) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(method));
      CAPTURE(int(precision));
      check_handling(Pair(everything(precision, method)));
    }
  }
}

TEST_CASE("solves: a large dt, with and without bending and damping") {
  if (test::skipped_without_device()) return;
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const double k_b : {0.0, 5.0}) {
      CAPTURE(int(precision));
      CAPTURE(k_b);
      Preset preset = test::cloth(21, 34, "implicit_euler");
      preset.precision = precision, preset.k_b = k_b, preset.k_d = k_b / 1000;
      preset.dt = 5e-3, preset.iterations = 40;
      Pair pair(preset);
      pair.advance(30);
      pair.check();
      pair.change([](Preset& p) { p.k_s = 400, p.dt = 2e-3; });
      pair.advance(30);
      pair.check();
      CHECK(pair.opencl.engine().solves().unconverged == pair.cpu.engine().solves().unconverged);
    }
}

TEST_CASE("solves: what was done is counted as the CPU engine counts it") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(40, 37, "implicit_euler");
  preset.dt = 1e-3;
  Pair pair(preset);
  pair.advance(50);
  const SolveCounts cpu = pair.cpu.engine().solves(), opencl = pair.opencl.engine().solves();
  CHECK(opencl.unconverged == cpu.unconverged);
  // Rounding decides now and then whether another step is made.
  const auto alike = [](std::int64_t a, std::int64_t b) { return std::abs(double(a - b)) <= 0.03 * double(b); };
  CHECK(alike(opencl.newton, cpu.newton));
  CHECK(alike(opencl.linear, cpu.linear));
  CHECK(alike(opencl.force_evaluations, cpu.force_evaluations));
}

TEST_CASE("solves: the same springs tear") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(40, 37, "implicit_euler");
  preset.pins.mode = Pins::Mode::left_column;
  preset.F_max = 0.01, preset.dt = 1e-3;
  Pair pair(preset);
  for (int n = 0; n < 12; ++n) {
    pair.advance(15);
    CHECK(pair.opencl.tears().torn_count() == pair.cpu.tears().torn_count());
  }
  CHECK(pair.cpu.tears().torn_count() > 5);
  pair.check();
}

TEST_CASE("solves: where conjugate gradients do not get there, the host solves directly, as the CPU engine does") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(60, 4, "implicit_euler");
  preset.precision = Precision::float_;
  preset.k_s = preset.k_b = 1e9, preset.k_d = 0, preset.dt = 1;
  preset.iterations = 1;  // one linear system
  preset.pins.mode = Pins::Mode::top_row;
  Pair pair(preset);
  pair.advance(1);
  CHECK(pair.opencl.engine().solves().linear == max_gradient_steps(lattice_of(preset)));
  pair.check();
}

TEST_CASE("solves: one weight") {
  if (test::skipped_without_device()) return;
  for (const char* method : implicit_methods) {
    Pair pair(test::one_weight(method));
    pair.advance(100);
    pair.check();
  }
}

TEST_CASE("solves: work-items of one particle, and vectors of any width, in one launch and in many") {
  if (test::skipped_without_device()) return;
  for (const int rows : {33, 170}) {
    Preset preset = everything(Precision::float_, "implicit_euler");
    preset.rows = rows, preset.columns = rows + 14;
    Simulation cpu(preset);
    cpu.advance(20);
    for (const int width : {1, 4, 8, 16}) {
      CAPTURE(rows);
      CAPTURE(width);
      Tears tears(lattice_of(preset));
      const auto engine = engine_of(preset, width, tears);
      engine->advance(20, tears);
      State state;
      engine->read(state, tears);
      CHECK(test::distance(state, cpu.read()) <= test::tolerance(preset));
    }
  }
}

TEST_CASE("solves: every run has the same bits, whatever the pieces in which steps are made") {
  if (test::skipped_without_device()) return;
  for (const int width : {0, 1})
    for (const int rows : {33, 150}) {
      CAPTURE(width);
      CAPTURE(rows);
      Preset preset = everything(Precision::float_, "implicit_euler");
      preset.rows = rows, preset.columns = rows;
      State states[3];
      for (int run = 0; run < 3; ++run) {
        Tears tears(lattice_of(preset));
        const auto engine = engine_of(preset, width, tears);
        for (int n = 0; n < 10; n += run == 2 ? 1 : 10) engine->advance(run == 2 ? 1 : 10, tears);
        engine->read(states[run], tears);
      }
      CHECK(test::identical(states[0], states[1]));
      CHECK(test::identical(states[0], states[2]));
    }
}

}  // namespace tyglab::opencl_implicit_test
