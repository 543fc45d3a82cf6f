// Keyboard and pointer events since the last frame, in order, as GLFW's callbacks report them. Slow drawing loses no
// press, however short.
#pragma once

#include <array>
#include <bitset>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <variant>
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
  bool click = true;   ///< of release: false where a gesture has taken the press over
};

struct TypedCharacter {
  unsigned code;  ///< of Unicode
};

using InputEvent = std::variant<KeyEvent, TypedCharacter, PointerEvent>;

struct InputQueue {
  static constexpr int most_keys = 512, most_buttons = 5;

  std::vector<KeyEvent> keys;
  std::vector<PointerEvent> pointer;
  std::vector<InputEvent> all;         ///< those and characters, in the order in which they came
  std::vector<std::string> dropped;    ///< files dropped on the window
  glm::vec2 at{-1e6f};                 ///< the pointer's last position
  int mods = 0;                        ///< held now
  std::bitset<most_keys> keys_down;    ///< now
  std::bitset<most_buttons> buttons;   ///< likewise
  bool focused = true, inside = true;  ///< the window has the keyboard; the pointer is over it
  bool by_touch = false;               ///< fingers point, on a screen that they touch: no buttons, no hovering
  bool scale_changed = false;          ///< the window went to a monitor with another content scale
  bool anything = false;               ///< an event of any kind arrived
  bool field_opens = false;            ///< what was typed in this frame is for a field that takes keys in a later one
  bool unread = false;                 ///< Dear ImGui has not yet been shown everything that was typed
  bool unshown = false;                ///< nor all else that happened: it comes in the next frames
  bool double_click = false;           ///< the left button went down for the second time at the same place, just now
  int double_click_frames = 0;         ///< for how many frames more that counts: Dear ImGui sees a press frames later
  double double_click_s = 0.4;         ///< longest time between its presses; longer where frames are slow
  float double_click_px = 6;           ///< farthest that its presses are apart
  double last_press = -1;              ///< s, of the left button
  glm::vec2 last_press_at{0};

  std::function<int(glm::vec2)> finger_button;     ///< GLFW_MOUSE_BUTTON_… that a finger there stands for; none: left
  std::function<bool(glm::vec2)> finger_on_cloth;  ///< whether a finger there is over the cloth's picture
  std::function<bool(glm::vec2)> finger_on_list;   ///< whether it is over what scrolls

  // What GLFW's callbacks are told; times are glfwGetTime's, s.
  void on_key(int key, int action, int mods);
  void on_character(unsigned code);
  void on_button(int button, int action, int mods, double time);
  /// The button is up because a gesture has taken its press over: no control counts as clicked.
  void on_cancel(int button, double time);
  void on_move(glm::vec2 to, double time);
  void on_wheel(glm::vec2 by, double time);

  /// Ends the frame, which has processed all events.
  void clear();

 private:
  void add(const PointerEvent& event);
  void note_left_press(double time);
};

// The part of the window that shows the cloth.

/// The place of the viewport in the window, and the panels over it.
struct Viewport {
  struct Box {
    glm::vec2 lo{0}, hi{0};
    bool contains(glm::vec2 p) const { return p.x >= lo.x && p.y >= lo.y && p.x < hi.x && p.y < hi.y; }
  };
  Box box;
  int columns = 1, rows = 1;  ///< pictures of one camera side by side: the cloth's, then its copies', row by row
  float buttons = 0;          ///< that much of each picture's height is left to buttons and marks, pixels
  float foot = 0;             ///< and that much at its lower edge to the name of its cloth
  float filled = 0.84f;       ///< the part of what is left that framing gives to the cloth
  std::vector<Box> covers;    ///< buttons and banners over it: presses there are theirs
  bool blocked = false;       ///< a menu or dialog is open: every press is its own
  glm::vec2 whole() const { return box.hi - box.lo; }
  /// Of one picture.
  glm::vec2 size() const { return whole() / glm::vec2(columns, rows); }
  /// The upper left corner of the n-th picture, pixels in the window.
  glm::vec2 origin(int tile) const { return box.lo + size() * glm::vec2(tile % columns, tile / columns); }
  /// The corner of a further picture; none if the pictures take all places.
  std::optional<glm::vec2> free_place(int pictures) const {
    return pictures < columns * rows ? std::optional(origin(pictures)) : std::nullopt;
  }
  /// The picture under a pixel of the window, or the nearest one.
  int tile_at(glm::vec2 p) const;
  /// Divides the viewport for that many pictures.
  void divide(int pictures);
  bool takes(glm::vec2 p) const {
    if (blocked || !box.contains(p)) return false;
    for (const Box& cover : covers)
      if (cover.contains(p)) return false;
    return true;
  }
};

}  // namespace tyglab
