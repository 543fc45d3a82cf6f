// The variables of table B.1, live, for the picked particle.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <string>

#include "app/base/text.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr std::array<std::string_view, 3> motion{"x", "v", "a"};

/// The sum comes last.
std::vector<std::string_view> listed_forces(const Preset& preset) {
  std::vector<std::string_view> keys = shown_force_keys(preset);
  std::rotate(keys.begin(), keys.begin() + 1, keys.end());
  return keys;
}

/// Whether the variable can be drawn at the particle: a position is a place, not an arrow, a mass on a spring has none.
bool has_arrow(const Ui& ui, std::string_view key) {
  return ui.session.preset().kind == Kind::cloth && key != "x";
}

/// Below this a variable is the rounding of numbers that cancel, and is shown as 0: 10⁻¹² of what the scene's own
/// weight gives, m g, or without gravity of the force that stretches a spring to twice its length. Doubles round at
/// 10⁻¹⁶ of what is added up, so what physics leaves is far above it.
double noise_of(const Preset& preset, std::string_view key) {
  constexpr double part = 1e-12;
  const double k = preset.kind == Kind::one_weight ? preset.k : spring_constants(preset).largest();
  const double force = preset.g != 0 ? preset.m * std::abs(preset.g) : k * preset.L;
  if (key == "x") return part * preset.L;
  if (key == "v") return part * std::sqrt(force / preset.m * preset.L);
  return part * (key == "a" ? force / preset.m : force);
}

glm::dvec3 value_of(const Ui& ui, const ParticleReadout* readout, std::string_view key) {
  if (readout == nullptr) return glm::dvec3(0);
  const double noise = noise_of(ui.session.preset(), key);
  glm::dvec3 value = (*readout)[key];
  for (int n = 0; n < 3; ++n)
    if (std::abs(value[n]) < noise) value[n] = 0;
  return value;
}

/// Whether a body's contact, which no formula gives, is missing from what is shown.
bool lacks_contact(const ParticleReadout* readout, std::string_view key) {
  return readout != nullptr && readout->on_body && (key == "F" || key == "a");
}

void variable_tooltip(Ui& ui, ImGuiID id, const Variable& what, const glm::dvec3& value, bool without_contact) {
  if (!tooltip_due(ui, id)) return;
  const Tokens& c = ui.theme.colors;
  begin_tooltip(ui);
  ImGui::PushFont(ui.fonts.title);
  wrapped(ui, std::string(what.quantity) + " · " + std::string(what.storhet), c.text);
  ImGui::PopFont();
  wrapped(ui, what.help, c.text);
  const ScaledUnit in = scaled_unit(std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)}), what.unit);
  wrapped(ui, steady_vector(value / in.size) + " " + in.name, c.text);
  if (without_contact)
    wrapped(ui,
            "The particle lies on a body. Contact corrects position and velocity after each step and is not a force of "
            "the model, so neither F nor the acceleration includes it.",
            c.warning);
  wrapped(ui, equation_of_report(what.equation), c.quiet);
  if (has_arrow(ui, what.key)) wrapped(ui, "Click to show or hide its arrow at the particle", c.quiet);
  end_tooltip(ui);
}

float line_height(const Ui& ui) {
  return ui.theme.px(20);
}

constexpr float unit_at_1 = 24;  // of "mN", px at scale 1

/// Where numbers end, from the left of the panel: one grid for forces (two to a line) and motion (three to a line).
struct Grid {
  float first_end, middle_end, last_end;  ///< of numbers; units stand behind them
  float second_start;                     ///< of the right force
};

Grid grid(const Ui& ui) {
  const float gap = ui.theme.px(8);
  const float last = ui.row_width - ui.theme.px(34), first = std::floor((last - gap) / 2);
  return {first, std::floor((first + last) / 2), last, first + gap};
}

/// After the symbol of what lacks the contact: refers to the note beside F.
void contact_mark(Ui& ui, ImVec2 symbol_at, std::string_view symbol) {
  const float x = symbol_at.x + symbol_width(ui.fonts, symbol) + ui.theme.px(3);
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.text, {x, symbol_at.y}, ui.theme.colors.warning, "*");
}

