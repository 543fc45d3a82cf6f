// Cards at the right that have little room: scrolling, commands that open them; and the cloth in its picture.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "app/base/glfw_keys.h"
#include "tests/ui/null_ui.h"

namespace tyglab::layout_test {

test::UiOptions options(const std::string& preset, double scale = 1, const char* theme = "dark",
                        glm::ivec2 size = {1280, 720}) {
  return {.preset = preset, .size = size, .settings = [=](Settings& settings) {
            settings.ui_scale = scale, settings.theme = theme;
          }};
}

/// Whether a control is there, within the window, and at least so high.
bool whole(test::NullUi& window, const std::string& name, float height) {
  if (!window.sees(name)) return false;
  const Box box = window.control(name);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  return box.hi.y - box.lo.y >= height && box.lo.x >= 0 && box.hi.x <= size.x + 1 && box.hi.y <= size.y + 1;
}

/// The particles of a row, or of all of five rows, stand in the (first) picture, below the buttons.
void check_in_picture(test::NullUi& window, bool first_row_alone) {
  const Viewport& viewport = window.ui.viewport;
  const glm::vec2 lo = viewport.box.lo, hi = lo + viewport.size();
  const Lattice& lattice = window.cloth().lattice();
  for (int k = 0; k < (first_row_alone ? 1 : 5); ++k)
    for (int l = 0; l < 5; ++l) {
      const glm::vec2 at = window.pixel_of(k * (lattice.rows - 1) / 4, l * (lattice.columns - 1) / 4);
      CAPTURE(k);
      CAPTURE(l);
      CHECK(at.x >= lo.x);
      CHECK(at.x <= hi.x);
      CHECK(at.y >= lo.y + viewport.buttons - 1);
      CHECK(at.y <= hi.y);
    }
}

void to_projector(test::NullUi& window) {
  for (int n = 0; n < 2; ++n) window.key(GLFW_KEY_T, GLFW_MOD_CONTROL);
  window.frames(6);
  REQUIRE(window.settings.theme == "projector");
}

TEST_CASE("with large text the plots keep a height at which they are read, and the column scrolls") {
  for (const auto& [scale, theme] : {std::pair{2.0, "dark"}, {2.6, "dark"}, {1.5, "projector"}}) {
    CAPTURE(scale);
    test::NullUi window(options("hanging", scale, theme));
    window.find("forces card");
    window.scroll_to("plots.force_plot", "plots.source.1");
    CHECK(whole(window, "plots.force_plot", 60));
    window.scroll_to("plots.curve.F_ext", "plots.force_plot");
    window.key(GLFW_KEY_M);
    window.frames(4);
    if (!window.sees("plots.map")) window.scroll_to("plots.map", "plots.close_map");
    CHECK(whole(window, "plots.map", 60));
  }
}

TEST_CASE("every card is opened by its heading and found by the palette, comes into sight, and hides no other") {
  const std::vector<std::string> names{"Copies", "Stability", "Accuracy", "Energy", "Performance"};
  for (const double scale : {1.0, 1.5, 2.6}) {
    CAPTURE(scale);
    test::NullUi window(options("hanging", scale));
    window.find("forces card");
    for (const std::string& name : names) {
      CAPTURE(name);
      window.find(name + " card");
      window.frames(4);
      CHECK(window.sees("plots." + name));
      CHECK(window.session.wants.forces);  // the plot stays, seen or scrolled to
      if (name == "Energy") CHECK(window.cloth().ledger().has_value());
    }
    CHECK(window.cloth().ledger().has_value());  // it is open still
    CHECK(window.session.wants.accuracy);
  }
  test::NullUi window(options("hanging", 1, "dark", {1920, 1200}));
  window.click("plots.Energy");
  window.frames(4);
  float above = 0;
  for (const std::string& name : names) {
    const Box heading = window.control("plots." + name);
    if (name == "Copies" || name == "Stability") above = heading.hi.y;
    if (name == "Accuracy") CHECK(heading.lo.y >= above);  // the order stays
  }
  CHECK(window.sees("plots.force_plot"));
  window.click("plots.Energy");
  window.frames(4);
  CHECK_FALSE(window.cloth().ledger().has_value());
}

TEST_CASE("the button of Copies is reached with none and with four of them, beside map and step") {
  for (const auto& [scale, theme] : {std::pair{1.0, "projector"}, {2.0, "light"}}) {
    CAPTURE(scale);
    test::NullUi window(options("flag", scale, theme));
    window.pause();
    window.key(GLFW_KEY_M);
    window.key(GLFW_KEY_I);
    window.find("copies card");
    for (std::size_t count = 1; count < 5; ++count) {
      CAPTURE(count);
      if (count > 1) window.find("copies card");
      window.frames(4);
      if (!window.sees("plots.add")) window.scroll_to("plots.add", "plots.Copies");
      const Box button = window.control("plots.add");
      CHECK(button.hi.y - button.lo.y >= 29 * scale);  // it is seen whole
      window.add_copy("Equal_copy");
      CHECK(window.session.copies.lockstep.size() == count);
      window.frames(4);
    }
    if (!window.sees("plots.add")) window.scroll_to("plots.add", "plots.Copies");
    CHECK(window.sees("plots.add"));
  }
}

TEST_CASE("M and I open their card in its place, in sight, and close it again") {
  test::NullUi window(options("hanging"));
  window.key(GLFW_KEY_M);
  window.frames(4);
  CHECK(whole(window, "plots.map", 100));
  CHECK(whole(window, "plots.close_map", 10));
  window.until([&] { return window.session.studies.map.findings().has_value(); }, "the map");
  window.key(GLFW_KEY_I);
  window.frames(4);
  CHECK(window.sees("plots.close_inside"));
  CHECK(window.session.wants.map);
  window.key(GLFW_KEY_M);
  window.frames(4);
  CHECK_FALSE(window.sees("plots.map"));
  CHECK_FALSE(window.session.studies.map.findings().has_value());
  CHECK(window.sees("plots.close_inside"));
  window.key(GLFW_KEY_I);
  window.frames(4);
  CHECK_FALSE(window.sees("plots.close_inside"));
}

TEST_CASE("the cloth is framed anew for each size of its picture, below the buttons, until the camera is in hand") {
  for (const auto& [preset, first_row_alone] : {std::pair{"hanging", true}, {"denim", true}, {"flag", false}}) {
    CAPTURE(std::string(preset));
    test::NullUi window(options(preset));
    window.pause();
    window.frames(4);
    check_in_picture(window, first_row_alone);
    window.find("copies card");
    window.add_copy("Equal_copy");
    window.frames(6);
    check_in_picture(window, first_row_alone);
    to_projector(window);
    check_in_picture(window, first_row_alone);
  }
  for (const double scale : {1.5, 2.0}) {
    test::NullUi window(options("hanging", scale));
    window.pause();
    window.frames(6);
    check_in_picture(window, true);
  }
  test::NullUi window(options("hanging"));
  const Box box = window.ui.viewport.box;
  window.move((box.lo + box.hi) / 2.f);
  window.wheel(1);
  window.frames(4);
  const Camera by_hand = window.scene.camera;
  to_projector(window);
  CHECK(window.scene.camera == by_hand);  // a view of one's own stays
  window.key(GLFW_KEY_F);
  window.frames(2);
  CHECK_FALSE(window.scene.camera == by_hand);
}

TEST_CASE("where the text leaves no room beside the cloth, constants, plots and cloth take turns in the whole window") {
  test::NullUi window(options("hanging", 2.6, "dark", {900, 600}));
  REQUIRE(window.sees("side.columns.3"));
  CHECK(window.ui.viewport.whole().x == 900);
  window.click("side.columns.1");
  CHECK((window.sees("constants.k_s.slider") || window.sees("constants.dt.slider")));
  window.find("forces card");
  CHECK(window.sees("plots.source.1"));
  window.click("side.columns.3");
  CHECK(window.ui.viewport.whole().x == 900);
  // What is plotted of the past goes on meanwhile.
  CHECK(window.session.wants.forces);
  const std::size_t before = window.session.recorded.forces.size(), gaps = window.session.recorded.forces.gaps().size();
  window.frames(20);
  CHECK(window.session.recorded.forces.size() > before);
  CHECK(window.session.recorded.forces.gaps().size() == gaps);
}

TEST_CASE("where a lab's strip would leave the plots too low, they take its place; it is seen with the constants") {
  for (const auto& [scale, size] : {std::pair{2.0, glm::ivec2(1280, 720)}, {2.6, {1280, 720}}, {2.6, {900, 600}}}) {
    CAPTURE(scale);
    CAPTURE(size.x);
    test::NullUi window(options("hanging", scale, "dark", size));
    window.find("not smooth");
    window.frames(3);
    REQUIRE(window.session.labs.run.has_value());
    CHECK(window.sees("lab.leave"));
    window.find("accuracy card");
    window.frames(4);
    CHECK(window.sees("plots.Accuracy"));
    CHECK_FALSE(window.sees("lab.leave"));
    CHECK(window.session.labs.run.has_value());
    window.click("side.columns.1");
    CHECK(window.sees("lab.leave"));
  }
}

TEST_CASE("a lab begins without the copies that were there, and says so") {
  test::NullUi window(options("hanging"));
  window.find("copies card");
  window.add_copy("Euler");
  window.find("not smooth");
  window.frames(2);
  CHECK(window.session.labs.run.has_value());
  CHECK(window.session.copies.lockstep.empty());
  CHECK(window.said("Your copies come back when you leave it."));
  CHECK(window.ui.viewport.columns * window.ui.viewport.rows == 1);
}

/// Every control stands within the window, and none of the top bar over another.
void check_controls(test::NullUi& window) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  std::vector<Box> bar;
  for (const auto& [name, box] : window.controls()) {
    CAPTURE(name);
    CHECK(box.lo.x >= -1);
    CHECK(box.lo.y >= -1);
    CHECK(box.hi.x <= size.x + 1);
    CHECK(box.hi.y <= size.y + 1);
    if (!name.starts_with("top.")) continue;
    const Box inner{box.lo + 1.f, box.hi - 1.f};
    for (const Box& other : bar) CHECK_FALSE(overlap(inner, other));
    bar.push_back(box);
  }
  CHECK(window.sees("top.play"));
}

