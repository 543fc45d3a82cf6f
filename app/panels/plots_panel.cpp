// The plots at the right, as cards: live forces, and y(t) of the one weight.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "app/panels/accuracy_card.h"
#include "app/panels/copies_card.h"
#include "app/panels/curves.h"
#include "app/panels/energy_card.h"
#include "app/panels/imgui_compat.h"
#include "app/panels/inside_card.h"
#include "app/panels/map_card.h"
#include "app/panels/panels.h"
#include "app/panels/performance.h"
#include "app/panels/plot.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

/// A card's ground, with its title; the cursor goes inside it.
class Card {
 public:
  /// `buttons`: how many head_buttons follow; the note stands to their left.
  Card(App& app, const char* id, std::string_view title, std::string_view note, float height, int buttons = 0) {
    const Tokens& c = app.theme.colors;
    const float padding = app.theme.px(12);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    gui::begin_child(id, {width, height}, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(lo, {lo.x + width, lo.y + height}, c.panel, app.theme.px(8));
    const float top = lo.y + padding;
    draw_text(draw, *app.fonts.title, {lo.x + padding, top}, c.text, title);
    const ImFont& small = *app.fonts.small;
    const float note_x = lo.x + width - padding - float(buttons) * head_pitch(app) - text_width(small, note);
    if (note_x > lo.x + 2 * padding + text_width(*app.fonts.title, title))
      draw_text(draw, small, {note_x, top + app.fonts.title->Ascent - small.Ascent}, c.quiet, note);
    inner_ = {{lo.x + padding, top + app.theme.px(24)}, {width - 2 * padding, height - 2 * padding - app.theme.px(24)}};
    ImGui::SetCursorScreenPos(inner_.at);
  }
  ~Card() { ImGui::EndChild(); }
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;
  const Region& inner() const { return inner_; }

  /// A button on the title's line, the n-th from the right; the cursor stays.
  bool head_button(App& app, int n, const char* id, const char* glyph, const char* word, const char* tip) const {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({inner_.at.x + inner_.size.x - float(n + 1) * head_pitch(app) + app.theme.px(4),
                               inner_.at.y - app.theme.px(28)});
    const bool clicked = quiet_button(app, id, glyph, word, tip);
    report_control(app, id);
    ImGui::SetCursorScreenPos(at);
    return clicked;
  }

 private:
  static float head_pitch(const App& app) { return app.theme.px(26); }

  Region inner_;
};

/// Clickable names of the curves; the rows that they take are `measure`d first.
float legend(App& app, const Region& place, bool measure) {
  Plots& plots = app.ui.plots;
  const float line = app.theme.px(22), gap = app.theme.px(14), sample = app.theme.px(22);
  float x = place.at.x, y = place.at.y;
  for (std::size_t k = 0; k < force_keys.size(); ++k) {
    const float width = sample + app.theme.px(6) + symbol_width(app.fonts, force_keys[k]);
    if (x > place.at.x && x + width > place.at.x + place.size.x) x = place.at.x, y += line;
    if (!measure) {
      ImGui::SetCursorScreenPos({x, y});
      ImGui::PushID(int(k));
      if (ImGui::InvisibleButton("curve", {width, line})) plots.hidden[k] = !plots.hidden[k];
      const float opacity = plots.hidden[k] ? (ImGui::IsItemHovered() ? 0.6f : 0.35f) : 1;
      CurveStyle style = curve_style(app.theme.colors, force_keys[k]);
      style.color = faded(style.color, opacity);
      const float middle = std::round(y + line / 2);
      const ImVec2 ends[2] = {{x, middle}, {x + sample, middle}};
      ImDrawList& draw = *ImGui::GetWindowDrawList();
      draw_styled_line(draw, ends, 2, style, app.theme.scale);
      draw_symbol(draw, app.fonts, {x + sample + app.theme.px(6), baseline_at(app.fonts, middle)}, force_keys[k],
                  faded(app.theme.colors.text, opacity));
      tooltip(app, gui::item_id(),
              std::string(variable(force_keys[k]).quantity) + " · " + std::string(variable(force_keys[k]).storhet),
              plots.hidden[k] ? "Click to show" : "Click to hide");
      ImGui::PopID();
    }
    x += width + gap;
  }
  return y + line - place.at.y;
}

void force_controls(App& app, const Region& inner) {
  Plots& plots = app.ui.plots;
  static constexpr const char* sources[] = {"Particle", "Sum", "Max"};
  if (app.preset().kind == Kind::one_weight) {
    plots.source = Source::particle;  // there is but one
    ImGui::Dummy({0, app.theme.px(26)});
  } else if (const int k = segments(app, "source", sources, 3, int(plots.source)); k >= 0 && k != int(plots.source)) {
    plots.source = Source(k);
    plots.forces.clear();
  }
  const float side = app.theme.px(22), gap = app.theme.px(4);
  static constexpr const char* scales[] = {"log"};
  const float log_width = text_width(*app.fonts.text, scales[0]) + 2 * app.theme.px(11);
  const float right = inner.at.x + inner.size.x - 2 * (side + gap) - log_width;
  ImGui::SameLine();
  ImGui::SetCursorScreenPos({std::max(right, ImGui::GetCursorScreenPos().x), inner.at.y});
  if (segments(app, "scale", scales, 1, plots.log ? 0 : -1) == 0) plots.log = !plots.log;
  tooltip(app, gui::item_id(), plots.log ? "Back to a linear axis" : "A logarithmic axis");
  ImGui::SameLine(0, gap);
  const float y = inner.at.y + app.theme.px(2);
  ImGui::SetCursorScreenPos({ImGui::GetCursorScreenPos().x, y});
  if (quiet_button(app, "pause", plots.paused ? icon::play : icon::pause, plots.paused ? "run" : "hold",
                   plots.paused ? "Let the plot run again" : "Hold the plot; the simulation goes on"))
    plots.paused = !plots.paused;
  ImGui::SameLine(0, gap);
  ImGui::SetCursorScreenPos({ImGui::GetCursorScreenPos().x, y});
  if (quiet_button(app, "csv", icon::download, "CSV", "Write what the plot holds as a CSV file…"))
    app.command(Command::export_forces);
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

void force_card(App& app, float height) {
  Plots& plots = app.ui.plots;
  const Card card(app, "forces", force_title(app), plots.paused ? "held" : plots.log ? "N, log" : "N", height);
  const Region& inner = card.inner();
  force_controls(app, inner);
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < force_keys.size(); ++k)
    if (!plots.hidden[k])
      curves.push_back(
          {force_keys[k], curve_style(app.theme.colors, force_keys[k]), plots.forces.t(), plots.forces.column(k)});
  const float head = app.theme.px(34), legend_height = legend(app, inner, true);
  const float plot_height = inner.size.y - head - legend_height - app.theme.px(6);
  ImGui::SetCursorScreenPos({inner.at.x, inner.at.y + head});
  const bool no_particle = plots.source == Source::particle && !app.picked;
  const PlotFrame frame =
      time_frame(app, plots.forces, plots.log, "N", no_particle ? "Right-click a particle to pick it" : why_empty(app));
  if (plot_height > app.theme.px(24))
    zoom_time(app, frame, draw_plot(app, "plot", {inner.size.x, plot_height}, curves, frame));
  legend(app, {{inner.at.x, inner.at.y + inner.size.y - legend_height}, inner.size}, false);
}

/// The report's curves beside the weight's own, which is drawn thicker; a click hides one.
void figure_legend(App& app, const Region& place) {
  Plots& plots = app.ui.plots;
  const Tokens& c = app.theme.colors;
  const ImFont& font = *app.fonts.small;
  const float sample = app.theme.px(14), gap = app.theme.px(10);
  float x = place.at.x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < Figure::curves.size(); ++k) {
    const float width = sample + app.theme.px(4) + text_width(font, Figure::titles[k]);
    if (x + width > place.at.x + place.size.x) break;
    ImGui::SetCursorScreenPos({x, place.at.y});
    ImGui::PushID(int(k));
    if (ImGui::InvisibleButton("figure", {width, place.size.y})) plots.figure_hidden[k] = !plots.figure_hidden[k];
    report_control(app, Figure::titles[k]);
    const float opacity = plots.figure_hidden[k] ? (ImGui::IsItemHovered() ? 0.6f : 0.35f) : 1;
    CurveStyle style = integrator_style(c, Figure::curves[k]);
    style.color = faded(style.color, opacity);
    const float middle = std::round(place.at.y + place.size.y / 2);
    const ImVec2 ends[2] = {{x, middle}, {x + sample, middle}};
    draw_styled_line(draw, ends, 2, style, app.theme.scale);
    draw_on_baseline(draw, font, {x + sample + app.theme.px(4), baseline_at(app.fonts, middle)}, faded(c.text, opacity),
                     Figure::titles[k]);
    tooltip(app, gui::item_id(), "As in figure 3.2: the same start, constants and dt by this method",
            plots.figure_hidden[k] ? "Click to show" : "Click to hide");
    ImGui::PopID();
    x += width + gap;
  }
}

