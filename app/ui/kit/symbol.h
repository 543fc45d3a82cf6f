// Symbols of the report, typeset: italic, with real subscripts, and with drawn dots for time derivatives.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "app/ui/kit/fonts.h"

namespace tyglab {

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

}  // namespace tyglab
