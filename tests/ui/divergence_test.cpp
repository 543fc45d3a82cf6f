// A cloth that explodes stops with a banner; restarting, and undoing what caused it, work.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/base/glfw_keys.h"
#include "app/base/text.h"
#include "app/render/camera.h"
#include "app/session/requests.h"
#include "app/ui/frame/panels.h"
#include "tests/ui/null_ui.h"

namespace tyglab::divergence_ui_test {

void explode(test::NullUi& window) {
  window.until([&] { return window.diverged(); }, "the cloth to diverge");
  window.frames(2);
}

/// A cloth that has run well for two seconds and then gets a dt too large for it; when it diverged, s.
double push_over(test::NullUi& window) {
  window.until([&] { return window.t() > 2; }, "two seconds of motion");
  window.type_value("dt", "0.004");
  explode(window);
  return window.t();
}

void run_to(test::NullUi& window, double t) {
  window.until([&] { return window.t() > t; }, "the cloth to move on");
  CHECK_FALSE(window.diverged());
}

TEST_CASE("the preset that explodes stops, says when, where and why, and starts again from its banner") {
  test::NullUi window({.preset = "explodes"});
  explode(window);
  const Divergence why = *window.cloth().divergence();
  const std::int64_t steps = window.steps();
  const double t = window.t();
  CHECK(why.step == steps + 1);  // the state is the one before the step that diverged
  CHECK(std::abs(why.t - double(why.step) * window.preset().dt) < 1e-6);
  CHECK_FALSE(why.cause.empty());
  CHECK_FALSE(why.advice.empty());
  window.frames(4);
  CHECK(window.steps() == steps);
  CHECK(window.t() == t);
  window.key(GLFW_KEY_RIGHT);
  CHECK(window.steps() == steps);
  for (const int mode : {5, 2, 1}) {
    window.key(GLFW_KEY_0 + mode);
    CHECK(window.preset().mode == mode);
  }
  CHECK(window.paused());  // a step pauses
  window.click("viewport.Restart");
  CHECK_FALSE(window.diverged());
  CHECK(window.steps() == 0);
  CHECK(window.t() == 0);
  CHECK_FALSE(window.sees("viewport.Restart"));
  window.key(GLFW_KEY_SPACE);
  explode(window);
  CHECK(window.cloth().divergence()->step == why.step);
}

bool tells_of_excess(const test::NullUi& window) {
  const auto& list = window.session.messages.list();
  return std::any_of(list.begin(), list.end(), [](const Message& message) {
    return message.text.find("times the energy the scene can supply") != std::string::npos;
  });
}

TEST_CASE("the window tells of energy that errors of the method have added; in a lab that is the student's to find") {
  test::NullUi window({.preset = "hanging", .with = [](Preset& preset) {
                         preset.rows = preset.columns = 10, preset.pins.mode = Pins::Mode::none;
                         preset.k_d = 0, preset.k_s = 1e4, preset.dt = 0.01, preset.integrator = "implicit_midpoint";
                       }});
  window.until([&] { return tells_of_excess(window); }, "the window to tell of it");
  CHECK_FALSE(window.diverged());

  test::NullUi student({.preset = "hanging"});
  begin_lab(student.session, "02_euler");
  student.frames(4);
  student.click("lab.prediction"), student.type("3"), student.key(GLFW_KEY_ENTER);  // the motion waits for it
  student.session.pacing.playing = true, student.session.pacing.speed = 0.2;        // so that there are many looks
  student.until([&] { return student.cloth().excess() > 1.5; }, "Euler to add energy");
  student.session.updates_unlooked = 0;
  student.frames(200);
  CHECK(student.session.updates_unlooked == 0);  // nobody looks
  CHECK_FALSE(tells_of_excess(student));
}

TEST_CASE("in a small window with a lab the details scroll, stand over all else, and fold again") {
  test::NullUi window({.preset = "hanging", .size = {900, 600}});
  begin_lab(window.session, "03_stiffness");
  window.frames(4);
  window.turn_to("lab.prediction");
  window.click("lab.prediction"), window.type("200"), window.key(GLFW_KEY_ENTER);  // the motion waits for it
  window.type_value("k_s", "100000");
  window.session.pacing.playing = true;
  explode(window);
  window.click("viewport.Details");
  window.frames(2);
  const Box banner = *window.ui.placing.find("banner");
  const Box* views = window.ui.placing.find("views");
  CHECK((views == nullptr || !overlap(banner, *views)));  // whole or not at all
  CHECK(banner.hi.y <= window.control("lab.leave").lo.y);
  CHECK(banner.lo.y >= window.control("top.brand").hi.y);
  window.scroll_to("viewport.Restart", "viewport.fold");
  window.click("viewport.fold");
  window.frames(2);
  CHECK(window.sees("viewport.Details"));
  CHECK_FALSE(window.sees("viewport.Restart"));
}

TEST_CASE("in a small window the banner is one line; its details come and go with a click") {
  test::NullUi window(
      {.preset = "explodes", .size = {900, 600}, .settings = [](Settings& settings) { settings.ui_scale = 1.5; }});
  explode(window);
  const auto covered = [&] {
    const Box box = *window.ui.placing.find("banner");
    return (box.hi.y - box.lo.y) / window.ui.viewport.size().y;
  };
  CHECK_FALSE(overlap(*window.ui.placing.find("banner"), window.ui.viewport.box));
  CHECK(window.sees("viewport.Verlet"));
  CHECK_FALSE(window.sees("viewport.Restart"));
  window.click("viewport.Details");
  window.frames(2);
  CHECK(window.sees("viewport.Restart"));
  CHECK(covered() > 0.5);
  const Box* views = window.ui.placing.find("views");
  CHECK((views == nullptr || !overlap(*window.ui.placing.find("banner"), *views)));
  window.click("viewport.fold");
  window.frames(2);
  CHECK(window.ui.placing.find("views") != nullptr);
  CHECK_FALSE(overlap(*window.ui.placing.find("banner"), window.ui.viewport.box));
  window.key(GLFW_KEY_R);
  window.resize({1280, 900});
  window.key(GLFW_KEY_0, GLFW_MOD_CONTROL);
  window.key(GLFW_KEY_SPACE);
  explode(window);
  CHECK(window.sees("viewport.Restart"));  // there is room, and what was wanted once is forgotten
}

/// Whether parts of a ring in the color of danger are drawn round a middle outside the picture.
bool ring_without_middle(const test::NullUi& window) {
  const Box banner = *window.ui.placing.find("banner"), picture = window.ui.viewport.box;
  glm::vec2 sum{0};
  float count = 0;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    if (std::string(data.CmdLists[n]->_OwnerName) != "viewport") continue;
    for (const ImDrawVert& corner : data.CmdLists[n]->VtxBuffer) {
      const glm::vec2 at(corner.pos.x, corner.pos.y);
      if (corner.col == window.ui.theme.colors.danger && !overlap(banner, {at - 4.f, at + 4.f})) sum += at, ++count;
    }
  }
  return count > 0 && !picture.contains(sum / count);
}

