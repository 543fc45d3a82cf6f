// Name of the preset, transport, time, engine.
#include <cmath>
#include <cstdio>

#include "app/base/numbers.h"
#include "app/ui/constants/engine_menu.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

float bar_middle(App& app, float height) {
  return std::round((app.theme.px(48) - height) / 2);
}

void document_menu(App& app) {
  if (!begin_menu(app, "document")) return;
  const auto item = [&](Command command, bool enabled = true) {
    const CommandRow& row = row_of(command);
    if (ImGui::MenuItem(row.name, *row.keys != 0 ? row.keys : nullptr, false, enabled)) app.command(command);
    report_control(app, row.name);
  };
  item(Command::open_dialog);
  item(Command::save);
  item(Command::save_as);
  ImGui::Separator();
  item(Command::undo, app.history.can_undo());
  item(Command::redo, app.history.can_redo());
  ImGui::Separator();
  item(Command::restart);
  item(Command::reset_constants, unsaved(app));
  item(Command::reset_everything);
  ImGui::Separator();
  item(Command::open_palette);
  item(Command::choose_lab);
  item(Command::start_tour);
  ImGui::Separator();
  item(Command::larger_text);
  item(Command::smaller_text);
  item(Command::normal_text);
  item(Command::next_theme);
  ImGui::Separator();
  if (ImGui::MenuItem("Constants", nullptr, app.settings.layout.left))
    app.settings.layout.left = !app.settings.layout.left;
  if (ImGui::MenuItem("Plots", nullptr, app.settings.layout.right))
    app.settings.layout.right = !app.settings.layout.right;
  const auto shown = [&](Command command, bool is) {
    if (ImGui::MenuItem(row_of(command).name, row_of(command).keys, is)) app.command(command);
    report_control(app, row_of(command).name);
  };
  shown(Command::toggle_map, app.settings.layout.map);
  shown(Command::toggle_inside, app.settings.layout.inside);
  if (ImGui::MenuItem("Hints", nullptr, app.settings.layout.status))
    app.settings.layout.status = !app.settings.layout.status;
  item(Command::toggle_panels);
  item(Command::full_screen);
  ImGui::Separator();
  item(Command::quit);
  end_menu();
}

/// Name of the preset, with a dot while it is not saved; opens the menu. Returns where it ends.
float document_name(App& app, float x, float width) {
  const Tokens& c = app.theme.colors;
  const float height = app.theme.px(32), y = bar_middle(app, height);
  const float dot = unsaved(app) ? app.theme.px(18) : 0, padding = app.theme.px(10), arrow = app.theme.px(18);
  const std::string name = fitted(*app.fonts.text, app.preset().name, width - dot - 2 * padding - arrow);
  const float text = text_width(*app.fonts.text, name);
  ImGui::SetCursorScreenPos({x, y});
  const float whole = text + dot + 2 * padding + arrow;
  if (ImGui::InvisibleButton("name", {whole, height})) ImGui::OpenPopup("document");
  report_control(app, "name");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) draw.AddRectFilled({x, y}, {x + whole, y + height}, c.field, app.theme.px(5));
  tooltip(app, gui::item_id(),
          app.preset().name + (unsaved(app) ? ": changes have not been saved" : "") + "\n" + app.preset().description,
          "Open Ctrl+O · save Ctrl+S");
  const ImVec2 at{x + padding, std::round(y + (height - app.fonts.text->FontSize) / 2)};
  draw_text(draw, *app.fonts.text, at, c.text, name);
  const float middle = y + height / 2;
  if (dot > 0) draw.AddCircleFilled({at.x + text + app.theme.px(10), middle}, app.theme.px(3.5f), c.warning, 16);
  const float tip = at.x + text + dot + app.theme.px(10), r = app.theme.px(3.5f);
  draw.AddTriangleFilled({tip - r, middle - r * 0.5f}, {tip + r, middle - r * 0.5f}, {tip, middle + r * 0.8f}, c.quiet);
  document_menu(app);
  return x + whole;
}

