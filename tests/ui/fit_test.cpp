// Every text has room: on the start page, in the top bar, in presentation mode and in every lab, at each size of the
// window, in each theme, with usual and with large text.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "app/base/glfw_keys.h"
#include "app/session/lab_state.h"
#include "app/ui/frame/panels.h"
#include "tests/ui/null_ui.h"

namespace tyglab::fit_test {

/// Lays the window out in every way that is promised.
void in_each_layout(const char* preset, const std::function<void(test::NullUi&)>& look) {
  for (const char* theme : {"dark", "light", "projector"})
    for (const glm::ivec2 size : {glm::ivec2{1280, 720}, {1920, 1080}, {900, 600}})
      for (const double text : {1.0, 1.5}) {
        const std::string layout = std::string(theme) + ", " + std::to_string(size.x) + ", " + std::to_string(text);
        CAPTURE(layout);
        test::NullUi window({.preset = preset, .size = size, .settings = [&](Settings& settings) {
                               settings.theme = theme, settings.ui_scale = text;
                             }});
        window.pause();
        look(window);
      }
}

/// In the windows whose names begin so, nothing is cut or shortened.
void check_texts(test::NullUi& window, const std::string& region) {
  for (const std::string& text : window.cut_texts()) {
    CAPTURE(text);
    CHECK_FALSE(text.starts_with(region));
  }
}

TEST_CASE("every card of the start page shows its title and its goal whole" * doctest::test_suite("slow")) {
  in_each_layout("hanging", [](test::NullUi& window) {
    window.ui.command("start_page");
    window.frames(4);
    CHECK_FALSE(window.control_beginning("dialog.Continue_with").empty());
    CHECK(window.sees("dialog.Take_the_tour"));
    const Box list = window.control("dialog.find");
    window.move({(list.lo.x + list.hi.x) / 2, list.hi.y + 60});
    for (int n = 0; n < 60; ++n) {
      check_texts(window, "dialog");
      CHECK_FALSE(window.drew("…"));
      window.wheel(-1.5f);
    }
    CHECK(window.sees("dialog.entry.How_it_tears"));
  });
}

TEST_CASE("the texts of the top bar have room, and the speed can be chosen in every theme" *
          doctest::test_suite("slow")) {
  for (const char* preset : {"hanging", "sphere", "fold_without_k_b"})
    in_each_layout(preset, [](test::NullUi& window) {
      window.frames(2);
      check_texts(window, "top");
      CHECK_FALSE(window.drew(window.preset().name.substr(0, 6) + "…"));
      CHECK((window.sees("top.speed.4") || window.sees("top.speed")));
    });
}

TEST_CASE("presentation mode names its scene, and its texts have room" * doctest::test_suite("slow")) {
  in_each_layout("sphere", [](test::NullUi& window) {
    window.key(GLFW_KEY_F5);
    window.frames(4);
    CHECK(window.drew(window.preset().name));
    check_texts(window, "podium");
    check_texts(window, "viewport");
    CHECK((window.sees("podium.speed.4") || window.sees("podium.speed")));
    CHECK(window.sees("podium.card") == (window.ui.viewport.size().x < ImGui::GetIO().DisplaySize.x));
    window.key(GLFW_KEY_F5);
    window.frames(4);
  });
}

TEST_CASE("every step of every lab has its texts whole" * doctest::test_suite("slow")) {
  in_each_layout("hanging", [](test::NullUi& window) {
    std::vector<std::string> labs;
    for (const Lab& lab : find_labs(window.session)) labs.push_back(lab.label);
    for (const std::string& lab : labs) {
      CAPTURE(lab);
      begin_lab(window.session, lab);
      window.rest();
      for (std::size_t step = 0; step < window.session.labs.run->lab.steps.size(); ++step) {
        CAPTURE(step);
        enter_step(window.session, step);
        window.frames(3);
        check_texts(window, "lab");
        check_texts(window, "top");
      }
    }
  });
}

TEST_CASE("with large text in a small window a lab's page has five lines, and the cloth is in sight") {
  test::NullUi window({.preset = "hanging", .size = {900, 600}, .settings = [](Settings& settings) {
                         settings.theme = "projector", settings.ui_scale = 1.5f;
                       }});
  begin_lab(window.session, "03_stiffness");
  window.frames(6);
  const Box cloth = window.ui.viewport.box;
  CHECK(cloth.hi.y - cloth.lo.y >= 100);
  CHECK(600 - cloth.hi.y >= 80 + 5 * window.ui.fonts.text->FontSize);
  leave_lab(window.session);
  window.frames(6);
  CHECK(window.ui.viewport.box.hi.y < 600 - window.ui.theme.px(20));  // the status line is there again
}

TEST_CASE("once a step is done, all of why is seen at once") {
  test::NullUi window;
  begin_lab(window.session, "03_stiffness");
  window.frames(4);
  LabRun& run = *window.session.labs.run;
  run.record().predicted = run.record().done = run.show_explanation = true;
  window.move({10, 300});
  window.frames(6);
  CHECK(window.drew("a flat sheet never reaches the worst case. CHECK: DONE"));  // not below what was checked
  for (const std::string& text : window.cut_texts()) CHECK_FALSE(text.starts_with("lab"));
}

}  // namespace tyglab::fit_test
