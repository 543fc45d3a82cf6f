#include "app/ui/frame/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/ui/frame/commands.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float between_buttons_at_1 = 6;  // between buttons
constexpr float beside_label_at_1 = 6;     // beside a speed's label

struct Speed {
  double value;
  const char* label;
};
constexpr std::array<Speed, 4> offered_speeds{{{1, "1"}, {1.0 / 4, "1/4"}, {1.0 / 20, "1/20"}, {1.0 / 100, "1/100"}}};

/// Those, and the present one where it is another; while the hand slows time down, that speed.
struct SpeedLabels {
  std::vector<std::string> texts;
  std::vector<const char*> labels;
  int chosen = 0;
};

SpeedLabels speed_labels(const Ui& ui) {
  const double now = ui.session.pacing.aim();
  SpeedLabels all;
  for (const Speed& speed : offered_speeds) all.texts.emplace_back(speed.label);
  const auto known =
      std::find_if(offered_speeds.begin(), offered_speeds.end(), [&](const Speed& s) { return s.value == now; });
  all.chosen = int(known - offered_speeds.begin());
  if (known == offered_speeds.end())
    all.texts.push_back(now < 1 ? "1/" + short_number(std::round(1 / now), 3) : short_number(now, 2));
  for (const std::string& text : all.texts) all.labels.push_back(text.c_str());
  return all;
}

const char* speed_tip(const Pacing& pacing) {
  return pacing.slowed != 1 ? "Slow motion while you grab or cut (H)"
                            : "Speed: simulated seconds per real second. Below 1 is slow motion; → makes single steps.";
}

void choose_speed(Pacing& pacing, int k) {
  if (k < 0 || k >= int(offered_speeds.size())) return;
  pacing.speed = offered_speeds[std::size_t(k)].value;
  pacing.restart_measure();
}

}  // namespace

ImVec2 transport_size(const Ui& ui, float side) {
  return {3 * ui.theme.px(side) + 2 * ui.theme.px(between_buttons_at_1), ui.theme.px(side)};
}

ImVec2 transport_buttons(Ui& ui, ImVec2 at, float side) {
  const float gap = ui.theme.px(between_buttons_at_1);
  ImGui::SetCursorScreenPos(at);
  if (icon_button(ui, {"restart", icon::restart, "Restart", "Restart the motion and keep the constants",
                       "R or Backspace", false, side}))
    ui.command("restart");
  ImGui::SameLine(0, gap);
  const std::string why = why_not(ui, row_of("toggle_play"));
  const bool playing = ui.session.pacing.playing && why.empty();
  const char* const run = playing ? "Pause" : "Run";
  if (icon_button(ui,
                  {"play", playing ? icon::pause : icon::play, run, why.empty() ? run : why, "Space", playing, side}))
    ui.command("toggle_play");
  ImGui::SameLine(0, gap);
  if (icon_button(ui, {"step", icon::step, "Step", "One step of dt, then pause",
                       ui.slider.focused != 0 ? "O (→ moves the slider until Esc)" : "→ or O", false, side}))
    ui.command("step");
  return ImGui::GetItemRectMax();
}

RealTime real_time(const Ui& ui) {
  const Pacing& pacing = ui.session.pacing;
  const Tokens& c = ui.theme.colors;
  // A replay is as slow as it is meant to be.
  const bool running =
      pacing.playing && !ui.session.replay && !ui.session.simulation->divergence() && !ui.session.asleep();
  if (!running) return {"–", c.quiet, false};
  const bool reached = pacing.aim() > 0 && pacing.reached() / pacing.aim() > 0.95;
  return {short_number(std::round(100 * pacing.reached()), 4) + " %", reached ? c.good : c.warning};
}

ImVec2 speed_control_size(const Ui& ui, float width) {
  const SpeedLabels all = speed_labels(ui);
  return segments_size(ui, all.labels.data(), int(all.labels.size()), beside_label_at_1, width);
}

ImVec2 offered_speeds_size(const Ui& ui) {
  std::vector<const char*> labels;
  for (const Speed& speed : offered_speeds) labels.push_back(speed.label);
  return segments_size(ui, labels.data(), int(labels.size()), beside_label_at_1);
}

void speed_control(Ui& ui, ImVec2 at, float width) {
  const SpeedLabels all = speed_labels(ui);
  ImGui::SetCursorScreenPos(at);
  const int k = segments(ui, "speed", all.labels.data(), int(all.labels.size()), all.chosen, beside_label_at_1, width);
  tooltip(ui, gui::item_id(), speed_tip(ui.session.pacing));
  choose_speed(ui.session.pacing, k);
}

ImVec2 speed_list_size(const Ui& ui, bool offered) {
  const SpeedLabels all = speed_labels(ui);
  const float widest = text_width(*ui.fonts.text, "1/100 ×"),
              now = text_width(*ui.fonts.text, all.texts[std::size_t(all.chosen)] + " ×");
  return {(offered ? widest : std::max(widest, now)) + ui.theme.px(34), ui.theme.px(26)};
}

void speed_list(Ui& ui, ImVec2 at) {
  const SpeedLabels all = speed_labels(ui);
  ImGui::SetCursorScreenPos(at);
  if (!begin_combo(ui, "##speed", (all.texts[std::size_t(all.chosen)] + " ×").c_str(), speed_list_size(ui).x))
    return tooltip(ui, gui::item_id(), speed_tip(ui.session.pacing));
  for (int k = 0; k < int(all.texts.size()); ++k) {
    if (ImGui::Selectable((all.texts[std::size_t(k)] + " ×").c_str(), k == all.chosen))
      choose_speed(ui.session.pacing, k);
    report_control(ui, "speed_" + std::to_string(k + 1));
  }
  end_combo();
}

}  // namespace tyglab
