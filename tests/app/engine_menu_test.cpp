// Engines and precisions as they are offered, and what follows from a method that runs on one engine alone.
#include "app/ui/constants/constants_panel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/integrators/scheme.h"
#include "tests/app/desk.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::engine_menu_test {

constexpr int cpu_double = 1, opencl_float = 2, opencl_double = 3;

OpenClDevice device_called(const char* name, bool processor, bool fp64) {
  OpenClDevice device;
  device.name = name, device.processor = processor, device.card = !processor, device.fp64 = fp64;
  return device;
}

/// Asks as panels do, and lets frames pass until it is there.
void act(test::Desk& desk) {
  desk.act();
  for (int n = 0; n < 20000 && desk.session.rebuild.busy(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    desk.session.rebuild.poll(desk.session);
  }
  REQUIRE_FALSE(desk.session.rebuild.busy());
}

Preset on_opencl() {
  Preset preset = test::cloth(8, 8);
  preset.engine = EngineKind::opencl;
  return preset;
}

TEST_CASE("what cannot run is not offered, and says why; until the devices are known all is offered") {
  Preset preset = test::cloth(8, 8);
  const auto modes = engine_modes();
  for (const EngineMode& mode : modes) CHECK(why_not(mode, preset, nullptr).empty());
  const OpenClInventory none{{}, "the loader found no platform"};
  for (const int n : {opencl_float, opencl_double}) {
    const std::string why = why_not(modes[std::size_t(n)], preset, &none);
    CHECK(why.find("No OpenCL device was found (the loader found no platform). ") == 0);
  }
  CHECK(why_not(modes[cpu_double], preset, &none).empty());
  const OpenClInventory two{{device_called("Processor", true, true), device_called("Card", false, false)}, ""};
  CHECK(why_not(modes[opencl_float], preset, &two).empty());
  CHECK(why_not(modes[opencl_double], preset, &two) ==
        "Card does not support double precision.");  // the card goes first
  CHECK(words_of(modes[opencl_float], preset, &two).find("With OpenCL on Card, in float") == 0);
  preset.device = 0;
  CHECK(why_not(modes[opencl_double], preset, &two).empty());
  CHECK(words_of(modes[opencl_double], preset, &two).find("With OpenCL on Processor, in double") == 0);
  preset.integrator = "xpbd";
  CHECK(why_not(modes[opencl_float], preset, &two).find("XPBD runs only on the CPU engine.") == 0);
  CHECK(why_not(modes[cpu_double], preset, &two).empty());
}

TEST_CASE("copies of a cloth on OpenCL take the CPU engine along where their method needs it, and no other do") {
  for (const CopyChoice& choice : copy_choices(on_opencl())) {
    CAPTURE(choice.label);
    Preset copy = copied_preset(on_opencl(), choice.differences);
    const bool alone = !runs_on_opencl(scheme(copy.integrator)) || choice.label == "CPU";
    CHECK((copy.engine == EngineKind::cpu) == alone);
  }
  Preset preset = test::cloth(8, 8);
  const Difference to_cpu{&Preset::engine, EngineKind::cpu};
  for (const CopyChoice& choice : copy_choices(preset))
    CHECK(std::count(choice.differences.begin(), choice.differences.end(), to_cpu) == 0);
  preset.integrator = "xpbd";
  for (const CopyChoice& choice : copy_choices(preset)) CHECK(choice.label != "OpenCL");
}

TEST_CASE("a method of the CPU engine alone brings it along: one change, one undo, and a note") {
  if (test::skipped_without_device()) return;
  for (const char* method : {"xpbd", "dopri5", "vbd"}) {
    CAPTURE(std::string(method));
    test::Desk desk(on_opencl());
    Preset next = desk.session.preset();
    next.integrator = method;
    desk.session.propose(next);
    act(desk);
    CHECK(desk.session.preset().integrator == method);
    CHECK(desk.session.preset().engine == EngineKind::cpu);
    REQUIRE(desk.session.messages.list().size() == 1);
    CHECK(desk.session.messages.list().front().text ==
          std::string(scheme(method).title) + " runs only on the CPU engine, so that engine was chosen.");
    desk.ui.command("undo");
    act(desk);
    CHECK(desk.session.preset() == on_opencl());
    CHECK_FALSE(desk.session.history.can_undo());
    for (const CopyChoice& choice : copy_choices(desk.session.preset()))
      if (!choice.differences.empty() && choice.differences.front() == Difference{&Preset::integrator, method}) {
        add_copy(desk.session, choice.differences, choice.reference);
        CHECK_FALSE(desk.session.copies.lockstep.empty());
        desk.session.copies.lockstep.clear();
      }
  }
}

}  // namespace tyglab::engine_menu_test