void height_card(App& app, float height) {
  Plots& plots = app.ui.plots;
  const Card card(app, "height", "Height of the weight, y(t)", "m", height);
  const Region& inner = card.inner();
  const float side = app.theme.px(22);
  ImGui::SetCursorScreenPos({inner.at.x + inner.size.x - side, inner.at.y});
  if (quiet_button(app, "csv", icon::download, "CSV", "Write what the plot holds as a CSV file…"))
    app.command(Command::export_height);
  figure_legend(app, {inner.at, {inner.size.x - side, side}});
  const std::span<const double> t = plots.height.t();
  std::vector<PlotCurve> curves;
  for (std::size_t k = 0; k < Figure::curves.size(); ++k)
    if (!plots.figure_hidden[k]) {
      CurveStyle style = integrator_style(app.theme.colors, Figure::curves[k]);
      style.width = 1.2f;
      curves.push_back({Figure::titles[k], style, t, plots.height.column(k + 1)});
    }
  const std::size_t companions = curves.size();
  for (const auto& [since, method] : plots.height_methods) {
    const auto from = std::size_t(std::lower_bound(t.begin(), t.end(), since) - t.begin());
    if (curves.size() > companions) curves.back().to = from + 1;  // up to where the next one begins
    curves.push_back({"y", integrator_style(app.theme.colors, method), t, plots.height.column(0)});
    curves.back().from = from;
    curves.back().style.width = 2.4f;
  }
  const float head = side + app.theme.px(6);
  ImGui::SetCursorScreenPos({inner.at.x, inner.at.y + head});
  PlotFrame frame = time_frame(app, plots.height, false, "m", why_empty(app));
  frame.from_zero = false;
  zoom_time(app, frame, draw_plot(app, "plot", {inner.size.x, inner.size.y - head}, curves, frame));
}

