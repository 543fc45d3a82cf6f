// Engines compiled without some parts, which `bench skip` measures: they do what the whole engine does while it is off.
#include <doctest/doctest.h>

#include "core/cloth/state.h"
#include "core/engines/cpu/parts.h"
#include "tests/bench/skip.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::parts_test {

namespace part = cpu::part;

State after(Engine& engine, const Preset& preset, int steps) {
  Tears tears(lattice_of(preset));
  engine.set_fixed(particles_in(pinned_particles(preset)), {});
  engine.load(start_state(preset), tears);
  CHECK(engine.advance(steps, tears).steps == steps);
  State state;
  engine.read_raw(state, tears);
  return state;
}

TEST_CASE("an engine without a part makes the same bits as the whole one with the part off" *
          doctest::skip(test::sanitized)) {
  for (const SkipFeature& feature : skip_features(19)) {
    if (feature.absent == 0) continue;
    CAPTURE(feature.name);
    const Lattice lattice = lattice_of(feature.preset_off);
    const auto whole = make_engine(feature.preset_off, lattice, 1);
    const auto without = cpu::make_engine_without(feature.absent, feature.preset_off, lattice);
    REQUIRE(without != nullptr);
    CHECK(test::identical(after(*whole, feature.preset_off, 300), after(*without, feature.preset_off, 300)));
  }
}

TEST_CASE("an engine without a part leaves it out even where the preset asks for it" * doctest::skip(test::sanitized)) {
  Preset preset = test::cloth(18, 17);
  preset.precision = Precision::float_;
  preset.bodies = {Body{}};
  preset.bodies[0].c = {0.25, 0.9, 0.1};
  Preset off = preset;
  off.bodies.clear();
  const Lattice lattice = lattice_of(preset);
  const auto whole = make_engine(preset, lattice, 1), whole_off = make_engine(off, lattice, 1);
  const auto without = cpu::make_engine_without(part::all_but_pins, preset, lattice);
  const State expected = after(*whole_off, off, 200);
  CHECK(test::identical(expected, after(*without, preset, 200)));
  CHECK_FALSE(test::identical(expected, after(*whole, preset, 200)));  // the body does something here
}

TEST_CASE("only pins, or all but pins, can be left out" * doctest::skip(test::sanitized)) {
  const Preset preset = test::cloth(4, 4);
  for (const unsigned absent : {0u, unsigned(part::bodies), unsigned(part::everything)})
    CHECK(cpu::make_engine_without(absent, preset, lattice_of(preset)) == nullptr);
}

}  // namespace tyglab::parts_test
