// Name of the preset, transport, time, engine.
#include <cmath>
#include <cstdio>

#include "app/base/text.h"
#include "app/session/motion.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

float bar_middle(Ui& ui, float height) {
  return std::round((ui.theme.px(48) - height) / 2);
}

/// The program's name, which leads to the start page. Returns where it ends.
float brand(Ui& ui, float x) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.brand;
  const float height = ui.theme.px(32), y = bar_middle(ui, height), padding = ui.theme.px(8);
  const float width = text_width(font, "Tyglab") + 2 * padding;
  ImGui::SetCursorScreenPos({x - padding, y});
  if (gui::press_area("brand", {width, height})) ui.command("start_page");
  report_control(ui, "brand");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered())
    draw.AddRectFilled({x - padding, y}, {x - padding + width, y + height}, c.field, ui.theme.px(5));
  tooltip(ui, gui::item_id(), "Scenes, labs and recent work", ui.keys_of("start_page"));
  draw_text(draw, font, {x, bar_middle(ui, font.FontSize)}, c.text, "Tyglab");
  return x - padding + width;
}

float menu_width(const Ui& ui) {
  return text_width(*ui.fonts.text, "Menu") + ui.theme.px(10 + 18 + 6);
}

/// Everything that can be done. Returns where it ends.
float menu_button(Ui& ui, float x) {
  const Tokens& c = ui.theme.colors;
  const float height = ui.theme.px(32), y = bar_middle(ui, height), width = menu_width(ui);
  ImGui::SetCursorScreenPos({x, y});
  if (gui::press_area("menu", {width, height})) ImGui::OpenPopup("application");
  report_control(ui, "menu");
  const bool open = ImGui::IsPopupOpen("application");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (open || ImGui::IsItemHovered()) draw.AddRectFilled({x, y}, {x + width, y + height}, c.field, ui.theme.px(5));
  tooltip(ui, gui::item_id(), "All commands", ui.keys_of("open_palette"));
  draw_text(draw, *ui.fonts.text, {x + ui.theme.px(10), std::round(y + (height - ui.fonts.text->FontSize) / 2)}, c.text,
            "Menu");
  const float tip = x + width - ui.theme.px(13), middle = y + height / 2, r = ui.theme.px(3.5f);
  draw.AddTriangleFilled({tip - r, middle - r * 0.5f}, {tip + r, middle - r * 0.5f}, {tip, middle + r * 0.8f}, c.quiet);
  ImGui::SetNextWindowPos({x, y + height + ui.theme.px(4)});
  application_menu(ui, "application");
  return x + width;
}

constexpr float before_name_at_1 = 8, after_name_at_1 = 14;  // the dot has its room there whether or not it is shown

/// What the preset's name takes with all that belongs to it, px.
float document_width(const Ui& ui) {
  return text_width(*ui.fonts.text, ui.session.preset().name) + ui.theme.px(before_name_at_1 + after_name_at_1);
}

/// Name of the preset, with a dot while it is not saved; leads to others. Returns where it ends.
float document_name(Ui& ui, float x, float width) {
  const Tokens& c = ui.theme.colors;
  const float height = ui.theme.px(32), y = bar_middle(ui, height);
  const float before = ui.theme.px(before_name_at_1), after = ui.theme.px(after_name_at_1);
  const std::string name = fitted(*ui.fonts.text, ui.session.preset().name, width - before - after);
  const float text = text_width(*ui.fonts.text, name);
  ImGui::SetCursorScreenPos({x, y});
  const float whole = before + text + after;
  if (gui::press_area("name", {whole, height})) ui.command("open_dialog");
  report_control(ui, "name");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) draw.AddRectFilled({x, y}, {x + whole, y + height}, c.field, ui.theme.px(5));
  tooltip(ui, gui::item_id(),
          ui.session.preset().name + (unsaved(ui.session) ? ": unsaved changes" : "") + "\n" +
              ui.session.preset().description,
          "Open Ctrl+O · save Ctrl+S");
  const ImVec2 at{x + before, std::round(y + (height - ui.fonts.text->FontSize) / 2)};
  draw_text(draw, *ui.fonts.text, at, c.quiet, name);
  if (unsaved(ui.session))
    draw.AddCircleFilled({at.x + text + after / 2, y + height / 2}, ui.theme.px(3.5f), c.warning, 16);
  return x + whole;
}

float transport(Ui& ui, float x) {
  const float y = bar_middle(ui, ui.theme.px(32));
  const ImVec2 hi = transport_buttons(ui, {x, y});
  ui.tour.transport = {{x, y}, {hi.x, hi.y}};
  return hi.x;
}

/// With what is between it and the next one, px.
float after_reading(const Ui& ui, float width) {
  return width + ui.theme.px(18);
}

