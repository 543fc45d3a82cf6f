// Copies that move in lockstep beside the cloth: the same hand, different settings.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "app/base/glfw_keys.h"
#include "app/base/text.h"
#include "app/ui/frame/commands.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/ui.h"
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

TEST_CASE("a copy is drawn as its method is in lists, one of a method that is there as nothing else; in every theme") {
  test::NullUi window;
  window.pause();
  window.click("plots.Copies");
  for (const char* item : {"Equal_copy", "Implicit_Euler", "dt_2_5e_4_s"}) window.add_copy(item);
  const auto is = [](const CurveStyle& a, const CurveStyle& b) { return a.color == b.color && a.line == b.line; };
  for (int theme = 0; theme < 3; ++theme) {
    CAPTURE(window.settings.theme);
    const Tokens& c = window.ui.theme.colors;
    CHECK(is(cloth_style(window.ui.theme.colors, window.session, Copies::original), integrator_style(c, "verlet")));
    CHECK(is(cloth_style(window.ui.theme.colors, window.session, 1), integrator_style(c, "implicit_euler")));
    for (const int n : {0, 1, 2}) {
      const ImVec4 curve = ImGui::ColorConvertU32ToFloat4(cloth_style(window.ui.theme.colors, window.session, n).color);
      CHECK(window.scene.ghost_colors[std::size_t(n)] == glm::vec3(curve.x, curve.y, curve.z));
      for (int other = Copies::original; other < n; ++other)
        CHECK_FALSE(is(cloth_style(window.ui.theme.colors, window.session, n),
                       cloth_style(window.ui.theme.colors, window.session, other)));
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

TEST_CASE("the menu of copies leaves most of the window in sight, under headings, and every row can be reached") {
  test::NullUi window({.settings = [](Settings& settings) { settings.theme = "projector"; }});
  window.pause();
  window.click("plots.Copies");
  window.click("plots.add");
  CHECK(window.drew("Method"));
  float least = 1e9f, most = 0;
  for (const auto& [name, box] : window.controls())
    if (name.starts_with("menu.")) least = std::min(least, box.lo.y), most = std::max(most, box.hi.y);
  CHECK(most - least < 450);
  window.scroll_to("menu.OpenCL", "menu.Equal_copy");
  for (const char* heading : {"Step", "Precision", "Engine"}) CHECK(window.drew(heading));
  window.wheel(20);
  window.scroll_to("menu.XPBD", "menu.Equal_copy");
  window.click("menu.XPBD");
  window.frames(2);
  CHECK(name_of_cloth(window.session, 0) == "XPBD");
}

TEST_CASE("the columns of the copies' card say what they hold, in a narrow column too") {
  for (const auto& [size, theme] :
       {std::pair{glm::ivec2{1600, 900}, "dark"}, {{1280, 720}, "dark"}, {{1280, 720}, "projector"}}) {
    CAPTURE(size.x);
    CAPTURE(std::string(theme));
    test::NullUi window({.size = size, .settings = [theme = theme](Settings& settings) { settings.theme = theme; }});
    window.pause();
    window.find("copies card");
    window.add_copy("Equal_copy");
    window.frames(4);
    window.move(window.middle("plots.distance"));
    window.until([&] { return window.drew("Root mean square (rms)"); }, "which distance is meant");
    window.move(window.middle("plots.cost"));
    window.until([&] { return window.drew("CPU seconds per simulated second"); }, "what the cost is");
  }
}

TEST_CASE("a plot has its units at its axes, and its head says what else is to know") {
  test::NullUi window;
  window.pause();
  window.click("plots.Copies");
  window.add_copy("Implicit_Euler");
  window.frames(2);
  for (const bool presented : {false, true}) {
    CAPTURE(presented);
    CHECK(window.drew("1 m"));
    CHECK_FALSE(window.drew("m, log"));
    if (!presented) CHECK(window.drew("log"));
    window.key(GLFW_KEY_F5);
    window.frames(4);
  }
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

TEST_CASE("a copy that has diverged tells why, cannot be cut through its name, and is no reference") {
  test::NullUi window;
  window.click("plots.Copies");
  window.add_copy("Euler");
  window.until([&] { return cloth_of(window.session, 0).divergence().has_value(); }, "Euler to diverge");
  window.pause();
  window.frames(3);
  const Divergence why = *cloth_of(window.session, 0).divergence();
  const auto torn = [&] {
    return window.cloth().tears().torn_count() + cloth_of(window.session, 0).tears().torn_count();
  };
  const int before = torn();
  const char* details = "The others go on; R restarts all of them.";  // the name in the picture says less

  window.click("viewport.name_of_copy0");
  window.frames(3);
  CHECK(window.drew("Euler diverged"));
  CHECK(window.drew(details));
  CHECK(window.drew("step " + std::to_string(why.step)));
  CHECK(window.drew("times the worst-case limit"));
  REQUIRE(window.ui.placing.find("copy details") != nullptr);
  CHECK(window.ui.placing.find("copy details")->lo.y >= window.ui.viewport.box.hi.y);  // it covers no cloth
  CHECK(torn() == before);
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK_FALSE(window.drew(details));

  window.click("plots.copy0");
  window.frames(3);
  CHECK(window.drew(details));
  CHECK(window.session.copies.reference == Copies::original);
  window.click("viewport.close_details");
  window.frames(3);
  CHECK_FALSE(window.ui.copy_details.has_value());

  window.click("plots.copy0");
  window.key(GLFW_KEY_R);  // what they are about is gone
  window.frames(3);
  CHECK_FALSE(window.ui.copy_details.has_value());
  window.click("plots.copy0");
  CHECK(window.session.copies.reference == 0);
}

TEST_CASE("the palette overlays the copies, parts them, and removes them all") {
  test::NullUi window;
  window.pause();
  CHECK_FALSE(why_not(window.ui, row_of("toggle_overlaid")).empty());
  CHECK_FALSE(why_not(window.ui, row_of("remove_copies")).empty());
  window.click("plots.Copies");
  window.add_copy("Euler");
  window.add_copy("Implicit_Euler");
  CHECK(window.session.copies.tiles() == 3);
  window.find("overlaid");
  window.frames(3);
  CHECK(window.session.copies.tiles() == 1);
  window.find("copies overlaid");
  window.frames(3);
  CHECK(window.session.copies.tiles() == 3);
  window.find("remove all");
  window.frames(3);
  CHECK(window.session.copies.lockstep.empty());
}

TEST_CASE("in a low window the details of a copy have the view buttons' place whole, not in part") {
  test::NullUi window({.size = {900, 600}, .settings = [](Settings& settings) { settings.ui_scale = 1.5f; }});
  window.find("copies card");
  window.add_copy("Euler");
  window.until([&] { return cloth_of(window.session, 0).divergence().has_value(); }, "Euler to diverge");
  window.pause();
  window.frames(3);
  CHECK(window.sees("viewport.views.1"));
  window.click("plots.copy0");
  window.frames(4);
  REQUIRE(window.ui.placing.find("copy details") != nullptr);
  const Box details = *window.ui.placing.find("copy details");
  for (const auto& [name, box] : window.controls()) {
    CAPTURE(name);
    if (name.starts_with("viewport.views")) CHECK_FALSE(overlap(box, details));
  }
  window.key(GLFW_KEY_ESCAPE);
  window.frames(4);
  CHECK(window.sees("viewport.views.1"));
}

TEST_CASE("the names of overlaid cloths stand above them where the picture is narrow") {
  test::NullUi window({.size = {1280, 840}, .settings = [](Settings& settings) { settings.theme = "projector"; }});
  window.pause();
  window.click("plots.Copies");
  window.add_copy("Euler");
  window.add_copy("Implicit_Euler");
  window.find("overlaid");
  window.rest();
  const Viewport& viewport = window.ui.viewport;
  REQUIRE(viewport.size().x < viewport.size().y);
  const std::vector<Box> cloth = drawn_parts(window.ui);
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n);
    const Box* name = window.ui.placing.find("name " + std::to_string(n));
    REQUIRE(name != nullptr);
    CHECK(covered(*name, cloth) == 0);
  }
  window.key(GLFW_KEY_F5);  // there the cloth has more beside it
  window.rest();
  REQUIRE(viewport.size().x > viewport.size().y);
  CHECK(window.ui.placing.find("name 2")->hi.y > viewport.box.hi.y - viewport.size().y / 10);
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
