// Tabs for cards of which only one has room: in a row or two, or as a list in a small column.
#pragma once

#include <span>

#include "app/ui/kit/ui_context.h"

namespace tyglab {

/// How the names are shown in a column of that size (px).
class CardTabs {
 public:
  CardTabs(const UiContext& ui, std::span<const char* const> names, ImVec2 column);
  /// Draws them at the cursor; returns the index of the one that was chosen, or -1.
  int draw(UiContext& ui, int chosen) const;
  float height() const { return height_; }  ///< px

 private:
  std::span<const char* const> names_;
  float width_, height_, padding_;
  bool list_ = false;
};

}  // namespace tyglab
