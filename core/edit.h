// Every change of a simulation is an edit: a value that Simulation::apply alone applies between two steps. Undo,
// replay, lockstep copies, --set and tests all use edits.
#pragma once

#include <glm/vec3.hpp>
#include <variant>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/model/preset.h"

namespace tyglab::edit {

/// Sets all constants. The cloth is rebuilt only if rows, columns or kind differ. Constants of the start (x_0, v_0,
/// tilt_deg, …) take effect at the next restart, or at once if no step has been made.
struct Change {
  Preset preset;
};
/// Returns to the start with the present constants and mends tears.
struct Restart {};
/// The hand grabs particle (i, j). Pinned particles cannot be grabbed.
struct Grab {
  int i, j;
};
/// The hand moves to `to` (m), evenly over the next `steps` steps.
struct MoveHand {
  glm::dvec3 to;
  int steps;
};
struct Release {};
/// These particles lose their springs upward (2.3.4). Where the cloth parts, it is cut from each to the next.
struct Cut {
  std::vector<Pins::Site> sites;
};
/// Cuts these stretch springs and the bending springs over them, whatever the path of the knife; where the cloth parts,
/// it is cut through their owners. Sites outside the lattice are ignored.
struct CutSprings {
  std::vector<SpringSite> springs;
};
struct Pin {
  int i, j;
  bool pinned;
};
/// Moves body `index` to center `c`, or a plane to height `c.y`, over that many steps, in which it has the velocity of
/// the move; 0: at once. One that moves by itself is shifted at once.
struct MoveBody {
  int index;
  glm::dvec3 c;
  int steps = 0;
};

}  // namespace tyglab::edit

namespace tyglab {
using Edit = std::variant<edit::Change, edit::Restart, edit::Grab, edit::MoveHand, edit::Release, edit::Cut,
                          edit::CutSprings, edit::Pin, edit::MoveBody>;
}
