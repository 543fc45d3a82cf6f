// A lab's field and buttons, and what it opens beside itself.
#include <doctest/doctest.h>

#include "app/base/glfw_keys.h"
#include "app/session/lab_state.h"
#include "app/ui/cards/cards.h"
#include "tests/ui/null_ui.h"

namespace tyglab::lab_controls_test {

void begin(test::NullUi& window, std::string_view label) {
  find_labs(window.session);
  begin_lab(window.session, label);
  window.frames(4);
  REQUIRE(window.session.labs.run.has_value());
}

StepRecord& record(test::NullUi& window) {
  return window.session.labs.run->record();
}

void do_step(test::NullUi& window) {
  record(window).predicted = record(window).done = true;
  record(window).chosen = 0;
  window.frames(3);
}

void type_prediction(test::NullUi& window, std::string_view text) {
  window.type(text);
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
}

TEST_CASE("a prediction that is refused keeps the keyboard, all of it selected, and its warning goes with it") {
  test::NullUi window;
  begin(window, "03_stiffness");
  const int view = window.preset().mode;
  window.click("lab.prediction");
  type_prediction(window, "inf");
  CHECK(window.said("“inf” is not a number in N/m"));
  REQUIRE(window.typing());
  type_prediction(window, "abc");
  CHECK(std::string(record(window).typed) == "abc");  // in place of what was refused
  CHECK_FALSE(window.said("inf"));                    // of several, what was said of the last
  REQUIRE(window.typing());
  type_prediction(window, "5");
  CHECK(record(window).predicted);
  CHECK(std::string(record(window).typed) == "5");
  CHECK(window.preset().mode == view);  // 5 was no shortcut
  CHECK_FALSE(window.said("abc"));
  CHECK_FALSE(window.typing());
}

TEST_CASE("a number typed while a lab's question waits is its answer, wherever the keys went, and letters do nothing") {
  test::NullUi window;
  begin(window, "03_stiffness");
  const int view = window.preset().mode;
  window.key(GLFW_KEY_M);
  CHECK_FALSE(window.settings.layout.map);
  CHECK(window.said("The lab waits for your prediction."));
  CHECK_FALSE(window.typing());
  window.type("4e1");
  window.frames(6);
  CHECK(window.typing());
  CHECK(std::string(record(window).typed) == "4e1");
  CHECK(window.preset().mode == view);
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK(record(window).predicted);
  window.key(GLFW_KEY_2);
  CHECK(window.preset().mode == 2);
  window.key(GLFW_KEY_M);
  CHECK(window.settings.layout.map);

  window.ui.side = Side::main;  // the lab's text is there again, in place of the map
  enter_step(window.session, 1);
  window.frames(4);
  REQUIRE(window.sees("lab.choice.1"));
  const int of_step = window.preset().mode;
  window.key(GLFW_KEY_3);
  CHECK(window.preset().mode == of_step);
  CHECK(window.said("The lab waits for your prediction."));
  window.key(GLFW_KEY_P, GLFW_MOD_CONTROL);  // only plain keys wait
  CHECK(window.ui.palette.open);
}

TEST_CASE("Next says what it waits for: the prediction first, then the checks") {
  test::NullUi window;
  begin(window, "03_stiffness");
  window.move(window.middle("lab.Next"));
  window.frames(60);
  CHECK(window.drew("Once the prediction is made and the checks hold; Skip continues without that"));
  window.click("lab.prediction");
  type_prediction(window, "5");
  window.move(window.middle("lab.Next"));
  window.frames(60);
  CHECK(window.drew("Once the checks hold; Skip continues without that"));
}

TEST_CASE("what cannot be negative is not predicted so") {
  test::NullUi window;
  begin(window, "03_stiffness");
  window.click("lab.prediction");
  type_prediction(window, "-5");
  CHECK(window.said("A stiffness cannot be negative. Type 0 N/m or more."));
  CHECK_FALSE(record(window).predicted);
  CHECK(window.typing());

  const auto refused = [](const char* unit, const char* typed, const char* answer = "1") {
    const Lab lab =
        parse_lab("# A lab\n\n## A step\n\nText.\n\n```lab\npredict: How much?\nanswer: " + std::string(answer) + " " +
                      unit + " within 0.1\n```\n",
                  "my.md");
    return !refusal_of(*lab.steps[0].prediction, typed).empty();
  };
  for (const char* unit : {"s", "kg", "N/m", "N s/m"}) {
    CHECK(refused(unit, "-1"));
    CHECK_FALSE(refused(unit, "0"));
  }
  for (const char* unit : {"m", "N", "J", ""}) CHECK_FALSE(refused(unit, "-1"));
  CHECK_FALSE(refused("s", "-1", "-2"));  // the lab asks for a difference of times
}

TEST_CASE("the warning about a constant's number goes once one is accepted") {
  test::NullUi window;
  window.type_value("k_s", "abc");
  CHECK(window.said("“abc” is not a number"));
  window.type_value("k_s", "-3");
  CHECK_FALSE(window.said("abc"));
  CHECK(window.said("it stays at"));
  window.type_value("k_s", "60");
  CHECK(window.preset().k_s == 60);
  CHECK_FALSE(window.said("it stays at"));
}

TEST_CASE("that what is to be found holds already is not shown before the step is done") {
  test::NullUi window;
  begin(window, "03_stiffness");
  enter_step(window.session, 1);
  window.frames(4);
  window.click("lab.choice.1");
  window.click("lab.Predict");
  window.frames(4);
  REQUIRE(window.session.labs.run->now().checks[2].to_find);  // that nothing diverges
  CHECK(record(window).checks[2] == CheckState::holds);
  CHECK(window.drew("CHECK: 1 OF 4"));  // that nothing else was changed
}

TEST_CASE("Skip never stands where Next does, whatever a step has, so that a double click on Next skips nothing") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{900, 600}}) {
    test::NullUi window({.size = size});
    begin(window, "05_order");
    const auto next = window.middle("lab.Next"), skip = window.middle("lab.Skip");
    CHECK(next != skip);
    do_step(window);
    window.double_click(window.middle("lab.Next"));
    window.frames(3);
    CHECK(window.session.labs.run->step == 1);
    CHECK_FALSE(window.session.labs.run->now().open);  // "Set up again" is not there
    CHECK(window.middle("lab.Next") == next);
    CHECK(window.middle("lab.Skip") == skip);
    window.click("lab.Next");  // it waits for the checks
    CHECK(window.session.labs.run->step == 1);
    window.click("lab.Skip");
    CHECK(window.session.labs.run->step == 2);
  }
}

