#include "app/ui/kit/widgets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"

namespace tyglab {
namespace {

constexpr double tooltip_delay = 0.45;  // s

/// A row of icons sits on the line of the text beside it.
void centered_text(UiContext& ui, const ImFont& font, ImVec2 lo, ImVec2 hi, ImU32 color, const char* text) {
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e9f, 0, text);
  draw_text(*ImGui::GetWindowDrawList(), font,
            {std::round((lo.x + hi.x - size.x) / 2), std::round((lo.y + hi.y - size.y) / 2)}, color, text);
  (void)ui;
}

/// Lists of menus and combo boxes have the same rhythm wherever they are opened from; a finger needs higher lines.
bool list_opened(UiContext& ui) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(ui.input.by_touch ? 16 : 8)));
  if (ui.close_lists) ImGui::CloseCurrentPopup();
  return true;
}

constexpr float widest_tooltip = 340, narrowest_tooltip = 120, tooltip_padding_at_1 = 12;  // pixels at scale 1

/// Where the last item's tooltip goes, px.
struct TooltipPlace {
  ImVec2 at;
  float wrap;  ///< where its lines end
};

/// Labels and scales of arrows make room for a tooltip.
bool makes_room(const OverlayLayout::Mark& mark) {
  return mark.name.starts_with("label ") || mark.name.starts_with("scale ");
}

/// A place as near as possible to that height at which a box covers no mark over the cloth.
float clear_of_marks(const UiContext& ui, Box box) {
  const float gap = ui.theme.px(8), first = box.lo.y, height = box.hi.y - box.lo.y;
  const float most = ImGui::GetIO().DisplaySize.y - gap;
  std::vector<float> tops{first};
  for (const auto& mark : ui.placing.marks())
    if (!makes_room(mark)) tops.insert(tops.end(), {mark.box.lo.y - gap - height, mark.box.hi.y + gap});
  std::sort(tops.begin(), tops.end(), [first](float a, float b) { return std::abs(a - first) < std::abs(b - first); });
  for (const float top : tops) {
    const Box there{{box.lo.x, top}, {box.hi.x, top + height}};
    const auto& marks = ui.placing.marks();
    const bool taken =
        std::any_of(marks.begin(), marks.end(), [&](const auto& m) { return !makes_room(m) && overlap(m.box, there); });
    if (!taken && top >= gap && top + height <= most) return top;
  }
  return first;
}

/// So that what it explains stays in sight: beside the panel or list of which the last item takes up the width, as
/// narrow as it must be for that, else under the item, or above it where there is no room.
TooltipPlace tooltip_place(const UiContext& ui) {
  const ImVec2 window = ImGui::GetIO().DisplaySize, lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  const ImGuiWindow& panel = *ImGui::GetCurrentWindowRead()->RootWindow;
  const float gap = ui.theme.px(8), left = panel.Pos.x, right = left + panel.Size.x;
  const float around = 2 * gap + 2 * ui.theme.px(tooltip_padding_at_1);
  const float room_right = window.x - right - around, room_left = left - around;
  const glm::vec2 size = ui.tooltip_size;
  const bool row = hi.x - lo.x > 0.4f * panel.Size.x;
  const auto inside = [gap](float x, float most) { return std::max(std::min(x, most - gap), std::min(gap, x)); };
  float wrap = std::min(ui.theme.px(widest_tooltip), window.x - ui.theme.px(48));
  if (row && std::max(room_right, room_left) >= ui.theme.px(narrowest_tooltip)) {
    const bool at_right = room_right >= std::min(wrap, room_left);
    wrap = std::min(wrap, at_right ? room_right : room_left);
    const float x = at_right ? right + gap : left - gap - size.x, y = inside(lo.y, window.y - size.y);
    return {{x, clear_of_marks(ui, {{x, y}, {x + size.x, y + size.y}})}, wrap};
  }
  const float x = inside(lo.x, window.x - size.x);
  const auto free = [&](float y) {
    const Box box{{x, y}, {x + size.x, y + size.y}};
    const auto& marks = ui.placing.marks();
    return y >= 0 && y + size.y <= window.y &&
           std::none_of(marks.begin(), marks.end(), [&](const auto& m) { return overlap(m.box, box); });
  };
  const float below = hi.y + gap / 2, above = lo.y - gap / 2 - size.y;
  if (free(below)) return {{x, below}, wrap};
  if (free(above)) return {{x, above}, wrap};
  return {{x, inside(below + size.y <= window.y ? below : above, window.y - size.y)}, wrap};
}

