// The user interface of one session: the memory of panels, cards, marks and dialogs from frame to frame. They draw the
// session and the scene, and make requests; they decide nothing.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/sketch.h"
#include "app/session/copies.h"
#include "app/session/session.h"
#include "app/tools/tools.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/ui_context.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

struct CommandRow;
struct Ui;

/// What the Accuracy card shows: error over cost, the order of convergence, or settings for an error.
enum class AccuracySide { errors, convergence, settings };

/// A card of those above each other, and where it begins in what scrolls, pixels.
struct CardAnchor {
  std::string card;
  float from;
};

/// The column of plots and cards.
struct Plots {
  bool log = false;
  std::optional<double> window_s;    ///< simulated time shown, once the wheel has set it; until then it grows
  std::string tab;                   ///< name of the card shown where only one has room; another: the first
  std::string wanted;                ///< of a card that is to come to the front where it is a tab
  std::vector<std::string> cards;    ///< names on the tabs; none where all cards have room
  std::optional<CardAnchor> anchor;  ///< the first tool that is seen
  float width = 0;                   ///< of a card, pixels
  std::set<std::string_view> hidden{"F", "F_int", "F_ext"};  ///< curves of forces, of force_keys()
  std::array<bool, 4> figure_hidden{};
  AccuracySide accuracy = AccuracySide::errors;
  bool verification = false;          ///< whether the card of the gallery of exact answers is there
  char target[32] = "1e-4";           ///< of the settings to be found: the largest error, m, as it is typed
  std::optional<float> finder_needs;  ///< height of the search for them, pixels at scale 1, once it is known
};

/// A line of the palette: what it is called, and what it does.
struct PaletteEntry {
  std::string group, title;
  std::string keys;  ///< at the right: keys, units, progress
  std::string also;  ///< words under which it is found too
  std::string help;  ///< sentences under which it is found after all others
  std::function<void(Ui&)> act;
  std::string number = {}, purpose = {};  ///< of a lab: its place in the list, and what it is for
};

/// A scene or a lab that can be opened, with its picture.
struct GalleryCard {
  const char* section;  ///< "Scenes"
  PaletteEntry entry;
  Preset preset;
  std::string problem;  ///< why it cannot be opened
};

/// The start page, and what opens presets: cards, narrowed by what is typed.
struct Gallery {
  enum class Only { all, scenes, labs };
  std::vector<GalleryCard> cards;
  char find[128] = "";
  Only only = Only::all;
  bool focus = true;     ///< its field is to take keys
  std::string narrowed;  ///< the text for which `selected` counts
  int selected = -1;     ///< among those that are found; -1: none
  int go = 0;            ///< cards to go on, by the keys of this frame
  float end = 0;         ///< px: where its list ends in the dialog
  float below = 0;       ///< px that the rest of the dialog takes
};

/// A question or a file dialog over everything else.
struct Dialog {
  enum class Kind { none, start, open, save, write_export, texture, picture, film, course_page, unsaved, large_cloth };
  Kind kind = Kind::none;
  bool opening = false;  ///< to be opened in this frame
  char path[1024] = "";
  char name[128] = "";
  std::string problem;                    ///< shown in it
  bool refused = false;                   ///< what was given: the path's field is to take keys again
  const char* selecting = nullptr;        ///< the field of which all text is to be selected, once it takes keys
  bool enter = false;                     ///< Enter was pressed in this frame
  bool path_follows = false;              ///< the path is made from the name until it is edited
  bool overwrite = false;                 ///< the file exists, and the user is asked
  bool first_start = false;               ///< of start: there is nothing yet to continue with
  bool whole_window = false;              ///< of picture
  char seconds[16] = "10";                ///< of film, as it is typed
  const CommandRow* exporting = nullptr;  ///< of write_export
  std::optional<Request> then;            ///< of a question: what follows a yes
  std::string question;
};

