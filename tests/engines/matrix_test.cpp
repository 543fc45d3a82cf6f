// The CPU engine against OpenCL over everything that a scene can have: methods, precisions, sizes, features, and what
// is done to the cloth while it moves, drawn from a seed. What differs is made smaller, feature by feature, for as long
// as it still differs, and the message says how to play that alone.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "core/engines/opencl/opencl_devices.h"
#include "core/io/preset_io.h"
#include "core/theory/advice.h"
#include "tests/engines/engine_pair.h"
#include "tests/support/devices.h"

namespace tyglab::matrix_test {

using test::Pair;
using test::Random;

constexpr std::uint64_t seed = 20;
constexpr int long_run = 250;  // pairs, each of which builds a program or two

constexpr std::array features{"bending", "damping", "wind",      "gusts", "pins",   "sphere",   "plane",
                              "tearing", "hand",    "F_release", "cuts",  "a pin",  "a change", "a body that moves",
                              "stretch", "speed",   "explosion", "air",   "threads"};

std::vector<std::string> opencl_methods() {
  std::vector<std::string> methods;
  for (const Scheme& method : schemes())
    if (runs_on_opencl(method)) methods.emplace_back(method.name);
  return methods;
}

/// A pair for each method and precision, in the order of Scene::make.
int short_run() {
  return int(2 * opencl_methods().size());
}

/// One pair of the matrix; a shrunk one is without some of the features, and smaller.
struct Case {
  std::uint64_t seed = 0, number = 0;
  unsigned without = 0;  ///< bits, as features
  int halved = 0;        ///< how often each side is

  std::string text() const {
    std::ostringstream out;
    out << seed << ':' << number << ':' << without << ':' << halved;
    return out.str();
  }
};

/// What `TYGLAB_MATRIX=SEED:NUMBER:WITHOUT:HALVED` asks for.
std::optional<Case> asked_for() {
  const char* text = std::getenv("TYGLAB_MATRIX");
  if (text == nullptr) return std::nullopt;
  Case one;
  char colon = 0;
  std::istringstream(text) >> one.seed >> colon >> one.number >> colon >> one.without >> colon >> one.halved;
  return one;
}

/// Both engines, and the CPU engine once more from a start that differs in the last digits: how far apart rounding
/// alone takes the motion.
struct Trio {
  explicit Trio(const Preset& preset) : pair(preset), shaken(preset) {
    Random random(1);
    State state = shaken.read();
    const double digit = preset.precision == Precision::float_ ? 0x1p-23 : 0x1p-52;
    for (auto* x : {&state.x.x, &state.x.y, &state.x.z})
      for (double& coordinate : *x) coordinate += digit * random.uniform(-1, 1);
    test::load(shaken, state);
  }
  void apply(const Edit& edit) { pair.apply(edit), shaken.apply(edit); }
  void change(const std::function<void(Preset&)>& what) {
    pair.change(what);
    Preset next = shaken.preset();
    what(next);
    shaken.apply(edit::Change{next});
  }
  void advance(int steps) { pair.advance(steps), shaken.advance(steps); }

  Pair pair;
  Simulation shaken;
};

/// The scene of a case. Every choice has random numbers of its own, so that the others stay where a feature goes.
class Scene {
 public:
  explicit Scene(const Case& of) : of_(of) { make(); }

  const Preset& preset() const { return preset_; }
  std::string text() const {
    std::string all = preset_.integrator + (preset_.precision == Precision::float_ ? ", float, " : ", double, ") +
                      std::to_string(preset_.rows) + " x " + std::to_string(preset_.columns);
    for (const char* feature : features)
      if (has(feature)) all += std::string(", ") + feature;
    return all;
  }
  bool has(std::string_view feature) const {
    const auto bit = unsigned(std::find(features.begin(), features.end(), feature) - features.begin());
    const int one_in = feature == "explosion" ? 12 : feature == "tearing" || feature == "stretch" ? 3 : 2;
    return (of_.without >> bit & 1) == 0 && random(std::string(feature)).below(one_in) == 0;
  }