TEST_CASE("at every size of the window its controls stay within it and apart, and the cloth keeps room") {
  for (const double scale : {1.0, 2.0}) {
    CAPTURE(scale);
    test::NullUi window(options("hanging", scale));
    for (const glm::ivec2 size : {glm::ivec2{900, 600}, {1560, 960}, {640, 400}, {480, 320}, {1280, 720}}) {
      CAPTURE(size.x);
      window.resize(size);
      check_controls(window);
      if (scale != 1) continue;
      CHECK(window.ui.viewport.whole().x >= 200);
      CHECK(window.ui.viewport.whole().y >= 200);
    }
  }
}

TEST_CASE("where both columns have no room, tabs choose one; what asks for a card, or for a constant, brings it") {
  test::NullUi window(options("hanging", 1, "dark", {700, 600}));
  CHECK(window.sees("side.columns.2"));
  CHECK(window.sees("constants.k_s.slider"));
  window.click("side.columns.2");
  CHECK(window.sees("plots.Stability"));
  CHECK_FALSE(window.sees("constants.k_s.slider"));
  check_controls(window);
  window.click("side.columns.1");
  CHECK(window.sees("constants.k_s.slider"));
  window.key(GLFW_KEY_M);
  window.frames(4);
  CHECK(window.sees("plots.map"));
  window.find("constant, stretching");
  CHECK(window.sees("constants.k_s.slider"));
  window.key(GLFW_KEY_ESCAPE);
  window.key(GLFW_KEY_M);  // to the front
  window.frames(4);
  window.key(GLFW_KEY_M);
  window.resize({1280, 720});
  CHECK_FALSE(window.sees("side.columns.1"));
  CHECK(window.sees("constants.k_s.slider"));
  CHECK(window.sees("plots.Stability"));
}

