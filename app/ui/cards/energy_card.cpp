#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>

#include "app/base/text.h"
#include "app/ui/cards/cards.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr const char* energy_heading = card_name::energy;
constexpr std::string_view height_row = "gravitational potential", total_row = "total";
constexpr float gap_at_1 = 7, restart_at_1 = 36, curves_at_1 = 130;  // pixels at scale 1
constexpr float bar_at_1 = 8, bar_below_at_1 = 4;                    // thickness, beside a name and below it
constexpr float below_at_1 = 7;                                      // that a bar below a line adds to it

ImU32 color_of(const Tokens& c, double share) {
  return share > Ledger::warns_at ? c.danger : std::abs(share) > Ledger::warns_at / 10 ? c.warning : c.good;
}

/// Height counts from wherever y = 0 is: its size, and with it the sum, says nothing beside the others.
bool from_zero(const EnergyRow& row) {
  return row.name != height_row && row.name != total_row;
}

/// From the middle of the bar: to the right what the cloth has or gained, to the left what it lost.
void draw_bar(Ui& ui, ImVec2 lo, ImVec2 hi, double part, ImU32 color) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = std::round((lo.x + hi.x) / 2);
  const float end = middle + float(std::clamp(part, -1.0, 1.0)) * (hi.x - middle);
  draw.AddRectFilled({std::min(middle, end), lo.y}, {std::max(middle, end), hi.y}, color, ui.theme.px(2));
  draw.AddLine({middle, lo.y - 2}, {middle, hi.y + 2}, ui.theme.colors.line);
}

/// Where the bars are, px from the left: between names and numbers or, in a narrow card, below them.
struct BarColumn {
  float left, right;
  bool below;
};

BarColumn bar_column(const Ui& ui, float width) {
  const float left = ui.theme.px(128), right = width - ui.theme.px(96);
  if (left + ui.theme.px(24) >= right) return {0, width, true};
  return {left, right, false};
}

/// Of a row with all that belongs to it, pixels at scale 1.
float row_height_at_1(const EnergyRow& row, const BarColumn& bars) {
  return card::line + (bars.below && from_zero(row) ? below_at_1 : 0);
}

void energy_line(Ui& ui, const EnergyRow& row, const LedgerReading& reading, double full, const ScaledUnit& unit,
                 float width) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const BarColumn bars = bar_column(ui, width);
  const float height = ui.theme.px(row_height_at_1(row, bars)), middle = std::round(lo.y + ui.theme.px(card::line) / 2);
  const float baseline = baseline_at(ui.fonts, middle);
  const bool unexplained = row.kind == EnergyKind::unexplained;
  const double part = reading.scale > 0 ? row.joule / reading.scale : 0;
  ImGui::PushID(row.name.data(), row.name.data() + row.name.size());
  gui::press_area("energy", {width, height});
  report_control(ui, "line");
  tooltip(ui, gui::item_id(), std::string(row.help) + (unexplained ? " Now " + share_text(reading) + "." : ""));
  ImGui::PopID();
  const ImU32 ink = row.joule == 0 && !unexplained ? c.quiet : c.text;
  const bool unknown = unexplained && reading.began >= ui.session.simulation->time();
  const ImU32 color = unknown                       ? c.quiet
                      : unexplained                 ? color_of(c, part)
                      : row.kind == EnergyKind::has ? c.accent
                                                    : c.text;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_on_baseline(draw, *ui.fonts.small, {lo.x, baseline}, unexplained ? color : ink,
                   unexplained && row.joule < 0 ? std::string_view("removed by the method") : row.name);
  if (from_zero(row)) {
    const float bar = ui.theme.px(bars.below ? bar_below_at_1 : bar_at_1),
                top = bars.below ? std::round(lo.y + ui.theme.px(card::line)) : middle - bar / 2;
    draw_bar(ui, {lo.x + bars.left, top}, {lo.x + bars.right, top + bar}, row.joule / full, faded(color, 0.8f));
  }
  const double shown = unexplained ? std::abs(row.joule) : row.joule;
  const std::string text = unknown ? "–" : power_number(shown / unit.size, 3) + " " + unit.name;
  const ImFont& mono = *ui.fonts.mono;
  draw_on_baseline(draw, mono, {lo.x + width - text_width(mono, text), baseline}, unexplained ? color : ink, text);
}

/// What a bar stands for that reaches the end: the least of 1, 2 and 5 times a power of ten that holds them all, J.
double full_bar(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  const double power = std::pow(10, std::floor(std::log10(largest))), lead = largest / power;
  constexpr double rounding = 1e-9;  // that a lead of 2 may come out as 2 + 4e-16
  return power * (lead <= 1 + rounding ? 1 : lead <= 2 + rounding ? 2 : lead <= 5 + rounding ? 5 : 10);
}

/// What a full bar stands for, above its end: half a bar is what is gained, half what is lost.
void bar_scale(Ui& ui, double full, const ScaledUnit& unit, float width) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const std::string words = "full scale " + short_number(full / unit.size, 3) + " " + unit.name;
  const ImFont& small = *ui.fonts.small;
  const float left = std::max(lo.x, lo.x + bar_column(ui, width).right - text_width(small, words));
  draw_on_baseline(*ImGui::GetWindowDrawList(), small,
                   {left, baseline_at(ui.fonts, lo.y + ui.theme.px(card::line) / 2)}, ui.theme.colors.quiet, words);
  ImGui::Dummy({width, ui.theme.px(card::line)});
}

