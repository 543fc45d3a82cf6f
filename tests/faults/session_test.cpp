// The session under faults: what fails becomes a message, and the cloth, its history and its document are as before.
#include <doctest/doctest.h>

#include "app/session/document.h"
#include "app/session/session.h"
#include "tests/faults/cloth.h"
#include "tests/support/faults.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::session_faults_test {
namespace {

using test::Fault;

constexpr double frame = 1 / 60.0;

/// Names that are there before anything fails.
struct Names {
  std::filesystem::path other, mine;
  std::string name = "a name of my own, longer than short ones";
};

/// A session in which something is asked for.
class Asked final : public test::Scene {
 public:
  using Act = std::function<void(Session&, const Names&)>;
  Asked(const Preset& preset, Act act) : act_(std::move(act)) {
    session_.simulation = std::make_shared<Simulation>(preset);
    session_.document.saved = preset;
    session_.simulation->advance(4);
    session_.pacing.playing = false;
    names_.other = folder_ / "other.json", names_.mine = folder_ / "mine.json";
    save_preset(test::cloth(9, 9), names_.other);
  }
  void act() override { act_(session_, names_); }
  std::string state() override {
    return test::told(*session_.simulation) + session_.document.label + session_.document.file.string() +
           preset_to_json(session_.document.saved) + std::to_string(session_.history.bytes());
  }
  std::string problem(const test::Attempt& attempt, const std::string& before) override {
    if (attempt.refused) return "thrown at the frames: " + attempt.sentence;
    const auto& said = session_.messages.list();
    const bool told = !said.empty() || session_.not_saved;
    if (!told && state() == before) return "nothing done, and nothing said";
    if (told && state() != before) return "said, but not as before";
    session_.messages = {};
    session_.not_saved.reset();
    return {};
  }
  std::string outcome() override { return test::told_later(*session_.simulation); }

 private:
  test::TemporaryFolder folder_;
  Names names_;
  Session session_;
  Act act_;
};

void ask(const char* name, const Asked::Act& act) {
  test::inject({.operation = name, .kind = Fault::allocation, .dense = 60},
               [&] { return std::make_unique<Asked>(test::cloth(8, 8), act); });
}

Asked::Act edited(const std::function<void(Preset&)>& change) {
  return [change](Session& session, const Names&) {
    Preset next = session.preset();
    change(next);
    apply_edit(session, edit::Change{next});
  };
}

}  // namespace

TEST_CASE("edits of a session") {
  ask("session: edit of k_s", edited([](Preset& p) { p.k_s *= 2; }));
  ask("session: edit of the rows", edited([](Preset& p) { p.rows += 2; }));
  ask("session: edit of the method", edited([](Preset& p) { p.integrator = "rk4"; }));
  ask("session: grab", [](Session& s, const Names&) { apply_edit(s, edit::Grab{4, 4}); });
}

TEST_CASE("presets opened and saved in a session") {
  ask("session: open preset", [](Session& s, const Names& names) { open_document(s, names.other, false); });
  ask("session: save preset", [](Session& s, const Names& names) { save_document_as(s, names.mine, names.name); });
}

TEST_CASE("a session that steps: what is short pauses it, with a message" * doctest::test_suite("slow")) {
  Session session;
  Preset preset = test::cloth(12, 12, "implicit_euler");
  session.simulation = std::make_shared<Simulation>(preset);
  session.document.saved = preset;
  session.scripted = true;
  const auto updated = [&](const test::FaultAt& at) { return test::attempt(at, [&] { session.update(frame, {}); }); };
  updated({Fault::allocation});
  const std::int64_t all = updated({Fault::allocation}).calls;
  std::int64_t tried = 0, survived = 0;
  for (std::int64_t n = 1; n <= all; ++n) {
    session.pacing.playing = true;
    session.messages = {};
    const std::int64_t steps = session.simulation->steps();
    const test::Attempt result = updated({Fault::allocation, n});
    if (!result.met) continue;
    ++tried;
    CHECK_MESSAGE(!result.refused, result.sentence);
    CHECK(session.simulation->steps() >= steps);
    CHECK(test::all_finite(session.simulation->read()));
    if (!session.pacing.playing) CHECK_FALSE(session.messages.list().empty());
    survived += !result.refused;
  }
  std::printf("FAULTS frame of a session: allocation %d %d\n", int(tried), int(survived));
}

TEST_CASE("jobs without a thread: what somebody waits for is done at once, what takes long is refused") {
  Job<int> job;
  std::int64_t tried = 0, survived = 0;
  for (const Priority priority : {Priority::normal, Priority::below_frames}) {
    const test::Attempt result =
        test::attempt({Fault::thread, 1}, [&] { job.start(priority, [](const JobControl&) { return 7; }); });
    CHECK(result.met);
    CHECK_FALSE(result.refused);
    REQUIRE(job.ready());
    const auto outcome = job.take();
    const auto* error = std::get_if<JobError>(&outcome);
    const auto* result_of = std::get_if<int>(&outcome);
    const bool right = priority == Priority::normal ? result_of != nullptr && *result_of == 7
                                                    : error != nullptr && !error->what.empty();
    CHECK(right);
    ++tried, survived += right;
  }
  std::printf("FAULTS job beside the frames: thread %d %d\n", int(tried), int(survived));
}

TEST_CASE("a job that runs out of memory ends with an error as a value") {
  std::int64_t tried = 0, survived = 0;
  const auto work = [](const JobControl&) { return int(Simulation(test::cloth(8, 8)).advance(2).steps); };
  Job<int> job;
  const auto done = [&](const test::FaultAt& at) {
    return test::attempt(at, [&] {
      job.start(Priority::normal, work);
      while (!job.wait(1)) continue;
    });
  };
  const std::int64_t all = done({Fault::allocation}).calls;
  job.take();
  for (std::int64_t n = 1; n <= all; ++n)
    for (const bool lasting : {false, true}) {
      const test::Attempt result = done({Fault::allocation, n, lasting});
      if (!result.met) continue;
      bool right = result.out_of_memory;  // the job itself could not be made
      if (!result.refused) {
        const auto outcome = job.take();
        const auto* error = std::get_if<JobError>(&outcome);
        right = error != nullptr && error->out_of_memory && !error->what.empty();
      }
      CHECK_MESSAGE(right, n);
      ++tried, survived += right;
    }
  std::printf("FAULTS job beside the frames: allocation %d %d\n", int(tried), int(survived));
}

}  // namespace tyglab::session_faults_test