TEST_CASE("the borders between the regions drag within limits, the cloth gets what is left, and nothing is cut") {
  constexpr float least = 240, most = 900;
  for (const int width : {1280, 1920}) {
    CAPTURE(width);
    test::NullUi window(options("hanging", 1, "dark", {width, 720}));
    const Box& box = window.ui.viewport.box;
    const float y = box.lo.y + 300, left = box.lo.x, right = box.hi.x;
    REQUIRE(left - 20 > least);
    window.drag({{left, y}, {left - 10, y}, {left - 20, y + 10}});
    window.frames(2);
    CHECK(std::abs(box.lo.x - (left - 20)) <= 2);
    CHECK(box.hi.x == right);
    // Wider than what a column has of such a window as long as nobody drags it.
    window.drag({{right, y}, {right - 30, y}, {right - 80, y - 10}});
    window.frames(2);
    CHECK(std::abs(box.hi.x - (right - 80)) <= 2);
    CHECK(std::abs(box.lo.x - (left - 20)) <= 2);
    CHECK(window.torn() == 0);
    CHECK(std::abs(window.settings.layout.left_width - (left - 20)) <= 2);  // remembered
    CHECK(std::abs(window.settings.layout.right_width - (float(width) - right + 80)) <= 2);
    const glm::vec2 border{box.lo.x, y};
    window.drag({border, {border.x - 200, y}});
    window.frames(2);
    CHECK(box.lo.x == least);
    window.drag({{least, y}, {least + most, y}});
    window.frames(2);
    CHECK(window.settings.layout.left_width <= most);
    CHECK(window.ui.viewport.whole().x >= least);  // the cloth keeps its place
  }
}

