#include <sched.h>

#include <algorithm>

#include "core/analysis/machine.h"

namespace tyglab {

int processors() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

}  // namespace tyglab
