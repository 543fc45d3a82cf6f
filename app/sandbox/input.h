// What keyboard and pointer did since the last frame, in order, as GLFW's callbacks told it. Dear ImGui samples once a
// frame and drops short presses when frames are long; this queue does not.
#pragma once

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

struct InputQueue {
  std::vector<KeyEvent> keys;
  std::vector<PointerEvent> pointer;
  std::vector<std::string> dropped;  ///< files dropped on the window
  glm::vec2 at{-1e6f};               ///< the pointer's last position
  int mods = 0;
  bool scale_changed = false;  ///< the window went to a monitor with another content scale
  bool anything = false;       ///< an event of any kind arrived

  void clear() {
    keys.clear(), pointer.clear(), dropped.clear();
    scale_changed = anything = false;
  }
};

}  // namespace tyglab
