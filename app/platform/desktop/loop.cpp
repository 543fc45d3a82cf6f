#include "app/platform/loop.h"

namespace tyglab {

int make_turns(std::unique_ptr<Turns> turns) {
  while (turns->turn()) {
  }
  return turns->finish();
}

}  // namespace tyglab
