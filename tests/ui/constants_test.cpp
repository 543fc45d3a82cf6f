// Constants are changed by slider, by typing and by keys, undone and reset; the integrator is switched while running.
#include <doctest/doctest.h>

#include <cmath>

#include "app/base/glfw_keys.h"
#include "app/session/requests.h"
#include "core/io/preset_io.h"
#include "core/model/preset.h"
#include "tests/ui/null_ui.h"

namespace tyglab::constants_test {

constexpr double preset_k_s = 50;
constexpr int ctrl = GLFW_MOD_CONTROL;

TEST_CASE("the dot of what is not saved moves nothing in the top bar") {
  test::NullUi window({.settings = [](Settings& settings) { settings.theme = "projector"; }});
  const Box before = window.control("top.play");
  window.type_value("k_s", "60");
  REQUIRE(unsaved(window.session));
  window.frames(2);
  CHECK(window.control("top.play").lo == before.lo);
}

TEST_CASE("a number of the report stands where it is said which report, not in a method's name") {
  test::NullUi window;
  CHECK_FALSE(window.drew("(2.15)"));
  window.move(window.middle("constants.integrator"));
  window.until([&] { return window.drew("the report's (2.15)"); }, "the tooltip");
}

TEST_CASE("the lattice's numbers are called by their words") {
  test::NullUi window({.size = {1280, 2000}});
  window.frames(2);
  CHECK(window.drew("rows"));
  CHECK(window.drew("columns"));
}

TEST_CASE("what is left of numbers that cancel is 0 in the picked particle's read-outs") {
  test::NullUi window({.preset = "one_weight", .with = [](Preset& preset) {
                         preset.offset = 4e-16, preset.k = 10, preset.g = 0, preset.k_d = 0;
                       }});
  window.pause();
  window.frames(2);
  const double F_s = window.cloth().particle(0, 0)["F_s"].y;
  REQUIRE(F_s != 0);
  CHECK_FALSE(window.drew("10⁻¹"));
}

TEST_CASE("dragging the slider of k_s changes k_s, and one undo takes the whole drag back") {
  test::NullUi window({.with = [](Preset& preset) { preset.dt = 1e-4; }});
  const auto k_s = [&] { return window.preset().k_s; };
  REQUIRE(k_s() == preset_k_s);
  REQUIRE_FALSE(unsaved(window.session));
  const double start = window.t();
  window.move(window.along("constants.k_s.slider", 0.25f));
  window.press();
  const double low = k_s();
  CHECK(low < preset_k_s);
  window.move(window.along("constants.k_s.slider", 0.5f));
  window.move(window.along("constants.k_s.slider", 0.75f));
  window.frames(2);
  const double high = k_s();
  CHECK(high > preset_k_s);
  CHECK(high / low > 10);  // half of a slider of three decades is a factor of about 32
  CHECK(high / low < 100);
  window.release();
  CHECK(unsaved(window.session));
  const double then = window.t();
  CHECK(then > start);
  window.until([&] { return window.t() > then; }, "the cloth to go on moving");
  CHECK_FALSE(window.diverged());
  window.key(GLFW_KEY_Z, ctrl);
  CHECK(k_s() == preset_k_s);
  CHECK_FALSE(unsaved(window.session));
  window.key(GLFW_KEY_Z, ctrl | GLFW_MOD_SHIFT);
  CHECK(k_s() == high);
}

TEST_CASE("a slider dragged far beyond its ends gives 0 at the left and its largest value at the right") {
  test::NullUi window;
  window.pause();
  const auto along = [&](float part) { return window.along("constants.k_b.slider", part); };
  const float y = along(0).y;
  window.drag({along(0.5f), along(0.1f), {3, y}});
  CHECK(window.preset().k_b == 0);
  window.drag({along(0.01f), along(0.9f), {1200, y}});
  CHECK(window.preset().k_b > 100);
  CHECK(window.torn() == 0);
}

TEST_CASE("a value typed after Ctrl+click is taken; Escape, nonsense and values out of range leave it as it was") {
  test::NullUi window;
  window.pause();
  window.type_value("k_s", "310");
  CHECK(window.preset().k_s == 310);
  const auto& stability = window.session.studies.stability;
  window.until([&] { return stability.limits() && window.preset().dt > stability.limits()->any; },
               "the gauge to say that dt is too long for it");
  window.type_value("k_s", "7", test::NullUi::escape);
  CHECK(window.preset().k_s == 310);
  for (const auto& [text, message] : {std::pair{"abc", "“abc” is not a number; k_s stays at 310 N/m."},
                                      {"1e12", "N/m; it stays at 310 N/m."},
                                      {"-3", "ranges from"},
                                      {"nan", "not a number"},
                                      {"1e999", "“1e999” is out of range; k_s stays at 310 N/m."}}) {
    CAPTURE(text);
    window.type_value("k_s", text);
    CHECK(window.preset().k_s == 310);
    CHECK(window.said(message));
  }
  const std::int64_t steps = window.steps();
  window.type_value("dt", "2e-4");
  CHECK(window.preset().dt == 2e-4);
  CHECK(window.steps() == steps);
  window.key(GLFW_KEY_Z, ctrl);
  window.key(GLFW_KEY_Z, ctrl);
  CHECK(window.preset().k_s == preset_k_s);
  CHECK(window.preset().dt == 1e-3);
}

TEST_CASE("a field whose value was refused keeps the keys, and what is typed next replaces its text") {
  for (const char* wrong : {"abc", "-3"}) {
    CAPTURE(wrong);
    test::NullUi window;
    window.pause();
    const int view = window.preset().mode;
    window.double_click(window.middle("constants.k_s.value"));
    REQUIRE(window.typing());
    window.type(wrong);
    window.key(GLFW_KEY_ENTER);
    window.frames(3);
    CHECK(window.preset().k_s == preset_k_s);
    REQUIRE(window.typing());
    const std::size_t said = window.session.messages.list().size();
    window.type("15");
    window.key(GLFW_KEY_ENTER);
    window.frames(3);
    CHECK(window.preset().k_s == 15);
    CHECK(window.preset().mode == view);
    CHECK_FALSE(window.typing());
    CHECK(window.session.messages.list().size() + 1 == said);  // the warning has had its effect
  }
}

TEST_CASE("a double click on a number lets one type it, also while its slider has the keys; Ctrl+Q quits from there") {
  test::NullUi window;
  window.pause();
  window.click(window.along("constants.k_s.slider", 0.5f));
  window.double_click(window.middle("constants.k_s.value"));
  REQUIRE(window.typing());
  window.type("310");
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  CHECK(window.preset().k_s == 310);
  window.key(GLFW_KEY_Z, ctrl);
  window.key(GLFW_KEY_Z, ctrl);
  CHECK_FALSE(unsaved(window.session));
  window.double_click(window.middle("constants.k_b.value"));
  REQUIRE(window.typing());
  window.key(GLFW_KEY_Q, ctrl);
  CHECK(window.session.quit);
}

TEST_CASE("methods are listed in groups, the report's first, with order and limit, and chosen by pointer or keys") {
  test::NullUi window;
  window.pause();
  window.click("constants.integrator");
  window.frames(3);
  for (const char* words : {"IN THE REPORT", "EXPLICIT", "IMPLICIT", "AS IN GAMES", "order", "dt at most"})
    CHECK(window.drew(words));
  const auto y = [&](const std::string& method) { return window.control("menu." + method).lo.y; };
  CHECK(y("euler") < y("verlet"));
  CHECK(y("verlet") < y("rk4"));
  CHECK(y("rk4") < y("implicit_euler"));
  CHECK(y("implicit_euler") < y("xpbd"));
  window.key(GLFW_KEY_DOWN);
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK(window.preset().integrator == "semi_implicit_euler");  // after verlet
  CHECK_FALSE(window.ui.methods.open);
  window.click("constants.integrator");
  window.frames(3);
  window.click("menu.implicit_midpoint");
  CHECK(window.preset().integrator == "implicit_midpoint");
}

TEST_CASE("a click anywhere on a message takes it away") {
  test::NullUi window;
  window.type_value("k_s", "abc");
  REQUIRE_FALSE(window.session.messages.list().empty());
  CHECK(window.drew("“abc” is not a number"));
  window.click("message.dismiss");
  CHECK(window.session.messages.list().empty());
  CHECK(window.torn() == 0);
}

TEST_CASE("a double click on a slider brings the preset's value back, Ctrl+R those of all constants") {
  test::NullUi window;
  window.pause();
  window.type_value("k_s", "310");
  window.type_value("k_b", "9");
  window.double_click(window.along("constants.k_s.slider", 0.9f));
  CHECK(window.preset().k_s == preset_k_s);
  CHECK(window.preset().k_b == 9);
  window.type_value("k_s", "20");
  window.key(GLFW_KEY_R, ctrl);
  window.frames(2);
  CHECK_FALSE(unsaved(window.session));
}

TEST_CASE("what rows that are typed mean is asked; the rest of the constants stays, and one undo takes it back") {
  test::NullUi window({.with = [](Preset& preset) { preset.k_s = 77, preset.rows = preset.columns = 16; }});
  window.pause();
  const Preset before = window.preset();
  const double far = window.scene.camera.distance;
  const auto type_rows = [&](const char* text) {
    if (!window.sees("constants.rows.value")) window.scroll_to("constants.rows.value", "constants.k_s.value");
    window.type_value("rows", text);
  };
  type_rows("31");
  CHECK(window.drew("16 × 16 → 31 × 16: what is meant?"));
  CHECK(window.preset() == before);  // nothing is built before the answer

  window.click("constants.Same_size_finer");
  window.until([&] { return window.preset().rows == 31; }, "the finer cloth");
  CHECK(window.preset() == with_resolution(before, 2));
  CHECK(window.cloth().lattice().columns == 31);
  CHECK(window.scene.camera.distance == doctest::Approx(far));
  window.rest();
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  window.until([&] { return window.preset() == before; }, "one undo to take it back");

  type_rows("31");
  window.type_value("columns", "61");
  CHECK(window.drew("31 × 61"));
  CHECK_FALSE(window.drew("Same size"));  // the cloth has other proportions
  window.key(GLFW_KEY_ENTER, GLFW_MOD_SHIFT);
  window.until([&] { return window.preset().columns == 61; }, "more cloth");
  Preset more = before;
  more.rows = 31, more.columns = 61;
  CHECK(window.preset() == more);
  CHECK(window.scene.camera.distance > 1.5 * far);  // all of it is seen

  type_rows("16");
  CHECK(window.drew("Less cloth"));
  window.key(GLFW_KEY_ESCAPE);
  window.frames(2);
  CHECK_FALSE(window.drew("what is meant?"));
  type_rows("1");
  CHECK(window.preset() == more);
}

TEST_CASE("a slider in use takes the arrow keys for itself; once left, → steps again") {
  test::NullUi window;
  window.pause();
  const std::int64_t before = window.steps();
  window.click(window.along("constants.k_s.slider", 0.5f));
  const double value = window.preset().k_s;
  for (int n = 0; n < 3; ++n) window.key(GLFW_KEY_RIGHT);
  CHECK(window.preset().k_s > 1.05 * value);
  CHECK(window.steps() == before);
  window.key(GLFW_KEY_ESCAPE);
  window.key(GLFW_KEY_RIGHT);
  CHECK(window.steps() == before + 1);
}

TEST_CASE("the integrator is switched while the cloth moves, and the motion goes on") {
  test::NullUi window({.with = [](Preset& preset) { preset.dt = 1e-4; }});
  for (const std::string name : {"euler", "improved_euler", "verlet"}) {
    CAPTURE(name);
    window.click("constants.integrator");
    window.click("menu." + name);
    CHECK(window.preset().integrator == name);
    const double t = window.t();
    const std::int64_t steps = window.steps();
    CHECK(t > 0);
    window.until([&] { return window.steps() > steps + 20; }, "the motion to go on");
    CHECK(window.t() > t);
    CHECK_FALSE(window.diverged());
  }
}

TEST_CASE("a tooltip stands where it belongs once the window sleeps") {
  for (const std::string name : {"top.help", "top.labs", "constants.k_s.slider", "viewport.views.5"}) {
    CAPTURE(name);
    test::NullUi window({.size = {900, 600}});
    window.pause();
    window.until([&] { return window.session.studies.stability.limits().has_value(); }, "what it tells of");
    window.move(window.middle(name));
    window.until([&] { return window.ui.tooltip.has_value(); }, "the tooltip to be measured");
    for (int n = 0; n < 9 && window.ui.draw_by <= window.ui.now; ++n) window.frame();
    const auto asleep = window.tooltip();
    REQUIRE(asleep.has_value());
    CHECK(asleep->lo.x >= 0);
    CHECK(asleep->lo.y >= 0);
    CHECK(asleep->hi.x <= 900);
    CHECK(asleep->hi.y <= 600);
    window.frames(4);
    CHECK(window.tooltip()->lo == asleep->lo);
    CHECK(window.tooltip()->hi == asleep->hi);
  }
}

TEST_CASE("a tooltip stands beside its row and hides no constant; while the help is open there is none") {
  for (const auto& [size, scale] : {std::pair{glm::ivec2{1280, 720}, 1.0}, {{900, 600}, 1.5}}) {
    CAPTURE(size.x);
    test::NullUi window({.size = size, .settings = [scale](Settings& settings) { settings.ui_scale = scale; }});
    window.until([&] { return window.t() > 0.3; }, "labels of arrows to stand over the cloth");
    window.pause();
    window.move(window.middle("constants.k_s.slider"));
    window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
    // Which add lines to it, whenever they come; marks make room in the frame after.
    window.until([&] { return window.session.studies.stability.limits().has_value(); }, "its limits");
    window.frames(30);
    REQUIRE(window.tooltip().has_value());
    int seen = 0;
    for (const std::string name : {"dt.slider", "dt.value", "k_b.value", "k_d.slider", "k_d.value", "g.slider"}) {
      CAPTURE(name);
      if (!window.sees("constants." + name)) continue;
      CHECK_FALSE(overlap(*window.tooltip(), window.control("constants." + name)));
      ++seen;
    }
    CHECK(seen >= 2);
    for (const auto& mark : window.ui.placing.marks()) {
      CAPTURE(mark.name);
      CHECK_FALSE(overlap(*window.tooltip(), mark.box));
    }
    window.rest();
    CHECK_FALSE(window.tooltip().has_value());
    window.key(GLFW_KEY_F1);
    window.frames(4);
    window.move(window.middle("constants.k_s.slider"));
    window.frames(90);
    CHECK_FALSE(window.tooltip().has_value());
  }
}

TEST_CASE("a key hides the tooltip, so that it covers no list that the key opens, until the pointer moves") {
  test::NullUi window;
  window.pause();
  window.move(window.middle("top.menu"));
  window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
  window.key(GLFW_KEY_L, GLFW_MOD_CONTROL);
  window.frames(90);
  CHECK_FALSE(window.tooltip().has_value());
  window.key(GLFW_KEY_ESCAPE);
  window.frames(90);
  CHECK_FALSE(window.tooltip().has_value());
  window.move(window.middle("top.menu") + glm::vec2(1, 0));
  window.frames(90);
  CHECK(window.tooltip().has_value());
}

TEST_CASE(
    "the gauge under dt explains itself: each of its marks, and the bar between them, has a tooltip that appears") {
  test::NullUi window;
  window.pause();
  const auto& limits = window.session.studies.stability.limits();
  window.until([&] { return limits && limits->now && limits->now < 2 * limits->any; }, "the limits");
  const auto says = [&](const char* control, const char* words) {
    CAPTURE(std::string(control));
    window.rest();
    window.frames(3);
    CHECK_FALSE(window.tooltip().has_value());
    const Box box = window.control(std::string("constants.") + control);
    const bool bar = std::string(control) == "stability";
    window.move({bar ? box.lo.x + 3 : (box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2});
    window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
    window.frames(2);
    CHECK(window.drew(words));
  };
  says("gauge_worst_case", "Line: the worst-case limit,");
  says("gauge_this_cloth", "Dot: this cloth's own limit as it hangs now");
  says("gauge_every_shape", "is unstable in every shape in which a spring pulls");
  says("gauge_dt", "of this cloth's as it hangs now.");
  says("stability", "Stable in any shape: dt is");
}

TEST_CASE("the tooltip of k_s says in which zone it is: at 180 N/m on lab 03's sheet it depends on the shape") {
  test::NullUi window({.preset = "taut_sheet", .with = [](Preset& preset) {
                         preset.integrator = "verlet", preset.dt = 1e-3, preset.k_s = 180, preset.k_d = 0;
                       }});
  window.pause();
  const auto& limits = window.session.studies.stability.limits();
  window.until([&] { return limits && limits->now; }, "the limits");
  window.move(window.along("constants.k_s.slider", 0.5f));
  window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
  window.frames(2);
  CHECK(window.drew("Depends on the shape: dt is"));
  CHECK(window.drew(
      "stable in any shape up to 133 N/m, depends on the shape up to 1600 N/m, unstable in every shape above that"));
}

TEST_CASE("the tooltip of k_s says that it acts on nothing where the springs of every direction have their own") {
  for (const bool all : {false, true}) {
    CAPTURE(all);
    test::NullUi window({.with = [&](Preset& preset) {
      preset.k_warp = preset.k_weft = 80;
      if (all) preset.k_shear = 20;
    }});
    window.pause();
    window.move(window.along("constants.k_s.slider", 0.5f));
    window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
    window.frames(2);
    CHECK(window.drew("It has no effect while k_warp, k_weft and k_shear are set.") == all);
    window.key(GLFW_KEY_M);
    window.frames(6);
    CHECK(window.drew("K_s has no effect") == false);
    CHECK(window.drew("so there is no map over it.") == all);
  }
}

TEST_CASE("a typed value makes the slider longer on its side alone, until it is reset") {
  test::NullUi window;
  window.pause();
  const auto at = [&](float part) {
    window.frames(60);  // two clicks in a row are a double click
    window.click(window.along("constants.k_s.slider", part));
    const double value = window.preset().k_s;
    window.key(GLFW_KEY_Z, ctrl);
    return value;
  };
  const double low = at(0.2f), high = at(0.9f);
  CHECK(at(0.01f) == 0);
  window.type_value("k_s", "1e5");
  CHECK(at(0.01f) == 0);  // 0 stays at the left
  CHECK(at(0.9f) > 20 * high);
  CHECK(at(0.9f) < 1e5);  // so that 1e5 is near the end, not in the middle
  CHECK(at(0.2f) < 10 * low);
  window.type_value("k_s", "60");
  CHECK(at(0.9f) > 20 * high);  // it does not shrink under the hand
  window.frames(60);
  window.double_click(window.along("constants.k_s.slider", 0.5f));
  CHECK(window.preset().k_s == preset_k_s);
  CHECK(at(0.9f) == doctest::Approx(high));
  CHECK(at(0.2f) == doctest::Approx(low));
}

}  // namespace tyglab::constants_test
