#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/session/lab.h"
#include "app/ui/state/ui.h"

namespace tyglab {

bool in_front(const Ui& ui, std::string_view name) {
  const Plots& plots = ui.plots;
  return plots.tab == name && std::find(plots.cards.begin(), plots.cards.end(), name) != plots.cards.end();
}

void show_card(Ui& ui, std::string_view name) {
  Layout& layout = ui.settings.layout;
  layout.right = ui.panels = true;
  ui.side = Side::plots;
  layout.folded.erase(std::string(name));
  ui.plots.wanted = name;
}

const char* card_of_lab(std::string_view name) {
  constexpr std::array names{card_name::forces,   card_name::height, card_name::stability,
                             card_name::accuracy, card_name::energy, card_name::performance,
                             card_name::copies,   card_name::map,    card_name::step};
  static_assert(names.size() == lab_cards.size());
  const auto found = std::find(lab_cards.begin(), lab_cards.end(), name);
  return found == lab_cards.end() ? nullptr : names[std::size_t(found - lab_cards.begin())];
}

void show_for_lab(Ui& ui, std::string_view name) {
  const char* const card = card_of_lab(name);
  if (card == nullptr) return;
  Layout& layout = ui.settings.layout;
  LabCards& opened = ui.lab_cards;
  const auto open = [](bool& shown, bool& by_lab) {
    by_lab |= !shown;
    shown = true;
  };
  open(layout.right, opened.column);
  if (card == card_name::map) open(layout.map, opened.map);
  if (card == card_name::step) open(layout.inside, opened.step);
  if (layout.folded.erase(card) > 0) opened.unfolded.insert(card);
  ui.plots.wanted = card;
  ui.plots.accuracy = AccuracySide::errors;
}

void close_lab_cards(Ui& ui) {
  const LabCards opened = std::exchange(ui.lab_cards, {});
  Layout& layout = ui.settings.layout;
  if (opened.column) layout.right = false;
  if (opened.map) layout.map = false;
  if (opened.step) layout.inside = false;
  layout.folded.insert(opened.unfolded.begin(), opened.unfolded.end());
}

}  // namespace tyglab
