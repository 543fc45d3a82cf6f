// What the performance card says: what a scene needs is on, the rest is skipped; costs by part.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/ui/cards/cards.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::performance_test {

FeatureRow row(const test::Desk& desk, std::string_view name) {
  for (const FeatureRow& row : feature_rows(desk.ui))
    if (row.name == name) return row;
  FAIL("no row " << std::string(name));
  return {};
}

TEST_CASE("features that a scene needs are on, the others are skipped") {
  test::Desk desk;
  Preset preset = test::quiet_cloth(6, 6);
  desk.session.simulation = std::make_shared<Simulation>(preset);
  for (const char* name : {"bending", "damping", "wind", "bodies", "tearing", "tear masks", "plot data"})
    CHECK_MESSAGE(row(desk, name).activity == Activity::skipped, std::string(name));
  CHECK(row(desk, "divergence watch").activity == Activity::on);
  CHECK(row(desk, "normals").activity == Activity::on);
  desk.scene.view.mode = 5;
  CHECK(row(desk, "normals").activity == Activity::skipped);
  preset.k_b = 1, preset.k_d = 0.001, preset.W = {0, 0, 1}, preset.F_max = 5, preset.bodies.resize(1);
  desk.session.simulation->apply(edit::Change{preset});
  desk.session.simulation->apply(edit::Cut{{{3, 3}}});
  desk.session.wants.forces = true;
  for (const char* name : {"bending", "damping", "wind", "bodies", "tearing", "tear masks", "plot data"})
    CHECK_MESSAGE(row(desk, name).activity == Activity::on, std::string(name));
  CHECK_FALSE(row(desk, "bending").ms.has_value());
  CHECK(row(desk, "plot data").ms.has_value());
  desk.session.pacing.playing = false;
  CHECK(row(desk, "bending").activity == Activity::skipped);
}

TEST_CASE("the facts name the engine and the memory of the solver's arrays") {
  test::Desk desk(test::cloth(32, 32));
  const auto facts = performance_facts(desk.ui);
  CHECK(facts[0].value.find("CPU") != std::string::npos);
  CHECK(std::any_of(facts.begin(), facts.end(),
                    [](const auto& fact) { return fact.value.find("B/particle") != std::string::npos; }));
  const auto value = [&](std::string_view name) {
    for (const PerformanceFact& fact : performance_facts(desk.ui))
      if (fact.name == name) return fact.value;
    return std::string();
  };
  CHECK(value("masks and read-outs") == "1 kB");
  desk.session.simulation->forces(Reduction::sum);  // reads the whole state: six doubles a particle
  CHECK(value("masks and read-outs") == "50 kB");
  CHECK(value("undo") == "0 kB");
  for (int n = 0; n < 10; ++n) desk.session.history.record({desk.session.preset()}, 0);
  CHECK(value("undo") != "0 kB");
}

TEST_CASE("the time report gives every part, by the wall and by the processor") {
  FrameCosts costs;
  for (int n = 0; n < 3; ++n) {
    costs.add(Part::frame, {0.010, 0.008});
    costs.add(Part::simulate, {0.004, 0.004});
    if (n == 0) costs.add(Part::normals, {0.003, 0.001});
    if (n > 0) costs.add_copied(VertexPath::shared_buffer, 0, "", 600);
    costs.end_frame();
  }
  const auto report = nlohmann::json::parse(costs.json(100, 50, "an engine", "a preset"));
  CHECK(report["positions_come_by"] == "shared_buffer");
  CHECK(report["copied_bytes_per_frame"] == 0);
  CHECK(report["read_bytes_per_frame"] == 600);
  CHECK(report["frames"] == 3);
  CHECK(report["mean_ms_per_frame"]["frame"].get<double>() == doctest::Approx(10));
  CHECK(report["mean_ms_per_frame"]["normals"].get<double>() == doctest::Approx(1));
  CHECK(report["mean_cpu_ms_per_frame"]["frame"].get<double>() == doctest::Approx(8));
  CHECK(report["own_cpu_ms_per_frame"].get<double>() == doctest::Approx(4));
  CHECK(report["times_run"]["normals"] == 1);
  CHECK(report["times_run"]["upload"] == 0);
  CHECK(costs.recent_ms(Part::simulate) == doctest::Approx(4));
  CHECK(costs.recent_ms(Part::normals) < 3);
}

}  // namespace tyglab::performance_test
