#include "app/ui/cards/cards.h"

#include <algorithm>

#include "app/ui/state/ui.h"

namespace tyglab {

bool in_front(const Ui& ui, std::string_view name) {
  const Plots& plots = ui.plots;
  return plots.tab == name && std::find(plots.cards.begin(), plots.cards.end(), name) != plots.cards.end();
}

void show_card(Ui& ui, std::string_view name) {
  Layout& layout = ui.settings.layout;
  layout.right = ui.panels = ui.side_plots = true;
  ui.side_cloth = false;
  layout.folded.erase(std::string(name));
  ui.plots.wanted = name;
}

}  // namespace tyglab
