// The mouse on the cloth, and what colors it: grabbed, cut, picked, pinned; bodies and wind dragged; the camera turned;
// the legend.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <vector>

#include "app/base/glfw_keys.h"
#include "app/tools/tools.h"
#include "tests/ui/null_ui.h"

namespace tyglab::cloth_ui_test {

constexpr int middle_button = GLFW_MOUSE_BUTTON_MIDDLE, right = GLFW_MOUSE_BUTTON_RIGHT;

void fall(test::NullUi& window, double t) {
  window.until([&] { return window.t() > t; }, "the cloth to move");
}

Pins::Site corner(test::NullUi& window) {
  const Lattice& lattice = window.cloth().lattice();
  return {lattice.rows - 1, lattice.columns - 1};
}

/// A particle by its part of the rows and columns.
glm::vec2 at(test::NullUi& window, double row, double column) {
  const Lattice& lattice = window.cloth().lattice();
  return window.pixel_of(int(row * (lattice.rows - 1)), int(column * (lattice.columns - 1)));
}

glm::vec2 pixel(test::NullUi& window, const glm::dvec3& x) {
  return *window.scene.camera.project(x, window.ui.viewport.size()) + window.ui.viewport.box.lo;
}

int pinned(test::NullUi& window) {
  int count = 0;
  const Lattice& lattice = window.cloth().lattice();
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) count += window.cloth().pinned(i, j);
  return count;
}

std::optional<std::string> color(test::NullUi& window) {
  const FieldColors* shown = shown_colors(window.scene);
  return shown != nullptr ? std::optional<std::string>(info(shown->field).name) : std::nullopt;
}

/// Lets the cloth fall a little and stops it, with the pointer over a corner: which, and where in the window.
std::pair<Pins::Site, glm::vec2> point_at_corner(test::NullUi& window) {
  fall(window, 0.5);
  window.pause();
  const Pins::Site site = corner(window);
  const glm::vec2 from = window.pixel_of(site.i, site.j);
  window.move(from);
  return {site, from};
}

TEST_CASE("a particle grabbed with the right button follows the pointer, and is let go with it") {
  test::NullUi window;
  const auto [site, from] = point_at_corner(window);
  window.press(right);
  window.move(from + glm::vec2(12, -8));
  window.frames(2);
  REQUIRE(window.cloth().held().has_value());
  CHECK(window.cloth().held() == site);
  window.key(GLFW_KEY_SPACE);
  for (const glm::vec2 by : {glm::vec2(60, -60), {-40, -120}, {-80, -30}}) {
    window.move(from + by);
    window.until([&] { return glm::distance(window.pixel_of(site.i, site.j), from + by) < 3; },
                 "the particle to come to the pointer");
    CHECK(window.cloth().held().has_value());
  }
  CHECK(window.torn() == 0);
  window.release(right);
  CHECK_FALSE(window.cloth().held().has_value());
  const glm::dvec3 there = window.cloth().position(site.i, site.j);
  fall(window, window.t() + 0.3);
  CHECK(window.cloth().position(site.i, site.j) != there);
}

TEST_CASE("the hand lets go by itself when its force exceeds F_release") {
  test::NullUi window({.with = [](Preset& preset) { preset.F_release = 5; }});
  fall(window, 0.5);
  window.pause();
  const glm::vec2 from = at(window, 0.5, 0.5);
  window.move(from);
  window.press(right);
  window.move(from + glm::vec2(10, 0));
  window.frames(2);
  REQUIRE(window.cloth().held().has_value());
  window.key(GLFW_KEY_SPACE);
  fall(window, window.t() + 0.2);
  CHECK(window.cloth().held().has_value());  // a hand that rests feels less than F_release
  window.move(from + glm::vec2(150, 150));
  window.until([&] { return !window.cloth().held().has_value(); }, "the hand to let go");
  window.frames(2);
  CHECK(window.said("F_release"));
  window.release(right);
}