TEST_CASE("Ctrl and + or - change the size of text, Ctrl+0 brings it back, and a small window keeps its controls") {
  test::NullUi window(options("hanging"));
  const auto height = [&] {
    const Box row = window.control("constants.k_s.slider");
    return row.hi.y - row.lo.y;
  };
  const float before = height();
  for (int n = 0; n < 4; ++n) window.key(GLFW_KEY_EQUAL, GLFW_MOD_CONTROL);
  const float larger = height();
  CHECK(larger > 1.3f * before);
  check_controls(window);
  window.key(GLFW_KEY_MINUS, GLFW_MOD_CONTROL);
  CHECK(height() < larger);
  for (int n = 0; n < 6; ++n) window.key(GLFW_KEY_EQUAL, GLFW_MOD_CONTROL);
  window.resize({640, 400});
  check_controls(window);
  window.resize({1280, 720});
  window.key(GLFW_KEY_0, GLFW_MOD_CONTROL);
  CHECK(height() == before);
}

TEST_CASE("the cloth has six tenths of a window of 1280 pixels, until a column is dragged wider") {
  for (const char* theme : {"dark", "light"}) {
    test::NullUi window(options("hanging", 1, theme));
    const auto width = [&] { return window.ui.viewport.whole().x; };
    CHECK(width() >= 0.6f * 1280);
    const float before = width();
    const glm::vec2 border{window.ui.viewport.box.lo.x, 400};
    window.drag({border, border + glm::vec2(40, 0)});
    window.frames(3);
    CHECK(width() == doctest::Approx(before - 40).epsilon(0.01));
  }
}

