// Ctrl+P, the tour, and the help that leads to both.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>

#include "app/base/glfw_keys.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "tests/ui/null_ui.h"

namespace tyglab::palette_ui_test {

void open_with(test::NullUi& window, std::string_view text) {
  window.key(GLFW_KEY_P, GLFW_MOD_CONTROL);
  window.until([&] { return window.ui.palette.open && window.typing(); }, "the palette to take keys");
  window.type(text);
}

TEST_CASE("Ctrl+P finds commands, methods, constants and presets by what is typed, with mouse and keyboard") {
  test::NullUi window;
  window.key(GLFW_KEY_P, GLFW_MOD_CONTROL);
  CHECK(window.ui.palette.open);
  window.key(GLFW_KEY_ESCAPE);
  CHECK_FALSE(window.ui.palette.open);
  window.find("rk4");
  CHECK(window.preset().integrator == "rk4");
  window.find("run or");
  CHECK(window.paused());
  open_with(window, "dare inte");
  window.key(GLFW_KEY_ENTER);
  window.frames(6);
  CHECK(window.ui.palette.open);  // nothing is found, so nothing is done
  window.key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  window.type("constant, stretching");
  window.key(GLFW_KEY_DOWN);
  window.key(GLFW_KEY_UP);
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK_FALSE(window.ui.palette.open);
  window.key(GLFW_KEY_RIGHT);
  window.frames(2);
  CHECK(window.preset().k_s > 50);  // its slider has the keys
  window.key(GLFW_KEY_ESCAPE);
  open_with(window, "outlines");
  window.click("palette.View.Outlines");
  CHECK(window.preset().mode == 4);
  window.find("flag in");
  CHECK(window.ui.dialog.kind == Dialog::Kind::unsaved);  // constants have changed
}

TEST_CASE("the palette adds bodies, by other names too") {
  test::NullUi window;
  window.pause();
  window.find("add sphere");
  REQUIRE(window.preset().bodies.size() == 1);
  CHECK(window.preset().bodies[0].shape == Body::Shape::sphere);
  window.find("add plane");
  REQUIRE(window.preset().bodies.size() == 2);
  CHECK(window.preset().bodies[1].shape == Body::Shape::plane);
  const auto entries = palette_entries(window.ui);
  for (const auto& [typed, title] :
       {std::pair{"ball", "Add a sphere"}, {"floor", "Add a plane"}, {"ground", "Add a plane"}}) {
    const std::vector<int> found = matching(entries, typed);
    CHECK(std::any_of(found.begin(), found.end(), [&](int k) { return entries[std::size_t(k)].title == title; }));
  }
  test::NullUi weight({.preset = "one_weight"});
  for (const PaletteEntry& entry : palette_entries(weight.ui)) CHECK(entry.title != "Add a sphere");
}

TEST_CASE("what is typed right after the key that opens a field is for the field, however slow the frames are") {
  test::NullUi window;
  const auto before = window.preset();
  window.input.on_key(GLFW_KEY_P, GLFW_PRESS, GLFW_MOD_CONTROL);
  window.input.on_key(GLFW_KEY_P, GLFW_RELEASE, 0);
  window.add_typed("rk4");
  window.frames(12);
  CHECK(window.ui.palette.open);
  CHECK(std::string(window.ui.palette.text) == "rk4");
  CHECK(window.preset() == before);  // 4 is a view, and k colors the cloth
  CHECK_FALSE(window.ui.scene.colors.chosen);
  window.key(GLFW_KEY_ESCAPE);

  window.input.on_key(GLFW_KEY_L, GLFW_PRESS, GLFW_MOD_CONTROL);
  window.input.on_key(GLFW_KEY_L, GLFW_RELEASE, 0);
  window.add_typed("chaos");
  window.input.on_key(GLFW_KEY_ENTER, GLFW_PRESS, 0);
  window.input.on_key(GLFW_KEY_ENTER, GLFW_RELEASE, 0);
  window.frames(20);
  REQUIRE(window.session.labs.run);
  CHECK(window.session.labs.run->lab.label == "08_chaos");
}

TEST_CASE("a click beside the palette closes it and does nothing to the cloth") {
  test::NullUi window;
  window.pause();
  open_with(window, "zzz");
  const Box box = window.ui.viewport.box;
  window.click(glm::vec2{(box.lo.x + box.hi.x) / 2, box.hi.y - 60});
  CHECK_FALSE(window.ui.palette.open);
  CHECK(window.torn() == 0);
}

TEST_CASE("menu, palette and help have every command: they read the same rows") {
  test::NullUi window;
  window.pause();
  const auto entries = palette_entries(window.ui);
  const auto palette_has = [&](std::string_view name) {
    return std::any_of(entries.begin(), entries.end(), [&](const PaletteEntry& entry) { return entry.title == name; });
  };
  const auto control_of = [](std::string_view name) {
    std::string control = "menu.";
    for (const char letter : name)
      if (const auto byte = static_cast<unsigned char>(letter); byte < 0x80)
        control += std::isalnum(byte) ? letter : '_';
    return control;
  };
  window.click("top.menu");
  for (const CommandTopic& topic : command_topics()) {
    CAPTURE(topic.name);
    window.click(control_of(topic.name));
    window.frames(3);
    CHECK(window.middle("top.play").x > 0);  // the transport is not hidden
    for (const CommandRow& row : topic.rows) {
      CAPTURE(row.name);
      CHECK(window.drew(row.name));
      CHECK(palette_has(row.name) == why_not(window.ui, row).empty());
    }
  }
  window.click("menu.File");
  CHECK(window.control("menu.Quit").lo.y > window.control("menu.Presets").hi.y);
  window.click("menu.View");
  window.click("menu.Views_of_the_cloth");
  window.click("menu.Outlines");
  window.until([&] { return window.preset().mode == 4; }, "the view");
}

TEST_CASE("help has its buttons in sight in a small window, and its last line is read by scrolling") {
  for (const double scale : {1.0, 1.5}) {
    CAPTURE(scale);
    test::NullUi window({.size = {900, 600}, .settings = [scale](Settings& settings) { settings.ui_scale = scale; }});
    window.key(GLFW_KEY_F1);
    window.frames(4);
    const Box close = window.control("help.Close");
    CHECK(close.hi.y <= 600);
    window.move({450, 250});
    for (int turn = 0; turn < 60; ++turn) window.wheel(-1);
    window.frames(4);
    CHECK(window.drew("Esc releases them."));
    CHECK(window.control("help.Close").lo.y == close.lo.y);
    window.click("help.Close");
    window.frames(2);
    CHECK_FALSE(window.ui.help);
  }
}

TEST_CASE("on a touch screen the tour speaks of fingers alone") {
  test::NullUi window({.settings = [](Settings& settings) { settings.tour_seen = false; }});
  window.input.by_touch = true;
  start_tour(window.ui);
  for (int card = 0; card < 5; ++card) {
    CAPTURE(card);
    window.frames(4);
    REQUIRE(window.ui.tour.card == card);
    for (const char* word : {"button", "click", "Ctrl", "Space", "wheel"}) {
      CAPTURE(std::string(word));
      CHECK_FALSE(window.drew(word));
    }
    if (card < 4) window.click("tour.Next");
  }
}

TEST_CASE("the tour is walked through, skipped and seen again, and that it was seen is remembered") {
  test::NullUi window({.settings = [](Settings& settings) { settings.tour_seen = false; }});
  start_tour(window.ui);
  window.frames(2);
  CHECK_FALSE(window.drew("The motion is paused: Space runs it."));
  window.pause();
  window.frames(2);
  CHECK(window.drew("The motion is paused: Space runs it."));
  for (int card = 0; card < 5; ++card) {
    window.frames(4);
    CHECK(window.ui.tour.card == card);
    if (card < 4) window.click("tour.Next");
  }
  window.click("tour.Back");
  CHECK(window.ui.tour.card == 3);
  window.key(GLFW_KEY_ENTER);
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  CHECK(window.ui.tour.card == -1);
  CHECK(window.settings.tour_seen);
  window.key(GLFW_KEY_F1);
  window.click("help.Take_the_tour");
  CHECK(window.ui.tour.card == 0);
  window.click("tour.Skip_the_tour");
  CHECK(window.ui.tour.card == -1);
}

}  // namespace tyglab::palette_ui_test
