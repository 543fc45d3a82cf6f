// The column of cards at the right: plots, and below them tools under headings, in a fixed order. An opened tool takes
// room from the plots while these remain readable; after that the tools scroll, and if even the plots have no room, the
// whole column scrolls. Plots without room for all of them share tabs.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/cards/cards.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float margin_at_1 = 12, under_tabs_at_1 = 8, tabs_at_1 = 26;  // pixels at scale 1
constexpr float tabs_stay_at_1 = 150, stacked_at_1 = 240;               // in a lower column they scroll with their card
constexpr float least_part = 0.34f;                                     // of the column, for plots
constexpr float least_tools_at_1 = 160;                                 // lower they would hardly be seen

void copies_plot_card(Ui& ui, float height) {
  const bool energy = ui.session.copies.plotted == Copies::Quantity::energy;
  const PlotCard card(ui, "copies plot", energy ? "Energy of the copies" : "Distance of the copies",
                      energy ? "" : "log", height, 1);
  if (card.head_button(ui, 0, "csv_copies", icon::download, "CSV", "Export the plot as CSV…"))
    ui.command("export_copies");
  copies_plot(ui, card.inner().size);
}

void map_plot_card(Ui& ui, float height) {
  const bool weight = ui.session.preset().kind == Kind::one_weight;
  const char* title = weight ? "Which k and dt are stable" : "Which k_s and dt are stable";
  constexpr int buttons = 3;
  const bool fits = text_width(*ui.fonts.title, title) <= plot_card_title_width(ui, ui.plots.width, buttons);
  const PlotCard card(ui, "map plot", fits ? title : card_name::map,
                      ui.session.studies.map.working() ? "measuring" : "", height, buttons);
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

void verification_card(Ui& ui, float height) {
  const PlotCard card(ui, "verification", card_name::verification, "", height, 1);
  if (card.head_button(ui, 0, "close_verification", icon::close, "×", "Close")) ui.command("toggle_verification");
  verification(ui, card.inner().size);
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
  return cards;
}

/// Under headings that fold them, but for the map and the step, which come and go.
std::vector<Card> tool_cards(const Ui& ui) {
  const bool small = ui.session.simulation->lattice().size() <= AccuracyWatch::largest;
  static constexpr std::array sides{&Wants::accuracy, &Wants::convergence, &Wants::settings};
  const auto accuracy = sides[std::size_t(ui.plots.accuracy)];
  std::vector<Card> cards{{card_name::copies, copies_card, copies_card_height, &Wants::copies},
                          {card_name::stability, stability_card, stability_card_height, &Wants::stability}};
  if (ui.settings.layout.map) cards.push_back({card_name::map, map_plot_card, least_of<330>, &Wants::map});
  cards.push_back({card_name::accuracy, accuracy_card, accuracy_card_height, small ? accuracy : nullptr});
  cards.push_back({card_name::energy, energy_card, energy_card_height, &Wants::ledger});
  if (ui.settings.layout.inside) cards.push_back({card_name::step, inside_card, least_of<330>, &Wants::step});
  if (ui.plots.verification)
    cards.push_back({card_name::verification, verification_card, least_of<330>, &Wants::verification});
  cards.push_back({card_name::performance, performance_card, performance_card_height, &Wants::crossings});
  return cards;
}

/// What of the column is seen, and how high: known before any of it is drawn.
struct ColumnPlan {
  std::vector<Card> plots, tools;
  float plots_height = 0, tools_height = 0;  ///< px, of what is seen of them
  bool scrolls = false;                      ///< both together
  bool tabs = false;                         ///< one of the plots is seen
  std::size_t chosen = 0;                    ///< which one
  std::vector<float> heights{};              ///< px, of plots above each other
  std::vector<float> tool_heights{};         ///< px
};

/// Cards above each other, with the gaps between them, px.
float total(const Ui& ui, std::span<const float> heights) {
  float sum = heights.empty() ? 0 : -ui.theme.px(margin_at_1);
  for (const float height : heights) sum += height + ui.theme.px(margin_at_1);
  return sum;
}

std::vector<float> least_heights(const Ui& ui, std::span<const Card> cards, float width) {
  std::vector<float> heights;
  for (const Card& card : cards) heights.push_back(std::ceil(card.least(ui, width)));
  return heights;
}

/// Index of the card whose tab is chosen: the one that is to come to the front, the one that is there, or the first.
std::size_t chosen_tab(const Plots& plots, std::span<const Card> cards) {
  for (const std::string& name : {plots.wanted, plots.tab}) {
    const auto found = std::find_if(cards.begin(), cards.end(), [&](const Card& card) { return card.name == name; });
    if (found != cards.end()) return std::size_t(found - cards.begin());
  }
  return 0;
}

/// Of the plots above each other what is left over is shared out alike. One alone takes all of it, up to where it would
/// be too tall for its width to be read.
std::vector<float> shared_out(const Ui& ui, std::vector<float> heights, float width, float room) {
  constexpr float tallest = 1.6f;
  if (heights.size() == 1) return {std::floor(std::max({heights[0], 0.6f * room, std::min(room, tallest * width)}))};
  const float spare = (room - total(ui, heights)) / float(heights.size());
  for (float& height : heights) height = std::floor(height + spare);
  return heights;
}

ColumnPlan plan_column(const Ui& ui, ImVec2 column) {
  const float gap = ui.theme.px(margin_at_1), tabs = ui.theme.px(tabs_at_1) + ui.theme.px(under_tabs_at_1);
  ColumnPlan plan{plot_cards(ui), tool_cards(ui)};
  if (ui.presenting) {
    for (const Card& card : std::exchange(plan.tools, {})) plan.plots.push_back(card);
    plan.plots_height = column.y, plan.tabs = true, plan.chosen = chosen_tab(ui.plots, plan.plots);
    return plan;
  }
  std::vector<float> least = least_heights(ui, plan.plots, column.x);
  const float tallest = *std::max_element(least.begin(), least.end());
  const float least_plots = std::max(tallest, std::floor(least_part * column.y)) + (least.size() > 1 ? tabs : 0);
  plan.tool_heights = least_heights(ui, plan.tools, column.x);
  const float room = column.y - least_plots - gap;
  if (total(ui, plan.tool_heights) > room)  // beside a scroll bar
    plan.tool_heights = least_heights(ui, plan.tools, column.x - ImGui::GetStyle().ScrollbarSize);
  const float wanted = total(ui, plan.tool_heights);
  plan.scrolls = wanted > room && room < ui.theme.px(least_tools_at_1);
  plan.tools_height = plan.scrolls ? wanted : std::min(wanted, room);
  plan.plots_height = plan.scrolls ? least_plots : column.y - plan.tools_height - gap;
  for (float& height : least) height = std::max(height, ui.theme.px(least.size() > 1 ? stacked_at_1 : 0));
  plan.tabs = least.size() > 1 && total(ui, least) > plan.plots_height;
  plan.chosen = chosen_tab(ui.plots, plan.plots);
  plan.heights = shared_out(ui, std::move(least), column.x, plan.plots_height);
  return plan;
}

/// Size of the column in its region.
ImVec2 column_size(const Ui& ui, ImVec2 region) {
  const float margins = 2 * ui.theme.px(margin_at_1);
  return {region.x - margins, region.y - margins};
}

/// A card that its heading has opened comes into sight; one that was folded makes room.
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

/// Scrolls so that the first tool that is seen stays where it is, whatever opens or closes above it; what is to come
/// into sight goes first.
void keep_in_place(Ui& ui, std::span<const Card> tools, std::span<const float> heights) {
  const auto before = std::exchange(ui.plots.anchor, std::nullopt);
  const auto is_wanted = [&](const Card& card) { return card.name == ui.plots.wanted; };
  const bool wanted = std::any_of(tools.begin(), tools.end(), is_wanted);
  const float scroll = ImGui::GetScrollY();
  float from = ImGui::GetCursorPosY();
  for (std::size_t k = 0; k < tools.size(); ++k) {
    if (!wanted && before && before->card == tools[k].name && before->from != from)
      ImGui::SetScrollY(std::max(scroll + from - before->from, 0.f));
    if (!ui.plots.anchor && from >= scroll) ui.plots.anchor = CardAnchor{tools[k].name, from};
    from += heights[k] + ui.theme.px(margin_at_1);
  }
}

/// Cards above each other; scrolls so that the one that is wanted is seen.
void draw_stacked(Ui& ui, std::span<const Card> cards, std::span<const float> heights, float seen) {
  const float left = ImGui::GetCursorScreenPos().x;
  float top = ImGui::GetCursorScreenPos().y;
  for (std::size_t k = 0; k < cards.size(); ++k) {
    ImGui::SetCursorScreenPos({left, top});
    const float from = ImGui::GetCursorPosY(), to = from + heights[k];
    const bool wanted = ui.plots.wanted == cards[k].name;
    draw_foldable(ui, cards[k], heights[k]);
    if (wanted && (from < ImGui::GetScrollY() || heights[k] >= seen)) {
      ImGui::SetScrollFromPosY(from - ImGui::GetScrollY(), 0);
    } else if (wanted && to > ImGui::GetScrollY() + seen) {
      ImGui::SetScrollFromPosY(to - ImGui::GetScrollY(), 1);
    }
    top += heights[k] + ui.theme.px(margin_at_1);
  }
}

/// One card, and tabs for all.
void draw_tabbed(Ui& ui, std::span<const Card> cards, std::size_t chosen, ImVec2 size) {
  Plots& plots = ui.plots;
  std::vector<const char*> names;
  for (const Card& card : cards) names.push_back(card.name);
  plots.cards.assign(names.begin(), names.end());
  const Card& card = cards[chosen];
  if (card.name == plots.wanted) plots.tab = plots.wanted;
  ui.settings.layout.folded.erase(card.name);  // who chooses a tab wants to see what it holds
  const CardTabs tabs(ui, names, size);
  const float above = tabs.height() + ui.theme.px(under_tabs_at_1), least = card.least(ui, plots.width);
  const bool stay = size.y >= ui.theme.px(tabs_stay_at_1);
  const float height = std::floor(std::max(size.y - above, least));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (!stay) begin_scrolling(ui, card.name, size, above + height);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const int clicked = tabs.draw(ui, int(chosen));
  ImGui::SetCursorScreenPos({top.x, top.y + above});
  if (stay)
    ImGui::SetCursorScreenPos({corner.x, corner.y + above}),
        begin_scrolling(ui, card.name, {size.x, size.y - above}, height);
  draw_foldable(ui, card, height);
  ImGui::EndChild();
  if (clicked >= 0) plots.tab = names[std::size_t(clicked)];
}

void draw_plots(Ui& ui, const ColumnPlan& plan, float width) {
  if (plan.tabs) return draw_tabbed(ui, plan.plots, plan.chosen, {width, plan.plots_height});
  draw_stacked(ui, plan.plots, plan.heights, plan.plots_height);
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
  const std::string wanted = plots.wanted;
  const float below = plan.plots_height + margin;
  if (plan.scrolls) {
    begin_scrolling(ui, "column", column, below + plan.tools_height);
    const ImVec2 top = ImGui::GetCursorScreenPos();
    draw_plots(ui, plan, ImGui::GetContentRegionAvail().x);
    ui.wheel_scrolls = true;
    ImGui::SetCursorScreenPos({top.x, top.y + below});
    keep_in_place(ui, plan.tools, plan.tool_heights);
    draw_stacked(ui, plan.tools, plan.tool_heights, column.y);
    ImGui::EndChild();
  } else {
    ui.wheel_scrolls = false;
    draw_plots(ui, plan, column.x);
    ImGui::SetCursorScreenPos({corner.x, corner.y + below});
    begin_scrolling(ui, "tools", {column.x, plan.tools_height}, total(ui, plan.tool_heights));
    keep_in_place(ui, plan.tools, plan.tool_heights);
    draw_stacked(ui, plan.tools, plan.tool_heights, plan.tools_height);
    ImGui::EndChild();
  }
  if (plots.wanted == wanted) plots.wanted.clear();  // what a heading has opened is high enough in the next frame
  end_region();
}

Wants plots_want(const Ui& ui, ImVec2 size, bool take_turns) {
  Wants wants;
  // Who asked for a search may look at something else meanwhile: it ends with its card.
  wants.settings_kept = ui.settings.layout.folded.count(card_name::accuracy) == 0;
  const auto add = [&](const Card& card) {
    if (card.wants != nullptr) wants.*card.wants = true;
  };
  const auto open = [&](const Card& card) { return ui.settings.layout.folded.count(card.name) == 0; };
  if (size.x <= 0) {
    if (!take_turns) return wants;
    // Who pulls the cloth looks at its forces afterwards, in the same place; and who reads a lab, at what it shows.
    for (const Card& card : plot_cards(ui))
      if (open(card)) add(card);
    const char* const of_lab = ui.session.labs.run ? card_of_lab(ui.session.labs.run->shown()) : nullptr;
    for (const Card& card : tool_cards(ui))
      if (card.name == of_lab && open(card)) add(card);
    return wants;
  }
  const ColumnPlan plan = plan_column(ui, column_size(ui, size));
  for (std::size_t k = 0; k < plan.plots.size(); ++k)
    if (!plan.tabs || k == plan.chosen) add(plan.plots[k]);
  for (const Card& card : plan.tools)
    if (open(card)) add(card);
  return wants;
}

}  // namespace tyglab
