// Memory and threads that fail while a cloth is built, edited, moved and taken back: what is refused leaves the cloth
// as it was, and it goes on to the same bits.
#include <doctest/doctest.h>

#include <functional>

#include "core/simulation.h"
#include "tests/faults/cloth.h"
#include "tests/support/faults.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::simulation_faults_test {
namespace {

using test::Campaign, test::Fault;

/// A cloth on which an operation is tried.
class Moving final : public test::Scene {
 public:
  using Act = std::function<void(Simulation&)>;
  Moving(const Preset& preset, int threads, const Act& prepare, Act act)
      : cloth_(preset, threads), act_(std::move(act)) {
    if (prepare) prepare(cloth_);
  }
  void act() override { act_(cloth_); }
  std::string state() override { return test::told(cloth_); }
  std::string outcome() override { return test::told_later(cloth_); }

 private:
  Simulation cloth_;
  Act act_;
};

/// A cloth that is built, or not.
class Building final : public test::Scene {
 public:
  Building(Preset preset, int threads) : preset_(std::move(preset)), threads_(threads) {}
  void act() override { cloth_ = std::make_unique<Simulation>(preset_, threads_); }
  std::string state() override { return cloth_ ? test::told(*cloth_) : "none"; }
  std::string outcome() override { return cloth_ ? told_anywhere() : "none"; }

 private:
  /// With fewer threads the bits are the same.
  std::string told_anywhere() {
    cloth_->advance(20);
    std::string text = test::told(*cloth_);
    const std::string name = cloth_->engine().name();
    return text.erase(text.find(name), name.size());
  }
  Preset preset_;
  int threads_;
  std::unique_ptr<Simulation> cloth_;
};

Preset hanging(const std::string& method = "verlet", Precision precision = Precision::double_, int side = 12) {
  Preset preset = test::cloth(side, side, method);
  preset.precision = precision;
  return preset;
}

/// A cloth with everything: bodies, wind in gusts, springs that break.
Preset busy(const std::string& method = "verlet") {
  Preset preset = hanging(method);
  Body floor;  // that the lowest rows lie on from the start
  floor.shape = Body::Shape::plane, floor.y = Simulation(preset).position(preset.rows - 1, 0).y + 1.5 * preset.L;
  preset.bodies = {floor};
  preset.W = {0, 0, 1e-4}, preset.F_max = 50;
  return preset;
}

/// Steps up to the tenth, in however many calls: those before the fault count.
class Stepping final : public test::Scene {
 public:
  Stepping(const Preset& preset, int threads, bool ledger) : cloth_(preset, threads), twin_(preset, threads) {
    if (ledger) cloth_.enable_ledger(true);
  }
  void act() override {
    while (cloth_.steps() < last && !cloth_.divergence()) cloth_.advance(int(last - cloth_.steps()));
  }
  std::string state() override { return test::told(cloth_); }
  std::string problem(const test::Attempt& attempt, const std::string&) override {
    if (!attempt.out_of_memory) return "not refused for want of memory: " + attempt.sentence;
    twin_.advance(int(cloth_.steps()));
    return test::told(cloth_) == test::told(twin_) ? "" : "not the cloth of as many whole steps";
  }
  std::string outcome() override {
    act();
    return test::told(cloth_);
  }

 private:
  static constexpr std::int64_t last = 6;
  Simulation cloth_, twin_;
};

/// A cloth that goes back to an earlier moment.
class Back final : public test::Scene {
 public:
  explicit Back(const Preset& preset) : cloth_(preset), then_((cloth_.advance(3), cloth_.snapshot())) {
    cloth_.apply(edit::Grab{8, 6});
    cloth_.advance(4);
  }
  void act() override { cloth_.restore(then_); }
  std::string state() override { return test::told(cloth_); }
  std::string outcome() override { return test::told_later(cloth_); }

 private:
  Simulation cloth_;
  Snapshot then_;
};

constexpr int many = 78;                          // rows and columns for which four threads pay
constexpr int several = test::sanitized ? 2 : 4;  // threads; beyond the processors there are, most wait for others

void warmed(Simulation& cloth) {
  cloth.advance(5);
}

void edit_of(const char* name, const Preset& preset, const Moving::Act& act, const Moving::Act& prepare = warmed,
             int threads = 1) {
  test::inject({.operation = name, .kind = Fault::allocation, .lasts = true},
               [&] { return std::make_unique<Moving>(preset, threads, prepare, act); });
}

/// Applies what `change` makes of the present constants.
Moving::Act changed(const std::function<void(Preset&)>& change) {
  return [change](Simulation& cloth) {
    Preset next = cloth.preset();
    change(next);
    cloth.apply(edit::Change{next});
  };
}

}  // namespace

