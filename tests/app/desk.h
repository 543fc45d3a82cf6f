// A user interface without a window: a session, its scene, tools and panels, put together as the window does.
#pragma once

#include "app/session/session.h"
#include "app/tools/pointer.h"
#include "app/ui/state/ui.h"

namespace tyglab::test {

struct Desk {
  explicit Desk(const Preset& preset = {}) {
    session.simulation = std::make_shared<Simulation>(preset);
    session.document.saved = preset;
  }
  /// What was asked for is done, and everybody follows.
  void act() {
    apply_requests(session);
    follow();
    ui.run_actions();
    follow();
  }
  void follow() { scene.follow(), tools.follow(), ui.follow(); }

  Settings settings;
  InputQueue input;
  Session session;
  Scene scene{session};
  Tools tools{session, scene, input, settings.handling};
  Ui ui{session, scene, tools, input, settings};
};

}  // namespace tyglab::test
