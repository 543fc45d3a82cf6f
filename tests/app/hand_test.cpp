// The hand's tools without a window: a cut along the pointer's path, the wind's arrow, slow motion.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "app/render/picking.h"
#include "app/tools/tools.h"
#include "app/ui/overlay/overlay.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::hand_test {

constexpr glm::vec2 size{640, 480};

/// A flat upright cloth, seen straight from the front: row i is seen at a height, column j at a breadth.
Preset upright() {
  Preset preset = test::quiet_cloth(9, 9);
  preset.tilt_deg = 90, preset.L = 0.1;
  return preset;
}

Camera from_the_front(const Preset& preset) {
  Camera camera = scene_camera(preset, size.x / size.y);
  camera.yaw = camera.pitch = 0;
  return camera;
}

struct Front {
  explicit Front(Preset preset) : simulation(preset), camera(from_the_front(preset)) {}
  glm::vec2 at(double i, double j) const {
    const glm::dvec3 a = simulation.positions().at(0, 0), b = simulation.positions().at(8, 8);
    return *camera.project({a.x + (b.x - a.x) * j / 8, a.y + (b.y - a.y) * i / 8, a.z}, size);
  }
  std::vector<SpringSite> across(glm::vec2 from, glm::vec2 to) const { return across(std::array{Stroke{from, to}}); }
  std::vector<SpringSite> across(std::span<const Stroke> strokes) const {
    return springs_across(simulation.positions(), simulation.tears(), camera, simulation.preset().bodies, strokes,
                          size);
  }
  Simulation simulation;
  Camera camera;
};

TEST_CASE("a level stroke between two rows meets the springs between them and no other") {
  const Front scene(upright());
  const auto met = scene.across(scene.at(3.5, -1), scene.at(3.5, 9));
  CHECK(met.size() == 9 + 8 + 8);
  for (const SpringSite& spring : met) {
    CHECK(spring.i == 3);
    CHECK(spring.direction != 0);
  }
  // Half as long, half of them.
  for (const SpringSite& spring : scene.across(scene.at(3.5, -1), scene.at(3.5, 4.2))) CHECK(spring.j <= 5);
  CHECK(scene.across(scene.at(3.5, 2), scene.at(3.5, 2)).empty());
  CHECK(scene.across(scene.at(-0.5, -1), scene.at(-0.5, 9)).empty());
}

TEST_CASE("an upright stroke meets the springs between two columns") {
  const Front scene(upright());
  const auto met = scene.across(scene.at(-1, 5.5), scene.at(9, 5.5));
  CHECK(met.size() == 9 + 8 + 8);
  for (const SpringSite& spring : met) CHECK(spring.direction != 1);
}

TEST_CASE("a slanting stroke parts the cloth: nothing whole is left between its two sides") {
  const Front scene(upright());
  const glm::vec2 from = scene.at(-0.7, 1.3), to = scene.at(8.9, 6.1);
  const auto met = scene.across(from, to);
  const auto beyond = [&](int i, int j) {
    const glm::vec2 p = scene.at(i, j) - from, d = to - from;
    return d.x * p.y - d.y * p.x > 0;
  };
  std::size_t between = 0;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k < stretch_directions; ++k) {
        if (!scene.simulation.lattice().has_spring(k, i, j)) continue;
        const bool parted =
            beyond(i, j) != beyond(i + directions[std::size_t(k)].di, j + directions[std::size_t(k)].dj);
        between += parted;
        CHECK((std::find(met.begin(), met.end(), SpringSite{k, i, j}) != met.end()) == parted);
      }
  CHECK(met.size() == between);
}

TEST_CASE("a way made of many short strokes meets what one long one meets, each spring once") {
  const Front scene(upright());
  const auto whole = scene.across(scene.at(2, -1), scene.at(6, 9));  // through particles
  std::vector<SpringSite> pieces;
  for (int n = 0; n < 50; ++n) {
    const auto place = [&](int k) { return glm::mix(scene.at(2, -1), scene.at(6, 9), float(k) / 50); };
    for (const SpringSite& spring : scene.across(place(n), place(n + 1))) pieces.push_back(spring);
  }
  for (const SpringSite& spring : whole) CHECK(std::find(pieces.begin(), pieces.end(), spring) != pieces.end());
  CHECK(pieces.size() < whole.size() + 4);  // rounding of places on one line
}

