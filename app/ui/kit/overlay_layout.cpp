
#include "app/ui/kit/overlay_layout.h"

#include <algorithm>
#include <utility>

namespace tyglab {

bool overlap(const Box& a, const Box& b) {
  return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
}

float covered(const Box& box, std::span<const Box> others) {
  float sum = 0;
  for (const Box& other : others) {
    if (!overlap(box, other)) continue;
    sum += (std::min(box.hi.x, other.hi.x) - std::max(box.lo.x, other.lo.x)) *
           (std::min(box.hi.y, other.hi.y) - std::max(box.lo.y, other.lo.y));
  }
  return sum;
}

void OverlayLayout::begin(float gap) {
  marks_.clear();
  gap_ = gap;
}

void OverlayLayout::back_to(std::string_view name) {
  marks_.erase(std::find_if(marks_.begin(), marks_.end(), [&](const Mark& m) { return m.name == name; }), marks_.end());
}

void OverlayLayout::take(std::string name, const Box& box) {
  marks_.push_back({std::move(name), box});
}

const Box* OverlayLayout::nearest_taken(const Box& box) const {
  const Box wide{box.lo - gap_, box.hi + gap_};
  const auto mark = std::find_if(marks_.begin(), marks_.end(), [&](const Mark& m) { return overlap(m.box, wide); });
  return mark != marks_.end() ? &mark->box : nullptr;
}

const Box* OverlayLayout::find(std::string_view name) const {
  const auto mark = std::find_if(marks_.begin(), marks_.end(), [&](const Mark& m) { return m.name == name; });
  return mark != marks_.end() ? &mark->box : nullptr;
}

std::optional<Box> OverlayLayout::in_corner(const Box& area, glm::vec2 size, ScreenCorner corner) const {
  const bool right = corner == ScreenCorner::lower_right || corner == ScreenCorner::upper_right;
  const bool lower = corner == ScreenCorner::lower_right || corner == ScreenCorner::lower_left;
  glm::vec2 at{right ? area.hi.x - size.x : area.lo.x, lower ? area.hi.y - size.y : area.lo.y};
  if (at.x < area.lo.x || at.x + size.x > area.hi.x) return std::nullopt;
  while (at.y >= area.lo.y && at.y + size.y <= area.hi.y) {
    const Box box{at, at + size};
    const Box* other = nearest_taken(box);
    if (other == nullptr) return box;
    at.y = lower ? std::min(at.y - 1, other->lo.y - gap_ - size.y) : std::max(at.y + 1, other->hi.y + gap_);
  }
  return std::nullopt;
}

std::optional<Box> OverlayLayout::first_free(std::span<const Box> boxes) const {
  const auto box = std::find_if(boxes.begin(), boxes.end(), [&](const Box& b) { return free(b); });
  return box != boxes.end() ? std::optional(*box) : std::nullopt;
}

std::optional<std::size_t> choose_place(std::span<const std::optional<Box>> places, std::span<const Box> avoid,
                                        std::optional<std::size_t> before) {
  std::optional<std::size_t> best;
  float least = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!places[k]) continue;
    const float covers = covered(*places[k], avoid);
    if (!best || covers < least) best = k, least = covers;
  }
  const bool stands = before && *before < places.size() && places[*before];
  return stands && covered(*places[*before], avoid) <= 2 * least ? before : best;
}

bool begin_region(const char* name, const Region& region, ImU32 ground, ImVec2 padding) {
  ImGui::SetNextWindowPos(region.at);
  ImGui::SetNextWindowSize(region.size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
  return ImGui::Begin(name, nullptr, region_flags);
}

void end_region() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace tyglab
