// The camera, and what is under the pointer.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "app/render/camera.h"
#include "app/render/picking.h"
#include "core/io/preset_io.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace tyglab::camera_test {

constexpr glm::vec2 size(800, 600);

TEST_CASE("project is what the matrices draw, and unproject its inverse") {
  Camera camera;
  camera.target = {0.3f, 0.8f, -0.2f};
  test::Random random(1);
  for (int n = 0; n < 200; ++n) {
    camera.orbit(float(random.uniform(-300, 300)), float(random.uniform(-100, 100)));
    const glm::dvec3 x(random.uniform(-0.5, 0.5), random.uniform(0, 1), random.uniform(-0.5, 0.5));
    const auto pixel = camera.project(x, size);
    REQUIRE(pixel.has_value());
    const glm::vec4 clip = camera.projection(size.x / size.y) * camera.view() * glm::vec4(glm::vec3(x), 1);
    CHECK(pixel->x == doctest::Approx((clip.x / clip.w + 1) / 2 * size.x).epsilon(1e-3));
    CHECK(pixel->y == doctest::Approx((1 - clip.y / clip.w) / 2 * size.y).epsilon(1e-3));
    CHECK(glm::length(camera.unproject_in_camera_plane(*pixel, x, size) - x) < 1e-4);
    const glm::dvec3 to = glm::normalize(x - glm::dvec3(camera.eye()));
    CHECK(glm::length(camera.ray(*pixel, size) - to) < 1e-4);
  }
  CHECK_FALSE(camera.project(glm::dvec3(camera.eye() - camera.forward()), size).has_value());
}

TEST_CASE("frame brings a box into view, whatever its shape") {
  for (const glm::vec3 half : {glm::vec3(1, 1, 1), glm::vec3(3, 0.1f, 0.1f), glm::vec3(0.01f, 5, 0), glm::vec3(0)}) {
    Camera camera;
    camera.frame(glm::vec3(1, 2, 3) - half, glm::vec3(1, 2, 3) + half, size.x / size.y);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at(1 + (corner & 1 ? 1 : -1) * half.x, 2 + (corner & 2 ? 1 : -1) * half.y,
                          3 + (corner & 4 ? 1 : -1) * half.z);
      const auto pixel = camera.project(at, size);
      REQUIRE(pixel.has_value());
      CHECK((pixel->x >= 0 && pixel->x <= size.x && pixel->y >= 0 && pixel->y <= size.y));
    }
  }
}

TEST_CASE("framing leaves free what is covered along the upper edge, and centers in what is left") {
  for (const float covered : {0.2f, 0.46f}) {
    CAPTURE(covered);
    constexpr float part = 0.9f, roomy_part = 0.7f;
    const float half = (1 - covered) * size.y / 2, middle = covered * size.y + half;
    const std::vector<glm::vec3> points{{-0.2f, 0, 0.3f}, {0.2f, 0, -0.3f}, {0, 1, 0.1f}, {0.1f, 0.9f, -0.2f}};
    const auto reach = [&](const Camera& camera) {
      glm::vec2 ends(1e9f, -1e9f);
      for (const glm::vec3& point : points) {
        const auto pixel = camera.project(glm::dvec3(point), size);
        REQUIRE(pixel.has_value());
        ends = {std::min(ends.x, pixel->y), std::max(ends.y, pixel->y)};
      }
      return ends;
    };
    Camera camera;
    camera.frame(points, size.x / size.y, glm::vec2(part), covered);
    const glm::vec2 framed = reach(camera);
    CHECK(framed.x == doctest::Approx(middle - part * half).epsilon(0.01));
    CHECK(framed.y == doctest::Approx(middle + part * half).epsilon(0.01));
    camera.make_room(points, size.x / size.y, roomy_part, covered);
    const glm::vec2 roomy = reach(camera);
    CHECK(roomy.x >= middle - roomy_part * half - 1);
    CHECK(roomy.y <= middle + roomy_part * half + 1);
    // No further back than it must.
    CHECK(std::max(middle - roomy.x, roomy.y - middle) == doctest::Approx(roomy_part * half).epsilon(0.01));
  }
}

TEST_CASE("framing leaves free what is covered along both edges") {
  const std::vector<glm::vec3> points{{-0.2f, 0, 0.3f}, {0.2f, 0, -0.3f}, {0, 1, 0.1f}};
  Camera camera;
  constexpr float above = 0.3f, below = 0.15f;
  camera.frame(points, size.x / size.y, glm::vec2(1), above, below);
  camera.make_room(points, size.x / size.y, 1, above, below);
  glm::vec2 ends(1e9f, -1e9f);
  for (const glm::vec3& point : points) {
    const auto pixel = camera.project(glm::dvec3(point), size);
    REQUIRE(pixel.has_value());
    ends = {std::min(ends.x, pixel->y), std::max(ends.y, pixel->y)};
  }
  CHECK(ends.x == doctest::Approx(above * size.y).epsilon(0.01));
  CHECK(ends.y == doctest::Approx((1 - below) * size.y).epsilon(0.01));
}

