// Run, step, restart and the speed: in the top bar and, large, in presentation mode.
#pragma once

#include <imgui.h>

#include <string>

namespace tyglab {

struct Ui;

/// The three buttons from there on, each `side` wide (at scale 1). Returns their lower right corner.
ImVec2 transport_buttons(Ui& ui, ImVec2 at, float side = 32);
/// What they take, px.
ImVec2 transport_size(const Ui& ui, float side = 32);

/// The speeds to choose from, in one row or, where that is wider than `width` (px), in more.
void speed_control(Ui& ui, ImVec2 at, float width);
ImVec2 speed_control_size(const Ui& ui, float width);
/// What those that are always offered take in one row, px.
ImVec2 offered_speeds_size(const Ui& ui);
/// The same choice as a list that shows the present speed, where the speeds have no room beside each other.
void speed_list(Ui& ui, ImVec2 at);
/// Its size, px; `offered`: with one of the speeds that are always offered, whatever the present one is.
ImVec2 speed_list_size(const Ui& ui, bool offered = false);

/// Simulated time to real time, over the last half second, "98 %", and the color to say it in.
struct RealTime {
  std::string text;
  ImU32 color;
  bool known = true;  ///< false: time stands still, or is meant to be slow, and the text is a dash
};
RealTime real_time(const Ui& ui);
inline constexpr const char* real_time_tip =
    "Simulated time to real time, over the last half second. Amber: the machine does not reach the requested speed.";

}  // namespace tyglab