  /// What is done to both after `part` of three parts of the run.
  void handle(Trio& all, int part) const {
    const int i = random("row").below(preset_.rows), j = random("column").below(preset_.columns);
    const auto aside = [&](const char* what, double by) {
      Random r = random(what);
      return glm::dvec3(r.uniform(-by, by), r.uniform(-by, by), r.uniform(-by, by));
    };
    if (part == 1 && has("hand")) {
      all.apply(edit::Grab{i, j});
      all.apply(edit::MoveHand{all.pair.cpu.position(i, j) + aside("way", 0.05), 25});
    }
    if (part == 1 && has("cuts")) {
      Random r = random("cut");
      edit::Cut cut;
      for (int n = 0; n < 5; ++n) cut.sites.push_back({r.below(preset_.rows), r.below(preset_.columns)});
      all.apply(cut);
    }
    if (part == 2 && has("hand")) all.apply(edit::Release{});
    if (part == 2 && has("a pin")) all.apply(edit::Pin{preset_.rows - 1 - i, j, true});
    if (part == 2 && has("a change"))
      all.change([](Preset& p) { p.k_s *= 1.3, p.m *= 1.1, p.g = 5, p.dt *= 0.7, p.k_d *= 0.5; });
    if (part == 2 && has("a body that moves") && has("sphere"))
      all.apply(edit::MoveBody{0, preset_.bodies[0].c + aside("body", 0.02)});
  }

 private:
  Random random(const std::string& what) const {
    std::uint64_t name = 0;
    for (const char c : what) name = name * 31 + std::uint8_t(c);
    return Random((of_.seed << 48) + (of_.number << 32) + name);
  }

  void make() {
    const std::vector<std::string> methods = opencl_methods();
    Preset& p = preset_ = test::cloth(2, 1, methods[std::size_t(of_.number) % methods.size()]);
    p.precision = of_.number / methods.size() % 2 == 0 ? Precision::float_ : Precision::double_;
    size();
    constants();
    bodies();
    if (has("explosion")) p.dt = std::min(1.0, 3 * std::max(p.dt, 1e-3)), p.k_s *= 300;
  }

  void size() {
    constexpr std::array rows{2, 3, 5, 8, 15, 16, 17, 31, 33, 47, 64}, columns{1, 2, 3, 7, 8, 9, 16, 17, 31, 33, 65};
    Preset& p = preset_;
    p.rows = rows[std::size_t(random("rows").below(int(rows.size())))];
    p.columns = columns[std::size_t(random("columns").below(int(columns.size())))];
    if (is_implicit(scheme(p.integrator))) p.rows = std::min(p.rows, 17), p.columns = std::min(p.columns, 17);
    p.rows = std::max(2, p.rows >> of_.halved), p.columns = std::max(1, p.columns >> of_.halved);
  }

  void constants() {
    Preset& p = preset_;
    p.tilt_deg = random("tilt").uniform(0, 90);
    p.k_b = has("bending") ? 5 : 0, p.k_d = has("damping") ? 0.002 : 0;
    if (has("wind")) p.W = {0.001, 0.0005, 0.002};
    if (has("threads")) p.k_warp = 70, p.k_shear = 5;
    if (has("air") && !is_implicit(scheme(p.integrator))) p.air_density = 1.2, p.C_T = 0.1, p.u = {1, 0.5, -3};
    if (has("gusts")) p.gust = 0.5, p.gust_period = 0.03;
    p.pins.mode = has("pins") ? Pins::Mode(1 + random("pins of").below(5)) : Pins::Mode::none;
    if (has("stretch")) p.initial_stretch = random("stretched by").uniform(0.8, 1.2);
    if (has("tearing")) p.F_max = random("overload").uniform(0.02, 0.2);
    if (has("F_release")) p.F_release = 0.05;
    if (has("speed")) p.v_0 = {0.5, -0.3, 0.4};
    p.dt = std::min(1e-3, 0.4 * stable_dt(p, p.integrator));
    if (p.dt <= 0) p.dt = 2e-4;  // a method that is stable at none, over a short time
  }

  void bodies() {
    Preset& p = preset_;
    // Who bounces in one step and not in the next goes elsewhere: with float's rounding that would decide.
    const double restitution = p.precision == Precision::double_ ? 0.5 : 0;
    const double width = p.L * std::max(p.rows, p.columns);
    if (has("sphere"))
      p.bodies.push_back(
          {.c = p.x_0 - glm::dvec3(0, 0.4 * width + 0.01, -0.3 * width), .r = 0.4 * width, .friction = 0.4});
    if (has("plane"))
      p.bodies.push_back({.shape = Body::Shape::plane, .y = p.x_0.y - 0.005, .restitution = restitution});
  }