/// The middle of the ring that marks a divergence; none where there is none.
std::optional<glm::vec2> ring_of(const test::NullUi& window) {
  const Box banner = *window.ui.placing.find("banner");
  const Box* label = window.ui.placing.find("ring");
  glm::vec2 lo{1e9f}, hi{-1e9f};
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    if (std::string(data.CmdLists[n]->_OwnerName) != "viewport") continue;
    for (const ImDrawVert& corner : data.CmdLists[n]->VtxBuffer) {
      const glm::vec2 at(corner.pos.x, corner.pos.y);
      if (corner.col != window.ui.theme.colors.danger || overlap(banner, {at - 4.f, at + 4.f})) continue;
      if (label == nullptr || !label->contains(at)) lo = glm::min(lo, at), hi = glm::max(hi, at);
    }
  }
  if (lo.x > hi.x) return std::nullopt;
  return (lo + hi) / 2.f;
}

TEST_CASE("the ring stands on the drawn cloth where it diverged, wherever the spring's ends have flown to") {
  int rings = 0;
  for (const double dt : {0.0022, 0.0023, 0.0024, 0.00252, 0.0026, 0.0028, 0.003, 0.0035, 0.004}) {
    CAPTURE(dt);
    test::NullUi window({.preset = "hanging", .with = [&](Preset& preset) { preset.dt = dt; }});
    explode(window);
    window.frames(2);
    const auto ring = ring_of(window);
    if (!ring) continue;
    ++rings;
    const Divergence d = *window.cloth().divergence();
    const PositionView x = window.cloth().positions();
    const double L = window.preset().L;
    float nearest = 1e9f;  // px, of the neighborhood's particles that the picture shows, to the ring's middle
    for (int i = std::max(0, d.i - 7); i <= std::min(x.rows - 2, d.i + 7); ++i)
      for (int j = std::max(0, d.j - 7); j <= std::min(x.columns - 2, d.j + 7); ++j)
        if (glm::distance(x.at(i, j), x.at(i, j + 1)) <= 5 * L && glm::distance(x.at(i, j), x.at(i + 1, j)) <= 5 * L)
          nearest = std::min({nearest, glm::distance(window.pixel_of(i, j), *ring),
                              glm::distance(window.pixel_of(i, j + 1), *ring),
                              glm::distance(window.pixel_of(i + 1, j), *ring)});
    CHECK(nearest < 40);
  }
  CHECK(rings >= 3);
}