/// What linear theory says of a divergence and of the ways out (advice.h): kept, since it takes milliseconds and is
/// asked for in every frame.
struct Advice {
  /// What it is about: the constants that diverged, the present ones, and those before the user's last change.
  std::optional<Preset> then, now, before;
  double largest_dt = 0;          ///< s, that was stable then
  bool springs_too_weak = false;  ///< now
  std::optional<Preset> suggested_fix, slower;
  bool undo_helps = false;  ///< the linear theory says that `before` are stable
};

/// Why a copy has diverged, as it is told.
struct CopyDetails {
  std::size_t copy;
  std::int64_t step = -1;   ///< of the divergence that they are about; -1: they are not worked out yet
  bool over_views = false;  ///< they need the view buttons' place: those are not there
  std::string happened, why;
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
  bool scroll = false;  ///< the selected one is to come into sight
  int go = 0;           ///< entries to go down, by the keys of this frame
  bool enter = false;   ///< Enter was pressed
};

/// The list of methods, while it is open.
struct MethodList {
  bool open = false;
  std::vector<std::string> limits;  ///< of dt, as it says them
  int selected = 0;
  int go = 0;          ///< methods to go down, by the keys of this frame
  bool enter = false;  ///< Enter was pressed
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

/// Rows and columns (x, y) that were typed, until it is said what they mean (constants_panel.h).
struct AskedLattice {
  glm::ivec2 of;  ///< of which cloth
  double L;
  glm::ivec2 wanted;
  bool shown = false;  ///< the question has been brought into sight
};

/// A PNG of the window, or of the viewport with what its colors mean and without buttons.
struct PictureOrder {
  std::filesystem::path file;
  bool whole_window = false;
};

/// A film of the viewport: a numbered PNG for each 25th of a second that the window would show.
struct FilmOrder {
  static constexpr int fps = 25;
  std::filesystem::path folder;
  std::int64_t count = 0, frame = 0;  ///< images, and those that have been ordered
  bool shown = true;                  ///< the window has been drawn with its controls since the last image
  double next_t = 0;                  ///< s, simulated, of the next one
};

/// What a lab has opened of the plots' column: closed again when it ends. What was open before is not among it.
struct LabCards {
  std::set<std::string> unfolded;  ///< cards, by their names
  bool column = false, map = false, step = false;
};

/// The field of a lab's prediction.
struct LabField {
  bool enter = false;  ///< Enter was pressed in it in this frame
  bool again = false;  ///< what was typed is refused: it is to take keys again, all of its text selected
  bool waits = false;  ///< what answers the question was drawn in the last frame
  bool shown = false;  ///< and that is the field, not a list of choices
};

/// The pages of a lab's step.
struct LabPages {
  std::string step = {};  ///< whose they are
  int at = 0, count = 1;  ///< the one that is shown
  bool asks = false;      ///< the step waits for a prediction
  float wheel = 0;        ///< turns of the wheel that have not made up a page yet
};

/// What is shown where columns take turns.
enum class Side {
  main,  ///< the lab's text or, where not even one column has room beside it, the cloth
  constants,
  plots
};

/// What the first cut says beside the pointer.
struct CutHint {
  glm::vec2 at;  ///< px
  double until;  ///< s
};

struct Ui : UiContext {
  Ui(Session& of, Scene& in, Tools& with, InputQueue& events, Settings& remembered)
      : UiContext(events, remembered, of.messages, in.viewport), session(of), scene(in), tools(with) {}

