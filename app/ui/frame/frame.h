// A frame of the sandbox without its window: the effects of events, and everything drawn with Dear ImGui. The window
// collects events before it and shows a picture after it; a test needs neither.
#pragma once

#include <bitset>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "app/base/input.h"

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
/// While a film is exported: the time by which the motion is to go on in the next frame, s; orders the picture when the
/// cloth is where it is due. None: there is no film, or it has ended, which is said.
std::optional<double> direct_film(Ui& ui);
/// Draws everything within a frame of Dear ImGui that has begun.
void draw_panels(Ui& ui);
/// Changes that follow a while without one are undone apart from those before it.
void end_gestures(Ui& ui);

// Keys to commands, from the window's own callback: Dear ImGui loses short presses during long frames.

struct KeyEvent;
struct Ui;

/// Turns the frame's key presses into requests. A text field or slider that is active keeps its keys.
void handle_keys(Ui& ui);
/// Whether it is the key of a command that opens a text field, for which what is typed next is.
bool opens_field(const KeyEvent& event);

// Dear ImGui reads keys, buttons and the pointer once per frame, but one of our frames may contain a whole click, a
// drag or a typed word. So it receives all events in order, and in each frame only as many as it can distinguish.

class GuiInput {
 public:
  /// Shows the current context what one frame can hold of all that has come and not been shown yet, and notes in
  /// `input` whether anything is left. Comes before ImGui::NewFrame, and after a back end that would say otherwise.
  void feed(InputQueue& input);
  /// In place of that, before a frame without some of its controls (Ui::bare()): all waits for the next frame.
  void hold(InputQueue& input);

 private:
  /// What the present frame has been shown so far.
  struct Frame {
    bool key = false, text = false, button = false, moved = false;
    std::optional<int> mods;
  };
  void take(const InputQueue& input);
  void release_keys(const InputQueue& input);
  void tell_what_waits(InputQueue& input) const;
  bool show(const InputEvent& event, Frame& frame);
  bool show(const KeyEvent& event, Frame& frame);
  bool show(const TypedCharacter& typed, Frame& frame);
  bool show(const PointerEvent& event, Frame& frame);

  std::vector<InputEvent> waiting_;
  std::bitset<InputQueue::most_keys> keys_, changed_;  ///< keys shown as down; those that the present frame changed
  std::bitset<InputQueue::most_buttons> buttons_;      ///< shown as down
  glm::vec2 at_{-1e6f};                                ///< where the pointer is shown
  int held_ = 0;  ///< frames at most for which all waits, until the field takes keys that the last key opens
  bool focused_ = true;
};

}  // namespace tyglab
