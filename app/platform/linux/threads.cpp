#include "app/platform/threads.h"

#include <sys/resource.h>

namespace tyglab {

void lower_own_priority() {
  setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone
}

}  // namespace tyglab
