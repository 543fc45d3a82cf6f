// The parts of the sandbox that need no window: pacing, undo, sampled series, typed numbers, plot ranges.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "app/base/messages.h"
#include "app/base/text.h"
#include "app/session/history.h"
#include "app/session/pacing.h"
#include "app/session/recorded.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::sandbox_test {

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
  history.record({with_k_s(1)}, 7);
  history.record({with_k_s(2)}, 7);  // the same drag
  history.record({with_k_s(3)}, 8);
  Preset present = with_k_s(4);
  CHECK(history.what(true, present) == "k_s 3 → 4 N/m");
  present = history.take(true, HistoryEntry{present}).constants;
  CHECK(present.k_s == 3);
  CHECK(history.what(true, present) == "k_s 1 → 3 N/m");
  CHECK(history.what(false, present) == "k_s 3 → 4 N/m");
  present = history.take(true, HistoryEntry{present}).constants;
  CHECK(present.k_s == 1);
  CHECK_FALSE(history.can_undo());
  present = history.take(false, HistoryEntry{present}).constants;
  CHECK(present.k_s == 3);
  history.record({present}, 0);
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
  const std::vector<SeriesColumn> columns{{"F_s", "N"}, {"share", ""}};
  const auto rows = test::lines(series.csv(columns, "a comment"));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == "# tyglab series, t in s, a comment");
  CHECK(rows[1] == "t,F_s [N],share");
  CHECK(rows[2] == "0.5,1,2");
}

TEST_CASE("numbers are read as people type them and shown short") {
  struct Typed {
    const char *text, *unit;
    double value;
  };
  for (const Typed& typed : {Typed{"50", "N", 50},
                             {" 0,25 ", "", 0.25},
                             {"1e-3 s", "s", 1e-3},
                             {"2 ms", "s", 2e-3},
                             {"9,8 cm", "m", 0.098},
                             {"0.06 kN/m", "N/m", 60},
                             {"3 g", "kg", 3e-3},
                             {"40 µs", "s", 4e-5},
                             {"2.5·10⁻¹² m", "m", 2.5e-12},
                             {"-9.82 m/s²", "m/s²", -9.82},
                             {"-9.82m/s^2", "m/s²", -9.82},
                             {".5", "", 0.5}}) {
    CAPTURE(std::string(typed.text));
    REQUIRE(typed_number(typed.text, typed.unit).has_value());
    CHECK(*typed_number(typed.text, typed.unit) == doctest::Approx(typed.value));
  }
  CHECK_FALSE(typed_number("3 N", "m").has_value());
  CHECK_FALSE(typed_number("3 m", "").has_value());
  CHECK_FALSE(typed_number("3 foot", "m").has_value());
  for (const char* text : {"", " ", "abc", "--5", "nan", "inf", "1e999"}) {
    CAPTURE(std::string(text));
    CHECK_FALSE(typed_number(text).has_value());
  }
  CHECK(short_number(310) == "310");
  CHECK(short_number(0.002) == "0.002");
  CHECK(short_number(0) == "0");
  CHECK(steady_number(0.00341) == "3.41·10⁻³");
  struct Shown {
    double value;
    const char *unit, *text;
  };
  for (const Shown& shown : {Shown{26.1e-6, "s", "26.1 µs"},
                             {0.002, "s", "0.002 s"},
                             {-4.04e-4, "N", "-0.404 mN"},
                             {4.04e-4, "N s/m", "0.404 mN s/m"},
                             {2e-6, "kg", "2 mg"},
                             {2.1e-5, "1/s", "2.1·10⁻⁵ 1/s"},
                             {1e-13, "m", "1·10⁻¹³ m"},
                             {3e7, "N/m", "3·10⁷ N/m"},
                             {18000, "", "18,000"},
                             {0, "N", "0 N"}})
    CHECK(quantity(shown.value, shown.unit) == shown.text);
  CHECK(scaled_unit(0.0048, "m/s²").name == "mm/s²");
  CHECK(grouped(1234567) == "1,234,567");
  CHECK(grouped(-123) == "-123");
  test::Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const double value = std::ldexp(random.uniform(-1, 1), random.below(60) - 30);
    CHECK(*typed_number(short_number(value)) == doctest::Approx(value).epsilon(1e-3));
    CHECK(*typed_number(steady_number(value)) == doctest::Approx(value).epsilon(1e-2));
  }
}

TEST_CASE("a time is shown with as many digits as a step needs to be seen") {
  CHECK(time_number(0.325, 1e-3) == "0.325");
  CHECK(time_number(12.0, 0.02) == "12.000");
  for (const double dt : {1.0, 0.3, 2.5e-3, 1e-3, 4.5e-4, 1e-4, 3e-6, 1e-7})
    for (const double t : {0.0, 0.123, 61.7}) CHECK(time_number(t, dt) != time_number(t + dt, dt));
}

TEST_CASE("three messages at most are kept, the latest") {
  Messages messages;
  for (const char* text : {"first", "second", "third", "fourth", "third"}) messages.note(text);
  REQUIRE(messages.list().size() == 3);
  CHECK(messages.list()[0].text == "second");
  CHECK(messages.list()[2].text == "third");
}

