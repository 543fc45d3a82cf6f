// Samples over time, as plots and their files show them.
#include "app/session/recorded.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "app/session/motion.h"
#include "tests/app/desk.h"
#include "tests/support/scenes.h"

namespace tyglab::series_test {

void add(Series& series, double from, int samples) {
  for (int n = 0; n < samples; ++n) series.add(from + n, std::array{1.0});
}

std::vector<std::size_t> gaps(const Series& series) {
  return {series.gaps().begin(), series.gaps().end()};
}

TEST_CASE("where steps passed without samples, the curve has a gap, and only there") {
  Series series(1);
  series.interrupt();
  add(series, 0, 3);
  CHECK(gaps(series).empty());  // before the first sample there is nothing to leave out
  series.interrupt(), series.interrupt();
  add(series, 10, 2);
  CHECK(gaps(series) == std::vector<std::size_t>{3});
  add(series, 5, 1);  // time went back: a new series
  CHECK(gaps(series).empty());
}

TEST_CASE("gaps stay with their samples when the oldest are dropped") {
  Series series(1);
  add(series, 0, 5);
  series.interrupt();
  add(series, 100, 34995);
  series.interrupt();
  add(series, 40000, 5000);
  REQUIRE(series.size() == 40000);
  const double behind = series.t()[35000];
  add(series, 50000, 1);
  REQUIRE(gaps(series).size() == 1);
  CHECK(series.t()[gaps(series)[0]] == behind);
}

TEST_CASE("what is plotted of a particle does not depend on how often pictures are drawn") {
  const auto samples = [](int frames) {
    test::Desk desk(test::cloth(6, 6));
    desk.session.picked = Pins::Site{3, 3};
    desk.session.pacing.playing = desk.session.pacing.patient = true;
    for (int n = 0; n < frames; ++n) {
      desk.session.wants.forces = true;
      desk.session.update(0.5 / frames, {});
    }
    CHECK(desk.session.simulation->time() > 0.3);
    return double(desk.session.recorded.forces.size()) / desk.session.simulation->time();
  };
  CHECK(samples(4) == doctest::Approx(240).epsilon(0.1));
  CHECK(samples(30) == doctest::Approx(240).epsilon(0.15));
}

TEST_CASE("a plot's file is a series of `run`: from t = 0 on, with the same names and values") {
  const Preset preset = test::cloth(6, 6);
  test::Desk desk(preset);
  Recorded& recorded = desk.session.recorded;
  recorded.chosen = Source::sum;
  const auto play = [&] {
    desk.session.pacing.playing = desk.session.pacing.patient = true;
    for (int n = 0; n < 3; ++n) {
      desk.session.wants.forces = true;
      desk.session.update(0.04, {});
    }
    desk.session.pacing.playing = false;
  };
  play();
  Simulation start(preset);
  const std::vector<SeriesColumn> columns = series_columns(preset.kind), plotted = force_columns(Source::sum);
  const std::vector<double> values = series_values(start);
  int shared = 0;
  for (std::size_t k = 0; k < plotted.size(); ++k)
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == plotted[k].name) {
        CHECK(recorded.forces.column(k)[0] == values[c]);
        CHECK(columns[c].unit == plotted[k].unit);
        ++shared;
      }
  CHECK(shared == 4);
  CHECK(recorded.forces.t()[0] == 0);
  CHECK(recorded.forces.size() > 1);
  restart(desk.session);
  play();
  CHECK(recorded.forces.t()[0] == 0);
  restart(desk.session);
  desk.session.wants.forces = true;
  single_step(desk.session, {});
  desk.session.update(0, {});
  REQUIRE(recorded.forces.size() == 2);
  CHECK(recorded.forces.t()[0] == 0);
  CHECK(recorded.forces.t()[1] == preset.dt);
}

TEST_CASE("a rewind keeps the samples up to where the motion goes on from") {
  Series series(1);
  for (int n = 1; n <= 10; ++n) series.add(0.1 * n, std::vector<double>{double(n)});
  series.go_on_from(0.55);
  REQUIRE(series.size() == 5);
  series.add(0.6, std::vector<double>{60.0});
  CHECK(series.size() == 6);
  CHECK(series.column(0)[4] == 5);
  CHECK(series.gaps().empty());
  series.go_on_from(2);  // an undone rewind
  series.add(2.1, std::vector<double>{1.0});
  CHECK(series.size() == 7);
  REQUIRE(series.gaps().size() == 1);
  CHECK(series.gaps()[0] == 6);
  series.go_on_from(0);
  CHECK(series.empty());
  CHECK(series.gaps().empty());
}

}  // namespace tyglab::series_test
