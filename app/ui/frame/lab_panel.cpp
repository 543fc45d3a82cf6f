// The current lab, in a column beside the cloth or, in a narrower window, in a strip below it: text, prediction, task,
// checks and explanation. Nothing scrolls; text that does not fit continues on further pages.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/session/lab_check.h"
#include "app/session/lab_state.h"
#include "app/session/observables.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float column_at_1 = 380, strip_at_1 = 140;           // width beside the cloth, least height below it
constexpr float header_at_1 = 40, foot_at_1 = 38;              // of a strip's header, of a row of buttons
constexpr float gap_at_1 = 20, paragraph_at_1 = 6;             // between columns of text, between paragraphs
constexpr float two_columns_from = 480, rows_at_1 = 220;       // width of text in two columns, of constants beside text
constexpr float least_text_at_1 = 300;                         // width of text beside constants
constexpr float column_from = 1280;                            // width of a window, at the display's scale
constexpr float least_cloth = 0.45f, presented_cloth = 0.65f;  // of the window's width
constexpr float most_strip = 0.35f;                            // of its height
constexpr float button_gap_at_1 = 6;

/// Blocks below each other in columns of one height, as many columns as a page has. What is on another page than the
/// one that is shown is only measured.
class Pages {
 public:
  Pages(Ui& ui, const Region& area, int columns) : ui_(ui), area_(area), columns_(columns) {
    width_ = std::floor((area.size.x - float(columns - 1) * ui.theme.px(gap_at_1)) / float(columns));
  }

  float width() const { return width_; }
  int count() const { return column_ / columns_ + 1; }

  /// Blocks of that height together, px, begin on a new page where the present one has no room for them all.
  void keep(float height) {
    const float left = float(columns_ - 1 - column_ % columns_) * area_.size.y + area_.size.y - y_;
    if (height > left && height <= float(columns_) * area_.size.y) column_ = count() * columns_, y_ = 0;
  }

  /// Whether a block of that height, px, is shown: the cursor is at its corner. It stands in one column with `after`
  /// more pixels.
  bool block(float height, float after = 0) {
    if (y_ > 0 && y_ + height + after > area_.size.y) ++column_, y_ = 0;
    const float x = area_.at.x + float(column_ % columns_) * (width_ + ui_.theme.px(gap_at_1));
    ImGui::SetCursorScreenPos({x, area_.at.y + y_});
    y_ += height + ui_.theme.px(paragraph_at_1);
    return column_ / columns_ == ui_.lab_pages.at;
  }

  /// The page of the last block is to be shown.
  void turn_here() {
    if (std::exchange(ui_.lab_pages.at, column_ / columns_) != column_ / columns_) ui_.draw_by = ui_.now;
  }

  /// A paragraph, which goes on in the next column where it must; with a sign before it, if there is one.
  void text(std::string_view words, ImU32 color, const ImFont& font, const char* sign = nullptr, ImU32 sign_color = 0) {
    const float indent = sign != nullptr ? ui_.theme.px(22) : 0, line = font.FontSize;
    std::string_view rest;
    const std::string lines =
        in_lines(font, ui_.input.by_touch ? for_fingers(words) : std::string(words), width_ - indent);
    for (rest = lines; !rest.empty();) {
      const auto all = std::size_t(std::count(rest.begin(), rest.end(), '\n')) + 1;
      if (y_ > 0 && y_ + line * float(std::min<std::size_t>(all, 2)) > area_.size.y) ++column_, y_ = 0;
      const std::size_t fit = std::max<std::size_t>(1, std::size_t(std::max(area_.size.y - y_, 0.f) / line));
      std::size_t end = 0;
      for (std::size_t n = 0; n < fit && end != std::string_view::npos; ++n) end = rest.find('\n', end + (n > 0));
      const std::string_view part = rest.substr(0, end);
      if (block(line * float(std::min(all, fit)))) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        draw_text(draw, font, {at.x + indent, at.y}, color, part);
        if (sign != nullptr) draw_text(draw, font, at, sign_color, sign);
      }
      sign = nullptr;
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    }
  }

 private:
  Ui& ui_;
  Region area_;
  int columns_, column_ = 0;
  float width_, y_ = 0;
};

