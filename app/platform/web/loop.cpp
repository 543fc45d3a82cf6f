#include "app/platform/loop.h"

#include <emscripten.h>

#include <utility>

namespace tyglab {
namespace {

std::unique_ptr<Turns>& present_turns() {
  static std::unique_ptr<Turns> turns;
  return turns;
}

void one_turn() {
  if (present_turns()->turn()) return;
  emscripten_cancel_main_loop();
  present_turns()->finish();
}

}  // namespace

int make_turns(std::unique_ptr<Turns> turns) {
  present_turns() = std::move(turns);
  emscripten_set_main_loop(one_turn, 0, false);
  return 0;
}

}  // namespace tyglab
