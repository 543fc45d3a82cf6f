// State files give back the very same numbers; series are tables that programs can read.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/output/obj.h"
#include "core/output/series_csv.h"
#include "core/output/state_csv.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::csv_test {

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  CHECK(end == text.c_str() + text.size());
  return value;
}

TEST_CASE("17 digits bring back every double") {
  test::Random random(4);
  for (int n = 0; n < 20000; ++n) {
    const double value = std::ldexp(random.uniform(-1, 1), random.below(200) - 100);
    std::string text;
    append_number(text, value);
    CHECK(number(text) == value);
  }
  for (const double value : {0.0, 5e-324, 1.7976931348623157e308, 0.1, 1.0 / 3, -2.5, 1e22}) {
    std::string text;
    append_number(text, value);
    CHECK(number(text) == value);
  }
}

TEST_CASE("what is not finite is an empty cell, and no coordinate of a mesh") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double value : {infinite, -infinite, std::nan("")}) {
    std::string text = "1,";
    append_number(text, value);
    CHECK(text == "1,");
    append_number(text, value, 9);
    CHECK(text == "1,");
    CHECK_THROWS_WITH_AS(float_coordinate(value), doctest::Contains("too large"), OutputError);
  }
  CHECK_THROWS_AS(float_coordinate(-1e39), OutputError);
  CHECK(float_coordinate(3e38) == 3e38f);

  Simulation simulation(test::cloth(3, 2));
  State state = simulation.read();
  state.v.y[3] = infinite, state.x.z[5] = -infinite;
  const std::string rows = state_csv(simulation.tears(), state, {0.5, 7, "hash"});
  CHECK(rows.find("inf") == std::string::npos);
  for (const std::string& row : test::lines(rows))
    if (!row.starts_with("#")) CHECK(std::count(row.begin(), row.end(), ',') == 7);
  CHECK_THROWS_AS(obj_text(simulation.tears(), state.x, {}), OutputError);
}

TEST_CASE("a state file holds the stamp, the header and every particle to the last bit") {
  Simulation simulation(test::cloth(5, 4));
  simulation.advance(123);
  const State& state = simulation.read_raw();
  const auto rows = test::lines(state_csv(simulation));
  REQUIRE(rows.size() == 2 + 20);
  CHECK(rows[0].starts_with("# tyglab state, t = 0.123"));
  CHECK(rows[0].find(", steps = 123, preset hash " + preset_hash(simulation.preset())) != std::string::npos);
  CHECK(rows[1] == "i,j,x,y,z,vx,vy,vz");
  for (int p = 0; p < 20; ++p) {
    const auto cells = test::split(rows[std::size_t(p) + 2], ',');
    REQUIRE(cells.size() == 8);
    CHECK(cells[0] == std::to_string(p / 4));
    CHECK(cells[1] == std::to_string(p % 4));
    const double wanted[] = {state.x.x[p], state.x.y[p], state.x.z[p], state.v.x[p], state.v.y[p], state.v.z[p]};
    for (int c = 0; c < 6; ++c) CHECK(number(cells[std::size_t(c) + 2]) == wanted[c]);
  }
}

TEST_CASE("a state file of one weight has one row") {
  Simulation simulation(test::one_weight());
  simulation.advance(10);
  const std::string text = state_csv(simulation.tears(), simulation.read_raw(), {0.01, 10, "0"});
  CHECK(test::lines(text).size() == 3);
}

TEST_CASE("a time series has a t column, units in the header and a value in every cell") {
  for (const Preset& preset : {test::cloth(5, 4), test::one_weight()}) {
    const test::TemporaryFolder folder;
    Simulation simulation(preset);
    const auto columns = series_columns(preset.kind);
    SeriesCsv series(folder / "t.csv", columns, preset_hash(preset));
    for (int n = 0; n < 5; ++n) {
      series.add(simulation.time(), series_values(simulation));
      simulation.advance(10);
    }
    series.end();
    const auto rows = test::lines(test::read_file(folder / "t.csv"));
    REQUIRE(rows.size() == 2 + 5);
    CHECK(rows[0].starts_with("#"));
    CHECK(rows[0].find("t in s") != std::string::npos);
    CHECK(rows[0].find(preset_hash(preset)) != std::string::npos);
    const auto names = test::split(rows[1], ',');
    CHECK(names[0] == "t");
    REQUIRE(names.size() == columns.size() + 1);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      CHECK(names[c + 1].starts_with(columns[c].name));
      if (!columns[c].unit.empty()) CHECK(names[c + 1].find("[" + columns[c].unit + "]") != std::string::npos);
    }
    for (int n = 0; n < 5; ++n) {
      const auto cells = test::split(rows[std::size_t(n) + 2], ',');
      REQUIRE(cells.size() == names.size());
      CHECK(number(cells[0]) == doctest::Approx(n * 10 * preset.dt));
      for (const std::string& cell : cells) CHECK(std::isfinite(number(cell)));
    }
  }
}

TEST_CASE("outputs that cannot be written say so by name") {
  const test::TemporaryFolder folder;
  const auto missing = folder / "missing" / "file.csv";
  try {
    write_output(missing, state_csv(Tears({2, 1}), start_state(test::cloth(2, 1)), {}));
    FAIL_CHECK("written");
  } catch (const OutputError& error) {
    CHECK(std::string(error.what()).find(missing.string()) != std::string::npos);
  }
  const auto columns = series_columns(Kind::cloth);
  CHECK_THROWS_AS(SeriesCsv(missing, columns, ""), OutputError);
  CHECK_THROWS_AS(SeriesCsv("/dev/full", columns, ""), OutputError);
}

}  // namespace tyglab::csv_test
