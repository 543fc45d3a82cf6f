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
constexpr float force_controls_at_1 = 34, force_controls_row_at_1 = 30, force_gap_at_1 = 4, force_button_at_1 = 22;
constexpr float force_legend_line_at_1 = 22, force_sample_at_1 = 22, force_over_legend_at_1 = 6,
                force_least_plot_at_1 = 78;

constexpr std::array<const char*, 3> force_sources{"Particle", "Sum", "Max"};
constexpr std::array<const char*, 1> force_scales{"log"};

/// Where the names of the curves stand, px from the legend's corner.
struct LegendPlaces {
  struct Name {
    std::string_view key;
    ImVec2 at;
    float width;
  };
  std::vector<Name> names;
  float height;
};

LegendPlaces legend_places(const Ui& ui, float whole) {
  LegendPlaces places;
  const float line = ui.theme.px(force_legend_line_at_1), gap = ui.theme.px(14);
  ImVec2 at{0, 0};
  for (const std::string_view key : shown_force_keys(ui.session.preset())) {
    const float width = ui.theme.px(force_sample_at_1) + ui.theme.px(6) + symbol_width(ui.fonts, key);
    if (at.x > 0 && at.x + width > whole) at = {0, at.y + line};
    places.names.push_back({key, at, width});
    at.x += width + gap;
  }
  places.height = at.y + line;
  return places;
}

/// Clickable names of the curves.
void legend(Ui& ui, ImVec2 corner, const LegendPlaces& places) {
  Plots& plots = ui.plots;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = ui.theme.px(force_legend_line_at_1), sample = ui.theme.px(force_sample_at_1);
  for (const auto& [key, at, width] : places.names) {
    const ImVec2 lo{corner.x + at.x, corner.y + at.y};
    ImGui::SetCursorScreenPos(lo);
    ImGui::PushID(key.data());
    if (gui::press_area("curve", {width, line}) && plots.hidden.erase(key) == 0) plots.hidden.insert(key);
    const bool hidden = plots.hidden.contains(key);
    report_control(ui, "curve." + std::string(key));
    const LegendInk ink =
        legend_ink(ui.theme.colors, curve_style(ui.theme.colors, key), hidden, ImGui::IsItemHovered());
    const float middle = std::round(lo.y + line / 2), left = lo.x + sample + ui.theme.px(6);
    const ImVec2 ends[2] = {{lo.x, middle}, {lo.x + sample, middle}};
    draw_styled_line(draw, ends, 2, ink.sample, ui.theme.scale);
    draw_symbol(draw, ui.fonts, {left, baseline_at(ui.fonts, middle)}, key, ink.name);
    if (hidden) strike_out({draw, ui.theme, ui.fonts}, {left, middle}, symbol_width(ui.fonts, key));
    tooltip(ui, gui::item_id(), std::string(variable(key).quantity) + " · " + std::string(variable(key).storhet),
            hidden ? "Click to show" : "Click to hide");
    ImGui::PopID();
  }
}

/// What stands at the right over the plot: the scale, hold and CSV.
float right_controls_width(const Ui& ui) {
  return segments_size(ui, force_scales.data(), 1).x + 2 * ui.theme.px(force_button_at_1) +
         2 * ui.theme.px(force_gap_at_1);
}

/// Whether that has no room beside the force_sources, so that it takes another row.
bool force_controls_wrap(const Ui& ui, float width) {
  const float left = ui.session.preset().kind == Kind::one_weight ? 0 : segments_size(ui, force_sources.data(), 3).x;
  return left + ui.theme.px(8) + right_controls_width(ui) > width;
}

/// Height of all that stands over the plot, px.
float controls_height(const Ui& ui, float width) {
  return ui.theme.px(force_controls_at_1) + (force_controls_wrap(ui, width) ? ui.theme.px(force_controls_row_at_1) : 0);
}

void source_control(Ui& ui) {
  if (ui.session.preset().kind == Kind::one_weight) return;
  Recorded& recorded = ui.session.recorded;
  const int k = segments(ui, "source", force_sources.data(), 3, int(recorded.chosen));
  if (k < 0 || k == int(recorded.chosen)) return;
  recorded.chosen = Source(k);
  recorded.forces.clear();
}

void right_controls(Ui& ui, ImVec2 at) {
  Plots& plots = ui.plots;
  const float gap = ui.theme.px(force_gap_at_1), y = at.y + ui.theme.px(2);
  ImGui::SetCursorScreenPos(at);
  if (segments(ui, "scale", force_scales.data(), 1, plots.log ? 0 : -1) == 0) plots.log = !plots.log;
  tooltip(ui, gui::item_id(), plots.log ? "Linear axis" : "Logarithmic axis");
  ImGui::SetCursorScreenPos({ImGui::GetItemRectMax().x + gap, y});
  if (quiet_button(ui, "pause", ui.session.recorded.paused ? icon::play : icon::pause,
                   ui.session.recorded.paused ? "run" : "hold",
                   ui.session.recorded.paused ? "Resume the plot" : "Pause the plot; the simulation continues"))
    ui.session.recorded.paused = !ui.session.recorded.paused;
  ImGui::SetCursorScreenPos({ImGui::GetItemRectMax().x + gap, y});
  if (quiet_button(ui, "csv", icon::download, "CSV", "Export the plot as CSV…")) ui.command("export_forces");
}

void force_controls(Ui& ui, const Region& inner) {
  source_control(ui);
  const bool wraps = force_controls_wrap(ui, inner.size.x);
  right_controls(ui, wraps ? ImVec2(inner.at.x, inner.at.y + ui.theme.px(force_controls_row_at_1))
                           : ImVec2(inner.at.x + inner.size.x - right_controls_width(ui), inner.at.y));
}

/// The longest that the width has room for beside the unit.
std::string force_title(const Ui& ui, float width) {
  const bool weight = ui.session.preset().kind == Kind::one_weight;
  const Source source = force_source(ui.session);
  const std::string subject = weight                      ? "the mass"
                              : source == Source::sum     ? "the cloth, summed"
                              : source == Source::maximum ? "the cloth, largest"
                                                          : "the picked particle";
  const float unit = ui.theme.px(48);
  for (const std::string& title : {"Forces on " + subject, weight ? "Forces" : "On " + subject})
    if (text_width(*ui.fonts.title, title) + unit <= width) return title;
  return "Forces";
}

}  // namespace

float force_card_least(const Ui& ui, float width) {
  const float inner = plot_card_inner_width(ui, width);
  return plot_card_height(ui, controls_height(ui, inner) + ui.theme.px(force_least_plot_at_1 + force_over_legend_at_1) +
                                  legend_places(ui, inner).height);
}

void force_card(Ui& ui, float height) {
  Plots& plots = ui.plots;
  const PlotCard card(ui, "forces", force_title(ui, plot_card_inner_width(ui, ImGui::GetContentRegionAvail().x)),
                      ui.session.recorded.paused ? "held"
                      : plots.log                ? "log"
                                                 : "",
                      height);
  const Region& inner = card.inner();
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
