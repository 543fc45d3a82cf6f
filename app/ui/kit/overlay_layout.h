// Places marks over the cloth without overlap: each mark chooses its place in turn, and later marks use the space that
// is left.
//
// A mark requests the nearest free place in a corner, or the first free one of several, and receives its place. View
// buttons come first, then the names of copies, the scales of arrows, PAUSED, the banner and the legend. The arrow to a
// cloth that is out of view and the labels of arrows come last, and are left out if there is no space; they and the
// scales make room for a tooltip. PAUSED and the legend also avoid the cloth, and stay where they are while nothing
// comes under them. tests/ui/marks_test.cpp checks that no two marks overlap.
#pragma once

#include <imgui.h>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/input.h"

namespace tyglab {

using Box = Viewport::Box;  ///< pixels of the window

bool overlap(const Box& a, const Box& b);
/// The sum of what a box shares with each of others, px².
float covered(const Box& box, std::span<const Box> others);

enum class ScreenCorner { lower_right, lower_left, upper_right, upper_left };

/// The places that are taken in a frame.
class OverlayLayout {
 public:
  struct Mark {
    std::string name;
    Box box;
  };
  /// A new frame begins, in which nothing is taken yet. `gap`: what marks keep from each other, px.
  void begin(float gap);
  /// The same frame once more from that mark on: what was taken before it stays.
  void back_to(std::string_view name);
  /// The box belongs to that mark from now on, whether it was free or not.
  void take(std::string name, const Box& box);
  /// Whether no mark is nearer to the box than the gap.
  bool free(const Box& box) const { return nearest_taken(box) == nullptr; }
  /// The place of that size in a corner of `area`, or as far from it along the side as others ask; none where that
  /// would leave the area.
  std::optional<Box> in_corner(const Box& area, glm::vec2 size, ScreenCorner corner) const;
  /// The first of these boxes that is free.
  std::optional<Box> first_free(std::span<const Box> boxes) const;
  const std::vector<Mark>& marks() const { return marks_; }
  /// Of the mark of that name; null where there is none in this frame.
  const Box* find(std::string_view name) const;

 private:
  const Box* nearest_taken(const Box& box) const;
  std::vector<Mark> marks_;
  float gap_ = 0;
};

/// Which of several places, the best first, to take: the first that covers nothing of `avoid`, or else the one that
/// covers least; but the one that was taken `before` as long as it covers nothing, or no other covers half as much,
/// since what stands still is found more easily. None where there is no place.
std::optional<std::size_t> choose_place(std::span<const std::optional<Box>> places, std::span<const Box> avoid,
                                        std::optional<std::size_t> before);

// A region of the window: a fixed part of it with its own background.

/// Its place, pixels.
struct Region {
  ImVec2 at, size;
};

/// Of a window that stands where it is put, without a frame.
inline constexpr ImGuiWindowFlags region_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse;

/// Starts a region as a fixed window with the given ground.
bool begin_region(const char* name, const Region& region, ImU32 ground, ImVec2 padding);
void end_region();

}  // namespace tyglab