void open_tooltip(UiContext& ui, float wrap) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(tooltip_padding_at_1), ui.theme.px(10)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(6), ui.theme.px(4)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.theme.px(6));
  ImGui::BeginTooltip();
  // Dear ImGui hides it in the frame in which it measures it.
  if (ImGui::IsWindowAppearing()) ui.draw_by = ui.now;
  ui.tooltip_wrap = wrap;
  ImGui::PushTextWrapPos(wrap);
}

/// Where choices in rows stand, px from the first one's corner.
struct SegmentPlaces {
  struct Segment {
    ImVec2 at;
    float width;
    bool begins_row, ends_row;
  };
  std::vector<Segment> segments;
  float height = 0;  ///< of each
  ImVec2 size{0, 0};
};

/// Where rows begin that hold as many as fit in `width`, but at most `most`.
std::vector<bool> row_beginnings(const std::vector<float>& widths, float width, int most) {
  std::vector<bool> begins(widths.size());
  float x = 0;
  int in_row = 0;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    begins[k] = k == 0 || x + widths[k] > width || in_row == most;
    if (begins[k]) x = 0, in_row = 0;
    x += widths[k] + 1, ++in_row;
  }
  return begins;
}

/// As few rows as there can be, and then as equal in number as there is room for.
std::vector<bool> even_rows(const std::vector<float>& widths, float width) {
  const auto rows = [](const std::vector<bool>& begins) { return std::count(begins.begin(), begins.end(), true); };
  const int count = int(widths.size());
  const std::vector<bool> least = row_beginnings(widths, width, count);
  const int each = int((count + rows(least) - 1) / std::max<std::ptrdiff_t>(rows(least), 1));
  std::vector<bool> even = row_beginnings(widths, width, each);
  return rows(even) == rows(least) ? even : least;
}

SegmentPlaces segment_places(const UiContext& ui, const char* const* labels, int count, float room_at_1, float width) {
  SegmentPlaces places;
  places.height = ui.theme.px(26);
  std::vector<float> widths;
  for (int k = 0; k < count; ++k) widths.push_back(text_width(*ui.fonts.text, labels[k]) + 2 * ui.theme.px(room_at_1));
  const std::vector<bool> row_begins = even_rows(widths, width);
  ImVec2 at{0, 0};
  for (int k = 0; k < count; ++k) {
    const float own = widths[std::size_t(k)];
    const bool begins = row_begins[std::size_t(k)];
    if (begins && k > 0) at = {0, at.y + places.height + ui.theme.px(4)}, places.segments.back().ends_row = true;
    places.segments.push_back({at, own, begins, k + 1 == count});
    places.size = {std::max(places.size.x, at.x + own), at.y + places.height};
    at.x += own + 1;
  }
  return places;
}

}  // namespace

bool tooltip_due(UiContext& ui, ImGuiID id) {
  // A finger asks by resting there; once it is lifted nobody points.
  if (ui.input.by_touch) {
    constexpr float rests = 0.6f;  // s
    const ImGuiIO& io = ImGui::GetIO();
    const bool held = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left);
    if (ui.covered || !held || moved || ui.slider.typing != 0 ||
        !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled | ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
      return false;
    ui.hover_seen = true, ui.hovered = id;
    const float left = rests - io.MouseDownDuration[ImGuiMouseButton_Left];
    if (left > 0) ui.draw_by = std::min(ui.draw_by, ui.now + double(left) + 0.01);
    return left <= 0;
  }
  // What cannot be chosen says why.
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return false;
  if (ui.covered) return false;
  ui.hover_seen = true;
  // Who types looks elsewhere, and what a key has opened is not to be covered.
  if (ui.keys_since_move) return false;
  const bool enabled = ImGui::IsItemHovered();  // a press on what is disabled asks why it is
  if ((enabled && ImGui::IsMouseDown(ImGuiMouseButton_Left)) || ui.slider.typing != 0) {
    ui.hovered = id, ui.hover_used = true;
    return false;
  }
  if (ui.hovered != id) {
    ui.hovered = id;
    ui.hovered_since = ui.now;
    ui.hover_used = false;
  }
  if (ui.hover_used) return false;  // who works with it looks at the cloth
  const double due = ui.hovered_since + tooltip_delay;
  if (ui.now <= due) ui.draw_by = std::min(ui.draw_by, due + 0.01);
  return ui.now > due;
}

