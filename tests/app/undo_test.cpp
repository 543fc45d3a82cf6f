// Ctrl+Z takes back the last action, whatever it was, and says which.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <string>

#include "app/session/copies.h"
#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/model/fabric.h"
#include "tests/support/scenes.h"

namespace tyglab::undo_test {

Session session_with(const Preset& preset) {
  Session session;
  session.simulation = std::make_shared<Simulation>(preset);
  session.document.saved = preset;
  return session;
}

Session moving_cloth() {
  Preset preset = test::cloth(8, 8);
  preset.dt = 1e-3;
  Session session = session_with(preset);
  session.simulation->advance(50);
  return session;
}

bool said(const Session& session, const std::string& part) {
  for (const Message& message : session.messages.list())
    if (message.text.find(part) != std::string::npos) return true;
  return false;
}

void set_k_s(Session& session, double k_s) {
  Preset next = session.preset();
  next.k_s = k_s;
  REQUIRE(apply_edit(session, edit::Change{next}));
}

edit::Cut cut_at(int i, int j) {
  return edit::Cut{{{i, j}}};
}

TEST_CASE("a cut is taken back with the moment in which it was made, and nothing earlier with it") {
  Session session = moving_cloth();
  REQUIRE(apply_edit(session, edit::Pin{7, 3, true}));
  session.simulation->advance(10);
  const double t = session.simulation->time();
  const glm::dvec3 x = session.simulation->position(4, 4);
  REQUIRE(apply_edit(session, cut_at(4, 4), 5));
  const auto torn = session.simulation->tears().torn_count();
  REQUIRE(torn > 0);
  session.simulation->advance(20);
  REQUIRE(apply_edit(session, cut_at(4, 5), 5));  // the same stroke
  session.simulation->advance(20);
  const auto all_torn = session.simulation->tears().torn_count();
  const glm::dvec3 later = session.simulation->position(4, 4);

  take_from_history(session, true);
  CHECK(session.simulation->tears().torn_count() == 0);
  CHECK(session.simulation->time() == t);
  CHECK(session.simulation->position(4, 4) == x);
  CHECK(session.simulation->pinned(7, 3));
  CHECK(said(session, "Undone: cut. The cloth is at t = 0.060 s again."));

  take_from_history(session, false);
  CHECK_FALSE(said(session, "Undone: cut"));  // nothing older is told after it
  CHECK(session.simulation->tears().torn_count() == all_torn);
  CHECK(glm::distance(session.simulation->position(4, 4), later) < 1e-12);
  CHECK(said(session, "Redone: cut."));

  take_from_history(session, true);
  take_from_history(session, true);
  CHECK_FALSE(session.simulation->pinned(7, 3));
  CHECK(said(session, "Undone: pin at (7, 3)."));
  take_from_history(session, true);
  CHECK(said(session, "There is nothing to undo."));
}

TEST_CASE("what is undone is named, methods and precisions too") {
  Session session = session_with(test::cloth(8, 8));
  const Preset before = session.preset();
  Preset preset = before;
  preset.integrator = "rk4";
  REQUIRE(apply_edit(session, edit::Change{preset}, 1));
  preset.precision = Precision::float_;
  REQUIRE(apply_edit(session, edit::Change{preset}, 2));
  CHECK(only_change(before, session.preset()).empty());
  take_from_history(session, true);
  CHECK(said(session, "Undone: precision float → double."));
  CHECK(only_change(before, session.preset()) == "integrator");
  take_from_history(session, true);
  CHECK(said(session, "Undone: integrator Runge-Kutta 4 → Verlet."));
}

TEST_CASE("of a fabric that was chosen its name is told, not one of its constants") {
  Session session = session_with(test::cloth(8, 8));
  for (const Fabric& fabric : {fabrics().front(), fabrics().back()})
    REQUIRE(apply_edit(session, edit::Change{with_fabric(session.preset(), fabric)}, 0));
  const std::string first(fabrics().front().name), last(fabrics().back().name);
  take_from_history(session, true);
  CHECK(said(session, ("Undone: fabric " + last + " → " + first + ".").c_str()));
  take_from_history(session, true);
  CHECK(said(session, ("Undone: fabric " + first + " → none.").c_str()));
  take_from_history(session, false);
  CHECK(said(session, ("Redone: fabric none → " + first + ".").c_str()));
}

TEST_CASE("a knife that goes through nothing leaves nothing to undo") {
  Session session = moving_cloth();
  REQUIRE(apply_edit(session, edit::CutSprings{}, 5));
  CHECK_FALSE(session.history.can_undo());
}

TEST_CASE("a pull, a restart and a constant are taken back one after the other, each named") {
  Session session = moving_cloth();
  const double begun = session.simulation->time();
  set_k_s(session, 80);
  session.simulation->advance(10);
  const double grabbed = session.simulation->time();
  const glm::dvec3 x = session.simulation->position(7, 0);
  REQUIRE(apply_edit(session, edit::Grab{7, 0}));
  REQUIRE(apply_edit(session, edit::MoveHand{x + glm::dvec3(0.1, 0, 0.1), 20}));
  session.simulation->advance(20);
  REQUIRE(apply_edit(session, edit::Release{}));
  session.simulation->advance(20);
  const double ended = session.simulation->time();
  restart(session);
  session.simulation->advance(5);

  take_from_history(session, true);
  CHECK(said(session, "Undone: restart"));
  CHECK(session.simulation->time() == ended);
  take_from_history(session, true);
  CHECK(said(session, "Undone: pull at (7, 0)"));
  CHECK(session.simulation->time() == grabbed);
  CHECK(session.simulation->position(7, 0) == x);
  CHECK_FALSE(session.simulation->held());
  take_from_history(session, true);
  CHECK(said(session, "Undone: k_s 80 → 50 N/m."));
  CHECK(session.preset().k_s == 50);
  CHECK(session.simulation->time() == grabbed);  // the motion goes on
  for (int n = 0; n < 3; ++n) take_from_history(session, false);
  CHECK(session.preset().k_s == 80);
  CHECK(session.simulation->steps() == 5);
  CHECK(begun < grabbed);
}

TEST_CASE("a restart before anything moved, and one after a divergence, are no actions to take back") {
  Session session = session_with(test::cloth(8, 8));
  restart(session);
  CHECK_FALSE(session.history.can_undo());
  set_k_s(session, 1e6);
  session.simulation->advance(2000);
  REQUIRE(session.simulation->divergence());
  restart(session);
  take_from_history(session, true);
  CHECK(said(session, "Undone: k_s 1e6 → 50 N/m."));
}

TEST_CASE("what led to a divergence can be undone and done again") {
  Session session = moving_cloth();
  restart(session);
  set_k_s(session, 1e6);
  session.simulation->advance(2000);
  REQUIRE(session.simulation->divergence());
  const double t = session.simulation->time();
  take_from_history(session, true);
  take_from_history(session, true);  // the restart, whose motion has diverged
  CHECK(session.preset().k_s == 50);
  take_from_history(session, false);
  CHECK(session.simulation->time() == t);  // the last whole step
  take_from_history(session, false);
  CHECK(session.preset().k_s == 1e6);
  session.simulation->advance(1);
  CHECK(session.simulation->divergence());
}

TEST_CASE("rewinding past a change says that it stays, and Ctrl+Z takes it back") {
  Session session = moving_cloth();
  const auto go_on = [&](int steps) {
    for (int n = 0; n < steps; ++n) session.rewind.look(*session.simulation), session.simulation->advance(1);
  };
  go_on(1500);
  set_k_s(session, 80);
  go_on(200);
  REQUIRE(apply_edit(session, cut_at(4, 4)));
  go_on(200);
  REQUIRE(rewind_and_say_what_stays(session));
  CHECK(session.preset().k_s == 80);
  CHECK(session.simulation->tears().torn_count() == 0);  // the cut has gone with the motion
  CHECK(said(session, "Rewound the motion, not the constants: k_s 50 → 80 N/m stays. Ctrl+Z undoes it."));
  take_from_history(session, true);
  CHECK(session.preset().k_s == 50);
  go_on(1500);
  session.messages = Messages();
  REQUIRE(rewind_and_say_what_stays(session));
  CHECK(session.messages.list().empty());
}

/// Steps of the cloth with its copies.
void go_on(Session& session, int steps) {
  session.simulation->advance(steps);
  copies_follow(session, 0);
}

glm::dvec3 corner_of_copy(const Session& session, std::size_t n) {
  return session.copies.lockstep[n].simulation->position(7, 0);
}

TEST_CASE("a copy that was removed is brought back with its motion, and nothing else is undone") {
  for (const int meanwhile : {0, 20}) {
    CAPTURE(meanwhile);
    Session session = moving_cloth(), control = moving_cloth();
    for (Session* each : {&session, &control}) {
      set_k_s(*each, 60);
      restart(*each);
      add_copy(*each, {{&Preset::k_s, 80.0}}, false);
      add_copy(*each, {{&Preset::k_s, 20.0}}, true);
      go_on(*each, 50);
    }
    remove_copy(session, 0);
    CHECK(session.copies.reference == 0);
    for (Session* each : {&session, &control}) go_on(*each, meanwhile);
    const double t = session.simulation->time();
    take_from_history(session, true);
    CHECK(said(session, "Undone: removal of the copy (k_s = 80)."));
    REQUIRE(session.copies.lockstep.size() == 2);
    CHECK(session.copies.reference == 1);
    CHECK(settings_of_cloth(session, 0) == "k_s = 80");
    CHECK(session.simulation->time() == t);
    CHECK(session.preset().k_s == 60);
    for (const std::size_t n : {0, 1}) CHECK(corner_of_copy(session, n) == corner_of_copy(control, n));
    for (Session* each : {&session, &control}) go_on(*each, 30);
    for (const std::size_t n : {0, 1}) CHECK(corner_of_copy(session, n) == corner_of_copy(control, n));

    take_from_history(session, false);
    CHECK(said(session, "Redone: removal of the copy (k_s = 80)."));
    CHECK(session.copies.lockstep.size() == 1);
    take_from_history(session, true);
    REQUIRE(session.copies.lockstep.size() == 2);
    CHECK(corner_of_copy(session, 0) == corner_of_copy(control, 0));
  }
}

TEST_CASE("a copy that was added is taken away by an undo, and a redo brings it back") {
  Session session = moving_cloth();
  set_k_s(session, 60);
  add_copy(session, {{&Preset::k_s, 80.0}}, true);
  go_on(session, 30);
  const glm::dvec3 x = corner_of_copy(session, 0);
  take_from_history(session, true);
  CHECK(said(session, "Undone: new copy (k_s = 80)."));
  CHECK(session.copies.lockstep.empty());
  CHECK(session.preset().k_s == 60);
  take_from_history(session, false);
  REQUIRE(session.copies.lockstep.size() == 1);
  CHECK(session.copies.reference == 0);
  CHECK(corner_of_copy(session, 0) == x);
  take_from_history(session, true);
  take_from_history(session, true);
  CHECK(session.preset().k_s == 50);
  CHECK(said(session, "Undone: k_s 60 → 50 N/m."));
}

TEST_CASE("a copy that had diverged comes back so; one whose cloth is elsewhere by now starts from that") {
  Session session = moving_cloth();
  add_copy(session, {{&Preset::k_s, 1e6}}, false);
  go_on(session, 500);
  REQUIRE(session.copies.lockstep[0].simulation->divergence());
  remove_copy(session, 0);
  go_on(session, 500);
  take_from_history(session, true);
  REQUIRE(session.copies.lockstep.size() == 1);
  CHECK(session.copies.lockstep[0].simulation->divergence());

  Session back = moving_cloth();
  const Snapshot then = back.simulation->snapshot();
  add_copy(back, {{&Preset::k_s, 80.0}}, false);
  go_on(back, 100);
  remove_copy(back, 0);
  back.simulation->restore(then);
  take_from_history(back, true);
  REQUIRE(back.copies.lockstep.size() == 1);
  CHECK(corner_of_copy(back, 0) == back.simulation->position(7, 0));
  CHECK(said(back, "The copy starts from the present cloth."));
}

TEST_CASE("states are kept within their memory, and what is too large says so") {
  History history;
  Simulation simulation(test::cloth(300, 300));
  const auto state = std::make_shared<const Snapshot>(simulation.snapshot());
  const int fit = int(History::most_bytes / state->bytes());
  for (int n = 0; n < fit + 5; ++n) history.record({simulation.preset(), 0, "cut", state}, 0);
  CHECK(history.bytes() <= History::most_bytes + 1000 * std::size_t(fit));
  int kept = 0;
  for (; history.can_undo(); ++kept) history.take(true, {});
  CHECK(kept == fit);

  Session session = moving_cloth();
  HistoryEntry entry{session.preset(), 0, "cut"};
  entry.too_large = true;
  session.history.record(entry, 0);
  take_from_history(session, true);
  CHECK(said(session, "The cut cannot be undone"));
}

}  // namespace tyglab::undo_test