float transport(App& app, float x) {
  const float gap = app.theme.px(6), y = bar_middle(app, app.theme.px(32));
  ImGui::SetCursorScreenPos({x, y});
  if (icon_button(app, "restart", icon::restart, "Restart", "Restart the motion; the constants stay", "R or Backspace"))
    app.command(Command::restart);
  ImGui::SameLine(0, gap);
  const bool playing = app.pacing.playing;
  if (icon_button(app, "play", playing ? icon::pause : icon::play, playing ? "Pause" : "Run", playing ? "Pause" : "Run",
                  "Space", playing))
    app.command(Command::toggle_play);
  ImGui::SameLine(0, gap);
  if (icon_button(app, "step", icon::step, "Step", "One step of dt, then pause",
                  app.ui.slider.focused != 0 ? "O (→ is the slider's until Esc)" : "→ or O"))
    app.command(Command::step);
  const ImVec2 hi = ImGui::GetItemRectMax();
  app.ui.tour.transport = {{x, y}, {hi.x, hi.y}};
  return hi.x;
}

/// A quiet label with a number after it. Returns where the next one begins; where the bar has no room for this one it
/// is left out, and so are all after it: they stand in the order of their use.
float reading(App& app, float x, float end, const char* label, const std::string& value, const char* widest,
              ImU32 color, const char* tip) {
  const ImFont &small = *app.fonts.small, &mono = *app.fonts.mono;
  const float label_width = *label != 0 ? text_width(small, label) + app.theme.px(8) : 0;
  const float width = label_width + std::max(text_width(mono, widest), text_width(mono, value));
  if (x + width > end) return end;
  const float height = app.theme.px(32), y = bar_middle(app, height);
  ImGui::SetCursorScreenPos({x, y});
  ImGui::PushID(tip);
  ImGui::InvisibleButton("reading", {width, height});
  tooltip(app, gui::item_id(), tip);
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float baseline = std::round(y + height / 2 + mono.FontSize * 0.36f);
  draw_text(draw, small, {x, baseline - small.Ascent}, app.theme.colors.quiet, label);
  draw_text(draw, mono, {x + label_width, baseline - mono.Ascent}, color, value);
  return x + width + app.theme.px(18);
}

float speed_combo(App& app, float x, float end) {
  static constexpr double speeds[] = {0.01, 0.03, 0.1, 0.25, 0.5, 1, 2};
  const float width = app.theme.px(88), height = app.theme.px(26);
  if (x + width > end) return end;
  ImGui::SetCursorScreenPos({x, bar_middle(app, height)});
  const bool slowed = app.pacing.slowed != 1;
  const std::string hand = slowed ? std::string(icon_or(app.fonts, icon::hand, "hand")) + " " : "";
  const std::string shown = hand + short_number(app.pacing.aim()) + (slowed ? "×" : " ×");
  ImGui::PushStyleColor(ImGuiCol_Text, slowed ? app.theme.colors.accent : app.theme.colors.text);
  const bool open = begin_combo(app, "##speed", shown.c_str(), width);
  ImGui::PopStyleColor();
  if (open) {
    for (double speed : speeds)
      if (ImGui::Selectable((short_number(speed) + " ×").c_str(), speed == app.pacing.speed)) {
        app.pacing.speed = speed;
        app.pacing.restart_measure();
      }
    end_combo();
  } else {
    tooltip(app, gui::item_id(),
            slowed ? "Slow motion while the hand is in the cloth"
                   : "Speed: simulated time to real time. Below 1 is slow motion.");
  }
  return x + width + app.theme.px(18);
}

