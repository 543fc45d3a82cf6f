// The current lab, in a strip below the viewport: what to read at the left; at the right what to predict, then what
// to do, what is checked and why. The buttons stand at the strip's foot, since the strip grows upward as its text does.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/base/numbers.h"
#include "app/base/text_lines.h"
#include "app/session/lab_check.h"
#include "app/session/observables.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float header_at_1 = 46, lowest_strip_at_1 = 130, foot_at_1 = 38;  // pixels at scale 1

/// Small capitals over a part; what is above keeps its distance, what is below stands close.
void small_head(Ui& ui, const char* text, ImU32 color) {
  if (ImGui::GetCursorPosY() > ui.theme.px(4)) ImGui::Dummy({0, ui.theme.px(2)});
  ImGui::PushFont(ui.fonts.small);
  wrapped(ui, text, color);
  ImGui::PopFont();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ui.theme.px(3));
}

/// Text in the column's width.
void set_text(Ui& ui, std::string_view text, ImU32 color) {
  wrapped(ui, in_lines(*ui.fonts.text, text, ImGui::GetContentRegionAvail().x), color);
}

void paragraphs_of(Ui& ui, const Paragraphs& text, ImU32 color) {
  for (const std::string& paragraph : text) set_text(ui, paragraph, color);
}

/// A line with an icon before it (or a sign, where the icon font is missing), in which words say the same.
void marked_line(Ui& ui, const char* glyph, const char* sign, ImU32 color, const std::string& text, ImU32 text_color) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  draw_text(*ImGui::GetWindowDrawList(), *ui.fonts.text, lo, color, icon_or(ui.fonts, glyph, sign));
  ImGui::Indent(ui.theme.px(22));
  set_text(ui, text, text_color);
  ImGui::Unindent(ui.theme.px(22));
}

std::string with_unit(double value, std::string_view unit) {
  return short_number(value) + (unit.empty() ? "" : " " + std::string(unit));
}

/// What was predicted, and, once the step is done, whether it came true.
void verdict(Ui& ui, const Prediction& asked, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  const bool number = asked.choices.empty();
  const std::string said = number ? with_unit(typed_number(record.typed, asked.unit).value_or(0), asked.unit)
                                  : asked.choices[std::size_t(record.chosen)];
  if (!record.done) return marked_line(ui, icon::right, ">", c.accent, "You predict: " + said, c.text);
  if (record.right) return marked_line(ui, icon::check, "+", c.good, "You were right: " + said, c.text);
  const std::string answer = number ? with_unit(record.answer, asked.unit) : asked.choices[asked.right];
  marked_line(ui, icon::close, "x", c.warning, "You predicted: " + said, c.text);
  marked_line(ui, icon::check, "+", c.good, "Right: " + answer, c.text);
}

/// Why what was typed is no number in that unit.
std::string not_understood(const char* typed, const std::string& unit) {
  const std::string quoted = "“" + std::string(typed) + "” is not a number";
  if (unit.empty()) return quoted + ". Type one such as 0.31 or 1e-4.";
  return quoted + " in " + unit + ". Type one such as 0.31 or 1e-4, without a unit or in " + unit + ".";
}

void number_field(Ui& ui, const Prediction& asked, StepRecord& record) {
  ImGui::SetNextItemWidth(ui.theme.px(120));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(7)));
  ImGui::InputTextWithHint("##prediction", "your number", record.typed, sizeof record.typed);
  ImGui::PopStyleVar();
  report_control(ui, "prediction");
  const bool in_field = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  wrapped(ui, asked.unit, ui.theme.colors.quiet);
  if (!asked.unit.empty()) ImGui::SameLine();
  const bool enter = ui.lab_enter && in_field && !ui.input.unread;
  if (text_button(ui, "Predict", true, record.typed[0] != 0) || enter)
    if (!predict(ui.session)) ui.session.messages.error(not_understood(record.typed, asked.unit));
}

