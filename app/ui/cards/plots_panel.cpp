// The column of cards at the right: plots, and below them cards of lines under headings. What has no room becomes a
// tab, and where not even one card has, the column scrolls.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/ui/cards/accuracy_card.h"
#include "app/ui/cards/cards.h"
#include "app/ui/cards/copies_card.h"
#include "app/ui/cards/energy_card.h"
#include "app/ui/cards/force_card.h"
#include "app/ui/cards/height_card.h"
#include "app/ui/cards/inside_card.h"
#include "app/ui/cards/map_card.h"
#include "app/ui/cards/performance.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/card_tabs.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/plot_card.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float margin_at_1 = 12, under_tabs_at_1 = 8, tabs_at_1 = 26;  // pixels at scale 1
constexpr float tabs_stay_at_1 = 150, stacked_at_1 = 240;               // in a lower column they scroll with their card

void copies_plot_card(App& app, float height) {
  const bool energy = app.copies.plotted == Copies::Quantity::energy;
  const PlotCard card(app, "copies plot", energy ? "Energy of the copies" : "Distance of the copies",
                      energy ? "J" : "m, log", height, 1);
  if (card.head_button(app, 0, "csv_copies", icon::download, "CSV", "Write what the plot holds as a CSV file…"))
    app.command(Command::export_copies);
  copies_plot(app, card.inner().size);
}

void map_plot_card(App& app, float height) {
  const bool weight = app.preset().kind == Kind::one_weight;
  const PlotCard card(app, "map plot", weight ? "Which k and dt are stable" : "Which k_s and dt are stable",
                      app.map.busy() ? "measuring" : "", height, 3);
  if (card.head_button(app, 0, "close_map", icon::close, "×", "Close the map")) app.command(Command::toggle_map);
  if (card.head_button(app, 1, "csv_map", icon::download, "CSV", "Write the map as a CSV file…"))
    app.command(Command::export_map);
  if (card.head_button(app, 2, "png_map", icon::picture, "PNG", "Write the map as a picture…"))
    app.command(Command::export_map_picture);
  stability_map(app, card.inner().size);
}

void inside_card(App& app, float height) {
  const PlotCard card(app, "inside", "Inside a step", "", height, 1);
  if (card.head_button(app, 0, "close_inside", icon::close, "×", "Close")) app.command(Command::toggle_inside);
  inside_step(app, card.inner().size);
}

/// Height of a card of which so much (at scale 1) is the least that says something.
template <int content_at_1>
float least_of(const App& app, float) {
  return plot_card_height(app, app.theme.px(content_at_1));
}

/// A card that stands among the plots.
struct ColumnCard {
  const char* name;
  void (*draw)(App&, float height);
  float (*least)(const App&, float width);  ///< px; lower it could not be read
};

std::vector<ColumnCard> plot_cards(const App& app) {
  std::vector<ColumnCard> cards;
  if (app.preset().kind == Kind::one_weight) cards.push_back({card_name::height, height_card, height_card_least});
  cards.push_back({card_name::forces, force_card, force_card_least});
  if (!app.copies.lockstep.empty()) cards.push_back({card_name::distances, copies_plot_card, least_of<160>});
  if (app.settings.layout.map) cards.push_back({card_name::map, map_plot_card, least_of<270>});
  if (app.settings.layout.inside) cards.push_back({card_name::step, inside_card, least_of<70>});
  return cards;
}

/// A card at the foot: its heading, and under it what it holds unless it is folded.
struct FootCard {
  ColumnCard card;
  float (*wanted)(const App&);
  float height = 0;  ///< px; 0 once it has become a tab
};

/// The least of one that is not to be cut.
template <float (*wanted)(const App&)>
float whole(const App& app, float) {
  return wanted(app);
}

/// The lowest first.
std::array<FootCard, 5> foot_cards() {
  return {FootCard{{card_name::performance, performance_card, whole<performance_card_height>}, performance_card_height},
          FootCard{{card_name::energy, energy_card, whole<energy_card_height>}, energy_card_height},
          FootCard{{card_name::accuracy, accuracy_card, whole<accuracy_card_height>}, accuracy_card_height},
          FootCard{{card_name::stability, stability_card, whole<stability_card_height>}, stability_card_height},
          FootCard{{card_name::copies, copies_card, whole<copies_card_height>}, copies_card_height}};
}

/// Heights of the cards at the foot, where the plots can spare so much room (px). What has no room, a heading or an
/// open card, joins the plots. Returns the height of those that stay, with their gaps.
float place_at_foot(App& app, std::span<FootCard> foot, float room, std::vector<ColumnCard>& plots) {
  const float gap = app.theme.px(margin_at_1), head = app.theme.px(card::head);
  room -= float(foot.size()) * (head + gap);
  float all = 0;
  std::size_t joined = 0;  // of the lowest, where not even all headings have room
  for (; joined < foot.size() && room < 0; ++joined) room += head + gap;
  for (std::size_t k = foot.size(); k-- > 0;) {
    FootCard& card = foot[k];
    const float more = std::ceil(card.wanted(app) - head);
    if (k < joined || more > room) {
      plots.push_back(card.card);
      if (k >= joined) room += head + gap;
    } else {
      card.height = head + more;
      room -= more;
      all += card.height + gap;
    }
  }
  return all;
}

