// Prints answers of drivers, which may crash.
#pragma once

#include <string>

namespace tyglab {

/// Prints in a process of its own, since a driver that aborts takes its process along; what the driver prints by itself
/// goes to driver_log(). On Windows in this one. Returns how that ended, or nothing if it came to its end. Throws
/// OutputError if not all that it printed arrived.
std::string print_in_child(void (*print)());

}  // namespace tyglab
