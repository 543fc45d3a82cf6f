#include "app/studies/job.h"

#include <sys/resource.h>

namespace tyglab {
namespace {

std::atomic<bool> work_yields = true;

}  // namespace

void let_work_yield(bool yields) {
  work_yields = yields;
}

void run_below_frames() {
  if (!work_yields) return;
  setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone
}

}  // namespace tyglab
