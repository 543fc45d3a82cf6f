#include "tests/app/lab_player.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "core/io/preset_io.h"

namespace tyglab::test {
namespace {

constexpr double patience = 120;  // s

}  // namespace

LabPlayer::LabPlayer(const std::string& label) {
  app_.simulation = std::make_unique<Simulation>(Preset{});
  begin_lab(app_, label);
  REQUIRE(app_.labs.run.has_value());
  take_requests();
}

/// The steps' presets are opened as the sandbox does it, without its window.
void LabPlayer::take_requests() {
  for (const Request& request : app_.requests) {
    const auto* open = std::get_if<request::Open>(&request);
    if (open == nullptr) continue;
    const Preset preset = with_settings(load_preset(open->file), open->settings);
    app_.simulation = std::make_unique<Simulation>(preset, 2);
    app_.document = {preset, open->file.stem().string(), {}};
    app_.picked = Pins::Site{app_.simulation->lattice().rows / 2, app_.simulation->lattice().columns / 2};
    app_.accuracy.drop();
  }
  app_.requests.clear();
}

void LabPlayer::predict(const std::string& number) {
  std::snprintf(app_.labs.run->record().typed, sizeof StepRecord::typed, "%s", number.c_str());
  REQUIRE(tyglab::predict(app_));
}

void LabPlayer::choose(int choice) {
  app_.labs.run->record().chosen = choice;
  REQUIRE(tyglab::predict(app_));
}

void LabPlayer::set(const std::string& setting) {
  app_.simulation->apply(edit::Change{with_settings(app_.preset(), {setting})});
}

void LabPlayer::frame(int steps) {
  app_.steps_made = app_.simulation->advance(up_to_stop(app_, steps)).steps;
  app_.ui.now += 1.0 / 60;
  pause_at_stop(app_);
  watch_lab(app_);
}

void LabPlayer::run(double seconds) {
  const double end = app_.simulation->time() + seconds;
  app_.pacing.playing = true;
  const int steps = std::max(1, int(std::lround(1.0 / 60 / app_.preset().dt)));
  while (app_.pacing.playing && app_.simulation->time() < end && !app_.simulation->divergence() && !done())
    frame(steps);
  frame(0);
}

void LabPlayer::look() {
  const auto limits = [&] {
    app_.stability.poll(app_);
    return app_.stability.limits() && app_.stability.limits()->of == app_.preset();
  };
  const auto study = [&] {
    if (!accuracy_open) return true;
    app_.accuracy.poll(app_);
    const auto known = app_.accuracy.study();
    return known && known->present && known->of == app_.preset() && known->t == app_.simulation->time();
  };
  const auto begun = std::chrono::steady_clock::now();
  while (!limits() || !study()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    app_.ui.now += 0.01;
    REQUIRE(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < patience);
  }
  watch_lab(app_);
}

void LabPlayer::next() {
  REQUIRE(done());
  enter_step(app_, lab().step + 1);
  take_requests();
}

}  // namespace tyglab::test