TEST_CASE("at its end a lab leads on to the next, and the last one to the list") {
  test::NullUi window;
  begin(window, "03_stiffness");
  enter_step(window.session, 2);
  window.frames(4);
  window.click("lab.Next_lab");
  window.frames(3);
  CHECK(window.session.labs.run->lab.label == "03_stiffness");  // it is not done yet
  do_step(window);
  window.click("lab.Next_lab");
  window.frames(3);
  REQUIRE(window.session.labs.run.has_value());
  CHECK(window.session.labs.run->lab.label == "04_damping");
  CHECK(window.said("You left “k_s and the critical time step”"));
  const Lab& last = window.session.labs.list.back();
  begin(window, last.label);
  enter_step(window.session, last.steps.size() - 1);
  window.frames(4);
  do_step(window);
  window.click("lab.Next_lab");
  window.frames(3);
  CHECK_FALSE(window.session.labs.run.has_value());
  CHECK(window.ui.palette.open);
  CHECK(window.ui.palette.labs);
}

TEST_CASE("a card that a lab has opened is closed with it; one that was open before stays") {
  test::NullUi window;
  std::set<std::string>& folded = window.settings.layout.folded;
  REQUIRE(folded.contains(card_name::accuracy));
  begin(window, "05_order");
  CHECK_FALSE(folded.contains(card_name::accuracy));
  begin(window, "03_stiffness");
  CHECK(folded.contains(card_name::accuracy));
  CHECK_FALSE(folded.contains(card_name::stability));
  window.click("lab.leave");
  window.frames(3);
  CHECK(folded.contains(card_name::stability));
  folded.erase(card_name::accuracy);
  begin(window, "05_order");
  window.click("lab.leave");
  window.frames(3);
  CHECK_FALSE(folded.contains(card_name::accuracy));
}

TEST_CASE("presentation mode has the constants that the lab's step asks for at hand") {
  test::NullUi window;
  begin(window, "04_damping");
  window.key(GLFW_KEY_F5);
  window.frames(4);
  CHECK(window.sees("podium.k_d.slider"));
  CHECK(window.sees("podium.dt.slider"));
  CHECK_FALSE(window.sees("podium.k_s.slider"));
  begin(window, "12_wind");
  CHECK(window.sees("podium.W.z"));
  leave_lab(window.session);
  window.frames(4);
  CHECK(window.sees("podium.k_s.slider"));
}

TEST_CASE("the button under a question's choices is whole in presentation mode, in any size") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{900, 600}}) {
    test::NullUi window({.size = size});
    begin(window, "04_damping");
    window.key(GLFW_KEY_F5);
    window.frames(8);
    window.turn_to("lab.choice.1");
    const auto height = [&](const char* control) {
      const Box box = window.control(control);
      return box.hi.y - box.lo.y;
    };
    CHECK(height("lab.Predict") == height("lab.Back"));
    if (size.x == 1280) CHECK(height("lab.choice.3") == height("lab.choice.1"));
    window.click("lab.choice.1");
    window.click("lab.Predict");
    CHECK(record(window).predicted);
  }
}

}  // namespace tyglab::lab_controls_test
