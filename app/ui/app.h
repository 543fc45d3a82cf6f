// Everything of the sandbox that changes while it runs, in one place.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/frame_costs.h"
#include "app/base/input.h"
#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/scene/cloth_colors.h"
#include "app/scene/cloth_views.h"
#include "app/scene/effects.h"
#include "app/session/copies.h"
#include "app/session/edits.h"
#include "app/session/history.h"
#include "app/session/labs/lab_state.h"
#include "app/session/messages.h"
#include "app/session/pacing.h"
#include "app/session/rebuild.h"
#include "app/session/reference_curves.h"
#include "app/session/requests.h"
#include "app/session/rewind.h"
#include "app/session/settings.h"
#include "app/session/sleep.h"
#include "app/session/step_inspector.h"
#include "app/studies/accuracy_watch.h"
#include "app/studies/convergence_watch.h"
#include "app/studies/device_search.h"
#include "app/studies/engine_search.h"
#include "app/studies/map_watch.h"
#include "app/studies/stability_watch.h"
#include "app/tools/pointer.h"
#include "app/ui/frame/session_report.h"
#include "app/ui/frame/ui_state.h"
#include "app/ui/kit/fonts.h"
#include "app/ui/kit/theme.h"
#include "core/energy/auto_step.h"
#include "core/simulation.h"

namespace tyglab {

struct App {
  std::unique_ptr<Simulation> simulation;
  int threads = 1;  ///< of the CPU engine, at most
  Document document;
  History history;
  BackgroundRebuild building;
  EngineSearch engine_search;
  DeviceSearch device_search;
  Pacing pacing;
  Sleep sleep;
  StabilityWatch stability;
  AccuracyWatch accuracy;
  ConvergenceWatch convergence;
  MapWatch map;
  StepInspector inside;
  Rewind rewind;
  ReferenceCurves figure;
  LabState labs;
  std::optional<AutoStep> auto_dt;  ///< dt follows the constants and the ledger; none: it is the user's
  std::int64_t steps_made = 0;      ///< in the last frame
  bool warned_left_inside = false;  ///< that overlapping bodies keep particles inside, said once a session
  bool warned_unconverged = false;  ///< that an implicit method's solves do not reach their tolerance, likewise

  std::unique_ptr<ClothRenderer> renderer;
  ClothViews views;
  Copies copies;
  Camera camera;
  ViewOptions view;
  ClothColors colors;
  Effects effects;
  std::optional<request::SavePicture> picture;  ///< to be taken of this frame
  Viewport viewport;
  Tool tool;
  std::optional<Pins::Site> picked;
  bool redraw_cloth = true;     ///< something that the renderer's revision does not tell changed (a texture)
  bool wants_framing = true;    ///< the camera is to frame the scene once the viewport's size is known
  bool camera_by_hand = false;  ///< it was turned, moved or zoomed since: a picture of another size frames nothing

  Theme theme;
  Fonts fonts;
  Ui ui;
  Messages messages;
  Settings settings;
  InputQueue input;
  std::vector<Request> requests;
  FrameCosts costs;
  std::unique_ptr<SessionReport> report;  ///< none unless it is asked for

  bool full_screen = false;  ///< as the window is; a request asks to change it
  bool toggle_full_screen = false;
  bool scale_changed = true;  ///< fonts are to be built anew
  bool quit = false;
  bool scripted = false;  ///< --frames: nothing is restored, asked or remembered

  bool asleep() const { return pacing.playing && sleep.asleep(*simulation); }
  const Preset& preset() const { return simulation->preset(); }
  /// The constants as they have been asked for: those of the cloth in work, or else the present one's.
  const Preset& requested_preset() const {
    return building.requested_preset() != nullptr ? *building.requested_preset() : preset();
  }
  void request(Request request) { requests.push_back(std::move(request)); }
  void command(Command command) { requests.emplace_back(request::Do{command}); }
  /// Asks for the constants to become these.
  void propose(Preset next, unsigned gesture = 0) {
    requests.emplace_back(request::Apply{edit::Change{std::move(next)}, gesture});
  }
};

}  // namespace tyglab
