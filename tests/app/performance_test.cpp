// What the performance card says: what a scene needs is on, the rest is skipped; costs by part.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/ui/cards/performance.h"
#include "tests/support/scenes.h"

namespace tyglab::performance_test {

FeatureRow row(const App& app, std::string_view name) {
  for (const FeatureRow& row : feature_rows(app))
    if (row.name == name) return row;
  FAIL("no row " << std::string(name));
  return {};
}

TEST_CASE("features that a scene needs are on, the others are skipped") {
  App app;
  Preset preset = test::quiet_cloth(6, 6);
  app.simulation = std::make_unique<Simulation>(preset);
  for (const char* name : {"bending", "damping", "wind", "bodies", "tearing", "tear masks", "plot data"})
    CHECK_MESSAGE(row(app, name).activity == Activity::skipped, std::string(name));
  CHECK(row(app, "divergence watch").activity == Activity::on);
  CHECK(row(app, "normals").activity == Activity::on);
  app.view.mode = 5;
  CHECK(row(app, "normals").activity == Activity::skipped);
  preset.k_b = 1, preset.k_d = 0.001, preset.W = {0, 0, 1}, preset.F_max = 5, preset.bodies.resize(1);
  app.simulation->apply(edit::Change{preset});
  app.simulation->apply(edit::Cut{{{3, 3}}});
  app.ui.plots.forces_shown = true;
  for (const char* name : {"bending", "damping", "wind", "bodies", "tearing", "tear masks", "plot data"})
    CHECK_MESSAGE(row(app, name).activity == Activity::on, std::string(name));
  CHECK_FALSE(row(app, "bending").ms.has_value());
  CHECK(row(app, "plot data").ms.has_value());
  app.pacing.playing = false;
  CHECK(row(app, "bending").activity == Activity::skipped);
}

TEST_CASE("the facts name the engine and the memory of the solver's arrays") {
  App app;
  app.simulation = std::make_unique<Simulation>(test::cloth(32, 32));
  const auto facts = performance_facts(app);
  CHECK(facts[0].value.find("CPU") != std::string::npos);
  CHECK(std::any_of(facts.begin(), facts.end(),
                    [](const auto& fact) { return fact.value.find("B/particle") != std::string::npos; }));
  const auto value = [&](std::string_view name) {
    for (const PerformanceFact& fact : performance_facts(app))
      if (fact.name == name) return fact.value;
    return std::string();
  };
  CHECK(value("masks and read-outs") == "1 kB");
  app.simulation->forces(Reduction::sum);  // reads the whole state: six doubles a particle
  CHECK(value("masks and read-outs") == "50 kB");
  CHECK(value("undo") == "0 kB");
  for (int n = 0; n < 10; ++n) app.history.record(app.preset(), 0);
  CHECK(value("undo") != "0 kB");
}

TEST_CASE("the time report gives every part, by the wall and by the processor") {
  FrameCosts costs;
  for (int n = 0; n < 3; ++n) {
    costs.add(Part::frame, {0.010, 0.008});
    costs.add(Part::simulate, {0.004, 0.004});
    if (n == 0) costs.add(Part::normals, {0.003, 0.001});
    if (n > 0) costs.add_copied(VertexWay::shared_buffer, 0, "", 600);
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
