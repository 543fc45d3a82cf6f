#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>

#include "app/session/lab.h"
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

void show_for_lab(Ui& ui, std::string_view name) {
  constexpr std::array names{card_name::forces,   card_name::height, card_name::stability,
                             card_name::accuracy, card_name::energy, card_name::performance,
                             card_name::copies,   card_name::map,    card_name::step};
  static_assert(names.size() == lab_cards.size());
  const auto found = std::find(lab_cards.begin(), lab_cards.end(), name);
  if (found == lab_cards.end()) return;
  const char* const card = names[std::size_t(found - lab_cards.begin())];
  Layout& layout = ui.settings.layout;
  layout.right = true;
  layout.map |= card == card_name::map, layout.inside |= card == card_name::step;
  layout.folded.erase(card);
  ui.plots.wanted = card;
  ui.plots.accuracy = AccuracySide::errors;
}

}  // namespace tyglab