TEST_CASE("a message that waits behind a more important one is not lost") {
  Messages messages;
  messages.error("first");
  messages.note("second");
  messages.error("third");
  messages.warning("fourth");
  REQUIRE(messages.list().size() == 3);
  CHECK(messages.next_end() == 0);  // nothing has been shown: at once
  CHECK(messages.foremost() == 1);  // of the errors the latest
  messages.show(1, 0);
  CHECK(messages.next_end() == 8);
  messages.age(8.1);
  REQUIRE(messages.list().size() == 2);
  CHECK(messages.list()[messages.foremost()].text == "fourth");
  messages.show(1, 8.1);
  messages.age(16.2);
  REQUIRE(messages.list().size() == 1);
  CHECK(messages.list()[messages.foremost()].text == "second");
  messages.show(0, 16.2);
  messages.age(20.3);
  CHECK(messages.list().empty());
}

TEST_CASE("a message that is already shown is renewed, and stands there once") {
  Messages messages;
  const auto age = [&](double now) {
    messages.age(now);
    for (std::size_t k = 0; k < messages.list().size(); ++k) messages.show(k, now);
  };
  messages.note("the same");
  age(0);
  messages.note("another");
  age(3);
  for (int n = 0; n < 3; ++n) messages.note("the same");
  REQUIRE(messages.list().size() == 2);
  age(3);
  messages.age(6.9);  // 4 s after it was first said, and before 4 s after it was said again
  CHECK(messages.list().size() == 2);
  messages.age(7.1);
  CHECK(messages.list().empty());
}

/// Red, green and blue, linear, as seen by a person who lacks the long-wave or the middle-wave cones (Viénot, Brettel
/// and Mollon 1999), or by one who lacks none; then as lightness and two opponent colors (Oklab, Ottosson 2020).
glm::dvec3 seen(ImU32 color, int lacking) {
  const auto linear = [](unsigned c) { return std::pow(double(c & 255) / 255, 2.2); };
  glm::dvec3 rgb{linear(color), linear(color >> 8), linear(color >> 16)};
  const double mix = lacking == 1 ? 0.11238 : 0.29275, blue = lacking == 1 ? 0.00401 : -0.02234;
  if (lacking > 0) {
    const double red_green = mix * rgb.r + (1 - mix) * rgb.g;
    rgb = {red_green, red_green, blue * (rgb.r - rgb.g) + rgb.b};
  }
  const double l = std::cbrt(0.4122 * rgb.r + 0.5363 * rgb.g + 0.0514 * rgb.b);
  const double m = std::cbrt(0.2119 * rgb.r + 0.6807 * rgb.g + 0.1074 * rgb.b);
  const double s = std::cbrt(0.0883 * rgb.r + 0.2817 * rgb.g + 0.6300 * rgb.b);
  return {0.2105 * l + 0.7936 * m - 0.0041 * s, 1.9780 * l - 2.4286 * m + 0.4506 * s,
          0.0259 * l + 0.7828 * m - 0.8087 * s};
}

TEST_CASE("every integrator has a color or a line of its own, which the color-blind can tell apart") {
  const Tokens colors = dark_tokens();
  for (const std::string_view a : integrator_names())
    for (const std::string_view b : integrator_names()) {
      if (a == b) continue;
      CAPTURE(std::string(a));
      CAPTURE(std::string(b));
      const CurveStyle one = integrator_style(colors, a), other = integrator_style(colors, b);
      CHECK(one.color != colors.vermilion);  // the exact solution's
      if (one.line != other.line) continue;
      for (const int lacking : {0, 1, 2})
        CHECK(glm::distance(seen(one.color, lacking), seen(other.color, lacking)) > 0.06);
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
  std::vector<double> x, calm, blown, constant, broken, rest;
  for (int n = 0; n < 500; ++n) {
    x.push_back(n * 0.01);
    calm.push_back(std::sin(n * 0.1));
    blown.push_back(n < 495 ? std::sin(n * 0.1) : std::pow(10.0, n - 400));
    constant.push_back(2);
    rest.push_back(0.9018 + 1e-15 * n);
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
    const PlotRange still = plot_range(std::vector<PlotCurve>{{"y", {}, x, rest}}, frame);
    CHECK(still.hi - still.lo > 0.01);  // rounding is no motion
    const PlotRange range = plot_range(curves[1], frame);
    CHECK(range.hi < 100);
    CHECK(range.hi >= 1);
    CHECK(range.lo <= -1);
  }
}

TEST_CASE("a plot's axis has more than two ticks, and a twentieth of it is free above the curves") {
  for (const bool log : {false, true})
    for (const bool from_zero : {false, true})
      for (const double most : {1e-9, 0.001, 0.0011, 0.002, 0.0021, 0.0049, 0.005, 0.00501, 0.0099, 0.01, 1.0, 3.7e5})
        for (const double part : {0.0, 0.05, 0.3, 0.8, 0.98}) {
          CAPTURE(log);
          CAPTURE(from_zero);
          CAPTURE(most);
          CAPTURE(part);
          const std::vector<double> x{0, 1, 2, 3}, y{part * most, most, most, most};
          const PlotRange range = plot_range(std::vector<PlotCurve>{{"F", {}, x, y}}, {0, 4, log, from_zero, "N", ""});
          const PlotScale scale{range.lo, range.hi, log};
          CHECK(scale.at(most) <= 0.9500001);
          if (!log) CHECK(scale.at(most) > 0.3);
          int seen = 0;
          for (const double tick : range.ticks) seen += scale.at(tick) > -1e-9 && scale.at(tick) < 1 + 1e-9;
          CHECK(seen > 2);
          if (from_zero && !log) CHECK(range.lo == 0);
        }
}

}  // namespace tyglab::sandbox_test
