// A frame of the sandbox without its window: the effects of events, and everything drawn with Dear ImGui. The window
// collects events before it and shows a picture after it; a test needs neither.
#pragma once

namespace tyglab {

struct Ui;

/// Whoever shows the session or acts on it follows what became of it.
void follow_session(Ui& ui);
/// Takes the look of the settings' theme where it has changed; `content_scale` is what the monitor asks for. Returns
/// whether the fonts are to be rebuilt, at ui.theme.scale.
bool take_look(Ui& ui, float content_scale);
/// Does what keys, requests and pointer of the frame ask for, and goes on by `elapsed` seconds. `frame_time`: of the
/// display, s.
void act_on_events(Ui& ui, double elapsed, double frame_time);
/// Draws everything within a frame of Dear ImGui that has begun.
void draw_panels(Ui& ui);
/// Changes that follow a while without one are undone apart from those before it.
void end_gestures(Ui& ui);

}  // namespace tyglab
