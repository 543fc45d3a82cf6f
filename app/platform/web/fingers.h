// Translates fingers on a touch screen into mouse buttons: one finger grabs what is under it, two rotate and zoom the
// view; over panels one finger presses and two scroll.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "app/base/input.h"

namespace tyglab {

class Fingers {
 public:
  enum class Phase { down, move, up };
  /// One of them, by its number, goes down, moves or is lifted; pixels.
  void on_finger(InputQueue& queue, int id, Phase phase, glm::vec2 at);

 private:
  struct Finger {
    int id;
    glm::vec2 at;
  };
  glm::vec2 middle() const;
  float distance() const;
  void hold(InputQueue& queue, int button);
  void let_go(InputQueue& queue);
  void move_two(InputQueue& queue);

  std::vector<Finger> fingers_;
  int button_ = -1;    ///< held down; below 0: none
  float apart_ = 0;    ///< of two, when last looked at, pixels
  glm::vec2 last_{0};  ///< the middle between two, likewise
  bool over_cloth_ = false;
};

}  // namespace tyglab