/// Small capitals over a part, which is shown at once if `turn`.
void small_head(Ui& ui, Pages& pages, const char* text, ImU32 color, bool turn = false) {
  const ImFont& font = *ui.fonts.small;
  const bool seen =
      pages.block(font.FontSize - ui.theme.px(3), 2 * ui.fonts.text->FontSize + ui.theme.px(paragraph_at_1));
  if (turn) pages.turn_here();
  if (seen) draw_text(*ImGui::GetWindowDrawList(), font, ImGui::GetCursorScreenPos(), color, text);
}

void set_text(Ui& ui, Pages& pages, std::string_view text, ImU32 color) {
  pages.text(text, color, *ui.fonts.text);
}

void paragraphs_of(Ui& ui, Pages& pages, const Paragraphs& text, ImU32 color) {
  for (const std::string& paragraph : text) set_text(ui, pages, paragraph, color);
}

/// A paragraph with an icon before it (or a sign, where the icon font is missing), in which words say the same.
void marked_line(Ui& ui, Pages& pages, const char* glyph, const char* sign, ImU32 color, const std::string& text,
                 ImU32 text_color) {
  pages.text(text, text_color, *ui.fonts.text, icon_or(ui.fonts, glyph, sign), color);
}

std::string with_unit(double value, std::string_view unit) {
  return short_number(value) + (unit.empty() ? "" : " " + std::string(unit));
}

/// What was predicted, and, once the step is done, whether it came true.
void verdict(Ui& ui, Pages& pages, const Prediction& asked, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  const bool number = asked.choices.empty();
  const std::string said = number ? with_unit(typed_number(record.typed, asked.unit).value_or(0), asked.unit)
                                  : asked.choices[std::size_t(record.chosen)];
  if (!record.done) return marked_line(ui, pages, icon::right, ">", c.accent, "You predict: " + said, c.text);
  // What the step has measured is said beside what was predicted, even if that is near enough.
  const bool measured = number && !asked.answer.name.empty();
  const std::string answer = number ? with_unit(rounded(record.answer, 3), asked.unit) : asked.choices[asked.right];
  if (record.right && !record.looked)
    return marked_line(ui, pages, icon::check, "+", c.good,
                       "You were right: " + said + (measured ? "; measured: " + answer : ""), c.text);
  if (record.looked)
    marked_line(ui, pages, icon::unknown, "?", c.warning,
                "Predicted after constants were changed, so not counted: " + said, c.text);
  else
    marked_line(ui, pages, icon::close, "x", c.warning, "You predicted: " + said, c.text);
  marked_line(ui, pages, icon::check, "+", c.good, (measured ? "Measured: " : "Right: ") + answer, c.text);
}

/// Takes what was typed; what is refused leaves the keyboard to the field.
void take_prediction(Ui& ui, const Prediction& asked, const StepRecord& record) {
  std::string why = refusal_of(asked, record.typed);
  ui.lab_field.again = !why.empty();
  if (!why.empty()) return ui.refuse_number(std::move(why));
  ui.accept_number();
  predict(ui.session);
}

float button_width(const Ui& ui, const char* label) {
  return text_width(*ui.fonts.text, label) + 2 * ImGui::GetStyle().FramePadding.x;
}

/// The field, its unit and the button in one row of that width, px.
void number_field(Ui& ui, const Prediction& asked, StepRecord& record, float width) {
  constexpr float least = 60, usual = 120;  // of the field, pixels at scale 1
  LabField& field = ui.lab_field;
  field.waits = field.shown = true;
  const float gap = ImGui::GetStyle().ItemSpacing.x,
              unit = asked.unit.empty() ? 0 : text_width(*ui.fonts.text, asked.unit) + gap,
              room = width - gap - unit - button_width(ui, "Predict");
  // It takes the keys in a frame after the one that asks for that.
  if (field.again) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(std::clamp(room, ui.theme.px(least), ui.theme.px(usual)));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(7)));
  ImGui::InputTextWithHint("##prediction", "your number", record.typed, sizeof record.typed,
                           field.again ? ImGuiInputTextFlags_AutoSelectAll : 0);
  ImGui::PopStyleVar();
  report_control(ui, "prediction");
  if (ImGui::IsItemActive()) field.again = false;
  const bool in_field = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  ImGui::SameLine();
  if (!asked.unit.empty()) {
    ImGui::AlignTextToFramePadding();
    wrapped(ui, asked.unit, ui.theme.colors.quiet);
    ImGui::SameLine();
  }
  const bool enter = field.enter && in_field && !ui.input.unread;
  if (text_button(ui, "Predict", true, record.typed[0] != 0) || enter) take_prediction(ui, asked, record);
}

