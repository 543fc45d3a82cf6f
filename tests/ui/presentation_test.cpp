// Presentation mode on a projector: what a lecture shows is whole, and what it needs is at hand.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/base/glfw_keys.h"
#include "app/session/lab_state.h"
#include "tests/ui/null_ui.h"

namespace tyglab::presentation_test {

test::UiOptions projector(glm::ivec2 size = {1280, 720}, const char* preset = "hanging") {
  return {.preset = preset, .size = size, .settings = [](Settings& settings) { settings.theme = "projector"; }};
}

/// Nothing that can be used is cut by the edge of the column beside the cloth.
void check_whole(test::NullUi& window) {
  for (const std::string& name : window.cut_at_sides()) {
    CAPTURE(name);
    CHECK_FALSE(name.starts_with("plots."));
  }
}

TEST_CASE("every card beside the cloth is whole on a projector, and the cloth keeps its two thirds") {
  test::NullUi window(projector());
  window.until([&] { return window.t() > 0.1; }, "the cloth to fall a little");
  window.pause();
  window.key(GLFW_KEY_F5);
  window.key(GLFW_KEY_M);
  window.key(GLFW_KEY_I);
  window.frames(6);
  for (const char* name : {"Forces", "Copies", "Stability", "Map", "Accuracy", "Energy", "Step", "Performance"}) {
    CAPTURE(std::string(name));
    window.click("plots.cards");  // a list: no rows of tabs that take the card's height
    window.click("menu." + std::string(name));
    window.frames(6);
    CHECK(window.ui.plots.tab == name);
    check_whole(window);
    const glm::vec2 cloth = window.ui.viewport.size();
    CHECK(cloth.x * cloth.y >= 0.65f * 1280 * 720);
  }
  CHECK(window.drew("positions are drawn from"));
  CHECK(window.drew("a copy"));
  window.find("inside a step");
  window.until([&] { return window.drew("particle (16, 16)"); }, "the step");
  CHECK_FALSE(window.drew("..."));
}

TEST_CASE("an audience reads the axes, every arrow has its symbol, and the cloth is large") {
  for (const glm::ivec2 size : {glm::ivec2(1920, 1080), glm::ivec2(1280, 720), glm::ivec2(900, 600)}) {
    CAPTURE(size.x);
    test::NullUi window({.size = size, .settings = [](Settings& settings) {
                           for (const char* key : {"F_s", "F_b", "F_d", "F_g", "F_int", "F_ext", "F", "v", "a"})
                             settings.handling.arrows.insert(key);
                         }});
    window.until([&] { return window.t() > 0.4; }, "the cloth to fall");
    window.pause();
    CHECK(window.ui.fonts.axis == window.ui.fonts.small);
    window.key(GLFW_KEY_F5);
    window.frames(6);
    CHECK(window.ui.fonts.axis->FontSize >= 0.025f * float(size.y));
    const glm::vec2 view = window.ui.viewport.size();
    CHECK(view.x >= 0.65f * float(size.x));
    const Box* bar = window.ui.placing.find("scale N");
    REQUIRE(bar != nullptr);
    CHECK(bar->hi.y - bar->lo.y >= window.ui.fonts.axis->FontSize);
    CHECK(bar->hi.y < window.ui.viewport.box.hi.y);
    const auto part = part_of_picture(window.scene.camera, bounds(window.cloth().positions()), view.x / view.y);
    REQUIRE(part.has_value());
    CHECK(part->hi.y - part->lo.y > 0.75f);
    const ParticleReadout r = window.cloth().particle(window.session.picked->i, window.session.picked->j);
    int drawn = 0;
    for (const char* key : {"F_s", "F_b", "F_d", "F_g", "F_int", "F_ext", "F", "v", "a"}) {
      const std::string name(key);
      const double scale = window.ui.arrow_scales[name == "v" ? 1 : name == "a" ? 2 : 0];
      // In perspective one that points at the eye is short; those that are long for sure are asked for.
      const glm::dvec3 x = r.x, to = r.x + glm::normalize(r[key]) * glm::length(r[key]) / scale * 90.0 *
                                               double(window.ui.theme.scale) *
                                               window.scene.camera.metres_per_pixel(r.x, view.y);
      const auto from = window.scene.camera.project(x, view), end = window.scene.camera.project(to, view);
      if (glm::length(r[key]) == 0 || !from || !end || glm::distance(*from, *end) < window.ui.theme.px(11)) continue;
      ++drawn;
      CAPTURE(name);
      CHECK(window.ui.placing.find("label 0 " + std::string(variable(key).symbol)) != nullptr);
    }
    CHECK(drawn >= 4);
    window.key(GLFW_KEY_F5);
    window.frames(3);
    CHECK(window.ui.fonts.axis == window.ui.fonts.small);
  }
}

TEST_CASE("an audience reads every text, and the cloth keeps its width beside a card and beside a lab") {
  for (const glm::ivec2 size : {glm::ivec2(1920, 1080), glm::ivec2(2560, 1440), glm::ivec2(1280, 720)}) {
    CAPTURE(size.x);
    test::NullUi window({.size = size});
    window.pause();
    window.key(GLFW_KEY_F5);
    window.frames(6);
    CHECK(window.ui.fonts.small->FontSize >= 0.02f * float(size.y));
    CHECK(window.ui.viewport.size().x >= 0.65f * float(size.x));
    check_whole(window);
    find_labs(window.session);
    begin_lab(window.session, "01_hooke");
    window.frames(6);
    CHECK(window.sees("lab.prediction"));
    CHECK(window.ui.viewport.size().x >= 0.65f * float(size.x));
    for (const std::string& text : window.cut_texts()) {
      CAPTURE(text);
      CHECK_FALSE(text.starts_with("lab"));
      CHECK_FALSE(text.starts_with("podium"));
    }
    window.key(GLFW_KEY_F5);
    window.frames(3);
    CHECK(window.ui.theme.scale == 1);
  }
}

TEST_CASE("on a projector the engine's menu keeps its place at every speed") {
  test::NullUi window(projector());
  window.frames(3);
  REQUIRE(window.sees("top.engine"));
  const glm::vec2 before = window.middle("top.engine");
  window.session.pacing.speed = 1.0 / 16;  // a quarter of a quarter: no speed that is always offered
  window.frames(3);
  REQUIRE(window.sees("top.engine"));
  CHECK(window.middle("top.engine") == before);
}

TEST_CASE("what brings the panels back is said no longer once they are back") {
  test::NullUi window(projector());
  window.key(GLFW_KEY_F5);
  CHECK(window.said("brings the panels back"));
  window.key(GLFW_KEY_ESCAPE);
  CHECK_FALSE(window.ui.presenting);
  CHECK_FALSE(window.said("brings the panels back"));
}

TEST_CASE("on a projector the three sides of Accuracy are reached, and the search with its button") {
  test::NullUi window(projector());
  window.pause();
  window.key(GLFW_KEY_F5);
  window.find("find settings for an error");
  window.frames(4);
  CHECK(window.drew("Find settings"));
  CHECK(window.sees("plots.target"));
  CHECK(window.sees("plots.Find"));
  check_whole(window);
  window.click("plots.accuracy_ways.2");
  window.frames(4);
  CHECK(window.sees("plots.csv_convergence"));
  CHECK_FALSE(overlap(window.control("plots.csv_convergence"), window.control("plots.accuracy_ways.2")));
  CHECK_FALSE(overlap(window.control("plots.again"), window.control("plots.accuracy_ways.3")));
}

TEST_CASE("a search for settings goes on while another card is in front, and ends with its card") {
  test::NullUi window;
  window.pause();
  window.find("find settings for an error");
  window.frames(4);
  window.click("plots.Find");
  window.frames(3);
  REQUIRE(window.session.studies.settings.tolerance().has_value());
  window.key(GLFW_KEY_F5);
  window.frames(4);
  window.find("forces card");
  window.frames(4);
  CHECK(window.session.studies.settings.tolerance().has_value());
  window.key(GLFW_KEY_F5);
  window.frames(4);
  CHECK(window.session.studies.settings.tolerance().has_value());
  window.find("accuracy card");
  window.click("plots.Accuracy");
  window.frames(4);
  CHECK_FALSE(window.session.studies.settings.tolerance().has_value());
}

TEST_CASE("presentation mode has the projector's size of text in every theme") {
  std::vector<float> presented;
  for (const char* theme : {"dark", "light", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window({.settings = [theme](Settings& settings) { settings.theme = theme; }});
    window.frames(2);
    const float before = window.ui.theme.scale;
    window.key(GLFW_KEY_F5);
    window.frames(3);
    presented.push_back(window.ui.theme.scale);
    window.key(GLFW_KEY_F5);
    window.frames(3);
    CHECK(window.ui.theme.scale == before);
  }
  CHECK(presented[0] > 1.3f);
  CHECK(presented[1] == presented[0]);
  CHECK(presented[2] == presented[0]);
}

TEST_CASE("presentation mode says how near to real time it runs") {
  for (const char* theme : {"dark", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window({.settings = [theme](Settings& settings) { settings.theme = theme; }});
    window.key(GLFW_KEY_F5);
    window.frames(6);
    CHECK(window.sees("podium.real_time"));
  }
}

TEST_CASE("the palette finds a copy by its method's key") {
  test::NullUi window;
  window.pause();
  window.find("add a copy: rk4");
  window.until([&] { return window.session.copies.lockstep.size() == 1; }, "the copy");
  CHECK(window.session.copies.lockstep[0].simulation->preset().integrator == "rk4");
}

}  // namespace tyglab::presentation_test