void begin_tooltip(UiContext& ui) {
  const TooltipPlace place = tooltip_place(ui);
  ImGui::SetNextWindowPos(place.at);
  open_tooltip(ui, place.wrap);
}

void begin_tooltip_at_pointer(UiContext& ui) {
  open_tooltip(ui, std::min(ui.theme.px(widest_tooltip), ImGui::GetIO().DisplaySize.x - ui.theme.px(48)));
}

void end_tooltip(UiContext& ui) {
  ImGui::PopTextWrapPos();
  ui.tooltip_wrap = 0;
  const glm::vec2 size{ImGui::GetWindowSize().x, ImGui::GetWindowSize().y};
  // It stands where a tooltip of the size before belongs: the next frame places it anew.
  if (std::exchange(ui.tooltip_size, size) != size) ui.draw_by = ui.now;
  const glm::vec2 at{ImGui::GetWindowPos().x, ImGui::GetWindowPos().y};
  ui.tooltip = Box{at, at + ui.tooltip_size};
  ImGui::EndTooltip();
  ImGui::PopStyleVar(3);
}

void wrapped(UiContext& ui, std::string_view text, ImU32 color) {
  // A number and its unit stay on one line.
  if (ui.tooltip_wrap > 0) {
    const std::string lines =
        in_lines(*ImGui::GetFont(), with_whole_terms(std::string(text)), ui.tooltip_wrap - ImGui::GetCursorPosX());
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(lines.c_str());
    return ImGui::PopStyleColor();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

void tooltip(UiContext& ui, ImGuiID id, std::string_view text, std::string_view keys) {
  if (!tooltip_due(ui, id)) return;
  begin_tooltip(ui);
  wrapped(ui, ui.input.by_touch ? for_fingers(text) : std::string(text), ui.theme.colors.text);
  if (!keys.empty() && !ui.input.by_touch) {
    ImGui::PushFont(ui.fonts.small);
    wrapped(ui, keys, ui.theme.colors.quiet);
    ImGui::PopFont();
  }
  end_tooltip(ui);
}

bool icon_button(UiContext& ui, const IconButton& button) {
  const Tokens& c = ui.theme.colors;
  const float side = ui.theme.px(button.side);
  const char* text = icon_or(ui.fonts, button.glyph, button.word);
  const float width = ui.fonts.icons ? side : std::max(side, text_width(*ui.fonts.text, text) + ui.theme.px(12));
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool pressed = gui::press_area(button.id, {width, side});
  report_control(ui, button.id);
  const ImU32 ground = button.lit               ? c.accent
                       : ImGui::IsItemActive()  ? c.line
                       : ImGui::IsItemHovered() ? c.field_hover
                                                : c.field;
  const ImVec2 hi{lo.x + width, lo.y + side};
  ImGui::GetWindowDrawList()->AddRectFilled(lo, hi, ground, ui.theme.px(5));
  centered_text(ui, *ui.fonts.text, lo, hi, button.lit ? c.on_accent : c.text, text);
  tooltip(ui, gui::item_id(), button.tip, button.keys);
  return pressed;
}

bool quiet_button(UiContext& ui, const char* id, const char* glyph, const char* word, std::string_view tip) {
  const Tokens& c = ui.theme.colors;
  const float side = ui.theme.px(22);
  const char* text = icon_or(ui.fonts, glyph, word);
  const float width = ui.fonts.icons ? side : text_width(*ui.fonts.text, text) + ui.theme.px(8);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool pressed = gui::press_area(id, {width, side});
  report_control(ui, id);
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 hi{lo.x + width, lo.y + side};
  if (hovered) ImGui::GetWindowDrawList()->AddRectFilled(lo, hi, c.field_hover, ui.theme.px(4));
  centered_text(ui, *ui.fonts.text, lo, hi, hovered ? c.text : c.quiet, text);
  tooltip(ui, gui::item_id(), tip);
  return pressed;
}

bool text_button(UiContext& ui, const char* label, bool strong, bool enabled, float width) {
  const Tokens& c = ui.theme.colors;
  ImGui::BeginDisabled(!enabled);
  if (strong) {
    ImGui::PushStyleColor(ImGuiCol_Button, c.accent);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, mixed(c.accent, c.text, 0.2f));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, mixed(c.accent, c.ground, 0.2f));
    ImGui::PushStyleColor(ImGuiCol_Text, c.on_accent);
  }
  const bool pressed = ImGui::Button(label, {width, ui.theme.px(30)});
  report_control(ui, label);
  if (strong) ImGui::PopStyleColor(4);
  ImGui::EndDisabled();
  return pressed;
}

