// Labs played by mouse and keyboard: chosen, predicted, left.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

#include "app/base/glfw_keys.h"
#include "app/session/lab_state.h"
#include "app/session/requests.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/panels.h"
#include "tests/ui/null_ui.h"

namespace tyglab::labs_ui_test {

const LabRun& lab(test::NullUi& window) {
  REQUIRE(window.session.labs.run.has_value());
  return *window.session.labs.run;
}

/// Chooses a lab by the cap in the top bar and some letters of its title.
void begin(test::NullUi& window, std::string_view typed, const std::string& label) {
  window.click("top.labs");
  window.until([&] { return window.ui.palette.open && window.typing(); }, "the list of labs");
  window.type(typed);
  window.key(GLFW_KEY_ENTER);
  window.until([&] { return window.session.labs.run && !window.ui.palette.open; }, "the lab to begin");
  window.frames(2);
  CHECK(lab(window).lab.label == label);
  CHECK(window.paused());
}

void predict(test::NullUi& window, std::string_view text) {
  window.turn_to("lab.prediction");
  window.click("lab.prediction");
  REQUIRE(window.typing());
  window.type(text);
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  CHECK(lab(window).record().predicted);
  CHECK_FALSE(window.typing());
}

void choose(test::NullUi& window, int number) {
  window.turn_to("lab.choice." + std::to_string(number));
  window.click("lab.choice." + std::to_string(number));
  window.click("lab.Predict");
  CHECK(lab(window).record().predicted);
}

void go_on(test::NullUi& window, std::size_t step) {
  window.click("lab.Next");
  window.frames(4);
  CHECK(lab(window).step == step);
  CHECK_FALSE(lab(window).record().done);
}

void until_done(test::NullUi& window, const char* what) {
  window.until([&] { return lab(window).record().done; }, what);
}

TEST_CASE("the lab on Hooke's law is played from its beginning to its end, and what is done is remembered") {
  test::NullUi window({.preset = "denim"});
  begin(window, "hooke", "01_hooke");
  CHECK(window.session.document.label == "one_weight");
  CHECK(window.t() == 0);
  window.key(GLFW_KEY_SPACE);
  window.key(GLFW_KEY_RIGHT);
  window.frames(10);
  CHECK(window.paused());
  CHECK(window.steps() == 0);  // the result is not seen before the prediction
  CHECK(window.said("Predict first: the motion waits for your prediction."));
  CHECK(window.drew("Predict in the lab to run"));
  CHECK_FALSE(window.drew("Space runs"));
  CHECK_FALSE(window.scene.view.equilibrium);  // nor the line where the mass comes to rest
  predict(window, "0,09");
  window.frames(2);
  CHECK(window.scene.view.equilibrium);
  CHECK(window.paused());
  window.key(GLFW_KEY_SPACE);
  until_done(window, "the weight at rest to count");
  CHECK_FALSE(lab(window).record().right);
  go_on(window, 1);
  CHECK(window.paused());
  predict(window, "0.049 m");
  CHECK_FALSE(window.paused());  // it ran when the step began, and goes on
  window.frames(10);
  CHECK_FALSE(lab(window).record().done);  // k has not been changed
  window.type_value("k", "20");
  until_done(window, "the stiffer spring's rest to count");
  CHECK(lab(window).record().right);
  go_on(window, 2);
  CHECK(window.session.document.label == "hanging");
  CHECK(window.preset().rows == 12);
  CHECK_FALSE(unsaved(window.session));
  choose(window, 2);
  window.key(GLFW_KEY_SPACE);
  const int middle = 11 / 2;
  window.click(window.pixel_of(middle, middle), GLFW_MOUSE_BUTTON_RIGHT);
  until_done(window, "the cloth to come to rest");
  CHECK(lab(window).record().right);
  window.click("lab.Finish");
  CHECK_FALSE(window.session.labs.run.has_value());
  window.key(GLFW_KEY_L, GLFW_MOD_CONTROL);
  CHECK(window.ui.palette.open);
  window.key(GLFW_KEY_ESCAPE);
  CHECK_FALSE(window.ui.palette.open);
  CHECK(window.session.labs.progress == std::map<std::string, int>{{"01_hooke", 3}});
}

TEST_CASE("the lab on k_s: the limit is predicted, found by an explosion, and kept clear of") {
  test::NullUi window;
  begin(window, "critical", "03_stiffness");
  predict(window, "200");
  window.key(GLFW_KEY_SPACE);
  CHECK_FALSE(window.paused());
  window.type_value("k_s", "300");
  window.until([&] { return window.diverged(); }, "an explosion");
  CHECK_FALSE(lab(window).record().done);  // far above the limit does not count
  window.type_value("k_s", "198");
  window.key(GLFW_KEY_R);
  window.until([&] { return window.diverged(); }, "an explosion near the limit");
  CHECK_FALSE(lab(window).record().done);
  window.type_value("k_s", "190");
  window.key(GLFW_KEY_R);
  until_done(window, "half a second below the limit");
  CHECK(lab(window).record().right);  // 200 is near enough
  go_on(window, 1);
  CHECK_FALSE(window.diverged());
  CHECK(window.paused());
  CHECK_FALSE(unsaved(window.session));
  choose(window, 1);
  window.type_value("k_s", "180");
  window.key(GLFW_KEY_SPACE);
  until_done(window, "two seconds below the limit");
  CHECK(lab(window).record().right);
  go_on(window, 2);
  predict(window, "5e-4");
  window.type_value("k_s", "800");
  window.type_value("dt", "0.00046");
  window.key(GLFW_KEY_SPACE);
  window.until([&] { return window.t() > 1.1; }, "a second at half the step");
  CHECK_FALSE(lab(window).record().done);
  window.type_value("dt", "0.0005");
  window.key(GLFW_KEY_R);
  until_done(window, "an explosion at a slightly larger one");
  CHECK(lab(window).record().right);
  window.click("lab.Back");
  CHECK(lab(window).step == 1);
  CHECK(lab(window).record().done);
  CHECK(window.preset().k_s == 800);  // nothing is opened by going back
}

TEST_CASE("a lab asks nothing; what is done in it is no work, and whoever leaves it has their experiment back") {
  test::NullUi window;
  window.type_value("k_s", "77");
  window.frames(20);
  window.find("add a copy: rk4");
  window.until([&] { return window.session.copies.lockstep.size() == 1; }, "the copy");
  window.frames(20);
  window.pause();
  window.move(window.ui.viewport.box.lo + 100.f);
  window.wheel(1);
  window.session.picked = Pins::Site{3, 4};
  window.ui.color_by(ParticleField::speed);
  const double t = window.t();
  const glm::dvec3 corner = window.cloth().position(31, 0);
  const Camera camera = window.scene.camera;
  CHECK(unsaved(window.session));
  window.click("top.labs");
  window.click("palette.Lab.Why_Euler_gains_energy");
  window.frames(2);
  CHECK(window.ui.dialog.kind == Dialog::Kind::none);
  CHECK(window.session.document.label == "one_weight");
  window.type_value("k", "11");
  CHECK_FALSE(unsaved(window.session));
  window.click("lab.Set_up_again");
  CHECK(window.preset().k == 10);  // the step as it was
  window.type_value("k", "12");
  window.session.request(request::Quit{});
  apply_requests(window.session);
  CHECK(window.session.quit);  // nothing is lost
  CHECK_FALSE(window.session.question.has_value());
  window.session.quit = false;
  window.click("lab.leave");
  window.frames(2);
  CHECK_FALSE(window.session.labs.run.has_value());
  CHECK(window.session.document.label == "hanging");
  CHECK(window.preset().k_s == 77);
  CHECK(window.t() == t);
  CHECK(window.cloth().position(31, 0) == corner);
  CHECK(window.paused());
  CHECK(unsaved(window.session));
  CHECK(window.session.copies.lockstep.size() == 1);
  CHECK(window.session.picked == Pins::Site{3, 4});
  CHECK(window.scene.camera == camera);
  REQUIRE(window.scene.colors.chosen.has_value());
  CHECK(window.scene.colors.chosen->field == ParticleField::speed);
  CHECK(window.session.labs.kept.empty());
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  CHECK(window.session.copies.lockstep.empty());
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  CHECK(window.preset().k_s == 50);
}

TEST_CASE("an experiment without changes is there again after a lab too, with its motion") {
  test::NullUi window({.preset = "denim"});
  window.frames(30);
  window.pause();
  const double t = window.t();
  REQUIRE(t > 0);
  begin(window, "hooke", "01_hooke");
  CHECK(window.session.document.label == "one_weight");
  window.find("leave the lab");
  window.frames(2);
  CHECK(window.session.document.label == "denim");
  CHECK(window.t() == t);
  CHECK_FALSE(unsaved(window.session));
}

TEST_CASE("another lab keeps the experiment too, and only what is no lab's is kept") {
  test::NullUi window;
  window.type_value("k_s", "77");
  begin(window, "hooke", "01_hooke");
  window.type_value("k", "11");
  begin(window, "critical", "03_stiffness");
  REQUIRE(window.session.labs.kept.size() == 1);
  CHECK(window.session.labs.kept[0].constants.k_s == 77);
  window.find("flag in");
  window.type_value("k_s", "33");
  CHECK(unsaved(window.session));  // that is no lab's cloth
  window.click("lab.Open_the_lab_s_cloth");
  window.frames(2);
  CHECK(window.ui.dialog.kind == Dialog::Kind::none);
  CHECK(window.session.document.label == "taut_sheet");
  REQUIRE(window.session.labs.kept.size() == 2);
  window.find("leave the lab");
  window.frames(2);
  CHECK_FALSE(window.session.labs.run.has_value());
  CHECK(window.session.document.label == "flag");
  CHECK(window.preset().k_s == 33);
  window.find("back to your");
  window.frames(2);
  CHECK(window.preset().k_s == 77);
  REQUIRE(window.session.labs.kept.size() == 1);  // the flag with its changes
  CHECK(window.session.labs.kept[0].document.label == "flag");
}

TEST_CASE("a step shows what it is about, at its speed, and the lab's end gives the user's own speed back") {
  test::NullUi window;
  window.session.pacing.speed = 0.5;
  Lab lab = parse_lab(
      "# A lab\n\nWhat for.\n\n## First\n\nText.\n\n```lab\nopen: hanging\nshow: energy\nspeed: 0.1\nview: 2\n"
      "color: tension\n```\n\n## Second\n\nMore.\n\n```lab\nshow: map\n```\n",
      "mine.md");
  lab.label = "mine";
  find_labs(window.session);
  window.session.labs.list = {lab};
  begin_lab(window.session, "mine");
  window.frames(4);
  CHECK(window.session.pacing.speed == 0.1);
  CHECK(window.preset().mode == 2);
  CHECK_FALSE(unsaved(window.session));
  REQUIRE(window.scene.colors.chosen.has_value());
  CHECK(window.scene.colors.chosen->field == ParticleField::tension);
  CHECK(window.session.labs.run->record().done);
  CHECK(window.session.simulation->ledger().has_value());  // for the Energy card, which has its turn after the text
  window.click("side.columns.2");
  CHECK(window.sees("plots.energy_plot"));
  CHECK(window.session.simulation->ledger().has_value());
  window.click("side.columns.1");
  enter_step(window.session, 1);
  window.frames(4);
  CHECK(window.session.pacing.speed == 0.5);
  CHECK_FALSE(window.scene.colors.chosen.has_value());
  CHECK(window.session.wants.map);
  window.click("side.columns.2");
  CHECK(window.drew("Which k_s and dt are stable"));
  leave_lab(window.session);
  CHECK(window.session.pacing.speed == 0.5);
}

TEST_CASE("what a step shows is measured where the window has no room for its card, and comes into sight with F5") {
  const auto large_text = [](Settings& settings) { settings.ui_scale = 1.5; };
  test::NullUi window({.size = {900, 600}, .settings = large_text});
  find_labs(window.session);
  begin_lab(window.session, "05_order");
  window.frames(4);
  Preset asked = window.preset();
  asked.dt = 0.0005;
  window.session.propose(std::move(asked));
  until_done(window, "the error to be measured");
  CHECK_FALSE(window.drew("open the card"));

  for (const int width : {1100, 1280}) {
    CAPTURE(width);
    test::NullUi wide({.size = {width, 720}});
    find_labs(wide.session);
    begin_lab(wide.session, "05_order");
    wide.frames(4);
    wide.ui.plots.wanted.clear(), wide.ui.plots.tab = card_name::forces;
    wide.key(GLFW_KEY_F5);
    wide.frames(4);
    CHECK(wide.ui.presenting);
    if (wide.sees("side.columns.2")) wide.click("side.columns.2");  // the lab has the column
    CHECK(in_front(wide.ui, card_name::accuracy));
    CHECK(wide.session.wants.accuracy);
  }
}

TEST_CASE("the card says which number is looked at, where it is seen, and why a check is broken") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{900, 600}}) {
    test::NullUi window({.size = size});
    find_labs(window.session);
    window.session.labs.progress["03_stiffness"] = 1;
    begin_lab(window.session, "03_stiffness");
    window.frames(4);
    choose(window, 1);
    window.rest();
    CHECK(window.drew("k_s ≥ 180 N/m throughout"));
    CHECK(window.drew("now 50 N/m (Springs)"));
    window.session.pacing.playing = true;
    window.until([&] { return window.t() > 0.1; }, "a tenth of a second");
    CHECK(window.drew("k_s was 50 N/m at t = 0.0"));
    CHECK(window.drew("set it to 180 N/m or more, then restart"));
  }
}

