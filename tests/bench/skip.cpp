#include "tests/bench/skip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <stdexcept>

#include "core/cloth/state.h"
#include "core/engines/cpu/parts.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

namespace part = cpu::part;

/// The default cloth: stretch, bending, damping and gravity, pinned at two corners.
Preset scene_of(int side) {
  Preset preset;
  preset.rows = preset.columns = side;
  preset.dt = 1e-4;  // thousands of steps stay within a second of motion
  return preset;
}

std::unique_ptr<Engine> make_engine_for(const SkipFeature& feature, SkipState state, const Preset& preset) {
  const Lattice lattice = lattice_of(preset);
  if (state == SkipState::absent && feature.absent != 0)
    return cpu::make_engine_without(feature.absent, preset, lattice);
  return make_engine(preset, lattice, 1);
}

}  // namespace

std::string_view name_of(SkipState state) {
  return state == SkipState::on ? "on" : state == SkipState::off ? "off" : "absent";
}

std::vector<SkipFeature> skip_features(int side) {
  std::vector<SkipFeature> features;
  const auto add = [&](std::string name, std::string on_means, unsigned absent, auto on, auto off) {
    SkipFeature feature{std::move(name), std::move(on_means), absent, scene_of(side), scene_of(side)};
    on(feature.preset_on), off(feature.preset_off);
    features.push_back(std::move(feature));
  };
  const auto plain = [](Preset&) {};
  add("bending", "k_b = 5 N/m, as in the default cloth", 0, plain, [](Preset& p) { p.k_b = 0; });
  add(
      "rigidity", "B = 10 µN·m, twist = 1", 0, [](Preset& p) { p.B = 1e-5; }, plain);
  add("damping", "k_d = 0.002 Ns/m, as in the default cloth", 0, plain, [](Preset& p) { p.k_d = 0; });
  add(
      "wind", "on every triangle", 0,
      [](Preset& p) {
        p.W = {0, 0, 1e-3};
      },
      plain);
  const auto bodies = [](Preset& p) {
    p.bodies = {Body{}, Body{.shape = Body::Shape::plane, .y = -100}};
    p.bodies[0].c = {0, 50, 0};
  };
  add("bodies", "a sphere and a plane, out of reach", part::all_but_pins, bodies, plain);
  // As people tear a cloth: steps of 1 ms, and a limit that is thirty times what the topmost springs bear.
  const auto hung_by_a_row = [](Preset& p) { p.dt = 1e-3, p.pins.mode = Pins::Mode::top_row; };
  const auto watched = [&](Preset& p) { hung_by_a_row(p), p.F_max = 30 * p.rows * p.m * p.g; };
  add("tearing", "F_max is set, and no spring reaches it", part::all_but_pins, watched, hung_by_a_row);
  // Without pins the cloth falls: a short way, so that floats can still tell its particles apart.
  const auto pinned_by = [](Pins::Mode mode) { return [mode](Preset& p) { p.dt = 1e-6, p.pins.mode = mode; }; };
  add("pins", "a column of pinned particles", part::pins, pinned_by(Pins::Mode::left_column),
      pinned_by(Pins::Mode::none));
  add(
      "hand", "a particle in the middle is held, F_release is watched", part::all_but_pins,
      [](Preset& p) { p.F_release = 1e9; }, plain);
  features.back().held_when_on = true;
  return features;
}

SkipCase::SkipCase(const SkipFeature& feature, SkipState state) {
  const Preset& preset = state == SkipState::on ? feature.preset_on : feature.preset_off;
  assert(state != SkipState::absent || preset.precision == Precision::float_);
  const Lattice lattice = lattice_of(preset);
  particles_ = lattice.size();
  tears_ = Tears(lattice);
  engine_ = make_engine_for(feature, state, preset);
  Held held;
  if (state == SkipState::on && feature.held_when_on)
    held.particle = (lattice.rows / 2) * lattice.columns + lattice.columns / 2;
  engine_->set_fixed(particles_in(pinned_particles(preset)), held);
  engine_->load(start_state(preset), tears_);
  engine_->advance(1, tears_);  // in which every spring is measured
}

double SkipCase::advance(int steps) {
  const auto start = std::chrono::steady_clock::now();
  const AdvanceResult done = engine_->advance(steps, tears_);
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  if (done.steps < steps || done.torn > 0)
    throw std::runtime_error("a scene of bench skip diverged or tore, so its times mean nothing");
  return time.count() / steps / particles_;
}

SkipRow measure_skip(const SkipFeature& feature, int rounds) {
  constexpr std::array states{SkipState::absent, SkipState::off, SkipState::on};
  std::vector<SkipCase> cases;
  cases.reserve(states.size());
  for (const SkipState state : states) cases.emplace_back(feature, state);
  // A run of a few milliseconds; the first ones warm up.
  const double particles = feature.preset_on.rows * feature.preset_on.columns;
  const int steps = std::max(1, int(2e6 / (2 * particles)));
  for (SkipCase& which : cases) which.advance(steps);

  std::vector<double> absent, off_ratios, on_ratios;
  for (int round = 0; round < rounds; ++round) {
    std::array<double, states.size()> ns{};
    for (std::size_t n = 0; n < states.size(); ++n) {
      const std::size_t turn = (n + std::size_t(round)) % states.size();  // nobody is always the first
      ns[turn] = cases[turn].advance(steps);
    }
    absent.push_back(ns[0]), off_ratios.push_back(ns[1] / ns[0]), on_ratios.push_back(ns[2] / ns[0]);
  }
  SkipRow row{feature, rounds};
  row.ns_absent = median(absent);
  row.ns_off = row.ns_absent * median(off_ratios);
  row.ns_on = row.ns_absent * median(on_ratios);
  return row;
}

}  // namespace tyglab
