// A card with a plot: its background, with a title, a note and buttons above the contents.
#pragma once

#include <string_view>

#include "app/ui/kit/region.h"

namespace tyglab {

/// Begins where the cursor stands, as wide as its region; the cursor then goes inside it.
class PlotCard {
 public:
  /// `buttons`: how many head_buttons follow; the note stands to their left.
  PlotCard(UiContext& ui, const char* id, std::string_view title, std::string_view note, float height, int buttons = 0);
  ~PlotCard();
  PlotCard(const PlotCard&) = delete;
  PlotCard& operator=(const PlotCard&) = delete;
  const Region& inner() const { return inner_; }

  /// A button on the title's line, the n-th from the right; the cursor stays.
  bool head_button(UiContext& ui, int n, const char* id, const char* glyph, const char* word, const char* tip) const;

 private:
  Region inner_;
};

/// Height of a card with that much in it, and width of what a card of that width holds, px.
float plot_card_height(const UiContext& ui, float content);
float plot_card_inner_width(const UiContext& ui, float width);
/// The width that is left for its title beside that many buttons, px.
float plot_card_title_width(const UiContext& ui, float width, int buttons);

}  // namespace tyglab
