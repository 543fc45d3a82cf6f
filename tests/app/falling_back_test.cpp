// A device that is lost in mid-run.
#include "app/session/engine_fallback.h"

#include <doctest/doctest.h>

#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::falling_back_test {

/// An engine whose device is lost after so many calls of advance().
class LostEngine final : public Engine {
 public:
  LostEngine(std::unique_ptr<Engine> engine, int calls) : engine_(std::move(engine)), left_(calls) {}
  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override { engine_->load(rows, tears); }
  void set_preset(const Preset& preset, const Tears& tears) override { engine_->set_preset(preset, tears); }
  void set_fixed(std::span<const int> pinned, Held held) override { engine_->set_fixed(pinned, held); }
  Advance advance(int steps, Tears& tears) override {
    if (left_-- == 0) throw EngineError("OpenCL, making a step: the device is not available.");
    return engine_->advance(steps, tears);
  }
  void note_contacts(bool on) override { engine_->note_contacts(on); }
  std::vector<Contact> contacts() const override { return engine_->contacts(); }
  void read(State& state, const Tears& tears) override { engine_->read(state, tears); }
  void read_raw(State& state, const Tears& tears) override { engine_->read_raw(state, tears); }
  PositionView positions() const override { return engine_->positions(); }
  StoredParticle stored(int i, int j) const override { return engine_->stored(i, j); }
  std::size_t bytes() const override { return engine_->bytes(); }
  int threads() const override { return engine_->threads(); }
  SolveCounts solves() const override { return engine_->solves(); }
  InnerSteps inner_steps() const override { return engine_->inner_steps(); }
  std::vector<StepFeature> features() const override { return engine_->features(); }
  std::string name() const override { return engine_->name(); }

 private:
  std::unique_ptr<Engine> engine_;
  int left_;
};

App app_that_loses_its_device(const Preset& preset, int calls) {
  App app;
  app.simulation = std::make_unique<Simulation>(preset);
  app.simulation->wrap_engine(
      [&](std::unique_ptr<Engine> engine) { return std::make_unique<LostEngine>(std::move(engine), calls); });
  return app;
}

/// Frames of ten steps until an engine gives up; what follows is the CPU engine's.
void run(App& app, int frames) {
  for (int n = 0; n < frames; ++n) {
    app.rewind.look(*app.simulation);
    try {
      app.simulation->advance(10);
    } catch (const EngineError& error) {
      fall_back(app, error.what());
    }
  }
}

Preset on_device() {
  Preset preset = test::cloth(20, 30, "rk4");  // which keeps the velocity that is read
  preset.engine = EngineKind::opencl, preset.device = 0, preset.dt = 1e-3;
  return preset;
}

TEST_CASE("a device that is lost: the CPU engine goes on from the last state that was kept, cuts and pins too") {
  if (!test::device_there()) return;
  App app = app_that_loses_its_device(on_device(), 25);
  app.simulation->apply(edit::Cut{{{10, 10}, {10, 11}}});
  app.simulation->apply(edit::Pin{5, 5, true});
  const int torn = app.simulation->tears().torn_count();
  app.simulation->apply(edit::Grab{15, 15});
  app.tool.kind = Tool::Kind::grab;
  run(app, 25);
  REQUIRE(app.preset().engine == EngineKind::opencl);
  const Snapshot kept = *app.rewind.before(*app.simulation, app.simulation->time(), 0);
  CHECK(kept.t == doctest::Approx(0.2));
  run(app, 1);
  CHECK(app.preset().engine == EngineKind::cpu);
  CHECK(app.simulation->time() == kept.t);
  CHECK(app.simulation->steps() == kept.steps);
  CHECK(app.simulation->tears().torn_count() == torn);
  CHECK(test::identical(app.simulation->read(), kept.state));
  CHECK(app.tool.kind == Tool::Kind::none);
  CHECK_FALSE(app.simulation->held());
  REQUIRE(app.messages.list().size() == 1);
  const std::string said = app.messages.list().front().text;
  CHECK(said.find("the device is not available") != std::string::npos);
  CHECK(said.find("The CPU engine goes on from t = 0.2") != std::string::npos);
  run(app, 3);
  CHECK(app.simulation->steps() == kept.steps + 30);
  CHECK(test::all_finite(app.simulation->read()));
}

TEST_CASE(
    "a device that is lost before anything was kept: the CPU engine begins anew; and it is never its own rescue") {
  if (!test::device_there()) return;
  App app = app_that_loses_its_device(on_device(), 0);
  CHECK_THROWS_AS(app.simulation->advance(1), EngineError);
  fall_back(app, "Lost.");
  CHECK(app.preset().engine == EngineKind::cpu);
  CHECK(app.simulation->steps() == 0);
  CHECK_THROWS_AS(fall_back(app, "Lost."), EngineError);
}

}  // namespace tyglab::falling_back_test