TEST_CASE("a cloth that is built" * doctest::test_suite("slow")) {
  const auto build = [](const char* name, const Preset& preset, int threads = 1) {
    test::inject({.operation = name, .kind = Fault::allocation, .dense = 60, .lasts = true},
                 [&] { return std::make_unique<Building>(preset, threads); });
  };
  build("build in double", busy());
  build("build in float", hanging("verlet", Precision::float_));
  build("build of an implicit method", hanging("implicit_euler"));
  build("build of a method that chooses its steps", hanging("dopri5"));
  build("build of a method that projects", hanging("xpbd"));
  build("build of a mass on a spring", test::one_weight());
  build("build with several threads", hanging("verlet", Precision::double_, many), several);
}

TEST_CASE("threads that cannot be started: fewer of them make the same bits") {
  test::inject({.operation = "build with several threads", .kind = Fault::thread, .may_pass = true},
               [&] { return std::make_unique<Building>(hanging("verlet", Precision::double_, many), 4); });
  for (std::int64_t n = 1; n <= 3; ++n) {
    std::unique_ptr<Simulation> cloth;
    test::attempt({Fault::thread, n, true},
                  [&] { cloth = std::make_unique<Simulation>(hanging("verlet", Precision::double_, many), 4); });
    REQUIRE(cloth != nullptr);
    CHECK(cloth->engine().threads() == int(n));
  }
}

TEST_CASE("an edit of constants" * doctest::test_suite("slow")) {
  edit_of("edit of k_s", busy(), changed([](Preset& p) { p.k_s *= 1.5; }));
  edit_of("edit of dt", busy(), changed([](Preset& p) { p.dt *= 0.5; }));
  edit_of("edit of dt, velocity Verlet", busy("velocity_verlet"), changed([](Preset& p) { p.dt *= 0.5; }));
  edit_of("edit of dt, leapfrog", busy("semi_implicit_euler"), changed([](Preset& p) { p.dt *= 0.5; }));
  edit_of("edit of tolerance", busy("dopri5"), changed([](Preset& p) { p.tolerance *= 10; }));
  edit_of("edit of bodies", hanging(), changed([](Preset& p) {
            Body plane;
            plane.shape = Body::Shape::plane, plane.y = -2;
            p.bodies = {plane};
          }));
  edit_of("edit of the wind", busy(), changed([](Preset& p) { p.W = {0, 0, 2e-4}, p.gust = 0.5; }));
  edit_of("edit of the name", busy(), changed([](Preset& p) { p.name = "a name that is longer than short strings"; }));
  edit_of("edit of pins", busy(), changed([](Preset& p) { p.pins.mode = Pins::Mode::four_corners; }));
  edit_of("edit of the rows", busy(), changed([](Preset& p) { p.rows += 3; }));
  edit_of("edit of the start, before it", busy(), changed([](Preset& p) { p.tilt_deg = 30; }), nullptr);
  edit_of("edit of the method", busy(), changed([](Preset& p) { p.integrator = "rk4"; }));
  edit_of("edit of the method and pins", busy(),
          changed([](Preset& p) { p.integrator = "implicit_euler", p.pins.mode = Pins::Mode::four_corners; }));
  edit_of("edit of the precision", busy(), changed([](Preset& p) { p.precision = Precision::float_; }));
  edit_of("restart", busy(), [](Simulation& cloth) { cloth.apply(edit::Restart{}); });
  edit_of("edit with several threads", hanging("verlet", Precision::float_, many),
          changed([](Preset& p) { p.k_s *= 2; }), warmed, several);
}