/// A plot of the column: as a card where all have room, otherwise behind a tab.
struct PlotCard {
  const char* tab;
  void (*draw)(App&, float height);
  bool shown_when_new = true;  ///< its tab is chosen when it comes
};

void copies_plot_card(App& app, float height) {
  const bool energy = app.copies.plotted == Copies::Quantity::energy;
  const Card card(app, "copies plot", energy ? "Energy of the copies" : "Distance of the copies",
                  energy ? "J" : "m, log", height, 1);
  if (card.head_button(app, 0, "csv_copies", icon::download, "CSV", "Write what the plot holds as a CSV file…"))
    app.command(Command::export_copies);
  copies_plot(app, card.inner().size);
}

void map_plot_card(App& app, float height) {
  const bool weight = app.preset().kind == Kind::one_weight;
  const Card card(app, "map plot", weight ? "Which k and dt are stable" : "Which k_s and dt are stable",
                  app.map.busy() ? "measuring" : "", height, 3);
  if (card.head_button(app, 0, "close_map", icon::close, "×", "Close the map")) app.command(Command::toggle_map);
  if (card.head_button(app, 1, "csv_map", icon::download, "CSV", "Write the map as a CSV file…"))
    app.command(Command::export_map);
  if (card.head_button(app, 2, "png_map", icon::picture, "PNG", "Write the map as a picture…"))
    app.command(Command::export_map_picture);
  stability_map(app, card.inner().size);
}

void inside_card(App& app, float height) {
  const Card card(app, "inside", "Inside a step", "", height, 1);
  if (card.head_button(app, 0, "close_inside", icon::close, "×", "Close")) app.command(Command::toggle_inside);
  inside_step(app, card.inner().size);
}

std::vector<PlotCard> plot_cards(const App& app) {
  std::vector<PlotCard> cards;
  if (app.preset().kind == Kind::one_weight) cards.push_back({"Height", height_card});
  cards.push_back({"Forces", force_card});
  if (!app.copies.lockstep.empty()) cards.push_back({"Copies", copies_plot_card});
  if (app.settings.layout.map) cards.push_back({"Map", map_plot_card});
  if (app.settings.layout.inside) cards.push_back({"Step", inside_card});
  return cards;
}

/// A card at the foot: its heading, and under it what it holds unless it is folded.
struct FootCard {
  const char* tab;  ///< its name where it joins the plots; nullptr: it never does
  float (*wanted)(const App&);
  void (*draw)(App&, float height);
  float height = 0;
};

