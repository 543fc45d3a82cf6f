#include "app/ui/kit/widgets.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <variant>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double zero_stretch = 0.04;      ///< of a logarithmic slider that starts at 0
constexpr double double_click_time = 0.6;  ///< s
constexpr double decades_below = 1e3;      ///< its smallest value but 0 is max over this, at first

bool has_zero(const SliderScale& s) {
  return s.scale == Scale::logarithmic && s.min <= 0;
}
double lowest(const SliderScale& s) {
  return !has_zero(s) ? s.min : s.low > 0 ? s.low : s.max / decades_below;
}

/// Places are given to the digits that a pixel can tell apart, never to seventeen.
double tidy(const SliderScale& s, double value, int digits) {
  if (s.integer) return std::round(value);
  if (s.scale == Scale::logarithmic) return rounded(value, digits);
  const double step = std::pow(10, std::floor(std::log10((s.max - s.min) / 100)) - (digits - 3));
  return rounded(std::round(value / step) * step, 12);
}

struct KeyStep {
  double by;
  int digits;
};

KeyStep key_step(int mods) {
  if ((mods & GLFW_MOD_CONTROL) != 0) return {0.001, 5};
  return {(mods & GLFW_MOD_SHIFT) != 0 ? 0.1 : 0.01, 3};
}

double stepped(const SliderScale& s, double value, double direction, int mods) {
  if (s.integer) return std::clamp(value + direction * ((mods & GLFW_MOD_SHIFT) != 0 ? 10 : 1), s.min, s.max);
  const KeyStep step = key_step(mods);
  return slider_value(s, slider_position(s, value) + direction * step.by, step.digits);
}

void start_typing(UiContext& ui, unsigned id, double value) {
  SliderState& state = ui.slider;
  state.typing = id;
  state.typing_since = ui.now;
  state.typing_starts = true;
  state.commit = state.cancel = false;
  state.refused.clear();
  std::snprintf(state.text, sizeof state.text, "%.10g", value);
}

/// Whether the last item, a number, was pressed so that it can be typed; by a finger once it is lifted (`tapped`).
bool wants_typing(const UiContext& ui, bool tapped) {
  return (ui.input.by_touch && tapped) || (ImGui::IsItemActive() && ui.input.double_click) ||
         (ImGui::IsItemActivated() && ImGui::GetIO().KeyCtrl);
}

/// Keys of the focused slider, as one result.
SliderResult take_keys(UiContext& ui, const SliderScale& scale, double value) {
  SliderState& state = ui.slider;
  SliderResult result{.value = value};
  const auto go = [&](double to) { result.changed = to != value, result.value = to; };
  for (const KeyEvent& key : state.keys) {
    switch (key.key) {
      case GLFW_KEY_LEFT:
        go(stepped(scale, result.value, -1, key.mods));
        break;
      case GLFW_KEY_RIGHT:
        go(stepped(scale, result.value, 1, key.mods));
        break;
      case GLFW_KEY_PAGE_DOWN:
        go(stepped(scale, result.value, -1, GLFW_MOD_SHIFT));
        break;
      case GLFW_KEY_PAGE_UP:
        go(stepped(scale, result.value, 1, GLFW_MOD_SHIFT));
        break;
      case GLFW_KEY_HOME:
        go(scale.min);
        break;
      case GLFW_KEY_END:
        go(scale.max);
        break;
      case GLFW_KEY_DELETE:
        result.reset = true;
        break;
      case GLFW_KEY_ENTER:
      case GLFW_KEY_KP_ENTER:
        start_typing(ui, ImGui::GetID("value"), value);
        break;
      case GLFW_KEY_ESCAPE:
        state.focused = 0;
        break;
      case GLFW_KEY_UP:
        state.wanted_order = state.focused_order - 1;
        break;
      case GLFW_KEY_DOWN:
        state.wanted_order = state.focused_order + 1;
        break;
      case GLFW_KEY_TAB:
        state.wanted_order = state.focused_order + ((key.mods & GLFW_MOD_SHIFT) != 0 ? -1 : 1);
        break;
      default:
        break;
    }
  }
  state.keys.clear();
  result.finished = result.changed;
  return result;
}

