// The parts of the sandbox that need no window: pacing, undo, sampled series, settings, typed numbers, plot ranges.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "app/panels/numbers.h"
#include "app/panels/plot.h"
#include "app/panels/symbol.h"
#include "app/sandbox/clock.h"
#include "app/sandbox/history.h"
#include "app/sandbox/series.h"
#include "app/sandbox/settings.h"
#include "core/notation/preset_io.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab {
namespace {

Preset with_k_s(double k_s) {
  Preset preset;
  preset.k_s = k_s;
  return preset;
}

TEST_CASE("simulated time keeps pace with real time, whatever the frame rate") {
  for (const double frame : {1 / 25.0, 1 / 60.0, 1 / 144.0}) {
    for (const double speed : {0.1, 1.0, 2.0}) {
      Pacing pacing;
      pacing.speed = speed;
      int steps = 0;
      for (int n = 0; n < int(10 / frame); ++n) {
        const int due = pacing.due(frame, 1e-3);
        steps += due;
        pacing.made(due, 1e-3, due * 1e-7);
      }
      // The first frames may be careful, until the cost of a step is known.
      CHECK(steps * 1e-3 == doctest::Approx(10 * speed).epsilon(0.03));
      CHECK(pacing.reached() == doctest::Approx(speed).epsilon(0.05));
    }
  }
}

TEST_CASE("a machine too slow drops time instead of falling ever further behind") {
  Pacing pacing;
  for (int n = 0; n < 200; ++n) {
    const int due = pacing.due(1 / 60.0, 1e-3);
    CHECK(due >= 0);
    if (n > 20) CHECK(due * 0.01 <= pacing.budget_s + 0.01);  // a step costs 10 ms here
    pacing.made(due, 1e-3, due * 0.01);
  }
  CHECK(pacing.reached() < 0.2);
}

TEST_CASE("undo and redo go gesture by gesture") {
  History history;
  CHECK_FALSE(history.can_undo());
  history.record(with_k_s(1), 7);
  history.record(with_k_s(2), 7);  // the same drag
  history.record(with_k_s(3), 8);
  Preset present = with_k_s(4);
  present = *history.undo(present);
  CHECK(present.k_s == 3);
  present = *history.undo(present);
  CHECK(present.k_s == 1);
  CHECK_FALSE(history.undo(present).has_value());
  present = *history.redo(present);
  CHECK(present.k_s == 3);
  history.record(present, 0);
  CHECK_FALSE(history.can_redo());
}

TEST_CASE("a series keeps its order, forgets its oldest samples, and writes a table") {
  Series series(2);
  for (int n = 0; n < 100000; ++n) series.add(n * 1e-3, std::vector<double>{double(n), -1.5});
  CHECK(series.size() > 1000);
  CHECK(series.size() < 50000);
  CHECK(series.column(0).size() == series.size());
  for (std::size_t n = 1; n < series.size(); ++n) CHECK(series.t()[n] > series.t()[n - 1]);
  CHECK(series.column(0).back() == 99999);
  series.add(0.5, std::vector<double>{1, 2});  // a restart
  CHECK(series.size() == 1);
  const std::vector<std::string> names{"F_s [N]", "F [N]"};
  const auto rows = test::lines(series.csv(names, "a comment"));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == "# a comment");
  CHECK(rows[1] == "t,F_s [N],F [N]");
  CHECK(rows[2] == "0.5,1,2");
}

