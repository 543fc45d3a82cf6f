// The cards beside the cloth: stability, the order of convergence, the energy ledger, a step written out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/base/glfw_keys.h"
#include "app/session/lab_state.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/frame.h"
#include "core/analysis/convergence.h"
#include "core/model/words.h"
#include "tests/support/sanitized.h"
#include "tests/ui/null_ui.h"

namespace tyglab::cards_test {

Studies& studies(test::NullUi& window) {
  return window.session.studies;
}

/// What the gauge under dt shows.
double dt_over_limit(test::NullUi& window) {
  const auto& limits = studies(window).stability.limits();
  return limits && limits->any > 0 ? window.preset().dt / limits->any : std::nan("");
}

TEST_CASE("the other side of the accuracy card measures the order beside the frames, and writes it as CSV" *
          doctest::test_suite("slow")) {
  test::NullUi window({.preset = "taut_sheet",
                       .with = [](Preset& preset) { preset.integrator = "rk4", preset.rows = preset.columns = 9; }});
  window.pause();  // while nothing moves the frames leave the processors to what is measured
  window.find("order of conv");
  const auto study = [&] { return studies(window).convergence.study(); };
  window.until([&] { return study() && study()->done; }, "the order to be measured");
  CHECK(study()->points.size() == 5);  // dt to dt/16
  CHECK(measured_order(*study()).has_value());
  CHECK_FALSE(studies(window).accuracy.study().has_value());
  window.click("plots.csv_convergence");
  const auto rows = test::lines(test::read_file(window.write_export("convergence.csv")));
  REQUIRE(rows.size() == 7);
  CHECK(rows[1] == "dt [s],error [m],difference to dt/2 [m],status");
  CHECK(window.drew("nominal "));
  window.type_value("k_s", "60");  // what was measured says nothing of other constants
  window.frames(2);
  CHECK_FALSE(window.drew("nominal "));
  CHECK(window.drew("The order of Runge"));
  window.click("plots.accuracy_ways.1");
  window.until([&] { return studies(window).accuracy.study().has_value(); }, "the errors to come back");
  CHECK_FALSE(study().has_value());
}

TEST_CASE("crossing triangles are counted while the performance card is open, and outlined") {
  test::NullUi window({.preset = "bias"});
  window.until([&] { return window.t() > 1; }, "the cloth to pass through itself");
  window.pause();
  window.frames(2);
  CHECK_FALSE(studies(window).crossings.found().has_value());
  window.find("performance card");
  window.until([&] { return studies(window).crossings.found().has_value(); }, "the count");
  CHECK(studies(window).crossings.found()->pairs > 100);
  window.frames(2);
  CHECK(window.drew(grouped(studies(window).crossings.found()->pairs)));
}

TEST_CASE("the stability card marks the cloth's fastest mode on the method's growth, and follows k_s") {
  test::NullUi window;
  window.click("plots.Stability");
  window.until([&] { return dt_over_limit(window) > 0; }, "the limits");
  CHECK(dt_over_limit(window) < 1);
  window.type_value("k_s", "110");
  CHECK(window.preset().k_s == 110);
  window.until([&] { return dt_over_limit(window) > 1; }, "the limit to move");
}

TEST_CASE("the card keeps the ledger while it is open: energy moves from height to motion and into damping") {
  test::NullUi window;
  window.until([&] { return window.steps() > 20; }, "the cloth to move");
  CHECK_FALSE(window.cloth().ledger().has_value());
  window.click("plots.Energy");
  REQUIRE(window.cloth().ledger().has_value());
  window.until([&] { return window.cloth().ledger()->works.of[force::damping] < -1e-4; }, "damping to take energy");
  CHECK(std::abs(window.cloth().ledger()->share()) < 0.01);
  CHECK(window.cloth().ledger()->works.of[force::wind] == 0);
  const Series& curves = window.session.recorded.energy;  // no copy is needed for them
  REQUIRE(curves.size() > 5);
  CHECK(curves.column(0).back() > 0);
  CHECK(curves.column(2).back() < 0);
  if (!window.sees("plots.energy_plot")) window.scroll_to("plots.energy_plot", "plots.Energy");
  CHECK(window.sees("plots.energy_plot"));
  window.type_value("k_s", "90");
  window.until([&] { return window.cloth().ledger()->works.edits != 0; }, "the edit to be told");
  window.find("energy card");  // its heading comes back into sight
  window.click("plots.Energy");
  CHECK_FALSE(window.cloth().ledger().has_value());
}

TEST_CASE("energy that a method takes is called removed, and has no sign") {
  test::NullUi window({.with = [](Preset& preset) { preset.integrator = "implicit_euler", preset.dt = 0.01; }});
  window.pause();
  window.click("plots.Energy");
  window.key(GLFW_KEY_SPACE);
  window.until([&] { return window.cloth().ledger()->share() < -1e-3; }, "implicit Euler to take energy");
  window.frames(2);
  CHECK(window.drew("removed by the method"));
  CHECK_FALSE(window.drew("added by the method"));
}

TEST_CASE("what decides is shown: of an ω·dt just above Verlet's limit as many digits as tell it from 2") {
  test::NullUi window({.preset = "one_weight", .with = [](Preset& preset) {
                         preset.integrator = "verlet", preset.k_d = 0, preset.k = 1000;
                         preset.dt = 2.003 / std::sqrt(preset.k / preset.m);
                       }});
  window.pause();
  window.find("stability card");
  window.until([&] { return window.drew("2.003, above the limit 2: oscillations grow by 12 % per step."); },
               "the sentence");
}

TEST_CASE("what an open card needs is wanted in the frame that opens it, whether anything is drawn or not") {
  test::NullUi window;
  const Wants& wants = window.session.wants;
  const auto undrawn_frame = [&] { act_on_events(window.ui, 1.0 / 60, 1.0 / 60); };
  const auto after = [&](const char* command) {
    window.ui.command(command);
    undrawn_frame();
  };
  CHECK((wants.forces && wants.stability));
  CHECK_FALSE((wants.map || wants.ledger || wants.step));
  after("show_energy");
  CHECK(wants.ledger);
  CHECK(window.cloth().ledger().has_value());  // from the first step on
  after("toggle_map");
  CHECK(wants.map);
  const bool forces = wants.forces;
  for (int n = 0; n < 5; ++n) {
    undrawn_frame();
    CHECK((wants.map && wants.stability && wants.forces == forces));
  }
  after("toggle_map");
  CHECK_FALSE(wants.map);
  after("toggle_panels");
  CHECK_FALSE((wants.forces || wants.stability || wants.ledger));
  CHECK_FALSE(window.cloth().ledger().has_value());
}

TEST_CASE("what Euler makes of energy is seen, before it is a divergence" * doctest::test_suite("slow")) {
  test::NullUi window({.with = [](Preset& preset) { preset.integrator = "euler", preset.dt = 5e-5; }});
  window.pause();
  window.click("plots.Energy");
  window.key(GLFW_KEY_SPACE);
  window.until([&] { return window.cloth().ledger()->share() > 1e-4; }, "Euler to make energy");
  CHECK_FALSE(window.diverged());
}

TEST_CASE("dt follows the constants while it is automatic, until it is typed" * doctest::test_suite("slow")) {
  test::NullUi window;
  window.click("constants.auto");
  window.until([&] { return window.session.auto_dt.has_value(); }, "dt to become automatic");
  CHECK(window.said("and follows the constants."));
  const double before = window.preset().dt;
  window.type_value("k_s", "5000");
  window.until([&] { return window.preset().dt < before / 5; }, "dt to follow k_s");
  const double t = window.t();
  window.until([&] { return window.t() > t + 0.2; }, "the cloth to move on");
  CHECK_FALSE(window.diverged());
  window.type_value("dt", "0.0001");
  CHECK_FALSE(window.session.auto_dt.has_value());
  CHECK(window.preset().dt == 1e-4);
  CHECK_FALSE(window.session.messages.list().empty());
}

TEST_CASE("where a method has no stable dt, automatic says so and stays off") {
  test::NullUi window({.with = [](Preset& preset) { preset.integrator = "euler", preset.k_d = 0, preset.dt = 1e-5; }});
  window.click("constants.auto");
  window.until([&] { return !window.session.messages.list().empty(); }, "the reason");
  CHECK_FALSE(window.session.auto_dt.has_value());
  CHECK(window.preset().dt == 1e-5);
}

TEST_CASE("the level lines beside a mass on a spring say what they are, but not before a lab's prediction") {
  test::NullUi window({.preset = "one_weight"});
  window.frames(3);
  CHECK(window.drew("x₀: y = 1 m"));
  CHECK(window.drew("equilibrium"));
  find_labs(window.session);
  begin_lab(window.session, "01_hooke");
  window.frames(6);
  CHECK(window.drew("x₀: y = 1 m"));
  CHECK_FALSE(window.drew("equilibrium"));
}

TEST_CASE("paused, the picked particle's next step is written out; → makes it, and it comes out as foretold") {
  test::NullUi window({.with = [](Preset& preset) { preset.precision = Precision::double_; }});
  window.until([&] { return window.steps() > 60; }, "the cloth to move");
  window.pause();
  window.key(GLFW_KEY_I);
  const auto shown = [&] { return window.session.inspector.shown(); };
  window.until([&] { return shown() != nullptr; }, "the step to be written out");
  const Pins::Site picked = *window.session.picked;
  CHECK(shown()->i == picked.i);
  CHECK(shown()->j == picked.j);
  CHECK(shown()->stages.size() == 1);  // Verlet looks once
  CHECK(shown()->stages.front().stencils.size() == 20);
  const glm::dvec3 foretold = shown()->x_after;
  window.rest();
  const std::int64_t before = window.steps();
  window.key(GLFW_KEY_RIGHT);
  CHECK(window.steps() == before + 1);
  CHECK(glm::length(window.cloth().position(picked.i, picked.j) - foretold) < 1e-12);
  CHECK(shown()->x_after != foretold);  // it is the next one
  window.click("plots.close_inside");
  CHECK(shown() == nullptr);
}

TEST_CASE("in a narrow column a step's vectors take two lines and a spring one, without a cut or broken number") {
  for (const auto& [theme, height] : {std::pair{"dark", 720}, {"projector", 1080}}) {
    CAPTURE(std::string(theme));
    test::NullUi window(
        {.size = {1280, height}, .settings = [theme = theme](Settings& settings) { settings.theme = theme; }});
    window.until([&] { return window.steps() > 60; }, "the cloth to move");
    window.pause();
    window.key(GLFW_KEY_I);
    window.until([&] { return window.drew("spring to stretch, % force, "); }, "the step");
    for (const char* text : {"x, m", "v, seen, ", "(16, 17)"}) CHECK(window.drew(text));
    for (const std::string& text : window.cut_texts()) {
      CAPTURE(text);
      CHECK_FALSE(text.starts_with("plots"));
    }
  }
}

TEST_CASE("every evaluation of Runge-Kutta's step is told") {
  test::NullUi window({.with = [](Preset& preset) { preset.integrator = "rk4"; }});
  window.key(GLFW_KEY_I);
  window.until([&] { return window.session.inspector.shown() != nullptr; }, "the step to be written out");
  CHECK(window.session.inspector.shown()->stages.size() == 4);
}

/// A square cloth; a sixth as wide where sanitizers slow its studies down.
test::UiOptions cloth_of(int side) {
  if (test::sanitized) side = std::max(side / 6, 3);
  return {.with = [side](Preset& preset) { preset.rows = preset.columns = side; }};
}

TEST_CASE("the accuracy card measures the present settings beside the frames, anew when a constant changes") {
  test::NullUi window(cloth_of(32));
  const auto study = [&] { return studies(window).accuracy.study(); };
  window.frames(10);
  CHECK_FALSE(study().has_value());  // nothing is measured while nobody looks
  window.click("plots.Accuracy");
  const auto error = [&] { return study() && study()->present ? study()->present->error_rms_m : std::nan(""); };
  window.until([&] { return error() > 0; }, "the error to be measured");
  CHECK(error() < 1e-3);
  const double t = window.t();
  CHECK(t > 0);
  window.until([&] { return study()->points.size() > 3; }, "other methods beside it");
  window.until([&] { return window.t() > t; }, "the cloth to move on");
  window.type_value("dt", "0.0001");
  CHECK_FALSE(window.drew("Verlet's error is"));  // what was found of the dt before is not shown as the present one's
  window.until([&] { return error() < 2e-6; }, "the error of a tenth of dt");
  window.click("plots.Accuracy");
  CHECK_FALSE(study().has_value());  // the work ends with the card
}

TEST_CASE("settings for an error are found beside the frames, ranked by their cost, and used with a click" *
          doctest::test_suite("slow")) {
  test::NullUi window(cloth_of(5));
  const auto search = [&] { return studies(window).settings.search(); };
  window.find("settings for an error");
  CHECK(window.drew("Error at most"));
  CHECK_FALSE(search().has_value());  // nothing is measured before it is asked for
  CHECK_FALSE(studies(window).accuracy.study().has_value());
  window.pause();
  window.click("plots.target");
  window.key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  window.type("nonsense");
  window.key(GLFW_KEY_ENTER);
  CHECK(window.said("“nonsense” is not a length"));
  CHECK_FALSE(search().has_value());
  window.click("plots.target");
  window.key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  window.type("0.5 mm");
  window.key(GLFW_KEY_ENTER);
  window.until([&] { return search().has_value(); }, "the search to begin");
  CHECK(search()->goal.tolerance == doctest::Approx(5e-4));
  window.until([&] { return search()->done; }, "the search to end");
  const auto reached = settings_for(*search(), 5e-4);
  REQUIRE_FALSE(reached.empty());  // how many are measured to their end depends on what they cost here and now
  CHECK(std::is_sorted(reached.begin(), reached.end(), [](auto& a, auto& b) { return a.cost < b.cost; }));
  const Preset before = window.preset();
  window.frames(2);
  std::size_t row = reached.size();  // the last one in sight: a slow machine measures more than the card has room for
  while (row > 1 && !window.sees("plots.setting" + std::to_string(row))) --row;
  const Preset chosen = with_setting(before, reached[row - 1]);
  window.click("plots.setting" + std::to_string(row));
  window.until([&] { return window.preset() == chosen; }, "the setting to be used");
  CHECK(window.sees("plots.setting1"));  // the ranking stays: it is about the same motion
  window.until([&] { return window.drew("× before"); }, "costs to be those of the settings of before");
  window.rest();
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  window.until([&] { return window.preset() == before; }, "one undo to take method and dt back");
  window.type_value("k_s", "90");
  window.until([&] { return window.drew("The constants have changed"); }, "the ranking to be taken back");
  CHECK_FALSE(window.sees("plots.setting1"));
  window.click("plots.Accuracy");
  window.until([&] { return !search().has_value(); }, "the search to end with its card");
}

TEST_CASE("a search for settings is stopped with the button that began it, and begun again") {
  test::NullUi window(cloth_of(60));  // which takes seconds
  const auto& watch = studies(window).settings;
  window.pause();
  window.find("settings for an error");
  window.click("plots.Find");
  window.until([&] { return window.sees("plots.Stop"); }, "a button that stops");
  window.until([&] { return watch.search().has_value(); }, "the search to begin");
  CHECK(watch.searching());
  window.click("plots.Stop");
  window.until([&] { return window.sees("plots.Find"); }, "a button that begins");
  CHECK(watch.stopped());
  CHECK_FALSE(watch.searching());
  CHECK(window.drew("Stopped"));
  CHECK_FALSE(watch.search()->done);
  window.click("plots.Find");
  window.until([&] { return window.drew("First come fine runs"); }, "the search to begin anew");
  CHECK(watch.searching());
}

TEST_CASE("an error that cannot be promised is refused, and the tightest that can be is a click away" *
          doctest::test_suite("slow")) {
  test::NullUi window(cloth_of(4));
  const auto search = [&] { return studies(window).settings.search(); };
  window.pause();
  window.find("settings for an error");
  window.click("plots.target");
  window.key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  window.type("1e-12");
  window.click("plots.Find");
  window.until([&] { return search() && search()->done; }, "the search to end");
  window.frames(2);  // the card makes room for what is said
  CHECK(window.drew("The tightest tolerance that can be guaranteed is"));
  CHECK_FALSE(window.sees("plots.setting1"));
  const double tightest = tightest_tolerance(*search());
  window.frames(2);
  window.click(window.control_beginning("plots.Use"));
  window.until([&] { return window.sees("plots.setting1"); }, "settings for what can be promised");
  CHECK(*studies(window).settings.tolerance() == doctest::Approx(tightest));
}

TEST_CASE("the map fills while the cloth moves; a click takes k_s and dt from it; M closes it and ends the work" *
          doctest::test_suite("slow")) {
  test::NullUi window(cloth_of(13));
  const auto cells = [&] {
    const auto map = studies(window).map.findings();
    return map ? map->cells.size() : 0;
  };
  window.key(GLFW_KEY_M);
  const Box map = window.control("plots.map");
  const auto at = [&](float x, float y) { return map.lo + glm::vec2(x, y) * (map.hi - map.lo); };
  window.until([&] { return cells() > 60; }, "cells to be measured");
  const double t = window.t();
  window.until([&] { return cells() > 140 && window.t() > t; }, "a quarter of the map, while the cloth moves on");
  window.move(at(0.8f, 0.2f));
  window.frames(2);
  CHECK(window.drew("Click to use these values."));
  window.click(at(0.8f, 0.2f));
  CHECK(window.preset().k_s > 200);
  CHECK(window.preset().dt > 0.003);
  window.until([&] { return window.diverged(); }, "what the map foretold: it diverges");
  window.click(at(0.3f, 0.6f));
  CHECK(window.preset().k_s < 50);
  CHECK(window.preset().dt < 0.001);
  window.key(GLFW_KEY_M);
  window.frames(2);
  CHECK_FALSE(studies(window).map.findings().has_value());
}

TEST_CASE("the Map card says in whole words that a cloth is too large for it") {
  for (const double scale : {1.0, 1.5}) {
    CAPTURE(scale);
    test::NullUi window({.with = [](Preset& p) { p.rows = p.columns = 160; },
                         .size = {1280, 720},
                         .settings = [scale](Settings& s) { s.ui_scale = scale; }});
    window.pause();
    window.key(GLFW_KEY_M);
    window.frames(6);
    CHECK(window.drew("This cloth is too large to be mapped here."));
    for (const std::string& cut : window.cut_texts()) {
      CAPTURE(cut);
      CHECK(cut.find("cloth") == std::string::npos);
    }
  }
}

TEST_CASE("the Energy card has the textbook's names, and says what a whole bar stands for") {
  test::NullUi window({.preset = "one_weight",
                       .with = [](Preset& preset) { preset.k = 10, preset.g = 0, preset.offset = 0.2; },
                       .size = {1600, 900}});
  window.pause();
  window.click("plots.Energy");
  window.frames(3);
  for (const char* name : {"kinetic", "elastic, stretch", "gravitational potential", "total"}) CHECK(window.drew(name));
  CHECK(window.drew("full scale 0.2 J"));  // ½ k x²
}

/// Whether the last frame drew anything in that color.
bool drew_color(ImU32 color) {
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n)
    for (const ImDrawVert& corner : data.CmdLists[n]->VtxBuffer)
      if (corner.col == color) return true;
  return false;
}

