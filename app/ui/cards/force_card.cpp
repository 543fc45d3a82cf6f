#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

// Pixels at scale 1.
constexpr float force_controls_at_1 = 34, force_controls_row_at_1 = 30;
constexpr float force_roomy_at_1 = 11, force_narrow_at_1 = 6, force_log_gap_at_1 = 8;  // beside and between the choices
constexpr float force_legend_line_at_1 = 22, force_over_legend_at_1 = 6;
constexpr float force_least_wide_at_1 = 78, force_least_narrow_at_1 = 130;  // of the plot: a narrow one is to be tall
constexpr int force_buttons = 2;

/// Of a name in the legend: its sample, and what parts it from that and from the next one.
struct LegendEntrySize {
  float sample, gap, between;
};
constexpr LegendEntrySize roomy_entry{22, 6, 14}, narrow_entry{14, 4, 10};

constexpr std::array<const char*, 3> force_sources{"Particle", "Sum", "Max"};
constexpr std::array<const char*, 1> force_scales{"log"};

/// Where the names of the curves stand, px from the legend's corner.
struct LegendPlaces {
  LegendEntrySize entry;
  struct Name {
    std::string_view key;
    ImVec2 at;
    float width;
  };
  std::vector<Name> names;
  float height;
};

LegendPlaces legend_of(const Ui& ui, float whole, const LegendEntrySize& entry) {
  LegendPlaces places{.entry = entry, .names = {}, .height = 0};
  const float line = ui.theme.px(force_legend_line_at_1);
  ImVec2 at{0, 0};
  for (const std::string_view key : shown_force_keys(ui.session.preset())) {
    const float width = ui.theme.px(entry.sample) + ui.theme.px(entry.gap) + symbol_width(ui.fonts, key);
    if (at.x > 0 && at.x + width > whole) at = {0, at.y + line};
    places.names.push_back({key, at, width});
    at.x += width + ui.theme.px(entry.between);
  }
  places.height = at.y + line;
  return places;
}

/// Where that saves a line, its entries are narrow.
LegendPlaces legend_places(const Ui& ui, float whole) {
  const LegendPlaces roomy = legend_of(ui, whole, roomy_entry), narrow = legend_of(ui, whole, narrow_entry);
  return narrow.height < roomy.height ? narrow : roomy;
}

/// Clickable names of the curves.
void legend(Ui& ui, ImVec2 corner, const LegendPlaces& places) {
  Plots& plots = ui.plots;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = ui.theme.px(force_legend_line_at_1), sample = ui.theme.px(places.entry.sample);
  for (const auto& [key, at, width] : places.names) {
    const ImVec2 lo{corner.x + at.x, corner.y + at.y};
    ImGui::SetCursorScreenPos(lo);
    ImGui::PushID(key.data());
    if (gui::press_area("curve", {width, line}) && plots.hidden.erase(key) == 0) plots.hidden.insert(key);
    const bool hidden = plots.hidden.contains(key);
    report_control(ui, "curve." + std::string(key));
    const LegendInk ink =
        legend_ink(ui.theme.colors, curve_style(ui.theme.colors, key), hidden, ImGui::IsItemHovered());
    const float middle = std::round(lo.y + line / 2), left = lo.x + sample + ui.theme.px(places.entry.gap);
    const ImVec2 ends[2] = {{lo.x, middle}, {lo.x + sample, middle}};
    draw_styled_line(draw, ends, 2, ink.sample, ui.theme.scale);
    draw_symbol(draw, ui.fonts, {left, baseline_at(ui.fonts, middle)}, key, ink.name);
    if (hidden) strike_out({draw, ui.theme, ui.fonts}, {left, middle}, symbol_width(ui.fonts, key));
    tooltip(ui, gui::item_id(), std::string(variable(key).quantity) + " · " + std::string(variable(key).storhet),
            hidden ? "Click to show" : "Click to hide");
    ImGui::PopID();
  }
}

/// What stands over the plot: the source of the forces at the left, the scale at the right, or below where it has no
/// room.
struct ControlsPlan {
  float padding;  ///< at scale 1
  float scale;    ///< px, of the scale's control
  bool wraps;
};

ControlsPlan plan_controls(const Ui& ui, float width) {
  ControlsPlan plan{};
  for (const float padding : {force_roomy_at_1, force_narrow_at_1}) {
    const bool weight = ui.session.preset().kind == Kind::one_weight;
    const float sources = weight ? 0 : segments_size(ui, force_sources.data(), 3, padding).x;
    plan = {padding, segments_size(ui, force_scales.data(), 1, padding).x, false};
    if (sources + ui.theme.px(force_log_gap_at_1) + plan.scale <= width) return plan;
  }
  plan.wraps = true;
  return plan;
}

