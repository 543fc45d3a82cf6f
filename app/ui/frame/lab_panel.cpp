// The current lab, in a strip below the viewport: what to read at the left; at the right what to predict, then what
// to do, what is checked and why. The buttons stand at the strip's foot, since the strip grows upward as its text does.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/session/lab_check.h"
#include "app/session/observables.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
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
  if (record.looked)
    return marked_line(ui, icon::unknown, "?", c.warning, "Predicted after a look, so not counted: " + said, c.text);
  if (record.right) return marked_line(ui, icon::check, "+", c.good, "You were right: " + said, c.text);
  const std::string answer = number ? with_unit(record.answer, asked.unit) : asked.choices[asked.right];
  marked_line(ui, icon::close, "x", c.warning, "You predicted: " + said, c.text);
  marked_line(ui, icon::check, "+", c.good, "Right: " + answer, c.text);
}

/// Takes what was typed; what is refused leaves the keyboard to the field.
void take_prediction(Ui& ui, const Prediction& asked, const StepRecord& record) {
  std::string why = refusal_of(asked, record.typed);
  ui.lab_field.again = !why.empty();
  if (!why.empty()) return ui.refuse_number(std::move(why));
  ui.accept_number();
  predict(ui.session);
}

void number_field(Ui& ui, const Prediction& asked, StepRecord& record) {
  LabField& field = ui.lab_field;
  field.seen = true;
  // It takes the keys in a frame after the one that asks for that.
  if (field.again) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(ui.theme.px(120));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(7)));
  ImGui::InputTextWithHint("##prediction", "your number", record.typed, sizeof record.typed,
                           field.again ? ImGuiInputTextFlags_AutoSelectAll : 0);
  ImGui::PopStyleVar();
  report_control(ui, "prediction");
  if (ImGui::IsItemActive()) field.again = false;
  const bool in_field = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  wrapped(ui, asked.unit, ui.theme.colors.quiet);
  if (!asked.unit.empty()) ImGui::SameLine();
  const bool enter = field.enter && in_field && !ui.input.unread;
  if (text_button(ui, "Predict", true, record.typed[0] != 0) || enter) take_prediction(ui, asked, record);
}