TEST_CASE("a cut with the left button removes springs, while the cloth moves and while it is paused") {
  test::NullUi window;
  fall(window, 0.5);
  REQUIRE(window.torn() == 0);
  const glm::vec2 a = at(window, 0.5, 0.5), b = at(window, 0.5, 1);
  window.drag({a, (a + b) / 2.f, b});
  CHECK(window.torn() > 10);
  CHECK(window.tools.tool.kind == Tool::Kind::none);
  window.pause();
  const int torn = window.torn();
  const std::int64_t steps = window.steps();
  window.drag({at(window, 0.25, 0), at(window, 0.25, 0.25)});
  CHECK(window.torn() > torn + 3);
  CHECK(window.steps() == steps);  // a cut makes no step
  window.key(GLFW_KEY_BACKSPACE);
  CHECK(window.torn() == 0);
  CHECK(window.steps() == 0);
}

TEST_CASE("the first cut of all says beside the pointer how to pull and how to take it back, and no other does") {
  test::NullUi window({.settings = [](Settings& settings) { settings.cut_told = false; }});
  fall(window, 0.5);
  window.drag({at(window, 0.5, 0.5), at(window, 0.5, 0.6)});
  REQUIRE(window.torn() > 0);
  CHECK(window.drew("Right drag pulls. Ctrl+Z undoes the cut."));
  CHECK(window.settings.cut_told);
  SUBCASE("until it is taken back") {
    window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    window.frames(2);
    REQUIRE(window.torn() == 0);
    CHECK_FALSE(window.drew("Right drag pulls"));
    return;
  }
  window.frames(60 * 9);
  CHECK_FALSE(window.drew("Right drag pulls"));
  window.drag({at(window, 0.3, 0.5), at(window, 0.3, 0.6)});
  CHECK_FALSE(window.drew("Right drag pulls"));
}

/// How much of the n-th picture's cloth is in it, 0 to 1.
float in_sight(test::NullUi& window, int tile = 0) {
  const glm::vec2 size = window.ui.viewport.size();
  const auto part =
      part_of_picture(window.scene.camera, bounds(cloth_in_tile(window.scene, tile).positions()), size.x / size.y);
  return part ? part->in_sight() : 0;
}

TEST_CASE(
    "an arrow at the edge says where a fallen cloth is and frames it, as F does; a restart comes back to its start") {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(900, 600)}) {
    CAPTURE(size.x);
    test::NullUi window({.with = [](Preset& preset) { preset.pins.mode = Pins::Mode::none; }, .size = size});
    window.frames(3);
    CHECK_FALSE(window.sees("viewport.way_to_cloth"));
    const Camera first = window.scene.camera;
    fall(window, 1.2);
    window.pause();
    window.rest();
    window.frames(3);
    REQUIRE(in_sight(window) == 0);
    const auto arrow = window.control("viewport.way_to_cloth");
    const Viewport::Box& view = window.ui.viewport.box;
    CHECK(arrow.lo.y > (view.lo.y + view.hi.y) / 2);  // below
    CHECK(view.contains(arrow.lo));
    CHECK(view.contains(arrow.hi));
    window.click("viewport.way_to_cloth");
    window.frames(3);
    CHECK(in_sight(window) == 1);
    CHECK_FALSE(window.sees("viewport.way_to_cloth"));
    CHECK(window.torn() == 0);
    window.resize(size - 60);  // the cloth stays framed
    window.frames(3);
    CHECK(in_sight(window) == 1);
    window.resize(size);
    window.key(GLFW_KEY_R);
    window.frames(3);
    CHECK(in_sight(window) > 0.9f);
    CHECK(window.scene.camera == first);
    window.key(GLFW_KEY_SPACE);
    fall(window, 1.2);
    window.pause();
    window.key(GLFW_KEY_F);
    window.frames(1);
    CHECK(in_sight(window) == 1);
  }
}