/// The sentences to choose from with their heights, px.
struct Choices {
  std::vector<std::string> words;
  std::vector<float> heights;
};

Choices choices_of(const Ui& ui, const Prediction& asked, float width) {
  const ImFont& font = *ui.fonts.text;
  const float pad = ui.theme.px(5);
  Choices out;
  for (const std::string& choice : asked.choices) {
    out.words.push_back(in_lines(font, choice, width - ui.theme.px(24) - pad));
    out.heights.push_back(font.CalcTextSizeA(font.FontSize, 1e9f, 0, out.words.back().c_str()).y + 2 * pad);
  }
  return out;
}

void one_choice(Ui& ui, const std::string& words, ImVec2 size, bool chosen) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.text;
  const ImVec2 lo = ImGui::GetItemRectMin();
  const float pad = ui.theme.px(5);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (chosen || ImGui::IsItemHovered())
    draw.AddRectFilled(lo, {lo.x + size.x, lo.y + size.y}, chosen ? mixed(c.field, c.accent, 0.25f) : c.field,
                       ui.theme.px(5));
  const ImVec2 middle{lo.x + ui.theme.px(12), lo.y + pad + std::round(font.FontSize / 2)};
  draw.AddCircle(middle, ui.theme.px(5.5f), chosen ? c.accent : c.quiet, 20, std::max(1.f, ui.theme.px(1.5f)));
  if (chosen) draw.AddCircleFilled(middle, ui.theme.px(3), c.accent, 16);
  draw_text(draw, font, {lo.x + ui.theme.px(24), lo.y + pad}, c.text, words);
}

void choice_list(Ui& ui, Pages& pages, const Choices& choices, StepRecord& record) {
  for (int k = 0; k < int(choices.words.size()); ++k) {
    const ImVec2 size{pages.width(), choices.heights[std::size_t(k)]};
    if (!pages.block(size.y)) continue;
    ui.lab_field.waits = true;
    ImGui::PushID(k);
    if (gui::press_area("choice", size)) record.chosen = k;
    report_control(ui, "choice." + std::to_string(k + 1));
    one_choice(ui, choices.words[std::size_t(k)], size, record.chosen == k);
    ImGui::PopID();
  }
  if (pages.block(ui.theme.px(30)) && text_button(ui, "Predict", true, record.chosen >= 0)) predict(ui.session);
}

