// State of the user interface that is neither simulated nor remembered.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/base/input.h"
#include "app/session/requests.h"
#include "app/session/series.h"
#include "app/ui/kit/overlay_layout.h"
#include "core/model/preset.h"

namespace tyglab {

struct App;

/// The slider or value in use.
struct SliderState {
  unsigned focused = 0;       ///< takes keys; 0: none
  bool focused_seen = false;  ///< it was drawn in this frame
  unsigned typing = 0;        ///< its value is being typed
  bool typing_starts = false;
  bool commit = false, cancel = false;  ///< Enter, Escape while typing
  char text[64] = "";
  unsigned dragged = 0;
  double position = 0;                                   ///< of the drag, 0 to 1, finer than the value shows
  double value = 0;                                      ///< of the drag, for constants that are taken when it ends
  bool reset_done = false;                               ///< a double click reset it: its presses do not drag
  double reset_time = -1;                                ///< s
  std::vector<KeyEvent> keys;                            ///< of this frame, for the focused one
  int order = 0, focused_order = -1, wanted_order = -1;  ///< position in the panel, for Tab and up and down
  std::string wanted_key;  ///< of the constant whose slider is to take the focus when it is drawn next
};

/// What the force plot follows.
enum class Source { particle, sum, maximum };

struct Plots {
  static constexpr int forces_count = 7;
  Source source = Source::particle;
  bool paused = false;
  bool log = false;
  std::optional<double> window_s;  ///< simulated time shown, once the wheel has set it; until then it grows
  std::string tab;                 ///< name of the card shown where only one has room; another: the first
  std::string wanted;              ///< of a card that is to come to the front where it is a tab
  std::vector<std::string> cards;  ///< names on the tabs of the last frame; none where all cards have room
  float width = 0;                 ///< of a card, pixels
  bool scrolls = false;            ///< the wheel scrolls their column, and zooms a plot only with Ctrl
  std::array<bool, forces_count> hidden{true, false, false, false, false, true, true};
  Series forces{forces_count};
  Series height{5};  ///< of the weight, then by the curves of Figure
  std::array<bool, 4> figure_hidden{};
  /// From which simulated time on (s) which method moved the weight.
  std::vector<std::pair<double, std::string>> height_methods;
  bool forces_shown = false, height_shown = false;  ///< in the last frame: only then is data collected
};

/// A question or a file dialog over everything else.
struct Dialog {
  enum class Kind { none, open, save, write_export, texture, picture, unsaved, large_cloth };
  Kind kind = Kind::none;
  bool opening = false;  ///< to be opened in this frame
  char path[1024] = "";
  char name[128] = "";
  std::string problem;          ///< shown in it
  bool refused = false;         ///< what was given: the path's field is to take keys again
  bool selecting = false;       ///< all of its text, once it takes them
  bool enter = false;           ///< Enter was pressed in this frame
  bool path_follows = false;    ///< the path is made from the name until it is edited
  bool overwrite = false;       ///< the file exists, and the user is asked
  bool whole_window = false;    ///< of picture
  ExportSource source{};        ///< of write_export
  std::optional<Request> then;  ///< of a question: what follows a yes
  std::string question;
  struct Entry {
    std::filesystem::path file;
    std::string label, name, description, problem;
    bool shipped = false;
  };
  std::vector<Entry> entries;
  int selected = -1;
};

/// What linear theory says of a divergence and of the ways out (advice.h): kept, since it takes milliseconds and is
/// asked for in every frame.
struct Advice {
  std::optional<Preset> then, now;  ///< what it is about: the constants that diverged, the present ones
  double largest_dt = 0;            ///< s, that was stable then
  bool springs_too_weak = false;    ///< now
  std::optional<Preset> suggested_fix, slower;
};

/// A line of the palette: what it is called, and what it does.
struct PaletteEntry {
  std::string group, title;
  std::string keys;  ///< at the right: keys, units, progress
  std::string also;  ///< words under which it is found too
  std::string help;  ///< sentences under which it is found after all others
  std::function<void(App&)> act;
};

/// Ctrl+P: a list of all that can be done, narrowed by what is typed.
struct CommandPalette {
  bool open = false;
  bool opening = false;  ///< its field is to take keys
  bool labs = false;     ///< it lists labs alone
  std::vector<PaletteEntry> entries;
  char text[128] = "";
  std::string narrowed;  ///< the text for which `selected` counts
  int selected = 0;
  int go = 0;                   ///< entries to go down, by the keys of this frame
  bool enter = false;           ///< Enter was pressed
  std::vector<KeyEvent> later;  ///< pressed after it, for what stands there once it has acted
};

/// The cards that show a newcomer round.
struct Tour {
  int card = -1;                     ///< none while below 0
  bool next = false, leave = false;  ///< asked for by keys of this frame
  struct Place {
    glm::vec2 lo{0}, hi{0};
  };
  Place transport, labs;  ///< where the top bar drew them
};

struct Ui {
  SliderState slider;
  CommandPalette palette;
  Tour tour;
  Plots plots;
  Dialog dialog;
  Advice advice;
  bool help = false;
  bool panels = true;                                    ///< Tab hides them all
  OverlayLayout placing;                                 ///< what stands where over the cloth in this frame
  std::optional<std::size_t> pause_place, legend_place;  ///< which of their places those marks took last
  float notes_from = 0;                  ///< y from which notes may stand over the cloth, under the buttons; pixels
  bool arrows = true;                    ///< of the variables that are ticked, at the picked particle
  std::optional<bool> wind_arrow;        ///< shown or not; none: while there is wind
  bool energy_shown = false;             ///< the ledger's card is open
  bool accuracy_shown = false;           ///< the accuracy card is open
  bool inside_shown = false;             ///< a step written out is in sight
  bool map_shown = false;                ///< the map of stiffness against dt is in sight
  std::array<double, 3> arrow_scales{};  ///< N, m/s and m/s² for the longest arrow, smoothed
  double now = 0;                        ///< s since the window opened
  double draw_by = 0;      ///< when the next frame is wanted though nothing moves (a tooltip, a cursor, a message)
  double last_change = 0;  ///< when constants changed last, to tell gestures apart
  unsigned hovered = 0;    ///< what the pointer rests on, for tooltips
  double hovered_since = 0;
  bool hover_seen = false;
  glm::vec2 tooltip_size{0};      ///< of the last tooltip, pixels
  bool close_lists = false;       ///< Esc was pressed: open menus and combo boxes close in this frame
  bool constants_to_top = false;  ///< another preset was taken: its constants are shown from the first one on
  float viewport_left = 0;        ///< pixels
  bool side_plots = false;        ///< where both columns have no room, the plots stand in the constants' place
  bool side_cloth = true;         ///< where not even one has room beside the cloth: the cloth is shown, and neither
  float row_width = 0;            ///< of the constants, pixels
};

}  // namespace tyglab
