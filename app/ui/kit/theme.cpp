#include "app/ui/kit/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tyglab {
namespace {

ImVec4 vec(ImU32 color, float opacity = 1) {
  return ImGui::ColorConvertU32ToFloat4(faded(color, opacity));
}

/// Lengths of ink and gap in turn, at scale 1.
std::span<const float> pattern(LineStyle style) {
  static constexpr std::array<float, 2> dashed{8, 4}, dotted{2, 3}, long_dash{14, 5}, sparse{2, 7};
  static constexpr std::array<float, 4> dash_dot{8, 3, 2, 3};
  static constexpr std::array<float, 6> dash_dot_dot{8, 3, 2, 3, 2, 3};
  switch (style) {
    case LineStyle::dashed:
      return dashed;
    case LineStyle::dotted:
      return dotted;
    case LineStyle::dash_dot:
      return dash_dot;
    case LineStyle::dash_dot_dot:
      return dash_dot_dot;
    case LineStyle::long_dash:
      return long_dash;
    case LineStyle::sparse_dots:
      return sparse;
    case LineStyle::solid:
      break;
  }
  return {};
}

/// Walks along the line and draws the inked parts of the pattern.
class Dasher {
 public:
  Dasher(ImDrawList& draw, const CurveStyle& style, float scale, float phase)
      : draw_(draw), lengths_(pattern(style.line)), color_(style.color), width_(style.width * scale), scale_(scale) {
    for (float length : lengths_) period_ += length * scale_;
    phase = std::fmod(phase, period_);
    while (phase >= lengths_[index_] * scale_) phase -= lengths_[index_] * scale_, advance();
    left_ = lengths_[index_] * scale_ - phase;
  }
  void segment(ImVec2 a, ImVec2 b) {
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0) || length > 1e5f) return;
    float at = 0;
    while (at < length) {
      const float end = std::min(length, at + left_);
      if (index_ % 2 == 0) draw_.AddLine(between(a, b, at / length), between(a, b, end / length), color_, width_);
      left_ -= end - at;
      at = end;
      if (left_ <= 1e-3f) advance(), left_ = lengths_[index_] * scale_;
    }
    walked_ += length;
  }
  float walked() const { return walked_; }

 private:
  static ImVec2 between(ImVec2 a, ImVec2 b, float t) { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }
  void advance() { index_ = (index_ + 1) % lengths_.size(); }

  ImDrawList& draw_;
  std::span<const float> lengths_;
  ImU32 color_;
  float width_, scale_;
  std::size_t index_ = 0;
  float period_ = 0, left_ = 0, walked_ = 0;
};