void readings(App& app, float x, float end) {
  const Tokens& c = app.theme.colors;
  char text[64];
  const auto time = [&](double t) { return "t = " + time_number(t, app.preset().dt) + " s"; };
  x = reading(app, x, end, "", time(app.simulation->time()), time(10).c_str(), c.text, "Simulated time");
  x = speed_combo(app, x, end);
  const double part = app.pacing.aim() > 0 ? app.pacing.reached() / app.pacing.aim() : 0;
  std::snprintf(text, sizeof text, "%.0f %%", 100 * app.pacing.reached());
  const bool running = app.pacing.playing && !app.simulation->divergence() && !app.asleep();
  x = reading(
      app, x, end, "real time", running ? text : "–", "100 %",
      !running      ? c.quiet
      : part > 0.95 ? c.good
                    : c.warning,
      "Simulated time to real time, reached over the last half second. Amber: the machine does not keep up with the "
      "speed wished.");
  std::snprintf(text, sizeof text, "%d", app.pacing.steps_per_frame());
  x = reading(app, x, end, "steps/frame", text, "000", c.text, "Steps of dt made between two pictures");
  reading(app, x, end, "dt", short_number(app.preset().dt) + " s", "1.234e-4 s", c.text, "Time step, set at the left");
}

void window_buttons(App& app, float x) {
  ImGui::SetCursorScreenPos({x, bar_middle(app, app.theme.px(32))});
  if (icon_button(app, "labs", icon::labs, "Labs", "Labs: predict, do, and let the program look", "Ctrl+L",
                  app.labs.run.has_value()))
    app.command(Command::choose_lab);
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  app.ui.tour.labs = {{lo.x, lo.y}, {hi.x, hi.y}};
  ImGui::SameLine(0, app.theme.px(6));
  if (icon_button(app, "screen", app.full_screen ? icon::compress : icon::expand, "Full", "Full screen", "F11"))
    app.command(Command::full_screen);
  ImGui::SameLine(0, app.theme.px(6));
  if (icon_button(app, "help", icon::help, "Help", "Mouse and keys", "F1", app.ui.help))
    app.command(Command::toggle_help);
}

}  // namespace

void top_bar(App& app, const Region& region) {
  const Tokens& c = app.theme.colors;
  if (!begin_region("top", region, c.panel, {0, 0})) return end_region();
  const float margin = app.theme.px(16), button = app.theme.px(32), gap = app.theme.px(6), combo = app.theme.px(124);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImFont& brand = *app.fonts.brand;
  // In a narrow window, or with large text, the transport keeps its place to the last.
  float room = region.size.x - 2 * margin - 3 * button - 2 * gap - 2 * app.theme.px(18);
  const float least_name = app.theme.px(72), buttons = 3 * button + 2 * gap;
  const bool with_buttons = room > buttons + least_name, with_name = room > least_name;
  if (with_buttons) room -= buttons;
  const float title = text_width(brand, "Tyglab") + app.theme.px(14);
  float x = margin;
  if (room > title + least_name) {
    draw_text(draw, brand, {x, bar_middle(app, brand.FontSize)}, c.text, "Tyglab");
    x += title, room -= title;
  }
  const float name_width = std::min({app.theme.px(240), std::max(region.size.x * 0.2f, least_name), room});
  if (with_name) x = document_name(app, x, name_width) + app.theme.px(16);
  // Over the viewport's left edge where there is room, as if it belonged to it.
  const float left = app.settings.layout.left && app.ui.panels ? app.ui.viewport_left + app.theme.px(12) : x;
  x = transport(app, left > x && left < region.size.x * 0.4f ? left : x) + app.theme.px(18);
  const float right = region.size.x - margin - (with_buttons ? buttons : 0);
  const float engine = right - app.theme.px(16) - combo;
  const bool room_for_engine = engine > x + app.theme.px(120);
  readings(app, x, (room_for_engine ? engine : right) - app.theme.px(12));
  if (room_for_engine) {
    ImGui::SetCursorScreenPos({engine, bar_middle(app, app.theme.px(26))});
    engine_menu(app, combo);
  }
  if (with_buttons) window_buttons(app, right);
  end_region();
}

}  // namespace tyglab