int segments(UiContext& ui, const char* id, const char* const* labels, int count, int chosen, float room_at_1,
             float width) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const SegmentPlaces places = segment_places(ui, labels, count, room_at_1, width);
  const float round = ui.theme.px(5);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  int clicked = -1;
  ImGui::PushID(id);
  for (int k = 0; k < count; ++k) {
    const SegmentPlaces::Segment& segment = places.segments[std::size_t(k)];
    const ImVec2 lo{at.x + segment.at.x, at.y + segment.at.y}, hi{lo.x + segment.width, lo.y + places.height};
    ImGui::SetCursorScreenPos(lo);
    ImGui::PushID(k);
    if (gui::press_area("segment", {hi.x - lo.x, hi.y - lo.y})) clicked = k;
    if (ui.controls) report_control(ui, std::string(id) + "." + std::to_string(k + 1));
    const bool on = k == chosen;
    const ImU32 ground = on ? c.accent : ImGui::IsItemHovered() ? c.field_hover : c.field;
    const ImDrawFlags corners = (segment.begins_row ? ImDrawFlags_RoundCornersLeft : 0) |
                                (segment.ends_row ? ImDrawFlags_RoundCornersRight : 0);
    draw.AddRectFilled(lo, hi, ground, round, corners != 0 ? corners : ImDrawFlags_RoundCornersNone);
    centered_text(ui, *ui.fonts.text, lo, hi, on ? c.on_accent : c.text, labels[k]);
    ImGui::PopID();
  }
  ImGui::PopID();
  return clicked;
}

ImVec2 segments_size(const UiContext& ui, const char* const* labels, int count, float room_at_1, float width) {
  return segment_places(ui, labels, count, room_at_1, width).size;
}

namespace {

constexpr float check_box_at_1 = 16, check_gap_at_1 = 8;  // pixels at scale 1

}  // namespace

float check_width(const UiContext& ui, const char* label) {
  return ui.theme.px(check_box_at_1) + ui.theme.px(check_gap_at_1) + text_width(*ui.fonts.text, label);
}

bool check(UiContext& ui, const char* label, bool value) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float box = ui.theme.px(check_box_at_1), height = ui.theme.px(26), gap = ui.theme.px(check_gap_at_1);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool clicked = gui::press_area(label, {check_width(ui, label), height});
  report_control(ui, label);
  const ImVec2 at{lo.x, std::round(lo.y + (height - box) / 2)};
  const ImU32 ground = value ? c.accent : ImGui::IsItemHovered() ? c.line : c.field_hover;
  draw.AddRectFilled(at, {at.x + box, at.y + box}, ground, ui.theme.px(4));
  if (!value) draw.AddRect(at, {at.x + box, at.y + box}, mixed(c.line, c.quiet, 0.6f), ui.theme.px(4));
  if (value) {
    const ImVec2 tick[3] = {{at.x + box * 0.24f, at.y + box * 0.52f},
                            {at.x + box * 0.43f, at.y + box * 0.71f},
                            {at.x + box * 0.77f, at.y + box * 0.30f}};
    draw.AddPolyline(tick, 3, c.on_accent, ImDrawFlags_None, std::max(1.5f, ui.theme.px(2)));
  }
  draw_text(draw, *ui.fonts.text, {at.x + box + gap, std::round(lo.y + (height - ui.fonts.text->FontSize) / 2)}, c.text,
            label);
  return clicked;
}

