// A card of the gallery: the picture, title and purpose of a scene.
#pragma once

#include <string>

#include "app/ui/state/ui.h"

namespace tyglab {

/// What all cards of a gallery have in common, px: the picture stands over the text, or at its left.
struct CardShape {
  float width;
  ImVec2 picture;
  bool beside;
};
CardShape card_shape(const Ui& ui, float width, bool beside);

/// What a card says, in lines of its width; nothing of it is cut but a goal of more than a few lines.
struct CardText {
  std::string title, goal;
  float height;  ///< px, of the card
  bool whole;    ///< the goal is all that there is to say
};
CardText card_text(const Ui& ui, const GalleryCard& card, const CardShape& shape);

/// Whole sentences of a text, as many as three lines of that width (px) hold, but the first in any case.
std::string goal_in_lines(const ImFont& font, const std::string& text, float width);

/// Draws it from that corner on, with the height of its row, px; `lit`: under the pointer, or chosen by keys.
void draw_gallery_card(Ui& ui, const GalleryCard& card, ImVec2 lo, const CardShape& shape, float height, bool lit);

}  // namespace tyglab
