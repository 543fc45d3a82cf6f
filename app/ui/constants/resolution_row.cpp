#include "app/ui/constants/constants_panel.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/preset.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

/// "0.93 × 0.93 m"
std::string size_of(const Preset& preset) {
  const auto side = [&](int count) { return short_number(rounded((count - 1) * preset.L, 3)); };
  return side(preset.rows) + " × " + side(preset.columns) + " m";
}

/// The same cloth with as many rows and columns as are wanted: where one of them was left as it is, it follows.
std::optional<Preset> with_same_size(const Preset& now, const Preset& wanted) {
  const bool by_rows = wanted.rows != now.rows;
  const int from = by_rows ? now.rows : now.columns, to = by_rows ? wanted.rows : wanted.columns;
  if (from < 2 || to < 2) return std::nullopt;
  Preset scaled = with_resolution(now, (to - 1.0) / (from - 1));
  const auto as_wanted = [](int scaled_to, int wish, int was) { return wish == was || scaled_to == wish; };
  if (!as_wanted(scaled.rows, wanted.rows, now.rows) || !as_wanted(scaled.columns, wanted.columns, now.columns))
    return std::nullopt;
  return scaled;
}

std::string count_of(const Preset& preset) {
  return std::to_string(preset.rows) + " × " + std::to_string(preset.columns);
}

/// What a finer cloth does not keep, as a further sentence: where single particles carry it, its sag has no limit.
std::string hangs_by_points(const Preset& preset) {
  using enum Pins::Mode;
  const Pins& pins = preset.pins;
  const bool points =
      pins.mode == top_corners || pins.mode == four_corners || (pins.mode == list && !pins.list.empty());
  if (!points || preset.g == 0 || preset.columns == 1) return "";
  return " This cloth hangs by points, so its sag has no limit: the finer it is, the more it sags, by 30 % from 9 to "
         "65 "
         "rows.";
}

/// A button with what it leads to beneath it.
bool answer(Ui& ui, const char* label, const std::string& result, bool strong) {
  const bool clicked = text_button(ui, label, strong);
  ImGui::PushFont(ui.fonts.small);
  wrapped(ui, in_lines(*ui.fonts.small, with_whole_terms(result), ui.row_width), ui.theme.colors.quiet);
  ImGui::PopFont();
  return clicked;
}

/// Once this frame, which still shows the question, is drawn.
void answer_later(Ui& ui, bool same_size) {
  ui.act([same_size](Ui& u) { answer_resolution(u, same_size); });
}

void question_part(Ui& ui, const ResolutionQuestion& question) {
  const Preset& now = ui.session.requested_preset();
  const Preset& more = question.more;
  const bool grows = std::int64_t(more.rows) * more.columns > std::int64_t(now.rows) * now.columns;
  const std::string asks = count_of(now) + " → " + count_of(more) + ": what is meant?";
  wrapped(ui, in_lines(*ui.fonts.text, with_whole_terms(asks), ui.row_width), ui.theme.colors.text);
  if (const auto& same = question.same_size) {
    const std::string result = count_of(*same) + ", " + size_of(now) + " as now; L = " + quantity(same->L, "m", 3) +
                               ", dt = " + quantity(same->dt, "s", 3);
    if (answer(ui, grows ? "Same size, finer" : "Same size, coarser", result, true)) answer_later(ui, true);
    tooltip(ui, gui::item_id(), "This cloth with other springs: mass and stretch behavior stay." + hangs_by_points(now),
            "Enter");
  }
  const std::string result = count_of(more) + ", " + size_of(more) + "; L, m and dt stay";
  if (answer(ui, grows ? "More cloth" : "Less cloth", result, !question.same_size)) answer_later(ui, false);
  tooltip(ui, gui::item_id(),
          grows ? "More springs and particles of this kind: a larger cloth"
                : "Fewer springs and particles of this kind: a smaller cloth",
          "Shift+Enter");
  if (text_button(ui, ("Keep " + count_of(now)).c_str())) return ui.asked_lattice.reset();
  tooltip(ui, gui::item_id(), "Nothing changes", "Esc");
  if (!std::exchange(ui.asked_lattice->shown, true)) ImGui::SetScrollHereY(1);
}

}  // namespace

void ask_resolution(Ui& ui, const Preset& wanted) {
  const Preset& now = ui.session.requested_preset();
  ui.asked_lattice = AskedLattice{{now.rows, now.columns}, now.L, {wanted.rows, wanted.columns}};
}

std::optional<ResolutionQuestion> resolution_question(const Ui& ui) {
  const Preset& now = ui.session.requested_preset();
  const auto& asked = ui.asked_lattice;
  if (!asked || asked->of != glm::ivec2(now.rows, now.columns) || asked->L != now.L || asked->of == asked->wanted)
    return std::nullopt;
  Preset more = now;
  more.rows = asked->wanted.x, more.columns = asked->wanted.y;
  return ResolutionQuestion{more, with_same_size(now, more)};
}

void answer_resolution(Ui& ui, bool same_size) {
  const auto question = resolution_question(ui);
  ui.asked_lattice.reset();
  if (question) ui.session.propose(same_size && question->same_size ? *question->same_size : question->more);
}

void resolution_row(Ui& ui) {
  const std::string tip =
      "Makes the lattice finer or coarser and keeps the size, mass and stretch behavior: R−1 and C−1 times q, L/q, "
      "F_max/q, W/q², dt/q, m·RC/(R'C'). Resistance to folding decreases as the cloth gets finer, since the constant "
      "of bending springs stays. "
      "Tears are repaired." +
      hangs_by_points(ui.session.requested_preset());
  const auto scale = [&](double q) { ui.session.propose(with_resolution(ui.session.requested_preset(), q)); };
  labeled_row(ui, "divide", [&](float) {
    const Preset& preset = ui.session.requested_preset();
    const float gap = ui.theme.px(6);
    const bool coarser = preset.rows >= 3 && (preset.columns >= 3 || preset.columns == 1);
    if (text_button(ui, "÷ 2", false, coarser)) scale(0.5);
    tooltip(ui, gui::item_id(), tip);
    ImGui::SameLine(0, gap);
    const bool finer = preset.rows * 2 - 1 <= 4096 && preset.columns * 2 - 1 <= 4096;
    if (text_button(ui, "× 2", false, finer)) scale(2);
    tooltip(ui, gui::item_id(), tip);
    ImGui::SameLine(0, ui.theme.px(12));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string text = std::to_string(preset.rows * preset.columns) + " particles";
    draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.small,
                     {at.x, baseline_at(ui.fonts, at.y + ui.theme.px(15))}, ui.theme.colors.quiet, text);
    ImGui::Dummy({text_width(*ui.fonts.small, text), ui.theme.px(30)});
  });
  if (const auto question = resolution_question(ui)) question_part(ui, *question);
}

}  // namespace tyglab