  Case of_;
  Preset preset_;
};

/// Whether the last digits decide what happens: what tears, lets go or turns over.
bool decided_by_rounding(Trio& trio) {
  Simulation &cpu = trio.pair.cpu, &shaken = trio.shaken;
  constexpr double much = 10;  // tolerances
  return cpu.divergence().has_value() != shaken.divergence().has_value() || cpu.steps() != shaken.steps() ||
         cpu.tears().torn_count() != shaken.tears().torn_count() || cpu.held() != shaken.held() ||
         (!cpu.divergence() && test::distance(cpu.read(), shaken.read()) > much * test::tolerance(cpu.preset()));
}

/// What differs; empty where nothing does.
std::string difference(Trio& trio) {
  Pair& pair = trio.pair;
  std::ostringstream all;
  if (pair.opencl.divergence().has_value() != pair.cpu.divergence().has_value())
    return pair.cpu.divergence() ? "the CPU engine alone diverges" : "OpenCL alone diverges";
  if (pair.opencl.steps() != pair.cpu.steps()) all << pair.cpu.steps() << " and " << pair.opencl.steps() << " steps; ";
  if (pair.cpu.divergence() && pair.cpu.divergence()->quantity != pair.opencl.divergence()->quantity)
    all << pair.cpu.divergence()->quantity << " and " << pair.opencl.divergence()->quantity << "; ";
  if (!test::all_finite(pair.cpu.read()) || !test::all_finite(pair.opencl.read())) all << "something is not finite; ";
  if (pair.cpu.divergence()) return all.str();  // what grows a hundredfold in a step has no digits in common
  const int torn = pair.cpu.tears().torn_count(), torn_there = pair.opencl.tears().torn_count();
  if (torn != torn_there) all << torn << " and " << torn_there << " springs are torn; ";
  if (pair.cpu.left_inside() != pair.opencl.left_inside()) all << "others are left inside bodies; ";
  if (pair.cpu.held().has_value() != pair.opencl.held().has_value()) all << "one hand has let go; ";
  // Where a solve has been given up, each engine has another part of the way left.
  if (pair.cpu.engine().solves().unconverged + pair.opencl.engine().solves().unconverged > 0) return all.str();
  const double apart = test::distance(pair.opencl.read(), pair.cpu.read());
  constexpr double steps_that_round = 100;
  const double rounding = steps_that_round * test::distance(trio.shaken.read(), pair.cpu.read());
  if (!(apart <= std::max(test::tolerance(pair.cpu.preset()), rounding))) all << apart << " m apart; ";
  return all.str();
}

/// Over a whole run. `undecided` counts runs that end early, since rounding decides them.
std::string difference(const Case& one, int* undecided = nullptr) {
  constexpr int steps_of_part = 25, parts = 3;
  const Scene scene(one);
  Trio trio(scene.preset());
  for (int part = 0; part < parts; ++part) {
    scene.handle(trio, part);
    trio.advance(steps_of_part);
    if (decided_by_rounding(trio)) {
      if (undecided != nullptr) ++*undecided;
      break;
    }
    if (const std::string wrong = difference(trio); !wrong.empty())
      return wrong + "after " + std::to_string(trio.pair.cpu.steps()) + " steps";
    if (trio.pair.cpu.divergence()) break;
  }
  return "";
}

/// The smallest case that still differs.
Case shrunk(Case one) {
  for (unsigned bit = 0; bit < features.size(); ++bit) {
    Case simpler = one;
    simpler.without |= 1u << bit;
    if (simpler.without != one.without && !difference(simpler).empty()) one = simpler;
  }
  for (Case smaller = one; smaller.halved < 6; one = smaller) {
    ++smaller.halved;
    if (difference(smaller).empty()) break;
  }
  return one;
}

void check(const Case& one, int* undecided = nullptr) {
  const std::string wrong = difference(one, undecided);
  if (wrong.empty()) return;
  const Case least = shrunk(one);
  FAIL_CHECK("pair ", one.text(), " (", Scene(one).text(), "): ", wrong, "\nsmaller: ", Scene(least).text(), ": ",
             difference(least), "\n", preset_to_json(Scene(least).preset()), "\nplay it: TYGLAB_MATRIX=", least.text(),
             " build/release/bin/engines_tests --test-case='pairs of both engines*'");
}

void check_pairs(int from, int end) {
  if (test::skipped_without_device()) return;
  if (const auto one = asked_for()) return check(*one);
  int undecided = 0;
  for (int number = from; number < end; ++number) check({seed, std::uint64_t(number)}, &undecided);
  CHECK(undecided * 10 < end - from);
}

TEST_CASE("pairs of both engines make the same motion" * doctest::test_suite("matrix")) {
  check_pairs(0, short_run());
}

TEST_CASE("many pairs of both engines make the same motion" * doctest::test_suite("long")) {
  check_pairs(short_run(), long_run);
}

}  // namespace tyglab::matrix_test
