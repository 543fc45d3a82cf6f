// The engine's menu, and cloths that are built beside the frames.
#include <doctest/doctest.h>

#include "app/base/glfw_keys.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "tests/support/devices.h"
#include "tests/ui/null_ui.h"

namespace tyglab::engine_ui_test {

constexpr int ctrl = GLFW_MOD_CONTROL;

/// Opens the menu, and waits until it is known which devices there are.
void open_menu(test::NullUi& window) {
  window.click("top.engine");
  window.until([&] { return window.session.studies.devices.found() != nullptr; }, "the devices to be known");
  window.frames(2);
}

bool rests(test::NullUi& window) {
  return !window.session.rebuild.busy();
}

TEST_CASE("a step's time can be limited where the method solves, and a lab has no limit") {
  test::NullUi window;
  CHECK_FALSE(window.drew("unlimited"));
  Preset stiff = window.preset();
  stiff.integrator = "implicit_euler", stiff.k_s = 1e5, stiff.dt = 0.02;
  window.session.propose(stiff);
  window.frames(4);
  window.click("constants.step_limit");
  window.click("menu.limit_5");
  window.frames(3);
  CHECK(window.drew("5 ms per step"));
  CHECK(window.session.simulation->step_limit() == 0.005);
  begin_lab(window.session, "07_implicit");
  window.frames(4);
  CHECK(window.session.step_limit == 0);
  CHECK_FALSE(window.drew("unlimited"));
}

TEST_CASE("while a large cloth is built the frames of the present one go on, and then it is as its file says") {
  test::NullUi window;
  Preset large = window.preset();
  large.rows = large.columns = 1024, large.L = 0.0005, large.name = "Large cloth";
  const std::filesystem::path file = window.config / "large.json";
  write_atomically(file, preset_to_json(large));
  window.key(GLFW_KEY_O, ctrl);
  window.fill("path", file.string());
  const std::int64_t before = window.session.rebuild.frames_beside();
  const std::int64_t steps = window.steps();
  window.key(test::NullUi::enter);
  window.until([&] { return window.session.rebuild.opens(); }, "the cloth to be ordered");
  CHECK(window.preset().rows == 32);
  window.until([&] { return window.session.document.label == "large"; }, "the large cloth");
  CHECK(window.session.rebuild.frames_beside() - before >= 3);
  CHECK(steps > 0);
  CHECK(window.preset().rows == 1024);
  CHECK(rests(window));
  CHECK_FALSE(unsaved(window.session));
}

TEST_CASE("\"Automatic\" takes the engine that is fastest, and says why") {
  test::NullUi window;
  open_menu(window);
  window.click("menu.automatic_engine");
  window.until([&] { return window.said("Automatic: "); }, "a choice");
  const bool cpu = window.said("Automatic: the CPU engine");
  window.until([&] { return rests(window); }, "the engine");
  CHECK((window.preset().engine == EngineKind::cpu) == cpu);
  const double t = window.t();
  window.until([&] { return window.t() > t; }, "the cloth to go on");
}

TEST_CASE("an engine chosen by the menu and the palette; a method of the CPU engine alone brings that along") {
  if (test::skipped_without_device()) return;
  test::NullUi window;
  window.pause();
  open_menu(window);
  window.click("menu.opencl_float");
  window.until([&] { return window.preset().engine == EngineKind::opencl && rests(window); }, "the OpenCL engine");
  window.click("plots.Copies");
  for (const char* copy : {"Accurate_solution_Dormand_Prince_5_4_tolerance_1e_9_m", "XPBD"}) {
    window.add_copy(copy);
    CHECK(window.session.messages.list().empty());  // nothing speaks against it
  }
  window.key(GLFW_KEY_SPACE);
  window.until(
      [&] {
        return window.t() > 0.3 && cloth_of(window.session, 0).time() > 0.25 &&
               cloth_of(window.session, 1).time() > 0.25;
      },
      "them to move with the original");
  window.pause();
  window.find("xpbd");
  CHECK(window.preset().integrator == "xpbd");
  CHECK(window.preset().engine == EngineKind::cpu);
  REQUIRE(window.session.messages.list().size() == 1);
  CHECK(window.drew("XPBD runs only on the CPU engine, so that engine was chosen."));
  window.key(GLFW_KEY_Z, ctrl);
  window.until([&] { return rests(window); }, "the undo");
  CHECK(window.preset().integrator != "xpbd");
  CHECK(window.preset().engine == EngineKind::opencl);
}

// Run as a test of its own, by which the loader of OpenCL finds nothing.
TEST_CASE("where there is no OpenCL device its entries are gray, say why, and cannot be chosen" *
          doctest::test_suite("no_device")) {
  test::NullUi window;
  window.pause();
  open_menu(window);
  for (const std::string mode : {"menu.opencl_float", "menu.opencl_double"}) {
    CAPTURE(mode);
    const glm::vec2 at = window.middle(mode);
    window.click(at);
    CHECK(window.preset().engine == EngineKind::cpu);
    CHECK(window.session.messages.list().empty());
    CHECK(window.sees(mode));  // the menu stays open
    window.frames(60);
    CHECK(window.drew("No OpenCL device was found"));
  }
  window.move(window.middle("menu.cpu_double"));
  window.frames(60);
  CHECK(window.drew("On the CPU, in double: 16 significant digits"));
  window.click("menu.cpu_double");
  window.until([&] { return rests(window); }, "double");
  CHECK(window.preset().precision == Precision::double_);
}

}  // namespace tyglab::engine_ui_test
