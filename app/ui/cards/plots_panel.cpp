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
#include "app/ui/cards/plots_panel.h"
#include "app/ui/kit/card_tabs.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/plot_card.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float margin_at_1 = 12, under_tabs_at_1 = 8, tabs_at_1 = 26;  // pixels at scale 1
constexpr float tabs_stay_at_1 = 150, stacked_at_1 = 240;               // in a lower column they scroll with their card

void copies_plot_card(Ui& ui, float height) {
  const bool energy = ui.session.copies.plotted == Copies::Quantity::energy;
  const PlotCard card(ui, "copies plot", energy ? "Energy of the copies" : "Distance of the copies",
                      energy ? "J" : "m, log", height, 1);
  if (card.head_button(ui, 0, "csv_copies", icon::download, "CSV", "Export the plot as CSV…"))
    ui.command("export_copies");
  copies_plot(ui, card.inner().size);
}

void map_plot_card(Ui& ui, float height) {
  const bool weight = ui.session.preset().kind == Kind::one_weight;
  const PlotCard card(ui, "map plot", weight ? "Which k and dt are stable" : "Which k_s and dt are stable",
                      ui.session.studies.map.working() ? "measuring" : "", height, 3);
  if (card.head_button(ui, 0, "close_map", icon::close, "×", "Close the map")) ui.command("toggle_map");
  if (card.head_button(ui, 1, "csv_map", icon::download, "CSV", "Export the map as CSV…")) ui.command("export_map");
  if (card.head_button(ui, 2, "png_map", icon::picture, "PNG", "Export the map as a PNG image…"))
    ui.command("export_map_picture");
  stability_map(ui, card.inner().size);
}

void inside_card(Ui& ui, float height) {
  const PlotCard card(ui, "inside", "Inside a step", "", height, 1);
  if (card.head_button(ui, 0, "close_inside", icon::close, "×", "Close")) ui.command("toggle_inside");
  inside_step(ui, card.inner().size);
}

/// Height of a card of which that much (at scale 1) is the least that says something.
template <int content_at_1>
float least_of(const Ui& ui, float) {
  return plot_card_height(ui, ui.theme.px(content_at_1));
}

/// A card of the column: it draws itself, says how low it may become, and what it wants to be worked out while it is
/// open.
struct Card {
  const char* name;
  void (*draw)(Ui&, float height);
  float (*least)(const Ui&, float width);  ///< px; lower it could not be read
  Wants (*wants)(const Ui&) = nullptr;     ///< null: nothing
};

template <bool Wants::*need>
Wants needs(const Ui&) {
  Wants wants;
  wants.*need = true;
  return wants;
}

Wants accuracy_wants(const Ui& ui) {
  Wants wants;
  if (ui.session.simulation->lattice().size() > AccuracyWatch::largest) return wants;
  (ui.plots.convergence ? wants.convergence : wants.accuracy) = true;
  return wants;
}

std::vector<Card> plot_cards(const Ui& ui) {
  std::vector<Card> cards;
  const Session& session = ui.session;
  if (session.preset().kind == Kind::one_weight)
    cards.push_back({card_name::height, height_card, height_card_least, needs<&Wants::height>});
  cards.push_back({card_name::forces, force_card, force_card_least, needs<&Wants::forces>});
  if (!session.copies.lockstep.empty())
    cards.push_back({card_name::distances, copies_plot_card, least_of<160>, needs<&Wants::copies>});
  if (ui.settings.layout.map) cards.push_back({card_name::map, map_plot_card, least_of<270>, needs<&Wants::map>});
  if (ui.settings.layout.inside) cards.push_back({card_name::step, inside_card, least_of<70>, needs<&Wants::step>});
  return cards;
}

/// A card at the foot: its heading, and under it what it holds unless it is folded.
struct FootCard {
  Card card;
  float (*wanted)(const Ui&);
  float height = 0;  ///< px; 0 once it has become a tab
};

/// The least of one that is not to be cut.
template <float (*wanted)(const Ui&)>
float whole(const Ui& ui, float) {
  return wanted(ui);
}

template <float (*height)(const Ui&)>
FootCard foot_card(const char* name, void (*draw)(Ui&, float), Wants (*wants)(const Ui&)) {
  return {{name, draw, whole<height>, wants}, height};
}

/// The lowest first.
std::array<FootCard, 5> foot_cards() {
  return {foot_card<performance_card_height>(card_name::performance, performance_card, nullptr),
          foot_card<energy_card_height>(card_name::energy, energy_card, needs<&Wants::ledger>),
          foot_card<accuracy_card_height>(card_name::accuracy, accuracy_card, accuracy_wants),
          foot_card<stability_card_height>(card_name::stability, stability_card, needs<&Wants::stability>),
          foot_card<copies_card_height>(card_name::copies, copies_card, needs<&Wants::copies>)};
}

/// Draws it, and notes what it wants unless it is folded.
void draw_card(Ui& ui, const Card& card, float height) {
  if (card.wants != nullptr && ui.settings.layout.folded.count(card.name) == 0) ui.wants |= card.wants(ui);
  card.draw(ui, height);
}

