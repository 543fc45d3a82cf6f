#include "app/ui/cards/cards.h"

#include <algorithm>

#include "app/ui/app.h"

namespace tyglab {

bool in_front(const App& app, std::string_view name) {
  const Plots& plots = app.ui.plots;
  return plots.tab == name && std::find(plots.cards.begin(), plots.cards.end(), name) != plots.cards.end();
}

void show_card(App& app, std::string_view name) {
  Layout& layout = app.settings.layout;
  layout.right = app.ui.panels = app.ui.side_plots = true;
  app.ui.side_cloth = false;
  layout.folded.erase(std::string(name));
  app.ui.plots.wanted = name;
}

void toggle_card(App& app, std::string_view name, bool Layout::*there, bool seen) {
  bool& open = app.settings.layout.*there;
  open = !(open && seen);
  if (open) show_card(app, name);
}

}  // namespace tyglab