void choice_list(Ui& ui, const Prediction& asked, StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  bool clicked = false;
  for (int k = 0; k < int(asked.choices.size()); ++k) {
    ImGui::PushID(k);
    const bool chosen = record.chosen == k;
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, indent = ui.theme.px(24), pad = ui.theme.px(5);
    const ImFont& font = *ui.fonts.text;
    const std::string words = in_lines(font, asked.choices[std::size_t(k)], width - indent - pad);
    const float height = font.CalcTextSizeA(font.FontSize, 1e9f, 0, words.c_str()).y + 2 * pad;
    if (gui::press_area("choice", {width, height})) record.chosen = k, clicked = true;
    report_control(ui, "choice." + std::to_string(k + 1));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (chosen || ImGui::IsItemHovered())
      draw.AddRectFilled(lo, {lo.x + width, lo.y + height}, chosen ? mixed(c.field, c.accent, 0.25f) : c.field,
                         ui.theme.px(5));
    const ImVec2 middle{lo.x + ui.theme.px(12), lo.y + pad + std::round(font.FontSize / 2)};
    draw.AddCircle(middle, ui.theme.px(5.5f), chosen ? c.accent : c.quiet, 20, std::max(1.f, ui.theme.px(1.5f)));
    if (chosen) draw.AddCircleFilled(middle, ui.theme.px(3), c.accent, 16);
    draw_text(draw, font, {lo.x + indent, lo.y + pad}, c.text, words);
    ImGui::PopID();
  }
  if (text_button(ui, "Predict", true, record.chosen >= 0)) predict(ui.session);
  if (clicked) ImGui::SetScrollHereY(1);  // the button may stand below the column's edge
}

void prediction_part(Ui& ui, const LabStep& step, StepRecord& record) {
  if (!step.prediction) return;
  small_head(ui, "PREDICT", ui.theme.colors.accent);
  set_text(ui, step.prediction->question, ui.theme.colors.text);
  if (record.predicted) return verdict(ui, *step.prediction, record);
  step.prediction->choices.empty() ? number_field(ui, *step.prediction, record)
                                   : choice_list(ui, *step.prediction, record);
}

bool to_be_predicted(const LabStep& step, const StepRecord& record) {
  return step.prediction && !record.predicted && !record.done;
}

/// " (4.2e-6 m after 1.7e-5 m)": what a check that is done has compared with the step before; nothing of others.
std::string compared(const LabRun& run, const Condition& check) {
  if (!check.right.before || check.right.factor == 1 || run.step == 0) return {};
  const auto &now = run.record().outcome.values, &before = run.records[run.step - 1].outcome.values;
  const auto value = now.find(check.name), earlier = before.find(check.right.name);
  if (value == now.end() || earlier == before.end()) return {};
  const std::string_view unit = unit_of(check.name);
  return " (" + with_unit(rounded(value->second, 3), unit) + " after " + with_unit(rounded(earlier->second, 3), unit) +
         ")";
}

void check_line(Ui& ui, const LabRun& run, const Condition& check, CheckState state, const CheckMemory& memory) {
  const Tokens& c = ui.theme.colors;
  if (run.record().done)
    return marked_line(ui, icon::check, "+", c.good, with_whole_terms(words_of(check) + compared(run, check)), c.text);
  const std::string words = with_whole_terms(check_in_words(ui.session, check, state, memory));
  // What must hold to the end holds so far, and is nothing that has been done.
  if (state == CheckState::holds && check.span == Span::throughout)
    return marked_line(ui, icon::check, "+", c.quiet, words + " · so far", c.quiet);
  if (state == CheckState::holds) return marked_line(ui, icon::check, "+", c.good, words, c.text);
  if (state == CheckState::open) return marked_line(ui, icon::circle, "o", c.quiet, words, c.text);
  if (state == CheckState::broken) return marked_line(ui, icon::close, "x", c.warning, words, c.text);
  marked_line(ui, icon::unknown, "?", c.warning, words, c.text);
}

/// The experiment that the lab has taken the place of.
void back_button(Ui& ui) {
  if (ui.session.labs.kept.empty()) return;
  if (text_button(ui, "Back to your experiment")) ui.command("back_to_experiment");
}

/// Another preset is open than the lab's: what it means, and the ways on.
void waiting_part(Ui& ui) {
  const Tokens& c = ui.theme.colors;
  marked_line(ui, icon::pause, "!", c.warning,
              "“" + ui.session.preset().name +
                  "” is open, which is not this lab's cloth. The lab is paused and checks nothing.",
              c.text);
  if (text_button(ui, "Open the lab's cloth", true)) resume_lab(ui.session);
  ImGui::SameLine();
  if (text_button(ui, "Leave the lab")) ui.command("leave_lab");
  back_button(ui);
}

void task_part(Ui& ui, const LabStep& step) {
  if (step.todo.empty()) return;
  small_head(ui, "DO", ui.theme.colors.accent);
  paragraphs_of(ui, step.todo, ui.theme.colors.text);
}

