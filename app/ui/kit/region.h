// A region of the window: a fixed part of it with its own background.
#pragma once

#include <imgui.h>

namespace tyglab {

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