/// Height of all that stands over the plot, px.
float controls_height(const Ui& ui, float width) {
  return ui.theme.px(force_controls_at_1) + (plan_controls(ui, width).wraps ? ui.theme.px(force_controls_row_at_1) : 0);
}

void source_control(Ui& ui, float padding) {
  if (ui.session.preset().kind == Kind::one_weight) return;
  Recorded& recorded = ui.session.recorded;
  const int k = segments(ui, "source", force_sources.data(), 3, int(recorded.chosen), padding);
  if (k < 0 || k == int(recorded.chosen)) return;
  recorded.chosen = Source(k);
  recorded.forces.clear();
}

void force_controls(Ui& ui, const Region& inner) {
  const ControlsPlan plan = plan_controls(ui, inner.size.x);
  source_control(ui, plan.padding);
  ImGui::SetCursorScreenPos(plan.wraps ? ImVec2(inner.at.x, inner.at.y + ui.theme.px(force_controls_row_at_1))
                                       : ImVec2(inner.at.x + inner.size.x - plan.scale, inner.at.y));
  Plots& plots = ui.plots;
  if (segments(ui, "scale", force_scales.data(), 1, plots.log ? 0 : -1, plan.padding) == 0) plots.log = !plots.log;
  tooltip(ui, gui::item_id(), plots.log ? "Linear axis" : "Logarithmic axis");
}

void head_buttons(Ui& ui, const PlotCard& card) {
  bool& paused = ui.session.recorded.paused;
  if (card.head_button(ui, 0, "csv", icon::download, "CSV", "Export the plot as CSV…")) ui.command("export_forces");
  if (card.head_button(ui, 1, "pause", paused ? icon::play : icon::pause, paused ? "run" : "hold",
                       paused ? "Resume the plot" : "Pause the plot; the simulation continues"))
    paused = !paused;
}

/// The longest that the width has room for.
std::string force_title(const Ui& ui, float width) {
  const bool weight = ui.session.preset().kind == Kind::one_weight;
  const Source source = force_source(ui.session);
  const std::string subject = weight                      ? "the mass"
                              : source == Source::sum     ? "the cloth, summed"
                              : source == Source::maximum ? "the cloth, largest"
                                                          : "the picked particle";
  for (const std::string& title : {"Forces on " + subject, weight ? "Forces" : "On " + subject})
    if (text_width(*ui.fonts.title, title) <= width) return title;
  return "Forces";
}

}  // namespace

float force_card_least(const Ui& ui, float width) {
  const float inner = plot_card_inner_width(ui, width), legend = legend_places(ui, inner).height;
  const bool narrow = legend > ui.theme.px(force_legend_line_at_1);
  const float plot = ui.theme.px(narrow ? force_least_narrow_at_1 : force_least_wide_at_1);
  return plot_card_height(ui, controls_height(ui, inner) + plot + ui.theme.px(force_over_legend_at_1) + legend);
}

void force_card(Ui& ui, float height) {
  Plots& plots = ui.plots;
  const PlotCard card(ui, "forces",
                      force_title(ui, plot_card_title_width(ui, ImGui::GetContentRegionAvail().x, force_buttons)),
                      ui.session.recorded.paused ? "held"
                      : plots.log                ? "log"
                                                 : "",
                      height, force_buttons);
  const Region& inner = card.inner();
  head_buttons(ui, card);
  force_controls(ui, inner);
  std::vector<PlotCurve> curves;
  const std::vector<std::string_view> shown = shown_force_keys(ui.session.preset());
  for (std::size_t k = 0; k < force_keys().size(); ++k) {
    const std::string_view key = force_keys()[k];
    if (!plots.hidden.contains(key) && std::find(shown.begin(), shown.end(), key) != shown.end())
      curves.push_back({key, curve_style(ui.theme.colors, key), ui.session.recorded.forces.t(),
                        ui.session.recorded.forces.column(k)});
  }
  for (PlotCurve& curve : curves) curve.gaps = ui.session.recorded.forces.gaps();
  const LegendPlaces places = legend_places(ui, inner.size.x);
  const float head = controls_height(ui, inner.size.x);
  const float plot_height = inner.size.y - head - places.height - ui.theme.px(force_over_legend_at_1);
  ImGui::SetCursorScreenPos({inner.at.x, inner.at.y + head});
  const bool no_particle = force_source(ui.session) == Source::particle && !ui.session.picked;
  const PlotFrame frame = time_frame(ui, ui.session.recorded.forces, plots.log, "N",
                                     no_particle ? "Right-click a particle to pick it" : why_empty(ui));
  zoom_time(ui, frame, draw_plot(ui, "plot", {inner.size.x, plot_height}, curves, frame));
  report_control(ui, "force_plot");
  legend(ui, {inner.at.x, inner.at.y + inner.size.y - places.height}, places);
}

}  // namespace tyglab