void checks_part(Ui& ui, const LabStep& step, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  const LabRun& run = *ui.session.labs.run;
  if (step.checks.empty()) return;
  // How many hold: what does not may stand below the column's edge.
  const auto holding = std::count(record.checks.begin(), record.checks.end(), CheckState::holds);
  const std::string count = "CHECK: " + std::to_string(holding) + " OF " + std::to_string(step.checks.size());
  small_head(ui, record.done ? "CHECK: DONE" : count.c_str(), record.done ? c.good : c.accent);
  for (std::size_t k = 0; k < step.checks.size(); ++k)
    if (k < record.checks.size() && k < record.seen.size())
      check_line(ui, run, step.checks[k], record.checks[k], record.seen[k]);
  const std::string& awaited = run.awaited;
  if (const Observable* row = find_observable(awaited); row != nullptr && !record.done)
    marked_line(ui, icon::unknown, "?", c.warning, awaited + " · " + std::string(row->hint), c.text);
}

/// The task, and what is checked; a task that is done stands last.
void doing_part(Ui& ui, const LabStep& step, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  if (lab_waits(ui.session)) return waiting_part(ui);
  const bool first = to_be_predicted(step, record);
  if (cannot_be_done(ui.session))
    return marked_line(ui, icon::warning, "!", c.warning,
                       first
                           ? "This machine has no OpenCL device, so there is nothing to do here; predict, and read on."
                           : "This machine has no OpenCL device, so there is nothing to do here; read on.",
                       c.text);
  if (first) return set_text(ui, "Predict first; then the task appears here.", c.quiet);
  if (!record.done) task_part(ui, step);
  checks_part(ui, step, record);
  if (record.done) task_part(ui, step);
}

void explanation_part(Ui& ui, LabRun& run) {
  if (!run.record().done || run.now().explanation.empty()) return;
  if (std::exchange(run.show_explanation, false)) ImGui::SetScrollHereY(0);
  small_head(ui, "WHY", ui.theme.colors.accent);
  paragraphs_of(ui, run.now().explanation, ui.theme.colors.text);
}

void end_part(Ui& ui, const LabRun& run) {
  if (run.record().done && run.step + 1 == run.lab.steps.size()) back_button(ui);
}

/// The step's title, where it has no room beside the buttons.
void title_part(Ui& ui, const LabRun& run) {
  ImGui::PushFont(ui.fonts.title);
  wrapped(ui, in_lines(*ui.fonts.title, run.now().title, ImGui::GetContentRegionAvail().x), ui.theme.colors.text);
  ImGui::PopFont();
}

void reading_part(Ui& ui, LabRun& run) {
  if (run.step == 0 && !run.record().done) paragraphs_of(ui, run.lab.summary, ui.theme.colors.quiet);
  paragraphs_of(ui, run.now().text, ui.theme.colors.text);
}

/// One of the panel's columns, which scrolls by itself.
void begin_lab_column(Ui& ui, const char* id, float left, float top, ImVec2 size) {
  ImGui::SetCursorScreenPos({left, top});
  gui::begin_child(id, size);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(6)));
  ImGui::PushTextWrapPos(0);
}

/// Returns how high its contents are, px.
float end_lab_column(Ui& ui) {
  const float height = ImGui::GetCursorPosY();
  ImGui::Dummy({0, ui.theme.px(4)});
  more_below(ui);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleVar();
  ImGui::EndChild();
  return height;
}

/// The strip becomes as high as its text needs; lower only when the pointer is elsewhere, so that no button moves away
/// from under it.
void fit_height(Ui& ui, const Region& region, float contents) {
  const float needs = std::round(ui.theme.px(header_at_1 + 12) + contents);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const bool inside = pointer.x >= region.at.x && pointer.x < region.at.x + region.size.x && pointer.y >= region.at.y &&
                      pointer.y < region.at.y + region.size.y;
  if (needs == ui.lab_needs || (needs < ui.lab_needs && inside)) return;
  ui.lab_needs = needs;
  ui.draw_by = std::min(ui.draw_by, ui.now);
}

/// What the button that leads on may say.
constexpr std::array forward_labels{"Skip", "Next", "Finish"};

float button_width(const Ui& ui, const char* label) {
  return text_width(*ui.fonts.text, label) + 2 * ImGui::GetStyle().FramePadding.x;
}

float forward_width(const Ui& ui) {
  float widest = 0;
  for (const char* label : forward_labels) widest = std::max(widest, button_width(ui, label));
  return widest;
}

constexpr float button_gap_at_1 = 6;

bool can_set_up_again(LabRun& run) {
  return run.now().open.has_value();
}

/// What all of them take beside each other, px.
float step_buttons_width(Ui& ui, LabRun& run) {
  const float gap = ui.theme.px(button_gap_at_1);
  const float again = can_set_up_again(run) ? gap + button_width(ui, "Set up again") : 0;
  return button_width(ui, "Back") + gap + forward_width(ui) + again;
}

