#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <sstream>

#include "app/base/text.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

// Pixels at scale 1.
constexpr float text_line_at_1 = 18, name_at_1 = 64, force_unit_at_1 = 52;
constexpr float spring_force_end_at_1 = 230, spring_force_at_1 = 62;  // where that column ends, and its width

std::string site(int i, int j) {
  return "(" + std::to_string(i) + ", " + std::to_string(j) + ")";
}

/// dt to a power, as it is written: "dt²", "1/dt".
std::string power_of_dt(int power) {
  return power == 0    ? ""
         : power == 1  ? "dt"
         : power == 2  ? "dt²"
         : power == -1 ? "1/dt"
                       : "dt^" + std::to_string(power);
}

/// A factor of a table: a fraction with a small denominator where it is one.
std::string factor_text(double factor) {
  if (factor == 1) return "";
  for (const int below : {1, 2, 3, 6, 8}) {
    const double above = std::abs(factor) * below;
    if (std::abs(above - std::round(above)) > 1e-12) continue;
    return std::to_string(int(std::round(above))) + (below == 1 ? "" : "/" + std::to_string(below));
  }
  return short_number(std::abs(factor));
}

std::string scale_text(const TracedTerm& term) {
  const std::string factor = factor_text(term.factor), dt = power_of_dt(term.dt_power);
  return factor + (factor.empty() || dt.empty() ? "" : " ") + dt;
}

/// Beside a name that begins at `lo`, or, where it is too long for that, below it in as many lines as it needs.
void value_text(Ui& ui, ImVec2 lo, const std::string& text, ImU32 color) {
  const ImFont& mono = *ui.fonts.mono;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float height = ui.theme.px(text_line_at_1), name = ui.theme.px(name_at_1), indent = ui.theme.px(12);
  const float whole = ImGui::GetContentRegionAvail().x;
  float baseline = baseline_at(ui.fonts, std::round(lo.y + height / 2)), taken = height;
  if (text_width(mono, text) <= whole - name) {
    draw_on_baseline(draw, mono, {lo.x + name, baseline}, color, text);
  } else {
    std::istringstream lines(in_lines(mono, with_whole_terms(text), whole - indent));
    for (std::string row; std::getline(lines, row); taken += height)
      draw_on_baseline(draw, mono, {lo.x + indent, baseline += height}, color, row);
  }
  ImGui::Dummy({whole, taken});
}

void line(Ui& ui, const std::string& name, const std::string& text, ImU32 color) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float baseline = baseline_at(ui.fonts, std::round(lo.y + ui.theme.px(text_line_at_1) / 2));
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.small, {lo.x, baseline}, ui.theme.colors.quiet, name);
  value_text(ui, lo, text, color);
}

void words(Ui& ui, const std::string& text, ImU32 color) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushTextWrapPos(0);
  wrapped(ui, text, color);
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
}

/// What three numbers share, so that each has few digits: their unit, or a power of ten where they have none.
ScaledUnit shared_by(const glm::dvec3& value, std::string_view unit) {
  const double largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
  if (!unit.empty()) return scaled_unit(largest, unit);
  const int power = largest > 0 ? 3 * int(std::floor(std::log10(largest) / 3)) : 0;
  if (power == 0) return {1, ""};
  const std::string factor = with_power("1e" + std::to_string(power));
  return {std::pow(10, power), factor.substr(factor.find("10"))};
}

/// Three numbers in columns, to the right of `indent`, px.
void number_columns(Ui& ui, float indent, const glm::dvec3& value, ImU32 color) {
  const ImFont& mono = *ui.fonts.mono;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float height = ui.theme.px(text_line_at_1), whole = ImGui::GetContentRegionAvail().x;
  const float column = std::floor((whole - indent) / 3),
              baseline = baseline_at(ui.fonts, std::round(lo.y + height / 2));
  for (int k = 0; k < 3; ++k) {
    const std::string text = table_number(value[k]);
    const float x = lo.x + indent + float(k + 1) * column - text_width(mono, text);
    draw_on_baseline(*ImGui::GetWindowDrawList(), mono, {x, baseline}, color, text);
  }
  ImGui::Dummy({whole, height});
}

/// Whether a vector with its unit has room beside a name.
bool fits_beside(const Ui& ui, const glm::dvec3& value, std::string_view unit) {
  const std::string text = steady_vector(value) + " " + std::string(unit);
  return text_width(*ui.fonts.mono, text) <= ImGui::GetContentRegionAvail().x - ui.theme.px(name_at_1);
}