/// A quiet label with a number after it. Returns where the next one begins; where the bar has no room for this one it
/// is left out, and so are all after it: they stand in the order of their use.
float reading(Ui& ui, float x, float end, const char* label, const std::string& value, const char* widest, ImU32 color,
              const char* tip) {
  const ImFont &small = *ui.fonts.small, &mono = *ui.fonts.mono;
  const float label_width = *label != 0 ? text_width(small, label) + ui.theme.px(8) : 0;
  const float width = label_width + std::max(text_width(mono, widest), text_width(mono, value));
  if (x + width > end) return end;
  const float height = ui.theme.px(32), y = bar_middle(ui, height);
  ImGui::SetCursorScreenPos({x, y});
  ImGui::PushID(tip);
  gui::press_area("reading", {width, height});
  tooltip(ui, gui::item_id(), tip);
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float baseline = std::round(y + height / 2 + mono.FontSize * 0.36f);
  draw_text(draw, small, {x, baseline - small.Ascent}, ui.theme.colors.quiet, label);
  draw_text(draw, mono, {x + label_width, baseline - mono.Ascent}, color, value);
  return x + after_reading(ui, width);
}

std::string time_text(const Ui& ui, double t) {
  return "t = " + time_number(t, ui.session.preset().dt) + " s";
}

/// What the simulated time takes, px: for a hundred seconds, so that nothing beside it moves while it runs.
float time_room(const Ui& ui) {
  return after_reading(ui, text_width(*ui.fonts.mono, time_text(ui, std::max(100.0, ui.session.simulation->time()))));
}

/// What the speeds that are always offered take beside each other, px: one that the hand sets for a moment moves
/// nothing.
float speeds_room(const Ui& ui) {
  return after_reading(ui, offered_speeds_size(ui).x);
}

/// All of them, or the list where they have no room; left out where that has none either, as readings are.
float speed(Ui& ui, float x, float end) {
  const ImVec2 all = speed_control_size(ui, 1e9f), list = speed_list_size(ui);
  if (x + all.x <= end) {
    speed_control(ui, {x, bar_middle(ui, all.y)}, 1e9f);
    return x + after_reading(ui, all.x);
  }
  if (x + list.x > end) return end;
  speed_list(ui, {x, bar_middle(ui, list.y)});
  return x + after_reading(ui, list.x);
}

/// How far a step is that takes long; empty where none does.
std::string step_under_way(const Session& session) {
  constexpr double unnoticed = 0.3;  // s
  if (!session.background_steps.busy()) return {};
  const double seconds = session.now - session.background_steps.begun();
  if (seconds < unnoticed) return {};
  const int percent = int(100 * session.background_steps.progress());
  char took[32];
  std::snprintf(took, sizeof took, ", %.1f s", seconds);
  return (percent < 1 ? "< 1" : std::to_string(percent)) + " %" + took;
}

void readings(Ui& ui, float x, float end) {
  const Tokens& c = ui.theme.colors;
  char text[64];
  // The speed is a control, and the time can also be read off a plot.
  if (x + time_room(ui) + speed_list_size(ui).x <= end)
    x = reading(ui, x, end, "", time_text(ui, clock_time(ui.session)), time_text(ui, 10).c_str(), c.text,
                "Simulated time");
  x = speed(ui, x, end);
  if (const std::string step = step_under_way(ui.session); !step.empty()) {
    const std::string label = "step " + std::to_string(ui.session.simulation->steps() + 1);
    reading(ui, x, end, label.c_str(), step, "100 %, 00.0 s", c.warning,
            "This step takes longer than a frame: its estimated progress, and its time so far. A change to the cloth "
            "restarts the step; a change of view does not.");
    return;
  }
  const RealTime real = real_time(ui);
  x = reading(ui, x, end, "real time", real.text, "100 %", real.color, real_time_tip);
  x = reading(ui, x, end, "dt", quantity(ui.session.preset().dt, "s"), "123.4 µs", c.text,
              "Time step, set in the left column");
  std::snprintf(text, sizeof text, "%d", ui.session.pacing.steps_per_frame());
  reading(ui, x, end, "steps/frame", text, "000", c.text, "Steps of dt per frame");
}

/// Of the buttons at the right: all, or the first two, which a lecture needs and no key is as quick as.
float buttons_width(const Ui& ui, int count) {
  return float(count) * ui.theme.px(32) + float(count - 1) * ui.theme.px(6);
}