/// Since when all this has been counted: the ledger is kept only while somebody wants it.
void since_line(Ui& ui, const LedgerReading& reading) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool late = reading.began > 0;
  const std::string text = late ? "counted since t = " + time_number(reading.began, ui.session.preset().dt) + " s"
                                : "counted since the start";
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.small,
                   {lo.x, baseline_at(ui.fonts, lo.y + ui.theme.px(card::line) / 2)},
                   late ? ui.theme.colors.warning : ui.theme.colors.quiet, text);
  if (!late) return;
  ImGui::SetCursorScreenPos({lo.x, lo.y + ui.theme.px(card::line + 4)});
  if (text_button(ui, "Restart and count")) ui.command("restart");
  report_control(ui, "count_from_start");
  tooltip(ui, gui::item_id(), "Restarts the motion and counts from its start", "R");
}

/// The energies over time.
void energy_curves(Ui& ui, ImVec2 size) {
  const Tokens& c = ui.theme.colors;
  const CurveStyle styles[] = {{c.blue, LineStyle::solid, 1.8f},
                               {c.green, LineStyle::dashed, 1.8f},
                               {c.text, LineStyle::solid, 1.2f},
                               {c.vermilion, LineStyle::dotted, 2.2f}};
  const Series& series = ui.session.recorded.energy;
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < energy_columns.size(); ++k) {
    curves.push_back({energy_columns[k], styles[k], series.t(), series.column(k)});
    curves.back().gaps = series.gaps();
  }
  const PlotFrame frame = time_frame(ui, series, false, "J", why_empty(ui));
  zoom_time(ui, frame, draw_plot(ui, "energy plot", size, curves, frame));
  report_control(ui, "energy_plot");
}

}  // namespace

std::vector<EnergyRow> energy_rows(const LedgerReading& r, const Preset& preset) {
  // What is off by default has a row where it is on, or has been.
  static const Preset usual;
  const auto counts = [&](const Force& force, double joule) {
    return force.on(preset) || joule != 0 || &force == &force::wind || force.on(usual);
  };
  std::vector<EnergyRow> rows{{EnergyKind::has, "kinetic", "½ m v² of every particle.", r.energy.kinetic}};
  for (const Force* force : force::all)
    if (force->conserves && counts(*force, r.energy.of[*force]))
      rows.push_back({EnergyKind::has, force->title, force->help, r.energy.of[*force]});
  rows.push_back({EnergyKind::has, total_row, "Sum of the energies above.", r.energy.total()});
  const auto add_works = [&](Force::Group group) {
    for (const Force* force : force::all)
      if (!force->conserves && force->group == group && counts(*force, r.works.of[*force]))
        rows.push_back({EnergyKind::works, force->title, force->help, r.works.of[*force]});
  };
  add_works(Force::Group::internal);
  rows.push_back({EnergyKind::works, "contact",
                  "Work of bodies: impacts and friction. Bodies at rest only remove energy.", r.works.contact});
  rows.push_back({EnergyKind::works, "tearing, cutting", "Energy of springs that tore or were cut.", r.works.tearing});
  add_works(Force::Group::external);
  rows.push_back({EnergyKind::works, "hand", "Work of the hand, and of pins that move.", r.works.hand});
  rows.push_back(
      {EnergyKind::works, "edits", "Jumps in energy when constants, pins or methods change.", r.works.edits});
  rows.push_back({EnergyKind::unexplained, "added by the method",
                  "The remainder: energy that no force explains, so the integrator added or removed it.",
                  r.unexplained()});
  return rows;
}

std::string share_text(const LedgerReading& reading) {
  return short_number(100 * reading.share(), 2) + " % of the scene's energy scale, " + quantity(reading.scale, "J", 3);
}

float energy_card_height(const Ui& ui, float width) {
  const auto ledger = ui.session.simulation->ledger();
  const float button = ledger && ledger->began > 0 ? restart_at_1 : 0;
  float rows = 2 * card::line;  // what a full bar stands for, and since when is counted
  for (const EnergyRow& row : energy_rows({}, ui.session.preset()))
    rows += row_height_at_1(row, bar_column(ui, card_width(ui, width)));
  return card_height(ui, energy_heading, rows + 4 * gap_at_1 + curves_at_1 + button);
}

void energy_card(Ui& ui, float height) {
  const bool open = begin_card(ui, energy_heading, height);
  if (const auto reading = ui.session.simulation->ledger(); open && reading) {
    const float width = card_width(ui);
    EnergyKind last = EnergyKind::has;
    const std::vector<EnergyRow> rows = energy_rows(*reading, ui.session.preset());
    double largest = 0;
    for (const EnergyRow& row : rows)
      if (from_zero(row)) largest = std::max(largest, std::abs(row.joule));
    const double full = full_bar(largest);
    const ScaledUnit unit = scaled_unit(full, "J");  // one for all rows
    bar_scale(ui, full, unit, width);
    for (const EnergyRow& row : rows) {
      if (row.kind != last) ImGui::Dummy({width, ui.theme.px(gap_at_1)});
      last = row.kind;
      energy_line(ui, row, *reading, full, unit, width);
    }
    ImGui::Dummy({width, ui.theme.px(gap_at_1)});
    energy_curves(ui, {width, ui.theme.px(curves_at_1)});
    ImGui::Dummy({width, ui.theme.px(gap_at_1)});
    since_line(ui, *reading);
  }
  end_card(ui);
}

}  // namespace tyglab