void prediction_part(Ui& ui, Pages& pages, const LabStep& step, StepRecord& record) {
  if (!step.prediction) return;
  const Tokens& c = ui.theme.colors;
  const Prediction& asked = *step.prediction;
  const Choices choices = choices_of(ui, asked, pages.width());
  const std::string question = in_lines(*ui.fonts.text, asked.question, pages.width());
  // The question and all that answers it are seen at once where a page has room for them.
  float all = ui.fonts.text->FontSize * float(2 + std::count(question.begin(), question.end(), '\n')) + ui.theme.px(60);
  if (!record.predicted)
    for (const float height : choices.heights) all += height + ui.theme.px(paragraph_at_1);
  pages.keep(all);
  small_head(ui, pages, "PREDICT", c.accent);
  set_text(ui, pages, asked.question, c.text);
  if (record.predicted) return verdict(ui, pages, asked, record);
  if (record.looked)
    marked_line(ui, pages, icon::warning, "!", c.warning,
                "Constants were changed before the prediction, so it will not be counted.", c.text);
  if (!asked.choices.empty()) return choice_list(ui, pages, choices, record);
  if (pages.block(ui.fonts.text->FontSize + ui.theme.px(14))) number_field(ui, asked, record, pages.width());
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

void check_line(Ui& ui, Pages& pages, const LabRun& run, const Condition& check, CheckState state,
                const CheckMemory& memory) {
  const Tokens& c = ui.theme.colors;
  const std::string words = with_whole_terms(check_in_words(ui.session, check, state, memory));
  if (run.record().done) {
    const std::string done = with_whole_terms(words_of(check) + compared(run, check));
    return marked_line(ui, pages, icon::check, "+", c.good, check.span == Span::narrowed ? words : done, c.text);
  }
  state = shown_state(check, state);
  // What must hold to the end holds so far, and is nothing that has been done.
  if (state == CheckState::holds && check.span == Span::throughout)
    return marked_line(ui, pages, icon::check, "+", c.quiet, words, c.quiet);
  if (state == CheckState::holds) return marked_line(ui, pages, icon::check, "+", c.good, words, c.text);
  if (state == CheckState::open) return marked_line(ui, pages, icon::circle, "o", c.quiet, words, c.text);
  if (state == CheckState::broken) return marked_line(ui, pages, icon::close, "x", c.warning, words, c.text);
  marked_line(ui, pages, icon::unknown, "?", c.warning, words, c.text);
}

/// The experiment that the lab has taken the place of.
void back_button(Ui& ui, Pages& pages) {
  if (ui.session.labs.kept.empty() || !pages.block(ui.theme.px(30))) return;
  if (text_button(ui, "Back to your experiment")) ui.command("back_to_experiment");
}

/// Another preset is open than the lab's: what it means, and the ways on.
void waiting_part(Ui& ui, Pages& pages) {
  const Tokens& c = ui.theme.colors;
  marked_line(ui, pages, icon::pause, "!", c.warning,
              "“" + ui.session.preset().name +
                  "” is open, which is not this lab's cloth. The lab is paused and checks nothing.",
              c.text);
  if (pages.block(ui.theme.px(30))) {
    if (text_button(ui, "Open the lab's cloth", true)) resume_lab(ui.session);
    ImGui::SameLine();
    if (text_button(ui, "Leave the lab")) ui.command("leave_lab");
  }
  back_button(ui, pages);
}

void task_part(Ui& ui, Pages& pages, const LabStep& step, bool turn = false) {
  if (step.todo.empty()) return;
  small_head(ui, pages, "DO", ui.theme.colors.accent, turn);
  paragraphs_of(ui, pages, step.todo, ui.theme.colors.text);
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

void checks_part(Ui& ui, Pages& pages, const LabStep& step, const StepRecord& record) {
  const Tokens& c = ui.theme.colors;
  const LabRun& run = *ui.session.labs.run;
  if (step.checks.empty()) return;
  const std::vector<std::size_t> listed = listed_checks(step, record);
  // How many hold: what does not may stand below the column's edge.
  const auto holding = std::count_if(listed.begin(), listed.end(), [&](std::size_t k) {
    return shown_state(step.checks[k], record.checks[k]) == CheckState::holds;
  });
  const std::string count = "CHECK: " + std::to_string(holding) + " OF " + std::to_string(listed.size());
  small_head(ui, pages, record.done ? "CHECK: DONE" : count.c_str(), record.done ? c.good : c.accent);
  for (const std::size_t k : listed) check_line(ui, pages, run, step.checks[k], record.checks[k], record.seen[k]);
  const std::string& awaited = run.awaited;
  if (const Observable* row = find_observable(awaited); row != nullptr && !record.done)
    marked_line(ui, pages, icon::unknown, "?", c.warning, awaited + " · " + std::string(row->hint), c.text);
}

/// The task, and what is checked; a task that is done stands last.
void doing_part(Ui& ui, Pages& pages, const LabRun& run, bool turn) {
  const LabStep& step = run.now();
  const StepRecord& record = run.record();
  const Tokens& c = ui.theme.colors;
  if (lab_waits(ui.session)) return waiting_part(ui, pages);
  const bool first = run.to_be_predicted();
  if (cannot_be_done(ui.session))
    return marked_line(ui, pages, icon::warning, "!", c.warning,
                       first
                           ? "This machine has no OpenCL device, so there is nothing to do here: predict, and read on."
                           : "This machine has no OpenCL device, so there is nothing to do here: read on.",
                       c.text);
  if (first) return set_text(ui, pages, "Predict first; then the task appears here.", c.quiet);
  if (!record.done) task_part(ui, pages, step, turn);
  checks_part(ui, pages, step, record);
  if (record.done) task_part(ui, pages, step);
}

void explanation_part(Ui& ui, Pages& pages, LabRun& run) {
  if (!run.record().done || run.now().explanation.empty()) return;
  small_head(ui, pages, "WHY", ui.theme.colors.accent, std::exchange(run.show_explanation, false));
  paragraphs_of(ui, pages, run.now().explanation, ui.theme.colors.text);
}

/// "Step 1 of 3".
std::string step_text(const LabRun& run) {
  return "Step " + std::to_string(run.step + 1) + " of " + std::to_string(run.lab.steps.size());
}

/// What of a step's head stands over its pages.
struct HeadParts {
  bool place = true, title = true;
};

/// What the step says, with what its head has no room for.
void step_parts(Ui& ui, Pages& pages, LabRun& run, HeadParts head) {
  const Tokens& c = ui.theme.colors;
  const StepRecord& record = run.record();
  if (!head.place) pages.text(step_text(run), c.quiet, *ui.fonts.small);
  if (!head.title) pages.text(run.now().title, c.text, *ui.fonts.title);
  if (run.step == 0 && !record.done) paragraphs_of(ui, pages, run.lab.summary, c.quiet);
  paragraphs_of(ui, pages, run.now().text, c.text);
  prediction_part(ui, pages, run.now(), run.record());
  // Once a step is done, why comes first: it is what is left to be read.
  const bool waits = lab_waits(ui.session), asks = run.to_be_predicted();
  const bool turn = std::exchange(ui.lab_pages.asks, asks) && !asks;
  if (!waits) explanation_part(ui, pages, run);
  doing_part(ui, pages, run, turn);
  if (waits) explanation_part(ui, pages, run);
  if (record.done && run.step + 1 == run.lab.steps.size()) back_button(ui, pages);
}

float wider(const Ui& ui, const char* one, const char* other) {
  return std::max(button_width(ui, one), button_width(ui, other));
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
                (last ? "× leaves the lab before that, and keeps your progress" : "Skip continues without that"));
  if (go) last ? ui.command("leave_lab") : enter_step(ui.session, run.step + 1);
}

/// Past a step that is not done, and at the end to the next lab. Never where Next stands, which may be hit twice.
void skip_button(Ui& ui, LabRun& run, bool can_go_on) {
  const bool last = run.step + 1 == run.lab.steps.size(), can = last == can_go_on;
  if (!text_button(ui, last ? "Next lab" : "Skip", false, can, wider(ui, "Skip", "Next lab")) || second_click()) return;
  last ? ui.command("next_lab") : enter_step(ui.session, run.step + 1);
}

/// What Back, Next, Skip and, with `again`, Set up again take, px; the same in every step, so that each keeps its
/// place.
float step_buttons_width(const Ui& ui, bool again) {
  const float gap = ui.theme.px(button_gap_at_1);
  return button_width(ui, "Back") + wider(ui, "Next", "Finish") + wider(ui, "Skip", "Next lab") + 2 * gap +
         (again ? button_width(ui, "Set up again") + gap : 0);
}

void step_buttons(Ui& ui, LabRun& run, ImVec2 at, bool again) {
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
  if (run.step != step || !again || !run.now().open) return;
  ImGui::SameLine(0, gap);
  if (text_button(ui, "Set up again")) set_up_step(ui.session);
}

std::string page_text(const LabPages& pages) {
  return std::to_string(pages.at + 1) + " of " + std::to_string(pages.count);
}

float page_turner_width(const Ui& ui) {
  return text_width(*ui.fonts.small, page_text(ui.lab_pages)) + ui.theme.px(2 * 22 + 8);
}

/// Back and forth between the pages of the step; also by the wheel.
void page_turner(Ui& ui, ImVec2 at) {
  LabPages& pages = ui.lab_pages;
  const std::string text = page_text(pages);
  const float side = ui.theme.px(22), words = text_width(*ui.fonts.small, text) + ui.theme.px(8);
  ImGui::SetCursorScreenPos(at);
  int by = quiet_button(ui, "page_back", icon::left, "<", "The page before") ? -1 : 0;
  draw_text(*ImGui::GetWindowDrawList(), *ui.fonts.small,
            {at.x + side + ui.theme.px(4), std::round(at.y + (side - ui.fonts.small->FontSize) / 2)},
            ui.theme.colors.text, text);
  ImGui::SetCursorScreenPos({at.x + side + words, at.y});
  if (quiet_button(ui, "page_on", icon::right, ">", "The next page")) by = 1;
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) pages.wheel += ImGui::GetIO().MouseWheel;
  if (std::abs(pages.wheel) >= 1) by = std::exchange(pages.wheel, 0.f) > 0 ? -1 : 1;
  pages.at = std::clamp(pages.at + by, 0, pages.count - 1);
}