TEST_CASE("torn springs are not met, nor what a sphere hides; through another layer the stroke goes") {
  Front scene(upright());
  scene.simulation.apply(edit::CutSprings{{{1, 3, 4}}});
  CHECK(scene.across(scene.at(3.5, -1), scene.at(3.5, 9)).size() == 24);
  Preset hidden = upright();
  Body sphere;
  sphere.c = glm::dvec3(scene.simulation.positions().at(4, 4)) + glm::dvec3(0, 0, 0.6), sphere.r = 0.25;
  hidden.bodies.push_back(sphere);
  const Front behind(hidden);
  const auto met = behind.across(behind.at(3.5, -1), behind.at(3.5, 9));
  CHECK(met.size() < 20);
  CHECK(met.size() >= 4);
  for (const SpringSite& spring : met) CHECK((spring.j <= 2 || spring.j >= 5));
  hidden.bodies[0].c.z -= 1.2;  // behind the cloth
  const Front before(hidden);
  CHECK(before.across(before.at(3.5, -1), before.at(3.5, 9)).size() == 25);
  const glm::vec2 from = scene.at(2.5, -1), to = scene.at(2.5, 9);
  State folded = scene.simulation.read();
  for (int i = 5; i < 9; ++i)
    for (int j = 0; j < 9; ++j)  // the lower half is laid behind the upper one
      folded.x.y[std::size_t(9 * i + j)] = folded.x.y[std::size_t(9 * (8 - i) + j)],
                                     folded.x.z[std::size_t(9 * i + j)] -= 0.1;
  test::load(scene.simulation, folded);
  const auto both = scene.across(from, to);
  CHECK(std::any_of(both.begin(), both.end(), [](const SpringSite& s) { return s.i == 2; }));
  CHECK(std::any_of(both.begin(), both.end(), [](const SpringSite& s) { return s.i == 5; }));
}

/// A desk with that scene, whose pointer is moved.
struct Hand : test::Desk {
  explicit Hand(const Preset& preset) : Desk(preset) {
    scene.viewport.box = {{0, 0}, size};
    scene.camera = from_the_front(preset);
  }
  void event(PointerEvent::Type type, glm::vec2 at, int mods = 0) {
    PointerEvent event{type};
    event.button = GLFW_MOUSE_BUTTON_LEFT, event.at = at, event.mods = mods, event.time = tools.now;
    input.at = at, input.mods = mods;
    input.pointer = {event};
    handle_pointer(tools);
    input.pointer.clear();
    act();
  }
  void drag(glm::vec2 from, glm::vec2 to, int mods = 0) {
    event(PointerEvent::Type::press, from, mods);
    event(PointerEvent::Type::move, glm::mix(from, to, 0.5f), mods);
    event(PointerEvent::Type::move, to, mods);
    event(PointerEvent::Type::release, to, mods);
  }
};

TEST_CASE("the same drag cuts upwards, or along its path") {
  const Front scene(upright());
  Hand upwards(upright()), along(upright());
  along.settings.handling.cut_along_path = true;
  for (Hand* desk : {&upwards, &along}) desk->drag(scene.at(-0.8, 3.5), scene.at(8.8, 3.5));
  const Tears &up = upwards.session.simulation->tears(), &path = along.session.simulation->tears();
  CHECK(path.torn_count() == 25);
  for (int i = 0; i < 9; ++i) {
    CHECK_FALSE(path.whole(0, i, 3));  // across the path
    CHECK(path.whole(1, i, 3));        // beside it
    CHECK(up.whole(0, i, 3));
  }
  CHECK_FALSE((up.whole(1, 3, 3) && up.whole(1, 3, 4)));
  CHECK(along.tools.tool.stroke.size() == 4);
  Hand still(upright());
  still.settings.handling.cut_along_path = true;
  still.drag(scene.at(3.5, 4), scene.at(3.5, 4));
  CHECK(still.session.simulation->tears().untorn());
}

glm::vec2 tip(const test::Desk& desk) {
  return *desk.scene.camera.project(wind_arrow(desk.tools, requested_wind(desk.tools)).tip, desk.scene.viewport.size());
}

TEST_CASE("the wind's arrow is shown while there is wind, or as it is asked for") {
  Preset calm = upright(), windy = upright();
  windy.W = {0.004, 0, 0};
  Hand a(calm), b(windy);
  CHECK_FALSE(wind_arrow_shown(a.tools));
  CHECK(wind_arrow_shown(b.tools));
  a.ui.command("toggle_wind_arrow"), b.ui.command("toggle_wind_arrow");
  a.act(), b.act();
  CHECK(wind_arrow_shown(a.tools));
  CHECK_FALSE(wind_arrow_shown(b.tools));
}

TEST_CASE("its tip is dragged in the camera's plane, and one undo takes the drag back") {
  Preset preset = upright();
  preset.W = {0.004, 0, 0.0004};
  Hand desk(preset);
  const glm::vec2 from = tip(desk);
  desk.drag(from, from + glm::vec2(0, -80));
  // 80 pixels are the wind as it was opened; upwards is y.
  CHECK(desk.session.preset().W.x == doctest::Approx(0.004).epsilon(0.02));
  CHECK(desk.session.preset().W.y == doctest::Approx(glm::length(preset.W)).epsilon(0.02));
  CHECK(desk.session.preset().W.z == doctest::Approx(0.0004).epsilon(0.02));
  CHECK(glm::distance(tip(desk), from + glm::vec2(0, -80)) < 3);
  CHECK(desk.tools.tool.kind == Tool::Kind::none);
  CHECK(desk.session.simulation->tears().untorn());
  desk.ui.command("undo");
  desk.act();
  CHECK(desk.session.preset().W == preset.W);
}

