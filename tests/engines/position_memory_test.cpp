// Positions in memory that is handed in, as OpenGL's is: the motion keeps its bits, and what is shown is never written.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/vertex_sharing.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::position_memory_test {

/// Memory as whoever draws would lend it.
class Pages {
 public:
  explicit Pages(std::size_t bytes) : memory(std::make_shared<PositionMemory>()) {
    memory->bytes = (bytes + PositionMemory::page - 1) / PositionMemory::page * PositionMemory::page;
    for (void*& slot : memory->slots) {
      slot = std::aligned_alloc(PositionMemory::page, memory->bytes);
      std::memset(slot, 0, memory->bytes);
    }
  }
  ~Pages() {
    for (void* slot : memory->slots) std::free(slot);
  }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;
  /// The slot that holds what is shown; -1: none.
  int slot_of(const PositionView& view) const {
    for (int n = 0; n < PositionMemory::count; ++n) {
      const auto* begin = static_cast<const std::byte*>(memory->slots[std::size_t(n)]);
      const auto* at = reinterpret_cast<const std::byte*>(view.f[0]);
      if (at >= begin && at < begin + memory->bytes) return n;
    }
    return -1;
  }
  std::vector<std::byte> content(int slot) const {
    const auto* begin = static_cast<const std::byte*>(memory->slots[std::size_t(slot)]);
    return {begin, begin + memory->bytes};
  }
  std::shared_ptr<PositionMemory> memory;
};

Preset scene(const std::string& integrator, Precision precision) {
  Preset preset = test::cloth(33, 47, integrator);
  preset.engine = EngineKind::opencl;
  preset.precision = precision;
  return preset;
}

bool same_state(const State& a, const State& b) {
  return a.x.x == b.x.x && a.x.y == b.x.y && a.x.z == b.x.z && a.v.x == b.v.x && a.v.y == b.v.y && a.v.z == b.v.z;
}

bool same_positions(const PositionView& shown, const PositionView& own) {
  for (int i = 0; i < own.rows; ++i)
    for (int j = 0; j < own.columns; ++j)
      if (glm::vec3(shown.at(i, j)) != glm::vec3(own.at(i, j))) return false;
  return true;
}

/// Shows what it is at, then makes steps, and looks whether what was shown stayed as it was.
void show_and_step(Simulation& simulation, Pages& pages, int steps) {
  const int slot = pages.slot_of(drawn_positions(simulation.engine()));
  REQUIRE(slot >= 0);
  pages.memory->shown = slot;
  const std::vector<std::byte> before = pages.content(slot);
  simulation.advance(steps);
  CHECK(pages.content(slot) == before);
}

TEST_CASE("positions in lent memory move with the same bits, and what is shown is never written") {
  if (test::skipped_without_device()) return;
  for (const Scheme& method : schemes()) {
    if (!runs_on_opencl(method)) continue;
    CAPTURE(std::string(method.name));
    const Preset preset = scene(std::string(method.name), Precision::float_);
    Simulation plain(preset), lent(preset);
    Pages pages(lent.engine().vertex_sharing()->wanted_slot_bytes());
    REQUIRE(lent.engine().vertex_sharing()->use_memory(pages.memory));
    CHECK(lent.engine().vertex_sharing()->wanted_slot_bytes() == 0);
    for (const int steps : {1, 2, 30, 7, 1, 300}) {
      show_and_step(lent, pages, steps);
      plain.advance(steps);
    }
    CHECK(same_state(lent.read(), plain.read()));
    CHECK(pages.slot_of(lent.positions()) >= 0);
    CHECK(bytes_read(lent.engine()) == 0);
  }
}

TEST_CASE("in double the memory shows the positions in float") {
  if (test::skipped_without_device()) return;
  const Preset preset = scene("verlet", Precision::double_);
  Simulation plain(preset), lent(preset);
  Pages pages(lent.engine().vertex_sharing()->wanted_slot_bytes());
  if (!lent.engine().vertex_sharing()->use_memory(pages.memory))
    FAIL("a processor works in the memory that it is given");
  for (const int steps : {1, 40, 3}) {
    show_and_step(lent, pages, steps);
    plain.advance(steps);
    CHECK(same_positions(drawn_positions(lent.engine()), plain.positions()));
  }
  CHECK(same_state(lent.read(), plain.read()));
}

TEST_CASE("what is shown stays where a state is loaded, a step is made again, or a run diverges") {
  if (test::skipped_without_device()) return;
  Preset preset = scene("verlet", Precision::float_);
  preset.F_max = 2;
  Simulation plain(preset), lent(preset);
  Pages pages(lent.engine().vertex_sharing()->wanted_slot_bytes());
  REQUIRE(lent.engine().vertex_sharing()->use_memory(pages.memory));
  const auto both = [&](const auto& what) { what(plain), what(lent); };
  show_and_step(lent, pages, 50), plain.advance(50);
  const Snapshot then = plain.snapshot();
  show_and_step(lent, pages, 200), plain.advance(200);
  pages.memory->shown = pages.slot_of(drawn_positions(lent.engine()));
  const std::vector<std::byte> before = pages.content(pages.memory->shown);
  both([&](Simulation& s) { s.restore(then); });
  CHECK(pages.content(pages.memory->shown) == before);
  both([&](Simulation& s) {
    Preset next = s.preset();
    next.dt *= 8, next.F_max = 0;
    s.apply(edit::Change{next});
  });
  show_and_step(lent, pages, 2000), plain.advance(2000);
  REQUIRE(plain.divergence());
  CHECK(lent.divergence()->step == plain.divergence()->step);
  CHECK(same_state(lent.read(), plain.read()));
  CHECK(same_positions(drawn_positions(lent.engine()), plain.positions()));
}

TEST_CASE("the CPU engine shares nothing with OpenGL") {
  Simulation simulation(test::cloth(8, 8));
  CHECK(simulation.engine().vertex_sharing() == nullptr);
  CHECK_FALSE(is_remote(simulation.engine()));
  CHECK(bytes_read(simulation.engine()) == 0);
  CHECK(same_positions(drawn_positions(simulation.engine()), simulation.positions()));
}

}  // namespace tyglab::position_memory_test