/// "Step 1 of 3 · Hooke's law", as far as it has room.
std::string place_text(const Ui& ui, const LabRun& run, float room) {
  return fitted(*ui.fonts.small, step_text(run) + " · " + run.lab.title, room);
}

/// The step's constants, in sight where the column of constants is not.
float checked_rows(Ui& ui, ImVec2 at, float width, bool measure = false) {
  const std::vector<const PresetRow*> rows = checked_constants(ui);
  const float height = float(std::min<std::size_t>(rows.size(), 2)) * (row_columns(ui).height + ui.theme.px(2));
  if (measure || rows.empty()) return height;
  ImGui::SetCursorScreenPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(2)));
  gui::begin_child("constants", {width, height});
  ui.row_width = width - ui.theme.px(4);
  for (std::size_t k = 0; k < std::min<std::size_t>(rows.size(), 2); ++k) constant_row(ui, *rows[k]);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  return height;
}

void leave_button(Ui& ui, ImVec2 at) {
  ImGui::SetCursorScreenPos(at);
  if (quiet_button(ui, "leave", icon::close, "x", "Leave the lab; your progress is kept")) ui.command("leave_lab");
}

void draw_step(Ui& ui, LabRun& run, const Region& area, int columns, HeadParts head) {
  Pages pages(ui, area, columns);
  step_parts(ui, pages, run, head);
  LabPages& seen = ui.lab_pages;
  if (std::exchange(seen.count, pages.count()) != seen.count) ui.draw_by = ui.now;
  seen.at = std::min(seen.at, seen.count - 1);
}

