// Colors, sizes and line styles as tokens. All panels use them, so another theme is one more table of tokens.
#pragma once

#include <imgui.h>

#include <span>
#include <string_view>

#include <cmath>

namespace tyglab {

/// A color from its hexadecimal digits, red first.
constexpr ImU32 rgb(unsigned hex) {
  return IM_COL32(hex >> 16 & 255, hex >> 8 & 255, hex & 255, 255);
}

/// Colors by what they mean. Data colors are Okabe and Ito's, safe for the color-blind.
struct Tokens {
  ImU32 ground, panel, field, field_hover, line, text, quiet, accent, on_accent;
  ImU32 danger, warning, good;
  ImU32 blue, green, magenta, yellow, vermilion, orange, sky;
  bool light;  ///< dark curves on a light ground
};
Tokens dark_tokens();
/// With data colors of their own that read on white.
Tokens light_tokens();

/// A look of the whole window.
struct Look {
  std::string_view name;  ///< in the settings
  Tokens (*tokens)();
  float magnified;  ///< of text, lengths and lines: for who sits far away
};
/// Dark, light, projector: the first is the one that a new user gets.
std::span<const Look> looks();
/// The look of that name; the first where none is called so.
const Look& look(std::string_view name);

/// Tokens and sizes at the present scale of text (monitor's content scale times the user's).
struct Theme {
  Tokens colors = dark_tokens();
  float scale = 1;
  float display = 1;      ///< the monitor's content scale alone
  float axis_text = 0;    ///< least size of numbers at the axes of plots, px
  float least_scale = 0;  ///< of text in presentation mode, by the size of the window
  /// Whole pixels for a length given at scale 1; the rhythm of the layout is 8.
  float px(float length) const { return std::round(length * scale); }
};

/// Sets Dear ImGui's style from the tokens.
void apply_style(const Theme& theme);

/// The color with its opacity multiplied.
ImU32 faded(ImU32 color, float opacity);
/// Between two colors, t from 0 to 1.
ImU32 mixed(ImU32 a, ImU32 b, float t);

enum class LineStyle { solid, dashed, dotted, dash_dot, dash_dot_dot, long_dash, sparse_dots };

/// How a quantity is drawn wherever it appears: curve, legend, read-out, arrow.
struct CurveStyle {
  ImU32 color;
  LineStyle line;
  float width;  ///< at scale 1
};

/// A polyline in that style; `phase` carries the dash pattern on from one call to the next.
void draw_styled_line(ImDrawList& draw, const ImVec2* points, int count, const CurveStyle& style, float scale,
                      float* phase = nullptr);

}  // namespace tyglab
