#include "app/ui/cards/cards.h"

#include <algorithm>

#include "app/ui/state/ui.h"

namespace tyglab {

bool in_front(const Ui& ui, std::string_view name) {
  const Plots& plots = ui.plots;
  return plots.tab == name && std::find(plots.cards.begin(), plots.cards.end(), name) != plots.cards.end();
}

bool in_sight(const Ui& ui, std::string_view name) {
  const Wants& wants = ui.wants;
  return name == card_name::map ? wants.map : name == card_name::step ? wants.step : in_front(ui, name);
}

void show_card(Ui& ui, std::string_view name) {
  Layout& layout = ui.settings.layout;
  layout.right = ui.panels = ui.side_plots = true;
  ui.side_cloth = false;
  layout.folded.erase(std::string(name));
  ui.plots.wanted = name;
}

void toggle_card(Ui& ui, std::string_view name, bool Layout::*there) {
  bool& open = ui.settings.layout.*there;
  open = !(open && in_sight(ui, name));
  if (open) show_card(ui, name);
}

}  // namespace tyglab
