// The small pictures of the start page: every shipped scene has one, whatever becomes of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <variant>

#include "app/scene/sketch.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "tests/support/places.h"

namespace tyglab::sketch_test {

const auto go_on = [] { return false; };

bool inside(const SceneSketch& sketch) {
  return std::all_of(sketch.corners.begin(), sketch.corners.end(), [](const SceneSketch::Corner& corner) {
    const bool in_picture = corner.at.x >= 0 && corner.at.x <= 1 && corner.at.y >= 0 && corner.at.y <= 1;
    return (in_picture || !corner.cloth) && corner.light >= 0 && corner.light <= 1;
  });
}

TEST_CASE("every shipped preset has a picture that fits its frame, those that diverge too") {
  for (const auto& file : std::filesystem::directory_iterator(std::string(test::source_dir) + "/app/presets")) {
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

TEST_CASE("a large cloth whose constants are the largest or the smallest allowed has a picture") {
  for (const PresetRow& row : notation()) {
    const auto* field = std::get_if<double Preset::*>(&row.field);
    if (field == nullptr) continue;
    for (const double value : {row.min, row.max}) {
      CAPTURE(row.key);
      CAPTURE(value);
      Preset preset;
      preset.rows = 64, preset.columns = 50;
      preset.** field = value;
      CHECK(sketch_of(preset, go_on).triangles.size() > 8);
    }
  }
}

void finish(SceneSketches& sketches) {
  while (sketches.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_CASE("a picture is there at once, of the start, and is followed by one of the motion made beside the frames") {
  SceneSketches sketches;
  Preset hanging, weight;
  weight.kind = Kind::one_weight;
  const SceneSketch& first = sketches.of(hanging);
  CHECK(first.triangles.size() > 8);
  CHECK(inside(first));
  const glm::vec2 corner = first.corners[first.corners.size() / 2].at;
  CHECK_FALSE(sketches.moved(hanging));
  CHECK(sketches.of(weight).line.size() > 8);
  CHECK(&sketches.of(hanging) == &first);  // one for each preset that differs
  finish(sketches);
  CHECK(sketches.moved(hanging));
  CHECK(sketches.moved(weight));
  CHECK_FALSE(first.corners[first.corners.size() / 2].at == corner);
  CHECK_FALSE(sketches.poll());
}

TEST_CASE("what is looked at is made before what was asked for earlier and is out of sight") {
  SceneSketches sketches;
  std::array<Preset, 4> scenes;
  for (int n = 0; n < 4; ++n) scenes[std::size_t(n)].k_s += n;
  for (const Preset& scene : scenes) sketches.of(scene);
  sketches.poll();  // begins the first
  while (!sketches.moved(scenes[3])) {
    sketches.of(scenes[3]);  // the only one that is still seen
    sketches.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(sketches.moved(scenes[0]));
  CHECK_FALSE(sketches.moved(scenes[1]));
  CHECK_FALSE(sketches.moved(scenes[2]));
  finish(sketches);
  CHECK(sketches.moved(scenes[2]));
}

}  // namespace tyglab::sketch_test
