// Translates fingers on a touch screen into mouse buttons: one finger grabs what is under it, two rotate and zoom the
// view; over panels, one finger presses or scrolls. A press counts only once it is known to be one
// finger's, so a gesture of two fingers is never a click as well.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "app/base/input.h"

namespace tyglab {

class Fingers {
 public:
  /// ended: the system has taken it for something else, so that it was no tap.
  enum class Phase { down, move, up, ended };
  /// The finger of that number goes down, moves or is lifted; pixels, s.
  void on_finger(InputQueue& queue, int id, Phase phase, glm::vec2 at, double time);
  /// To be called in every frame: a finger that stays alone presses after a moment.
  void update(InputQueue& queue, double time);

  float slack = 10;       ///< pixels within which a finger counts as still
  float wheel_step = 40;  ///< pixels that a panel scrolls for a step of the wheel

 private:
  /// The action of the first finger: it may still be the first of two (pending), has pressed, scrolls a panel, or has
  /// no action (any more).
  enum class Role { none, pending, pressed, scrolls };
  struct Finger {
    int id;
    glm::vec2 at;
  };
  glm::vec2 middle() const;
  float distance() const;
  void put_down(InputQueue& queue, glm::vec2 at, double time);
  void move_one(InputQueue& queue, glm::vec2 at, double time);
  void move_two(InputQueue& queue, double time);
  void press(InputQueue& queue, double time);
  void scroll(InputQueue& queue, float by, double time) const;
  void hold(InputQueue& queue, int button, double time);
  void let_go(InputQueue& queue, double time);

  std::vector<Finger> fingers_;
  Role role_ = Role::none;
  glm::vec2 start_{0};  ///< where the first finger went down, pixels
  double since_ = 0;    ///< when, s
  bool moved_ = false;  ///< it has moved since, beyond the slack
  int wanted_ = -1;     ///< the button that it stands for
  int button_ = -1;     ///< held down; below 0: none
  float apart_ = 0;     ///< of two, when last looked at, pixels
  glm::vec2 last_{0};   ///< the middle between two, or the one that scrolls, likewise
  bool over_cloth_ = false;
  bool over_list_ = false;  ///< something that scrolls
};

}  // namespace tyglab