TEST_CASE("panels that are hidden during a lab leave its name") {
  test::NullUi window(options("hanging"));
  begin_lab(window.session, "01_hooke");
  window.frames(4);
  window.key(GLFW_KEY_TAB);
  window.frames(4);
  CHECK(window.drew("Lab: " + window.session.labs.run->lab.title + " · Tab shows the panels"));
}

TEST_CASE("Tab hides the panels and brings them back; neither that nor a view changes the preset") {
  test::NullUi window(options("hanging"));
  const Box before = window.ui.viewport.box;
  window.key(GLFW_KEY_4);
  CHECK(window.preset().mode == 4);
  window.key(GLFW_KEY_TAB);
  window.frames(2);
  CHECK(window.ui.viewport.whole() == glm::vec2(1280, 720));
  CHECK_FALSE(window.sees("constants.k_s.slider"));
  CHECK(window.drew("Tab shows the panels"));
  window.click("viewport.show_panels");
  window.frames(2);
  CHECK(window.ui.viewport.box.lo == before.lo);
  CHECK(window.ui.viewport.box.hi == before.hi);
  window.key(GLFW_KEY_F1);
  CHECK(window.ui.help);
  window.frames(2);
  CHECK(window.drew("pins or unpins a particle"));
  window.key(GLFW_KEY_ESCAPE);
  CHECK_FALSE(window.ui.help);
  CHECK_FALSE(unsaved(window.session));
}

TEST_CASE("Ctrl+T goes through the themes and round again, and each colors the panels and the cloth's ground") {
  test::NullUi window(options("hanging"));
  const auto brightness = [](ImU32 color) { return (color & 255) + (color >> 8 & 255) + (color >> 16 & 255); };
  const auto panel = [&] { return brightness(window.ui.theme.colors.panel); };
  CHECK(window.settings.theme == "dark");
  CHECK(panel() < 200);
  const float scale = window.ui.theme.scale;
  for (const auto& [name, light, larger] :
       {std::tuple{"light", true, false}, {"projector", true, true}, {"dark", false, false}}) {
    CAPTURE(name);
    window.key(GLFW_KEY_T, GLFW_MOD_CONTROL);
    window.frames(2);
    CHECK(window.settings.theme == name);
    CHECK((panel() > 600) == light);
    CHECK((window.ui.theme.scale > scale) == larger);
    CHECK((ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x > 0.7f) == light);
  }
}