TEST_CASE("the banner has a strip of its own: no mark covers where the cloth is framed, and a replay is offered") {
  struct Case {
    glm::ivec2 size;
    double scale;
    const char* theme;
    bool presenting;
  };
  for (const Case& now : {Case{{900, 600}, 1.5, "dark", false},
                          {{1280, 720}, 1, "projector", true},
                          {{1280, 720}, 1, "projector", false},
                          {{1280, 720}, 1, "dark", false},
                          {{1920, 1080}, 1, "light", false}}) {
    CAPTURE(now.size.x);
    CAPTURE(std::string(now.theme));
    CAPTURE(now.presenting);
    test::NullUi window({.preset = "explodes", .size = now.size, .settings = [&](Settings& settings) {
                           settings.ui_scale = now.scale, settings.theme = now.theme;
                         }});
    if (now.presenting) window.key(GLFW_KEY_F5);
    explode(window);
    window.frames(4);
    const Viewport& viewport = window.ui.viewport;
    const Box banner = *window.ui.placing.find("banner");
    CHECK_FALSE(overlap(banner, viewport.box));
    CHECK(banner.hi.y <= float(now.size.y));
    const Bounds framed = scene_bounds(window.preset());
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 at(corner & 1 ? framed.lo.x : framed.hi.x, corner & 2 ? framed.lo.y : framed.hi.y,
                         corner & 4 ? framed.lo.z : framed.hi.z);
      const auto pixel = window.scene.camera.project(at, viewport.size());
      REQUIRE(pixel.has_value());
      CHECK(viewport.box.contains(*pixel + viewport.box.lo));
    }
    CHECK(window.drew("iverged"));
    CHECK(window.sees("viewport.Replay_slowly"));
    CHECK(window.sees("viewport.Verlet"));
    CHECK_FALSE(ring_without_middle(window));
  }
}

TEST_CASE("the banner makes the change that it names, a second back: the cloth then moves on") {
  test::NullUi window({.preset = "explodes"});
  explode(window);
  window.click("viewport.Verlet");
  CHECK_FALSE(window.diverged());
  CHECK(window.preset().integrator == "verlet");
  CHECK(unsaved(window.session));
  run_to(window, 0.5);
}

TEST_CASE("a constant pushed too far offers to undo that change and restart, which heals the cloth") {
  test::NullUi window;
  window.type_value("k_s", "200000");
  explode(window);
  window.click("viewport.Undo_k_s_and_restart");
  CHECK_FALSE(window.diverged());
  CHECK(window.preset().k_s == 50);
  run_to(window, 1);
}

TEST_CASE("Ctrl+R and R mend what R alone leads to again") {
  test::NullUi window;
  window.type_value("dt", "0.004");
  explode(window);
  window.key(GLFW_KEY_R);
  explode(window);
  window.key(GLFW_KEY_R, GLFW_MOD_CONTROL);
  window.frames(2);
  CHECK(window.preset().dt == 0.001);
  window.key(GLFW_KEY_R);
  window.frames(2);
  run_to(window, 1);
}

