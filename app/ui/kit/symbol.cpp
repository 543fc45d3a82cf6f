#include "app/ui/kit/widgets.h"

#include <algorithm>
#include <cmath>

#include "app/base/text.h"

namespace tyglab {
namespace {

/// How far a subscript sinks below the baseline, as a part of the symbol's size.
constexpr float sink = 0.16f;

float dot_radius(const Fonts& fonts) {
  return std::max(1.f, fonts.symbol->FontSize * 0.055f);
}

}  // namespace

SymbolParts parse_symbol(std::string_view symbol) {
  SymbolParts parts;
  const std::size_t underscore = symbol.find('_');
  parts.base = symbol.substr(0, underscore);
  if (underscore != std::string_view::npos) parts.subscript = symbol.substr(underscore + 1);
  while (!parts.base.empty() && parts.base.back() == '\'') parts.base.remove_suffix(1), ++parts.dots;
  return parts;
}

float text_width(const ImFont& font, std::string_view text) {
  return font.CalcTextSizeA(font.FontSize, 1e9f, 0, text.data(), text.data() + text.size()).x;
}

void draw_text(ImDrawList& draw, const ImFont& font, ImVec2 at, ImU32 color, std::string_view text) {
  draw.AddText(&font, font.FontSize, at, color, text.data(), text.data() + text.size());
}

void draw_on_baseline(ImDrawList& draw, const ImFont& font, ImVec2 at, ImU32 color, std::string_view text) {
  draw_text(draw, font, {std::round(at.x), std::round(at.y - font.Ascent)}, color, text);
}

float baseline_at(const Fonts& fonts, float middle) {
  return std::round(middle + fonts.text->FontSize * 0.36f);
}

float symbol_width(const Fonts& fonts, std::string_view symbol) {
  const SymbolParts parts = parse_symbol(symbol);
  return text_width(*fonts.symbol, parts.base) +
         (parts.subscript.empty() ? 0 : text_width(*fonts.subscript, parts.subscript));
}

void draw_symbol(ImDrawList& draw, const Fonts& fonts, ImVec2 at, std::string_view symbol, ImU32 color) {
  const SymbolParts parts = parse_symbol(symbol);
  const float width = text_width(*fonts.symbol, parts.base);
  draw_on_baseline(draw, *fonts.symbol, at, color, parts.base);
  if (!parts.subscript.empty()) {
    draw_on_baseline(draw, *fonts.subscript, {at.x + width, at.y + fonts.symbol->FontSize * sink}, color,
                     parts.subscript);
  }
  // The letters that take dots (x) are low: the dots stand a little above the x-height, shifted with the slant.
  const float radius = dot_radius(fonts), height = at.y - fonts.symbol->FontSize * 0.52f;
  const float middle = at.x + width * 0.62f, apart = radius * 3.4f;
  for (int k = 0; k < parts.dots; ++k)
    draw.AddCircleFilled({middle + (float(k) - float(parts.dots - 1) / 2) * apart, height}, radius, color, 12);
}

std::string fitted(const ImFont& font, const std::string& text, float width) {
  return shortened(text, width, [&font](std::string_view piece) { return text_width(font, piece); });
}

std::string in_lines(const ImFont& font, std::string_view text, float width) {
  return broken_into_lines(text, width, [&font](std::string_view piece) { return text_width(font, piece); });
}

}  // namespace tyglab
