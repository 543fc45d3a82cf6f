// Keys to commands, from the window's own callback: Dear ImGui loses short presses during long frames.
#pragma once

namespace tyglab {

struct KeyEvent;
struct Ui;

/// Turns the frame's key presses into requests. A text field or slider that is active keeps its keys.
void handle_keys(Ui& ui);
/// Whether it is the key of a command that opens a text field, for which what is typed next is.
bool opens_field(const KeyEvent& event);

}  // namespace tyglab
