// Small building blocks of panels.
#pragma once

#include <imgui.h>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "app/ui/kit/fonts.h"
#include "app/ui/kit/ui_context.h"
#include "core/model/notation.h"

namespace tyglab {

/// Whether the pointer has rested on the last item long enough for its tooltip.
bool tooltip_due(UiContext& ui, ImGuiID id);
/// A line of text as the tooltip of the last item; the keys that do the same stand after it, quietly.
void tooltip(UiContext& ui, ImGuiID id, std::string_view text, std::string_view keys = {});

/// Begins and ends a tooltip of the house's width and look, beside the last item or, where one reads off values under
/// the pointer, at the pointer.
void begin_tooltip(UiContext& ui);
void begin_tooltip_at_pointer(UiContext& ui);
void end_tooltip(UiContext& ui);
void wrapped(UiContext& ui, std::string_view text, ImU32 color);

/// A square button with an icon (or a word where the icon font is missing).
struct IconButton {
  const char *id, *glyph, *word;
  std::string_view tip, keys = {};
  bool lit = false;
  float side = 32;  ///< at scale 1
};
bool icon_button(UiContext& ui, const IconButton& button);
/// A button with words, as wide as `width` (px; 0: as its words need); `strong` fills it with the accent.
bool text_button(UiContext& ui, const char* label, bool strong = false, bool enabled = true, float width = 0);
/// A quiet button without a ground: an icon that shows itself under the pointer.
bool quiet_button(UiContext& ui, const char* id, const char* glyph, const char* word, std::string_view tip);

/// Choices in a row of which one is taken, with this room (at scale 1) on either side of each; they go on in another
/// row where they would be wider than `width` (px). Returns the index clicked, or -1.
int segments(UiContext& ui, const char* id, const char* const* labels, int count, int chosen, float padding = 11,
             float width = 1e9f);
/// What they take, px.
ImVec2 segments_size(const UiContext& ui, const char* const* labels, int count, float padding = 11, float width = 1e9f);
/// A check box of the house's look. Returns whether it was clicked.
bool check(UiContext& ui, const char* label, bool value);
/// What it takes, px.
float check_width(const UiContext& ui, const char* label);

/// Head of a section: small capitals, what is to be noted of it, and a line; a click folds it. Returns whether it is
/// open.
bool section(UiContext& ui, const char* name, std::string_view note = {});

/// A card of lines under a heading that folds it. Heights at scale 1.
namespace card {
inline constexpr float line = 19, head = 36, foot = 10;
}
/// Its height, px, with that much (at scale 1) under its heading, or folded.
float card_height(const UiContext& ui, const char* heading, float content);
/// Begins a card as wide as its region; returns whether it is open. end_card in any case. The note stands beside the
/// heading while it is.
bool begin_card(UiContext& ui, const char* heading, float height, std::string_view note = {});
void end_card(UiContext& ui);
/// Width of what stands in a card that has begun, px.
float card_width(const UiContext& ui);
float card_width(const UiContext& ui, float width);  ///< in one that is so wide

/// A combo box; while it is open its list is written with ImGui::Selectable, then end_combo.
bool begin_combo(UiContext& ui, const char* id, const char* shown, float width);
void end_combo();
/// A menu that was opened with ImGui::OpenPopup; Esc closes it. One that is higher than `most_height` (px) scrolls.
bool begin_menu(UiContext& ui, const char* id, float most_height = 1e9f);
/// Over the rows of a group.
void menu_heading(UiContext& ui, std::string_view words);
void end_menu();

/// For a child that scrolls, before its end: what goes on below its edge is seen to, the last line fades, and an arrow
/// points down.
void more_below(UiContext& ui);

/// Leaves an area of the window to the panel: presses on the viewport there are not the viewport's.
void cover_viewport(UiContext& ui, ImVec2 lo, ImVec2 hi);

// Tabs for cards of which only one has room: in a row or two, or as a list in a small column.

/// How the names are shown in a column of that size (px).
class CardTabs {
 public:
  CardTabs(const UiContext& ui, std::span<const char* const> names, ImVec2 column);
  /// Draws them at the cursor; returns the index of the one that was chosen, or -1.
  int draw(UiContext& ui, int chosen) const;
  float height() const { return height_; }  ///< px

