#include "tests/app/lab_player.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/session/edits.h"
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
  session_.wants = {.accuracy = accuracy_open};
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
  while (session_.pacing.playing && session_.simulation->time() < end && !session_.simulation->divergence() && !done())
    update(1.0 / 60);
  session_.pacing.playing = false;
  update();
}

void LabPlayer::look() {
  const auto limits = [&] {
    const auto& known = session_.studies.stability.limits();
    return known && known->of == session_.preset();
  };
  const auto study = [&] {
    if (!accuracy_open) return true;
    const auto known = session_.studies.accuracy.study();
    return known && known->present && known->of == session_.preset() && known->t == session_.simulation->time();
  };
  const auto begun = std::chrono::steady_clock::now();
  const bool playing = std::exchange(session_.pacing.playing, false);
  while (!limits() || !study()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    session_.wants = {.stability = true, .accuracy = accuracy_open};
    session_.update(0.01, {});
    REQUIRE(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < patience);
  }
  session_.pacing.playing = playing;
}

void LabPlayer::next() {
  REQUIRE(done());
  enter_step(session_, lab().step + 1);
  update();
}

}  // namespace tyglab::test
