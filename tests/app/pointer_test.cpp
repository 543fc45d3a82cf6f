// The mouse in the viewport, without a window: what it does to the cloth, and what "unsaved" and the picked particle
// make of it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include "app/session/requests.h"
#include "app/session/session.h"
#include "core/model/preset.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::pointer_test {

constexpr float width = 640, height = 480;

/// A cloth that fills a viewport of its own.
void start(test::Desk& desk, const Preset& preset) {
  desk.session.simulation = std::make_shared<Simulation>(preset);
  desk.session.document.saved = preset;
  desk.scene.viewport.box = {{0, 0}, {width, height}};
  desk.scene.camera = scene_camera(preset, width / height);
}

glm::vec2 pixel_of(test::Desk& desk, Pins::Site site) {
  return *desk.scene.camera.project(desk.session.simulation->positions().at(site.i, site.j),
                                    desk.scene.viewport.size());
}

/// A right click at one place, from `time` to a twentieth of a second after.
void right_click(test::Desk& desk, glm::vec2 at, double time) {
  const auto of_type = [&](PointerEvent::Type type, double t) {
    PointerEvent event{type};
    event.button = GLFW_MOUSE_BUTTON_RIGHT, event.at = at, event.time = t;
    return event;
  };
  desk.tools.now = time + 0.05;
  desk.input.pointer = {of_type(PointerEvent::Type::press, time), of_type(PointerEvent::Type::release, time + 0.05)};
  handle_pointer(desk.tools);
  desk.input.pointer.clear();
}

Preset falling_cloth() {
  Preset preset;
  preset.rows = preset.columns = 9;
  preset.L = 0.1;
  preset.pins.mode = Pins::Mode::none;
  return preset;
}

TEST_CASE("a right double click means the particle of its first press, however far the cloth has gone by the second") {
  test::Desk desk;
  start(desk, falling_cloth());
  const Pins::Site site{4, 4};
  const glm::vec2 at = pixel_of(desk, site);
  right_click(desk, at, 1);
  CHECK(desk.session.picked == site);
  desk.session.simulation->advance(200);
  REQUIRE(glm::length(pixel_of(desk, site) - at) > 30);  // beyond the reach of a press
  right_click(desk, at + glm::vec2(3, -2), 1.2);
  CHECK(desk.session.simulation->pinned(site.i, site.j));
  CHECK(desk.session.picked == site);
}

TEST_CASE("two right clicks that are far apart, or late, pin nothing") {
  for (const auto& [offset, time] : {std::pair{glm::vec2(20, 0), 1.2}, {glm::vec2(0, 0), 2.5}}) {
    test::Desk desk;
    start(desk, falling_cloth());
    const glm::vec2 at = pixel_of(desk, {4, 4});
    right_click(desk, at, 1);
    right_click(desk, at + offset, time);
    for (const int n : {3, 4, 5}) CHECK_FALSE(desk.session.simulation->pinned(4, n));
  }
}

TEST_CASE("a third quick click does not free again what the second pinned") {
  test::Desk desk;
  start(desk, falling_cloth());
  const glm::vec2 at = pixel_of(desk, {4, 4});
  for (const double time : {1.0, 1.2, 1.4}) right_click(desk, at, time);
  CHECK(desk.session.simulation->pinned(4, 4));
}

TEST_CASE("a press is forgotten when the cloth becomes too small to have its particle") {
  for (const bool by_touch : {false, true}) {
    CAPTURE(by_touch);
    test::Desk desk;
    start(desk, falling_cloth());
    desk.input.by_touch = by_touch;
    PointerEvent press{PointerEvent::Type::press};
    press.button = GLFW_MOUSE_BUTTON_RIGHT, press.at = pixel_of(desk, {8, 8}), press.time = desk.tools.now = 1;
    desk.input.pointer = {press};
    handle_pointer(desk.tools);
    REQUIRE(desk.tools.tool.site == Pins::Site{8, 8});
    Preset small = falling_cloth();
    small.rows = small.columns = 3;
    REQUIRE(apply_edit(desk.session, edit::Change{small}));
    desk.input.pointer.clear();
    desk.tools.now = 2;  // long enough to take hold, or to pick
    handle_pointer(desk.tools);
    CHECK_FALSE(desk.tools.tool.site.has_value());
    CHECK_FALSE(desk.session.picked.has_value());
    CHECK_FALSE(desk.session.simulation->held().has_value());
  }
}