/// Beside the cloth: the step's title, all it says, its constants where they are not in sight, and the buttons.
void lab_in_column(Ui& ui, LabRun& run, const Region& region, bool with_constants) {
  const Tokens& c = ui.theme.colors;
  const float margin = ui.theme.px(16), left = region.at.x + margin, width = region.size.x - 2 * margin;
  const float end = left + width;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  float y = region.at.y + ui.theme.px(6);
  leave_button(ui, {end - ui.theme.px(18), y});
  const std::string title = in_lines(*ui.fonts.title, run.now().title, width - ui.theme.px(30));
  draw_text(draw, *ui.fonts.title, {left, y}, c.text, title);
  y += ui.fonts.title->CalcTextSizeA(ui.fonts.title->FontSize, 1e9f, 0, title.c_str()).y + ui.theme.px(4);
  const bool turns = ui.lab_pages.count > 1;
  const float turner = turns ? page_turner_width(ui) : 0;
  draw_text(draw, *ui.fonts.small, {left, y}, c.quiet, place_text(ui, run, width - turner));
  if (turns) page_turner(ui, {end - turner, std::round(y + (ui.fonts.small->FontSize - ui.theme.px(22)) / 2)});
  y += ui.fonts.small->FontSize + ui.theme.px(12);

  float foot = region.at.y + region.size.y - ui.theme.px(foot_at_1);
  step_buttons(ui, run, {left, foot}, step_buttons_width(ui, true) <= width);
  if (with_constants) {
    foot -= checked_rows(ui, {}, width, true) + ui.theme.px(6);
    checked_rows(ui, {left, foot}, width);
  }
  draw_step(ui, run, {{left, y}, {width, std::max(foot - ui.theme.px(8) - y, 1.f)}}, 1, {});
}

