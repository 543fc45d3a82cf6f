// Small building blocks of panels.
#pragma once

#include <imgui.h>

#include <functional>
#include <string_view>

#include "app/ui/kit/ui_context.h"

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

}  // namespace tyglab