void contact_note(Ui& ui, ImVec2 at) {
  const float baseline = baseline_at(ui.fonts, std::round(at.y + line_height(ui) / 2));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_on_baseline(draw, *ui.fonts.text, {at.x, baseline}, ui.theme.colors.warning, "*");
  draw_on_baseline(draw, *ui.fonts.small, {at.x + ui.theme.px(10), baseline}, ui.theme.colors.quiet, "without contact");
}

constexpr float tick_side = 9, sample_at = 13, sample_length = 14, symbol_at = 31;  // at scale 1

void toggle_arrow(Ui& ui, std::string_view key) {
  std::set<std::string>& arrows = ui.settings.handling.arrows;
  const std::string name(key);
  const bool drawn = ui.arrows && arrows.count(name) > 0;
  if (drawn) return void(arrows.erase(name));
  arrows.insert(name);
  ui.arrows = true;
}

/// The tick that shows the variable's arrow. The item before is what a click takes.
void draw_tick(Ui& ui, std::string_view key, float left, float middle) {
  const Tokens& c = ui.theme.colors;
  const bool on = ui.arrows && ui.settings.handling.arrows.count(std::string(key)) > 0;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float side = ui.theme.px(tick_side), line = std::max(1.f, ui.theme.px(1.2f));
  const ImVec2 lo{left, std::round(middle - side / 2)}, hi{lo.x + side, lo.y + side};
  const ImU32 edge = ImGui::IsItemHovered() ? c.text : on ? c.accent : c.quiet;
  if (on) draw.AddRectFilled(lo, hi, c.accent, ui.theme.px(2));
  draw.AddRect(lo, hi, edge, ui.theme.px(2), 0, line);
  if (!on) return;
  const ImVec2 check[3] = {{lo.x + side * 0.22f, lo.y + side * 0.52f},
                           {lo.x + side * 0.42f, lo.y + side * 0.74f},
                           {lo.x + side * 0.8f, lo.y + side * 0.26f}};
  draw.AddPolyline(check, 3, c.on_accent, 0, ui.theme.scale * 1.4f);
}

/// A tick where there is an arrow to show, and the color and line of what is drawn or plotted.
void tick_and_sample(Ui& ui, std::string_view key, float left, float middle) {
  const bool arrow = has_arrow(ui, key), plotted = key.front() == 'F';
  if (arrow) draw_tick(ui, key, left, middle);
  if (!arrow && !plotted) return;
  const ImVec2 sample[2] = {{left + ui.theme.px(sample_at), middle},
                            {left + ui.theme.px(sample_at + sample_length), middle}};
  draw_styled_line(*ImGui::GetWindowDrawList(), sample, 2, curve_style(ui.theme.colors, key), ui.theme.scale);
}

/// A variable's symbol with the sample of its curve, its numbers, its unit. The numbers end at those distances from the
/// left edge, the unit follows the last.
void variable_cell(Ui& ui, std::string_view key, const ParticleReadout* readout, float width,
                   std::span<const double> numbers, std::span<const float> ends, const ScaledUnit& unit,
                   bool with_unit = true) {
  const Tokens& c = ui.theme.colors;
  const Variable& what = variable(key);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float height = line_height(ui), middle = std::round(lo.y + height / 2);
  ImGui::PushID(key.data(), key.data() + key.size());
  if (gui::press_area("variable", {width, height}) && has_arrow(ui, key)) toggle_arrow(ui, key);
  report_control(ui, key);
  tick_and_sample(ui, key, lo.x, middle);
  variable_tooltip(ui, gui::item_id(), what, value_of(ui, readout, key), lacks_contact(readout, key));
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float baseline = baseline_at(ui.fonts, middle);
  const ImVec2 symbol{lo.x + ui.theme.px(symbol_at), baseline};
  draw_symbol(draw, ui.fonts, symbol, what.symbol, c.text);
  if (lacks_contact(readout, key)) contact_mark(ui, symbol, what.symbol);
  const ImFont& mono = *ui.fonts.mono;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const std::string text = readout != nullptr ? table_number(numbers[k] / unit.size) : "–";
    draw_on_baseline(draw, mono, {lo.x + ends[k] - text_width(mono, text), baseline}, c.text, text);
  }
  if (with_unit)
    draw_on_baseline(draw, *ui.fonts.small, {lo.x + ends.back() + ui.theme.px(5), baseline}, c.quiet, unit.name);
}