TEST_CASE("every step of every lab has its whole title on its card, in small windows too") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{900, 600}}) {
    test::NullUi window({.size = size});
    for (const Lab& each : find_labs(window.session)) {
      begin_lab(window.session, each.label);
      for (std::size_t step = 0; step < each.steps.size(); ++step) {
        CAPTURE(each.label);
        CAPTURE(step);
        enter_step(window.session, step);
        window.session.requests.clear();  // the cloth is of no matter
        window.session.labs.opened = window.session.document.label;
        window.frames(2);
        CHECK(window.drew(each.steps[step].title));
        CHECK(window.drew("Step " + std::to_string(step + 1) + " of " + std::to_string(each.steps.size())));
      }
    }
  }
}

TEST_CASE("the field of a predicted number has its button beside it, with a unit or without") {
  std::size_t without = 0;
  for (const auto& [size, text] : {std::pair{glm::ivec2{1280, 720}, 1.0}, {{900, 600}, 1.0}, {{900, 600}, 1.5}}) {
    CAPTURE(size.x);
    CAPTURE(text);
    test::NullUi window({.size = size, .settings = [text = text](Settings& settings) { settings.ui_scale = text; }});
    for (const Lab& each : find_labs(window.session)) {
      begin_lab(window.session, each.label);
      for (std::size_t step = 0; step < each.steps.size(); ++step) {
        const auto& asked = each.steps[step].prediction;
        if (!asked || !asked->choices.empty()) continue;
        CAPTURE(each.label);
        CAPTURE(step);
        without += asked->unit.empty();
        enter_step(window.session, step);
        window.session.requests.clear();  // the cloth is of no matter
        window.session.labs.opened = window.session.document.label;
        window.frames(2);
        window.turn_to("lab.prediction");
        const Box field = window.control("lab.prediction"), button = window.control("lab.Predict");
        CHECK(button.lo.x > field.hi.x);
        CHECK(button.lo.x < field.hi.x + 120 * window.ui.theme.scale);
        CHECK(std::abs(button.lo.y - field.lo.y) < 6 * window.ui.theme.scale);
        CHECK_FALSE(window.cut_at_sides().contains("lab.Predict"));
      }
    }
  }
  CHECK(without > 0);
}