TEST_CASE("a restart keeps a camera that was turned by hand and sees the cloth") {
  test::NullUi window;
  fall(window, 0.3);
  const glm::vec2 from = (window.ui.viewport.box.lo + window.ui.viewport.box.hi) / 2.f;
  window.move(from);
  for (int n = 0; n < 6; ++n) window.wheel(1);
  window.drag({from, from + glm::vec2(40, 10), from + glm::vec2(80, 20)}, middle_button);
  const Camera by_hand = window.scene.camera;
  window.key(GLFW_KEY_R);
  window.frames(3);
  CHECK(window.scene.camera == by_hand);
  window.input.mods = GLFW_MOD_SHIFT;  // pans away
  for (int n = 0; n < 12; ++n) window.drag({from, from + glm::vec2(150, 0), from + glm::vec2(300, 0)}, middle_button);
  window.input.mods = 0;
  fall(window, 0.3);
  CHECK(window.sees("viewport.way_to_cloth"));
  window.key(GLFW_KEY_R);
  window.frames(3);
  CHECK(in_sight(window) > 0.9f);
}

TEST_CASE("a body that is added is in view, and its constants in sight; a plane is not slippery") {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1280, 500)}) {
    CAPTURE(size.y);
    test::NullUi window({.size = size});
    fall(window, 0.6);
    window.pause();
    window.scroll_to("constants.Add_sphere", "constants.k_s.slider");
    window.click("constants.Add_sphere");
    window.rest();
    window.frames(6);
    REQUIRE(window.preset().bodies.size() == 1);
    const Body sphere = window.preset().bodies[0];
    const glm::vec2 view = window.ui.viewport.size();
    const auto part = part_of_picture(window.scene.camera,
                                      {glm::vec3(sphere.c) - float(sphere.r), glm::vec3(sphere.c) + float(sphere.r)},
                                      view.x / view.y);
    REQUIRE(part.has_value());
    CHECK(part->in_sight() == 1);
    for (const char* key : {"c.x", "r.slider", "friction.slider", "restitution.slider"})
      CHECK(window.sees(std::string("constants.bodies[0].") + key));
    const Bounds cloth = bounds(window.cloth().positions());
    CHECK(sphere.c.y + sphere.r < cloth.lo.y);  // it starts no contact
    CHECK(sphere.friction == 0.5);
    for (const double value : {sphere.c.x, sphere.c.y, sphere.c.z, sphere.r})
      CHECK(value == std::round(100 * value) / 100);
    CHECK(window.drew("Sphere"));
    CHECK_FALSE(window.drew("Sphere 1"));
    window.click("constants.Add_plane");
    window.frames(6);
    REQUIRE(window.preset().bodies.size() == 2);
    const Body& plane = window.preset().bodies[1];
    CHECK(plane.friction == 0.5);
    CHECK(plane.y < sphere.c.y - sphere.r);
    CHECK(plane.y == std::round(100 * plane.y) / 100);
    CHECK(window.drew("Plane"));
    CHECK_FALSE(window.drew("Plane 2"));
    CHECK(window.sees("constants.bodies[1].y.slider"));
    CHECK(window.sees("constants.bodies[1].restitution.slider"));
    const glm::vec2 at = pixel(window, {0, plane.y, 0});
    CHECK(window.ui.viewport.box.contains(at));
    CHECK(window.preset().contact == "local");
    window.scroll_to("constants.contact.2", "constants.bodies[1].y.slider");
    window.click("constants.contact.2");
    window.frames(2);
    CHECK(window.preset().contact == "step");
    window.ui.command("undo");
    window.frames(2);
    CHECK(window.preset().contact == "local");
  }
  // Over a cloth that lies on a plane.
  test::NullUi window({.with = [](Preset& preset) {
    preset.pins.mode = Pins::Mode::none, preset.tilt_deg = 0;
    preset.bodies.resize(1);
    preset.bodies[0].shape = Body::Shape::plane;
    preset.bodies[0].y = 0.5;
  }});
  fall(window, 1);
  window.pause();
  window.scroll_to("constants.Add_sphere", "constants.k_s.slider");
  window.click("constants.Add_sphere");
  window.frames(6);
  REQUIRE(window.preset().bodies.size() == 2);
  CHECK(window.preset().bodies[1].c.y - window.preset().bodies[1].r > 0.5);
  window.click("constants.Add_sphere");
  window.frames(6);
  CHECK(window.drew("Sphere 2"));
}

