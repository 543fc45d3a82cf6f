// The drawing context and memory of the toolkit: the theme, the pointer and keys of a frame, and the controls that are
// hovered, typed into or dragged. It contains no cloth.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/input.h"
#include "app/base/messages.h"
#include "app/base/settings.h"
#include "app/ui/kit/fonts.h"
#include "app/ui/kit/overlay_layout.h"
#include "app/ui/kit/theme.h"

namespace tyglab {

/// How far a constant's value has gone since it was last the preset's: its slider spans that too.
struct SliderReach {
  double preset;  ///< the preset's value; with another one it does not count any more
  double least, most;
};

/// The slider or value in use.
struct SliderState {
  unsigned focused = 0;       ///< takes keys; 0: none
  bool focused_seen = false;  ///< it was drawn in this frame
  unsigned typing = 0;        ///< its value is being typed
  bool typing_starts = false;
  double typing_since = 0;              ///< s
  bool commit = false, cancel = false;  ///< Enter, Escape while typing
  char text[64] = "";
  std::string refused;  ///< what was typed last and not accepted: its field keeps the keys
  unsigned dragged = 0;
  double position = 0;                                   ///< of the drag, 0 to 1, finer than the value shows
  double value = 0;                                      ///< of the drag, for constants that are taken when it ends
  bool reset_done = false;                               ///< a double click reset it: its presses do not drag
  double reset_time = -1;                                ///< s
  std::vector<KeyEvent> keys;                            ///< of this frame, for the focused one
  int order = 0, focused_order = -1, wanted_order = -1;  ///< position in the panel, for Tab and up and down
  std::map<std::string, SliderReach> reaches;  ///< by the constant's key; of those that went beyond their usual span
  std::string wanted_key;  ///< of the constant whose slider is to take the focus when it is drawn next
  std::string shown_key;   ///< of the constant whose row is to be in sight when it is drawn next
  float rows_scroll = 0;   ///< by how much the column of constants is scrolled, or will be once this frame is drawn, px
};

/// Notes where controls are, for whoever drives the window.
class ControlLog {
 public:
  virtual ~ControlLog() = default;
  /// The Dear ImGui item drawn last is a control of that name.
  virtual void add_control(std::string_view name) = 0;
};

struct UiContext {
  UiContext(InputQueue& events, Settings& remembered, Messages& said, Viewport& seen)
      : input(events), settings(remembered), messages(said), viewport(seen) {}

  Theme theme;
  Fonts fonts;
  InputQueue& input;
  Settings& settings;
  Messages& messages;
  Viewport& viewport;  ///< controls that are drawn over it cover it
  ControlLog* controls = nullptr;
  SliderState slider;
  OverlayLayout placing;  ///< what stands where over the cloth in this frame
  double now = 0;         ///< s since the window opened
  double draw_by = 0;     ///< when the next frame is wanted though nothing moves (a tooltip, a cursor, a message)
  unsigned hovered = 0;   ///< what the pointer rests on, for tooltips
  double hovered_since = 0;
  bool hover_seen = false;
  bool hover_used = false;                               ///< it was pressed or typed into since: no tooltip any more
  glm::vec2 tooltip_size{0};                             ///< of the last tooltip, pixels
  std::optional<Viewport::Box> tooltip, tooltip_before;  ///< of this frame so far, and of the last one, pixels
  float tooltip_wrap = 0;        ///< where lines end in the one that is being written, pixels; 0: there is none
  bool keys_since_move = false;  ///< a key was pressed since the pointer moved last: no tooltips
  glm::vec2 pointer_before{-1};  ///< pixels
  bool close_lists = false;      ///< Esc was pressed: open menus and combo boxes close in this frame
  bool covered = false;          ///< something lies over everything: no tooltips
  bool wheel_scrolls = false;    ///< the wheel scrolls the column of plots, and zooms a plot only with Ctrl
  float row_width = 0;           ///< of what is laid out in rows, pixels
  std::string refusal;           ///< said of the number that was refused last; empty once one has been accepted

  /// Says why a number that was typed is refused, in place of what was said of the one before.
  void refuse_number(std::string why) {
    accept_number();
    refusal = why;
    messages.error(std::move(why));
  }
  /// What was said of those before it is of no more use.
  void accept_number() { messages.take_back(std::exchange(refusal, {})); }
};

/// Names the item drawn last for the control log, if there is one: the region or "dialog" or "menu" that it stands in,
/// a dot, and `name` with _ for all but letters and digits: "top.play", "constants.k_s.slider", "dialog.Save".
inline void report_control(UiContext& ui, std::string_view name) {
  if (ui.controls != nullptr) ui.controls->add_control(name);
}

}  // namespace tyglab