TEST_CASE("the height of the mass names the method that moves it") {
  test::NullUi window;
  find_labs(window.session);
  begin_lab(window.session, "07_implicit");
  enter_step(window.session, 2);
  window.click("side.columns.2");
  window.frames(6);
  CHECK(window.sees("plots.Implicit_Euler"));
  CHECK(window.sees("plots.Verlet"));
  window.find("integrator verlet");
  window.frames(4);
  CHECK_FALSE(window.sees("plots.Implicit_Euler"));
  CHECK(window.sees("plots.Verlet"));
}

TEST_CASE("the list of labs has their numbers, minutes and purposes") {
  test::NullUi window;
  window.session.labs.progress["02_euler"] = 3;
  window.click("top.labs");
  window.frames(2);
  CHECK(window.drew("3 steps · 15 min"));
  CHECK(window.drew("done"));
  CHECK(window.drew("A mass on a spring, and then a whole cloth"));
}

TEST_CASE("who leaves a lab is told how far it was gone through, whichever way is taken") {
  const auto said = [](test::NullUi& window) { return window.session.messages.list().back().text; };
  test::NullUi window;
  begin(window, "hooke", "01_hooke");
  window.click("lab.leave");
  CHECK(said(window).find("You left “") != std::string::npos);
  CHECK(said(window).find("” before its first step was done. Ctrl+L") != std::string::npos);
  begin(window, "hooke", "01_hooke");
  predict(window, "0.1");  // asked and not answered yet: it counts neither way
  window.find("leave the lab");
  CHECK(said(window).find("” before its first step was done. Ctrl+L") != std::string::npos);

  Session& session = window.session;
  begin_lab(session, "01_hooke");
  LabRun& run = *session.labs.run;
  for (StepRecord& record : run.records) record.predicted = record.done = true;
  run.records[1].right = true;
  CHECK(lab_result(run, 3) == "“" + run.lab.title + "” is done; 1 of 3 predictions was right. Ctrl+L lists all labs.");
  run.records[1].done = false;
  CHECK(lab_result(run, 3).find("” with 2 of 3 steps done, which you had finished before; ") != std::string::npos);
  CHECK(lab_result(run, 1).find("”; step 2 was skipped and is still to be done; 0 of 2 predictions") !=
        std::string::npos);
  run.records[0].done = false;
  CHECK(lab_result(run, 0).find("”; steps 1 and 2 were skipped and are still to be done; ") != std::string::npos);
}

