// Positions that a device writes into OpenGL's own memory: the picture is that of copied ones, and nothing is copied.
#include <doctest/doctest.h>

#include "app/render/gl_objects.h"
#include "app/render/mapped_buffer.h"
#include "tests/app/picture_pair.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::shared_memory_test {

Preset scene(EngineKind engine, Precision precision) {
  Preset preset = test::cloth(24, 31);
  preset.engine = engine;
  preset.precision = precision;
  return preset;
}

TEST_CASE("the vertex buffer shows what kernels wrote, and no byte is copied") {
  if (test::skipped_without_device()) return;
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    test::PicturePair stage;
    REQUIRE(gl::MappedBuffer::available());
    Simulation simulation(scene(EngineKind::opencl, precision));
    Image last;
    for (const int steps : {1, 3, 60, 200}) {
      simulation.advance(steps);
      CHECK(stage.copied_for(simulation, 1) == 0);
      CHECK(stage.vertex_path() == VertexPath::shared_memory);
      CHECK(stage.picture().rgb != last.rgb);
      last = stage.picture();
    }
  }
}

TEST_CASE(
    "another lattice, a cut, another view, method, precision or engine: what is drawn is right, and what can be is "
    "shared") {
  if (test::skipped_without_device()) return;
  test::PicturePair stage;
  Simulation simulation(scene(EngineKind::opencl, Precision::float_));
  test::check_pictures_of_changes(stage, simulation, VertexPath::shared_memory);
}

TEST_CASE("an engine goes on in its memory where the renderer that drew it is gone") {
  if (test::skipped_without_device()) return;
  test::PicturePair stage;
  Simulation plain(scene(EngineKind::opencl, Precision::float_)), lent(plain.preset());
  CHECK(stage.copied_by_a_sibling(lent) == 0);
  plain.advance(50), lent.advance(50);
  CHECK(lent.read().x.y == plain.read().x.y);
  CHECK(stage.copied_for(lent, 1) == 0);
}

TEST_CASE("the memory of engines that are gone is given back") {
  if (test::skipped_without_device()) return;
  test::PicturePair stage;
  std::size_t bytes = 0;
  for (int n = 0; n < 5; ++n) {
    Simulation simulation(scene(EngineKind::opencl, Precision::float_));
    for (int k = 0; k <= n; ++k) simulation.advance(1);  // each is seen to have changed
    stage.copied_for(simulation, 1);
    if (n > 0) CHECK(stage.sharing().bytes() == bytes);
    bytes = stage.sharing().bytes();
  }
}

TEST_CASE("a buffer that OpenGL has no room for is refused with a sentence") {
  const test::PicturePair stage;
  constexpr std::size_t far_too_much = std::size_t(1) << 45;
  CHECK_THROWS_WITH_AS(gl::MappedBuffer(3, far_too_much), "OpenGL could not allocate a persistently mapped buffer",
                       GraphicsError);
  CHECK_NOTHROW(gl::MappedBuffer(3, 4096));
}

}  // namespace tyglab::shared_memory_test