void window_buttons(Ui& ui, float x, int count) {
  ImGui::SetCursorScreenPos({x, bar_middle(ui, ui.theme.px(32))});
  if (icon_button(ui,
                  {"labs", icon::labs, "Labs", "Labs: predict, try, check", "Ctrl+L", ui.session.labs.run.has_value()}))
    ui.command("choose_lab");
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  ui.tour.labs = {{lo.x, lo.y}, {hi.x, hi.y}};
  ImGui::SameLine(0, ui.theme.px(6));
  if (icon_button(ui, {"present", icon::screen, "Present", "Presentation mode: a large cloth, few controls", "F5"}))
    ui.command("present");
  if (count < 4) return;
  ImGui::SameLine(0, ui.theme.px(6));
  if (icon_button(ui, {"screen", ui.full_screen ? icon::compress : icon::expand, "Full", "Full screen", "F11"}))
    ui.command("full_screen");
  ImGui::SameLine(0, ui.theme.px(6));
  if (icon_button(ui, {"help", icon::help, "Help", "Mouse and keys", "F1", ui.help})) ui.command("toggle_help");
}

constexpr float engine_at_1 = 124, beside_at_1 = 12;         // the engine's menu and what is left of it
constexpr float least_name_at_1 = 72, most_name_at_1 = 240;  // what the preset's name is given
constexpr float least_shortened_at_1 = 100;                  // a long name is not cut to a few letters

/// Where things stand, px: it depends on the window, not on what is shown, so that nothing moves when that changes.
struct BarPlan {
  float name = 0;  ///< what the preset's name has, 0 or more
  float transport = 0, engine = 0;
  bool with_engine = false;
};

/// Between the menu's end and the buttons at the right, where the name may have `room`.
BarPlan plan_bar(const Ui& ui, float from, float right, float room, float window) {
  const float before = ui.theme.px(16), least = ui.theme.px(least_shortened_at_1),
              controls = transport_size(ui).x + time_room(ui) + speeds_room(ui);
  const float most =
                  std::min({ui.theme.px(most_name_at_1), std::max(0.2f * window, ui.theme.px(least_name_at_1)), room}),
              name = room > ui.theme.px(least_name_at_1) ? most : 0;
  BarPlan plan;
  plan.engine = right - before - ui.theme.px(engine_at_1);
  // Over the viewport's left edge where there is room, as if it belonged to it. All speeds come before that, and before
  // the engine, which the menu has too.
  const float latest = plan.engine - ui.theme.px(beside_at_1) - controls,
              left = ui.settings.layout.left && ui.panels ? ui.viewport_left + ui.theme.px(12) : 0,
              beside_engine = latest - from - before, beside_buttons = right - controls - from - before;
  if (left - from - before >= least && left < 0.4f * window && left <= latest)
    return {std::min(name, left - from - before), left, plan.engine, true};
  plan.with_engine = beside_engine >= least;
  plan.name = std::min(name, std::max(plan.with_engine ? beside_engine : beside_buttons, least));
  plan.transport = from + plan.name + before;
  return plan;
}

}  // namespace

void top_bar(Ui& ui, const Region& region) {
  const Tokens& c = ui.theme.colors;
  if (!begin_region("top", region, c.panel, {0, 0})) return end_region();
  const float margin = ui.theme.px(16);
  // In a narrow window, or with large text, transport and menu keep their places to the last. Full screen and help,
  // which have keys and are in the menu, make room for the speeds.
  float room = region.size.x - 2 * margin - transport_size(ui).x - 2 * ui.theme.px(18) - menu_width(ui);
  const float speeds = speed_list_size(ui, true).x + ui.theme.px(16);
  const int count = room > buttons_width(ui, 4) + speeds ? 4 : room > buttons_width(ui, 2) ? 2 : 0;
  const bool with_buttons = count > 0;
  const float buttons = with_buttons ? buttons_width(ui, count) : 0;
  room -= buttons + speeds;
  const float title = text_width(*ui.fonts.brand, "Tyglab") + ui.theme.px(14);
  float x = margin;
  if (room > title) x = brand(ui, x) + ui.theme.px(2), room -= title;
  x = menu_button(ui, x);
  const float right = region.size.x - margin - buttons;
  const BarPlan plan = plan_bar(ui, x, right, room, region.size.x);
  if (plan.name >= std::min(document_width(ui), ui.theme.px(least_shortened_at_1))) document_name(ui, x, plan.name);
  x = transport(ui, plan.transport) + ui.theme.px(18);
  readings(ui, x, (plan.with_engine ? plan.engine : right) - ui.theme.px(beside_at_1));
  if (plan.with_engine) {
    ImGui::SetCursorScreenPos({plan.engine, bar_middle(ui, ui.theme.px(26))});
    engine_menu(ui, ui.theme.px(engine_at_1));
  }
  if (with_buttons) window_buttons(ui, right, count);
  end_region();
}

}  // namespace tyglab