/// Heights of the cards at the foot, where the plots can spare that much room (px). What has no room, a heading or an
/// open card, joins the plots. Returns the height of those that stay, with their gaps.
float place_at_foot(Ui& ui, std::span<FootCard> foot, float room, std::vector<Card>& plots) {
  const float gap = ui.theme.px(margin_at_1), head = ui.theme.px(card::head);
  room -= float(foot.size()) * (head + gap);
  float all = 0;
  std::size_t joined = 0;  // of the lowest, where not even all headings have room
  for (; joined < foot.size() && room < 0; ++joined) room += head + gap;
  for (std::size_t k = foot.size(); k-- > 0;) {
    FootCard& card = foot[k];
    const float more = std::ceil(card.wanted(ui) - head);
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
float stacked_height(const Ui& ui, const Card& card) {
  return std::max(card.least(ui, ui.plots.width), ui.theme.px(stacked_at_1));
}

/// Cards above each other: what is left over is shared out alike. One alone does not need the whole column: a plot much
/// taller than wide is hard to read.
std::vector<float> heights_of(const Ui& ui, std::span<const Card> cards, float available, float spare) {
  if (cards.size() == 1)
    return {std::floor(std::max(cards[0].least(ui, ui.plots.width),
                                std::max(0.6f * available, std::min(available, ui.theme.px(420)))))};
  std::vector<float> heights;
  for (const Card& card : cards) heights.push_back(std::floor(stacked_height(ui, card) + spare / float(cards.size())));
  return heights;
}

void draw_stacked(Ui& ui, std::span<const Card> cards, std::span<const float> heights) {
  const float left = ImGui::GetCursorScreenPos().x;
  float top = ImGui::GetCursorScreenPos().y;
  for (std::size_t k = 0; k < cards.size(); ++k) {
    ImGui::SetCursorScreenPos({left, top});
    draw_card(ui, cards[k], heights[k]);
    top += heights[k] + ui.theme.px(margin_at_1);
  }
}

/// A card that its heading has opened comes to the front where it becomes a tab; one that was folded makes room.
void draw_foldable(Ui& ui, const Card& card, float height) {
  const std::set<std::string>& folded = ui.settings.layout.folded;
  const bool before = folded.count(card.name) != 0;
  draw_card(ui, card, height);
  const bool after = folded.count(card.name) != 0;
  if (before && !after) ui.plots.wanted = card.name;
  if (!before && after && ui.plots.tab == card.name) ui.plots.tab.clear();
}

/// What is seen of the column over the foot, which scrolls where that is too low for it.
void begin_scrolling(Ui& ui, const char* id, ImVec2 size, float content) {
  ui.wheel_scrolls = content > size.y;
  gui::begin_child(id, size);
}

/// One card, and tabs for all.
void draw_tabbed(Ui& ui, std::span<const Card> cards, ImVec2 size) {
  Plots& plots = ui.plots;
  for (const Card& card : cards) plots.cards.emplace_back(card.name);
  std::vector<const char*> names;
  for (const Card& card : cards) names.push_back(card.name);
  if (std::find(plots.cards.begin(), plots.cards.end(), plots.wanted) != plots.cards.end()) plots.tab = plots.wanted;
  const auto found = std::find(plots.cards.begin(), plots.cards.end(), plots.tab);
  const int chosen = found == plots.cards.end() ? 0 : int(found - plots.cards.begin());
  const Card& card = cards[std::size_t(chosen)];
  ui.settings.layout.folded.erase(card.name);  // who chooses a tab wants to see what it holds
  const CardTabs tabs(ui, names, size);
  const float above = tabs.height() + ui.theme.px(under_tabs_at_1), least = card.least(ui, plots.width);
  const bool stay = size.y >= ui.theme.px(tabs_stay_at_1);
  const float height = std::floor(std::max(size.y - above, least));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (!stay) begin_scrolling(ui, card.name, size, above + height);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const int clicked = tabs.draw(ui, chosen);
  ImGui::SetCursorScreenPos({top.x, top.y + above});
  if (stay)
    ImGui::SetCursorScreenPos({corner.x, corner.y + above}),
        begin_scrolling(ui, card.name, {size.x, size.y - above}, height);
  draw_foldable(ui, card, height);
  ImGui::EndChild();
  if (clicked >= 0) plots.tab = names[std::size_t(clicked)];
}

}  // namespace

void plots_panel(Ui& ui, const Region& region) {
  Plots& plots = ui.plots;
  const float margin = ui.theme.px(margin_at_1), gap = margin;
  if (!begin_region("plots", region, ui.theme.colors.ground, {margin, margin})) return end_region();
  const ImVec2 column = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
  plots.width = column.x;
  plots.cards.clear();
  std::vector<Card> cards = plot_cards(ui);
  const std::size_t alone = cards.size();
  float stacked = 0, tallest = 0;
  for (const Card& card : cards) {
    stacked += stacked_height(ui, card) + gap;
    tallest = std::max(tallest, card.least(ui, column.x));
  }
  std::array<FootCard, 5> foot = foot_cards();
  const float tabs = ui.theme.px(tabs_at_1) + ui.theme.px(under_tabs_at_1);
  const float available = column.y - place_at_foot(ui, foot, column.y - tallest - tabs - gap, cards);
  const float spare = available - stacked + gap;
  if (cards.size() > alone || (cards.size() > 1 && spare < 0)) {
    draw_tabbed(ui, cards, {column.x, available});
  } else {
    const std::vector<float> heights = heights_of(ui, cards, available, spare);
    begin_scrolling(ui, "column", {column.x, available}, heights.size() == 1 ? heights[0] : available);
    draw_stacked(ui, cards, heights);
    ImGui::EndChild();
  }
  plots.wanted.clear();
  float lowest = corner.y + column.y;
  for (const FootCard& card : foot) {
    if (card.height <= 0) continue;
    ImGui::SetCursorScreenPos({corner.x, lowest - card.height});
    draw_foldable(ui, card.card, card.height);
    lowest -= card.height + gap;
  }
  end_region();
}

}  // namespace tyglab
