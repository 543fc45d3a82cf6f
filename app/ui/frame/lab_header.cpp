#include "app/ui/frame/panels.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

float button_width(const Ui& ui, const char* label) {
  return text_width(*ui.fonts.text, label) + 2 * ImGui::GetStyle().FramePadding.x;
}

float wider(const Ui& ui, const char* one, const char* other) {
  return std::max(button_width(ui, one), button_width(ui, other));
}

constexpr float button_gap_at_1 = 6;

/// What all of them take beside each other, px; the same in every step, so that each keeps its place.
float step_buttons_width(const Ui& ui) {
  const float gap = ui.theme.px(button_gap_at_1);
  return button_width(ui, "Back") + wider(ui, "Next", "Finish") + wider(ui, "Skip", "Next lab") +
         button_width(ui, "Set up again") + 3 * gap;
}

/// The second click of a double click meets the next step's button, and is not meant for it.
bool second_click() {
  return ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseClickedLastCount[0] > 1;
}

/// On to the next step once this one is done; out of the lab at its end.
void forward_button(Ui& ui, LabRun& run, bool can) {
  const bool last = run.step + 1 == run.lab.steps.size(), done = run.record().done;
  const bool go = text_button(ui, last ? "Finish" : "Next", done, can, wider(ui, "Next", "Finish")) && !second_click();
  if (!can)
    tooltip(ui, gui::item_id(),
            std::string(run.to_be_predicted() ? "Once the prediction is made and the checks hold; "
                                              : "Once the checks hold; ") +
                (last ? "× leaves the lab before that, and keeps your progress" : "Skip goes on without that"));
  if (go) last ? ui.command("leave_lab") : enter_step(ui.session, run.step + 1);
}

/// Past a step that is not done, and at the end to the next lab. Never where Next stands, which may be hit twice.
void skip_button(Ui& ui, LabRun& run, bool can_go_on) {
  const bool last = run.step + 1 == run.lab.steps.size(), can = last == can_go_on;
  if (!text_button(ui, last ? "Next lab" : "Skip", false, can, wider(ui, "Skip", "Next lab")) || second_click()) return;
  last ? ui.command("next_lab") : enter_step(ui.session, run.step + 1);
}

}  // namespace

void step_buttons(Ui& ui, LabRun& run, ImVec2 at) {
  const bool can_go_on = run.record().done || cannot_be_done(ui.session);
  const std::size_t step = run.step;
  const float gap = ui.theme.px(button_gap_at_1);
  ImGui::SetCursorScreenPos(at);
  if (text_button(ui, "Back", false, run.step > 0)) return back_step(ui.session);
  ImGui::SameLine(0, gap);
  forward_button(ui, run, can_go_on);
  if (run.step != step) return;
  ImGui::SameLine(0, gap);
  skip_button(ui, run, can_go_on);
  if (run.step != step || !run.now().open) return;
  ImGui::SameLine(0, gap);
  if (text_button(ui, "Set up again")) set_up_step(ui.session);
}

bool lab_header(Ui& ui, LabRun& run, const Region& region, bool with_buttons) {
  const Tokens& c = ui.theme.colors;
  const float gap = ui.theme.px(button_gap_at_1);
  float end = region.at.x + region.size.x - ui.theme.px(12 + 22);
  const float middle = region.at.y + ui.theme.px(24), margin = ui.theme.px(16);
  ImGui::SetCursorScreenPos({end, region.at.y + ui.theme.px(13)});
  if (quiet_button(ui, "leave", icon::close, "x", "Leave the lab; your progress is kept")) ui.command("leave_lab");
  if (with_buttons) {
    end -= gap + step_buttons_width(ui);
    step_buttons(ui, run, {end, region.at.y + ui.theme.px(9)});
  }
  end -= ui.theme.px(12);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  float x = region.at.x + margin;
  const float baseline = baseline_at(ui.fonts, middle);
  char place[32];
  std::snprintf(place, sizeof place, "Step %zu of %zu", run.step + 1, run.lab.steps.size());
  const float width = text_width(*ui.fonts.title, run.now().title);
  const bool room = x + width <= end;
  if (room)
    draw_on_baseline(draw, *ui.fonts.title, {x, baseline}, c.text, run.now().title), x += width + ui.theme.px(10);
  if (x + text_width(*ui.fonts.small, place) > end) return room;
  const std::string full = std::string(place) + " · " + run.lab.title;
  draw_on_baseline(draw, *ui.fonts.small, {x, baseline}, c.quiet,
                   x + text_width(*ui.fonts.small, full) <= end ? full : place);
  return room;
}

}  // namespace tyglab
