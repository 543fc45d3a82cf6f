#include "app/studies/job.h"

#include "app/platform/threads.h"

namespace tyglab {
namespace {

std::atomic<bool> work_yields = true;

}  // namespace

void let_work_yield(bool yields) {
  work_yields = yields;
}

void run_below_frames() {
  if (work_yields) lower_own_priority();
}

}  // namespace tyglab