TEST_CASE("a lab that is gone on with keeps what was predicted and found, and opens the card that it needs") {
  test::NullUi window;
  begin(window, "euler gains", "02_euler");
  predict(window, "2.9");
  window.key(GLFW_KEY_SPACE);
  until_done(window, "the first step");
  go_on(window, 1);
  choose(window, 1);
  window.click("lab.leave");
  window.frames(2);
  begin(window, "euler gains", "02_euler");
  // The second step compares with the first, so the lab goes on with that: its prediction stands.
  CHECK(lab(window).step == 0);
  CHECK_FALSE(lab(window).record().done);
  CHECK(lab(window).record().predicted);
  CHECK(lab(window).record().typed == std::string("2.9"));
  CHECK(lab(window).records[1].predicted);
  CHECK(lab(window).records[1].chosen == 0);
  window.key(GLFW_KEY_SPACE);
  until_done(window, "the first step again");
  CHECK(lab(window).record().right);
}

TEST_CASE("a lab that is begun at a later step opens the card of the step before") {
  test::NullUi window;
  Session& session = window.session;
  find_labs(session);
  auto& labs = session.labs.list;
  auto second = std::find_if(labs.begin(), labs.end(), [](const Lab& each) { return each.label == "02_euler"; });
  REQUIRE(second != labs.end());
  second->steps[1].show.clear(), second->steps[1].checks.clear();  // it is begun there, and wants no card
  session.labs.progress["02_euler"] = 1;
  const auto energy_open = [&] { return window.ui.settings.layout.folded.count(card_name::energy) == 0; };
  window.ui.settings.layout.folded.insert(card_name::energy);
  REQUIRE_FALSE(energy_open());
  begin_lab(session, "02_euler");
  window.frames(4);
  CHECK(lab(window).step == 1);
  CHECK(energy_open());
  window.click("lab.leave");
  window.frames(2);
  CHECK_FALSE(energy_open());
}