void choice_list(Ui& ui, const Prediction& asked, StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  for (int k = 0; k < int(asked.choices.size()); ++k) {
    ImGui::PushID(k);
    const bool chosen = record.chosen == k;
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, indent = ui.theme.px(24), pad = ui.theme.px(5);
    const ImFont& font = *ui.fonts.text;
    const std::string words = in_lines(font, asked.choices[std::size_t(k)], width - indent - pad);
    const float height = font.CalcTextSizeA(font.FontSize, 1e9f, 0, words.c_str()).y + 2 * pad;
    if (gui::press_area("choice", {width, height})) record.chosen = k;
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
}

void prediction_part(Ui& ui, const LabStep& step, StepRecord& record) {
  if (!step.prediction) return;
  small_head(ui, "PREDICT", ui.theme.colors.accent);
  set_text(ui, step.prediction->question, ui.theme.colors.text);
  if (record.predicted) return verdict(ui, *step.prediction, record);
  if (record.looked)
    marked_line(ui, icon::warning, "!", ui.theme.colors.warning,
                "Constants were changed before the prediction, so it will not be counted.", ui.theme.colors.text);
  step.prediction->choices.empty() ? number_field(ui, *step.prediction, record)
                                   : choice_list(ui, *step.prediction, record);
}

/// Under the sentences to choose from, which scroll.
void choice_foot(Ui& ui, const StepRecord& record, ImVec2 at) {
  ImGui::SetCursorScreenPos(at);
  if (text_button(ui, "Predict", true, record.chosen >= 0)) predict(ui.session);
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

/// That what is to be found holds already, as that nothing has diverged yet, would tell what is right.
CheckState shown_state(const Condition& check, CheckState state) {
  return check.to_find && state == CheckState::holds ? CheckState::open : state;
}

void check_line(Ui& ui, const LabRun& run, const Condition& check, CheckState state, const CheckMemory& memory) {
  const Tokens& c = ui.theme.colors;
  if (run.record().done)
    return marked_line(ui, icon::check, "+", c.good, with_whole_terms(words_of(check) + compared(run, check)), c.text);
  const std::string words = with_whole_terms(check_in_words(ui.session, check, state, memory));
  state = shown_state(check, state);
  // What must hold to the end holds so far, and is nothing that has been done.
  if (state == CheckState::holds && check.span == Span::throughout)
    return marked_line(ui, icon::check, "+", c.quiet, words, c.quiet);
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

/// The checks that have a line of their own: of those that are found together, the first that does not hold, and above
/// all one that is broken.
std::vector<std::size_t> listed_checks(const LabStep& step, const StepRecord& record) {
  std::vector<std::size_t> listed;
  for (std::size_t k = 0; k < std::min({step.checks.size(), record.checks.size(), record.seen.size()}); ++k) {
    if (record.done || listed.empty() || !found_together(step.checks[listed.back()], step.checks[k])) {
      listed.push_back(k);
      continue;
    }
    const CheckState before = record.checks[listed.back()], now = record.checks[k];
    if (now == CheckState::broken || before == CheckState::holds) listed.back() = k;
  }
  return listed;
}

void checks_part(Ui& ui, const LabStep& step, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  const LabRun& run = *ui.session.labs.run;
  if (step.checks.empty()) return;
  const std::vector<std::size_t> listed = listed_checks(step, record);
  // How many hold: what does not may stand below the column's edge.
  const auto holding = std::count_if(listed.begin(), listed.end(), [&](std::size_t k) {
    return shown_state(step.checks[k], record.checks[k]) == CheckState::holds;
  });
  const std::string count = "CHECK: " + std::to_string(holding) + " OF " + std::to_string(listed.size());
  small_head(ui, record.done ? "CHECK: DONE" : count.c_str(), record.done ? c.good : c.accent);
  for (const std::size_t k : listed) check_line(ui, run, step.checks[k], record.checks[k], record.seen[k]);
  const std::string& awaited = run.awaited;
  if (const Observable* row = find_observable(awaited); row != nullptr && !record.done)
    marked_line(ui, icon::unknown, "?", c.warning, awaited + " · " + std::string(row->hint), c.text);
}

/// The task, and what is checked; a task that is done stands last.
void doing_part(Ui& ui, const LabRun& run) {
  const LabStep& step = run.now();
  const StepRecord& record = run.record();
  const Tokens& c = ui.theme.colors;
  if (lab_waits(ui.session)) return waiting_part(ui);
  const bool first = run.to_be_predicted();
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

}  // namespace

float lab_panel_height(const Ui& ui, float available) {
  if (!ui.session.labs.run) return 0;
  // In a low window some lines are to be seen at once, though the cloth becomes small.
  // With the large text of presentation mode a question's choices need more.
  const float usual = (ui.presenting ? 0.53f : 0.45f) * available;
  const float some_lines = std::min(0.6f * available, ui.theme.px(header_at_1 + 100));
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
  // Until the prediction is made it takes the place of what is to be done, so that all choices are seen.
  const bool asks = run.to_be_predicted(), beside = two && asks;
  const float choice = asks && !run.now().prediction->choices.empty() ? ui.theme.px(foot_at_1) : 0;
  begin_lab_column(ui, ("read" + id).c_str(), left, top, {column, height - (two ? foot : choice)});
  if (!titled) title_part(ui, run);
  reading_part(ui, run);
  if (!beside) prediction_part(ui, run.now(), run.record());
  float contents = 0, last = left;
  if (two) {
    last += column + gap;
    contents = end_lab_column(ui) + foot;
    begin_lab_column(ui, ("do" + id).c_str(), last, top, {column, height - choice});
  }
  if (beside) prediction_part(ui, run.now(), run.record());
  // Once a step is done, why comes first: it is what is left to be read.
  const bool waits = lab_waits(ui.session);
  if (!waits) explanation_part(ui, run);
  doing_part(ui, run);
  if (waits) explanation_part(ui, run);
  end_part(ui, run);
  fit_height(ui, region, std::max(contents, end_lab_column(ui) + choice));
  if (choice > 0) choice_foot(ui, run.record(), {last, top + height - choice + ui.theme.px(2)});
  end_region();
}

}  // namespace tyglab
