#include "app/platform/threads.h"

namespace tyglab {

void lower_own_priority() {}

}  // namespace tyglab