/// Back and on, which keep their places from step to step, then the one that comes and goes.
void step_buttons(Ui& ui, LabRun& run, ImVec2 at) {
  const bool last = run.step + 1 == run.lab.steps.size(), done = run.record().done, again = can_set_up_again(run);
  const char* forward = forward_labels[last ? 2 : std::size_t(done)];
  // Where Next stood nothing leaves a lab that has not been done; the cross does.
  const bool can = !last || done || cannot_be_done(ui.session);
  const float gap = ui.theme.px(button_gap_at_1);
  ImGui::SetCursorScreenPos(at);
  if (text_button(ui, "Back", false, run.step > 0)) return back_step(ui.session);
  ImGui::SameLine(0, gap);
  // The second click of a double click meets the next step's button, and is not meant for it.
  const bool second = ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseClickedLastCount[0] > 1;
  const bool go = text_button(ui, forward, done, can, forward_width(ui)) && !second;
  if (!can) tooltip(ui, gui::item_id(), "Once the checks hold; × leaves the lab before that, and keeps your progress");
  if (again) {
    ImGui::SameLine(0, gap);
    if (text_button(ui, "Set up again")) set_up_step(ui.session);
  }
  if (!go) return;
  last ? ui.command("leave_lab") : enter_step(ui.session, run.step + 1);
}

/// The title, the buttons where `with_buttons`, and the cross. Returns whether the step's title had room.
bool lab_header(Ui& ui, LabRun& run, const Region& region, bool with_buttons) {
  const Tokens& c = ui.theme.colors;
  const float gap = ui.theme.px(button_gap_at_1);
  float end = region.at.x + region.size.x - ui.theme.px(12 + 22);
  const float middle = region.at.y + ui.theme.px(24), margin = ui.theme.px(16);
  ImGui::SetCursorScreenPos({end, region.at.y + ui.theme.px(13)});
  if (quiet_button(ui, "leave", icon::close, "x", "Leave the lab; your progress is kept")) ui.command("leave_lab");
  if (with_buttons) {
    end -= gap + step_buttons_width(ui, run);
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

}  // namespace

float lab_panel_height(const Ui& ui, float available) {
  if (!ui.session.labs.run) return 0;
  // In a low window some lines are to be seen at once, though the cloth becomes small.
  const float usual = 0.45f * available, some_lines = std::min(0.6f * available, ui.theme.px(header_at_1 + 100));
  const float most = std::round(std::min(ui.theme.px(290), std::max(usual, some_lines)));
  return ui.lab_needs > 0 ? std::min(std::max(ui.lab_needs, ui.theme.px(lowest_strip_at_1)), most) : most;
}

void lab_panel(Ui& ui, const Region& region) {
  const Tokens& c = ui.theme.colors;
  if (!begin_region("lab", region, c.panel, {0, 0})) return end_region();
  LabRun& run = *ui.session.labs.run;
  ImGui::GetWindowDrawList()->AddLine(region.at, {region.at.x + region.size.x, region.at.y}, c.line);
  const bool two = region.size.x >= ui.theme.px(lab_two_columns);
  const bool titled = lab_header(ui, run, region, !two);
  const float margin = ui.theme.px(16), gap = ui.theme.px(20), top = region.at.y + ui.theme.px(header_at_1);
  const float left = region.at.x + margin, width = region.size.x - margin - ui.theme.px(8);
  const float height = region.at.y + region.size.y - top - ui.theme.px(4);
  const float column = two ? std::floor((width - gap) / 2) : width, foot = two ? ui.theme.px(foot_at_1) : 0;
  // In one column the strip is as high as it may be, and the buttons stand in its header.
  if (two) step_buttons(ui, run, {left, top + height - foot + ui.theme.px(2)});
  const std::string id = run.lab.label + std::to_string(run.step);  // each step begins at its top
  begin_lab_column(ui, ("read" + id).c_str(), left, top, {column, height - foot});
  if (!titled) title_part(ui, run);
  reading_part(ui, run);
  // Until the prediction is made it takes the place of what is to be done, so that all choices are seen.
  const bool beside = two && to_be_predicted(run.now(), run.record());
  if (!beside) prediction_part(ui, run.now(), run.record());
  float contents = 0;
  if (two)
    contents = end_lab_column(ui) + foot,
    begin_lab_column(ui, ("do" + id).c_str(), left + column + gap, top, {column, height});
  if (beside) prediction_part(ui, run.now(), run.record());
  // Once a step is done, why comes first: it is what is left to be read.
  const bool waits = lab_waits(ui.session);
  if (!waits) explanation_part(ui, run);
  doing_part(ui, run.now(), run.record());
  if (waits) explanation_part(ui, run);
  end_part(ui, run);
  fit_height(ui, region, std::max(contents, end_lab_column(ui)));
  end_region();
}

}  // namespace tyglab