/// Focus goes from slider to slider in the order in which they are drawn.
bool follow_focus(SliderState& state, unsigned id) {
  const int order = state.order++;
  if (state.wanted_order == order) {
    state.focused = id;
    state.wanted_order = -1;
    ImGui::SetScrollHereY(0.5f);
  }
  if (state.focused != id) return false;
  state.focused_order = order;
  return state.focused_seen = true;
}

/// The drag of a slider or of a cell; `width` pixels are the whole scale.
SliderResult take_drag(UiContext& ui, const SliderScale& scale, double value, unsigned id, float width, bool jump,
                       float left) {
  SliderState& state = ui.slider;
  SliderResult result{.value = value};
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated()) {
    state.focused = id;
    state.dragged = id;
    state.value = value;
    state.position = slider_position(scale, value);
    state.reset_done = ui.now - state.reset_time < double_click_time;
    const double under = (io.MousePos.x - left) / width;
    if (jump && !state.reset_done && !ui.input.double_click &&
        std::abs(under - state.position) * width > ui.theme.px(6))
      state.position = under;
  } else if (ImGui::IsItemActive() && state.dragged == id) {
    state.position += io.MouseDelta.x / width * (io.KeyShift ? 0.1 : 1);
  }
  if (jump && ImGui::IsItemActive() && ui.input.double_click) {
    result.reset = state.reset_done = true;
    state.reset_time = ui.now;
  }
  if (ImGui::IsItemActive() && state.dragged == id && !state.reset_done) {
    const double to = slider_value(scale, state.position, io.KeyShift ? 4 : 3);
    // A value outside the slider stays until the pointer truly moves it.
    const bool moved = std::abs(state.position - slider_position(scale, value)) * width > 0.5;
    if (moved && to != state.value) result.changed = true, state.value = to;
    result.value = state.value;
  }
  if (ImGui::IsItemDeactivated() && state.dragged == id) {
    result.finished = !state.reset_done;
    result.value = state.value;
    state.dragged = 0;
  }
  return result;
}

void draw_track(UiContext& ui, const SliderScale& scale, double value, ImVec2 lo, ImVec2 hi, bool hovered,
                bool focused) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float round = ui.theme.px(4), middle = (lo.y + hi.y) / 2, half = ui.theme.px(8);
  const ImVec2 a{lo.x, middle - half}, b{hi.x, middle + half};
  draw.AddRectFilled(a, b, hovered ? c.field_hover : c.field, round);
  const double t = slider_position(scale, value);
  const float x = std::round(lo.x + float(t) * (hi.x - lo.x));
  if (x > lo.x + 1) draw.AddRectFilled(a, {x, b.y}, mixed(c.field, c.accent, hovered ? 0.42f : 0.34f), round);
  if (focused)
    draw.AddRect({a.x - 2, a.y - 2}, {b.x + 2, b.y + 2}, c.accent, round + 2, 0, std::max(1.f, ui.theme.px(1.5f)));
  const float thick = ui.theme.px(2), tall = ui.theme.px(10);
  const float at = std::max(std::min(x, hi.x - thick), lo.x + thick);
  draw.AddRectFilled({at - thick, middle - tall}, {at + thick, middle + tall}, c.text, ui.theme.px(2));
  // The value lies beyond the slider's own range: an arrow at the end says so.
  const float r = ui.theme.px(4);
  if (value > scale.max * (1 + 1e-9))
    draw.AddTriangleFilled({hi.x - 3 * r, middle - r}, {hi.x - 3 * r, middle + r}, {hi.x - 2 * r, middle}, c.text);
  if (value < lowest(scale) * (1 - 1e-9) && value != 0 && value < scale.max)
    draw.AddTriangleFilled({lo.x + 3 * r, middle - r}, {lo.x + 3 * r, middle + r}, {lo.x + 2 * r, middle}, c.text);
}

