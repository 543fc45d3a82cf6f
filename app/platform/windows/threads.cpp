#include "app/platform/threads.h"

#include <windows.h>

namespace tyglab {

void lower_own_priority() {
  ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST);
}

}  // namespace tyglab