TEST_CASE("in a small window a long message leaves the banner in sight, and is read in its tooltip") {
  for (const char* theme : {"dark", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window(
        {.preset = "explodes", .size = {900, 600}, .settings = [theme](Settings& s) { s.theme = theme; }});
    explode(window);
    const std::string end = "and these are its last words.";
    window.session.messages.error(
        "A message that is far longer than one line of a small window has room for, because "
        "it tells of everything that has happened, of what could be done about it, " +
        end);
    window.frames(4);
    REQUIRE(window.ui.message_box);
    REQUIRE(window.ui.placing.find("banner") != nullptr);
    CHECK_FALSE(overlap(*window.ui.message_box, *window.ui.placing.find("banner")));
    CHECK_FALSE(window.drew(end));
    CHECK(window.drew("A message that is"));
    window.move((window.ui.message_box->lo + window.ui.message_box->hi) / 2.f);
    window.until([&] { return window.tooltip().has_value(); }, "its tooltip");
    window.frames(2);
    CHECK(window.drew(end));
  }
}

TEST_CASE("the banner says why in a column too narrow for a whole sentence") {
  for (const auto& [width, whole] : {std::pair{1280, true}, {1100, false}}) {
    CAPTURE(width);
    test::NullUi window({.size = {width, 720}, .settings = [](Settings& settings) { settings.theme = "projector"; }});
    window.type_value("k_s", "500");
    explode(window);
    CHECK(window.drew("The simulation diverged: dt is 2.3 times the worst-case limit") == whole);
    CHECK(window.drew("Diverged: dt is 2.3 × the limit") == !whole);
    CHECK(window.sees("viewport.Undo_k_s_and_restart"));
  }
}

TEST_CASE("an undo that leads to what diverges, too, is no way out") {
  test::NullUi window;
  window.type_value("k_s", "1000");
  explode(window);
  CHECK(window.sees("viewport.Undo_k_s_and_restart"));
  window.type_value("k_s", "1520");
  window.frames(2);
  CHECK_FALSE(window.sees("viewport.Undo_k_s_and_restart"));  // to 1000
  window.type_value("k_s", "900");
  window.key(GLFW_KEY_R);
  explode(window);
  CHECK_FALSE(window.sees("viewport.Undo_k_s_and_restart"));  // to 1520
  CHECK(window.sees("viewport.Implicit_Euler"));
}

TEST_CASE("an undo is offered only where the former value is stable in linear theory") {
  test::NullUi window;
  window.type_value("dt", "1");
  explode(window);
  CHECK(window.sees("viewport.Undo_dt_and_restart"));
  window.type_value("k_s", "60");
  window.key(GLFW_KEY_R);
  explode(window);
  CHECK_FALSE(window.sees("viewport.Undo_k_s_and_restart"));  // to 50, which diverges at that dt as well
  CHECK(window.sees("viewport.Implicit_Euler"));
}

TEST_CASE("after a divergence the past can be had back: paused, with the constants as they are") {
  test::NullUi window;
  const double t = push_over(window);
  window.click("viewport.Rewind_1_s");
  CHECK_FALSE(window.diverged());
  CHECK(window.t() < t - 0.9);
  CHECK(window.paused());
  CHECK(window.preset().dt == 0.004);
  window.type_value("dt", "0.001");
  window.key(GLFW_KEY_SPACE);
  run_to(window, t + 0.5);
  window.pause();
  const double later = window.t();
  window.rest();
  window.key(GLFW_KEY_LEFT);
  window.frames(2);
  CHECK(window.t() < later - 0.5);
}

TEST_CASE("a replay is colored by strain, until the cloth that it led to is left") {
  test::NullUi window({.preset = "explodes"});
  window.ui.color_by(ParticleField::speed);
  explode(window);
  const auto field = [&] { return window.scene.colors.chosen->field; };
  const auto replay = [&] {
    window.ui.command("replay");
    window.until([&] { return window.session.replay.has_value(); }, "the replay to begin");
    CHECK(field() == ParticleField::strain);
  };
  const auto restart = [&] {
    window.ui.command("restart");
    window.until([&] { return !window.session.replay && !window.diverged(); }, "the replay to be left");
    window.frames(1);
  };
  replay();
  restart();
  CHECK(field() == ParticleField::speed);
  CHECK(window.settings.color == std::string(info(ParticleField::speed).name));
  explode(window);
  replay();
  window.ui.color_by(ParticleField::tension);  // what is chosen meanwhile stays
  restart();
  CHECK(field() == ParticleField::tension);
}

TEST_CASE("a replay says which steps are seen again and how slowly, its plot where it is, the ring what it marks") {
  test::NullUi window({.preset = "explodes", .size = {1920, 1080}});
  explode(window);
  const auto divergence = window.cloth().divergence();
  CHECK(window.drew("t = " + time_number(divergence->t, window.preset().dt) + " s"));
  window.ui.command("replay");
  window.until([&] { return window.session.replay.has_value(); }, "the replay to begin");
  window.frames(20);
  REQUIRE(window.session.replay.has_value());
  const Replay& replay = *window.session.replay;
  CHECK(window.drew("REPLAY"));
  CHECK(window.drew("steps " + std::to_string(replay.first) + " to " + std::to_string(divergence->step) + " at 1/"));
  CHECK(replay.first <= window.steps());
  CHECK(window.drew("diverges first"));
}

TEST_CASE("both ends of a short span are told apart") {
  CHECK(digits_apart(0, 10) == 4);
  CHECK(digits_apart(-2, 0) == 4);
  CHECK(digits_apart(17.581, 17.631) == 5);
  CHECK(digits_apart(17.6305, 17.6315) == 6);
  CHECK(digits_apart(5, 5) == 4);
}

TEST_CASE("a replay is as slow as it is meant to be: no part of real time is said") {
  test::NullUi window({.preset = "explodes", .size = {1920, 1080}});
  explode(window);
  window.ui.command("replay");
  window.until([&] { return window.session.replay.has_value(); }, "the replay to begin");
  window.frames(20);
  REQUIRE(window.session.replay.has_value());
  CHECK(real_time(window.ui).text == "–");
}

TEST_CASE("the banner offers 0.9 of dt_crit, from a second back") {
  test::NullUi window;
  const double t = push_over(window);
  window.click(window.control_beginning("viewport.dt"));
  CHECK_FALSE(window.diverged());
  CHECK(window.preset().dt > 0.0005);
  CHECK(window.preset().dt < 0.002);
  run_to(window, t);
}

TEST_CASE("the banner offers implicit Euler, which goes on with the same dt" * doctest::test_suite("slow")) {
  test::NullUi window;
  const double t = push_over(window);
  window.click("viewport.Implicit_Euler");
  CHECK_FALSE(window.diverged());
  CHECK(window.preset().integrator == "implicit_euler");
  CHECK(window.preset().dt == 0.004);
  run_to(window, t);
}

TEST_CASE("once constants have changed, the banner offers to try them instead of advice that is out of date") {
  test::NullUi window({.preset = "explodes"});
  explode(window);
  CHECK_FALSE(changed_since_divergence(window.session));
  CHECK(window.sees("viewport.Verlet"));
  Preset heeded = window.preset();
  heeded.integrator = "verlet";
  window.session.request(request::Apply{edit::Change{heeded}});
  window.frames(2);
  CHECK(changed_since_divergence(window.session));
  CHECK_FALSE(window.sees("viewport.Verlet"));
  const auto limits_are_known = [&] {
    const auto& limits = window.session.studies.stability.limits();
    return limits && limits->of.integrator == "verlet";
  };
  window.until(limits_are_known, "the limits of Verlet");
  window.frames(2);
  CHECK_FALSE(window.sees("viewport.Verlet"));
  window.click("viewport.Restart");
  CHECK_FALSE(window.diverged());
  CHECK(window.preset().integrator == "verlet");
}

TEST_CASE("a slider that is dragged on past a divergence leaves every way out") {
  test::NullUi window;
  window.type_value("k_s", "1000");
  explode(window);
  window.type_value("k_s", "1520");
  REQUIRE(changed_since_divergence(window.session));
  window.until([&] { return window.sees("viewport.Replay_slowly") && window.sees("viewport.Implicit_Euler"); },
               "replay and remedies to be offered");
  CHECK_FALSE(window.control_beginning("viewport.dt").empty());
}

TEST_CASE("extreme but allowed values stop the cloth at worst; all of them are reset by Ctrl+Shift+R") {
  test::NullUi window;
  for (const auto& [key, value] : {std::pair{"k_s", "1e9"}, {"k_d", "1e6"}, {"g", "-100"}, {"dt", "1"}, {"k_b", "1e9"}})
    window.type_value(key, value);
  explode(window);
  window.key(GLFW_KEY_R, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
  window.frames(2);
  CHECK_FALSE(window.diverged());
  CHECK_FALSE(unsaved(window.session));
  window.until([&] { return window.steps() > 50; }, "the cloth to move again");
}

}  // namespace tyglab::divergence_ui_test