TEST_CASE("every picture of several shows its cloth once they are framed, above its name") {
  test::NullUi window({.with = [](Preset& preset) { preset.pins.mode = Pins::Mode::none; }});
  fall(window, 0.2);
  window.click("plots.Copies");
  window.add_copy("dt_2_5e_4_s");
  window.frames(2);
  REQUIRE(window.session.copies.tiles() == 2);
  fall(window, 1.5);
  window.pause();
  window.frames(2);
  CHECK(window.sees("viewport.way_to_cloth"));
  CHECK(window.sees("viewport.way_to_cloth1"));
  window.key(GLFW_KEY_F);
  window.frames(2);
  for (int tile = 0; tile < 2; ++tile) {
    CHECK(in_sight(window, tile) == 1);
    const auto* name = window.ui.placing.find("name " + std::to_string(tile));
    REQUIRE(name != nullptr);
    const Lattice& lattice = window.cloth().lattice();
    for (const int i : {0, lattice.rows - 1})
      for (const int j : {0, lattice.columns - 1}) {
        const glm::dvec3 x = cloth_in_tile(window.scene, tile).position(i, j);
        CHECK(window.scene.camera.project(x, window.ui.viewport.size())->y + window.ui.viewport.origin(tile).y <
              name->lo.y);
      }
  }
}

TEST_CASE("the wind's arrow has its tip in the picture, whatever the wind and the picture's size, and is taken there") {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(900, 600), glm::ivec2(600, 400)}) {
    test::NullUi window({.preset = "flag", .size = size});
    window.frames(3);
    const double strength = glm::length(window.preset().W);
    for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(1, -1, 1),
                                 glm::dvec3(0.3, -0.1, 1), glm::dvec3(-1, 1, -1)})
      for (const double times : {1.0, 1.7, 30.0}) {
        Preset next = window.preset();
        next.W = times * strength * glm::normalize(way);
        window.session.propose(next);
        window.frames(2);
        CAPTURE(size.x);
        CAPTURE(way.x);
        CAPTURE(way.y);
        CAPTURE(way.z);
        CAPTURE(times);
        const glm::vec2 view = window.ui.viewport.size();
        const auto tip = window.scene.camera.project(wind_arrow(window.tools, next.W).tip, view);
        REQUIRE(tip.has_value());
        CHECK(std::min({tip->x, tip->y, view.x - tip->x, view.y - tip->y}) > 14);
        CHECK(on_wind_tip(window.tools, *tip));
      }
  }
}

TEST_CASE("the wind's arrow is dragged by its tip, and one undo takes it back; W shows and hides it") {
  test::NullUi window({.preset = "flag"});
  fall(window, 0.5);
  window.frames(3);
  const glm::dvec3 before = window.preset().W;
  const auto tip = [&] { return pixel(window, wind_arrow(window.tools, window.preset().W).tip); };
  const glm::vec2 from = tip(), to = from + glm::vec2(8, -60);
  window.drag({from, from + glm::vec2(4, -20), to});
  CHECK(window.preset().W.y > 0.001);
  CHECK(window.torn() == 0);
  CHECK(window.tools.tool.kind == Tool::Kind::none);
  CHECK(glm::distance(tip(), to) < 4);
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  CHECK(window.preset().W == before);
  window.key(GLFW_KEY_W);
  CHECK_FALSE(wind_arrow_shown(window.tools));
  window.key(GLFW_KEY_W);
  CHECK(wind_arrow_shown(window.tools));
}

TEST_CASE("with slow motion in the hand time goes at a quarter while a particle is held") {
  test::NullUi window;
  window.key(GLFW_KEY_H);
  CHECK(window.settings.handling.slow_hand);
  CHECK(window.session.pacing.aim() == 1);
  const glm::vec2 from = at(window, 0.5, 0.5);
  window.move(from);
  window.press(right);
  window.move(from + glm::vec2(20, 0));
  window.frames(2);
  CHECK(window.cloth().held().has_value());
  CHECK(window.session.pacing.aim() == 0.25);
  CHECK(window.session.pacing.speed == 1);
  window.release(right);
  CHECK(window.session.pacing.aim() == 1);
}