TEST_CASE("the list of labs begins at the one that goes on, or that is to be done next") {
  test::NullUi window;
  window.session.labs.progress["01_hooke"] = 3;
  window.key(GLFW_KEY_L, GLFW_MOD_CONTROL);
  window.frames(3);
  CHECK(window.ui.palette.selected == 1);
  window.key(GLFW_KEY_ESCAPE);
  begin(window, "wind", "12_wind");
  window.key(GLFW_KEY_L, GLFW_MOD_CONTROL);
  window.frames(4);
  CHECK(window.ui.palette.selected == 11);
  CHECK(window.sees("palette.Lab.Wind_gusts_and_a_swinging_sheet"));  // though the list has to scroll for it
  window.type("spring");
  CHECK(window.ui.palette.selected == 0);  // the best that is found
}

ImVec2 lab_size() {
  const ImGuiWindow* const panel = ImGui::FindWindowByName("lab");
  return panel != nullptr && panel->Active ? panel->Size : ImVec2(0, 0);
}

test::UiOptions in(glm::ivec2 size, const char* theme = "dark", double scale = 1) {
  return {.size = size, .settings = [=](Settings& settings) { settings.theme = theme, settings.ui_scale = scale; }};
}

TEST_CASE("from a width of 1280 on a lab is a column beside a cloth of full height, in turn with the plots") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{1366, 768}, glm::ivec2{1920, 1080}})
    for (const char* theme : {"dark", "light", "projector"}) {
      CAPTURE(size.x);
      CAPTURE(std::string(theme));
      test::NullUi window(in(size, theme));
      begin_lab(window.session, "03_stiffness");
      window.frames(4);
      const float scale = window.ui.theme.scale, width = float(size.x), height = float(size.y);
      const Viewport::Box cloth = window.ui.viewport.box;
      CHECK(window.ui.viewport.whole().x >= 0.45f * width);
      CHECK(cloth.lo.y <= 96 * scale);                                                // the bar and the view buttons
      CHECK(cloth.hi.y == height - std::round(30 * scale) - std::round(26 * scale));  // status line and timeline
      CHECK(lab_size().x >= 360 * scale);
      CHECK(lab_size().x <= 400 * scale);
      CHECK(lab_size().y >= 0.8f * height);
      CHECK((window.sees("constants.k_s.slider") || window.sees("lab.k_s.slider")));
      CHECK(window.session.wants.forces);  // recorded for its turn
      window.click(window.sees("side.columns.3") ? "side.columns.3" : "side.columns.2");
      window.frames(3);
      CHECK(window.sees("plots.source.1"));
      CHECK_FALSE(window.sees("lab.leave"));
      CHECK((window.ui.viewport.box.lo == cloth.lo && window.ui.viewport.box.hi == cloth.hi));
      window.click("side.columns.1");
      window.frames(3);
      CHECK(window.sees("lab.leave"));
      window.key(GLFW_KEY_F5);
      window.frames(6);
      CHECK(window.ui.viewport.whole().x >= 0.45f * width);
      CHECK(lab_size().y >= 0.7f * height);
      leave_lab(window.session);
      window.frames(4);
      CHECK(window.ui.viewport.whole().x >= 0.65f * width);
    }
}

