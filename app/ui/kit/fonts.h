// Fonts, all from Debian: Inter for text, STIX Italic for symbols, JetBrains Mono for numbers, Fork Awesome for icons.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace tyglab {

inline constexpr float small_text_at_1 = 12;  ///< the smallest font's size, px at scale 1

struct Fonts {
  ImFont* text = nullptr;          ///< 14 at scale 1, with icons
  ImFont* small = nullptr;         ///< 12, quiet labels and section heads
  ImFont* title = nullptr;         ///< 14, semibold, with icons
  ImFont* brand = nullptr;         ///< 17, semibold
  ImFont* large_icons = nullptr;   ///< 18, icons alone
  ImFont* symbol = nullptr;        ///< 19, italic
  ImFont* subscript = nullptr;     ///< 13, italic
  ImFont* mono = nullptr;          ///< 13
  ImFont* axis = nullptr;          ///< numbers at the axes of plots: small, or larger for an audience
  bool icons = false;              ///< whether the icon font was found
  std::vector<std::string> notes;  ///< what was missing, and what stands in for it
};

/// Fills Dear ImGui's atlas again at exact sizes; the atlas' texture must be made again afterwards. Missing fonts fall
/// back to DejaVu, then to Dear ImGui's own.
/// `axis`: the least size of numbers at axes, px.
Fonts build_fonts(float scale, float axis = 0);

/// Icons of Fork Awesome by their meaning.
namespace icon {
inline constexpr const char* play = "\xEF\x81\x8B";
inline constexpr const char* pause = "\xEF\x81\x8C";
inline constexpr const char* step = "\xEF\x81\x91";
inline constexpr const char* restart = "\xEF\x81\x89";
inline constexpr const char* undo = "\xEF\x83\xA2";
inline constexpr const char* redo = "\xEF\x80\x9E";
inline constexpr const char* scissors = "\xEF\x83\x84";
inline constexpr const char* expand = "\xEF\x81\xA5";
inline constexpr const char* compress = "\xEF\x81\xA6";
inline constexpr const char* help = "\xEF\x81\x99";
inline constexpr const char* open = "\xEF\x81\xBC";
inline constexpr const char* save = "\xEF\x83\x87";
inline constexpr const char* download = "\xEF\x80\x99";
inline constexpr const char* warning = "\xEF\x81\xB1";
inline constexpr const char* error = "\xEF\x81\x97";
inline constexpr const char* info = "\xEF\x81\x9A";
inline constexpr const char* down = "\xEF\x84\x87";
inline constexpr const char* left = "\xEF\x84\x84";
inline constexpr const char* right = "\xEF\x84\x85";
inline constexpr const char* plus = "\xEF\x81\xA7";
inline constexpr const char* trash = "\xEF\x87\xB8";
inline constexpr const char* close = "\xEF\x80\x8D";
inline constexpr const char* hand = "\xEF\x89\x95";
inline constexpr const char* move = "\xEF\x82\xB2";
inline constexpr const char* labs = "\xEF\x86\x9D";   // a student's cap
inline constexpr const char* check = "\xEF\x80\x8C";  // a tick
inline constexpr const char* picture = "\xEF\x80\xBE";
inline constexpr const char* circle = "\xEF\x84\x8C";
inline constexpr const char* screen = "\xEF\x84\x88";  // a display
inline constexpr const char* unknown = "\xEF\x84\xA8";
/// Every icon above: only these are drawn into the atlas.
inline constexpr const char* all[] = {play,     pause, step,    restart, undo,     redo,    scissors, expand,
                                      compress, help,  open,    save,    download, warning, error,    info,
                                      down,     left,  right,   plus,    trash,    close,   hand,     move,
                                      labs,     check, picture, circle,  screen,   unknown};
}  // namespace icon

/// The icon, or the word where the icon font is missing.
inline const char* icon_or(const Fonts& fonts, const char* glyph, const char* word) {
  return fonts.icons ? glyph : word;
}

}  // namespace tyglab