void set_colors(ImGuiStyle& style, const Tokens& c) {
  ImVec4* colors = style.Colors;
  colors[ImGuiCol_Text] = vec(c.text);
  colors[ImGuiCol_TextDisabled] = vec(c.quiet);
  colors[ImGuiCol_WindowBg] = vec(c.panel);
  colors[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
  colors[ImGuiCol_PopupBg] = vec(c.panel);
  colors[ImGuiCol_Border] = vec(c.line);
  colors[ImGuiCol_FrameBg] = colors[ImGuiCol_Button] = vec(c.field);
  colors[ImGuiCol_FrameBgHovered] = colors[ImGuiCol_ButtonHovered] = vec(c.field_hover);
  colors[ImGuiCol_FrameBgActive] = colors[ImGuiCol_ButtonActive] = vec(c.line);
  colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = vec(c.panel);
  colors[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
  colors[ImGuiCol_ScrollbarGrab] = vec(c.line);
  colors[ImGuiCol_ScrollbarGrabHovered] = colors[ImGuiCol_ScrollbarGrabActive] = vec(c.quiet);
  colors[ImGuiCol_CheckMark] = vec(c.accent);
  colors[ImGuiCol_Header] = vec(c.field);
  colors[ImGuiCol_HeaderHovered] = vec(c.field_hover);
  colors[ImGuiCol_HeaderActive] = vec(c.line);
  colors[ImGuiCol_Separator] = vec(c.line);
  colors[ImGuiCol_TextSelectedBg] = vec(c.accent, 0.35f);
  colors[ImGuiCol_ModalWindowDimBg] = vec(c.ground, 0.6f);
  colors[ImGuiCol_NavHighlight] = vec(c.accent);
}

}  // namespace

Tokens dark_tokens() {
  return {.ground = rgb(0x14161B),
          .panel = rgb(0x1C1F26),
          .field = rgb(0x262A33),
          .field_hover = rgb(0x2E333E),
          .line = rgb(0x333843),
          .text = rgb(0xE6E8EC),
          .quiet = rgb(0x98A0AD),
          .accent = rgb(0x56B4E9),
          .on_accent = rgb(0x14161B),
          .danger = rgb(0xD55E00),
          .warning = rgb(0xE69F00),
          .good = rgb(0x009E73),
          .blue = rgb(0x4A90D9),
          .green = rgb(0x009E73),
          .magenta = rgb(0xCC79A7),
          .yellow = rgb(0xF0E442),
          .vermilion = rgb(0xD55E00),
          .orange = rgb(0xE69F00),
          .sky = rgb(0x56B4E9),
          .light = false};
}

Tokens light_tokens() {
  return {.ground = rgb(0xEEF1F5),
          .panel = rgb(0xFFFFFF),
          .field = rgb(0xE3E7ED),
          .field_hover = rgb(0xD6DCE5),
          .line = rgb(0xC4CBD6),
          .text = rgb(0x14161B),
          .quiet = rgb(0x525C6B),
          .accent = rgb(0x00649F),
          .on_accent = rgb(0xFFFFFF),
          .danger = rgb(0x8E1B00),
          .warning = rgb(0x986C00),
          .good = rgb(0x00704F),
          .blue = rgb(0x1F5FA8),
          .green = rgb(0x00704F),
          .magenta = rgb(0xA03A72),
          .yellow = rgb(0x7A6A00),
          .vermilion = rgb(0xB84300),
          .orange = rgb(0xA05F00),
          .sky = rgb(0x0B78B5),
          .light = true};
}

std::span<const Look> looks() {
  static constexpr std::array<Look, 3> all{
      {{"dark", dark_tokens, 1}, {"light", light_tokens, 1}, {"projector", light_tokens, 1.4f}}};
  return all;
}

const Look& look(std::string_view name) {
  const auto all = looks();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Look& one) { return one.name == name; });
  return found == all.end() ? all.front() : *found;
}

void apply_style(const Theme& theme) {
  ImGuiStyle style;
  set_colors(style, theme.colors);
  style.WindowPadding = {16, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 8};
  style.ItemInnerSpacing = {6, 4};
  style.ScrollbarSize = 10;
  style.WindowRounding = 0;
  style.ChildRounding = 6;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 5;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowMinSize = {16, 16};
  style.DisplaySafeAreaPadding = {4, 4};
  style.ScaleAllSizes(theme.scale);
  ImGui::GetStyle() = style;
}

ImU32 faded(ImU32 color, float opacity) {
  const ImU32 alpha = ImU32(std::clamp(float(color >> 24) * opacity, 0.f, 255.f));
  return (color & 0x00FFFFFFu) | alpha << 24;
}

ImU32 mixed(ImU32 a, ImU32 b, float t) {
  ImU32 out = 0;
  for (int shift = 0; shift < 32; shift += 8) {
    const float from = float(a >> shift & 255), to = float(b >> shift & 255);
    out |= ImU32(from + (to - from) * t + 0.5f) << shift;
  }
  return out;
}

namespace {

/// By more than 60 degrees.
bool turns_sharply(ImVec2 a, ImVec2 b, ImVec2 c) {
  const ImVec2 in(b.x - a.x, b.y - a.y), out(c.x - b.x, c.y - b.y);
  return in.x * out.x + in.y * out.y < 0.5f * std::hypot(in.x, in.y) * std::hypot(out.x, out.y);
}

}  // namespace

void draw_styled_line(ImDrawList& draw, const ImVec2* points, int count, const CurveStyle& style, float scale,
                      float* phase) {
  if (count < 2) return;
  if (style.line == LineStyle::solid) {
    // Dear ImGui draws a polyline thinner where it turns sharply, down to nothing, so it is drawn in pieces between
    // such turns.
    int begin = 0;
    for (int k = 1; k < count; ++k) {
      const bool last = k + 1 == count;
      if (!last && !turns_sharply(points[k - 1], points[k], points[k + 1])) continue;
      draw.AddPolyline(points + begin, k + 1 - begin, style.color, ImDrawFlags_None, style.width * scale);
      begin = k;
    }
    return;
  }
  Dasher dasher(draw, style, scale, phase != nullptr ? *phase : 0);
  for (int k = 1; k < count; ++k) dasher.segment(points[k - 1], points[k]);
  if (phase != nullptr) *phase += dasher.walked();
}

}  // namespace tyglab
