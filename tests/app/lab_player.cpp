#include "tests/app/lab_player.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/session/motion.h"
#include "app/session/observables.h"
#include "app/session/session.h"
#include "app/studies/job.h"
#include "core/io/preset_io.h"
#include "tests/support/sanitized.h"

namespace tyglab::test {
namespace {

constexpr double patience = test::sanitized ? 1200 : 120;  // s

}  // namespace

LabPlayer::LabPlayer(const std::string& label) {
  session_.simulation = std::make_shared<Simulation>(Preset{});
  session_.threads = 2;
  session_.pacing.patient = true;
  let_work_yield(false);  // or it would wait for whatever else runs
  begin_lab(session_, label);
  REQUIRE(session_.labs.run.has_value());
  update();
}

void LabPlayer::update(double seconds) {
  session_.wants = {};
  session_.update(seconds, {});
  REQUIRE_FALSE(session_.question.has_value());
}

void LabPlayer::predict(const std::string& number) {
  std::snprintf(session_.labs.run->record().typed, sizeof StepRecord::typed, "%s", number.c_str());
  REQUIRE(tyglab::predict(session_));
}

void LabPlayer::choose(int choice) {
  session_.labs.run->record().chosen = choice;
  REQUIRE(tyglab::predict(session_));
}

void LabPlayer::set(const std::string& setting) {
  REQUIRE(apply_edit(session_, edit::Change{with_settings(session_.preset(), {setting})}));
}

void LabPlayer::run(double seconds) {
  const double end = session_.simulation->time() + seconds;
  session_.pacing.playing = true;
  constexpr int most_updates = 100000;  // a motion that waits for a prediction would wait forever
  for (int n = 0;
       session_.pacing.playing && session_.simulation->time() < end && !session_.simulation->divergence() && !done();
       ++n) {
    if (n == most_updates) FAIL("waited in vain for t = ", end, " s of step ", lab().step + 1);
    update(1.0 / 60);
  }
  session_.pacing.playing = false;
  update();
}

void LabPlayer::restart() {
  tyglab::restart(session_);
  update();
}

void LabPlayer::set_up_again() {
  set_up_step(session_);
  open();
}

void LabPlayer::open() {
  update();
  while (session_.rebuild.busy()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    update();
  }
}

void LabPlayer::cut(const std::vector<Pins::Site>& sites) {
  REQUIRE(apply_edit(session_, edit::Cut{sites}));
}

void LabPlayer::pull(int i, int j, const glm::dvec3& to, double seconds) {
  REQUIRE(apply_edit(session_, edit::Grab{i, j}));
  const double end = session_.simulation->time() + seconds;
  session_.pacing.playing = true;
  while (session_.simulation->time() < end && !session_.simulation->divergence()) {
    session_.wants = {};
    SessionInput input;
    input.hand = to;
    session_.update(1.0 / 60, input);
  }
  session_.pacing.playing = false;
}

void LabPlayer::release() {
  REQUIRE(apply_edit(session_, edit::Release{}));
}

std::string LabPlayer::card(std::size_t check) {
  const StepRecord& record = lab().record();
  return check_in_words(session_, lab().now().checks.at(check), record.checks.at(check), record.seen.at(check));
}

void LabPlayer::skip() {
  enter_step(session_, lab().step + 1);
  open();
}

void LabPlayer::look() {
  const auto limits = [&] {
    const auto& known = session_.studies.stability.limits();
    return known && known->of == session_.preset() && known->at == session_.study_moment().mark();
  };
  const bool measures = lab().now().show == "accuracy";
  const auto study = [&] {
    if (!measures) return true;
    const auto known = session_.studies.accuracy.study();
    return known && known->present && known->of == session_.preset() && known->at == session_.study_moment().mark();
  };
  REQUIRE_FALSE(session_.simulation->divergence());  // of which no study is made
  const auto begun = std::chrono::steady_clock::now();
  const bool playing = std::exchange(session_.pacing.playing, false);
  while (!done() && (!limits() || !study())) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    session_.wants = {.stability = true, .accuracy = measures};
    session_.update(0.01, {});
    REQUIRE(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < patience);
  }
  // The lab sees in the next update what a study has found in the last.
  session_.wants = {.stability = true, .accuracy = measures};
  session_.update(0.01, {});
  session_.pacing.playing = playing;
}

void LabPlayer::count() {
  const auto begun = std::chrono::steady_clock::now();
  while (!done() && !observe(session_, "crossings")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    update(0.01);
    REQUIRE(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < patience);
  }
  update();
}

void LabPlayer::next() {
  REQUIRE(done());
  enter_step(session_, lab().step + 1);
  open();
}

void finish(LabPlayer& play) {
  CAPTURE(play.lab().lab.label);
  CAPTURE(play.lab().step);
  REQUIRE(play.done());
  if (play.lab().now().prediction) CHECK(play.right());
}

}  // namespace tyglab::test
