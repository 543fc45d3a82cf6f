// Clicks, drags and words that are over before a frame is: each counts, in its turn.
#include <doctest/doctest.h>

#include <initializer_list>

#include "app/base/fingers.h"
#include "app/base/glfw_keys.h"
#include "app/ui/kit/imgui_compat.h"
#include "tests/ui/null_ui.h"

namespace tyglab::input_test {

constexpr int left = GLFW_MOUSE_BUTTON_LEFT, ctrl = GLFW_MOD_CONTROL;

// What GLFW tells before the next frame.

void go(test::NullUi& window, glm::vec2 to) {
  window.input.on_move(to, window.ui.now);
}

void button(test::NullUi& window, int action) {
  window.input.on_button(left, action, window.input.mods, window.ui.now);
}

void click_and_leave(test::NullUi& window, glm::vec2 at, glm::vec2 to, int times = 1) {
  go(window, at);
  for (int n = 0; n < times; ++n) button(window, GLFW_PRESS), button(window, GLFW_RELEASE);
  go(window, to);
}

void press(test::NullUi& window, int key, int mods = 0) {
  window.input.on_key(key, GLFW_PRESS, mods);
  window.input.on_key(key, GLFW_RELEASE, mods);
}

/// Until all that has come was shown.
void settle(test::NullUi& window) {
  window.frame();
  window.until([&] { return !window.input.unshown; }, "everything to be shown");
  window.frames(4);
}

void open_field(test::NullUi& window) {
  window.double_click(window.middle("constants.k_s.value"));
  REQUIRE(window.typing());
}

TEST_CASE("a click chooses what it met, though press, release and the way on come within one frame") {
  test::NullUi window;
  window.pause();
  window.click("top.engine");
  const glm::vec2 away(5, 400);
  click_and_leave(window, window.middle("menu.cpu_double"), away);
  settle(window);
  CHECK(window.preset().precision == Precision::double_);
  // The same from the closed menu on: it opens, and the next click chooses.
  window.frames(60);
  click_and_leave(window, window.middle("top.engine"), away);
  settle(window);
  window.frames(60);
  click_and_leave(window, window.middle("menu.cpu_float"), away);
  settle(window);
  CHECK(window.preset().precision == Precision::float_);
}

TEST_CASE("three clicks within a frame are three, and what the pointer passes over on its way is left alone") {
  test::NullUi window;
  window.pause();
  const glm::vec2 step = window.middle("top.step"), play = window.middle("top.play");
  const std::int64_t steps = window.steps();
  click_and_leave(window, step, play, 3);
  settle(window);
  CHECK(window.steps() == steps + 3);
  CHECK(window.paused());
}

TEST_CASE("a whole drag within one frame turns a slider to where it ends, and the slider lets go") {
  test::NullUi window;
  window.pause();
  const double before = window.preset().k_s;
  const glm::vec2 from = window.along("constants.k_s.slider", 0.3f), to = window.along("constants.k_s.slider", 0.9f);
  go(window, from);
  button(window, GLFW_PRESS);
  go(window, (from + to) / 2.f);
  go(window, to);
  button(window, GLFW_RELEASE);
  go(window, {5, 400});
  settle(window);
  const double value = window.preset().k_s;
  CHECK(value > 1.5 * before);
  window.move({400, 400});
  window.move({300, 400});
  CHECK(window.preset().k_s == value);
  CHECK(window.ui.slider.dragged == 0);
  // As far as a drag that takes its time.
  test::NullUi slow;
  slow.pause();
  slow.drag({from, (from + to) / 2.f, to});
  CHECK(slow.preset().k_s == value);
}

TEST_CASE("a body stays where the button was released, however far the pointer goes within that frame") {
  test::NullUi window({.preset = "sphere"});
  window.pause();
  window.key(GLFW_KEY_BACKSPACE);
  window.frames(4);
  const auto seen = [&] {
    return *window.scene.camera.project(window.preset().bodies[0].c, window.ui.viewport.size()) +
           window.ui.viewport.box.lo;
  };
  const glm::vec2 from = seen(), to = from + glm::vec2(30, 0);
  window.move(from);
  window.press();
  window.move(to);
  button(window, GLFW_RELEASE);
  go(window, to + glm::vec2(0, -200));
  settle(window);
  CHECK(glm::distance(seen(), to) < 3);
}

TEST_CASE("keys that fall into one frame arrive all and in order: select all, digits, a backspace, Enter") {
  test::NullUi window;
  window.pause();
  const auto type = [&](std::string_view digits) { window.add_typed(digits); };
  open_field(window);
  press(window, GLFW_KEY_A, ctrl);
  type("51");
  press(window, GLFW_KEY_ENTER);
  settle(window);
  CHECK_FALSE(window.typing());
  CHECK(window.preset().k_s == 51);
  open_field(window);
  press(window, GLFW_KEY_BACKSPACE);  // all of it is selected at first
  type("62");
  press(window, GLFW_KEY_ENTER);
  settle(window);
  CHECK(window.preset().k_s == 62);
  open_field(window);
  press(window, GLFW_KEY_A, ctrl);
  type("78");
  press(window, GLFW_KEY_BACKSPACE);
  type("45");
  for (int n = 0; n < 2; ++n) press(window, GLFW_KEY_BACKSPACE);  // the same key twice is twice
  type("3");
  press(window, GLFW_KEY_ENTER);
  settle(window);
  CHECK(window.preset().k_s == 73);
}

TEST_CASE("characters typed just before a shortcut are no part of it, and the shortcut none of theirs") {
  test::NullUi window;
  window.pause();
  open_field(window);
  window.add_typed("12");
  press(window, GLFW_KEY_A, ctrl);
  window.input.mods = ctrl;  // Ctrl is still down at the end of the frame
  settle(window);
  window.input.mods = 0;
  window.add_typed("9");
  press(window, GLFW_KEY_ENTER);
  settle(window);
  CHECK(window.preset().k_s == 9);
}

TEST_CASE("a key still down at the end of a long frame acts in its turn, and once") {
  test::NullUi window;
  window.pause();
  open_field(window);
  press(window, GLFW_KEY_A, ctrl);
  window.add_typed("8");
  window.input.on_key(GLFW_KEY_BACKSPACE, GLFW_PRESS, 0);
  window.frames(5);
  window.input.on_key(GLFW_KEY_BACKSPACE, GLFW_RELEASE, 0);
  window.add_typed("51");
  press(window, GLFW_KEY_ENTER);
  settle(window);
  CHECK(window.preset().k_s == 51);
}

TEST_CASE("Ctrl counts for the click that it was held for, though it is up before the frame ends") {
  test::NullUi window;
  window.pause();
  const glm::vec2 at = window.middle("constants.k_s.value");
  window.frames(60);
  window.input.mods = ctrl;
  click_and_leave(window, at, at);
  window.input.mods = 0;
  settle(window);
  CHECK(window.typing());
  window.key(test::NullUi::escape);
  window.frames(60);
  click_and_leave(window, at, at);
  window.input.mods = ctrl;  // and not for one before it
  window.frame();
  window.input.mods = 0;
  settle(window);
  CHECK_FALSE(window.typing());
}

TEST_CASE("a release that is lost, as while the window is iconified, leaves nothing held") {
  test::NullUi window;
  window.pause();
  window.move(window.along("constants.k_s.slider", 0.5f));
  window.press();
  CHECK(window.ui.slider.dragged != 0);
  button(window, GLFW_RELEASE);
  window.input.clear();
  window.frames(3);
  CHECK(window.ui.slider.dragged == 0);
  CHECK_FALSE(ImGui::IsMouseDown(left));
}

TEST_CASE("what the pointer points at counts while it is over the window, or the window has the keyboard") {
  test::NullUi window;
  window.move(window.middle("constants.k_s.slider"));
  const auto points = [&] { return ImGui::IsMousePosValid(); };
  CHECK(points());
  window.input.inside = false;
  window.frame();
  CHECK(points());
  window.input.focused = false;
  window.frame();
  CHECK_FALSE(points());
  window.input.inside = true;
  window.frame();
  CHECK(points());
}

/// A screen that fingers touch, as the page has it.
struct TouchScreen {
  using Phase = Fingers::Phase;
  explicit TouchScreen(test::NullUi& of) : window(of) {
    window.input.by_touch = true;
    window.input.double_click_px = 24;
    window.input.finger_button = [this](glm::vec2 at) { return finger_button(window.tools, at); };
    window.input.finger_on_cloth = [this](glm::vec2 at) { return window.ui.viewport.takes(at); };
    window.input.finger_on_list = [](glm::vec2 at) { return gui::scrolls_at({at.x, at.y}); };
    fingers.wheel_step = 5 * ImGui::GetFontSize();
  }
  void on(int finger, Phase phase, glm::vec2 at) {
    fingers.on_finger(window.input, finger, phase, at, window.ui.now);
    frames(1);
  }
  void frames(int count) {
    for (int n = 0; n < count; ++n) {
      window.frame();
      fingers.update(window.input, window.ui.now);
    }
  }
  void tap(glm::vec2 at) {
    on(1, Phase::down, at);
    on(1, Phase::up, at);
    frames(4);
  }
  void drag(glm::vec2 from, glm::vec2 to) {
    on(1, Phase::down, from);
    for (int n = 1; n <= 8; ++n) on(1, Phase::move, from + (to - from) * (float(n) / 8));
    on(1, Phase::up, to);
    frames(8);
  }