TEST_CASE("presentation mode gives the cloth two thirds of the window, and keeps at hand what a lecture needs") {
  for (const char* theme : {"dark", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window(options("hanging", 1, theme));
    window.key(GLFW_KEY_F5);
    window.frames(6);
    const glm::vec2 cloth = window.ui.viewport.size();
    CHECK(cloth.x * cloth.y >= 0.65f * 1280 * 720);
    for (const char* name : {"podium.play", "podium.step", "podium.restart", "podium.k_s.slider", "podium.dt.slider",
                             "podium.speed.4", "podium.present", "podium.card"}) {
      CAPTURE(std::string(name));
      CHECK(whole(window, name, 20));
    }
    window.until([&] { return window.sees("podium.stability"); }, "the gauge");
    CHECK_FALSE(window.sees("top.play"));
    CHECK(window.session.wants.forces);
    window.click("podium.card");
    window.frames(3);
    CHECK(window.ui.viewport.size().x == 1280);
    CHECK_FALSE(window.session.wants.forces);
    const double dt = window.preset().dt;
    window.click(window.along("podium.dt.slider", 0.2f));
    window.frames(3);
    CHECK(window.preset().dt < dt);
    window.click("podium.present");
    window.frames(6);
    CHECK(window.sees("top.play"));
  }
}

TEST_CASE("Escape leaves presentation mode once it has nothing else to end") {
  test::NullUi window;
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK_FALSE(window.ui.presenting);  // it does not begin it
  window.key(GLFW_KEY_F5);
  window.key(GLFW_KEY_P, GLFW_MOD_CONTROL);
  window.frames(3);
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK_FALSE(window.ui.palette.open);
  CHECK(window.ui.presenting);
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK_FALSE(window.ui.presenting);
}

TEST_CASE("the status line says how to grab and cut, whatever there is to tell of the cloth") {
  for (const float width : {900.f, 1280.f}) {
    CAPTURE(width);
    test::NullUi window(options("hanging", 1, "projector", {int(width), 720}));
    window.pause();
    window.frames(6);
    CHECK(window.drew("Right drag"));
    CHECK(window.drew("Left drag"));
    CHECK(window.drew("cuts"));
  }
}

TEST_CASE("where rounding keeps forces from balancing, the status line says so with the cure") {
  test::NullUi window({.preset = "sphere", .with = [](Preset& preset) {
                         preset.k_s = 1e4, preset.k_b = 0, preset.dt = 0.01, preset.integrator = "implicit_midpoint";
                       }});
  window.until([&] { return window.steps() >= 3; }, "three steps");
  window.pause();
  window.frames(3);
  CHECK(window.drew("steps unbalanced by rounding to float: use double"));
  CHECK_FALSE(window.drew("stopped early"));
}

TEST_CASE("on a projector the column of constants shows its texts whole, and the picked particle below them") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, {1366, 768}, {1920, 1080}})
    for (const char* theme : {"light", "projector"}) {
      CAPTURE(size.x);
      CAPTURE(std::string(theme));
      test::NullUi window(options("hanging", 1, theme, size));
      window.pause();
      window.frames(4);
      CHECK(whole(window, "constants.F_int", 10));
      CHECK(whole(window, "plots.force_plot", 100));
      const Box list = window.control("constants.k_s.slider");
      window.move({(list.lo.x + list.hi.x) / 2, list.hi.y});
      for (int n = 0; n < 20; ++n) {
        for (const std::string& text : window.cut_texts()) {
          CAPTURE(text);
          CHECK_FALSE(text.starts_with("constants"));
        }
        if (window.sees("constants.columns.slider")) {
          const float label = text_width(*window.ui.fonts.small, "columns");
          CHECK(window.control("constants.columns.slider").lo.x > window.ui.theme.px(16) + label + 4);
        }
        window.wheel(-1.5f);
      }
      CHECK(window.sees("constants.wind_arrow"));
    }
}

TEST_CASE("in a small window with large text presentation mode keeps the step and its gauge") {
  test::NullUi window(options("one_weight", 1.5, "light", {900, 600}));
  window.key(GLFW_KEY_F5);
  window.frames(6);
  CHECK(whole(window, "podium.dt.slider", 20));
  CHECK(whole(window, "podium.play", 20));
}

// Where the parts of the interface have no room they are cut off; that asks for nothing impossible, which the standard
// library's assertions would tell.
TEST_CASE("windows of any size are drawn, in presentation mode and out of it") {
  test::NullUi window(options("hanging", 1, "dark", {900, 600}));
  for (const bool presenting : {false, true}) {
    if (presenting) window.key(GLFW_KEY_F5);
    for (const glm::ivec2 size : {glm::ivec2{377, 1125}, {320, 240}, {200, 1400}, {1600, 200}}) {
      window.resize(size);
      window.frames(3);
    }
  }
  CHECK(window.session.simulation->time() > 0);
}

TEST_CASE("what stands in the top bar keeps its place when the preset is no longer saved") {
  test::NullUi window({.settings = [](Settings& settings) { settings.theme = "projector"; }});
  const glm::vec2 step = window.middle("top.speed.4");
  window.type_value("k_s", "60");
  REQUIRE(unsaved(window.session));
  CHECK(window.middle("top.speed.4") == step);
}

TEST_CASE("slow motion is chosen by what one sees") {
  test::NullUi window;
  window.click("top.speed.3");
  CHECK(window.session.pacing.speed == 1.0 / 20);
  window.click("top.speed.1");
  CHECK(window.session.pacing.speed == 1);
}

}  // namespace tyglab::layout_test