TEST_CASE("settings come back, and a broken file gives a sentence and the defaults") {
  const test::TemporaryFolder folder;
  REQUIRE(setenv("TYGLAB_CONFIG_DIR", folder.path().c_str(), 1) == 0);
  std::string problem;
  CHECK(load_settings(problem).width == Settings{}.width);
  CHECK(problem.empty());
  Settings settings;
  settings.width = 1000;
  settings.ui_scale = 1.5;
  settings.layout.right = false;
  settings.session = Session{with_k_s(77), with_k_s(76), "denim", "/a/b.json"};
  save_settings(settings);
  const Settings again = load_settings(problem);
  CHECK(problem.empty());
  CHECK(again.width == 1000);
  CHECK(again.ui_scale == 1.5);
  CHECK(again.layout == settings.layout);
  REQUIRE(again.session.has_value());
  CHECK(again.session->preset == settings.session->preset);
  CHECK(again.session->saved == settings.session->saved);
  CHECK(again.session->label == "denim");
  for (const char* text : {"", "{", "{\"window\": {\"width\": \"wide\"}}", "{\"session\": {}}",
                           "{\"session\": {\"preset\": {\"forces\": {\"k_s\": -1}}}}", "{\"layout\": {\"folded\": 3}}",
                           "{\"ui_scale\": []}", "[]", "5", "{\"window\": 5}"}) {
    CAPTURE(std::string(text));
    test::write_file(folder / "settings.json", text);
    problem.clear();
    CHECK(load_settings(problem).width == Settings{}.width);
    CHECK(problem.find("settings.json") != std::string::npos);
    CHECK(problem.find("exception") == std::string::npos);
    // It is kept beside, whole.
    CHECK_FALSE(std::filesystem::exists(folder / "settings.json"));
    CHECK(test::read_file(folder / "settings.json.broken") == text);
  }
  test::write_file(folder / "settings.json", "{\"window\": {\"width\": -5, \"height\": 1e9}, \"ui_scale\": -3}");
  problem.clear();
  const Settings odd = load_settings(problem);
  CHECK(odd.width >= 100);
  CHECK(odd.height <= 20000);
  CHECK(odd.ui_scale > 0);
  unsetenv("TYGLAB_CONFIG_DIR");
}

TEST_CASE("numbers are read as people type them and shown short") {
  for (const auto& [text, value] : {std::pair{"50", 50.0},
                                    {" 0,25 ", 0.25},
                                    {"1e-3 s", 1e-3},
                                    {"-9.82 m/s²", -9.82},
                                    {"310 N/m", 310.0},
                                    {".5", 0.5}}) {
    CAPTURE(std::string(text));
    REQUIRE(typed_number(text).has_value());
    CHECK(*typed_number(text) == doctest::Approx(value));
  }
  for (const char* text : {"", " ", "abc", "--5", "nan", "inf", "1e999"}) {
    CAPTURE(std::string(text));
    CHECK_FALSE(typed_number(text).has_value());
  }
  CHECK(short_number(310) == "310");
  CHECK(short_number(0.002) == "0.002");
  CHECK(short_number(0) == "0");
  test::Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const double value = std::ldexp(random.uniform(-1, 1), random.below(60) - 30);
    CHECK(*typed_number(short_number(value)) == doctest::Approx(value).epsilon(1e-3));
    CHECK(*typed_number(steady_number(value)) == doctest::Approx(value).epsilon(1e-2));
  }
}

TEST_CASE("symbols are taken apart into base, subscript and dots") {
  CHECK(parse_symbol("k_s").base == "k");
  CHECK(parse_symbol("k_s").subscript == "s");
  CHECK(parse_symbol("F_release").subscript == "release");
  CHECK(parse_symbol("x''").dots == 2);
  CHECK(parse_symbol("x''").base == "x");
  CHECK(parse_symbol("dt").subscript.empty());
}

TEST_CASE("a plot's scale survives blow-ups, constants and nothing at all") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<double> x, calm, blown, constant, broken;
  for (int n = 0; n < 500; ++n) {
    x.push_back(n * 0.01);
    calm.push_back(std::sin(n * 0.1));
    blown.push_back(n < 495 ? std::sin(n * 0.1) : std::pow(10.0, n - 400));
    constant.push_back(2);
    broken.push_back(n % 2 == 0 ? NAN : inf);
  }
  for (const bool log : {false, true}) {
    const PlotFrame frame{0, 5, log, false, "N", ""};
    const std::vector<PlotCurve> curves[] = {
        {{"F", {}, x, calm}}, {{"F", {}, x, blown}}, {{"F", {}, x, constant}}, {{"F", {}, x, broken}}, {}};
    for (const auto& curve : curves) {
      const PlotRange range = plot_range(curve, frame);
      CHECK(std::isfinite(range.lo));
      CHECK(std::isfinite(range.hi));
      CHECK(range.lo < range.hi);
      CHECK(range.ticks.size() < 100);
    }
    if (log) continue;
    const PlotRange range = plot_range(curves[1], frame);
    CHECK(range.hi < 100);
    CHECK(range.hi >= 1);
    CHECK(range.lo <= -1);
  }
}

}  // namespace
}  // namespace tyglab