  test::NullUi& window;
  Fingers fingers;
};

TEST_CASE("a gesture of two fingers is no press where the first of them landed") {
  test::NullUi window;
  window.pause();
  TouchScreen screen(window);
  const Preset before = window.preset();
  const auto picked = window.session.picked;  // the middle of the cloth, from the start
  const float distance = window.scene.camera.distance;
  const auto pinch = [&](glm::vec2 at, int frames = 3) {
    screen.on(1, TouchScreen::Phase::down, at);
    screen.frames(frames);  // the second finger comes a moment later
    screen.on(2, TouchScreen::Phase::down, at + glm::vec2(40, 0));
    for (float n = 1; n <= 8; ++n) {
      screen.on(1, TouchScreen::Phase::move, at - glm::vec2(5 * n, 0));
      screen.on(2, TouchScreen::Phase::move, at + glm::vec2(40 + 5 * n, 0));
    }
    screen.on(2, TouchScreen::Phase::up, at + glm::vec2(80, 0));
    screen.on(1, TouchScreen::Phase::up, at);
    screen.frames(8);
  };
  for (const char* control : {"top.play", "constants.dt.value"}) pinch(window.middle(control));
  pinch(window.along("constants.k_s.slider", 0.9f));
  // A quarter of a second later the first has pressed, which the second takes back.
  for (const char* control : {"top.play", "constants.dt.value"}) pinch(window.middle(control), 15);
  CHECK(window.paused());
  CHECK_FALSE(window.typing());
  REQUIRE(picked != Pins::Site{6, 6});
  const glm::vec2 particle = window.pixel_of(6, 6);
  pinch(particle);
  window.tools.finger_cuts = true;
  pinch(particle);
  CHECK(window.preset() == before);
  CHECK(window.session.picked == picked);
  CHECK(window.torn() == 0);
  CHECK(window.scene.camera.distance < 0.8f * distance);
  // One that ends as a gesture of the system is none either.
  screen.on(1, TouchScreen::Phase::down, window.middle("top.play"));
  screen.on(1, TouchScreen::Phase::ended, window.middle("top.play"));
  screen.frames(8);
  CHECK(window.paused());
  screen.tap(window.middle("top.play"));
  CHECK_FALSE(window.paused());
}

TEST_CASE("one finger grabs the cloth, turns a slider sideways, and scrolls what scrolls") {
  test::NullUi window({.size = {1280, 500}});
  window.pause();
  TouchScreen screen(window);
  const glm::vec2 slider = window.along("constants.k_s.slider", 0.5f);
  const Preset before = window.preset();
  screen.drag(slider, slider - glm::vec2(0, 120));
  CHECK(window.preset() == before);
  CHECK(window.middle("constants.k_s.slider").y == doctest::Approx(slider.y - 120).epsilon(0.05));
  const glm::vec2 there = window.along("constants.k_s.slider", 0.5f);
  screen.drag(there, there + glm::vec2(30, 0));
  CHECK(window.preset().k_s > before.k_s);
  const glm::vec2 particle = window.pixel_of(6, 6);
  screen.on(1, TouchScreen::Phase::down, particle);
  for (int n = 0; n < 12; ++n) screen.on(1, TouchScreen::Phase::move, particle + glm::vec2(5 * n, 0));
  CHECK(window.cloth().held());
  screen.on(1, TouchScreen::Phase::up, particle);
  screen.frames(4);
  CHECK_FALSE(window.cloth().held());
}

TEST_CASE("a tap on a number opens it with its text selected, and so does a double tap") {
  test::NullUi window;
  window.pause();
  TouchScreen screen(window);
  for (int taps : {1, 2}) {
    CAPTURE(taps);
    const glm::vec2 number = window.middle("constants.k_s.value");
    for (int n = 0; n < taps; ++n) screen.tap(number);
    REQUIRE(window.typing());
    window.add_typed(taps == 1 ? "77" : "88");
    screen.frames(6);
    window.key(test::NullUi::enter);
    screen.frames(4);
    CHECK(window.preset().k_s == (taps == 1 ? 77 : 88));
    screen.frames(60);
  }
}

TEST_CASE("a tap beside a number that is typed takes it, on the cloth and on the sky") {
  test::NullUi window;
  window.pause();
  TouchScreen screen(window);
  const glm::vec2 cloth = window.pixel_of(6, 6), sky = window.ui.viewport.box.lo + glm::vec2(12, 120);
  for (const glm::vec2 beside : {cloth, sky}) {
    const bool on_cloth = beside == cloth;
    CAPTURE(on_cloth);
    screen.tap(window.middle("constants.k_s.value"));
    REQUIRE(window.typing());
    window.add_typed(on_cloth ? "77" : "88");
    screen.frames(6);
    screen.tap(beside);
    screen.frames(4);
    CHECK_FALSE(window.typing());
    CHECK(window.preset().k_s == (on_cloth ? 77 : 88));
    screen.frames(60);
  }
}

TEST_CASE("a hint comes to a finger that rests, speaks of fingers, and goes with it") {
  test::NullUi window;
  window.pause();
  TouchScreen screen(window);
  const glm::vec2 slider = window.along("constants.k_s.slider", 0.5f);
  screen.tap(window.middle("viewport.views.3"));
  screen.frames(120);
  CHECK_FALSE(window.tooltip().has_value());
  screen.on(1, TouchScreen::Phase::down, slider);
  screen.frames(120);
  CHECK(window.tooltip().has_value());
  CHECK(window.drew("tap the number to type"));
  CHECK_FALSE(window.drew("Right-click"));
  screen.on(1, TouchScreen::Phase::up, slider);
  screen.frames(4);
  CHECK_FALSE(window.tooltip().has_value());
}

}  // namespace tyglab::input_test