/// Its magnitude ends `end` after the cell's left edge. The unit, which all forces share, stands once a line.
void force_cell(Ui& ui, std::string_view key, const ParticleReadout* readout, float end, const ScaledUnit& unit,
                bool last_in_line) {
  const double magnitude = glm::length(value_of(ui, readout, key));
  const float width = last_in_line ? end + ui.theme.px(unit_at_1) : end;
  variable_cell(ui, key, readout, width, {&magnitude, 1}, {&end, 1}, unit, last_in_line);
}

/// Three components.
void motion_line(Ui& ui, std::string_view key, const ParticleReadout* readout, const Grid& columns) {
  const glm::dvec3 value = value_of(ui, readout, key);
  const double numbers[3] = {value.x, value.y, value.z};
  const double largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
  const float ends[3] = {columns.first_end, columns.middle_end, columns.last_end};
  variable_cell(ui, key, readout, ui.row_width, numbers, ends, scaled_unit(largest, variable(key).unit));
}

constexpr const char* card_title = "Picked particle";

}  // namespace

float particle_panel_height(const Ui& ui) {
  const float spacing = ui.theme.px(2), title = ui.theme.px(2) + ui.theme.px(22) + 2 * spacing;
  const bool open = ui.settings.layout.folded.count(card_title) == 0;
  const int lines = open ? int(listed_forces(ui.session.preset()).size() + 1) / 2 + int(motion.size()) : 0;
  return title + float(lines) * (line_height(ui) + spacing) + ui.theme.px(8);
}

void particle_panel(Ui& ui) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool open = section(ui, card_title);
  char where[64] = "none";
  if (!ui.session.picked)
    std::snprintf(where, sizeof where, "none: %s a particle", ui.input.by_touch ? "tap" : "right-click");
  if (ui.session.picked) {
    const bool pinned = ui.session.simulation->pinned(ui.session.picked->i, ui.session.picked->j);
    std::snprintf(where, sizeof where, "(%d, %d)%s", ui.session.picked->i, ui.session.picked->j,
                  pinned ? ", pinned" : "");
  }
  if (ui.session.preset().kind == Kind::one_weight) std::snprintf(where, sizeof where, "the mass");
  const ImFont& small = *ui.fonts.small;
  const float x = lo.x + ui.theme.px(118);
  const float y = lo.y + ui.theme.px(4) + std::round((ui.theme.px(22) - small.FontSize) / 2);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float end = x + text_width(small, where) + ui.theme.px(8);
  draw.AddRectFilled({x - ui.theme.px(6), y}, {end, y + small.FontSize + 2}, c.panel);
  draw_text(draw, small, {x, y}, c.text, where);
  if (!open) return;
  ParticleReadout readout;
  const ParticleReadout* shown = nullptr;
  if (ui.session.picked)
    readout = ui.session.simulation->particle(ui.session.picked->i, ui.session.picked->j), shown = &readout;
  const Grid columns = grid(ui);
  const std::vector<std::string_view> forces = listed_forces(ui.session.preset());
  double largest = 0;
  for (const std::string_view key : forces) largest = std::max(largest, glm::length(value_of(ui, shown, key)));
  const ScaledUnit newtons = scaled_unit(largest, "N");
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const bool right = k % 2 == 1;
    if (right)
      ImGui::SameLine(0, 0), ImGui::SetCursorScreenPos({lo.x + columns.second_start, ImGui::GetCursorScreenPos().y});
    force_cell(ui, forces[k], shown, right ? columns.last_end - columns.second_start : columns.first_end, newtons,
               right || k + 1 == forces.size());
  }
  // F stands alone on the last line of the forces, with its unit.
  const float behind_unit = columns.first_end + ui.theme.px(8 + unit_at_1);
  if (lacks_contact(shown, "F")) contact_note(ui, {lo.x + behind_unit, ImGui::GetItemRectMin().y});
  for (std::string_view key : motion) motion_line(ui, key, shown, columns);
}

}  // namespace tyglab