/// In a narrow card the unit stands with the name, and the numbers in columns below.
void vector_line(Ui& ui, const std::string& name, const glm::dvec3& value, std::string_view unit, ImU32 color) {
  const std::string after = unit.empty() ? "" : " " + std::string(unit);
  if (fits_beside(ui, value, unit)) return line(ui, name, steady_vector(value) + after, color);
  const ScaledUnit shared = shared_by(value, unit);
  const char* const before = unit.empty() ? " " : ", ";
  line(ui, shared.name.empty() ? name : name + before + shared.name, "", color);
  number_columns(ui, 0, value / shared.size, color);
}

/// A symbol of table B.1 with its color, and its value.
void force_line(Ui& ui, std::string_view key, const glm::dvec3& value) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float height = ui.theme.px(text_line_at_1), middle = std::round(lo.y + height / 2), sample = ui.theme.px(18);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 ends[2] = {{lo.x, middle}, {lo.x + sample, middle}};
  draw_styled_line(draw, ends, 2, curve_style(ui.theme.colors, key), ui.theme.scale);
  draw_symbol(draw, ui.fonts, {lo.x + sample + ui.theme.px(6), baseline_at(ui.fonts, middle)}, key,
              ui.theme.colors.text);
  if (fits_beside(ui, value, "N")) return value_text(ui, lo, steady_vector(value) + " N", ui.theme.colors.text);
  const ScaledUnit shared = shared_by(value, "N");
  draw_on_baseline(draw, *ui.fonts.small, {lo.x + ui.theme.px(force_unit_at_1), baseline_at(ui.fonts, middle)},
                   ui.theme.colors.quiet, shared.name);
  ImGui::Dummy({0, height});
  number_columns(ui, 0, value / shared.size, ui.theme.colors.text);
}

/// A row of the springs' table: texts that end at its columns, after one at the left.
void spring_row(Ui& ui, const ImFont& font, const std::string& left, const std::string& middle,
                const std::string& right, ImU32 color) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float whole = ImGui::GetContentRegionAvail().x, height = ui.theme.px(text_line_at_1),
              baseline = baseline_at(ui.fonts, std::round(lo.y + height / 2)),
              end = std::min(whole, ui.theme.px(spring_force_end_at_1)), before = end - ui.theme.px(spring_force_at_1);
  draw_on_baseline(draw, *ui.fonts.small, {lo.x, baseline}, ui.theme.colors.quiet, left);
  draw_on_baseline(draw, font, {lo.x + before - text_width(font, middle), baseline}, color, middle);
  draw_on_baseline(draw, font, {lo.x + end - text_width(font, right), baseline}, color, right);
  ImGui::Dummy({whole, height});
}

/// Every spring: where to, how far it is stretched, what it does.
void springs(Ui& ui, const TracedStage& stage) {
  const Tokens& c = ui.theme.colors;
  const auto is_spring = [](const StencilForce& one) { return one.force->conserves; };
  double strongest = 0;
  for (const StencilForce& one : stage.stencils)
    if (is_spring(one)) strongest = std::max(strongest, glm::length(one.F));
  if (std::none_of(stage.stencils.begin(), stage.stencils.end(), is_spring)) return;
  const ScaledUnit newtons = scaled_unit(strongest, "N");
  spring_row(ui, *ui.fonts.small, "spring to", "stretch, %", "force, " + newtons.name, c.quiet);
  for (const StencilForce& spring : stage.stencils) {
    if (!is_spring(spring)) continue;
    std::array<char, 40> stretch;
    const double percent = 100 * (spring.length / spring.rest - 1), size = glm::length(spring.F);
    std::snprintf(stretch.data(), stretch.size(), "%+.2f", std::abs(percent) < 0.005 ? 0 : percent);
    const ImU32 color = size > 0 ? curve_style(c, spring.force->symbol).color : c.quiet;
    spring_row(ui, *ui.fonts.mono, site(spring.other_i, spring.other_j), stretch.data(),
               table_number(size / newtons.size), color);
  }
}

