#include "app/studies/job.h"

#include "app/process/process.h"

namespace tyglab {
namespace {

std::atomic<bool> work_yields = true;

}  // namespace

void let_work_yield(bool yields) {
  work_yields = yields;
}

void run_below_frames() {
  if (!work_yields) return;
  lower_thread_priority();
}

}  // namespace tyglab
