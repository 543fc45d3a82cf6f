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
  bool Wants::*wants = nullptr;            ///< null: nothing
};

std::vector<Card> plot_cards(const Ui& ui) {
  std::vector<Card> cards;
  const Session& session = ui.session;
  if (session.preset().kind == Kind::one_weight)
    cards.push_back({card_name::height, height_card, height_card_least, &Wants::height});
  cards.push_back({card_name::forces, force_card, force_card_least, &Wants::forces});
  if (!session.copies.lockstep.empty())
    cards.push_back({card_name::distances, copies_plot_card, least_of<160>, &Wants::copies});
  if (ui.settings.layout.map) cards.push_back({card_name::map, map_plot_card, least_of<270>, &Wants::map});
  if (ui.settings.layout.inside) cards.push_back({card_name::step, inside_card, least_of<70>, &Wants::step});
  return cards;
}

/// A card at the foot: its heading, and under it what it holds unless it is folded. It is never cut.
struct FootCard {
  Card card;
  float height = 0;  ///< px; 0 once it has become a tab
};
using Foot = std::array<FootCard, 5>;

/// The lowest first.
Foot foot_cards(const Ui& ui) {
  const bool small = ui.session.simulation->lattice().size() <= AccuracyWatch::largest;
  static constexpr std::array sides{&Wants::accuracy, &Wants::convergence, &Wants::settings};
  const auto accuracy = sides[std::size_t(ui.plots.accuracy)];
  return {{{{card_name::performance, performance_card, performance_card_height}},
           {{card_name::energy, energy_card, energy_card_height, &Wants::ledger}},
           {{card_name::accuracy, accuracy_card, accuracy_card_height, small ? accuracy : nullptr}},
           {{card_name::stability, stability_card, stability_card_height, &Wants::stability}},
           {{card_name::copies, copies_card, copies_card_height, &Wants::copies}}}};
}

/// What of the column is seen, and how high: known before any of it is drawn.
struct ColumnPlan {
  std::vector<Card> cards;       ///< above the foot: one above the other, or behind tabs
  Foot foot;                     ///< what stands below them
  float available = 0;           ///< px, height above the foot
  bool tabs = false;             ///< one of the cards is seen
  std::size_t chosen = 0;        ///< which one
  std::vector<float> heights{};  ///< of those above each other, px
};

