// The mouse in the viewport, without a window: what it does to the cloth, and what "unsaved" and the picked particle
// make of it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include "app/session/requests.h"
#include "app/ui/app.h"
#include "core/model/resolution.h"
#include "tests/support/scenes.h"

namespace tyglab::pointer_test {

constexpr float width = 640, height = 480;

/// A cloth that fills a viewport of its own.
void start(App& app, const Preset& preset) {
  app.simulation = std::make_unique<Simulation>(preset);
  app.document.saved = preset;
  app.viewport.box = {{0, 0}, {width, height}};
  app.camera = scene_camera(preset, width / height);
}

glm::vec2 pixel_of(App& app, Pins::Site site) {
  return *app.camera.project(app.simulation->positions().at(site.i, site.j), app.viewport.size());
}

/// A right click at one place, from `time` to a twentieth of a second after.
void right_click(App& app, glm::vec2 at, double time) {
  const auto of_type = [&](PointerEvent::Type type, double t) {
    PointerEvent event{type};
    event.button = GLFW_MOUSE_BUTTON_RIGHT, event.at = at, event.time = t;
    return event;
  };
  app.ui.now = time + 0.05;
  app.input.pointer = {of_type(PointerEvent::Type::press, time), of_type(PointerEvent::Type::release, time + 0.05)};
  handle_pointer(app);
  app.input.pointer.clear();
}

Preset falling_cloth() {
  Preset preset;
  preset.rows = preset.columns = 9;
  preset.L = 0.1;
  preset.pins.mode = Pins::Mode::none;
  return preset;
}

TEST_CASE("a right double click means the particle of its first press, however far the cloth has gone by the second") {
  App app;
  start(app, falling_cloth());
  const Pins::Site site{4, 4};
  const glm::vec2 at = pixel_of(app, site);
  right_click(app, at, 1);
  CHECK(app.picked == site);
  app.simulation->advance(200);
  REQUIRE(glm::length(pixel_of(app, site) - at) > 30);  // beyond the reach of a press
  right_click(app, at + glm::vec2(3, -2), 1.2);
  CHECK(app.simulation->pinned(site.i, site.j));
  CHECK(app.picked == site);
}

TEST_CASE("two right clicks that are far apart, or late, pin nothing") {
  for (const auto& [offset, time] : {std::pair{glm::vec2(20, 0), 1.2}, {glm::vec2(0, 0), 2.5}}) {
    App app;
    start(app, falling_cloth());
    const glm::vec2 at = pixel_of(app, {4, 4});
    right_click(app, at, 1);
    right_click(app, at + offset, time);
    for (const int n : {3, 4, 5}) CHECK_FALSE(app.simulation->pinned(4, n));
  }
}

TEST_CASE("a third quick click does not free again what the second pinned") {
  App app;
  start(app, falling_cloth());
  const glm::vec2 at = pixel_of(app, {4, 4});
  for (const double time : {1.0, 1.2, 1.4}) right_click(app, at, time);
  CHECK(app.simulation->pinned(4, 4));
}

TEST_CASE("pinning a particle is unsaved, freeing it again is as it was saved") {
  App app;
  Preset preset = falling_cloth();
  preset.pins.mode = Pins::Mode::top_corners;
  start(app, preset);
  REQUIRE(apply_edit(app, edit::Pin{4, 4, true}));
  CHECK(unsaved(app));
  REQUIRE(apply_edit(app, edit::Pin{4, 4, false}));
  CHECK_FALSE(unsaved(app));
  CHECK(app.preset().pins.mode == Pins::Mode::top_corners);
  REQUIRE(apply_edit(app, edit::Pin{0, 0, false}));
  CHECK(unsaved(app));
  REQUIRE(apply_edit(app, edit::Pin{0, 0, true}));
  preset = app.preset();
  preset.k_s = 51;
  REQUIRE(apply_edit(app, edit::Change{preset}));
  CHECK(unsaved(app));
}

TEST_CASE("the picked particle stays at its place of the cloth when the resolution changes") {
  App app;
  start(app, falling_cloth());
  app.picked = Pins::Site{4, 6};
  const glm::dvec3 before = app.simulation->positions().at(4, 6);
  REQUIRE(apply_edit(app, edit::Change{with_resolution(app.preset(), 2)}));
  CHECK(app.picked == Pins::Site{8, 12});
  const glm::dvec3 fine = app.simulation->positions().at(8, 12);
  for (int k = 0; k < 3; ++k) CHECK(fine[k] == doctest::Approx(before[k]).epsilon(1e-5));
  REQUIRE(apply_edit(app, edit::Change{with_resolution(app.preset(), 0.25)}));
  CHECK(app.picked == Pins::Site{2, 3});
  // Rows alone are literal: a larger cloth, in which the particle keeps its number.
  Preset taller = app.preset();
  taller.rows = 40;
  REQUIRE(apply_edit(app, edit::Change{taller}));
  CHECK(app.picked == Pins::Site{2, 3});
}

TEST_CASE("constants that change after a divergence are told apart from those that diverged") {
  App app;
  Preset preset = falling_cloth();
  preset.k_s = 1e6;
  start(app, preset);
  app.simulation->apply(edit::Grab{8, 8});
  app.simulation->apply(edit::MoveHand{{0, 5, 3}, 50});
  app.simulation->advance(5000);
  REQUIRE(app.simulation->divergence().has_value());
  CHECK_FALSE(changed_since_divergence(app));
  CHECK(app.simulation->diverged_preset().k_s == 1e6);
  Preset view = app.preset();
  view.mode = 3;
  view.precision = Precision::double_;  // built anew
  REQUIRE(apply_edit(app, edit::Change{view}));
  CHECK_FALSE(changed_since_divergence(app));
  CHECK(app.simulation->rebuilt(edit::Change{view})->diverged_preset().k_s == 1e6);
  view.k_s = 10;
  REQUIRE(apply_edit(app, edit::Change{view}));
  CHECK(app.simulation->divergence().has_value());
  CHECK(changed_since_divergence(app));
  CHECK(app.simulation->diverged_preset().k_s == 1e6);
  app.simulation->apply(edit::Restart{});
  CHECK_FALSE(changed_since_divergence(app));
}

}  // namespace tyglab::pointer_test
