#include "app/ui/cards/force_card.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/ui/kit/curves.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/plot.h"
#include "app/ui/kit/plot_card.h"
#include "app/ui/kit/symbol.h"
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
  std::array<ImVec2, force_keys.size()> at;
  std::array<float, force_keys.size()> width;
  float height;
};

LegendPlaces legend_places(const App& app, float whole) {
  LegendPlaces places;
  const float line = app.theme.px(force_legend_line_at_1), gap = app.theme.px(14);
  ImVec2 at{0, 0};
  for (std::size_t k = 0; k < force_keys.size(); ++k) {
    const float width = app.theme.px(force_sample_at_1) + app.theme.px(6) + symbol_width(app.fonts, force_keys[k]);
    if (at.x > 0 && at.x + width > whole) at = {0, at.y + line};
    places.at[k] = at, places.width[k] = width;
    at.x += width + gap;
  }
  places.height = at.y + line;
  return places;
}

/// Clickable names of the curves.
void legend(App& app, ImVec2 corner, const LegendPlaces& places) {
  Plots& plots = app.ui.plots;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = app.theme.px(force_legend_line_at_1), sample = app.theme.px(force_sample_at_1);
  for (std::size_t k = 0; k < force_keys.size(); ++k) {
    const ImVec2 lo{corner.x + places.at[k].x, corner.y + places.at[k].y};
    ImGui::SetCursorScreenPos(lo);
    ImGui::PushID(int(k));
    if (ImGui::InvisibleButton("curve", {places.width[k], line})) plots.hidden[k] = !plots.hidden[k];
    report_control(app, "curve." + std::string(force_keys[k]));
    const float opacity = plots.hidden[k] ? (ImGui::IsItemHovered() ? 0.6f : 0.35f) : 1;
    CurveStyle style = curve_style(app.theme.colors, force_keys[k]);
    style.color = faded(style.color, opacity);
    const float middle = std::round(lo.y + line / 2);
    const ImVec2 ends[2] = {{lo.x, middle}, {lo.x + sample, middle}};
    draw_styled_line(draw, ends, 2, style, app.theme.scale);
    draw_symbol(draw, app.fonts, {lo.x + sample + app.theme.px(6), baseline_at(app.fonts, middle)}, force_keys[k],
                faded(app.theme.colors.text, opacity));
    tooltip(app, gui::item_id(),
            std::string(variable(force_keys[k]).quantity) + " · " + std::string(variable(force_keys[k]).storhet),
            plots.hidden[k] ? "Click to show" : "Click to hide");
    ImGui::PopID();
  }
}

/// What stands at the right over the plot: the scale, hold and CSV.
float right_controls_width(const App& app) {
  return segments_size(app, force_scales.data(), 1).x + 2 * app.theme.px(force_button_at_1) +
         2 * app.theme.px(force_gap_at_1);
}

/// Whether that has no room beside the force_sources, so that it takes another row.
bool force_controls_wrap(const App& app, float width) {
  const float left = app.preset().kind == Kind::one_weight ? 0 : segments_size(app, force_sources.data(), 3).x;
  return left + app.theme.px(8) + right_controls_width(app) > width;
}

/// Height of all that stands over the plot, px.
float controls_height(const App& app, float width) {
  return app.theme.px(force_controls_at_1) +
         (force_controls_wrap(app, width) ? app.theme.px(force_controls_row_at_1) : 0);
}

void source_control(App& app) {
  Plots& plots = app.ui.plots;
  if (app.preset().kind == Kind::one_weight) {
    plots.source = Source::particle;  // there is but one
  } else if (const int k = segments(app, "source", force_sources.data(), 3, int(plots.source));
             k >= 0 && k != int(plots.source)) {
    plots.source = Source(k);
    plots.forces.clear();
  }
}

void right_controls(App& app, ImVec2 at) {
  Plots& plots = app.ui.plots;
  const float gap = app.theme.px(force_gap_at_1), y = at.y + app.theme.px(2);
  ImGui::SetCursorScreenPos(at);
  if (segments(app, "scale", force_scales.data(), 1, plots.log ? 0 : -1) == 0) plots.log = !plots.log;
  tooltip(app, gui::item_id(), plots.log ? "Back to a linear axis" : "A logarithmic axis");
  ImGui::SetCursorScreenPos({ImGui::GetItemRectMax().x + gap, y});
  if (quiet_button(app, "pause", plots.paused ? icon::play : icon::pause, plots.paused ? "run" : "hold",
                   plots.paused ? "Let the plot run again" : "Hold the plot; the simulation goes on"))
    plots.paused = !plots.paused;
  ImGui::SetCursorScreenPos({ImGui::GetItemRectMax().x + gap, y});
  if (quiet_button(app, "csv", icon::download, "CSV", "Write what the plot holds as a CSV file…"))
    app.command(Command::export_forces);
}

void force_controls(App& app, const Region& inner) {
  source_control(app);
  const bool wraps = force_controls_wrap(app, inner.size.x);
  right_controls(app, wraps ? ImVec2(inner.at.x, inner.at.y + app.theme.px(force_controls_row_at_1))
                            : ImVec2(inner.at.x + inner.size.x - right_controls_width(app), inner.at.y));
}

const char* force_title(const App& app) {
  if (app.preset().kind == Kind::one_weight) return "Forces on the weight";
  switch (app.ui.plots.source) {
    case Source::sum:
      return "Forces, summed over the cloth";
    case Source::maximum:
      return "Forces, largest on the cloth";
    case Source::particle:
      break;
  }
  return "Forces on the picked particle";
}

}  // namespace

float force_card_least(const App& app, float width) {
  const float inner = plot_card_inner_width(app, width);
  return plot_card_height(app, controls_height(app, inner) +
                                   app.theme.px(force_least_plot_at_1 + force_over_legend_at_1) +
                                   legend_places(app, inner).height);
}

void force_card(App& app, float height) {
  Plots& plots = app.ui.plots;
  plots.forces_shown = true;
  const PlotCard card(app, "forces", force_title(app), plots.paused ? "held" : plots.log ? "N, log" : "N", height);
  const Region& inner = card.inner();
  force_controls(app, inner);
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < force_keys.size(); ++k)
    if (!plots.hidden[k])
      curves.push_back(
          {force_keys[k], curve_style(app.theme.colors, force_keys[k]), plots.forces.t(), plots.forces.column(k)});
  for (PlotCurve& curve : curves) curve.gaps = plots.forces.gaps();
  const LegendPlaces places = legend_places(app, inner.size.x);
  const float head = controls_height(app, inner.size.x);
  const float plot_height = inner.size.y - head - places.height - app.theme.px(force_over_legend_at_1);
  ImGui::SetCursorScreenPos({inner.at.x, inner.at.y + head});
  const bool no_particle = plots.source == Source::particle && !app.picked;
  const PlotFrame frame =
      time_frame(app, plots.forces, plots.log, "N", no_particle ? "Right-click a particle to pick it" : why_empty(app));
  zoom_time(app, frame, draw_plot(app, "plot", {inner.size.x, plot_height}, curves, frame));
  report_control(app, "force_plot");
  legend(app, {inner.at.x, inner.at.y + inner.size.y - places.height}, places);
}

}  // namespace tyglab
