// The palette finds everything by its words, and the table of commands holds all of them.
#include "app/ui/frame/panels.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <set>

#include "app/ui/frame/commands.h"
#include "app/ui/frame/frame.h"
#include "core/integrators/scheme.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::palette_test {

std::string first_for(test::Desk& desk, const char* typed) {
  const std::vector<PaletteEntry> entries = palette_entries(desk.ui);
  const std::vector<int> found = matching(entries, typed);
  return found.empty() ? "" : entries[std::size_t(found[0])].group + ": " + entries[std::size_t(found[0])].title;
}

TEST_CASE("what is typed finds commands, presets, methods, labs, constants and views") {
  test::Desk desk(test::cloth(8, 8));
  CHECK(first_for(desk, "restart") == "Command: Restart the motion");
  CHECK(first_for(desk, "flag") == "Preset: Flag in the wind");
  CHECK(first_for(desk, "RK4").find("Integrator: ") == 0);
  CHECK(first_for(desk, "hooke").find("Lab: Hooke") == 0);
  CHECK(first_for(desk, "k_d") == "Constant: k_d  Damping constant");
  CHECK(first_for(desk, "k_s").starts_with("Constant: k_s "));  // a lab's title begins so too
  CHECK(first_for(desk, "dt").starts_with("Constant: dt "));
  CHECK(first_for(desk, "dämpning") == "Constant: k_d  Damping constant");
  CHECK(first_for(desk, "copy improved") == "Copy: Add a copy: Improved Euler");
  CHECK(first_for(desk, "copy implicit euler") == "Copy: Add a copy: Implicit Euler");  // and not the semi-implicit one
  CHECK(first_for(desk, "outlines") == "View: Outlines");
  CHECK(first_for(desk, "opencl") == "Engine: OpenCL, float");
  CHECK(first_for(desk, "cpu") == "Engine: CPU, float");
  CHECK(first_for(desk, "cpu double") == "Engine: CPU, double");
  CHECK(first_for(desk, "opencl double") == "Engine: OpenCL, double");
  CHECK(first_for(desk, "double").find("Engine: ") == 0);
  CHECK(first_for(desk, "precision").find("Engine: ") == 0);
  CHECK(first_for(desk, "engine float").find("Engine: ") == 0);
  CHECK(first_for(desk, "text larger") == "Command: Larger text");
  CHECK(first_for(desk, "no such thing").empty());
  for (const char* card : {"Forces", "Copies", "Stability", "Accuracy", "Energy", "Performance"})
    CHECK(first_for(desk, card) == "Command: " + std::string(card) + " card");
  CHECK(first_for(desk, "stiffness") == "Lab: k_s and the critical time step");
  const std::vector<PaletteEntry> entries = palette_entries(desk.ui);
  const std::vector<int> found = matching(entries, "stiffness against stretching");
  REQUIRE_FALSE(found.empty());
  CHECK(entries[std::size_t(found[0])].title.find("k_s") == 0);  // by its help alone
}

TEST_CASE("keys that follow the palette's Enter within its frame are kept for what comes after it") {
  ImGuiContext* gui = ImGui::CreateContext();
  ImGui::SetCurrentContext(gui);
  test::Desk desk(test::cloth(8, 8));
  open_palette(desk.ui, false);
  desk.input.on_character('x');
  desk.input.on_key(GLFW_KEY_ENTER, GLFW_PRESS, 0);
  desk.input.on_key(GLFW_KEY_M, GLFW_PRESS, 0);
  desk.input.on_character('m');
  handle_keys(desk.ui);
  CHECK(desk.ui.palette.enter);
  CHECK(desk.ui.actions.empty());
  // What was typed before Enter is looked for, what came after it is not.
  REQUIRE(desk.input.all.size() == 3);
  CHECK(std::get<TypedCharacter>(desk.input.all[0]).code == 'x');
  for (const int key : {1, 2}) CHECK(std::holds_alternative<KeyEvent>(desk.input.all[key]));
  desk.input.clear();
  desk.ui.palette.open = desk.ui.palette.enter = false;  // it has acted
  handle_keys(desk.ui);
  REQUIRE(desk.ui.actions.size() == 1);
  desk.act();
  CHECK(desk.settings.layout.map);
  handle_keys(desk.ui);
  CHECK(desk.ui.actions.empty());
  ImGui::DestroyContext(gui);
}

TEST_CASE("a constant comes first by its key") {
  Preset windy = test::cloth(8, 8);
  windy.W = {0, 0, 1e-3};
  test::Desk desk(windy);
  CHECK(first_for(desk, "gust").find("Constant: W_gust ") == 0);
  test::Desk calm(test::cloth(8, 8));
  CHECK(first_for(calm, "gust").find("Constant: W_gust ") == 0);  // though it needs wind to act
}

TEST_CASE("constants that play no part in the scene are left out") {
  test::Desk desk(test::one_weight());
  CHECK(first_for(desk, "stretching").find("Constant") != 0);
  CHECK(first_for(desk, "constant of the mass on a spring").find("Constant: k ") == 0);
}

TEST_CASE("what is found does what it says") {
  test::Desk desk(test::cloth(8, 8));
  const std::vector<PaletteEntry> entries = palette_entries(desk.ui);
  const auto act = [&](const char* typed) { entries[std::size_t(matching(entries, typed)[0])].act(desk.ui); };
  act("semi-implicit");
  act("take the tour");
  act("initial stretch");
  REQUIRE(desk.session.requests.size() == 1);
  const auto& change = std::get<request::Apply>(desk.session.requests[0]);
  CHECK(std::get<edit::Change>(change.edit).preset.integrator == "semi_implicit_euler");
  desk.ui.run_actions();
  CHECK(desk.ui.tour.card == 0);
  CHECK(desk.ui.slider.wanted_key == "initial_stretch");
  CHECK(desk.settings.layout.folded.count("Start") == 0);
}

TEST_CASE("every command has one row, and no two share a key") {
  std::set<std::pair<int, int>> taken;
  std::set<std::string_view> seen;
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows) {
      CAPTURE(std::string(row.name));
      CHECK(seen.insert(row.id).second);
      CHECK((*row.keys != 0) == !row.chords.empty());
      CHECK((*row.keys != 0) == (*row.help != 0));
      for (const Chord& chord : row.chords) CHECK(taken.insert({chord.key, chord.mods}).second);
    }
  CHECK_THROWS_AS(row_of("no such command"), std::logic_error);
}

}  // namespace tyglab::palette_test
