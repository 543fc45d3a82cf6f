// Pause, single step, restart.
#include <doctest/doctest.h>

#include <cmath>

#include "app/base/glfw_keys.h"
#include "tests/ui/null_ui.h"

namespace tyglab::transport_test {

void run(test::NullUi& window, int count) {
  const std::int64_t begun = window.steps();
  window.until([&] { return window.steps() > begun + count; }, "the motion");
}

/// A press that is over before a frame is.
void press(test::NullUi& window, int key) {
  window.input.on_key(key, GLFW_PRESS, 0);
  window.input.on_key(key, GLFW_RELEASE, 0);
}

TEST_CASE("Space stops and starts the motion, → and O make exactly one step of dt") {
  test::NullUi window;
  run(window, 50);
  window.pause();
  const std::int64_t steps = window.steps();
  const double t = window.t(), dt = window.preset().dt;
  window.frames(4);
  CHECK(window.steps() == steps);
  CHECK(window.t() == t);
  int n = 0;
  for (const int key : {GLFW_KEY_RIGHT, GLFW_KEY_O, GLFW_KEY_RIGHT}) {
    window.key(key);
    window.frames(3);
    CHECK(window.steps() == steps + ++n);
    CHECK(std::abs(window.t() - t - n * dt) < 1e-9);
    CHECK(window.paused());
  }
  window.click("top.step");
  CHECK(window.steps() == steps + 4);
  window.key(GLFW_KEY_SPACE);
  CHECK_FALSE(window.paused());
  run(window, 50);
  window.click("top.play");
  CHECK(window.paused());
}

TEST_CASE("Backspace and R restart the motion and keep the constants") {
  test::NullUi window({.with = [](Preset& preset) { preset.k_s = 80; }});
  for (const int key : {GLFW_KEY_BACKSPACE, GLFW_KEY_R}) {
    run(window, 100);
    window.pause();
    window.key(key);
    CHECK(window.steps() == 0);
    CHECK(window.t() == 0);
    CHECK(window.preset().k_s == 80);
    CHECK(window.paused());
    window.key(GLFW_KEY_SPACE);
  }
}

TEST_CASE("a rewind keeps the plots up to the moment that it goes back to") {
  test::NullUi window;
  window.until([&] { return window.t() > 1.5; }, "the motion");
  window.pause();
  const Series& forces = window.session.recorded.forces;
  const std::size_t before = forces.size();
  window.key(GLFW_KEY_LEFT);
  window.frames(3);
  CHECK(window.t() < 1);
  CHECK(forces.size() > before / 4);
  CHECK(forces.size() < before);
  CHECK(forces.t().back() <= window.t());
}

TEST_CASE("thirty key presses within a frame make thirty steps, and an odd number of Space starts the motion") {
  test::NullUi window;
  window.pause();
  const std::int64_t steps = window.steps();
  for (int n = 0; n < 30; ++n) press(window, GLFW_KEY_RIGHT);
  window.frames(3);
  CHECK(window.steps() == steps + 30);
  for (int n = 0; n < 7; ++n) press(window, GLFW_KEY_SPACE);
  window.frames(3);
  CHECK_FALSE(window.paused());
  CHECK(window.steps() > steps + 30);
}

TEST_CASE("→ held down goes on stepping, and stops when it is let go") {
  test::NullUi window;
  window.pause();
  const std::int64_t steps = window.steps();
  window.input.on_key(GLFW_KEY_RIGHT, GLFW_PRESS, 0);
  for (int n = 0; n < 6; ++n, window.frame()) window.input.on_key(GLFW_KEY_RIGHT, GLFW_REPEAT, 0);
  window.input.on_key(GLFW_KEY_RIGHT, GLFW_RELEASE, 0);
  const std::int64_t stepped = window.steps();
  CHECK(stepped > steps + 5);
  window.frames(5);
  CHECK(window.steps() == stepped);
}

}  // namespace tyglab::transport_test
