// What studies find, as bytes and back: how a copy of the program in a page's worker hands it over.
#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <variant>

#include "app/scene/sketch.h"
#include "app/studies/accuracy_watch.h"
#include "app/studies/job.h"
#include "app/studies/map_watch.h"
#include "app/studies/transfer.h"

namespace tyglab::transfer_test {

static_assert(Transferable<AccuracyStudy> && Transferable<Convergence> && Transferable<MapFindings> &&
              Transferable<SettingsSearch> && Transferable<SceneSketch> && Transferable<std::monostate>);
static_assert(!Transferable<std::unique_ptr<int>>);

Preset unusual() {
  Preset preset;
  preset.name = "Å \"b\"\n", preset.k_s = 1.0 / 3, preset.device = 3, preset.rows = 7;
  preset.bodies.push_back({.shape = Body::Shape::plane, .y = -0.1});
  return preset;
}

ErrorPoint point_of(const char* method, double error) {
  return {.integrator = method, .dt = 0.1 + 0.2, .error_rms_m = error, .resolved = false, .given_up = true};
}

void check_same(const ErrorPoint& a, const ErrorPoint& b) {
  CHECK(a.integrator == b.integrator);
  CHECK(a.precision == b.precision);
  CHECK(a.dt == b.dt);
  CHECK(a.error_rms_m == b.error_rms_m);
  CHECK(a.resolved == b.resolved);
  CHECK(a.given_up == b.given_up);
}

template <class T>
T there_and_back(const T& object) {
  return from_bytes<T>(bytes_of(object));
}

TEST_CASE("a study of accuracy comes back whole, but for the reference's track") {
  AccuracyStudy study;
  study.of = unusual(), study.at = {3, 4, 5, 0.25};
  study.reference.track = {{{1, 2, 3}}};
  study.reference.method = "rk4", study.reference.agreement_rms_m = 1e-9;
  study.present = point_of("verlet", std::numeric_limits<double>::infinity());
  study.points = {point_of("rk4", 1e-5), point_of("a method whose name is longer than a short string", 2e-5)};
  study.reference_part = 0.5, study.methods_done = 2;
  study.problem = "none";
  const AccuracyStudy back = there_and_back(study);
  CHECK(back.of == study.of);
  CHECK(back.at == study.at);
  CHECK(back.reference.method == "rk4");
  CHECK(back.reference.agreement_rms_m == 1e-9);
  CHECK(back.reference.track.empty());
  REQUIRE(back.present);
  check_same(*back.present, *study.present);
  REQUIRE(back.points.size() == 2);
  check_same(back.points[1], study.points[1]);
  CHECK(back.reference_part == 0.5);
  CHECK(back.methods_done == 2);
  CHECK(back.problem == "none");
  CHECK_FALSE(back.done);
  CHECK_FALSE(there_and_back(AccuracyStudy{}).present);
}

TEST_CASE("a map, an order of convergence and a search for settings come back") {
  MapFindings map{unusual(), {1, 2, 3, 4, 5, 6}, {{1, 2}, {3}, {}}, {{1, 2, 3.5, 0.1, 0.2, true, 1, 0.5}}, "why"};
  const MapFindings same = there_and_back(map);
  CHECK(same.of == map.of);
  CHECK(same.grid == map.grid);
  CHECK(same.boundary.stiffness == map.boundary.stiffness);
  CHECK(same.boundary.every.empty());
  REQUIRE(same.cells.size() == 1);
  CHECK(same.cells[0].diverged);
  CHECK(same.problem == "why");

  Convergence order;
  order.of = unusual(), order.points = {{0.1, 1e-3, 2e-3, true}}, order.torn = 3, order.done = true;
  const Convergence order_back = there_and_back(order);
  CHECK(order_back.points[0].difference_rms_m == 2e-3);
  CHECK(order_back.torn == 3);
  CHECK(order_back.done);

  SettingsSearch search;
  search.of = unusual(), search.goal.tolerance = 1e-6, search.references = "two", search.methods_done = 2;
  search.points = {point_of("euler", 1)};
  const SettingsSearch search_back = there_and_back(search);
  CHECK(search_back.goal.tolerance == 1e-6);
  CHECK(search_back.references == "two");
  check_same(search_back.points[0], search.points[0]);
}

TEST_CASE("a sketch of a scene comes back") {
  SceneSketch sketch{{{{0.5f, 0.25f}, 1}}, {{0, 1, 2}}, {{{1, 2}, 3, 4}}, {{0, 1}, {1, 0}}};
  const SceneSketch back = there_and_back(sketch);
  CHECK(back.corners[0].at == sketch.corners[0].at);
  CHECK(back.triangles == sketch.triangles);
  CHECK(back.balls[0].behind == 4);
  CHECK(back.line == sketch.line);
}

}  // namespace tyglab::transfer_test
