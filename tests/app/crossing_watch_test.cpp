// Crossing triangles as the sandbox counts them beside the frames.
#include "app/studies/crossing_watch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <thread>

#include "app/ui/cards/cards.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::crossing_watch_test {

/// Polls as frames do until a count is there.
FoundCrossings counted_by(CrossingWatch& watch, StudyMoment& moment) {
  for (int n = 0; n < 2000; ++n) {
    watch.poll(moment);
    if (watch.found()) return *watch.found();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL("no count came");
  return {};
}

/// The cloth with all particles moved at random: by that many L, to either side.
void crumple(Simulation& simulation, double amount) {
  simulation.load(test::crumpled(simulation.preset(), 3, amount));
}

TEST_CASE("the count begins at once, is at most one per second, and is forgotten with its card") {
  Simulation simulation(test::cloth(12, 12));
  StudyMoment moment{simulation};
  moment.now = 10;
  CrossingWatch watch;
  CHECK(counted_by(watch, moment).pairs == 0);
  crumple(simulation, 2);
  simulation.advance(1);
  moment.now = 10.5, moment.again_at = 100;
  watch.poll(moment);
  CHECK(watch.found()->pairs == 0);
  CHECK(moment.again_at == doctest::Approx(11));
  moment.now = 11;
  for (int n = 0; n < 2000 && watch.found()->pairs == 0; ++n) {
    watch.poll(moment);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const Crossings expected = count_crossings(simulation.read().x, simulation.tears(), {1 << 30});
  CHECK(watch.found()->pairs == expected.pairs);
  CHECK(watch.found()->pairs > 0);
  std::set<int> crossing;
  for (const auto& pair : expected.listed) crossing.insert(pair.begin(), pair.end());
  CHECK(watch.found()->triangles == std::vector<int>(crossing.begin(), crossing.end()));
  watch.drop();
  CHECK_FALSE(watch.found().has_value());
}

TEST_CASE("of many crossing triangles a part from all over the cloth is kept to be outlined") {
  Simulation simulation(test::cloth(70, 70));
  crumple(simulation, 3);
  StudyMoment moment{simulation};
  CrossingWatch watch;
  const std::vector<int> triangles = counted_by(watch, moment).triangles;
  CHECK(triangles.size() > 1000);
  CHECK(triangles.size() <= 3000);
  CHECK(triangles.front() < 100);
  CHECK(triangles.back() > 2 * 69 * 69 - 100);
}

TEST_CASE("what was found of a cloth of another size is not shown") {
  Simulation simulation(test::cloth(12, 12)), other(test::cloth(5, 7));
  StudyMoment moment{simulation}, next{other};
  CrossingWatch watch;
  crumple(simulation, 2);
  CHECK(counted_by(watch, moment).pairs > 0);
  next.readable = false;
  watch.poll(next);
  CHECK_FALSE(watch.found().has_value());
}

TEST_CASE("the performance card says how many there are once they are counted") {
  test::Desk desk(test::cloth(12, 12));
  crumple(*desk.session.simulation, 2);
  const auto said = [&] {
    for (const PerformanceFact& fact : performance_facts(desk.ui))
      if (fact.name == "crossings") return fact.value;
    return std::string();
  };
  CHECK(said() == "–");
  StudyMoment moment = desk.session.study_moment();
  const FoundCrossings found = counted_by(desk.session.studies.crossings, moment);
  CHECK(said() == std::to_string(found.pairs));
}

}  // namespace tyglab::crossing_watch_test
