// The palette finds everything by its words, and the table of commands holds all of them.
#include "app/ui/frame/palette.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <set>

#include "app/ui/frame/commands.h"
#include "app/ui/frame/keys.h"
#include "core/integrators/names.h"
#include "tests/support/scenes.h"

namespace tyglab::palette_test {

App app_with(const Preset& preset) {
  App app;
  app.simulation = std::make_unique<Simulation>(preset);
  return app;
}

std::string first_for(App& app, const char* typed) {
  const std::vector<PaletteEntry> entries = palette_entries(app);
  const std::vector<int> found = matching(entries, typed);
  return found.empty() ? "" : entries[std::size_t(found[0])].group + ": " + entries[std::size_t(found[0])].title;
}

TEST_CASE("what is typed finds commands, presets, methods, labs, constants and views") {
  App app = app_with(test::cloth(8, 8));
  CHECK(first_for(app, "restart") == "Command: Restart the motion");
  CHECK(first_for(app, "flag") == "Preset: Flag in the wind");
  CHECK(first_for(app, "RK4").find("Integrator: ") == 0);
  CHECK(first_for(app, "hooke").find("Lab: Hooke") == 0);
  CHECK(first_for(app, "k_d") == "Constant: k_d  Damping constant");
  CHECK(first_for(app, "dämpning") == "Constant: k_d  Damping constant");
  CHECK(first_for(app, "copy improved") == "Copy: Add a copy: Improved Euler");
  CHECK(first_for(app, "copy implicit euler") == "Copy: Add a copy: Implicit Euler");  // and not the semi-implicit one
  CHECK(first_for(app, "outlines") == "View: Outlines");
  CHECK(first_for(app, "opencl") == "Engine: OpenCL, float");
  CHECK(first_for(app, "cpu") == "Engine: CPU, float");
  CHECK(first_for(app, "cpu double") == "Engine: CPU, double");
  CHECK(first_for(app, "opencl double") == "Engine: OpenCL, double");
  CHECK(first_for(app, "double").find("Engine: ") == 0);
  CHECK(first_for(app, "precision").find("Engine: ") == 0);
  CHECK(first_for(app, "engine float").find("Engine: ") == 0);
  CHECK(first_for(app, "text larger") == "Command: Larger text");
  CHECK(first_for(app, "no such thing").empty());
  for (const char* card : {"Forces", "Copies", "Stability", "Accuracy", "Energy", "Performance"})
    CHECK(first_for(app, card) == "Command: " + std::string(card) + " card");
  CHECK(first_for(app, "stiff") == "Lab: k_s and the critical time step");
  const std::vector<PaletteEntry> entries = palette_entries(app);
  const std::vector<int> found = matching(entries, "stiffness against stretching");
  REQUIRE_FALSE(found.empty());
  CHECK(entries[std::size_t(found[0])].title.find("k_s") == 0);  // by its help alone
}

TEST_CASE("keys that follow the palette's Enter within its frame are kept for what comes after it") {
  ImGuiContext* gui = ImGui::CreateContext();
  ImGui::SetCurrentContext(gui);
  App app = app_with(test::cloth(8, 8));
  open_palette(app, false);
  app.input.keys = {{GLFW_KEY_ENTER, 0, false}, {GLFW_KEY_M, 0, false}};
  app.input.text = {{'x', 0}, {'m', 2}};
  handle_keys(app);
  CHECK(app.ui.palette.enter);
  CHECK(app.requests.empty());
  REQUIRE(app.input.text.size() == 1);  // what was typed before Enter is looked for, what came after it is not
  CHECK(app.input.text[0].character == 'x');
  app.input.clear();
  app.ui.palette.open = app.ui.palette.enter = false;  // it has acted
  handle_keys(app);
  REQUIRE(app.requests.size() == 1);
  CHECK(std::get<request::Do>(app.requests[0]).command == Command::toggle_map);
  handle_keys(app);
  CHECK(app.requests.size() == 1);
  ImGui::DestroyContext(gui);
}

TEST_CASE("a constant comes first by its key") {
  Preset windy = test::cloth(8, 8);
  windy.W = {0, 0, 1e-3};
  App app = app_with(windy);
  CHECK(first_for(app, "gust").find("Constant: W_gust ") == 0);
}

TEST_CASE("constants that play no part in the scene are left out") {
  App app = app_with(test::one_weight());
  CHECK(first_for(app, "stretching").find("Constant") != 0);
  CHECK(first_for(app, "constant of the mass on a spring").find("Constant: k ") == 0);
}

TEST_CASE("what is found does what it says") {
  App app = app_with(test::cloth(8, 8));
  const std::vector<PaletteEntry> entries = palette_entries(app);
  const auto act = [&](const char* typed) { entries[std::size_t(matching(entries, typed)[0])].act(app); };
  act("semi-implicit");
  act("take the tour");
  act("initial stretch");
  REQUIRE(app.requests.size() == 2);
  const auto& change = std::get<request::Apply>(app.requests[0]);
  CHECK(std::get<edit::Change>(change.edit).preset.integrator == "semi_implicit_euler");
  CHECK(std::get<request::Do>(app.requests[1]).command == Command::start_tour);
  CHECK(app.ui.slider.wanted_key == "initial_stretch");
  CHECK(app.settings.layout.folded.count("Start") == 0);
}

TEST_CASE("every command has one row, and no two share a key") {
  std::set<std::pair<int, int>> taken;
  std::set<Command> seen;
  for (const CommandRow& row : command_rows()) {
    CAPTURE(std::string(row.name));
    CHECK(seen.insert(row.command).second);
    CHECK((*row.keys != 0) == !row.chords.empty());
    CHECK((*row.keys != 0) == (*row.help != 0));
    for (const Chord& chord : row.chords) CHECK(taken.insert({chord.key, chord.mods}).second);
  }
  CHECK(seen.size() == std::size_t(Command::quit) + 1);
}

}  // namespace tyglab::palette_test