TEST_CASE("a press on a button over the cloth is the button's: nothing is cut") {
  test::NullUi window;
  for (const int mode : {4, 2, 1}) {
    window.click("viewport.views." + std::to_string(mode));
    CHECK(window.preset().mode == mode);
  }
  CHECK(window.torn() == 0);
}

TEST_CASE("with Shift the left button grabs, as touchpads without a right drag need it") {
  test::NullUi window;
  const auto [site, from] = point_at_corner(window);
  window.input.mods = GLFW_MOD_SHIFT;
  window.press();
  window.input.mods = 0;
  window.move(from + glm::vec2(12, -8));
  window.frames(2);
  CHECK(window.cloth().held() == site);
  window.release();
  window.frames(2);
  CHECK_FALSE(window.cloth().held().has_value());
  CHECK(window.torn() == 0);
}

TEST_CASE("a right click picks a particle, a right double-click pins it and another frees it") {
  test::NullUi window;
  window.pause();
  const int pins = pinned(window);
  const std::int64_t steps = window.steps();
  const Pins::Site site = corner(window);
  CHECK_FALSE(window.session.picked == site);
  const glm::vec2 place = window.pixel_of(site.i, site.j);
  window.click(place, right);
  CHECK(window.session.picked == site);
  for (const int count : {pins + 1, pins}) {
    window.frames(60);
    for (int n = 0; n < 2; ++n) window.press(right), window.release(right);
    window.frames(4);
    CHECK(pinned(window) == count);
    CHECK_FALSE(window.cloth().held().has_value());
  }
  CHECK(window.steps() == steps);
  CHECK(window.torn() == 0);
}

TEST_CASE("a finger held still picks the particle under it, and takes hold of it once it moves") {
  test::NullUi window;
  window.input.by_touch = true;
  const auto [site, from] = point_at_corner(window);
  const int pins = pinned(window);
  window.session.picked.reset();
  window.press(right);
  window.frames(2);
  CHECK_FALSE(window.session.picked.has_value());
  window.frames(60);
  CHECK(window.session.picked == site);
  CHECK_FALSE(window.cloth().held().has_value());
  SUBCASE("it moves") {
    window.move(from + glm::vec2(20, -10));
    window.frames(2);
    CHECK(window.cloth().held() == site);
    window.release(right);
    CHECK_FALSE(window.cloth().held().has_value());
  }
  SUBCASE("it is lifted: the next tap is the first of two, and pins nothing") {
    window.release(right);
    window.press(right), window.release(right);
    window.frames(4);
    CHECK(window.session.picked == site);
    CHECK(pinned(window) == pins);
  }
  SUBCASE("it follows a tap: held, it is no second half of a double tap") {
    window.release(right);
    window.frames(60);
    window.press(right), window.release(right);
    window.press(right);
    window.frames(60);
    window.release(right);
    CHECK(pinned(window) == pins);
  }
}

TEST_CASE("a left press on a body drags the body and never cuts, and it stays where the button was released") {
  test::NullUi window({.preset = "sphere"});
  window.pause();
  window.key(GLFW_KEY_BACKSPACE);
  window.frames(4);
  const glm::dvec3 before = window.preset().bodies[0].c;
  const glm::vec2 from = pixel(window, before);
  window.move(from);
  window.press();
  CHECK(window.tools.tool.kind == Tool::Kind::body);
  window.move(from + glm::vec2(40, 5));
  window.move(from + glm::vec2(90, 10));
  window.frames(2);
  CHECK(glm::distance(pixel(window, window.preset().bodies[0].c), from + glm::vec2(90, 10)) < 3);
  window.key(GLFW_KEY_SPACE);
  fall(window, 0.2);
  window.move(from + glm::vec2(-60, -40));
  window.release();
  CHECK(window.torn() == 0);
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  CHECK(glm::distance(window.preset().bodies[0].c, before) < 1e-12);
}

