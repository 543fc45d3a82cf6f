// Keys to commands, from the window's own callback: Dear ImGui drops short presses when frames are long.
#pragma once

namespace tyglab {

struct Ui;

/// Turns the frame's key presses into requests. A text field or slider that is active keeps its keys.
void handle_keys(Ui& ui);

}  // namespace tyglab
