// Dear ImGui reads keys, buttons and the pointer once per frame, but one of our frames may contain a whole click, a
// drag or a typed word. So it receives all events in order, and in each frame only as many as it can distinguish.
#pragma once

#include <bitset>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "app/base/input.h"

namespace tyglab {

class GuiInput {
 public:
  /// Shows the current context what one frame can hold of all that has come and not been shown yet, and notes in
  /// `input` whether anything is left. Comes before ImGui::NewFrame, and after a back end that would say otherwise.
  void feed(InputQueue& input);

 private:
  /// What the present frame has been shown so far.
  struct Frame {
    bool key = false, text = false, button = false, moved = false;
    std::optional<int> mods;
  };
  void take(const InputQueue& input);
  void release_keys(const InputQueue& input);
  bool show(const InputEvent& event, Frame& frame);
  bool show(const KeyEvent& event, Frame& frame);
  bool show(const TypedCharacter& typed, Frame& frame);
  bool show(const PointerEvent& event, Frame& frame);

  std::vector<InputEvent> waiting_;
  std::bitset<InputQueue::most_keys> keys_, changed_;  ///< keys shown as down; those that the present frame changed
  std::bitset<InputQueue::most_buttons> buttons_;      ///< shown as down
  glm::vec2 at_{-1e6f};                                ///< where the pointer is shown
  int held_ = 0;  ///< frames at most for which all waits, until the field takes keys that the last key opens
  bool focused_ = true;
};

}  // namespace tyglab