TEST_CASE("a hand, pins and cuts") {
  const auto applied = [](const Edit& edit) { return [edit](Simulation& cloth) { cloth.apply(edit); }; };
  const auto held = [](Simulation& cloth) { cloth.advance(5), cloth.apply(edit::Grab{8, 6}); };
  const auto with_ledger = [](Simulation& cloth) { cloth.enable_ledger(true), cloth.advance(5); };
  edit_of("grab", busy(), applied(edit::Grab{8, 6}));
  edit_of("move of the hand", busy(), applied(edit::MoveHand{{0.1, -0.2, 0.05}, 4}), held);
  edit_of("release", busy(), applied(edit::Release{}), held);
  edit_of("pin", busy(), applied(edit::Pin{7, 3, true}));
  edit_of("pin of the held particle", busy(), applied(edit::Pin{8, 6, true}), held);
  edit_of("unpin", busy(), applied(edit::Pin{0, 0, false}));
  edit_of("cut", busy(), applied(edit::Cut{{{5, 4}, {5, 5}, {5, 6}}}));
  edit_of("cut of springs", busy(), applied(edit::CutSprings{{{4, 4, 0}, {5, 5, 2}}}));
  edit_of("move of a body", busy(), applied(edit::MoveBody{0, {0.3, -0.1, 0}}));
  edit_of("grab with a ledger", busy(), applied(edit::Grab{8, 6}), with_ledger);
  edit_of("cut with a ledger", busy(), applied(edit::Cut{{{5, 4}, {5, 5}, {5, 6}}}), with_ledger);
  edit_of("pin with a ledger", busy(), applied(edit::Pin{7, 3, true}), with_ledger);
  edit_of("edit of k_s with a ledger", busy(), changed([](Preset& p) { p.k_s *= 1.5; }), with_ledger);
  edit_of("switching the ledger on", busy(), [](Simulation& cloth) { cloth.enable_ledger(true); });
}

TEST_CASE("steps: what is whole when memory fails stays, and is the same as ever" * doctest::test_suite("slow")) {
  const auto steps = [](const char* name, const Preset& preset, int threads = 1, bool ledger = false) {
    test::inject({.operation = name, .kind = Fault::allocation, .dense = threads > 1 ? 10 : 40, .lasts = true},
                 [&] { return std::make_unique<Stepping>(preset, threads, ledger); });
  };
  Preset tearing = busy();
  tearing.initial_stretch = 1.3, tearing.F_max = 0.1 * tearing.k_s * tearing.L;
  Preset gusty = busy();
  gusty.gust = 0.5;
  Preset explodes = hanging("euler");
  explodes.k_s = 1e6, explodes.dt = 1e-2;
  steps("steps", busy());
  steps("steps in gusts", gusty);
  steps("steps in which springs break", tearing);
  steps("steps of an implicit method", hanging("implicit_euler"));
  steps("steps of a stiff implicit method", [] {
    Preset stiff = hanging("implicit_euler");
    stiff.k_s = 1e5, stiff.dt = 0.02, stiff.F_max = 50;
    return stiff;
  }());
  steps("steps of a method that chooses its steps", busy("dopri5"));
  steps("steps of a method that projects", busy("xpbd"));
  steps("steps that alternate", busy("projective_dynamics"));
  steps("steps in which each particle solves for itself", busy("vbd"));
  steps("steps that diverge", explodes);
  steps("steps with a ledger", busy(), 1, true);
  steps("steps with a ledger in which springs break", tearing, 1, true);
  Preset wide = tearing;
  wide.rows = wide.columns = many;
  steps("steps of several threads in which springs break", wide, several);
  wide.integrator = "dopri5";
  steps("steps of several threads that choose their length", wide, several);
  wide.integrator = "xpbd";
  steps("steps of several threads that project", wide, several);
  wide.integrator = "vbd", wide.iterations = 2;
  steps("steps of several threads in which each particle solves for itself", wide, several);
}

TEST_CASE("the way back") {
  for (const char* method : {"verlet", "velocity_verlet", "implicit_euler", "dopri5"})
    test::inject({.operation = "going back", .kind = Fault::allocation, .lasts = true},
                 [&] { return std::make_unique<Back>(busy(method)); });
  Preset gusty = busy();
  gusty.gust = 0.5;
  test::inject({.operation = "going back in gusts", .kind = Fault::allocation, .lasts = true},
               [&] { return std::make_unique<Back>(gusty); });
  edit_of("snapshot", busy(), [](Simulation& cloth) { cloth.snapshot(); });
  edit_of("loading a state", busy(), [](Simulation& cloth) { cloth.load(test::crumpled(cloth.preset(), 1, 0.1)); });
  edit_of("a cloth beside it", busy(), [](Simulation& cloth) {
    Preset next = cloth.preset();
    next.precision = Precision::float_;
    cloth.rebuilt(edit::Change{next})->advance(1);
  });
  edit_of("a stand-in", busy(), [](Simulation& cloth) { cloth.stand_in(); });
}

}  // namespace tyglab::simulation_faults_test
