// Background threads.
#pragma once

namespace tyglab {

/// Lowers the priority of the calling thread, where the system can.
void lower_own_priority();

}  // namespace tyglab
