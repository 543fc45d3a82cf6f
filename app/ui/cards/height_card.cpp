#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr float height_legend_at_1 = 22, height_under_legend_at_1 = 6,
                height_least_plot_at_1 = 120;  // pixels at scale 1

constexpr float sample_at_1 = 18, sample_gap_at_1 = 4, entry_gap_at_1 = 10;
constexpr float own_width = 2.4f;  // of the mass's own curve, at scale 1

/// The mass's own method, drawn thick, then the curves of figure 3.2; its own method is not listed twice.
struct LegendEntry {
  std::string_view method, title;
  std::optional<std::size_t> curve;  ///< that a click hides
};
std::vector<LegendEntry> legend_entries(const Ui& ui) {
  const std::string& own = ui.session.preset().integrator;
  const auto& curves = ReferenceCurves::curves;
  std::vector<LegendEntry> entries;
  if (std::find(curves.begin(), curves.end(), own) == curves.end())
    entries.push_back({own, scheme(own).title, std::nullopt});
  for (std::size_t k = 0; k < curves.size(); ++k) entries.push_back({curves[k], ReferenceCurves::titles[k], k});
  return entries;
}

/// Where each entry of the legend begins, in lines as wide as that; relative to the first, y in lines.
std::vector<ImVec2> figure_places(const Ui& ui, float width) {
  std::vector<ImVec2> places;
  ImVec2 at{0, 0};
  for (const LegendEntry& entry : legend_entries(ui)) {
    const float wide = ui.theme.px(sample_at_1 + sample_gap_at_1) + text_width(*ui.fonts.small, entry.title);
    if (at.x > 0 && at.x + wide > width) at = {0, at.y + 1};
    places.push_back(at);
    at.x += wide + ui.theme.px(entry_gap_at_1);
  }
  return places;
}
float figure_legend_height(const Ui& ui, float card_width) {
  const float width = plot_card_inner_width(ui, card_width) - ui.theme.px(height_legend_at_1);
  return ui.theme.px(height_legend_at_1) * (figure_places(ui, width).back().y + 1);
}

/// The mass's own curve and the report's beside it; a click hides one of those.
void figure_legend(Ui& ui, const Region& place) {
  Plots& plots = ui.plots;
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.small;
  const float sample = ui.theme.px(sample_at_1), line = ui.theme.px(height_legend_at_1);
  const auto places = figure_places(ui, place.size.x);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const std::vector<LegendEntry> entries = legend_entries(ui);
  for (std::size_t n = 0; n < entries.size(); ++n) {
    const LegendEntry& entry = entries[n];
    const float width = sample + ui.theme.px(sample_gap_at_1) + text_width(font, entry.title);
    const float x = place.at.x + places[n].x, y = place.at.y + places[n].y * line;
    ImGui::SetCursorScreenPos({x, y});
    ImGui::PushID(int(n));
    bool* const hidden = entry.curve ? &plots.figure_hidden[*entry.curve] : nullptr;
    if (gui::press_area("figure", {width, line}) && hidden != nullptr) *hidden = !*hidden;
    report_control(ui, entry.title);
    const bool struck = hidden != nullptr && *hidden;
    LegendInk ink = legend_ink(c, integrator_style(c, entry.method), struck, ImGui::IsItemHovered());
    if (entry.method == ui.session.preset().integrator) ink.sample.width = own_width;
    const float middle = std::round(y + line / 2), left = x + sample + ui.theme.px(sample_gap_at_1);
    const ImVec2 ends[2] = {{x, middle}, {x + sample, middle}};
    draw_styled_line(draw, ends, 2, ink.sample, ui.theme.scale);
    draw_on_baseline(draw, font, {left, baseline_at(ui.fonts, middle)}, ink.name, entry.title);
    if (struck) strike_out({draw, ui.theme, ui.fonts}, {left, middle}, text_width(font, entry.title));
    if (hidden == nullptr) {
      tooltip(ui, gui::item_id(), "The mass itself, moved by this method");
    } else {
      tooltip(ui, gui::item_id(), "As in figure 3.2: equal start, constants and dt with this method",
              *hidden ? "Click to show" : "Click to hide");
    }
    ImGui::PopID();
  }
}

}  // namespace

float height_card_least(const Ui& ui, float width) {
  return plot_card_height(
      ui, figure_legend_height(ui, width) + ui.theme.px(height_under_legend_at_1 + height_least_plot_at_1));
}

void height_card(Ui& ui, float height) {
  Plots& plots = ui.plots;
  const PlotCard card(ui, "height", "Height of the mass, y(t)", "", height);
  const Region& inner = card.inner();
  const float side = ui.theme.px(height_legend_at_1);
  ImGui::SetCursorScreenPos({inner.at.x + inner.size.x - side, inner.at.y});
  if (quiet_button(ui, "csv", icon::download, "CSV", "Export the plot as CSV…")) ui.command("export_height");
  const float legend = figure_legend_height(ui, plots.width);
  figure_legend(ui, {inner.at, {inner.size.x - side, legend}});
  const std::span<const double> t = ui.session.recorded.height.t();
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < ReferenceCurves::curves.size(); ++k)
    if (!plots.figure_hidden[k]) {
      CurveStyle style = integrator_style(ui.theme.colors, ReferenceCurves::curves[k]);
      style.width = 1.2f;
      curves.push_back({ReferenceCurves::titles[k], style, t, ui.session.recorded.height.column(k + 1)});
    }
  const std::size_t companions = curves.size();
  for (const auto& [since, method] : ui.session.recorded.height_methods) {
    const auto from = std::size_t(std::lower_bound(t.begin(), t.end(), since) - t.begin());
    if (curves.size() > companions) curves.back().to = from + 1;  // up to where the next one begins
    curves.push_back({"y", integrator_style(ui.theme.colors, method), t, ui.session.recorded.height.column(0)});
    curves.back().from = from;
    curves.back().style.width = own_width;
  }
  for (PlotCurve& curve : curves) curve.gaps = ui.session.recorded.height.gaps();
  const float head = legend + ui.theme.px(height_under_legend_at_1);
  ImGui::SetCursorScreenPos({inner.at.x, inner.at.y + head});
  PlotFrame frame = time_frame(ui, ui.session.recorded.height, false, "m", why_empty(ui));
  frame.from_zero = false;
  zoom_time(ui, frame, draw_plot(ui, "plot", {inner.size.x, inner.size.y - head}, curves, frame));
}

}  // namespace tyglab
