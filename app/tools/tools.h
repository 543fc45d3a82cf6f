// Actions of the pointer on the cloth, the bodies, the wind and the camera: from pointer events to edits.
#pragma once

#include <functional>
#include <optional>

#include "app/base/input.h"
#include "app/base/settings.h"
#include "app/scene/scene.h"
#include "app/tools/pointer.h"

namespace tyglab {

struct Tools {
  Tools(Session& of, Scene& in, const InputQueue& events, const ToolSettings& as)
      : session(of), scene(in), input(events), settings(as) {}

  Session& session;
  Scene& scene;
  const InputQueue& input;
  const ToolSettings& settings;
  Tool tool;
  std::optional<bool> wind_arrow;  ///< shown or not; none: while there is wind
  bool finger_cuts = false;        ///< one finger on a touch screen cuts; otherwise it takes hold of the cloth
  double now = 0;                  ///< s, the window's clock

  /// Lengths on the screen, given at scale 1, in pixels.
  float px(float at_1) const { return at_1 * scene.scale; }
  /// Lets go of what is no longer there.
  void follow();
  /// What the tools do to the cloth in an update of the session.
  SessionInput session_input();

 private:
  SessionCounts seen_;
};

}  // namespace tyglab
