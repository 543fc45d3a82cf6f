// The small pictures of the start page: every shipped scene has one, whatever becomes of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/scene/sketch.h"
#include "core/io/preset_io.h"

namespace tyglab::sketch_test {

const auto go_on = [] { return false; };

bool inside(const SceneSketch& sketch) {
  return std::all_of(sketch.corners.begin(), sketch.corners.end(), [](const SceneSketch::Corner& corner) {
    return corner.at.x >= 0 && corner.at.x <= 1 && corner.at.y >= 0 && corner.at.y <= 1 && corner.light >= 0 &&
           corner.light <= 1;
  });
}

TEST_CASE("every shipped preset has a picture that fits its frame, those that diverge too") {
  for (const auto& file : std::filesystem::directory_iterator(TYGLAB_SOURCE_DIR "/app/presets")) {
    if (file.path().extension() != ".json") continue;
    CAPTURE(file.path().filename().string());
    const SceneSketch sketch = sketch_of(load_preset(file.path()), go_on);
    CHECK((sketch.triangles.size() > 8 || sketch.line.size() > 8));
    CHECK(inside(sketch));
    for (const auto& triangle : sketch.triangles)
      CHECK(*std::max_element(triangle.begin(), triangle.end()) < sketch.corners.size());
    for (const SceneSketch::Ball& ball : sketch.balls) CHECK(ball.behind <= sketch.triangles.size());
  }
}

TEST_CASE("pictures are made beside the frames, one for each preset that differs") {
  SceneSketches sketches;
  const auto made = [&](const Preset& preset) {
    const SceneSketch* sketch = nullptr;
    for (int n = 0; n < 1000 && (sketch = sketches.of(preset)) == nullptr; ++n) {
      sketches.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    REQUIRE(sketch != nullptr);
    return sketch;
  };
  Preset hanging, weight;
  weight.kind = Kind::one_weight;
  CHECK(sketches.of(hanging) == nullptr);
  const SceneSketch* first = made(hanging);
  CHECK(made(weight) != first);
  CHECK(made(hanging) == first);
  while (sketches.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK_FALSE(sketches.poll());
}

}  // namespace tyglab::sketch_test