TEST_CASE(
    "a cloth that has gone somewhere else is framed there; one that is where it should be keeps the scene's view") {
  const Preset preset = test::cloth(12, 12);
  const float aspect = size.x / size.y;
  const Camera first = scene_camera(preset, aspect);
  CHECK(present_camera(preset, {}, aspect) == first);
  CHECK(present_camera(preset, bounds(Simulation(preset).positions()), aspect) == first);
  const glm::vec3 side(float(11 * preset.L));
  for (const glm::vec3 at : {glm::vec3(0, -30, 0), glm::vec3(4, 1, -2), glm::vec3(0, 0.4f, 90)}) {
    CAPTURE(at.y);
    for (const glm::vec3 shape : {glm::vec3(1), glm::vec3(1, 0.02f, 1), glm::vec3(0.3f, 0.1f, 0.3f)}) {
      const Bounds box{at - side * shape / 2.f, at + side * shape / 2.f};
      const auto before = part_of_picture(first, box, aspect);
      CHECK((!before || before->in_sight() == 0));
      const auto part = part_of_picture(present_camera(preset, box, aspect), box, aspect);
      REQUIRE(part.has_value());
      CHECK(part->in_sight() == 1);
      CHECK(std::min({part->lo.x, part->lo.y, 1 - part->hi.x, 1 - part->hi.y}) > 0.05f);
      CHECK(std::max(part->hi.x - part->lo.x, part->hi.y - part->lo.y) > 0.6f);
    }
  }
  // Small, in a corner of the scene's view: seen, but not well.
  const Bounds heap{glm::vec3(0.1f, 0.6f, 0), glm::vec3(0.15f, 0.62f, 0.05f)};
  CHECK_FALSE(present_camera(preset, heap, aspect) == first);
  CHECK(part_of_picture(first, {glm::vec3(-1000), glm::vec3(1000)}, aspect)->in_sight() == 1);
  CHECK_FALSE(part_of_picture(
      first, {first.eye() - 20.f * first.forward() - 1.f, first.eye() - 20.f * first.forward() + 1.f}, aspect));
}

TEST_CASE("panning keeps the point under the pointer there") {
  Camera camera;
  const glm::vec2 from(300, 200), drag(57, -33);
  const glm::dvec3 point = camera.unproject_in_camera_plane(from, glm::dvec3(camera.target), size);
  camera.pan(drag.x, drag.y, size.y);
  const auto pixel = camera.project(point, size);
  REQUIRE(pixel.has_value());
  CHECK(glm::length(*pixel - (from + drag)) < 0.1f);
}

TEST_CASE("the camera never turns over and never reaches its target") {
  Camera camera;
  camera.orbit(0, 1e6f);
  CHECK(camera.pitch < 1.5f);
  camera.orbit(0, -1e6f);
  CHECK(camera.pitch > -1.5f);
  camera.zoom(1e6f);
  CHECK(camera.distance > 0);
  camera.zoom(-1e6f);
  CHECK(std::isfinite(camera.distance));
}

TEST_CASE("the particle under the pointer is found, within reach, and not behind another's back") {
  const Preset preset = test::cloth(9, 7);
  Simulation simulation(preset);
  const Camera camera = scene_camera(preset, size.x / size.y);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 7; ++j) {
      const auto pixel = camera.project(simulation.positions().at(i, j), size);
      REQUIRE(pixel.has_value());
      const auto hit = nearest_particle(simulation.positions(), camera, *pixel + glm::vec2(2, 1), size, 15);
      REQUIRE(hit.has_value());
      CHECK((hit->i == i && hit->j == j));
    }
  }
  CHECK_FALSE(nearest_particle(simulation.positions(), camera, {1, 1}, size, 5).has_value());
  const auto corner = camera.project(simulation.positions().at(0, 0), size);
  const auto skipping = nearest_particle(simulation.positions(), camera, *corner, size, 1000,
                                         [&](int i, int j) { return simulation.pinned(i, j); });
  REQUIRE(skipping.has_value());
  CHECK_FALSE(simulation.pinned(skipping->i, skipping->j));
}