TEST_CASE("Shift drags along the view, Ctrl snaps to an axis, and at its foot the wind is calm") {
  Preset preset = upright();
  preset.W = {0.004, 0.001, 0};
  Hand depth(preset);
  glm::vec2 from = tip(depth);
  depth.drag(from, from + glm::vec2(3, -40), GLFW_MOD_SHIFT);
  CHECK(depth.session.preset().W.x == doctest::Approx(0.004));
  CHECK(depth.session.preset().W.z == doctest::Approx(-0.5 * glm::length(preset.W)).epsilon(0.02));
  Hand axis(preset);
  axis.drag(from, from + glm::vec2(-10, 4), GLFW_MOD_CONTROL);
  CHECK(axis.session.preset().W.x > 0);
  CHECK(axis.session.preset().W.y == 0);
  CHECK(axis.session.preset().W.z == 0);
  Hand calm(preset);
  const glm::vec2 foot = *calm.scene.camera.project(wind_arrow(calm.tools, preset.W).base, size);
  calm.drag(from, foot + glm::vec2(2, 1));
  CHECK(calm.session.preset().W == glm::dvec3(0));
  CHECK(wind_arrow_shown(calm.tools));
}

TEST_CASE("where there is air and no W, the arrow is that of the air's velocity, and a drag keeps to its own wind") {
  Preset preset = upright();
  preset.u = {2, 0, 0.2};
  CHECK_FALSE(wind_arrow_shown(Hand(preset).tools));  // without air u does nothing
  preset.air_density = 1.2;
  Hand breeze(preset);
  CHECK(wind_arrow_shown(breeze.tools));
  CHECK(wind_of_arrow(breeze.tools) == &Preset::u);
  const glm::vec2 from = tip(breeze);
  breeze.drag(from, from + glm::vec2(0, -80));  // as long as u was
  CHECK(breeze.session.preset().u.x == doctest::Approx(2).epsilon(0.02));
  CHECK(breeze.session.preset().u.y == doctest::Approx(glm::length(preset.u)).epsilon(0.02));
  CHECK(breeze.session.preset().u.z == doctest::Approx(0.2).epsilon(0.02));
  CHECK(breeze.session.preset().W == glm::dvec3(0));
  breeze.ui.command("undo");
  breeze.act();
  CHECK(breeze.session.preset().u == preset.u);

  Preset still = preset;
  still.u = {0, 0, 0};
  Hand calm(still);
  CHECK_FALSE(wind_arrow_shown(calm.tools));
  calm.ui.command("toggle_wind_arrow");
  calm.act();
  calm.drag(tip(calm), tip(calm) + glm::vec2(80, 0));
  CHECK(calm.session.preset().u.x == doctest::Approx(3).epsilon(0.02));  // m/s

  preset.W = {0.004, 0, 0};
  Hand both(preset);
  CHECK(wind_of_arrow(both.tools) == &Preset::W);
  const glm::vec2 foot = *both.scene.camera.project(wind_arrow(both.tools, preset.W).base, size);
  both.drag(tip(both), foot);
  CHECK(both.session.preset().W == glm::dvec3(0));
  CHECK(both.session.preset().u == preset.u);
  CHECK(wind_of_arrow(both.tools) == &Preset::u);
}

TEST_CASE("an arrow that would leave its picture is cut short at its edge, any other is left as it is") {
  Hand desk(upright());
  desk.scene.viewport.box = {{100, 50}, {740, 530}};
  const ImVec2 from{300, 200};
  for (const ImVec2 goal : {ImVec2{2000, 200}, {-500, -900}, {310, 4000}, {739, 529}}) {
    ImVec2 to = goal;
    CHECK(keep_in_picture(desk.ui, 0, from, to));
    CHECK((to.x > 100 && to.x < 740 && to.y > 50 && to.y < 530));
    // On the way to where it was to go.
    CHECK((to.x - from.x) * (goal.y - from.y) == doctest::Approx((to.y - from.y) * (goal.x - from.x)));
  }
  ImVec2 inside{400, 300};
  CHECK_FALSE(keep_in_picture(desk.ui, 0, from, inside));
  CHECK((inside.x == 400 && inside.y == 300));
}

TEST_CASE("slow motion is a quarter of the speed, and measured as such") {
  Pacing pacing;
  pacing.speed = 0.5;
  const auto simulated = [&](double seconds) {
    int steps = 0;
    for (int n = 0; n < int(seconds * 60); ++n) {
      const int due = pacing.due(1 / 60.0, 1e-3);
      steps += due;
      pacing.made(due, 1e-3, due * 1e-7);
    }
    return steps * 1e-3;
  };
  CHECK(simulated(2) == doctest::Approx(1).epsilon(0.05));
  pacing.slow(Pacing::slow_motion);
  CHECK(pacing.aim() == 0.125);
  CHECK(simulated(4) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(pacing.reached() == doctest::Approx(0.125).epsilon(0.05));
  pacing.slow(1);
  CHECK(simulated(2) == doctest::Approx(1).epsilon(0.05));
}

}  // namespace tyglab::hand_test
