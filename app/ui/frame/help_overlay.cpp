// F1: the list of mouse actions and keys.
#include <algorithm>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

// Pixels at scale 1: above and below, the row of buttons, and of the tables in a very low window.
constexpr float help_padding_at_1 = 20, help_foot_at_1 = 48, least_help_at_1 = 60;

struct Entry {
  const char *keys, *does;
};

constexpr Entry mouse_entries[] = {
    {"Right or Shift+left drag", "grabs a particle and pulls it"},
    {"Right click", "picks a particle: its forces are shown"},
    {"Right double-click", "pins or unpins a particle"},
    {"Left drag", "cuts the springs above, or what it crosses (C)"},
    {"Drag the wind arrow's tip", "changes W, or u in air; Shift: in depth, Ctrl: along an axis"},
    {"Left drag on a sphere", "moves the sphere"},
    {"Middle or Ctrl+left drag", "orbits; with Shift pans"},
    {"Wheel, two fingers", "zooms; with Shift pans"},
    {"Drop a file", "opens a preset, or uses an image as texture"},
};
constexpr Entry finger_entries[] = {
    {"One finger", "grabs the cloth and pulls it, moves a sphere"},
    {"One finger, cutting", "cuts: Menu, Cloth, Cut with one finger"},
    {"Tap, or hold still", "picks a particle: its forces are shown"},
    {"Two fingers", "orbit; apart or together zooms"},
    {"A tap on a number", "types a value"},
};
constexpr Entry sliders[] = {
    {"Drag · Shift drag", "changes · ten times finer"},
    {"Double-click", "back to the preset's value"},
    {"Double-click or Ctrl+click the number", "types a value"},
    {"← → · Ctrl · Shift", "steps · finer · coarser"},
    {"Tab, ↑ ↓ · Esc", "next slider · back to the cloth"},
    {"Right-click a row", "resets · adds a copy with another value"},
};

/// Text that is wrapped between `left` and `right`, pixels within the window; returns where it ends below.
float text_between(Ui& ui, const char* text, ImVec2 at, float right, ImU32 color) {
  ImGui::SetCursorPos(at);
  ImGui::PushTextWrapPos(right);
  wrapped(ui, text, color);
  ImGui::PopTextWrapPos();
  return ImGui::GetCursorPosY();
}

/// A column of the help: from where to where, and how much of it the keys take.
struct Column {
  float left, width, keys;
};

void table(Ui& ui, const char* title, std::span<const Entry> entries, const Column& column) {
  const Tokens& c = ui.theme.colors;
  const float right = column.left + column.width, does = column.left + column.keys;
  ImGui::PushFont(ui.fonts.title);
  float y = text_between(ui, title, {column.left, ImGui::GetCursorPosY()}, right, c.text);
  ImGui::PopFont();
  for (const Entry& entry : entries) {
    const float keys_end = text_between(ui, entry.keys, {column.left, y}, does - ui.theme.px(12), c.accent);
    y = std::max(keys_end, text_between(ui, entry.does, {does, y}, right, c.text));
  }
  ImGui::SetCursorPos({column.left, y + ui.theme.px(8)});
}

struct Table {
  const char* title;
  std::vector<Entry> entries;
};

/// What fingers and the mouse do, and every command that has keys, topic by topic; the views have theirs.
std::vector<Table> all_tables(bool by_touch) {
  std::vector<Table> all;
  if (by_touch) all.push_back({"With fingers", {std::begin(finger_entries), std::end(finger_entries)}});
  all.push_back({"In the viewport", {std::begin(mouse_entries), std::end(mouse_entries)}});
  all.push_back({"On sliders", {std::begin(sliders), std::end(sliders)}});
  for (const CommandTopic& topic : command_topics()) {
    Table table{topic.name, {}};
    for (const CommandRow& row : topic.rows)
      if (*row.keys != 0) table.entries.push_back({row.keys, row.help});
    if (std::string_view(topic.name) == "View") table.entries.push_back({"1 to 5", "the five views"});
    all.push_back(std::move(table));
  }
  return all;
}

void tables(Ui& ui, float width) {
  const ImVec2 start = ImGui::GetCursorPos();
  const float gap = ui.theme.px(32);
  const bool two = width > ui.theme.px(640);
  const float column = two ? (width - gap) / 2 : width, key_width = std::min(ui.theme.px(180), 0.42f * column);
  const Column left{start.x, column, key_width}, right{two ? start.x + column + gap : start.x, column, key_width};
  const std::vector<Table> all = all_tables(ui.input.by_touch);
  const auto lines = [](int sum, const Table& table) { return sum + int(table.entries.size()) + 2; };  // its heading
  const int total = std::accumulate(all.begin(), all.end(), 0, lines);
  const Column* now = &left;
  int shown = 0;
  float half = 0;
  for (const Table& each : all) {
    if (two && now == &left && 2 * shown >= total) {
      now = &right, half = ImGui::GetCursorPosY();
      ImGui::SetCursorPosY(start.y);
    }
    table(ui, each.title, each.entries, *now);
    shown = lines(shown, each);
  }
  text_between(
      ui,
      "An active slider or text field keeps its keys; Esc releases them. Equation numbers in tooltips are those of "
      "the report “Simulering av tyg” (Linköpings universitet, 2012).",
      {now->left, ImGui::GetCursorPosY()}, now->left + column, ui.theme.colors.quiet);
  ImGui::SetCursorPos({start.x, std::max(half, ImGui::GetCursorPosY()) + ui.theme.px(4)});
}

}  // namespace

void help_overlay(Ui& ui) {
  if (ui.dialog.kind != Dialog::Kind::none) ui.help = false;
  if (!ui.help) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float width = std::min(ui.theme.px(960), window.x - ui.theme.px(32));
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, window.y - ui.theme.px(32)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(24), ui.theme.px(help_padding_at_1)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(5)));
  ImGui::SetNextWindowFocus();
  if (ImGui::Begin("help", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    const float around = ui.theme.px(32 + 2 * help_padding_at_1 + help_foot_at_1);
    const float room = std::max(window.y - around, ui.theme.px(least_help_at_1));
    // How high the tables are is known once they have been drawn.
    gui::begin_child("tables", {0, ui.help_needs > 0 ? std::min(ui.help_needs, room) : room});
    tables(ui, ImGui::GetContentRegionAvail().x);
    if (const float needs = ImGui::GetCursorPosY(); needs != ui.help_needs) ui.help_needs = needs, ui.draw_by = ui.now;
    more_below(ui);
    ImGui::EndChild();
    ImGui::Dummy({0, ui.theme.px(4)});
    if (text_button(ui, "Close", true)) ui.help = false;
    for (const char* id : {"choose_lab", "start_tour", "open_palette"}) {
      ImGui::SameLine();
      if (text_button(ui, row_of(id).name)) ui.help = false, ui.command(id);
    }
    const ImVec2 lo = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    cover_viewport(ui, lo, {lo.x + size.x, lo.y + size.y});
  }
  ImGui::End();
  ImGui::PopStyleVar(4);
}

}  // namespace tyglab