TEST_CASE("pinning a particle is unsaved, freeing it again is as it was saved") {
  test::Desk desk;
  Preset preset = falling_cloth();
  preset.pins.mode = Pins::Mode::top_corners;
  start(desk, preset);
  REQUIRE(apply_edit(desk.session, edit::Pin{4, 4, true}));
  CHECK(unsaved(desk.session));
  REQUIRE(apply_edit(desk.session, edit::Pin{4, 4, false}));
  CHECK_FALSE(unsaved(desk.session));
  CHECK(desk.session.preset().pins.mode == Pins::Mode::top_corners);
  REQUIRE(apply_edit(desk.session, edit::Pin{0, 0, false}));
  CHECK(unsaved(desk.session));
  REQUIRE(apply_edit(desk.session, edit::Pin{0, 0, true}));
  preset = desk.session.preset();
  preset.k_s = 51;
  REQUIRE(apply_edit(desk.session, edit::Change{preset}));
  CHECK(unsaved(desk.session));
}

TEST_CASE("the picked particle stays at its place of the cloth when the resolution changes") {
  test::Desk desk;
  start(desk, falling_cloth());
  desk.session.picked = Pins::Site{4, 6};
  const glm::dvec3 before = desk.session.simulation->positions().at(4, 6);
  REQUIRE(apply_edit(desk.session, edit::Change{with_resolution(desk.session.preset(), 2)}));
  CHECK(desk.session.picked == Pins::Site{8, 12});
  const glm::dvec3 fine = desk.session.simulation->positions().at(8, 12);
  for (int k = 0; k < 3; ++k) CHECK(fine[k] == doctest::Approx(before[k]).epsilon(1e-5));
  REQUIRE(apply_edit(desk.session, edit::Change{with_resolution(desk.session.preset(), 0.25)}));
  CHECK(desk.session.picked == Pins::Site{2, 3});
  // Rows alone are literal: a larger cloth, in which the particle keeps its number.
  Preset taller = desk.session.preset();
  taller.rows = 40;
  REQUIRE(apply_edit(desk.session, edit::Change{taller}));
  CHECK(desk.session.picked == Pins::Site{2, 3});
}

TEST_CASE("constants that change after a divergence are told apart from those that diverged") {
  test::Desk desk;
  Preset preset = falling_cloth();
  preset.k_s = 1e6;
  start(desk, preset);
  desk.session.simulation->apply(edit::Grab{8, 8});
  desk.session.simulation->apply(edit::MoveHand{{0, 5, 3}, 50});
  desk.session.simulation->advance(5000);
  REQUIRE(desk.session.simulation->divergence().has_value());
  CHECK_FALSE(changed_since_divergence(desk.session));
  CHECK(desk.session.simulation->diverged_preset().k_s == 1e6);
  Preset view = desk.session.preset();
  view.mode = 3;
  view.precision = Precision::double_;  // built anew
  REQUIRE(apply_edit(desk.session, edit::Change{view}));
  CHECK_FALSE(changed_since_divergence(desk.session));
  CHECK(desk.session.simulation->rebuilt(edit::Change{view})->diverged_preset().k_s == 1e6);
  view.k_s = 10;
  REQUIRE(apply_edit(desk.session, edit::Change{view}));
  CHECK(desk.session.simulation->divergence().has_value());
  CHECK(changed_since_divergence(desk.session));
  CHECK(desk.session.simulation->diverged_preset().k_s == 1e6);
  desk.session.simulation->apply(edit::Restart{});
  CHECK_FALSE(changed_since_divergence(desk.session));
}

}  // namespace tyglab::pointer_test