/// Heights of the cards at the foot, where the plots can spare that much room (px). What has no room, a heading or an
/// open card, joins the plots. Returns the height of those that stay, with their gaps.
float place_at_foot(const Ui& ui, float width, float room, Foot& foot, std::vector<Card>& plots) {
  const float gap = ui.theme.px(margin_at_1), head = ui.theme.px(card::head);
  room -= float(foot.size()) * (head + gap);
  float all = 0;
  std::size_t joined = 0;  // of the lowest, where not even all headings have room
  for (; joined < foot.size() && room < 0; ++joined) room += head + gap;
  for (std::size_t k = foot.size(); k-- > 0;) {
    FootCard& card = foot[k];
    const float more = std::ceil(card.card.least(ui, width) - head);
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

/// Index of the card whose tab is chosen: the one that is to come to the front, the one that is there, or the first.
std::size_t chosen_tab(const Plots& plots, std::span<const Card> cards) {
  for (const std::string& name : {plots.wanted, plots.tab}) {
    const auto found = std::find_if(cards.begin(), cards.end(), [&](const Card& card) { return card.name == name; });
    if (found != cards.end()) return std::size_t(found - cards.begin());
  }
  return 0;
}

ColumnPlan plan_column(const Ui& ui, ImVec2 column) {
  const float gap = ui.theme.px(margin_at_1), tabs = ui.theme.px(tabs_at_1) + ui.theme.px(under_tabs_at_1);
  ColumnPlan plan{plot_cards(ui), foot_cards(ui)};
  if (ui.presenting) {
    for (const FootCard& card : plan.foot) plan.cards.push_back(card.card);
    plan.available = column.y, plan.tabs = true, plan.chosen = chosen_tab(ui.plots, plan.cards);
    return plan;
  }
  float stacked = 0, tallest = 0;
  for (const Card& card : plan.cards) {
    const float least = card.least(ui, column.x);
    plan.heights.push_back(std::max(least, ui.theme.px(stacked_at_1)));
    stacked += plan.heights.back() + gap;
    tallest = std::max(tallest, least);
  }
  const float alone = float(plan.cards.size());
  plan.available = column.y - place_at_foot(ui, column.x, column.y - tallest - tabs - gap, plan.foot, plan.cards);
  const float spare = plan.available - stacked + gap;
  plan.tabs = plan.cards.size() > plan.heights.size() || (plan.cards.size() > 1 && spare < 0);
  plan.chosen = chosen_tab(ui.plots, plan.cards);
  // What is left over is shared out alike; one alone does not need the whole column: a plot much taller than wide is
  // hard to read.
  for (float& height : plan.heights) height = std::floor(height + spare / alone);
  if (plan.heights.size() == 1)
    plan.heights[0] =
        std::floor(std::max({tallest, 0.6f * plan.available, std::min(plan.available, ui.theme.px(420))}));
  return plan;
}

/// Size of the column in its region.
ImVec2 column_size(const Ui& ui, ImVec2 region) {
  const float margins = 2 * ui.theme.px(margin_at_1);
  return {region.x - margins, region.y - margins};
}

void draw_stacked(Ui& ui, std::span<const Card> cards, std::span<const float> heights) {
  const float left = ImGui::GetCursorScreenPos().x;
  float top = ImGui::GetCursorScreenPos().y;
  for (std::size_t k = 0; k < cards.size(); ++k) {
    ImGui::SetCursorScreenPos({left, top});
    cards[k].draw(ui, heights[k]);
    top += heights[k] + ui.theme.px(margin_at_1);
  }
}

/// A card that its heading has opened comes to the front where it becomes a tab; one that was folded makes room.
void draw_foldable(Ui& ui, const Card& card, float height) {
  const std::set<std::string>& folded = ui.settings.layout.folded;
  const bool before = folded.count(card.name) != 0;
  card.draw(ui, height);
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
void draw_tabbed(Ui& ui, const ColumnPlan& plan, float width) {
  Plots& plots = ui.plots;
  std::vector<const char*> names;
  for (const Card& card : plan.cards) names.push_back(card.name);
  plots.cards.assign(names.begin(), names.end());
  const Card& card = plan.cards[plan.chosen];
  if (card.name == plots.wanted) plots.tab = plots.wanted;
  ui.settings.layout.folded.erase(card.name);  // who chooses a tab wants to see what it holds
  const ImVec2 size{width, plan.available};
  const CardTabs tabs(ui, names, size);
  const float above = tabs.height() + ui.theme.px(under_tabs_at_1), least = card.least(ui, plots.width);
  const bool stay = size.y >= ui.theme.px(tabs_stay_at_1);
  const float height = std::floor(std::max(size.y - above, least));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (!stay) begin_scrolling(ui, card.name, size, above + height);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const int clicked = tabs.draw(ui, int(plan.chosen));
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
  const float margin = ui.theme.px(margin_at_1);
  if (!begin_region("plots", region, ui.theme.colors.ground, {margin, margin})) return end_region();
  const ImVec2 column = column_size(ui, region.size), corner = ImGui::GetCursorScreenPos();
  plots.width = column.x;
  plots.cards.clear();
  const ColumnPlan plan = plan_column(ui, column);
  if (plan.tabs) {
    draw_tabbed(ui, plan, column.x);
  } else {
    begin_scrolling(ui, "column", {column.x, plan.available},
                    plan.heights.size() == 1 ? plan.heights[0] : plan.available);
    draw_stacked(ui, plan.cards, plan.heights);
    ImGui::EndChild();
  }
  plots.wanted.clear();
  float lowest = corner.y + column.y;
  for (const FootCard& card : plan.foot) {
    if (card.height <= 0) continue;
    ImGui::SetCursorScreenPos({corner.x, lowest - card.height});
    draw_foldable(ui, card.card, card.height);
    lowest -= card.height + margin;
  }
  end_region();
}

Wants plots_want(const Ui& ui, ImVec2 size) {
  const ColumnPlan plan = plan_column(ui, column_size(ui, size));
  Wants wants;
  const auto add = [&](const Card& card) {
    if (card.wants != nullptr) wants.*card.wants = true;
  };
  for (std::size_t k = 0; k < plan.cards.size(); ++k)
    if (!plan.tabs || k == plan.chosen) add(plan.cards[k]);
  for (const FootCard& card : plan.foot)
    if (card.height > 0 && ui.settings.layout.folded.count(card.card.name) == 0) add(card.card);
  return wants;
}

}  // namespace tyglab
