// Experiments: what was done is repeated to the last bit, from the recording, its file, and in the sandbox.
#include "app/base/experiment_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "app/session/session.h"
#include "core/engines/engine.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/playback.h"
#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::experiment_test {

/// Through its file, as a stranger has it.
Experiment reread(const Simulation& simulation) {
  return experiment_from(experiment_bytes(experiment_of(simulation)), "test.tyglab");
}

/// The cloth of a repetition of all that a simulation has done.
std::unique_ptr<Simulation> repeated(const Simulation& simulation, int threads = 1) {
  const Experiment experiment = reread(simulation);
  auto other = std::make_unique<Simulation>(experiment.recording.start(), threads);
  Playback playback(experiment.recording);
  playback.advance(*other, experiment.recording.steps());
  CHECK(playback.over(*other));
  CHECK((playback.comparison().compared > 0 || simulation.divergence()));
  CHECK(!playback.comparison().differs_at);
  CHECK(playback.comparison().apart == 0);
  return other;
}

/// What somebody may do to a cloth, at random: constants, hand, knife, pins, bodies, undo, restart.
void do_something(Simulation& cloth, test::Random& random, Snapshot& kept) {
  const int i = random.below(cloth.preset().rows), j = random.below(cloth.preset().columns);
  Preset next = cloth.preset();
  switch (random.below(14)) {
    case 0:
      return cloth.apply(edit::Grab{i, j});
    case 1:
    case 2:
      return cloth.apply(edit::MoveHand{cloth.position(i, j) + glm::dvec3(random.uniform(-0.02, 0.02)), 5});
    case 3:
      return cloth.apply(edit::Release{});
    case 4:
      return cloth.apply(edit::Cut{{{i, j}, {i, (j + 1) % next.columns}}});
    case 5:
      return cloth.apply(edit::CutSprings{{{0, i, j}, {1, i, j}}});
    case 6:
      return cloth.apply(edit::Pin{i, j, random.below(2) == 0});
    case 7:
      return cloth.apply(edit::MoveBody{0, {random.uniform(-0.1, 0.1), 0.4, 0}, random.below(2) * 7});
    case 8:
      kept = cloth.snapshot();
      return;
    case 9:
      if (cloth.fits(kept)) cloth.restore(kept);
      return;
    case 10:
      next.k_s = random.uniform(10, 60);
      break;
    case 11:
      next.dt = random.uniform(3e-4, 9e-4);
      break;
    case 12:
      next.W = {random.uniform(-1e-4, 1e-4), 0, 0}, next.gust = 0.5;
      break;
    default:
      if (random.below(3) == 0) return cloth.apply(edit::Restart{});
      next.precision = next.precision == Precision::double_ ? Precision::float_ : Precision::double_;
  }
  cloth.apply(edit::Change{next});
}

TEST_CASE("whatever was done is repeated to the last bit, by every method, precision and engine" *
          doctest::test_suite("slow")) {
  int walks = 0;
  for (const EngineKind engine : {EngineKind::cpu, EngineKind::plain})
    for (const Scheme& method : schemes())
      for (const Precision precision : {Precision::float_, Precision::double_})
        for (const char* tearing : {"springs", "split"}) {
          Preset preset = test::cloth(9, 8, std::string(method.name));
          preset.precision = precision, preset.engine = engine, preset.tearing = tearing, preset.dt = 7e-4;
          preset.bodies = {Body{.c = {0.1, 0.5, 0}, .r = 0.1}};
          if (!check_preset(preset).empty()) continue;
          if (!engine_problem(preset).empty()) continue;
          CAPTURE(std::string(method.name));
          CAPTURE(int(precision));
          CAPTURE(int(engine));
          CAPTURE(std::string(tearing));
          test::Random random(std::uint64_t(++walks));
          Simulation cloth(preset);
          cloth.keep_hashes(true);
          Snapshot kept = cloth.snapshot();
          for (int n = 0; n < test::fewer(60, 12); ++n) {
            try {
              do_something(cloth, random, kept);
            } catch (const std::exception&) {
              // Not everything goes with everything; the cloth is as it was.
            }
            cloth.advance(random.below(40));
          }
          const auto other = repeated(cloth, 2);
          CHECK(test::identical(cloth.read_raw(), other->read_raw()));
          CHECK(cloth.preset() == other->preset());
          CHECK(cloth.time() == other->time());
          CHECK(cloth.divergence().has_value() == other->divergence().has_value());
        }
  CHECK(walks > 60);
}

