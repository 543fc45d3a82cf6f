#include "app/studies/job.h"

#include <sys/resource.h>

namespace tyglab {

void run_below_frames() {
  setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone
}

}  // namespace tyglab
