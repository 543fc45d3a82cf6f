#include "core/model/clocks.h"

#include <chrono>
#include <ctime>

namespace tyglab {

double thread_seconds() {
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return wall_seconds();
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double computing_seconds(EngineKind engine) {
  return engine == EngineKind::cpu ? thread_seconds() : wall_seconds();
}

}  // namespace tyglab