/// Heights of the cards at the foot, the lowest first, where the plots can spare so much room (px). What has no room, a
/// heading or an open card, joins the plots. Returns the height of those that stay, with their gaps.
float place_at_foot(App& app, std::span<FootCard> foot, float room, std::vector<PlotCard>& plots) {
  const float gap = app.theme.px(12), head = app.theme.px(card::head);
  room -= float(foot.size()) * (head + gap);
  float all = 0;
  // Those that cannot join take what there is before the others do.
  for (FootCard& card : foot)
    if (card.tab == nullptr) {
      card.height = head + std::floor(std::clamp(card.wanted(app) - head, 0.f, std::max(room, 0.f)));
      room -= card.height - head;
      all += card.height + gap;
    }
  for (FootCard& card : foot) {
    if (card.tab == nullptr) continue;
    const float more = std::ceil(card.wanted(app) - head);
    if (room < 0 || more > room) {
      plots.push_back({card.tab, card.draw, more > 0});
      room += head + gap;
    } else {
      card.height = head + more;
      room -= more;
      all += card.height + gap;
    }
  }
  return all;
}

/// The tab of a card that was not there in the last frame is chosen.
void choose_new_card(Plots& plots, std::span<const PlotCard> cards) {
  const auto known = [&](const PlotCard& card) {
    return std::find(plots.cards.begin(), plots.cards.end(), card.tab) != plots.cards.end();
  };
  for (const PlotCard& card : cards)
    if (card.shown_when_new && !plots.cards.empty() && !known(card)) plots.tab = card.tab;
  plots.cards.clear();
  for (const PlotCard& card : cards) plots.cards.emplace_back(card.tab);
}

/// Tabs for the cards; what is chosen alone remains.
void choose_tab(App& app, std::vector<PlotCard>& cards) {
  Plots& plots = app.ui.plots;
  constexpr float roomy = 11, narrow = 4;  // pixels at scale 1 to both sides of a name
  std::vector<const char*> names;
  float width = 0;
  for (const PlotCard& card : cards) {
    names.push_back(card.tab);
    width += text_width(*app.fonts.text, card.tab) + 2 * app.theme.px(roomy) + 1;
  }
  const auto found =
      std::find_if(cards.begin(), cards.end(), [&](const PlotCard& card) { return card.tab == plots.tab; });
  int chosen = found == cards.end() ? 0 : int(found - cards.begin());
  const float padding = width <= ImGui::GetContentRegionAvail().x ? roomy : narrow;
  if (const int k = segments(app, "cards", names.data(), int(names.size()), chosen, padding); k >= 0) chosen = k;
  report_control(app, "cards");
  plots.tab = names[std::size_t(chosen)];
  cards = {cards[std::size_t(chosen)]};
}

/// Which of the plots are shown in a column of that height, and how high each is.
float choose_plots(App& app, std::vector<PlotCard>& cards, float available, float gap) {
  const auto count = float(cards.size());
  const float each = (available - gap * (count - 1)) / count;
  choose_new_card(app.ui.plots, cards);
  if (cards.size() == 1)  // does not need the whole column: a plot much taller than wide is hard to read
    return std::max(0.6f * available, std::min(available, app.theme.px(420)));
  if (each >= app.theme.px(240)) return each;
  choose_tab(app, cards);
  return available - app.theme.px(26) - ImGui::GetStyle().ItemSpacing.y;
}

}  // namespace

void plots_panel(App& app, const Region& region) {
  Plots& plots = app.ui.plots;
  const float margin = app.theme.px(12), gap = app.theme.px(12);
  if (!begin_region("plots", region, app.theme.colors.ground, {margin, margin})) return end_region();
  const float column = ImGui::GetContentRegionAvail().y,
              least_plots = app.theme.px(app.settings.layout.map || app.settings.layout.inside ? 340.f : 260.f);
  std::array foot_cards{
      FootCard{"Performance", performance_card_height, performance_card},
      FootCard{"Energy", energy_card_height, energy_card}, FootCard{"Accuracy", accuracy_card_height, accuracy_card},
      FootCard{"Stability", stability_card_height, stability_card}, FootCard{nullptr, copies_card_height, copies_card}};
  std::vector<PlotCard> cards = plot_cards(app);
  const float foot = place_at_foot(app, foot_cards, column - least_plots, cards);
  const float height = choose_plots(app, cards, column - foot, gap);
  for (const PlotCard& card : cards) {
    plots.height_shown |= card.draw == height_card;
    plots.forces_shown |= card.draw == force_card;
    if (&card != cards.data()) ImGui::Dummy({0, gap - 2 * ImGui::GetStyle().ItemSpacing.y});
    card.draw(app, std::floor(height));
  }
  const float left = ImGui::GetCursorScreenPos().x;
  float lowest = region.at.y + region.size.y - margin;
  for (const FootCard& card : foot_cards) {
    if (card.height <= 0) continue;
    ImGui::SetCursorScreenPos({left, lowest - card.height});
    card.draw(app, card.height);
    lowest -= card.height + gap;
  }
  end_region();
}

}  // namespace tyglab
