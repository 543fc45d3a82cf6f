// The bars, dialogs and overlays on top of the panels, and the division of the window into regions.
#pragma once

#include <imgui.h>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/kit/overlay_layout.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/state/ui.h"
#include "core/model/notation.h"

namespace tyglab {

void top_bar(Ui& ui, const Region& region);
void status_bar(Ui& ui, const Region& region);
void help_overlay(Ui& ui);
/// Everything that can be done, while the popup of that name is open.
void application_menu(Ui& ui, const char* id);
/// The current lab, in a column beside the cloth or in a strip below it; with the constants that its step checks where
/// they are not in sight.
void lab_panel(Ui& ui, const Region& region, bool column, bool with_constants);
/// px; 0 in a window in which it is a strip.
float lab_column_width(const Ui& ui, float window);
float lab_strip_height(const Ui& ui, float window, float available);
/// What a lab leaves to all columns together in a window of that width, px.
float room_beside_cloth(float window);
/// The constants that the lab's step checks, in its order.
std::vector<const PresetRow*> checked_constants(const Ui& ui);

/// What presentation mode has in place of bars and columns, below the cloth.
void podium(Ui& ui, const Region& region);
float podium_height(const Ui& ui);
/// Whether it has the simulated time, in a window of that width, px; otherwise that is in the picture.
bool time_on_podium(const Ui& ui, float width);
/// Of the card beside the cloth, in a window of that width, px; 0 where it has no room.
float presented_card_width(const Ui& ui, float window);

/// All regions, with the borders between them that drag.
void draw_layout(Ui& ui, ImVec2 window);
/// What they want to be worked out, in a window of that size (px): by what is open and has room, drawn or not.
Wants layout_wants(const Ui& ui, ImVec2 window);

// Questions and file dialogs above everything else.

struct Ui;

/// Opens a file dialog.
void open_dialog(Ui& ui, Dialog::Kind kind);
/// Asks a question; `then` is requested when it is answered with yes.
void ask(Ui& ui, Dialog::Kind kind, std::string question, Request then);
/// Opens the save dialog again with what went wrong.
void show_save_problem(Ui& ui, const std::filesystem::path& file, const std::string& name, const std::string& problem);
/// Opens the dialog that saves an image again with what went wrong.
void show_picture_problem(Ui& ui, const PictureOrder& order, const std::string& problem);
/// Draws the open dialog, if any.
void dialogs(Ui& ui);

// Scenes, presets and labs as cards with pictures: the start page and the dialog that opens presets.

/// Looks for what there is now; labs only where asked for.
void fill_gallery(Ui& ui, bool labs);
/// What stands over it (in a `low` window it scrolls with the cards, and is brief), the field that narrows it, and the
/// cards in a list; closes the dialog and opens what is chosen. What is wrong with a file becomes the dialog's problem.
void gallery(Ui& ui, const std::function<void(bool low)>& head);
/// Whether a card is chosen by keys or by what was typed, and opening it as a click on it does.
bool gallery_choice(const Ui& ui);
void open_gallery_choice(Ui& ui);
/// Called when the rest of the dialog stands: the list's height leaves room for that.
void end_gallery(Ui& ui);

// A card of the gallery: the picture, title and purpose of a scene.

/// What all cards of a gallery have in common, px: the picture stands over the text, or at its left.
struct CardShape {
  float width;
  ImVec2 picture;
  bool beside;
};
CardShape card_shape(const Ui& ui, float width, bool beside);

/// What a card says, in lines of its width; nothing of it is cut but a goal of more than a few lines.
struct CardText {
  std::string title, goal;
  const ImFont* font = nullptr;  ///< of the goal
  float height = 0;              ///< px, of the card
  bool whole = false;            ///< the goal is all that there is to say
};
CardText card_text(const Ui& ui, const GalleryCard& card, const CardShape& shape);

/// Whole sentences of a text, as many as three lines of that width (px) hold, but the first in any case.
std::string goal_in_lines(const ImFont& font, const std::string& text, float width);

/// Draws it from that corner on, with the height of its row, px; `lit`: under the pointer, or chosen by keys.
void draw_gallery_card(Ui& ui, const GalleryCard& card, ImVec2 lo, const CardShape& shape, float height, bool lit);

// Ctrl+P: finds commands, presets, integrators, labs, constants and views by typing.

/// Opens it; `labs`: with labs alone, and how far each is done.
void open_palette(Ui& ui, bool labs = false);
/// Draws it, and does what is chosen.
void palette(Ui& ui);

/// All that it finds now.
std::vector<PaletteEntry> palette_entries(Ui& ui);
/// A lab, and a preset, as it finds them.
PaletteEntry lab_entry(const Ui& ui, const Lab& lab);
PaletteEntry preset_entry(const Preset& preset, const std::filesystem::path& file, bool shipped);
/// Indices of the entries that hold every word typed, those whose title begins with it first.
std::vector<int> matching(std::span<const PaletteEntry> entries, std::string_view typed);

// A few cards that introduce the sandbox: once at the first start, and again from the help.

void start_tour(Ui& ui);
/// Draws the present card, beside what it tells of.
void tour_card(Ui& ui);

// Run, step, restart and the speed: in the top bar and, large, in presentation mode.

struct Ui;

/// The three buttons from there on, each `side` wide (at scale 1). Returns their lower right corner.
ImVec2 transport_buttons(Ui& ui, ImVec2 at, float side = 32);
/// What they take, px.
ImVec2 transport_size(const Ui& ui, float side = 32);

/// The speeds to choose from, in one row or, where that is wider than `width` (px), in more.
void speed_control(Ui& ui, ImVec2 at, float width);
ImVec2 speed_control_size(const Ui& ui, float width);
/// What those that are always offered take in one row, px.
ImVec2 offered_speeds_size(const Ui& ui);
/// The same choice as a list that shows the present speed, where the speeds have no room beside each other.
void speed_list(Ui& ui, ImVec2 at);
/// Its size, px; `offered`: with one of the speeds that are always offered, whatever the present one is.
ImVec2 speed_list_size(const Ui& ui, bool offered = false);

/// Simulated time to real time, over the last half second, "98 %", and the color to say it in.
struct RealTime {
  std::string text;
  ImU32 color;
  bool known = true;  ///< false: time stands still, or is meant to be slow, and the text is a dash
};
RealTime real_time(const Ui& ui);
inline constexpr const char* real_time_tip =
    "Simulated time to real time, over the last half second. Amber: the machine does not reach the requested speed.";

}  // namespace tyglab