void force_lines(Ui& ui, const TracedStage& stage) {
  const Preset& preset = ui.session.preset();
  const auto on = by_key(stage.forces);
  for (const std::string_view key : shown_force_keys(preset))
    if (key != "F_int" && key != "F_ext" && key != "F") force_line(ui, key, on[key]);
  force_line(ui, "F", on["F"]);
  vector_line(ui, "a = F/m", stage.a, "m/s²", ui.theme.colors.text);
  words(ui, "with m = " + short_number(preset.m) + " kg", ui.theme.colors.quiet);
}

void assignment(Ui& ui, const Scheme& method, const TracedAssignment& what) {
  const Tokens& c = ui.theme.colors;
  const std::string target = vector_name(method, what.target);
  ImGui::Dummy({0, ui.theme.px(4)});
  line(ui, target + " ←", formula_of(method, what), c.accent);
  for (const TracedTerm& term : what.terms) {
    const std::string scale = scale_text(term);
    vector_line(ui, scale.empty() ? "" : scale + " ·", term.value, "", c.quiet);
  }
  vector_line(ui, "=", what.result, "", c.text);
}

void stage_text(Ui& ui, const StepTrace& trace, std::size_t n) {
  const Tokens& c = ui.theme.colors;
  const Scheme& method = scheme(trace.integrator);
  const TracedStage& stage = trace.stages[n];
  ImGui::PushFont(ui.fonts.title);
  wrapped(ui,
          trace.stages.size() > 1 ? "Evaluation " + std::to_string(n + 1) + " of " + std::to_string(trace.stages.size())
                                  : "Forces",
          c.text);
  ImGui::PopFont();
  vector_line(ui, "x", stage.x, "m", c.text);
  vector_line(ui, method.lag != 0 ? "v, seen" : "v", stage.v, "m/s", c.text);
  if (method.lag != 0) words(ui, "the velocity that damping uses: between two steps, or predicted", c.quiet);
  springs(ui, stage);
  force_lines(ui, stage);
  if (!trace.whole) return;
  for (const TracedAssignment& what : stage.assignments) assignment(ui, method, what);
  ImGui::Dummy({0, ui.theme.px(8)});
}

void result(Ui& ui, const StepTrace& trace) {
  const Tokens& c = ui.theme.colors;
  if (!trace.whole)
    words(
        ui,
        "This method solves equations, projects, or chooses its own steps, so its step is not a sum of these numbers. "
        "Its result:",
        c.quiet);
  vector_line(ui, "x, new", trace.x_after, "m", c.text);
  if (trace.whole)
    words(ui,
          "Computed in double from the method's coefficients. The engine rounds each sum to the chosen precision, "
          "and bodies correct position and velocity after it.",
          c.quiet);
}

std::string step_heading(const StepTrace& trace) {
  return std::string(scheme(trace.integrator).title) + ", particle " + site(trace.i, trace.j) +
         ", dt = " + short_number(trace.dt) + " s";
}

}  // namespace

std::string formula_of(const Scheme& method, const TracedAssignment& assignment) {
  std::string text;
  for (const TracedTerm& term : assignment.terms) {
    const std::string scale = scale_text(term);
    text += text.empty() ? (term.factor < 0 ? "−" : "") : term.factor < 0 ? " − " : " + ";
    text += scale + (scale.empty() ? "" : " ") + vector_name(method, term.vector);
  }
  return text;
}

void inside_step(Ui& ui, ImVec2 size) {
  const StepTrace* trace = ui.session.inspector.shown();
  if (trace == nullptr) {
    const bool large = ui.session.simulation->lattice().size() > StepInspector::largest;
    return words(ui,
                 ui.session.preset().kind == Kind::one_weight
                     ? "Open a cloth to see inside a step of one of its particles."
                 : ui.session.simulation->divergence() ? "Restart to see inside a step."
                 : large                               ? "This cloth is too large for this view."
                                                       : "Right-click a particle to see inside its step.",
                 ui.theme.colors.text);
  }
  gui::begin_child("step", size);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, ui.theme.px(1)));
  words(ui, step_heading(*trace), ui.theme.colors.text);
  if (ui.session.pacing.playing) words(ui, "Space pauses, then → makes one step at a time.", ui.theme.colors.quiet);
  if (trace->fixed) words(ui, "It is pinned or held, so forces do not move it.", ui.theme.colors.warning);
  ImGui::Dummy({0, ui.theme.px(4)});
  for (std::size_t n = 0; n < trace->stages.size(); ++n) stage_text(ui, *trace, n);
  result(ui, *trace);
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace tyglab