/// The text field of a value. Sets `result` when the typing ends.
void type_value(UiContext& ui, double value, float width, float height, std::string_view name, std::string_view unit,
                SliderResult& result) {
  SliderState& state = ui.slider;
  if (state.typing_starts) ImGui::SetKeyboardFocusHere();
  ImGui::PushFont(ui.fonts.mono);
  const float above = std::floor((height - ui.fonts.mono->FontSize) / 2);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(4), above));
  ImGui::SetNextItemWidth(width);
  ImGui::InputText("##typed", state.text, sizeof state.text, ImGuiInputTextFlags_AutoSelectAll);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  if (ImGui::IsItemActive()) state.typing_starts = false;
  // Who taps twice wants to type, and not to place the cursor.
  const bool again = ui.input.by_touch && ui.now - state.typing_since < double_click_time;
  if (again && ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) gui::select_all_text();
  // Enter counts once the text field has been shown all that was typed before it.
  const bool ended = (state.commit || state.cancel) && !ui.input.unread;
  // Only the left button ends Dear ImGui's own typing; a finger on the cloth presses another one.
  bool elsewhere = false;
  const bool on_it = ImGui::IsMouseHoveringRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  if (ui.input.by_touch && !on_it && ImGui::IsItemActive())
    for (int button = 0; button < ImGuiMouseButton_COUNT; ++button) elsewhere |= ImGui::IsMouseClicked(button);
  const bool over = ended || elsewhere || (!state.typing_starts && !ImGui::IsItemActive());
  if (!over) return;
  const unsigned field = std::exchange(state.typing, 0);
  // Who leaves what was refused gives it up.
  if (state.cancel || (!state.commit && state.refused == state.text)) return;
  if (const auto typed = typed_number(state.text, unit)) {
    ui.accept_number();
    result.changed = result.finished = *typed != value;
    result.value = *typed;
    if (state.commit) result.typed = field;
  } else {
    if (state.commit) type_again(state, field);
    const bool beyond = std::isinf(std::strtod(state.text, nullptr));  // "1e999"
    ui.refuse_number(std::string("“") + state.text + "” is " + (beyond ? "out of range" : "not a number") + "; " +
                     std::string(name) + " stays at " + quantity(value, unit) + ".");
  }
}

}  // namespace

void type_again(SliderState& state, unsigned field) {
  state.typing = field;
  state.typing_starts = true;
  state.commit = state.cancel = false;
  state.refused = state.text;
}

SliderScale slider_scale(const PresetRow& row, double preset_value) {
  const SliderRange range = slider_range(row, preset_value);
  SliderScale scale{range.min, range.max, row.scale, std::holds_alternative<int Preset::*>(row.field)};
  if (has_zero(scale)) scale.low = lowest(scale);
  return scale;
}

SliderScale grown(SliderScale s, const PresetRow& row, double value) {
  if (!(value >= row.min && value <= row.max)) return s;
  if (s.scale == Scale::linear) {
    while (value > s.max) s.max = std::min(s.max + (s.max - s.min), row.max);
    while (value < s.min) s.min = std::max(s.min - (s.max - s.min), row.min);
    return s;
  }
  constexpr double decade = 10;
  while (value > s.max) s.max = std::min(decade * s.max, row.max);
  if (value <= 0) return s;
  double low = lowest(s);
  while (value < low) low = std::max(low / decade, has_zero(s) ? 0.0 : row.min);
  (has_zero(s) ? s.low : s.min) = low;
  return s;
}

double slider_position(const SliderScale& s, double value) {
  if (s.max <= s.min) return 0;
  if (s.scale == Scale::linear) return std::clamp((value - s.min) / (s.max - s.min), 0.0, 1.0);
  const double low = lowest(s);
  if (value <= 0) return 0;
  const double t = std::clamp(std::log(value / low) / std::log(s.max / low), 0.0, 1.0);
  return has_zero(s) ? zero_stretch + (1 - zero_stretch) * t : t;
}

