// Actions of the pointer on the cloth, the bodies, the wind and the camera: from pointer events to edits.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/base/input.h"
#include "app/base/settings.h"
#include "app/scene/scene.h"
#include "app/tools/pointer.h"
#include "core/cloth/lattice.h"

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
  /// Releases a particle or body that no longer exists.
  void follow();
  /// The actions of the tools on the cloth in an update of the session.
  SessionInput session_input();

 private:
  SessionCounts seen_;
};

// The knife: dragging with the left button cuts upward, as in the report (2.3.4), or along the pointer's path.
//
// An upward cut removes springs of the particles near the path (particles_near_path). A cut along the path removes the
// springs whose two ends lie on different sides of the stroke (springs_across), with a rule for points on it, so
// consecutive strokes miss nothing. Both produce masks of tears, so engines need no code for knives.

struct Tools;

/// Cuts everything that the pointer has passed since the last call.
void use_knife(Tools& tools);
/// Whether it cuts at the pointer once a step, since the cloth moves under it between two frames. A cut along the path
/// is over with the frame whose path it is.
bool cuts_between_steps(const Tools& tools);
/// The springs that a nick at the pointer would cut, if it is free over the viewport.
std::vector<SpringSite> springs_under_pointer(Tools& tools);

// The wind as an arrow with a draggable tip.

struct Tools;

/// An arrow in space, near the lower right corner of the first picture.
struct WindArrow {
  glm::dvec3 base{0}, tip{0};  ///< m
  double metres_per_unit = 0;  ///< so long is what is drawn of 1 N or 1 m/s, unless it would leave its place
};

/// What the arrow stands for: the wind W (N), or in a scene with air and no W the air's velocity u (m/s). A drag keeps
/// to its own.
glm::dvec3 Preset::*wind_of_arrow(const Tools& tools);
/// The wind that is asked for, N or m/s.
glm::dvec3 requested_wind(const Tools& tools);

/// Whether the arrow is shown: while there is wind, or as it was asked for.
bool wind_arrow_shown(const Tools& tools);
/// The arrow of such a wind: as long as 80 pixels for the wind of the preset as it was opened, or, where that has none,
/// for the weight of a particle or for 3 m/s; shorter where it would leave the picture.
WindArrow wind_arrow(const Tools& tools, const glm::dvec3& wind);
/// Whether a press at that pixel of the first picture takes the tip.
bool on_wind_tip(const Tools& tools, glm::vec2 at);
/// The tip has been pressed, and is dragged: the wind follows in the plane of the camera; with Shift along the view;
/// with Ctrl along the nearest axis. Every drag is one change to undo.
void take_wind(Tools& tools);
void drag_wind(Tools& tools);

}  // namespace tyglab