TEST_CASE("a cut takes every particle near the pointer's path, however fast it moved") {
  const Preset preset = test::cloth(9, 7);
  Simulation simulation(preset);
  const Camera camera = scene_camera(preset, size.x / size.y);
  const glm::vec2 from = *camera.project(simulation.positions().at(4, 0), size);
  const glm::vec2 to = *camera.project(simulation.positions().at(4, 6), size);
  const auto sites = particles_near_path(simulation.positions(), camera, from, to, size, 15);
  for (int j = 0; j < 7; ++j) CHECK(std::count(sites.begin(), sites.end(), Pins::Site{4, j}) == 1);
  const auto standing = particles_near_path(simulation.positions(), camera, from, from, size, 15);
  REQUIRE(standing.size() == 1);
  CHECK(standing[0] == Pins::Site{4, 0});
}

TEST_CASE("the sphere in front is the one under the pointer") {
  Camera camera;
  camera.yaw = camera.pitch = 0;  // looks along -z
  std::vector<Body> bodies(3);
  bodies[0].c = {0, 0, -1};
  bodies[1].c = {0, 0, 0};
  bodies[2].shape = Body::Shape::plane;
  CHECK(body_under(bodies, camera, size / 2.0f, size) == 1);
  CHECK_FALSE(body_under(bodies, camera, {1, 1}, size).has_value());
}

TEST_CASE("a shipped scene's start fills the picture without leaving it") {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(test::source_dir) + "/app/presets")) {
    CAPTURE(entry.path().string());
    const Preset preset = load_preset(entry.path());
    if (preset.kind == Kind::one_weight) continue;
    const Camera camera = scene_camera(preset, size.x / size.y);
    Simulation simulation(preset);
    glm::vec2 lo(1e9f), hi(-1e9f);
    for (const int i : {0, preset.rows - 1}) {
      for (const int j : {0, preset.columns - 1}) {
        const auto pixel = camera.project(simulation.positions().at(i, j), size);
        REQUIRE(pixel.has_value());
        lo = glm::min(lo, *pixel), hi = glm::max(hi, *pixel);
      }
    }
    CHECK((lo.x >= 0 && lo.y >= 0 && hi.x <= size.x && hi.y <= size.y));
    CHECK(std::max((hi.x - lo.x) / size.x, (hi.y - lo.y) / size.y) > 0.5f);
  }
}

TEST_CASE("cloth that a spinning body carries round stays in the picture, on a phone too") {
  Preset preset = load_preset(std::string(test::source_dir) + "/app/presets/turntable.json");
  Simulation simulation(preset);
  for (int moment = 0; moment < 30; ++moment) {
    simulation.advance(100);
    for (const glm::vec2 window : {size, glm::vec2(390, 720)}) {
      const Camera camera = scene_camera(preset, window.x / window.y);
      for (const int i : {0, preset.rows - 1}) {
        for (const int j : {0, preset.columns - 1}) {
          const auto pixel = camera.project(simulation.position(i, j), window);
          REQUIRE(pixel.has_value());
          CHECK((pixel->x >= 0 && pixel->y >= 0 && pixel->x <= window.x && pixel->y <= window.y));
        }
      }
    }
  }
}

TEST_CASE("points are framed as near as can be, in the middle") {
  Camera camera;
  const std::vector<glm::vec3> points{{-1, 0, 0}, {1, 0, 0.5f}, {0.2f, 0.7f, -0.3f}};
  camera.frame(points, size.x / size.y, {0.9f, 0.8f});
  glm::vec2 lo(1e9f), hi(-1e9f);
  for (const glm::vec3& point : points) {
    const glm::vec2 pixel = *camera.project(glm::dvec3(point), size);
    lo = glm::min(lo, pixel), hi = glm::max(hi, pixel);
  }
  const glm::vec2 part = (hi - lo) / size, middle = (lo + hi) / 2.0f;
  CHECK((std::abs(part.x - 0.9f) < 1e-3f || std::abs(part.y - 0.8f) < 1e-3f));
  CHECK((part.x < 0.901f && part.y < 0.801f));
  CHECK(glm::length(middle - size / 2.0f) < 1);
}

TEST_CASE("a scene's camera shows all of it, and finite particles alone make its bounds") {
  for (const Preset& preset : {Preset{}, test::cloth(2, 1), test::one_weight()}) {
    const Camera camera = scene_camera(preset, size.x / size.y);
    Simulation simulation(preset);
    const PositionView x = simulation.positions();
    for (int i = 0; i < x.rows; ++i) {
      for (int j = 0; j < x.columns; ++j) {
        const auto pixel = camera.project(x.at(i, j), size);
        REQUIRE(pixel.has_value());
        CHECK((pixel->x > 0 && pixel->x < size.x && pixel->y > 0 && pixel->y < size.y));
      }
    }
  }
  const float numbers[] = {1, NAN, -2};
  PositionView view{1, 3, 3};
  for (auto& component : view.f) component = numbers;
  CHECK(bounds(view).lo == glm::vec3(-2));
  CHECK(bounds(view).hi == glm::vec3(1));
}

}  // namespace tyglab::camera_test