 private:
  std::span<const char* const> names_;
  float width_, height_, padding_;
  bool list_ = false;
};

// The positions of the controls in a frame, by name.

class ControlPlaces : public ControlLog {
 public:
  /// Controls that cannot be seen are left out.
  void add_control(std::string_view name) override;
  /// What has been added is what is shown from now on.
  void end_frame();
  /// Of the last whole frame, as much of each as is seen; pixels in the window.
  const std::map<std::string, Box>& shown() const { return shown_; }

 private:
  std::map<std::string, Box> drawing_, shown_;
};

// Symbols of the report, typeset: italic, with real subscripts, and with drawn dots for time derivatives.

/// A symbol of the notation table taken apart: "F_max" is F with the subscript max, "x''" is x with two dots.
struct SymbolParts {
  std::string_view base, subscript;
  int dots = 0;
};
SymbolParts parse_symbol(std::string_view symbol);

/// Width of the typeset symbol in pixels.
float symbol_width(const Fonts& fonts, std::string_view symbol);

/// Draws it with its left end and baseline at `at`.
void draw_symbol(ImDrawList& draw, const Fonts& fonts, ImVec2 at, std::string_view symbol, ImU32 color);

/// Baseline of a line of text, symbols and numbers whose middle is there.
float baseline_at(const Fonts& fonts, float middle);

/// Text with its top left corner at `at`.
void draw_text(ImDrawList& draw, const ImFont& font, ImVec2 at, ImU32 color, std::string_view text);
/// Text whose left end stands on the baseline at `at`, rounded to whole pixels: fonts of all kinds and sizes line up.
void draw_on_baseline(ImDrawList& draw, const ImFont& font, ImVec2 at, ImU32 color, std::string_view text);
float text_width(const ImFont& font, std::string_view text);
/// The text, or as much of its beginning as fits into the width with … after it.
std::string fitted(const ImFont& font, const std::string& text, float width);
/// The text in lines of that width, broken as broken_into_lines does; Dear ImGui would also break within 0.001.
std::string in_lines(const ImFont& font, std::string_view text, float width);

// The slider and the typed value of a constant.

/// What a slider spans. A logarithmic one that starts at 0 keeps a small stretch at its left end for 0 itself.
struct SliderScale {
  double min, max;
  Scale scale = Scale::linear;
  bool integer = false;
  double low = 0;  ///< of a logarithmic one that starts at 0: the least other value
};
/// The slider of a constant whose preset has that value.
SliderScale slider_scale(const PresetRow& row, double preset_value);
/// The same scale, longer at the one side on which `value` lies beyond it, by whole decades (a linear one doubles), but
/// within the row's limits: what stands at the other end stays there, and 0 at the left.
SliderScale grown(SliderScale scale, const PresetRow& row, double value);
/// Place of a value on the slider, 0 to 1.
double slider_position(const SliderScale& scale, double value);
/// The value there, rounded to that many significant digits.
double slider_value(const SliderScale& scale, double position, int digits = 3);

struct SliderResult {
  bool changed = false;   ///< `value` is new
  bool finished = false;  ///< the drag (or the key) is over
  bool reset = false;     ///< double click: back to the preset's value
  double value = 0;
  unsigned typed = 0;  ///< the field in which Enter gave it; 0: not given so
};

/// Draws it at the cursor and takes mouse and keys. Shift drags ten times finer.
SliderResult slider(UiContext& ui, const SliderScale& scale, double value, float width, float height);

/// What was typed there is not accepted: the field keeps the keys, with all of its text selected.
void type_again(SliderState& state, unsigned field);

/// A value that is dragged sideways (`scale` tells how far) or typed: component of a vector.
SliderResult drag_cell(UiContext& ui, const char* id, const SliderScale& scale, double value, float width, float height,
                       std::string_view name, std::string_view unit);

/// A number that a double click or Ctrl+click lets one type. `shown` is its text; `unit` may be typed after it; `name`
/// is what a refusal calls it.
SliderResult value_cell(UiContext& ui, const char* id, double value, std::string_view shown, float width, float height,
                        std::string_view name, std::string_view unit);

}  // namespace tyglab
