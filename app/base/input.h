// Keyboard and pointer events since the last frame, in order, as GLFW's callbacks report it. Dear ImGui samples once a
// frame and drops short presses when frames are long; this queue does not.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace tyglab {

struct KeyEvent {
  int key;   ///< GLFW_KEY_…
  int mods;  ///< GLFW_MOD_…
  bool repeat;
};

struct PointerEvent {
  enum class Type { press, release, move, wheel };
  Type type;
  int button = 0;      ///< GLFW_MOUSE_BUTTON_…, of press and release
  int mods = 0;        ///< GLFW_MOD_… held at the time
  glm::vec2 at{0};     ///< window coordinates
  glm::vec2 wheel{0};  ///< of wheel
  double time = 0;     ///< s, glfwGetTime
};

/// A character that was typed, and how many of the queue's keys were pressed before it.
struct TypedCharacter {
  unsigned character;
  std::size_t keys_before;
};

struct InputQueue {
  std::vector<KeyEvent> keys;
  std::vector<TypedCharacter> text;  ///< filled only where Dear ImGui keeps no order itself (before 1.87)
  std::vector<PointerEvent> pointer;
  std::vector<std::string> dropped;  ///< files dropped on the window
  glm::vec2 at{-1e6f};               ///< the pointer's last position
  int mods = 0;
  bool scale_changed = false;   ///< the window went to a monitor with another content scale
  bool anything = false;        ///< an event of any kind arrived
  bool unread = false;          ///< Dear ImGui has not yet been shown everything that was typed
  bool unshown = false;         ///< nor all else that happened: it comes in the next frames
  bool double_click = false;    ///< the left button went down for the second time at the same place, just now
  int double_click_frames = 0;  ///< for how many frames more that counts: Dear ImGui may show a press some frames late
  double double_click_s = 0.4;  ///< longest time between its presses; longer where frames are slow
  double last_press = -1;       ///< s, of the left button
  glm::vec2 last_press_at{0};

  /// Notes a press of the left button; two in quick succession are a double click even where one frame holds both.
  void note_left_press(double time) {
    const bool second =
        time - last_press < double_click_s && std::hypot(at.x - last_press_at.x, at.y - last_press_at.y) < 6;
    if (second) double_click = true, double_click_frames = 3;
    last_press = second ? -1 : time;
    last_press_at = at;
  }

  void clear() {
    keys.clear(), text.clear(), pointer.clear(), dropped.clear();
    scale_changed = anything = false;
    double_click = double_click_frames > 0 && --double_click_frames > 0;
  }
};

}  // namespace tyglab
