// Copies that move in lockstep beside the cloth: the same hand, different settings.
#include <doctest/doctest.h>

#include <cmath>

#include "app/base/glfw_keys.h"
#include "app/base/numbers.h"
#include "app/ui/kit/curves.h"
#include "tests/ui/null_ui.h"

namespace tyglab::copies_ui_test {

constexpr int right = GLFW_MOUSE_BUTTON_RIGHT;

/// The last measured distance of the n-th copy, m.
double distance(test::NullUi& window, std::size_t n) {
  const Series& series = window.session.copies.distance;
  return series.empty() ? std::nan("") : series.column(n + 1).back();
}

glm::ivec2 pictures(const test::NullUi& window) {
  return {window.ui.viewport.columns, window.ui.viewport.rows};
}

TEST_CASE("equal copies stay equal under the hand; another method parts from them; all are seen beside each other" *
          doctest::test_suite("slow")) {
  test::NullUi window;
  Session& session = window.session;
  window.pause();
  window.click("plots.Copies");
  window.add_copy("Equal_copy");
  window.frames(2);
  CHECK(pictures(window).x * pictures(window).y == 2);
  window.add_copy("Implicit_Euler");
  window.key(GLFW_KEY_SPACE);
  window.until([&] { return window.steps() > 100 && distance(window, 1) > 0; }, "the copies to move");
  CHECK(cloth_of(session, 0).steps() == window.steps());
  CHECK(distance(window, 0) == 0);
  CHECK(distance(window, 1) > 1e-6);
  window.pause();
  window.frames(4);
  const Pins::Site corner{window.preset().rows - 1, 0};
  const glm::vec2 at = window.pixel_of(corner.i, corner.j);
  window.move(at);
  window.press(right);
  window.move(at + glm::vec2(30, -20));
  window.frames(2);
  REQUIRE(window.cloth().held().has_value());
  for (const int n : {0, 1}) {
    REQUIRE(cloth_of(session, n).held().has_value());
    CHECK(cloth_of(session, n).held()->i == window.cloth().held()->i);
    CHECK(cloth_of(session, n).held()->j == window.cloth().held()->j);
  }
  window.key(GLFW_KEY_SPACE);
  window.move(at + glm::vec2(80, -60));
  window.frames(8);
  window.release(right);
  window.frames(10);
  CHECK(distance(window, 0) == 0);
  window.click("plots.remove1");
  window.click("plots.remove0");
  CHECK(session.copies.lockstep.empty());
  CHECK(pictures(window) == glm::ivec2(1, 1));
}

TEST_CASE("an overlaid copy has the color of its curve, in every theme") {
  test::NullUi window;
  for (int theme = 0; theme < 3; ++theme) {
    CAPTURE(window.settings.theme);
    const auto& colors = window.scene.ghost_colors;
    for (std::size_t seat = 0; seat < colors.size(); ++seat) {
      const ImVec4 curve = ImGui::ColorConvertU32ToFloat4(copy_style(window.ui.theme.colors, seat).color);
      CHECK(colors[seat] == glm::vec3(curve.x, curve.y, curve.z));
      for (std::size_t other = 0; other < seat; ++other) CHECK(colors[seat] != colors[other]);
    }
    window.key(GLFW_KEY_T, GLFW_MOD_CONTROL);
    window.frames(2);
  }
}

TEST_CASE("a constant's own menu adds a copy that keeps its value; the original's other constants reach it") {
  test::NullUi window;
  const Copies& copies = window.session.copies;
  const glm::vec2 value = window.middle("constants.k_s.value");
  window.click(value, right);
  window.click("menu.copy_double");
  REQUIRE(copies.lockstep.size() == 1);
  CHECK(name_of_cloth(window.session, 0) == "k_s = " + short_number(2 * window.preset().k_s));
  window.type_value("k_s", "60");
  CHECK(window.preset().k_s == 60);
  CHECK(name_of_cloth(window.session, 0) == "k_s = 100");
  window.click(value, right);
  window.click("menu.copy_value");
  window.type("25");
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  REQUIRE(copies.lockstep.size() == 2);
  CHECK(name_of_cloth(window.session, 1) == "k_s = 25");
  CHECK(window.drew("k_s = 25"));
  window.until([&] { return window.t() > 0.6; }, "them to part");
  window.rest();
  CHECK(pictures(window) != glm::ivec2(1, 1));
  window.click("plots.ways");
  const Box ways = window.control("plots.ways");
  window.click(glm::vec2{ways.hi.x - 10, (ways.lo.y + ways.hi.y) / 2});
  window.frames(2);
  CHECK(pictures(window) == glm::ivec2(1, 1));
}

TEST_CASE("a copy that diverges is told so while the others go on, and a restart mends it") {
  test::NullUi window;
  window.click("plots.Copies");
  window.add_copy("Euler");
  window.until([&] { return cloth_of(window.session, 0).divergence().has_value(); }, "Euler to diverge");
  const double at = window.t();
  CHECK_FALSE(window.diverged());
  window.until([&] { return window.t() > at + 0.2; }, "the original to go on");
  window.pause();
  window.key(GLFW_KEY_R);
  CHECK(window.t() < at);
  CHECK_FALSE(cloth_of(window.session, 0).divergence().has_value());
}

TEST_CASE("where the original diverges its copies go on") {
  test::NullUi window({.with = [](Preset& preset) { preset.integrator = "euler"; }});
  window.pause();
  window.click("plots.Copies");
  window.add_copy("Verlet");
  window.key(GLFW_KEY_R);
  window.key(GLFW_KEY_SPACE);
  window.until([&] { return window.diverged(); }, "Euler to diverge");
  const double at = cloth_of(window.session, 0).time();
  window.until([&] { return cloth_of(window.session, 0).time() > at + 0.3; }, "Verlet to go on");
}

}  // namespace tyglab::copies_ui_test