/// Height of a card that shares the column with others, px.
float stacked_height(const App& app, const ColumnCard& card) {
  return std::max(card.least(app, app.ui.plots.width), app.theme.px(stacked_at_1));
}

/// Cards above each other: what is left over is shared out alike. One alone does not need the whole column: a plot much
/// taller than wide is hard to read.
std::vector<float> heights_of(const App& app, std::span<const ColumnCard> cards, float available, float spare) {
  if (cards.size() == 1)
    return {std::floor(std::max(cards[0].least(app, app.ui.plots.width),
                                std::max(0.6f * available, std::min(available, app.theme.px(420)))))};
  std::vector<float> heights;
  for (const ColumnCard& card : cards)
    heights.push_back(std::floor(stacked_height(app, card) + spare / float(cards.size())));
  return heights;
}

void draw_stacked(App& app, std::span<const ColumnCard> cards, std::span<const float> heights) {
  const float left = ImGui::GetCursorScreenPos().x;
  float top = ImGui::GetCursorScreenPos().y;
  for (std::size_t k = 0; k < cards.size(); ++k) {
    ImGui::SetCursorScreenPos({left, top});
    cards[k].draw(app, heights[k]);
    top += heights[k] + app.theme.px(margin_at_1);
  }
}

/// A card that its heading has opened comes to the front where it becomes a tab; one that was folded makes room.
void draw_foldable(App& app, const ColumnCard& card, float height) {
  const std::set<std::string>& folded = app.settings.layout.folded;
  const bool before = folded.count(card.name) != 0;
  card.draw(app, height);
  const bool after = folded.count(card.name) != 0;
  if (before && !after) app.ui.plots.wanted = card.name;
  if (!before && after && app.ui.plots.tab == card.name) app.ui.plots.tab.clear();
}

/// What is seen of the column over the foot, which scrolls where that is too low for it.
void begin_scrolling(App& app, const char* id, ImVec2 size, float content) {
  app.ui.plots.scrolls = content > size.y;
  gui::begin_child(id, size);
}

/// One card, and tabs for all.
void draw_tabbed(App& app, std::span<const ColumnCard> cards, ImVec2 size) {
  Plots& plots = app.ui.plots;
  for (const ColumnCard& card : cards) plots.cards.emplace_back(card.name);
  std::vector<const char*> names;
  for (const ColumnCard& card : cards) names.push_back(card.name);
  if (std::find(plots.cards.begin(), plots.cards.end(), plots.wanted) != plots.cards.end()) plots.tab = plots.wanted;
  const auto found = std::find(plots.cards.begin(), plots.cards.end(), plots.tab);
  const int chosen = found == plots.cards.end() ? 0 : int(found - plots.cards.begin());
  const ColumnCard& card = cards[std::size_t(chosen)];
  app.settings.layout.folded.erase(card.name);  // who chooses a tab wants to see what it holds
  const CardTabs tabs(app, names, size);
  const float above = tabs.height() + app.theme.px(under_tabs_at_1), least = card.least(app, plots.width);
  const bool stay = size.y >= app.theme.px(tabs_stay_at_1);
  const float height = std::floor(std::max(size.y - above, least));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (!stay) begin_scrolling(app, card.name, size, above + height);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const int clicked = tabs.draw(app, chosen);
  ImGui::SetCursorScreenPos({top.x, top.y + above});
  if (stay)
    ImGui::SetCursorScreenPos({corner.x, corner.y + above}),
        begin_scrolling(app, card.name, {size.x, size.y - above}, height);
  draw_foldable(app, card, height);
  ImGui::EndChild();
  if (clicked >= 0) plots.tab = names[std::size_t(clicked)];
}

}  // namespace

void plots_panel(App& app, const Region& region) {
  Plots& plots = app.ui.plots;
  const float margin = app.theme.px(margin_at_1), gap = margin;
  if (!begin_region("plots", region, app.theme.colors.ground, {margin, margin})) return end_region();
  const ImVec2 column = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
  plots.width = column.x;
  plots.cards.clear();
  std::vector<ColumnCard> cards = plot_cards(app);
  const std::size_t alone = cards.size();
  float stacked = 0, tallest = 0;
  for (const ColumnCard& card : cards) {
    stacked += stacked_height(app, card) + gap;
    tallest = std::max(tallest, card.least(app, column.x));
  }
  std::array<FootCard, 5> foot = foot_cards();
  const float tabs = app.theme.px(tabs_at_1) + app.theme.px(under_tabs_at_1);
  const float available = column.y - place_at_foot(app, foot, column.y - tallest - tabs - gap, cards);
  const float spare = available - stacked + gap;
  if (cards.size() > alone || (cards.size() > 1 && spare < 0)) {
    draw_tabbed(app, cards, {column.x, available});
  } else {
    const std::vector<float> heights = heights_of(app, cards, available, spare);
    begin_scrolling(app, "column", {column.x, available}, heights.size() == 1 ? heights[0] : available);
    draw_stacked(app, cards, heights);
    ImGui::EndChild();
  }
  plots.wanted.clear();
  float lowest = corner.y + column.y;
  for (const FootCard& card : foot) {
    if (card.height <= 0) continue;
    ImGui::SetCursorScreenPos({corner.x, lowest - card.height});
    draw_foldable(app, card.card, card.height);
    lowest -= card.height + gap;
  }
  end_region();
}

}  // namespace tyglab