/// Below the cloth: everything but the text stands in one row over it.
void lab_in_strip(Ui& ui, LabRun& run, const Region& region, bool with_constants) {
  const Tokens& c = ui.theme.colors;
  const float margin = ui.theme.px(16), gap = ui.theme.px(button_gap_at_1);
  const float left = region.at.x + margin, width = region.size.x - 2 * margin, top = region.at.y + ui.theme.px(4);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  float end = left + width - ui.theme.px(18);
  leave_button(ui, {end, region.at.y + ui.theme.px(8)});
  const float turner = ui.lab_pages.count > 1 ? page_turner_width(ui) : 0;
  const bool again = end - turner - step_buttons_width(ui, true) - 3 * gap >= left;
  end -= gap + step_buttons_width(ui, again);
  step_buttons(ui, run, {end, top}, again);
  if (turner > 0) end -= 2 * gap + turner, page_turner(ui, {end, region.at.y + ui.theme.px(8)});
  end -= 2 * gap;
  // The place among the steps goes first: the title may stand over the text.
  const float baseline = baseline_at(ui.fonts, top + ui.theme.px(15)),
              title = text_width(*ui.fonts.title, run.now().title) + ui.theme.px(10),
              place = text_width(*ui.fonts.small, step_text(run));
  const HeadParts head{.place = left + place <= end, .title = left + title + place <= end};
  if (head.title) draw_on_baseline(draw, *ui.fonts.title, {left, baseline}, c.text, run.now().title);
  const float x = head.title ? left + title : left;
  if (head.place) draw_on_baseline(draw, *ui.fonts.small, {x, baseline}, c.quiet, place_text(ui, run, end - x));

  Region area{{left, region.at.y + ui.theme.px(header_at_1)}, {width, region.size.y - ui.theme.px(header_at_1 + 4)}};
  if (with_constants && !checked_constants(ui).empty()) {
    const float rows = std::min(ui.theme.px(rows_at_1), std::floor(width / 2)), beside = rows + ui.theme.px(gap_at_1);
    const float above = checked_rows(ui, {}, width, true) + ui.theme.px(paragraph_at_1);
    // Where lines beside them would be short, as on a phone, they stand above the text, if that keeps most of the room.
    if (width - beside < ui.theme.px(least_text_at_1) && above < area.size.y / 2) {
      checked_rows(ui, area.at, width);
      area.at.y += above, area.size.y -= above;
    } else {
      checked_rows(ui, area.at, rows);
      area.at.x += beside, area.size.x -= beside;
    }
  }
  draw_step(ui, run, area, area.size.x >= ui.theme.px(two_columns_from) ? 2 : 1, head);
}

}  // namespace

float lab_column_width(const Ui& ui, float window) {
  if (window < column_from * ui.theme.display) return 0;
  return std::floor(std::min(ui.theme.px(column_at_1), (1 - (ui.presenting ? presented_cloth : least_cloth)) * window));
}

float room_beside_cloth(float window) {
  return std::floor((1 - least_cloth) * window);
}

float lab_strip_height(const Ui& ui, float window, float available) {
  return std::round(std::max(most_strip * window, std::min(ui.theme.px(strip_at_1), 0.6f * available)));
}

void lab_panel(Ui& ui, const Region& region, bool column, bool with_constants) {
  if (!begin_region("lab", region, ui.theme.colors.panel, {0, 0})) return end_region();
  LabRun& run = *ui.session.labs.run;
  const std::string step = run.lab.label + std::to_string(run.step);
  if (ui.lab_pages.step != step) ui.lab_pages = {step};
  if (!column)
    ImGui::GetWindowDrawList()->AddLine(region.at, {region.at.x + region.size.x, region.at.y}, ui.theme.colors.line);
  column ? lab_in_column(ui, run, region, with_constants) : lab_in_strip(ui, run, region, with_constants);
  end_region();
}

}  // namespace tyglab
