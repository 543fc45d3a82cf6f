// The cloth's picture, and the marks over it.
#pragma once

#include <array>

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// The five views (2.4), in the order of their keys.
inline constexpr std::array<const char*, 5> view_names{"1 Triangles", "2 Connections", "3 Both", "4 Outlines",
                                                       "5 Points"};

/// How far below the upper edge what stands under the view buttons begins, pixels at scale 1.
inline constexpr float under_views_at_1 = 44;

void viewport_panel(Ui& ui, const Region& region);
/// The list of what can color the cloth, at the cursor, and the legend of what does.
void color_menu(Ui& ui, float width);
/// As wide as it should be.
float color_menu_width(const Ui& ui);
void color_legend(Ui& ui);
void banner(Ui& ui, const Box& region);
/// Height at the foot of a region of that size that is the banner's own, so that it covers no cloth, px; 0 while there
/// is none.
float banner_strip(Ui& ui, glm::vec2 region);
void message_list(Ui& ui);

}  // namespace tyglab