TEST_CASE("in a narrower window a lab takes at most 35 % of the height, and its pages are turned") {
  for (const glm::ivec2 size : {glm::ivec2{900, 600}, glm::ivec2{600, 400}, glm::ivec2{1279, 720}}) {
    CAPTURE(size.x);
    test::NullUi window(in(size));
    begin_lab(window.session, "03_stiffness");
    window.frames(4);
    const LabPages& pages = window.ui.lab_pages;
    CHECK(lab_size().y <= 0.35f * float(size.y) + 1);
    CHECK(window.drew("The stiffer a cloth, the faster it can oscillate"));
    CHECK((pages.count > 1) == window.sees("lab.page_on"));
    predict(window, "200");
    window.frames(2);
    CHECK(window.drew("Run the motion, and raise k_s"));  // the task comes into sight by itself
    CHECK((pages.count > 1 || size.x != 600));
    while (pages.at > 0) window.click("lab.page_back");
    CHECK(window.drew("The stiffer a cloth, the faster it can oscillate"));
    window.move({float(size.x) / 2, float(size.y) - 60});
    window.wheel(-1);
    CHECK(pages.at == std::min(1, pages.count - 1));
    window.session.labs.run->record().done = window.session.labs.run->show_explanation = true;
    window.frames(3);
    CHECK(window.drew("ω·dt = 2 with ω² = 8·k_s/m gives"));
  }
}

TEST_CASE("in a small frame the constant that a lab's step is about is in sight, by a finger too") {
  for (const bool touch : {false, true}) {
    CAPTURE(touch);
    test::NullUi window(in({600, 400}));
    for (const Lab& each : find_labs(window.session)) {
      begin_lab(window.session, each.label);
      for (std::size_t step = 0; step < each.steps.size(); ++step) {
        CAPTURE(each.label);
        CAPTURE(step);
        enter_step(window.session, step);
        window.input.by_touch = touch;
        window.frames(6);
        const auto rows = checked_constants(window.ui);
        if (rows.empty()) continue;
        const std::string key(rows.front()->key);
        const auto seen = [&](const std::string& part) {
          return window.sees("constants." + key + part) || window.sees("lab." + key + part);
        };
        // Or the choice of which it is about, whichever it checks first.
        const auto& checks = each.steps[step].checks;
        const bool chosen = std::any_of(checks.begin(), checks.end(), [&](const Condition& check) {
          return window.sees("constants." + std::string(check.name) + ".2");
        });
        CHECK((chosen || seen(".slider") || seen(".x")));
        CHECK(window.ui.viewport.whole().y >= 100);
      }
    }
  }
}