TEST_CASE("the middle button orbits, with Shift it pans, the wheel zooms, F frames; the cloth stays as it is") {
  test::NullUi window;
  window.pause();
  window.frames(2);
  const std::int64_t steps = window.steps();
  const glm::dvec3 x = window.cloth().position(31, 0);
  const auto corners = [&] {
    return std::vector<glm::vec2>{at(window, 0, 0), at(window, 0, 1), at(window, 1, 0), at(window, 1, 1)};
  };
  const auto width = [&] {
    const auto list = corners();
    const auto [lo, hi] = std::minmax_element(list.begin(), list.end(), [](auto a, auto b) { return a.x < b.x; });
    return hi->x - lo->x;
  };
  const auto start = corners();
  const float wide = width();
  const glm::vec2 from = (window.ui.viewport.box.lo + window.ui.viewport.box.hi) / 2.f;
  window.drag({from, from + glm::vec2(100, 10), from + glm::vec2(300, 20)}, middle_button);
  CHECK(width() < 0.7f * wide);  // seen from the side
  const auto turned = corners();
  window.input.mods = GLFW_MOD_SHIFT;
  window.drag({from, from + glm::vec2(50, 20), from + glm::vec2(100, 40)}, middle_button);
  window.input.mods = 0;
  for (std::size_t n = 0; n < 4; ++n) CHECK(corners()[n].x > turned[n].x + 40);
  window.key(GLFW_KEY_F);
  window.frames(2);
  CHECK(glm::distance(corners()[0], start[0]) < 40);
  const float before = width();
  window.move(from);
  for (int n = 0; n < 3; ++n) window.wheel(1);
  CHECK(width() > 1.2f * before);
  CHECK(window.steps() == steps);
  CHECK(window.torn() == 0);
  CHECK(window.cloth().position(31, 0) == x);
}

TEST_CASE("the list chooses a coloring, the value under the pointer is said, and the scale can be typed") {
  test::NullUi window;
  fall(window, 0.3);
  window.pause();
  window.rest();
  CHECK_FALSE(color(window).has_value());
  window.click("viewport.colour");
  window.click("menu.colour.speed");
  CHECK(color(window) == "speed");
  CHECK_FALSE(shown_colors(window.scene)->fixed.has_value());
  window.move(at(window, 0.5, 0.5));
  window.frames(3);
  CHECK(window.scene.colors.under_pointer.has_value());
  window.rest();
  const glm::vec2 top = window.middle("viewport.colour_top");
  window.double_click(top);
  REQUIRE(window.typing());
  window.type("7");
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  CHECK(shown_colors(window.scene)->fixed.has_value());
  CHECK(shown_colors(window.scene)->top() == 7);
}

TEST_CASE("the end of the scale is dragged in the legend, and a double click lets it follow the values again") {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(560, 400)}) {  // whole, and on a single line
    CAPTURE(size.x);
    test::NullUi window({.size = size, .settings = [](Settings& settings) { settings.color = "speed"; }});
    fall(window, 0.3);
    window.pause();
    window.rest();
    REQUIRE(shown_colors(window.scene) != nullptr);
    const auto bar = window.control("viewport.color_scale");
    const double before = shown_colors(window.scene)->top();
    const glm::vec2 from = (bar.lo + bar.hi) / 2.f;
    window.drag({from, from - glm::vec2(5, 0), from - glm::vec2((bar.hi.x - bar.lo.x) / 4, 0)});
    window.frames(2);
    REQUIRE(shown_colors(window.scene)->fixed.has_value());
    const double dragged = shown_colors(window.scene)->top();
    CHECK(dragged == doctest::Approx(before * std::pow(10, -0.25)).epsilon(0.15));
    CHECK(window.torn() == 0);  // it is no cut
    window.double_click(from);
    window.frames(2);
    CHECK_FALSE(shown_colors(window.scene)->fixed.has_value());
    CHECK(shown_colors(window.scene)->top() == before);
  }
}

TEST_CASE("copies are colored each by its own values on one scale; the distance from the reference needs one") {
  test::NullUi window({.settings = [](Settings& settings) { settings.color = "distance"; }});
  CHECK_FALSE(color(window).has_value());  // without a copy there is nothing to measure from
  window.click("plots.Copies");
  window.add_copy("dt_2_5e_4_s");
  window.frames(2);
  CHECK(color(window) == "distance");
  window.until([&] { return window.t() > 1 && shown_colors(window.scene)->top() < 0.1; },
               "a scale for what they are apart");
}