bool section(UiContext& ui, const char* name, std::string_view note) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  auto& folded = ui.settings.layout.folded;
  const bool open = folded.count(name) == 0;
  ImGui::Dummy({0, ui.theme.px(2)});
  const float height = ui.theme.px(22), width = ui.row_width;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  if (gui::press_area(name, {width, height})) open ? void(folded.insert(name)) : void(folded.erase(name));
  report_control(ui, name);
  const ImU32 color = ImGui::IsItemHovered() ? c.text : c.quiet;
  std::string capitals(name);
  for (char& letter : capitals) letter = char(std::toupper(static_cast<unsigned char>(letter)));
  const ImFont& font = *ui.fonts.small;
  const float top = std::round(lo.y + (height - font.FontSize) / 2), middle = std::round(lo.y + height / 2);
  draw_text(draw, font, {lo.x, top}, color, capitals);
  const float arrow = ui.theme.px(18);
  float from = lo.x + text_width(font, capitals) + ui.theme.px(10);
  if (open && !note.empty()) {
    const std::string shown = fitted(font, std::string(note), lo.x + width - arrow - from);
    draw_text(draw, font, {from, top}, ui.theme.colors.text, shown);
    from += text_width(font, shown) + ui.theme.px(10);
  }
  if (from < lo.x + width - arrow) draw.AddLine({from, middle}, {lo.x + width - arrow, middle}, c.line);
  const float x = lo.x + width - ui.theme.px(7), r = ui.theme.px(3);
  if (open) {
    draw.AddTriangleFilled({x - r, middle - r * 0.6f}, {x + r, middle - r * 0.6f}, {x, middle + r * 0.8f}, color);
  } else {
    draw.AddTriangleFilled({x + r * 0.6f, middle - r}, {x + r * 0.6f, middle + r}, {x - r * 0.8f, middle}, color);
  }
  return open;
}

void end_combo() {
  ImGui::PopStyleVar();
  ImGui::EndCombo();
}

bool begin_menu(UiContext& ui, const char* id, float most_height) {
  ImGui::SetNextWindowSizeConstraints({0, 0}, {1e9f, most_height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(14), ui.theme.px(12)));
  const bool open = ImGui::BeginPopup(id);
  ImGui::PopStyleVar();
  return open && list_opened(ui);
}

void menu_heading(UiContext& ui, std::string_view words) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float top = lo.y + ui.theme.px(4), height = ui.fonts.small->FontSize;
  draw_text(*ImGui::GetWindowDrawList(), *ui.fonts.small, {lo.x, top}, c.quiet, words);
  ImGui::Dummy({text_width(*ui.fonts.small, words), top - lo.y + height});
}

void end_menu() {
  ImGui::PopStyleVar();
  ImGui::EndPopup();
}

bool begin_combo(UiContext& ui, const char* id, const char* shown, float width) {
  ImGui::SetNextItemWidth(width);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(6)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(8), ui.theme.px(10)));
  const bool open = ImGui::BeginCombo(id, shown, ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton);
  ImGui::PopStyleVar(2);
  if (open) return list_opened(ui);
  report_control(ui, id);
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  const float r = ui.theme.px(3.5f), x = hi.x - ui.theme.px(13), y = std::round((lo.y + hi.y) / 2);
  ImGui::GetWindowDrawList()->AddTriangleFilled({x - r, y - r * 0.5f}, {x + r, y - r * 0.5f}, {x, y + r * 0.8f},
                                                ui.theme.colors.quiet);
  return false;
}

void more_below(UiContext& ui) {
  if (ImGui::GetScrollMaxY() - ImGui::GetScrollY() < ui.theme.px(6)) return;
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const float high = ui.theme.px(16), right = lo.x + size.x - ImGui::GetStyle().ScrollbarSize, bottom = lo.y + size.y;
  const float x = std::round((lo.x + right) / 2), y = bottom - ui.theme.px(7), r = ui.theme.px(5);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 clear = faded(c.panel, 0);
  draw.AddRectFilledMultiColor({lo.x, bottom - high}, {right, bottom}, clear, clear, c.panel, c.panel);
  draw.AddTriangleFilled({x - r, y}, {x + r, y}, {x, y + r}, c.text);
}

void cover_viewport(UiContext& ui, ImVec2 lo, ImVec2 hi) {
  ui.viewport.covers.push_back({{lo.x, lo.y}, {hi.x, hi.y}});
}

}  // namespace tyglab