TEST_CASE("a lab waits while another preset is open, says so, and puts its own cloth back") {
  test::NullUi window({.preset = "denim"});
  begin(window, "wind", "12_wind");
  CHECK(window.session.document.label == "hanging");
  window.find("flag in");
  CHECK(window.session.document.label == "flag");
  window.click("lab.Open_the_lab_s_cloth");
  CHECK(window.session.document.label == "hanging");
  CHECK(lab(window).lab.label == "12_wind");
  window.frames(4);
  CHECK_FALSE(window.sees("lab.Open_the_lab_s_cloth"));
}

TEST_CASE("Back sets the step before up again, so that nothing of the step after it counts") {
  test::NullUi window;
  begin(window, "critical", "03_stiffness");
  window.click("lab.Skip");
  window.frames(2);
  window.click("lab.Skip");
  window.frames(2);
  CHECK(window.preset().dt == 0.0002);
  window.click("lab.Back");
  window.frames(2);
  CHECK(window.session.labs.run->step == 1);
  CHECK(window.preset().dt == 0.001);
}

TEST_CASE("the buttons of a lab keep their places when its step is done") {
  for (const glm::ivec2 size : {glm::ivec2{1280, 720}, glm::ivec2{900, 600}}) {
    test::NullUi window({.size = size});
    begin(window, "gains energy", "02_euler");
    window.frames(4);
    const auto back = window.middle("lab.Back"), forward = window.middle("lab.Next");
    LabRun& run = *window.session.labs.run;
    run.record().predicted = run.record().done = true;
    window.frames(4);
    CHECK(window.middle("lab.Back") == back);
    CHECK(window.middle("lab.Next") == forward);
  }
}

TEST_CASE("what a step tells to change is in sight in a low column too") {
  test::NullUi window({.size = {900, 600}, .settings = [](Settings& settings) { settings.ui_scale = 1.5; }});
  find_labs(window.session);
  begin_lab(window.session, "03_stiffness");
  window.frames(8);
  CHECK(window.sees("constants.k_s.slider"));
  enter_step(window.session, 2);
  window.frames(8);
  CHECK(window.sees("constants.k_s.slider"));
}

TEST_CASE("where a step tells to change the time of contact, it is in sight, though its section was folded") {
  test::NullUi window({.size = {900, 600}});
  window.ui.settings.layout.folded.insert("Bodies");
  find_labs(window.session);
  begin_lab(window.session, "15_contact");
  window.frames(8);
  CHECK_FALSE(window.sees("constants.contact.2"));
  enter_step(window.session, 1);
  window.frames(8);
  CHECK(window.sees("constants.contact.2"));
}

TEST_CASE("what has only held so far looks like no work that is done") {
  test::NullUi window;
  begin(window, "critical", "03_stiffness");
  predict(window, "200");
  CHECK(window.drew("Integrator: Verlet so far"));
  CHECK(window.drew("neither found yet"));
}

TEST_CASE("the last step leaves the lab only once it is done; the cross does before that") {
  test::NullUi window;
  begin(window, "critical", "03_stiffness");
  enter_step(window.session, 2);
  window.frames(4);
  window.click("lab.Finish");
  window.frames(2);
  CHECK(window.session.labs.run.has_value());
  lab(window);
  window.session.labs.run->record().predicted = window.session.labs.run->record().done = true;
  window.frames(2);
  window.click("lab.Finish");
  window.frames(2);
  CHECK_FALSE(window.session.labs.run.has_value());
}

TEST_CASE("the second click of a double click leaves out no step") {
  test::NullUi window;
  begin(window, "critical", "03_stiffness");
  window.double_click(window.middle("lab.Skip"));
  window.frames(2);
  CHECK(window.session.labs.run->step == 1);
}

}  // namespace tyglab::labs_ui_test