TEST_CASE("K goes through what can color the cloth, each with a scale, and back to the cloth's own look") {
  test::NullUi window;
  fall(window, 0.3);
  window.pause();
  CHECK_FALSE(color(window).has_value());
  for (const std::string name : {"tension", "strain", "speed", "kinetic"}) {
    window.key(GLFW_KEY_K);
    window.frames(2);
    CHECK(color(window) == name);
    CHECK(shown_colors(window.scene)->top() > 0);
    CHECK(window.settings.color == name);  // remembered
  }
  window.key(GLFW_KEY_K);
  CHECK_FALSE(color(window).has_value());
  CHECK(window.settings.color.empty());
}

TEST_CASE("C makes a cut run along the pointer's path: a slanting stroke parts the springs that it crosses, once") {
  test::NullUi window({.preset = "taut_sheet"});
  window.pause();
  window.key(GLFW_KEY_C);
  CHECK(window.settings.handling.cut_along_path);
  CHECK(window.said("crosses"));
  const glm::vec2 corner = at(window, 0, 0), along = at(window, 0, 1) - corner, down = at(window, 1, 0) - corner;
  const glm::vec2 a = corner + 0.2f * along + 0.3f * down, b = corner + 0.8f * along + 0.8f * down;
  const std::int64_t steps = window.steps();
  window.drag({a, a + 0.25f * (b - a), a + 0.5f * (b - a), a + 0.75f * (b - a), b});
  const int torn = window.torn();
  CHECK(torn > 20);
  CHECK(torn < 400);
  CHECK(window.steps() == steps);  // a cut makes no step
  window.key(GLFW_KEY_SPACE);
  fall(window, 0.2);
  CHECK(window.torn() == torn);  // nothing is cut once the knife is put away
}

TEST_CASE("in gusts the wind that blows follows simulated time, is shown, and leaves W alone") {
  test::NullUi window({.preset = "flag", .with = [](Preset& preset) { preset.gust = 0.6, preset.gust_period = 0.8; }});
  const glm::dvec3 W = window.preset().W;
  std::vector<double> seen;
  for (int n = 1; n < 6; ++n) {
    fall(window, 0.15 * n);
    CHECK(window.preset().W == W);
    seen.push_back(window.cloth().wind().x);
  }
  const auto [lo, hi] = std::minmax_element(seen.begin(), seen.end());
  CHECK(*hi - *lo > 0.1 * W.x);
}

TEST_CASE("a click on a variable in the read-out shows or hides its arrow; a position has none") {
  test::NullUi window;
  fall(window, 0.6);
  window.pause();
  using Names = std::set<std::string>;
  const Names& arrows = window.settings.handling.arrows;
  CHECK(arrows == Names{"F_b", "F_d", "F_g", "F_s"});
  for (const std::string name : {"F", "v", "a"}) window.click("constants." + name);
  window.click("constants.F_s");
  window.click("constants.x");
  CHECK(arrows == Names{"F", "F_b", "F_d", "F_g", "a", "v"});
  window.rest();
  window.frames(60);
  CHECK(window.ui.placing.find("scale m/s²") != nullptr);  // those of v and a have scales of their own
  CHECK(window.ui.placing.find("scale m/s") != nullptr);
}

TEST_CASE("a mat on the ground comes to rest and falls asleep: no more steps; a restart wakes it" *
          doctest::test_suite("slow")) {
  test::NullUi window({.preset = "rubber_mat"});
  window.until([&] { return window.session.asleep(); }, "the cloth to fall asleep");
  const std::int64_t steps = window.steps();
  CHECK(steps > 1000);
  CHECK_FALSE(window.paused());
  CHECK(window.session.idle());
  window.frames(10);
  CHECK(window.steps() == steps);
  window.key(GLFW_KEY_R);
  window.frames(4);
  CHECK_FALSE(window.session.asleep());
  CHECK(window.steps() > 0);
  CHECK(window.steps() < steps);
}

}  // namespace tyglab::cloth_ui_test