TEST_CASE("a repetition can itself be saved, continued, and repeated") {
  Simulation cloth(test::cloth(8, 8));
  cloth.advance(100), cloth.apply(edit::Grab{7, 3}), cloth.apply(edit::MoveHand{{0.1, 0.9, 0.2}, 50}),
      cloth.advance(80);
  const auto second = repeated(cloth);
  second->apply(edit::Release{}), second->advance(300);
  const auto third = repeated(*second);
  CHECK(third->past().steps() == 480);
  CHECK(test::identical(second->read_raw(), third->read_raw()));
}

TEST_CASE("a minute in which the hand never rests fits into 100 kB") {
  Simulation cloth(test::cloth(8, 8));
  cloth.apply(edit::Grab{7, 3});
  test::Random random(1);
  for (int frame = 0; frame < 3600; ++frame) {
    // As the session rounds it.
    const auto rounded = [&] { return std::round(random.uniform(-1, 1) * 1e7) / 1e7; };
    cloth.apply(edit::MoveHand{{rounded(), rounded(), rounded()}, 17});
    cloth.advance(17);
  }
  CHECK(experiment_bytes(experiment_of(cloth)).size() < 100'000);
}

TEST_CASE("another engine is compared, and how far away it comes is measured") {
  Simulation cloth(test::cloth(8, 8));
  cloth.keep_hashes(true);
  cloth.advance(1000);
  const Experiment experiment = reread(cloth);
  Preset start = experiment.recording.start();
  start.precision = Precision::float_;
  Simulation other(start);
  Playback playback(experiment.recording.beginning_with(start));
  playback.advance(other, 1000);
  const Playback::Comparison& found = playback.comparison();
  CHECK(found.differs_at == 256);
  CHECK(found.equal_until == 0);
  CHECK(found.looked_at == 1000);
  CHECK(found.apart > 1e-9);
  CHECK(found.apart < 1e-4);
  const std::string words = comparison_in_words(playback, experiment, false);
  CHECK(words.find("differ at step 256") != std::string::npos);
}

TEST_CASE("constants of an older release, texts and pictures: what a file may hold") {
  Preset preset = test::cloth(5, 5);
  preset.name = "Naïve “cloth”\n", preset.texture = "/home/somebody/picture.png";
  Simulation cloth(preset);
  cloth.mark("before\x1b[31m"), cloth.advance(3);
  const Experiment read = reread(cloth);
  CHECK(read.recording.start().texture == Preset().texture);
  CHECK(read.seconds == doctest::Approx(3 * preset.dt));
  const auto events = read.recording.events();
  CHECK(std::get<event::Mark>(*events.front().event).words.find('\x1b') == std::string::npos);
}

TEST_CASE("what is wrong with a file is said, and nothing else happens") {
  const auto fails = [](const std::string& bytes) {
    try {
      experiment_from(bytes, "x.tyglab");
    } catch (const PresetError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Simulation cloth(test::cloth(5, 5));
  cloth.apply(edit::Grab{4, 2}), cloth.advance(5);
  const std::string bytes = experiment_bytes(experiment_of(cloth)), text = experiment_text(experiment_of(cloth));
  CHECK(fails(bytes).empty());
  CHECK(fails(text).empty());
  CHECK(fails("").find("is not an experiment") != std::string::npos);
  CHECK(fails(bytes.substr(0, bytes.size() / 2)).find("cut short") != std::string::npos);
  CHECK(fails("tyglab experiment\n99999999999\n").find("too large") != std::string::npos);
  CHECK(fails("tyglab experiment\n100000000\nabc").find("cut short") != std::string::npos);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    REQUIRE(at != std::string::npos);
    return fails(other.replace(at, from.size(), to));
  };
  CHECK(with("\"tyglab_experiment\": 1", "\"tyglab_experiment\": 2").find("newer version") != std::string::npos);
  CHECK(with("\"steps\": 5", "\"steps\": -5").find("steps") != std::string::npos);
  CHECK(with("\"steps\": 5", "\"stepz\": 5").find("stepz") != std::string::npos);
  CHECK(with("\"grab\",4,2", "\"grab\",4").find("line") != std::string::npos);
  CHECK(with("\"grab\",4,2", "\"grab\",4,2,1").find("more values") != std::string::npos);
  CHECK(with("\"grab\",4,2", "\"grob\",4,2").find("grob") != std::string::npos);
  CHECK(with("[0,\"grab\",4,2]", "[6,\"grab\",4,2]").find("later than the end") != std::string::npos);
  CHECK(with("[0,\"grab\",4,2]", "[0,\"set\",\"k_s=-3\"]").find("k_s") != std::string::npos);
  CHECK(with("[0,\"grab\",4,2]", "[0,\"set\",\"texture=/etc/passwd\"]").find("texture") != std::string::npos);
  CHECK(with("[0,\"grab\",4,2]", "[0,\"hand\",1,1e300,1,3]").find("not allowed") != std::string::npos);
  CHECK(with("[0,\"grab\",4,2]", "[0,\"state\",\"AAAA\"]").find("state") != std::string::npos);
}

TEST_CASE("in the sandbox an experiment is opened, repeated and compared; a touch makes it the user's") {
  Simulation cloth(test::cloth(8, 8));
  cloth.keep_hashes(true);
  cloth.advance(300), cloth.apply(edit::Grab{7, 3}), cloth.apply(edit::MoveHand{{0.1, 0.9, 0.2}, 50}),
      cloth.advance(80);
  Preset next = cloth.preset();
  next.k_s = 70;
  cloth.apply(edit::Change{next}), cloth.apply(edit::Release{}), cloth.advance(220);
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tyglab_repeated.tyglab";
  save_experiment(experiment_of(cloth), file);

  Session session;
  session.simulation = std::make_shared<Simulation>(test::cloth(6, 6));
  session.document.saved = session.preset();
  const auto update = [&] { session.update(1.0 / 60, {}); };
  const auto said = [&](const std::string& part) {
    for (const Message& message : session.messages.list())
      if (message.text.find(part) != std::string::npos) return true;
    return false;
  };
  session.request(request::Open{.file = file});
  update();
  REQUIRE(session.repetition);
  for (int n = 0; n < 2000 && session.repetition; ++n) update();
  CHECK(!session.repetition);
  CHECK(!session.pacing.playing);
  CHECK(session.simulation->past().steps() == 600);
  CHECK(test::identical(session.simulation->read_raw(), cloth.read_raw()));
  CHECK(session.preset().k_s == 70);
  CHECK(said("to the last bit"));
  CHECK(!unsaved(session));

  session.request(request::Open{.file = file, .confirmed = true});
  session.pacing.playing = true;
  for (int n = 0; n < 10; ++n) update();
  REQUIRE(session.repetition);
  next.k_s = 20;
  session.propose(next);
  update();
  CHECK(!session.repetition);
  CHECK(said("You have taken over"));
  const std::int64_t taken_over = session.simulation->past().steps();
  update();
  CHECK(session.simulation->past().steps() > taken_over);

  // What a stranger's file asks for ends its repetition, not the program.
  Simulation large(test::cloth(8, 8));
  large.advance(30);
  Recording recording(large.past().start());
  recording.add_steps(10), recording.add(event::Change{{"rows=4096", "columns=4096"}}), recording.add_steps(20);
  save_experiment(experiment_of(recording, large), file);
  session.request(request::Open{.file = file, .confirmed = true});
  session.pacing.playing = true;
  for (int n = 0; n < 10; ++n) update();
  CHECK(!session.repetition);
  CHECK(session.preset().rows == 8);
  CHECK(said("is not repeated here, since it changes to a cloth of 16,777,216 particles"));
  Recording on_device(large.past().start());
  on_device.add_steps(10), on_device.add(event::Change{{"solver.engine=opencl"}}), on_device.add_steps(20);
  save_experiment(experiment_of(on_device, large), file);
  session.request(request::Open{.file = file, .confirmed = true});
  update();
  CHECK(!session.repetition);
  CHECK(said("since it changes to an OpenCL device"));
  std::filesystem::remove(file);
}

}  // namespace tyglab::experiment_test