TEST_CASE("the Energy card has bars in a narrow column too") {
  for (const char* theme : {"dark", "light", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window({.settings = [=](Settings& settings) { settings.theme = theme; }});
    const ImU32 bar = faded(window.ui.theme.colors.accent, 0.8f);
    window.frames(20);
    CHECK_FALSE(drew_color(bar));
    window.find("energy card");
    window.frames(4);
    CHECK(drew_color(bar));
    CHECK(window.drew("full scale"));
    for (const std::string& text : window.cut_texts()) CHECK_FALSE(text.starts_with("plots"));
  }
}

TEST_CASE("the Energy card says since when it counts, and offers to count from the start") {
  test::NullUi window({.size = {1600, 1000}});
  window.until([&] { return window.t() > 0.3; }, "some motion");
  window.find("energy card");
  window.pause();
  window.frames(4);
  REQUIRE(window.cloth().ledger());
  CHECK(window.cloth().ledger()->began > 0.3);
  CHECK(window.drew("counted since t = 0."));
  window.click("plots.count_from_start");
  window.frames(4);
  CHECK(window.cloth().ledger()->began == 0);
  CHECK(window.drew("counted since the start"));
}

TEST_CASE("a plot that was hidden for a while shows no old span as if it were the present") {
  test::NullUi window;
  window.until([&] { return window.t() > 0.3; }, "some motion");
  window.key(GLFW_KEY_F5);
  window.find("stability card");  // in place of the forces
  const double hidden = window.t();
  window.until([&] { return window.t() > hidden + 11; }, "more than a plot holds");
  window.pause();
  window.key(GLFW_KEY_F5);
  window.frames(2);
  CHECK(window.drew("No samples after t = "));
  CHECK(window.cut_texts().empty());
  window.key(GLFW_KEY_SPACE);
  window.frames(4);
  CHECK_FALSE(window.drew("No samples after t = "));
}

TEST_CASE("once the pull before an explosion is undone and redone, the plot shows what it still has") {
  test::NullUi window;
  window.until([&] { return window.t() > 0.3; }, "some motion");
  window.drag({window.pixel_of(16, 16), window.pixel_of(16, 20)}, GLFW_MOUSE_BUTTON_RIGHT);
  const double pulled = window.t();
  window.until([&] { return window.t() > pulled + 0.6; }, "more than an explosion takes");
  window.type_value("k_s", "3000");
  window.until([&] { return window.diverged(); }, "the divergence");
  for (int n = 0; n < 2; ++n) window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  REQUIRE(window.t() < pulled + 0.1);
  for (int n = 0; n < 2; ++n) window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
  window.frames(2);
  REQUIRE(window.diverged());
  REQUIRE(window.t() > pulled + 0.6);
  CHECK_FALSE(window.session.recorded.forces.empty());
  CHECK_FALSE(window.drew("No samples after t = "));
}

TEST_CASE("what the Energy card shows moves no divergence") {
  std::int64_t steps[2] = {};
  for (const bool open : {false, true}) {
    test::NullUi window(test::UiOptions{.preset = "explodes"});
    if (open) window.find("energy card");
    window.key(GLFW_KEY_R);
    window.until([&] { return window.diverged(); }, "the divergence");
    steps[open] = window.cloth().divergence()->step;
  }
  CHECK(steps[0] == steps[1]);
}

TEST_CASE("the gallery of exact answers is measured beside the frames, until it is stopped or its card is closed") {
  test::NullUi window;
  window.pause();
  const VerifyWatch& watch = studies(window).verification;
  CHECK_FALSE(window.session.wants.verification);
  window.find("exact answers");
  window.frames(2);
  CHECK(window.session.wants.verification);
  CHECK(window.drew("Cases with exact or published answers."));
  CHECK(window.drew("Free fall, damped and not"));
  CHECK(window.drew("not measured yet"));
  CHECK_FALSE(watch.running());
  window.click("plots.Run");
  window.until([&] { return watch.findings() && watch.findings()->cases.size() >= 2; }, "two cases");
  CHECK(watch.running());
  window.frames(2);
  CHECK(window.drew("measured 4.91 m, exact 4.91 m"));
  CHECK(window.drew(" hold, "));
  CHECK_FALSE(window.drew("Measured 4.91 m, exact 4.91 m."));
  const Box run = window.control("plots.Stop");
  window.move({run.lo.x + 30, run.hi.y + 60});  // over the first case
  window.frames(2);
  CHECK(window.drew("Measured 4.91 m, exact 4.91 m."));
  window.click("plots.Stop");
  CHECK_FALSE(watch.running());
  window.frames(2);
  CHECK(window.drew("stopped after "));
  for (const VerifiedCase& one : watch.findings()->cases) CHECK(one.ok);
  window.click("plots.close_verification");
  window.frames(2);
  CHECK_FALSE(window.session.wants.verification);
  CHECK_FALSE(watch.findings().has_value());
}

TEST_CASE("what is said of a run of the gallery") {
  VerifyFindings findings;
  CHECK(verify_words(findings, true).starts_with("Measuring the first of "));
  findings.cases.resize(3);
  findings.cases[0].ok = findings.cases[2].ok = true;
  CHECK(verify_words(findings, true).starts_with("2 of 3 hold, 3 of "));
  CHECK(verify_words(findings, false).starts_with("2 of 3 hold; stopped after 3 of "));
  findings.done = true;
  CHECK(verify_words(findings, false) == "2 of 3 hold.");
  findings.problem = "It is too hot.";
  CHECK(verify_words(findings, false) == "It is too hot.");
}

TEST_CASE("the findings of the gallery go through bytes as they are") {
  VerifyFindings findings;
  findings.cases = {{"slide", 1, 2, 0.5, 2.0, false, "rk4", 1, 2, {{0, 0, 0}, {1, 2, 3}}},
                    {"wind", 3, 3, 0, {}, true, ""}};
  findings.problem = "none", findings.done = true;
  const VerifyFindings back = from_bytes<VerifyFindings>(bytes_of(findings));
  REQUIRE(back.cases.size() == 2);
  CHECK(back.cases[0].name == "slide");
  CHECK(back.cases[0].x == findings.cases[0].x);
  CHECK(back.cases[0].order == 2.0);
  CHECK(back.cases[0].at == "rk4");
  CHECK_FALSE(back.cases[1].order.has_value());
  CHECK(back.cases[1].ok);
  CHECK(back.problem == "none");
  CHECK(back.done);
}

}  // namespace tyglab::cards_test