double slider_value(const SliderScale& s, double position, int digits) {
  position = std::clamp(position, 0.0, 1.0);
  if (position == 0) return s.min;
  if (position == 1) return s.max;
  if (s.scale == Scale::linear) return std::clamp(tidy(s, s.min + (s.max - s.min) * position, digits), s.min, s.max);
  const double low = lowest(s);
  if (has_zero(s)) {
    if (position < zero_stretch) return 0;
    position = (position - zero_stretch) / (1 - zero_stretch);
  }
  return std::clamp(tidy(s, low * std::pow(s.max / low, position), digits), low, s.max);
}

SliderResult slider(UiContext& ui, const SliderScale& scale, double value, float width, float height) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  gui::press_area("slider", {width, height});
  const unsigned id = gui::item_id();
  const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
  SliderResult result = take_drag(ui, scale, value, id, width, true, lo.x);
  const bool focused = follow_focus(ui.slider, id);
  if (focused && !ui.slider.keys.empty()) result = take_keys(ui, scale, value);
  const bool dragging = ImGui::IsItemActive() && ui.slider.dragged == id;
  draw_track(ui, scale, dragging ? ui.slider.value : value, lo, {lo.x + width, lo.y + height}, hovered, focused);
  return result;
}

SliderResult drag_cell(UiContext& ui, const char* id_text, const SliderScale& scale, double value, float width,
                       float height, std::string_view name, std::string_view unit) {
  ImGui::PushID(id_text);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  SliderResult result{.value = value};
  const unsigned typing_id = ImGui::GetID("value");
  if (ui.slider.typing == typing_id) {
    type_value(ui, value, width, height, name, unit, result);
    ImGui::PopID();
    return result;
  }
  const bool pressed = gui::press_area("cell", {width, height});
  const unsigned id = gui::item_id();
  const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const bool still = std::sqrt(ImGui::GetIO().MouseDragMaxDistanceSqr[0]) < ui.theme.px(10);
  if (wants_typing(ui, pressed && still)) {
    ui.slider.dragged = 0;
    start_typing(ui, typing_id, value);
  } else {
    result = take_drag(ui, scale, value, id, ui.theme.px(300), false, lo.x);
  }
  const bool focused = follow_focus(ui.slider, id);
  if (focused && !ui.slider.keys.empty()) result = take_keys(ui, scale, value);
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float inset = std::round((height - ui.theme.px(20)) / 2);
  const ImVec2 a{lo.x, lo.y + inset}, b{lo.x + width, lo.y + height - inset};
  draw.AddRectFilled(a, b, hovered ? c.field_hover : c.field, ui.theme.px(4));
  if (focused) draw.AddRect(a, b, c.accent, ui.theme.px(4));
  const bool dragging = ImGui::IsItemActive() && ui.slider.dragged == id;
  const std::string text = short_number(dragging ? ui.slider.value : value);
  const ImFont& font = *ui.fonts.mono;
  draw.PushClipRect(a, b, true);
  const float x = std::max(a.x + 2, b.x - ui.theme.px(5) - text_width(font, text));
  draw_on_baseline(draw, font, {x, baseline_at(ui.fonts, lo.y + height / 2)}, c.text, text);
  draw.PopClipRect();
  ImGui::PopID();
  return result;
}

SliderResult value_cell(UiContext& ui, const char* id_text, double value, std::string_view shown, float width,
                        float height, std::string_view name, std::string_view unit) {
  SliderState& state = ui.slider;
  SliderResult result{.value = value};
  const unsigned id = ImGui::GetID(id_text);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  if (state.typing == id) {
    type_value(ui, value, width, height, name, unit, result);
    return result;
  }
  const bool pressed = gui::press_area(id_text, {width, height});
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
  if (wants_typing(ui, pressed)) start_typing(ui, id, value);
  const ImFont& font = *ui.fonts.mono;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float inset = ui.theme.px(2);
  if (hovered)
    draw.AddRectFilled({lo.x, lo.y + inset}, {lo.x + width, lo.y + height - inset}, ui.theme.colors.field,
                       ui.theme.px(4));
  draw_on_baseline(draw, font,
                   {lo.x + width - ui.theme.px(4) - text_width(font, shown), baseline_at(ui.fonts, lo.y + height / 2)},
                   ui.theme.colors.text, shown);
  return result;
}

}  // namespace tyglab