  Session& session;
  Scene& scene;
  Tools& tools;
  /// Pressed after a key of which it depends what they do: after the palette's Enter, or what opens a field.
  std::vector<KeyEvent> later_keys;
  CommandPalette palette;
  MethodList methods;
  std::vector<PaletteEntry> menu;  ///< what the menu holds beside commands, since it was opened
  Tour tour;
  Plots plots;
  Dialog dialog;
  Gallery gallery;
  SceneSketches sketches;
  Advice advice;
  bool help = false;
  float help_needs = 0;              ///< height of what F1 shows, px; 0: not known yet
  bool panels = true;                ///< Tab hides them all
  bool panels_hidden = false;        ///< by the user, who is told how to get them back
  bool presenting = false;           ///< a large cloth over a few large controls, and one card, in place of the panels
  bool presented_card = true;        ///< whether that card is there
  std::optional<bool> banner_whole;  ///< as the user wants it; none: as there is room
  std::optional<CopyDetails> copy_details;
  std::optional<std::size_t> pause_place, legend_place;  ///< which of their places those marks took last
  double legend_clear = 0;                               ///< s, when the cloth last left the legend most of its place
  glm::ivec2 divided{1};                                 ///< columns and rows of the pictures in the last frame
  bool banner_over_views = false;                        ///< it needs the view buttons' place: they are not there
  std::optional<Viewport::Box> message_box;              ///< of the message that was shown last frame, pixels
  float marks_from = 0;                  ///< y from which marks may stand over the cloth, under the buttons; pixels
  bool arrows = true;                    ///< of the variables that are checked, at the picked particle
  std::array<double, 3> arrow_scales{};  ///< N, m/s and m/s² for the longest arrow, smoothed
  bool constants_to_top = false;         ///< another preset was taken: its constants are shown from the first one on
  std::optional<AskedLattice> asked_lattice;
  LabField lab_field;
  LabCards lab_cards;
  LabPages lab_pages;
  std::optional<CutHint> cut_hint;
  float viewport_left = 0;       ///< pixels
  bool time_in_picture = false;  ///< presentation mode has no other place for the simulated time
  Side side = Side::main;

  std::optional<PictureOrder> picture;  ///< to be taken of this frame
  std::optional<FilmOrder> film;        ///< that is being exported
  bool full_screen = false;             ///< as the window is
  bool toggle_full_screen = false;
  bool scale_changed = true;  ///< fonts are to be built again
  std::vector<std::function<void(Ui&)>> actions;

  /// Whether this frame becomes an image of the viewport, without controls, and is not shown.
  bool bare() const { return picture && !picture->whole_window; }
  /// Asks for something to be done before the next frame is drawn.
  void act(std::function<void(Ui&)> action) { actions.push_back(std::move(action)); }
  /// The same of a command, by the id of its row (commands.h).
  void command(std::string_view id);
  /// A command's keys as people call them, empty where it has none.
  const char* keys_of(std::string_view id) const;
  /// Opens what is known of the divergence of the n-th cloth (n = Copies::original or a copy).
  void show_why_diverged(int n);
  /// What colors the cloth from now on; none: its own look. Remembered for the next session.
  void color_by(std::optional<ParticleField> field);
  /// By strain, for a replay; the coloring of before comes back when the cloth that it led to is left.
  void color_replay();
  /// Does what was asked for, in order.
  void run_actions();
  /// Follows what became of the session since the last call.
  void follow();

 private:
  void remember_recent();
  void follow_replay();
  void show_what_to_change();
  void tell_of_first_cut();
  SessionCounts seen_;
  std::optional<std::optional<ParticleField>> color_before_replay_;  ///< none: no replay has set it
};

// The visual distinction of the cloths while there are copies.

/// Of the n-th cloth (n = Copies::original or a copy), the same in plots, labels and as an overlay.
inline CurveStyle cloth_style(const Tokens& colors, const Session& session, int n) {
  return copy_style(colors, cloth_of(session, n).preset().integrator, seat_of_style(session, n));
}

// The description of a divergence, of the cloth itself or of a copy.

/// When, where and what it was, and the constants `then` that decided it: they may be others by now. `limit`: the
/// largest dt that was stable in any shape, s; 0 or infinite: there is none.
std::string what_happened(const Divergence& divergence, const Preset& then, double limit);

}  // namespace tyglab
